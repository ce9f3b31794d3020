/* SPDX-License-Identifier: MIT
 *
 * Seeding and importance warping (thesis 4.4, 4.5, 5.3.1): the clusters on the re-seed list and
 * those that a split has placed get the attributes of the texel they stand on.
 */
layout(local_size_x = 64) in;

#include "frame/rsm_fetch.glsl"
#include "lights/warp.glsl"
#include "methods/acrsm/cluster.glsl"
#include "methods/acrsm/lists.glsl"
#include "sampling/halton.glsl"

layout(std430, binding = 0) buffer Clusters { cluster clusters[CLUSTERS_MOST]; };

uniform sampler2D importance;
uniform int active_count;
uniform bool reseed;
uniform int levels; /* of the pyramid that the warp descends */
uniform uint first; /* Halton point of seed number 0 */

/* The warped point of seed n. A warp that ends at a coarse level may leave a point on a texel
 * without light: it then goes to the end. */
vec2 warped(uint n)
{
    vec2 point = halton(first + n), uv = warp_levels(point, levels);
    if (!is_lit(rsm_fetch_flux(texel_at(uv, rsm_resolution()))))
        uv = warp_levels(point, pyramid_levels - 1);
    return uv;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(active_count))
        return;
    int count = clusters[i].count;
    if (count != SPLIT && count != UNBORN && !(reseed && count == VANISHED))
        return;
    vec2 uv = count == SPLIT ? clusters[i].uv : warped(seed_number[i]);
    ivec2 texel = texel_at(uv, rsm_resolution());
    vec3 flux = rsm_fetch_flux(texel);
    if (!is_lit(flux))
        return; /* its turn comes again in the next frame */
    clusters[i].position = rsm_fetch_position(texel).xyz;
    clusters[i].normal = rsm_fetch_normal(texel);
    clusters[i].importance = texelFetch(importance, texel, 0).r;
    clusters[i].uv = uv;
    clusters[i].flux = flux;
    clusters[i].centre_flux = flux;
    clusters[i].area = 0.0;
    clusters[i].irradiance = 0.0;
    clusters[i].count = PLACED;
}
