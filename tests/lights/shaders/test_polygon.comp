/* SPDX-License-Identifier: MIT
 *
 * Form factors of polygons with 8 corners, one an invocation.
 */
layout(local_size_x = 64) in;
#include "lights/polygon_form_factor.glsl"

/* receiver's position; 0 | its normal; 0 | 8 corners; 0 */
layout(std430, binding = 0) readonly buffer Cases { vec4 cases[]; };
layout(std430, binding = 1) writeonly buffer Factors { float factors[]; };
uniform uint count;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    vec3 x = cases[10u * i].xyz, n = cases[10u * i + 1u].xyz;
    polygon_sum s = polygon_begin();
    for (uint k = 0u; k < 8u; k++)
        polygon_edge(s, n, cases[10u * i + 2u + k].xyz - x,
                     cases[10u * i + 2u + (k + 1u) % 8u].xyz - x);
    factors[i] = polygon_end(s, n);
}
