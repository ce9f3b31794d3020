/* SPDX-License-Identifier: MIT
 *
 * A hash of two numbers, as irb_hash_u32() of core/sampling/sobol.h (finaliser of MurmurHash3).
 */
uint hash_u32(uint seed, uint number)
{
    uint h = seed ^ (number * 0x9e3779b9u + 0x7f4a7c15u);
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ h >> 16;
}

/* In [0,1). */
float hash_float(uint seed, uint number)
{
    return float(hash_u32(seed, number) >> 8) * (1.0 / 16777216.0);
}
