/* SPDX-License-Identifier: MIT
 *
 * The camera's G-buffer in the thesis's slim layout (table 5.1a); read by gbuffer_fetch.glsl.
 */
#include "frame/geometry.glsl"
#include "frame/slim.glsl"
#include "frame/spheremap.glsl"

uniform vec3 camera_position;
uniform vec3 view_right, view_up, view_back; /* world -> view space: its rows */

layout(location = 0) out vec4 out_diffuse;
layout(location = 1) out vec4 out_specular;
layout(location = 2) out vec2 out_normal;

void main()
{
    surface s = fetch_surface(camera_position - world_position);
    vec3 n = vec3(dot(s.normal, view_right), dot(s.normal, view_up), dot(s.normal, view_back));
    out_diffuse = vec4(s.diffuse, 0.0);
    out_specular = encode_specular(s.specular);
    out_normal = spheremap_to_unorm(encode_spheremap(n));
}
