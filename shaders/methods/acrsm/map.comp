/* SPDX-License-Identifier: MIT
 *
 * Mapping (thesis 4.6): each lit texel goes to the nearest of the clusters whose square covers it,
 *     mu = w_x |x - c|/b_max + w_n (1 - |n_c.n|) + w_rho |rho_c - rho|          (eq. 4.4)
 *     C_min = arg min mu                                                        (eq. 4.5)
 * ties to the lower index. Where the thesis draws squares with a depth test, here an invocation
 * goes through the clusters of its tile for TEXELS texels at once.
 *
 * COVER 1: texels that no square covers go to the nearest of all clusters.
 * SIGNED_NORMALS 1: n_c.n clamped at 0 instead of its magnitude.
 */
#define GROUP 8
#define PER_SIDE 4
#define TEXELS (PER_SIDE * PER_SIDE)
layout(local_size_x = GROUP, local_size_y = GROUP) in;

#include "frame/rsm_fetch.glsl"
#include "methods/acrsm/cluster.glsl"
#include "methods/acrsm/tiles.glsl"

layout(std140, binding = 0) uniform Clusters { cluster clusters[CLUSTERS_MOST]; };
layout(std430, binding = 4) readonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 5) buffer Presence { uint presence[]; };
layout(rg32ui, binding = 0) writeonly uniform uimage2D cluster_map;

uniform sampler2D importance;
uniform int active_count;
uniform int side;     /* of the clusters' squares, texels */
uniform vec3 weights; /* of position (1/m: w_x / b_max), normal and importance */

const float FAR = 3.0e38;

float normal_distance(vec3 a, vec3 b)
{
#if SIGNED_NORMALS
    return 1.0 - max(dot(a, b), 0.0);
#else
    return 1.0 - abs(dot(a, b));
#endif
}

void main()
{
    int resolution = rsm_resolution();
    vec3 x[TEXELS], n[TEXELS];
    float rho[TEXELS], best[TEXELS];
    uint nearest[TEXELS];
    ivec2 texel[TEXELS];
    bool lit[TEXELS];
    for (int j = 0; j < TEXELS; j++) {
        texel[j] = ivec2(gl_WorkGroupID.xy) * TILE_SIDE + ivec2(gl_LocalInvocationID.xy) +
                   GROUP * ivec2(j % PER_SIDE, j / PER_SIDE);
        ivec2 inside = min(texel[j], ivec2(resolution - 1));
        x[j] = rsm_fetch_position(inside).xyz;
        n[j] = rsm_fetch_normal(inside);
        rho[j] = texelFetch(importance, inside, 0).r;
        lit[j] = texel[j] == inside && is_lit(rsm_fetch_flux(inside));
        best[j] = FAR;
        nearest[j] = NO_CLUSTER;
    }
    int tile = int(gl_WorkGroupID.y) * tiles_a_row(resolution) + int(gl_WorkGroupID.x);
    for (int word = 0; word * 32 < active_count; word++) {
        uint mask = candidates[tile * CLUSTER_WORDS + word];
        while (mask != 0u) {
            int i = 32 * word + findLSB(mask);
            mask &= mask - 1u;
            vec3 c = clusters[i].position, c_n = clusters[i].normal;
            float c_rho = clusters[i].importance;
            ivec2 corner = square_corner(texel_at(clusters[i].uv, resolution), side);
            for (int j = 0; j < TEXELS; j++) {
                float mu = weights.x * distance(x[j], c) +
                           weights.y * normal_distance(n[j], c_n) +
                           weights.z * abs(rho[j] - c_rho);
                bool nearer = mu < best[j] && in_square(texel[j], corner, side);
                best[j] = nearer ? mu : best[j];
                nearest[j] = nearer ? uint(i) : nearest[j];
            }
        }
    }
#if COVER
    for (int j = 0; j < TEXELS; j++) {
        if (!lit[j] || nearest[j] != NO_CLUSTER)
            continue;
        for (int i = 0; i < active_count; i++) {
            float mu = weights.x * distance(x[j], clusters[i].position) +
                       weights.y * normal_distance(n[j], clusters[i].normal) +
                       weights.z * abs(rho[j] - clusters[i].importance);
            bool nearer = mu < best[j] && is_mapped_to(clusters[i].count);
            best[j] = nearer ? mu : best[j];
            nearest[j] = nearer ? uint(i) : nearest[j];
        }
    }
#endif
    int words = tile_words(resolution);
    for (int j = 0; j < TEXELS; j++) {
        imageStore(cluster_map, texel[j],
                   uvec4(lit[j] ? nearest[j] : UNLIT, NO_CLUSTER, 0u, 0u));
        if (lit[j] && nearest[j] != NO_CLUSTER)
            atomicOr(presence[nearest[j] * uint(words) + uint(tile / 32)], 1u << (tile & 31));
    }
}
