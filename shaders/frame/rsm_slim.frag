/* SPDX-License-Identifier: MIT
 *
 * The reflective shadow map in the thesis's slim layout (table 5.1b); read by rsm_fetch.glsl. The
 * flux is stored in units of flux_scale, the most that any texel of albedo 1 can reflect, since
 * cos(theta)/cos(omega_s) exceeds 1 on the axis. k_s and the power take the 32 bits of the thesis's
 * importance map, from which a method computes it.
 */
#include "frame/geometry.glsl"
#include "frame/flux_in.glsl"
#include "frame/slim.glsl"
#include "frame/spheremap.glsl"

uniform vec3 flux_scale; /* W; 0 where the light has none of that colour */

layout(location = 0) out vec4 out_flux;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec2 out_normal;

void main()
{
    bool directional = light_type == LIGHT_DIRECTIONAL;
    surface s = fetch_surface(directional ? -light_direction : light_position - world_position);
    vec3 flux = s.diffuse * flux_in(ivec2(gl_FragCoord.xy));
    vec3 n = vec3(dot(s.normal, light_right), dot(s.normal, light_up),
                  -dot(s.normal, light_direction));
    out_flux.r = flux_scale.r > 0.0 ? flux.r / flux_scale.r : 0.0;
    out_flux.g = flux_scale.g > 0.0 ? flux.g / flux_scale.g : 0.0;
    out_flux.b = flux_scale.b > 0.0 ? flux.b / flux_scale.b : 0.0;
    out_flux.a = 0.0;
    out_specular = encode_specular(s.specular);
    out_normal = spheremap_to_unorm(encode_spheremap(n));
}
