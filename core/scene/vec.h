/* SPDX-License-Identifier: MIT
 *
 * The few 3-vector operations of this folder, in double: scenes are read once and rounded to float
 * once, at the end (cglm is single precision).
 */
#ifndef IRB_SCENE_VEC_H
#define IRB_SCENE_VEC_H

#include <math.h>
#include <stdbool.h>

static inline void vec_from_float(const float in[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = in[i];
}

static inline void vec_to_float(const double in[3], float out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)in[i];
}

static inline void vec_sub(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static inline double vec_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double vec_length(const double a[3])
{
    return sqrt(vec_dot(a, a));
}

/* `out` must not be `a` or `b`. */
static inline void vec_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* False, and left as it is, when the length is zero or not finite. */
static inline bool vec_normalize(double a[3])
{
    double length = vec_length(a);

    if (!(length > 0) || !isfinite(length))
        return false;
    for (int i = 0; i < 3; i++)
        a[i] /= length;
    return true;
}

/* (b - a) x (c - a): twice the triangle's area, along its normal. */
static inline void vec_triangle_cross(const double a[3], const double b[3], const double c[3],
                                      double out[3])
{
    double ab[3], ac[3];

    vec_sub(b, a, ab);
    vec_sub(c, a, ac);
    vec_cross(ab, ac, out);
}

#endif
