/* SPDX-License-Identifier: MIT
 *
 * Start of a frame's clustering (Prutkin et al. 2012, algorithm 1, lines 1 and 5 to 12): clusters go
 * on from the last frame; those without texels are placed anew, on the texel under their Halton
 * point warped by importance. A cluster whose centre has left the light's image is as good as empty:
 * the mean of texels lies within it.
 *
 * Each cluster's key for the grid: its cell, its number.
 */
layout(local_size_x = 64) in;
#include "frame/rsm_fetch.glsl"
#include "lights/warp.glsl"
#include "methods/rsm_clustering/cluster.glsl"
#include "methods/rsm_clustering/keys.glsl"

uniform uint cluster_count;
uniform uint kept_count; /* clusters that have a last frame */
uniform uint first;      /* index of the Halton point of cluster 0 */
uniform int cells;       /* of the grid, a side */

/* Where the light's image shows a point; [0,1)^2 within it. */
vec2 place_in_image(vec3 world)
{
    vec3 p = rsm_to_light_frame(world);
    float depth = rsm_spread.x * p.z + rsm_spread.y;
    return depth > 0.0 ? p.xy / (rsm_half_extent * depth) * 0.5 + 0.5 : vec2(-1.0);
}

bool is_inside(vec2 place)
{
    return all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(1.0)));
}

/* Not inside where no texel is lit. */
cluster seed(uint id, out vec2 place)
{
    float probability;
    ivec2 texel = warp(halton(first + id), probability);
    bool found = probability > 0.0;
    place = found ? (vec2(texel) + 0.5) / float(rsm_resolution()) : vec2(-1.0);
    return cluster(rsm_fetch_position(texel).xyz, 0.0, rsm_fetch_normal(texel), 0.0,
                   rsm_fetch_flux(texel), 0.0, ivec2(-1), found);
}

void main()
{
    uint id = gl_GlobalInvocationID.x;
    if (id >= cluster_count)
        return;
    cluster c = load_cluster(id);
    c.seeded = false;
    vec2 place = place_in_image(c.centre);
    if (id >= kept_count || !(c.texels > 0.0) || !is_inside(place))
        c = seed(id, place);
    bool takes_part = is_inside(place);
    c.cell = takes_part ? min(ivec2(place * float(cells)), cells - 1) : ivec2(-1);
    keys[id] = takes_part ? uint(c.cell.y * cells + c.cell.x) << CLUSTER_BITS | id : NO_KEY;
    store_cluster(id, c);
}
