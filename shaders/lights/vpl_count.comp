/* SPDX-License-Identifier: MIT
 *
 * First of three passes that put the lit candidates in order, without gaps and without atomics:
 * each invocation counts those of its run.
 */
layout(local_size_x = 64) in;
#include "lights/sample.glsl"

layout(std430, binding = 1) writeonly buffer Runs { uint runs[]; };

void main()
{
    uint run = gl_GlobalInvocationID.x, begin = run * run_length;
    if (begin >= candidates)
        return;
    uint count = 0u;
    for (uint i = begin; i < min(begin + run_length, candidates); i++)
        count += is_lit(draw(i)) ? 1u : 0u;
    runs[run] = count;
}
