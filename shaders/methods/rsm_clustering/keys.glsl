/* SPDX-License-Identifier: MIT
 *
 * Sorted keys (core/gl/sort.h): what is sorted by in the high bits, who it is in the low ones;
 * NO_KEY, which comes last, where there is nothing.
 */
layout(std430, binding = 1) buffer Keys { uint keys[]; };

const uint NO_KEY = 0xffffffffu;

/* Index of the first of `count` sorted keys that is not below `key`. */
uint lower_bound(uint count, uint key)
{
    uint low = 0u, high = count;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (keys[middle] < key)
            low = middle + 1u;
        else
            high = middle;
    }
    return low;
}
