/* SPDX-License-Identifier: MIT
 *
 * Where the maps of core/lights/raster_maps.h hold which direction of the light's frame
 * (lights/paraboloid.glsl), for those who draw them and those who read them.
 *
 * Hemicube: three squares, each a central projection onto a plane. Face 0: z = 1, (u, v) = (x, y)/z.
 * Face 1: x = 1, (u, v) = (y, z)/x. Face 2: y = 1, (u, v) = (x, z)/y. Since z >= 0, a side face has
 * the directions towards its plane where v > 0 and those away from it where v < 0: the hemicube's
 * four half faces fill two squares.
 *
 * Paraboloid: one square, (u, v) = (x, y)/(1 + z).
 *
 * In both, (u, v) in [-1,1]^2 is spread over the texels, row 0 at v = -1.
 */

/* Nothing to be seen. */
const float RASTER_EMPTY = uintBitsToFloat(0x7f800000u); /* +Inf */

/* (u, v) at texel coordinates. */
vec2 raster_uv(vec2 at, int size)
{
    return (2.0 * at) / float(size) - 1.0;
}

/* Not normalised: the component that (u, v) is divided by is 1 or -1. */
vec3 hemicube_direction(int face, vec2 uv)
{
    float side = uv.y < 0.0 ? -1.0 : 1.0;
    return face == 0 ? vec3(uv, 1.0) : side * (face == 1 ? vec3(1.0, uv) : vec3(uv.x, 1.0, uv.y));
}

/* Texels whose centres lie beyond the horizon, or less than half a texel from it, hold what is seen
 * half a texel above it instead: there the light's own plane does not show. Others are not moved. */
vec2 paraboloid_above_horizon(vec2 uv, int size)
{
    float r = length(uv), rim = 1.0 - 1.0 / float(size);
    return r > rim ? uv * (rim / r) : uv;
}
