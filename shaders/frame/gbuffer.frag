/* SPDX-License-Identifier: MIT
 *
 * The camera's G-buffer in full precision (thesis 5.1.1 without its packing).
 */
#include "frame/geometry.glsl"

uniform vec3 camera_position;

layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_geometric;
layout(location = 3) out vec4 out_diffuse;
layout(location = 4) out vec4 out_specular;

void main()
{
    vec3 to_camera = camera_position - world_position;
    surface s = fetch_surface(to_camera);
    out_position = vec4(s.position, 1.0);
    out_normal = vec4(s.normal, length(to_camera));
    out_geometric = vec4(s.geometric, 0.0);
    out_diffuse = vec4(s.diffuse, 0.0);
    out_specular = s.specular;
}
