/* SPDX-License-Identifier: MIT
 *
 * Scene geometry for the camera's G-buffer and the RSM alike.
 */
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec2 in_texcoord;

uniform mat4 model;         /* the object's transform */
uniform mat4 normal_matrix; /* cofactors of model's upper 3x3 */
uniform mat4 view_projection;

out vec3 world_position;
out vec3 world_normal;
out vec2 texcoord;

void main()
{
    vec4 world = model * vec4(in_position, 1.0);
    world_position = world.xyz;
    world_normal = mat3(normal_matrix) * in_normal;
    texcoord = in_texcoord;
    gl_Position = view_projection * world;
}
