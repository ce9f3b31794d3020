/* SPDX-License-Identifier: MIT
 *
 * The reflective shadow map in full precision (thesis 3.2.2, 5.1.1).
 */
#include "frame/geometry.glsl"
#include "frame/light.glsl"
#include "frame/solid_angle.glsl"

uniform int resolution;
uniform float half_extent; /* spot: tan of the half angle; directional: half side of the beam, m */

layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_flux;
layout(location = 3) out vec4 out_specular;

/* Flux that enters this texel, W: intensity times the exact solid angle, or irradiance times the
 * texel's area. The falloff is that of the texel's centre. */
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

void main()
{
    vec3 from_light = world_position - light_position;
    bool directional = light_type == LIGHT_DIRECTIONAL;
    surface s = fetch_surface(directional ? -light_direction : -from_light);
    vec3 flux = flux_in();
    out_position = vec4(s.position, 1.0);
    out_normal = vec4(s.normal,
                      directional ? dot(from_light, light_direction) : length(from_light));
    out_flux = vec4(s.diffuse * flux, (flux.r + flux.g + flux.b) / 3.0);
    out_specular = s.specular;
}
