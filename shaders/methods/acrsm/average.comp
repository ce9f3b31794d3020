/* SPDX-License-Identifier: MIT
 *
 * Averaging (thesis 4.7, 5.3.1): position, uv, normal and importance of a cluster become the means
 * over its texels, its flux their sum, its area that of the disc that holds them all. A work group
 * makes one cluster; every sum is taken in a fixed order. Large maps take several dispatches, the
 * words first_part..end_part-1 of the tiles in each (core/gl/context.h, IRB_LOOP_ROUNDS_MOST); all
 * but the last leave their sums in `carry` for the next.
 */
#define GROUP 64
layout(local_size_x = GROUP) in;

#include "frame/light.glsl"
#include "frame/rsm_fetch.glsl"
#include "gl/constants.glsl"
#include "methods/acrsm/cluster.glsl"
#include "methods/acrsm/tiles.glsl"

layout(std430, binding = 0) buffer Clusters { cluster clusters[CLUSTERS_MOST]; };
layout(std430, binding = 5) readonly buffer Presence { uint presence[]; };

uniform int first_part, end_part;
uniform sampler2D importance;
uniform usampler2D cluster_map;
uniform bool second_moment; /* area from the second moment instead of the farthest texel */

const float LEAST_NORMAL = 0.1; /* length of a mean normal below which it has no direction */

struct sums {
    vec4 offset; /* from the centre, m; squared length, m2 */
    vec4 normal; /* and importance */
    vec4 flux;   /* W; number of texels */
    vec4 image;  /* offset in texels; largest squared length, m2 */
};
shared sums partial[GROUP];
layout(std430, binding = 7) buffer Carry { sums carry[]; }; /* GROUP a cluster */

sums sums_add(sums a, sums b)
{
    return sums(a.offset + b.offset, a.normal + b.normal, a.flux + b.flux,
                vec4(a.image.xy + b.image.xy, max(a.image.z, b.image.z), 0.0));
}

/* Adds the texels of a tile that this invocation takes: one column's every GROUP/TILE_SIDE-th. */
void add_tile(int tile, uint i, vec3 c, ivec2 centre, inout sums sum)
{
    int resolution = rsm_resolution(), tiles = tiles_a_row(resolution);
    int lane = int(gl_LocalInvocationID.x);
    ivec2 corner = ivec2(tile % tiles, tile / tiles) * TILE_SIDE;
    for (int row = lane / TILE_SIDE; row < TILE_SIDE; row += GROUP / TILE_SIDE) {
        ivec2 texel = corner + ivec2(lane % TILE_SIDE, row);
        /* the map has no cluster beyond its border: the fetch is clamped to what is not ours */
        if (any(greaterThanEqual(texel, ivec2(resolution))) ||
            texelFetch(cluster_map, texel, 0).r != i)
            continue;
        vec3 d = rsm_fetch_position(texel).xyz - c;
        float d2 = dot(d, d);
        sum = sums_add(sum, sums(vec4(d, d2),
                                 vec4(rsm_fetch_normal(texel), texelFetch(importance, texel, 0).r),
                                 vec4(rsm_fetch_flux(texel), 1.0),
                                 vec4(vec2(texel - centre), d2, 0.0)));
    }
}

sums sums_of(uint i, vec3 c, ivec2 centre)
{
    sums sum = sums(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    if (first_part > 0)
        sum = carry[i * uint(GROUP) + gl_LocalInvocationID.x];
    int words = tile_words(rsm_resolution());
    for (int word = first_part; word < end_part; word++) {
        uint mask = presence[i * uint(words) + uint(word)];
        while (mask != 0u) {
            add_tile(32 * word + findLSB(mask), i, c, centre, sum);
            mask &= mask - 1u;
        }
    }
    return sum;
}

/* The mean's direction; where it has none (two sides of a wall: |n_c.n| takes both) the normal of
 * the texel at the new centre, or the one that the cluster had. */
vec3 mean_normal(vec3 mean, ivec2 centre, vec3 before)
{
    if (dot(mean, mean) > LEAST_NORMAL * LEAST_NORMAL)
        return normalize(mean);
    vec3 n = rsm_fetch_normal(centre);
    return dot(n, n) > 0.5 ? n : before;
}

/* The disc through the farthest texel (thesis 4.7), or that of the same second moment: a disc of
 * radius R has the mean squared distance R^2/2 from its centre. A texel's own footprint is the
 * least: one texel alone would have no area, and light of no bound. */
float area_of(sums sum, vec3 position)
{
    float n = sum.flux.w;
    vec3 mean = sum.offset.xyz / n;
    float variance = max(sum.offset.w / n - dot(mean, mean), 0.0);
    float r2 = second_moment ? 2.0 * variance : sum.image.z;
    float z = rsm_to_light_frame(position).z;
    float texel = 2.0 * rsm_half_extent / float(rsm_resolution()) *
                  (rsm_spread.x * max(z, 0.0) + rsm_spread.y);
    return max(PI * r2, texel * texel);
}

/* Eq. 2.1: from the light at the cluster's centre, mean of the channels; W/m2. */
float irradiance_at(vec3 position, vec3 normal)
{
    vec3 to_light;
    float distance_to_light;
    vec3 e = light_incident(position, to_light, distance_to_light);
    return dot(e, vec3(1.0 / 3.0)) * abs(dot(normal, to_light));
}

void finish(uint i, sums sum, vec3 c, ivec2 centre)
{
    float n = sum.flux.w, resolution = float(rsm_resolution());
    vec3 position = c + sum.offset.xyz / n;
    vec2 uv = (vec2(centre) + 0.5 + sum.image.xy / n) / resolution;
    ivec2 texel = texel_at(uv, rsm_resolution());
    clusters[i].position = position;
    clusters[i].normal = mean_normal(sum.normal.xyz / n, texel, clusters[i].normal);
    clusters[i].importance = sum.normal.w / n;
    clusters[i].flux = sum.flux.xyz;
    clusters[i].centre_flux = rsm_fetch_flux(texel);
    clusters[i].uv = uv;
    clusters[i].area = area_of(sum, position);
    clusters[i].irradiance = irradiance_at(position, clusters[i].normal);
    clusters[i].count = int(n);
}

void vanish(uint i)
{
    clusters[i].flux = vec3(0.0);
    clusters[i].centre_flux = vec3(0.0);
    clusters[i].area = 0.0;
    clusters[i].irradiance = 0.0;
    clusters[i].count = VANISHED;
}

void main()
{
    uint i = gl_WorkGroupID.x;
    bool mapped_to = is_mapped_to(clusters[i].count);
    vec3 c = clusters[i].position;
    ivec2 centre = texel_at(clusters[i].uv, rsm_resolution());
    bool last = end_part == tile_words(rsm_resolution());
    if (mapped_to)
        partial[gl_LocalInvocationID.x] = sums_of(i, c, centre);
    if (mapped_to && !last)
        carry[i * uint(GROUP) + gl_LocalInvocationID.x] = partial[gl_LocalInvocationID.x];
    barrier();
    if (gl_LocalInvocationID.x != 0u || !mapped_to || !last)
        return;
    sums sum = partial[0];
    for (int t = 1; t < GROUP; t++)
        sum = sums_add(sum, partial[t]);
    if (sum.flux.w > 0.0)
        finish(i, sum, c, centre);
    else
        vanish(i);
}
