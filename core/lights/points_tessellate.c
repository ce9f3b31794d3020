/* SPDX-License-Identifier: MIT */
#include "core/lights/points_mask.h"
#include "core/lights/points_parts.h"
#include "core/lights/tessellation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WEIGHT_ONE = 65535 };

/* The points of the last triangle: most triangles of a scene have the same factors, f_min. */
struct pattern {
    double factors[4]; /* t_A, t_a, t_b, t_c */
    struct irb_point *points;
    uint64_t count, capacity;
};

struct tessellator {
    const struct irb_scene *scene;
    const struct irb_points_desc *desc;
    struct irb_tessellation_range range;
    struct pattern pattern;
};

static bool pattern_add(struct pattern *pattern, double beta, double gamma)
{
    if (pattern->count == pattern->capacity) {
        uint64_t capacity = pattern->capacity ? 2 * pattern->capacity : 1024;
        struct irb_point *points = realloc(pattern->points, capacity * sizeof *points);
        if (!points)
            return false;
        pattern->points = points;
        pattern->capacity = capacity;
    }
    int v = (int)lround(fmin(gamma, 1) * WEIGHT_ONE), u = (int)lround(fmax(beta, 0) * WEIGHT_ONE);
    if (u > WEIGHT_ONE - v)
        u = WEIGHT_ONE - v;
    pattern->points[pattern->count++] = (struct irb_point){.u = (uint16_t)u, .v = (uint16_t)v};
    return true;
}

/* Lines 8 to 18 of algorithm 5.2. False when out of memory. */
static bool make_pattern(struct pattern *pattern, const double factors[4])
{
    const double s_a = 1.0 / (factors[1] + factors[0]), s_b = 1.0 / (factors[2] + factors[0]),
                 s_c = 1.0 / (factors[3] + factors[0]);
    pattern->count = 0;
    memcpy(pattern->factors, factors, sizeof pattern->factors);
    for (double gamma = 0.0; gamma <= 1.0; gamma += s_c) {
        double alpha = 1.0 - gamma, beta = 0.0;
        while (alpha > 0.0) {
            if (!pattern_add(pattern, beta, gamma))
                return false;
            alpha -= (1.0 - alpha) * s_a + (1.0 - beta) * s_b + (1.0 - gamma) * s_c;
            beta = 1.0 - alpha - gamma;
        }
    }
    return true;
}

/* False for a triangle without area. */
static bool get_factors(const struct tessellator *t, uint32_t triangle, double factors[4])
{
    const double f_min = t->desc->f_min, f_max = t->desc->f_max;
    const int order = t->desc->smoothstep;
    double edges[3], area = irb_triangle_size(t->scene, triangle, edges);
    if (!(area > 0))
        return false;
    factors[0] = irb_tessellation_factor(t->range.area, area, order, f_min, f_max);
    for (int i = 0; i < 3; i++)
        factors[i + 1] = irb_tessellation_factor(t->range.edge, edges[i], order, f_min, f_max);
    return true;
}

/* *made: points before the alpha mask. False when out of memory. */
static bool tessellate(struct tessellator *t, const struct irb_object *object, uint32_t triangle,
                       struct irb_points_sink *sink, uint64_t *made)
{
    const struct irb_points_mask mask = irb_points_mask(t->scene, object, triangle);
    double factors[4];
    *made = 0;
    if (!get_factors(t, triangle, factors))
        return true;
    if (memcmp(factors, t->pattern.factors, sizeof factors) && !make_pattern(&t->pattern, factors))
        return false;
    *made = t->pattern.count;
    if (!sink->points)
        sink->count += *made;
    for (uint64_t i = 0; sink->points && i < *made; i++) {
        const struct irb_point *point = &t->pattern.points[i];
        if (mask.cutoff > 0 && irb_points_mask_cuts(&mask, point->u, point->v))
            continue;
        sink->points[sink->count] = *point;
        sink->points[sink->count++].triangle = triangle;
    }
    return true;
}

bool irb_points_tessellate(const struct irb_scene *scene, const struct irb_points_desc *desc,
                           struct irb_points_sink *sink, float *density, struct irb_error *err)
{
    struct tessellator t = {.scene = scene, .desc = desc};
    bool ok = true;
    irb_tessellation_measure(scene, &t.range);
    for (int o = 0; o < scene->object_count && ok; o++) {
        const struct irb_object *object = &scene->objects[o];
        const uint32_t end = object->first_triangle + object->triangle_count;
        for (uint32_t i = object->first_triangle; i < end && ok; i++) {
            uint64_t made;
            if (irb_points_sink_is_over(sink))
                break;
            ok = tessellate(&t, object, i, sink, &made) ||
                 irb_fail(err, IRB_E_MEMORY, "points: out of memory");
            if (density)
                density[i] = (float)made;
        }
    }
    free(t.pattern.points);
    return ok;
}

/* A row of length 1 - gamma is cut into pieces of 2/3 (s_a + s_b + s_c), the last one begun. */
static double estimate(const double factors[4])
{
    double steps = 0;
    for (int i = 1; i < 4; i++)
        steps += 1 / (factors[i] + factors[0]);
    return (factors[3] + factors[0]) * (0.75 / steps + 0.5);
}

double irb_points_tessellate_estimate(const struct irb_scene *scene,
                                      const struct irb_points_desc *desc)
{
    struct tessellator t = {.scene = scene, .desc = desc};
    double sum = 0, factors[4];
    irb_tessellation_measure(scene, &t.range);
    for (int o = 0; o < scene->object_count; o++)
        for (uint32_t i = 0; i < scene->objects[o].triangle_count; i++)
            if (get_factors(&t, scene->objects[o].first_triangle + i, factors))
                sum += estimate(factors);
    return sum;
}
