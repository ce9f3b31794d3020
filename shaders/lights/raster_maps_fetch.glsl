/* SPDX-License-Identifier: MIT
 *
 * Distances from rasterised shadow maps (core/lights/raster_maps.h). The uniforms are set by
 * irb_raster_maps_bind(), RASTER_PROJECTION (0 hemicube, 1 paraboloid) by irb_raster_define().
 */
#include "lights/paraboloid.glsl"
#include "lights/raster_charts.glsl"

uniform sampler2DArray raster_maps; /* R32F: m */
uniform int raster_size;            /* texels a side */

/* The texel and layer that hold a direction in the light's frame; d.z < 0 is taken for the horizon.
 * The component of largest magnitude must not be 0. */
ivec3 raster_texel(int map, vec3 d)
{
    d.z = max(d.z, 0.0);
    ivec2 low = ivec2(0), high = ivec2(raster_size - 1);
#if RASTER_PROJECTION == 0
    bool top = d.z >= max(abs(d.x), abs(d.y)), on_x = abs(d.x) >= abs(d.y);
    float w = top ? d.z : on_x ? d.x : d.y;
    vec2 uv = (top ? d.xy : on_x ? d.yz : d.xz) / w;
    int face = top ? 0 : on_x ? 1 : 2, middle = raster_size / 2;
    /* never across the horizon, where the other side begins */
    low.y = !top && w > 0.0 ? middle : low.y;
    high.y = !top && w < 0.0 ? middle - 1 : high.y;
    int layer = 3 * map + face;
#else
    vec2 uv = paraboloid(d);
    int layer = map;
#endif
    ivec2 at = ivec2(floor((0.5 * uv + 0.5) * float(raster_size)));
    return ivec3(clamp(at, low, high), layer);
}

/* The unit direction whose distance a texel holds. */
vec3 raster_direction(ivec3 texel)
{
    vec2 uv = raster_uv(vec2(texel.xy) + 0.5, raster_size);
#if RASTER_PROJECTION == 0
    return normalize(hemicube_direction(texel.z % 3, uv));
#else
    return paraboloid_direction(paraboloid_above_horizon(uv, raster_size));
#endif
}

/* Euclidean distance from light `map` to the surface in the unit direction d of its frame, d.z >= 0,
 * m; +Inf where there is none. Of the nearest texel. */
float raster_distance(int map, vec3 d)
{
    return texelFetch(raster_maps, raster_texel(map, d), 0).r;
}
