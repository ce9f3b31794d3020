/* SPDX-License-Identifier: MIT
 *
 * Random numbers by counter: number i of a stream is a hash of both, so that no state is kept and
 * the same call gives the same bits whatever was drawn before.
 */
#ifndef IRB_STATS_RNG_H
#define IRB_STATS_RNG_H

#include <stdint.h>

/* 64 bits: SplitMix64 (Steele, Lea and Flood 2014) at position `counter` of stream `seed`. */
static inline uint64_t irb_rng_bits(uint64_t seed, uint64_t counter)
{
    uint64_t v = (seed * UINT64_C(0xd1342543de82ef95)) ^ (counter * UINT64_C(0x9e3779b97f4a7c15));
    v += UINT64_C(0x9e3779b97f4a7c15);
    v = (v ^ v >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    v = (v ^ v >> 27) * UINT64_C(0x94d049bb133111eb);
    return v ^ v >> 31;
}

/* Uniform in 0..count-1; count > 0. */
static inline int irb_rng_below(uint64_t seed, uint64_t counter, int count)
{
    return (int)((irb_rng_bits(seed, counter) >> 32) * (uint64_t)count >> 32);
}

/* Mean 0 and variance 1, the sum of four uniforms: a cubic B-spline in the place of the normal
 * density, within 3.46 and with a kurtosis of 2.7. Whole numbers but for the last step, so that
 * it has the same bits on every machine. */
static inline double irb_rng_bell(uint64_t seed, uint64_t counter)
{
    const uint64_t bits = irb_rng_bits(seed, counter);
    const int64_t sum =
        (int64_t)((bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) + (bits >> 48)) -
        2 * 0xffff;
    return (double)sum * 0x1.bb67ae8584caap-16; /* sqrt(3)/65536 */
}

#endif
