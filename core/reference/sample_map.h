/* SPDX-License-Identifier: MIT
 *
 * Private to the room: maps from the unit square that keep areas, and with them the good spread of
 * low-discrepancy points.
 */
#ifndef IRB_REFERENCE_SAMPLE_MAP_H
#define IRB_REFERENCE_SAMPLE_MAP_H

#include "core/reference/vec3.h"

/* sin and cos of 2 pi t for t in [-1/2, 1/2], within 2e-7: Taylor series for half the angle (the
 * next terms are below 6e-8 and 7e-9), then doubled. The same bits with every libm, and no branch.
 */
static inline void sincos_turn(float t, float *s, float *c)
{
    float a = 3.14159265358979323846f * t, a2 = a * a;
    float half_s =
        1 +
        a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040 +
                                                   a2 * (1.0f / 362880 - a2 * (1.0f / 39916800)))));
    float half_c =
        1 + a2 * (-1.0f / 2 +
                  a2 * (1.0f / 24 +
                        a2 * (-1.0f / 720 + a2 * (1.0f / 40320 + a2 * (-1.0f / 3628800 +
                                                                       a2 * (1.0f / 479001600))))));
    half_s *= a;
    *s = 2 * half_s * half_c;
    *c = half_c * half_c - half_s * half_s;
}

/* Point of the unit disc in polar coordinates, radius sqrt(u). */
static inline void map_to_disc(float u, float v, float *x, float *y)
{
    float radius = sqrtf(u), s, c;
    sincos_turn(v - 0.5f, &s, &c);
    *x = radius * c;
    *y = radius * s;
}

/* Direction with density cos/pi about (0,0,1). */
static inline struct vec3 map_to_cosine(float u, float v)
{
    struct vec3 d;
    map_to_disc(u, v, &d.x, &d.y);
    d.z = sqrtf(1 - u);
    return d;
}

#endif
