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

/* Points that seeds and frames share out: as many are exact in the radical inverses. */
enum { IRB_HALTON_POINTS = 1 << 30 };

/* Index of the first of `points` (1..IRB_HALTON_POINTS) points for a seed and a frame. The sequence
 * is cut into stretches of that length, counted round. Frame 0, which is for who takes the same in
 * every frame, has the stretch of the seed's number: seeds share no points but where they differ by
 * a multiple of the number of stretches. Each further frame is a golden section of them on. Of
 * seeds that differ by d, frames take the same stretch only where they are 0.44/(d + 1) of so many
 * frames apart: multiples n of the golden section are at least 1/(sqrt(5) n) from whole numbers
 * (Hurwitz 1891). */
static inline uint32_t irb_halton_stretch(uint64_t seed, uint32_t frame, uint32_t points)
{
    const uint64_t stretches = (uint32_t)IRB_HALTON_POINTS / points;
    const uint64_t turned = frame * UINT64_C(0x9e3779b97f4a7c15); /* golden section of 2^64 */
    const uint64_t step = (turned >> 32) * stretches >> 32;
    return (uint32_t)((seed % stretches + step) % stretches) * points;
}

#endif
