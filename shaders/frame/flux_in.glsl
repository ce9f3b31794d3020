/* SPDX-License-Identifier: MIT
 *
 * Flux that enters the RSM texel of this fragment, W: intensity times the exact solid angle, or
 * irradiance times the texel's area. The falloff is that of the texel's centre.
 */
#include "frame/light.glsl"
#include "frame/solid_angle.glsl"

uniform int resolution;
uniform float half_extent; /* spot: tan of the half angle; directional: half side of the beam, m */

vec3 flux_in()
{
    float side = 2.0 * half_extent / float(resolution);
    if (light_type == LIGHT_DIRECTIONAL)
        return light_intensity * (side * side);
    vec2 corner = floor(gl_FragCoord.xy) * side - half_extent;
    vec2 centre = corner + 0.5 * side;
    float cos_theta = inversesqrt(dot(centre, centre) + 1.0);
    return light_intensity * (light_falloff(cos_theta) * texel_solid_angle(corner, side));
}
