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

/* Of a column-major 4x4 matrix the 3x3 that normals go by, column-major: the inverse transpose
 * times the determinant's absolute value. Needs no division, so that flat scalings (determinant 0)
 * still give normals. Returns whether the matrix mirrors. */
static inline bool vec_normal_matrix(const double m[16], double out[9])
{
    const double *x = m, *y = m + 4, *z = m + 8;
    bool mirrored;

    vec_cross(y, z, out);
    vec_cross(z, x, out + 3);
    vec_cross(x, y, out + 6);
    mirrored = vec_dot(x, out) < 0;
    for (int i = 0; i < 9; i++)
        out[i] = mirrored ? -out[i] : out[i];
    return mirrored;
}

/* By a column-major 4x4 matrix, and by a 3x3 one. */
static inline void vec_transform_point(const double m[16], const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i];
}

static inline void vec_transform_normal(const double n[9], const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = n[i] * v[0] + n[3 + i] * v[1] + n[6 + i] * v[2];
}

#endif
