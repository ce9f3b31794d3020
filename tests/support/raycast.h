/* SPDX-License-Identifier: MIT
 *
 * Nearest surface along a ray by testing every triangle, in double precision. Include after
 * compare.h.
 */
#ifndef IRB_TESTS_SUPPORT_RAYCAST_H
#define IRB_TESTS_SUPPORT_RAYCAST_H

#include "core/scene/scene.h"

#include <math.h>
#include <stdlib.h>

struct raycast {
    double (*corners)[3][3]; /* of every triangle where it is now; owned */
    uint32_t count;
};

static inline void raycast_create(struct raycast *cast, const struct irb_scene *scene)
{
    const float *positions = irb_scene_current_positions(scene);
    cast->count = 0;
    cast->corners = malloc(scene->triangle_count * sizeof *cast->corners);
    for (int o = 0; o < scene->object_count; o++) {
        const struct irb_object *object = &scene->objects[o];
        const float *m = object->transform;
        for (uint32_t i = 0; i < 3 * object->triangle_count; i++) {
            uint32_t vertex = scene->indices[3 * (size_t)object->first_triangle + i];
            const float *p = positions + 3 * (size_t)vertex;
            for (int c = 0; c < 3; c++)
                cast->corners[cast->count + i / 3][i % 3][c] = (double)m[c] * p[0] +
                                                               (double)m[4 + c] * p[1] +
                                                               (double)m[8 + c] * p[2] + m[12 + c];
        }
        cast->count += object->triangle_count;
    }
}

static inline void raycast_destroy(struct raycast *cast)
{
    free(cast->corners);
}

static inline double raycast_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void raycast_cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Distance (in lengths of `direction`) to one triangle, from either side (Moeller and Trumbore
 * 1997); INFINITY beside it. */
static inline double raycast_triangle(const double corners[3][3], const double origin[3],
                                      const double direction[3])
{
    double u[3], v[3], s[3], p[3], q[3];
    for (int i = 0; i < 3; i++) {
        u[i] = corners[1][i] - corners[0][i];
        v[i] = corners[2][i] - corners[0][i];
        s[i] = origin[i] - corners[0][i];
    }
    raycast_cross(direction, v, p);
    double det = raycast_dot(u, p);
    if (det == 0)
        return INFINITY;
    double a = raycast_dot(s, p) / det;
    if (!(a >= 0 && a <= 1))
        return INFINITY;
    raycast_cross(s, u, q);
    double b = raycast_dot(direction, q) / det;
    return b >= 0 && a + b <= 1 ? raycast_dot(v, q) / det : INFINITY;
}

/* Nearest of at least `near`; INFINITY where there is none. */
static inline double raycast_nearest(const struct raycast *cast, const double origin[3],
                                     const double direction[3], double near)
{
    double nearest = INFINITY;
    for (uint32_t t = 0; t < cast->count; t++) {
        double r = raycast_triangle((const double(*)[3])cast->corners[t], origin, direction);
        if (r >= near && r < nearest)
            nearest = r;
    }
    return nearest;
}

#endif
