/* SPDX-License-Identifier: MIT
 *
 * Flux that enters an RSM texel, W: intensity times the exact solid angle, or irradiance times the
 * texel's area. The falloff is that of the texel's centre.
 */
#include "frame/light.glsl"
#include "frame/solid_angle.glsl"

uniform int resolution;
uniform float half_extent; /* spot: tan of the half angle; directional: half side of the beam, m */

float texel_side()
{
    return 2.0 * half_extent / float(resolution);
}

float texel_falloff(ivec2 texel)
{
    if (light_type == LIGHT_DIRECTIONAL)
        return 1.0;
    vec2 centre = vec2(texel) * texel_side() - half_extent + 0.5 * texel_side();
    return light_falloff(inversesqrt(dot(centre, centre) + 1.0));
}

/* Solid angle, sr, or area, m2. */
float texel_extent(ivec2 texel)
{
    float side = texel_side();
    if (light_type == LIGHT_DIRECTIONAL)
        return side * side;
    return texel_solid_angle(vec2(texel) * side - half_extent, side);
}

vec3 flux_in(ivec2 texel)
{
    return light_intensity * (texel_falloff(texel) * texel_extent(texel));
}
