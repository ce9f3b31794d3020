/* SPDX-License-Identifier: MIT
 *
 * Scene geometry in the frames of many virtual lights: one instance a light.
 */
#include "lights/paraboloid.glsl"
#include "lights/virtual_light.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 2) in vec2 in_texcoord;

uniform mat4 model;      /* rest -> current position */
uniform int first_light; /* of instance 0, in the block */
uniform int first_map;   /* of instance 0 */
const int BLOCK = 1024;  /* lights in a block: IRB_VPL_BLOCK */
layout(std140, binding = 0) uniform Block { vec4 lights[VPL_VECTORS * BLOCK]; };

out vec3 in_light; /* position in the light's frame, m */
flat out int map;
#ifdef ALPHA_MASK
out vec2 vertex_texcoord;
#endif

void main()
{
    int light = VPL_VECTORS * (first_light + gl_InstanceID);
    vec3 world = (model * vec4(in_position, 1.0)).xyz;
    in_light = (world - lights[light].xyz) * light_frame(lights[light + 1].xyz);
    map = first_map + gl_InstanceID;
#ifdef ALPHA_MASK
    vertex_texcoord = in_texcoord;
#endif
}
