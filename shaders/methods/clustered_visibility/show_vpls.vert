/* SPDX-License-Identifier: MIT
 *
 * The VPLs of the order as points on the RSM, in a colour for each VAL's number.
 */
#include "lights/hues.glsl"
#include "lights/virtual_light.glsl"

layout(std430, binding = 4) readonly buffer Ordered { vec4 ordered[]; };
uniform mat4 view_projection; /* world -> RSM, depth 1..0 */
flat out vec3 colour;

void main()
{
    int val = int(ordered[VPL_VECTORS * gl_VertexID + 1].w);
    colour = hue_of(val, 0.8);
    gl_Position = view_projection * vec4(ordered[VPL_VECTORS * gl_VertexID].xyz, 1.0);
    gl_Position.z = 0.0; /* depth plays no part */
}
