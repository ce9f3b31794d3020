/* SPDX-License-Identifier: MIT
 *
 * The flagged pixels in order, without gaps and without atomics. PASS 0: each invocation counts
 * those of its run; 1: one invocation sums over the runs and sets the indirect dispatch; 2: each
 * writes those of its run.
 */
#if PASS == 1
layout(local_size_x = 1) in;
#else
layout(local_size_x = 64) in;
#endif

uniform uint pixels, width;
uniform uint run_length, run_count;
uniform uint group_pixels; /* that a work group of the gather takes from the list */

layout(std430, binding = 0) readonly buffer Flags { uint flags[]; };
layout(std430, binding = 1) buffer List { uint list[]; }; /* x | y << 16 */
layout(std430, binding = 2) buffer Work { uvec3 groups; uint listed; uint covered; };
layout(std430, binding = 3) buffer Runs { uvec2 runs[]; }; /* to re-evaluate; covered */

const uint REEVALUATE = 2u;

void main()
{
#if PASS == 1
    uvec2 sum = uvec2(0u);
    for (uint run = 0u; run < run_count; run++) {
        uvec2 count = runs[run];
        runs[run] = sum;
        sum += count;
    }
    groups = uvec3((sum.x + group_pixels - 1u) / group_pixels, 1u, 1u);
    listed = sum.x;
    covered = sum.y;
#else
    uint run = gl_GlobalInvocationID.x, begin = run * run_length;
    if (run >= run_count)
        return;
    uint end = min(begin + run_length, pixels);
#if PASS == 0
    uvec2 count = uvec2(0u);
    for (uint i = begin; i < end; i++)
        count += uvec2(flags[i] >> 1, flags[i] & 1u);
    runs[run] = count;
#else
    uint slot = runs[run].x;
    for (uint i = begin; i < end; i++)
        if ((flags[i] & REEVALUATE) != 0u)
            list[slot++] = (i % width) | ((i / width) << 16);
#endif
#endif
}
