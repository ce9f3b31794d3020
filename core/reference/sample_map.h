/* SPDX-License-Identifier: MIT
 *
 * Private to the room: maps from the unit square that keep areas, and with them the good spread of
 * low-discrepancy points.
 */
#ifndef IRB_REFERENCE_SAMPLE_MAP_H
#define IRB_REFERENCE_SAMPLE_MAP_H

#include "core/reference/vec3.h"

/* sin and cos on [-pi/4, pi/4] by their Taylor series: the next terms are below 2e-9 and 3e-8. The
 * same bits with every libm, and a fraction of its time. */
static inline void small_sincos(float a, float *s, float *c)
{
    float a2 = a * a;
    *s = a * (1 + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040 + a2 / 362880))));
    *c = 1 + a2 * (-0.5f + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 / 40320)));
}

/* Concentric map to the unit disc (Shirley and Chiu 1997). */
static inline void map_to_disc(float u, float v, float *x, float *y)
{
    const float quarter_pi = 0.78539816339744830962f;
    float a = 2 * u - 1, b = 2 * v - 1, s, c;
    if (fabsf(a) > fabsf(b)) {
        small_sincos(quarter_pi * (b / a), &s, &c);
        *x = a * c;
        *y = a * s;
    } else if (b != 0) {
        small_sincos(quarter_pi * (a / b), &s, &c);
        *x = b * s;
        *y = b * c;
    } else {
        *x = *y = 0;
    }
}

/* Direction about the unit vector n with density cos/pi; returns the cosine. */
static inline float map_to_cosine(float u, float v, struct vec3 n, struct vec3 *direction)
{
    float x, y;
    map_to_disc(u, v, &x, &y);
    float z = sqrtf(fmaxf(0, 1 - x * x - y * y));
    struct vec3 s, t;
    v3_basis(n, &s, &t);
    *direction = v3_mad(v3_mad(v3_scale(n, z), x, s), y, t);
    return z;
}

#endif
