/* SPDX-License-Identifier: MIT
 *
 * The reflective shadow map in full precision (thesis 3.2.2, 5.1.1).
 */
#include "frame/geometry.glsl"
#include "frame/flux_in.glsl"

layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_flux;
layout(location = 3) out vec4 out_specular;

void main()
{
    vec3 from_light = world_position - light_position;
    bool directional = light_type == LIGHT_DIRECTIONAL;
    surface s = fetch_surface(directional ? -light_direction : -from_light);
    vec3 flux = flux_in(ivec2(gl_FragCoord.xy));
    out_position = vec4(s.position, 1.0);
    out_normal = vec4(s.normal,
                      directional ? dot(from_light, light_direction) : length(from_light));
    out_flux = vec4(s.diffuse * flux, (flux.r + flux.g + flux.b) / 3.0);
    out_specular = s.specular;
}
