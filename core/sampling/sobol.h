/* SPDX-License-Identifier: MIT
 *
 * Owen-scrambled Sobol points, two dimensions a set. Sets for further dimensions are padded: each
 * has seeds of its own, so that sets are decorrelated and every one of them is a (0,2)-sequence.
 *
 * Nested uniform scrambling (Owen 1995) is done by a hash on the mirrored bits in which a bit is
 * changed only by bits below it (Laine and Karras 2011, "Stratified sampling for stochastic
 * transparency"); the order of the points is shuffled by the same scrambling of the index (Burley
 * 2020, "Practical hash-based Owen scrambling", JCGT 9(4), sections 3 and 4).
 *
 * The first 2^k points of a set, and every following aligned block of 2^k, are a (0,k,2)-net: each
 * elementary interval of area 2^-k holds exactly one of them. Samples are therefore best added in
 * powers of two.
 */
#ifndef IRB_SAMPLING_SOBOL_H
#define IRB_SAMPLING_SOBOL_H

#include <stdint.h>

/* Seeds of one set; any three numbers without a pattern (irb_sobol_seed makes them). */
struct irb_sobol_set {
    uint32_t shuffle, x, y;
};

/* Mirrors the 32 bits. */
static inline uint32_t irb_reverse_bits(uint32_t v)
{
    v = __builtin_bswap32(v);
    v = (v >> 4 & 0x0f0f0f0fu) | (v & 0x0f0f0f0fu) << 4;
    v = (v >> 2 & 0x33333333u) | (v & 0x33333333u) << 2;
    return (v >> 1 & 0x55555555u) | (v & 0x55555555u) << 1;
}

/* Laine-Karras permutation. A product with an even number moves every bit up, so a bit depends on
 * lower bits only; the multipliers are those of Laine and Karras, section 3.1. */
static inline uint32_t irb_laine_karras(uint32_t v, uint32_t seed)
{
    v += seed;
    v ^= v * 0x6c50b47cu;
    v ^= v * 0xb82f1e52u;
    v ^= v * 0xc7afe638u;
    return v ^ v * 0x8d22f6e6u;
}

/* The index times Sobol's second generator matrix, mirrored: the Pascal triangle modulo 2, which
 * is the 5-fold Kronecker power of (1 1; 0 1), hence five steps instead of 32. */
static inline uint32_t irb_sobol_pascal(uint32_t index)
{
    index ^= index >> 16;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xccccccccu) >> 2;
    return index ^ (index & 0xaaaaaaaau) >> 1;
}

/* Upper 24 bits as a float in [0,1). */
static inline float irb_unit_float(uint32_t bits)
{
    return (float)(int32_t)(bits >> 8) * 0x1p-24f;
}

/* A well mixed 32-bit hash of (seed, number): two rounds of xor-shift and odd multiplication, with
 * the finaliser constants of MurmurHash3 (Appleby 2011). */
static inline uint32_t irb_hash_u32(uint32_t seed, uint32_t number)
{
    uint32_t h = seed ^ (number * 0x9e3779b9u + 0x7f4a7c15u);
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ h >> 16;
}

/* Seeds of set number `set` of the sequence that `seed` (of a pixel, say) stands for. */
static inline struct irb_sobol_set irb_sobol_seed(uint64_t seed, uint32_t set)
{
    uint32_t low = (uint32_t)seed, high = (uint32_t)(seed >> 32);
    return (struct irb_sobol_set){
        .shuffle = irb_hash_u32(low, 3 * set),
        .x = irb_hash_u32(high, 3 * set + 1),
        .y = irb_hash_u32(low ^ irb_hash_u32(high, set), 3 * set + 2),
    };
}

/* Both coordinates as 32-bit fractions, from the index's mirrored bits (which a caller with several
 * sets computes once). */
static inline void irb_sobol_2d_bits(const struct irb_sobol_set *set, uint32_t mirrored,
                                     uint32_t *x, uint32_t *y)
{
    uint32_t index = irb_reverse_bits(irb_laine_karras(mirrored, set->shuffle));
    *x = irb_reverse_bits(irb_laine_karras(index, set->x));
    *y = irb_reverse_bits(irb_laine_karras(irb_sobol_pascal(index), set->y));
}

/* Point `index` of the set; both coordinates in [0,1). */
static inline void irb_sobol_2d(const struct irb_sobol_set *set, uint32_t index, float *x, float *y)
{
    uint32_t bits_x, bits_y;
    irb_sobol_2d_bits(set, irb_reverse_bits(index), &bits_x, &bits_y);
    *x = irb_unit_float(bits_x);
    *y = irb_unit_float(bits_y);
}

#endif
