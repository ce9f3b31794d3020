/* SPDX-License-Identifier: MIT
 *
 * Second pass of the evaluation (thesis 4.8, 5.3.1, fig. 5.6): the first `selected` clusters of the
 * random order are merged (put on the list of free clusters) or split (a free cluster gets a seed
 * inside them); what is left of the free clusters goes to the re-seed list. One invocation: the
 * list is short, and its order decides who gets a free cluster.
 */
layout(local_size_x = 1) in;

#include "frame/rsm_fetch.glsl"
#include "gl/constants.glsl"
#include "methods/acrsm/cluster.glsl"
#include "methods/acrsm/evaluation.glsl"
#include "methods/acrsm/lists.glsl"
#include "sampling/hash.glsl"

layout(std430, binding = 0) buffer Clusters { cluster clusters[CLUSTERS_MOST]; };
layout(std430, binding = 1) readonly buffer Evaluation {
    verification verifications[CLUSTERS_MOST];
    uint order[CLUSTERS_MOST];
};

uniform usampler2D cluster_map; /* of the last frame */
uniform int selected;
uniform float merge_threshold; /* epsilon_m */
uniform float split_threshold; /* epsilon_s */
uniform float split_radius;    /* share of the cluster's radius */
uniform bool reseed;
uniform uint seed; /* of this frame */

const int TRIES = 48;       /* random texels, of which the first that will do is taken */
const int TRIES_A_RADIUS = 8; /* until the radius is halved: far-off texels can make it large */

/* Radius of the cluster in texels, as if it faced the light: no smaller than its image. */
float radius_in_texels(cluster c, int resolution)
{
    float z = rsm_to_light_frame(c.position).z;
    float texel = 2.0 * rsm_half_extent / float(resolution) * (rsm_spread.x * z + rsm_spread.y);
    float radius = sqrt(c.area * (2.0 / TAU));
    return texel > 0.0 ? min(radius / texel, float(resolution)) : 0.0;
}

/* A random texel within the radius that belongs to cluster i, lit in this frame as well, and no
 * centre; false where none was found. */
bool seed_inside(uint i, out vec2 uv)
{
    int resolution = rsm_resolution();
    vec2 centre = clusters[i].uv * float(resolution);
    float radius = split_radius * radius_in_texels(clusters[i], resolution);
    uint key = hash_u32(seed, 0x10000u + i);
    for (int t = 0; t < TRIES; t++) {
        float angle = TAU * hash_float(key, 2u * uint(t));
        float r = ldexp(radius, -(t / TRIES_A_RADIUS)) * sqrt(hash_float(key, 2u * uint(t) + 1u));
        ivec2 texel = ivec2(floor(centre + r * vec2(cos(angle), sin(angle))));
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(resolution))))
            continue;
        uvec2 entry = texelFetch(cluster_map, texel, 0).rg;
        if (entry.r == i && entry.g == NO_CLUSTER && is_lit(rsm_fetch_flux(texel))) {
            uv = (vec2(texel) + 0.5) / float(resolution);
            return true;
        }
    }
    return false;
}

void main()
{
    uint free_count = 0u, taken = 0u;
    for (int r = 0; r < selected; r++) {
        uint i = order[r];
        if (in_use(clusters[i].count) && imbalance(verifications[i]) < -merge_threshold)
            free_clusters[free_count++] = i;
    }
    merged = free_count;
    for (int r = 0; r < selected && free_count > 0u; r++) {
        uint i = order[r];
        vec2 uv;
        if (!in_use(clusters[i].count) || !(imbalance(verifications[i]) > split_threshold) ||
            !seed_inside(i, uv))
            continue;
        uint j = free_clusters[--free_count];
        clusters[j].uv = uv;
        clusters[j].count = SPLIT;
        taken++;
    }
    split = taken;
    /* Clean-up. Without re-seeding there is nowhere to go, and those clusters stay as they are. */
    for (uint f = 0u; reseed && f < free_count; f++)
        clusters[free_clusters[f]].count = VANISHED;
    if (!reseed)
        merged = taken;
}
