/* SPDX-License-Identifier: MIT
 *
 * The Halton sequence (Halton 1960): radical inverses of the sample's index in the first primes.
 * A prefix of any length is well spread, so a caller may add samples without starting again.
 *
 * Does not: scramble. Two dimensions need none; more than a few would correlate.
 */
#ifndef IRB_SAMPLING_HALTON_H
#define IRB_SAMPLING_HALTON_H

#include <stdint.h>

/* The digits of `index` in `base` (>= 2), mirrored at the radix point; in [0,1). */
static inline double irb_radical_inverse(unsigned base, uint32_t index)
{
    /* Exact integers until the end: digits < 2^33 over base^n <= base * 2^32. */
    uint64_t mirrored = 0, scale = 1;
    for (; index; index /= base) {
        mirrored = mirrored * base + index % base;
        scale *= base;
    }
    return (double)mirrored / (double)scale;
}

/* Point `index` of the sequence in bases 2 and 3. Point 0 is the origin; callers that would
 * rather not have it start at 1. */
static inline void irb_halton_2d(uint32_t index, float point[2])
{
    static const double below_one = 0x1.fffffep-1; /* largest float below 1 */
    for (int i = 0; i < 2; i++) {
        double u = irb_radical_inverse(2u + (unsigned)i, index);
        point[i] = (float)(u < below_one ? u : below_one);
    }
}

#endif
