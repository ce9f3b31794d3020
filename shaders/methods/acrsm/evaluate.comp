/* SPDX-License-Identifier: MIT
 *
 * First pass of the evaluation (thesis 4.8, 5.3.1): sums over the clusters whose centre lies in the
 * square of `side` texels round a cluster's own, and a random order of all clusters.
 *
 * NEIGHBOURS 0: each invocation goes through the list of clusters.
 * NEIGHBOURS 1: each work group goes through the texels of the square, as the thesis does; the same
 * clusters, at a cost that grows with the square. Large squares take several dispatches, the bands
 * first_part..end_part-1 of GROUP rows in each (core/gl/context.h, IRB_LOOP_ROUNDS_MOST); all but
 * the last leave their sums in `carry` for the next.
 */
#include "methods/acrsm/cluster.glsl"
#include "methods/acrsm/evaluation.glsl"
#include "sampling/hash.glsl"

#define GROUP 64
layout(local_size_x = GROUP) in;

layout(std140, binding = 0) uniform Clusters { cluster clusters[CLUSTERS_MOST]; };
layout(std430, binding = 1) writeonly buffer Evaluation {
    verification verifications[CLUSTERS_MOST];
    uint order[CLUSTERS_MOST]; /* a random permutation */
};

uniform usampler2D cluster_map;
uniform int active_count; /* k */
uniform int side;
uniform uint seed; /* of this frame */

float most_area()
{
    float most = 0.0;
    for (int i = 0; i < active_count; i++)
        most = max(most, in_use(clusters[i].count) ? clusters[i].area : 0.0);
    return most;
}

void put_in_order(uint i)
{
    uint key = hash_u32(seed, i), rank = 0u;
    for (uint j = 0u; j < uint(active_count); j++) {
        uint other = hash_u32(seed, j);
        rank += other < key || (other == key && j < i) ? 1u : 0u;
    }
    order[rank] = i;
}

#if NEIGHBOURS
uniform int first_part, end_part;
layout(std430, binding = 7) buffer Carry { vec2 carry[]; }; /* GROUP a cluster */
shared vec2 partial[GROUP];

void main()
{
    uint i = gl_WorkGroupID.x;
    int resolution = textureSize(cluster_map, 0).x;
    ivec2 corner = square_corner(texel_at(clusters[i].uv, resolution), side);
    ivec2 low = max(corner, ivec2(0)), high = min(corner + side, ivec2(resolution));
    float most = most_area();
    uint carried = i * uint(GROUP) + gl_LocalInvocationID.x;
    vec2 sum = first_part > 0 ? carry[carried] : vec2(0.0);
    int begin = low.y + GROUP * first_part + int(gl_LocalInvocationID.x);
    int end = min(high.y, low.y + GROUP * end_part);
    for (int y = begin; y < end; y += GROUP)
        for (int x = low.x; x < high.x; x++) {
            uint j = texelFetch(cluster_map, ivec2(x, y), 0).g;
            if (j >= uint(active_count) || j == i)
                continue;
            float delta = delta_of(clusters[j].area, clusters[j].importance, most);
            sum += vec2(delta * delta, delta);
        }
    if (GROUP * end_part < side)
        carry[carried] = sum;
    partial[gl_LocalInvocationID.x] = sum;
    barrier();
    if (gl_LocalInvocationID.x != 0u || GROUP * end_part < side)
        return;
    for (int t = 1; t < GROUP; t++)
        sum += partial[t];
    verifications[i] = verification(
        sum.x, sum.y, delta_of(clusters[i].area, clusters[i].importance, most), 0.0);
    put_in_order(i);
}
#else
void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(active_count))
        return;
    int resolution = textureSize(cluster_map, 0).x;
    ivec2 corner = square_corner(texel_at(clusters[i].uv, resolution), side);
    float most = most_area();
    vec2 sum = vec2(0.0);
    for (uint j = 0u; j < uint(active_count); j++) {
        ivec2 texel = texel_at(clusters[j].uv, resolution);
        /* of clusters that share a texel the map holds one */
        if (j == i || !in_use(clusters[j].count) || !in_square(texel, corner, side) ||
            texelFetch(cluster_map, texel, 0).g != j)
            continue;
        float delta = delta_of(clusters[j].area, clusters[j].importance, most);
        sum += vec2(delta * delta, delta);
    }
    verifications[i] = verification(
        sum.x, sum.y, delta_of(clusters[i].area, clusters[i].importance, most), 0.0);
    put_in_order(i);
}
#endif
