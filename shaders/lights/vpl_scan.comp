/* SPDX-License-Identifier: MIT
 *
 * Second pass: exclusive prefix sum over the runs (about sqrt(N) of them, so one invocation does),
 * and the number of lights.
 */
layout(local_size_x = 1) in;

uniform uint run_count;
layout(std430, binding = 1) buffer Runs { uint runs[]; };
layout(std430, binding = 3) writeonly buffer Counter { uint light_count; };

void main()
{
    uint sum = 0u;
    for (uint run = 0u; run < run_count; run++) {
        uint count = runs[run];
        runs[run] = sum;
        sum += count;
    }
    light_count = sum;
}
