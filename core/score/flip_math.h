/* SPDX-License-Identifier: MIT
 *
 * Roots and powers without branches and calls, so that a compiler can take several pixels at once.
 * Series about 1 and 0 and Halley's iteration: accurate to a few units in the last place. Private
 * to core/score.
 */
#ifndef IRB_SCORE_FLIP_MATH_H
#define IRB_SCORE_FLIP_MATH_H

#include <stdint.h>
#include <string.h>

/* A loop compiled for 4 and for 8 pixels at once, chosen when the program starts. Products and sums
 * are not contracted (-ffp-contract=off), so that both give the same bits. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__) &&   \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define IRB_FLIP_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define IRB_FLIP_WIDE
#endif

static inline int32_t irb_float_bits(float v)
{
    int32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

static inline float irb_bits_float(int32_t bits)
{
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

/* Cube root of a normal x > 0, rounded all but always to the nearest. A third of the exponent, by
 * the float's own bits, is within 4 %; a step of Halley's iteration cubes the relative error (times
 * 2/3), one of Newton's squares it. Dark colours differ by little more than rounding, so that the
 * last residual is taken in double. */
static inline float irb_cube_root(float x)
{
    const float bias = 127.0f * 8388608 * 2 / 3; /* two thirds of the exponent's bias stay */
    float y = irb_bits_float((int32_t)((float)irb_float_bits(x) * (1.0f / 3) + bias));
    float cube = y * y * y;
    y = y - y * (cube - x) / (2 * cube + x);
    double wide = y;
    float residual = (float)(wide * wide * wide - x);
    return y - residual / (3 * (y * y));
}

/* log2 of a normal x > 0: x = 2^e m with m within sqrt(2) of 1, log(m) = 2 artanh((m-1)/(m+1)). */
static inline float irb_log2(float x)
{
    const int32_t half_root = 0x3f3504f3; /* the bits of sqrt(1/2) */
    int32_t e = (irb_float_bits(x) - half_root) >> 23;
    float m = irb_bits_float((int32_t)((uint32_t)irb_float_bits(x) - ((uint32_t)e << 23)));
    float t = (m - 1) / (m + 1), s = t * t;
    float series = s * (1.0f / 3 + s * (1.0f / 5 + s * (1.0f / 7 + s * (1.0f / 9))));
    return (float)e + 2.88539008f * (t + t * series); /* 2/ln 2 */
}

/* 2^y for y in [-126, 0], smaller y as -126; the exponential series to the seventh power. */
static inline float irb_exp2_negative(float y)
{
    y = y < -126 ? -126 : y;
    int32_t n = (int32_t)(y - 0.5f); /* the nearest */
    float z = (y - (float)n) * 0.69314718f;
    float series = 1.0f / 24 + z * (1.0f / 120 + z * (1.0f / 720 + z * (1.0f / 5040)));
    series = 1 + z * (1 + z * (0.5f + z * (1.0f / 6 + z * series)));
    return series * irb_bits_float((n + 127) << 23);
}

/* x^y for x in [0,1] and y in [0,1]; 0^0 = 1. */
static inline float irb_unit_power(float x, float y)
{
    float power = irb_exp2_negative(y * irb_log2(x));
    float at_zero = y > 0 ? 0 : 1;
    return x > 0 ? power : at_zero;
}

#endif
