/* SPDX-License-Identifier: MIT
 *
 * Where points of a scene are, in double precision. Include after compare.h.
 */
#ifndef IRB_TESTS_LIGHTS_POINTS_FIXTURE_H
#define IRB_TESTS_LIGHTS_POINTS_FIXTURE_H

#include "core/lights/points.h"

#include <stdlib.h>

typedef double fixture_corners[3][3];

/* Corners of every triangle where `positions` and the objects' transforms put it; the caller's. */
static inline fixture_corners *fixture_place_corners(const struct irb_scene *scene,
                                                     const float *positions)
{
    fixture_corners *corners = calloc(scene->triangle_count, sizeof *corners);
    for (int o = 0; o < scene->object_count; o++) {
        const struct irb_object *object = &scene->objects[o];
        const float *m = object->transform;
        for (uint32_t k = 0; k < 3 * object->triangle_count; k++) {
            uint32_t t = object->first_triangle + k / 3;
            const float *p = positions + 3 * (size_t)scene->indices[3 * t + k % 3];
            for (int r = 0; r < 3; r++)
                corners[t][k % 3][r] = (double)m[r] * p[0] + (double)m[4 + r] * p[1] +
                                       (double)m[8 + r] * p[2] + m[12 + r];
        }
    }
    return corners;
}

/* Half the cross product of two edges: the triangle's area along its normal. */
static inline void fixture_area_vector(const fixture_corners c, double out[3])
{
    for (int k = 0; k < 3; k++) {
        int d = (k + 1) % 3, e = (k + 2) % 3;
        out[k] = 0.5 * ((c[1][d] - c[0][d]) * (c[2][e] - c[0][e]) -
                        (c[1][e] - c[0][e]) * (c[2][d] - c[0][d]));
    }
}

static inline void fixture_point_on(const fixture_corners c, const double weights[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = weights[0] * c[0][k] + weights[1] * c[1][k] + weights[2] * c[2][k];
}

static inline void fixture_place_point(const fixture_corners *corners,
                                       const struct irb_point *point, double out[3])
{
    const double u = point->u / 65535.0, v = point->v / 65535.0;
    fixture_point_on(corners[point->triangle], (double[]){1 - u - v, u, v}, out);
}

#endif
