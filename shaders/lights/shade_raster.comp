/* SPDX-License-Identifier: MIT
 *
 * Shading with rasterised shadow maps: lights/shade.glsl with VISIBILITY 3.
 */
#include "lights/raster_maps_fetch.glsl"
#include "lights/shadow_test.glsl"

/* Of the light's centre: 0 or 1. slope: texels. */
float raster_visibility(shadow_test s, int map, float slope)
{
    float len = length(s.q);
    ivec3 texel = raster_texel(map, s.q / len);
    float biased = texelFetch(raster_maps, texel, 0).r + s.offset; /* +Inf: no surface */
    vec3 w = raster_direction(texel);
    /* w.m changes at most so much over a texel, which is widest at the middle of a face */
    float plane = dot(w, s.m), change = length(s.m - plane * w) * (2.0 / float(raster_size));
    plane += slope * change;
    return biased < s.scale * len && biased * plane < s.scale ? 0.0 : 1.0;
}

#include "lights/shade.glsl"
