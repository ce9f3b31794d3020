/* SPDX-License-Identifier: MIT
 *
 * The VPLs of the order as points on the RSM, in a colour for each VAL's number: hues a golden ratio
 * apart.
 */
#include "lights/virtual_light.glsl"

layout(std430, binding = 4) readonly buffer Ordered { vec4 ordered[]; };
uniform mat4 view_projection; /* world -> RSM, depth 1..0 */
flat out vec3 colour;

void main()
{
    int val = int(ordered[VPL_VECTORS * gl_VertexID + 1].w);
    float hue = fract(float(val) * 0.61803398875);
    vec3 rgb = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    colour = mix(vec3(1.0), rgb, 0.8);
    gl_Position = view_projection * vec4(ordered[VPL_VECTORS * gl_VertexID].xyz, 1.0);
    gl_Position.z = 0.0; /* depth plays no part */
}
