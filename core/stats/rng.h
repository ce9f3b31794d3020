/* SPDX-License-Identifier: MIT
 *
 * Random numbers by counter: number i of a stream is a hash of both, so that no state is kept and
 * the same call gives the same bits whatever was drawn before.
 */
#ifndef IRB_STATS_RNG_H
#define IRB_STATS_RNG_H

#include <math.h>
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

/* Uniform in (0,1). */
static inline double irb_rng_uniform(uint64_t seed, uint64_t counter)
{
    return ((double)(irb_rng_bits(seed, counter) >> 11) + 0.5) * 0x1p-53;
}

/* Uniform in 0..count-1; count > 0. */
static inline int irb_rng_below(uint64_t seed, uint64_t counter, int count)
{
    return (int)((irb_rng_bits(seed, counter) >> 32) * (uint64_t)count >> 32);
}

/* Standard normal (Box and Muller 1958). Takes the uniforms 2*counter and 2*counter + 1. */
static inline double irb_rng_normal(uint64_t seed, uint64_t counter)
{
    double radius = sqrt(-2 * log(irb_rng_uniform(seed, 2 * counter)));
    return radius * cos(2 * 3.14159265358979323846 * irb_rng_uniform(seed, 2 * counter + 1));
}

#endif
