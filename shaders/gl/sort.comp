/* SPDX-License-Identifier: MIT
 *
 * Bitonic sorting network (Batcher 1968) over unsigned keys, ascending. A step of width j in a
 * merge of length k compares the keys i and i + j, i without bit j, and puts the smaller one first
 * where i lacks bit k.
 *
 * PASS 0: sorts each block by itself, all merges up to its length; 1: the steps below a block's
 * length of one merge, in shared memory; 2: one step of a longer width.
 */
#define GROUP 256
layout(local_size_x = GROUP) in;

layout(std430, binding = 0) buffer Keys { uint keys[]; };

uniform uint count;  /* PASS 0: what follows is padding, which comes last */
uniform uint block;  /* keys that a group sorts, a power of two, at most BITONIC_BLOCK */
uniform uint merge;  /* k */
uniform uint width;  /* j of PASS 2 */

void order(inout uint low, inout uint high, bool ascending)
{
    uint small = min(low, high), large = max(low, high);
    low = ascending ? small : large;
    high = ascending ? large : small;
}

/* The pair-th index that lacks bit j. */
uint first_of(uint pair, uint j)
{
    return 2u * pair - (pair & (j - 1u));
}

#if PASS == 2
void main()
{
    uint i = first_of(gl_GlobalInvocationID.x, width);
    uint low = keys[i], high = keys[i + width];
    order(low, high, (i & merge) == 0u);
    keys[i] = low;
    keys[i + width] = high;
}
#else
shared uint held[BITONIC_BLOCK];

void step_of(uint first, uint j, uint k)
{
    for (uint pair = gl_LocalInvocationID.x; pair < block / 2u; pair += uint(GROUP)) {
        uint i = first_of(pair, j);
        uint low = held[i], high = held[i + j];
        order(low, high, ((first + i) & k) == 0u);
        held[i] = low;
        held[i + j] = high;
    }
    barrier();
}

void main()
{
    uint first = gl_WorkGroupID.x * block;
    for (uint i = gl_LocalInvocationID.x; i < block; i += uint(GROUP))
#if PASS == 0
        held[i] = first + i < count ? keys[first + i] : 0xffffffffu;
#else
        held[i] = keys[first + i];
#endif
    barrier();
#if PASS == 0
    for (uint k = 2u; k <= block; k *= 2u)
        for (uint j = k / 2u; j > 0u; j /= 2u)
            step_of(first, j, k);
#else
    for (uint j = block / 2u; j > 0u; j /= 2u)
        step_of(first, j, merge);
#endif
    for (uint i = gl_LocalInvocationID.x; i < block; i += uint(GROUP))
        keys[first + i] = held[i];
}
#endif
