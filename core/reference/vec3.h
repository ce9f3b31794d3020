/* SPDX-License-Identifier: MIT
 *
 * Three floats as a value. The tracer's inner loop keeps them in registers, which array types
 * prevent.
 */
#ifndef IRB_REFERENCE_VEC3_H
#define IRB_REFERENCE_VEC3_H

#include <math.h>

struct vec3 {
    float x, y, z;
};

static inline struct vec3 v3(float x, float y, float z)
{
    return (struct vec3){x, y, z};
}

static inline struct vec3 v3_load(const float *v)
{
    return (struct vec3){v[0], v[1], v[2]};
}

static inline struct vec3 v3_add(struct vec3 a, struct vec3 b)
{
    return v3(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline struct vec3 v3_sub(struct vec3 a, struct vec3 b)
{
    return v3(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline struct vec3 v3_mul(struct vec3 a, struct vec3 b)
{
    return v3(a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline struct vec3 v3_scale(struct vec3 a, float s)
{
    return v3(a.x * s, a.y * s, a.z * s);
}

/* a + s b */
static inline struct vec3 v3_mad(struct vec3 a, float s, struct vec3 b)
{
    return v3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

static inline float v3_dot(struct vec3 a, struct vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct vec3 v3_cross(struct vec3 a, struct vec3 b)
{
    return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* Of two numbers; fmaxf and fminf are calls where NaN matters, which it does not here. */
static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

static inline float smaller(float a, float b)
{
    return a < b ? a : b;
}

static inline float v3_max(struct vec3 a)
{
    return larger(a.x, larger(a.y, a.z));
}

/* Largest magnitude of the components. */
static inline float v3_max_abs(struct vec3 a)
{
    return v3_max(v3(fabsf(a.x), fabsf(a.y), fabsf(a.z)));
}

/* a/|a|, or 0 where |a| is 0 or not finite. Scaled first, so that millimetre triangles (products
 * of 1e-20 and below) do not underflow. */
static inline struct vec3 v3_normalize_safe(struct vec3 a)
{
    float m = v3_max_abs(a);
    if (!(m > 0) || !isfinite(m))
        return v3(0, 0, 0);
    a = v3_scale(a, 1 / m);
    return v3_scale(a, 1 / sqrtf(v3_dot(a, a)));
}

/* Rec.709 luminance. */
static inline float v3_luminance(struct vec3 a)
{
    return 0.2126f * a.x + 0.7152f * a.y + 0.0722f * a.z;
}

/* Two tangents that make a right-handed orthonormal frame with the unit vector n (Duff et al. 2017,
 * "Building an orthonormal basis, revisited", JCGT 6(1)). */
static inline void v3_basis(struct vec3 n, struct vec3 *s, struct vec3 *t)
{
    float sign = copysignf(1, n.z);
    float a = -1 / (sign + n.z), b = n.x * n.y * a;
    *s = v3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    *t = v3(b, sign + n.y * n.y * a, -n.y);
}

#endif
