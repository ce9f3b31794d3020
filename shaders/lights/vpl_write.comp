/* SPDX-License-Identifier: MIT
 *
 * Third pass: each invocation writes the lit candidates of its run, in order.
 */
layout(local_size_x = 64) in;
#include "lights/sample.glsl"
#include "lights/virtual_light.glsl"

layout(std430, binding = 1) readonly buffer Runs { uint runs[]; };
layout(std430, binding = 0) writeonly buffer Lights { vec4 lights[]; };

uniform float normal_offset; /* m, against the normal */

void main()
{
    uint run = gl_GlobalInvocationID.x, begin = run * run_length;
    if (begin >= candidates)
        return;
    uint slot = runs[run];
    for (uint i = begin; i < min(begin + run_length, candidates); i++) {
        candidate c = draw(i);
        if (!is_lit(c))
            continue;
        vec3 normal = rsm_fetch_normal(c.texel);
        vec3 position = rsm_fetch_position(c.texel).xyz - normal_offset * normal;
        lights[VPL_VECTORS * slot] = vec4(position, 0.0);
        lights[VPL_VECTORS * slot + 1] = vec4(normal, 0.0);
        lights[VPL_VECTORS * slot + 2] = vec4(c.flux, 0.0);
        slot++;
    }
}
