/* SPDX-License-Identifier: MIT */
#include "core/lights/tessellation.h"

#include "core/scene/vec.h"

#include <math.h>

const char *const irb_smoothstep_names[] = {"3", "5", NULL};

int irb_smoothstep_order(int smoothstep)
{
    return smoothstep == IRB_SMOOTHSTEP_5 ? 5 : 3;
}

/* Far above any use (the thesis goes to 64), and still a bounded number of points a triangle. */
static const double most_factor = 1024;

double irb_triangle_size(const struct irb_scene *scene, uint32_t triangle, double edges[3])
{
    double corner[3][3], normal[3], along[3];
    for (size_t i = 0; i < 3; i++)
        vec_from_float(scene->positions + 3 * (size_t)scene->indices[3 * (size_t)triangle + i],
                       corner[i]);
    for (int i = 0; i < 3; i++) {
        vec_sub(corner[(i + 2) % 3], corner[(i + 1) % 3], along);
        edges[i] = vec_length(along);
    }
    vec_triangle_cross(corner[0], corner[1], corner[2], normal);
    return 0.5 * vec_length(normal);
}

static void widen(double range[2], double value, bool first)
{
    range[0] = first ? value : fmin(range[0], value);
    range[1] = first ? value : fmax(range[1], value);
}

void irb_tessellation_measure(const struct irb_scene *scene, struct irb_tessellation_range *range)
{
    bool first = true;
    *range = (struct irb_tessellation_range){0};
    for (uint32_t t = 0; t < scene->triangle_count; t++) {
        double edges[3], area = irb_triangle_size(scene, t, edges);
        if (!(area > 0))
            continue;
        widen(range->area, area, first);
        for (int i = 0; i < 3; i++)
            widen(range->edge, edges[i], first && i == 0);
        first = false;
    }
}

static double smooth(double x, int order)
{
    return order == 5 ? x * x * x * (x * (6 * x - 15) + 10) : x * x * (3 - 2 * x);
}

double irb_tessellation_factor(const double range[2], double value, int order, double f_min,
                               double f_max)
{
    const double width = range[1] - range[0];
    double x = width > 0 ? (value - range[0]) / width : 0;
    x = fmin(fmax(x, 0), 1);
    return fmax(ceil(smooth(x, order) * f_max), f_min);
}

/* OpenGL 4.5, 11.2.2.2: those on the edges, and on triangles within one another that have two
 * segments fewer a side each, down to one point or none. */
static double triangle_points(const double outer[3], double inner)
{
    double n = ceil(inner), sum = ceil(outer[0]) + ceil(outer[1]) + ceil(outer[2]);
    if (n == 1 && sum > 3)
        n = 2;
    const double rings = floor((n - 1) / 2);
    return sum + 3 * rings * (n - 1 - rings) + (fmod(n, 2) == 0 ? 1 : 0);
}

double irb_tessellation_points(const struct irb_scene *scene,
                               const struct irb_tessellation_range *range, int order, double f_min,
                               double f_max)
{
    double sum = 0;
    for (uint32_t t = 0; t < scene->triangle_count; t++) {
        double edges[3], outer[3], area = irb_triangle_size(scene, t, edges);
        if (!(area > 0))
            continue;
        for (int i = 0; i < 3; i++)
            outer[i] = irb_tessellation_factor(range->edge, edges[i], order, f_min, f_max);
        sum +=
            triangle_points(outer, irb_tessellation_factor(range->area, area, order, f_min, f_max));
    }
    return sum;
}

bool irb_tessellation_check(double f_min, double f_max, int order, struct irb_error *err)
{
    if (!(f_min >= 1) || !(f_min <= f_max) || !(f_max <= most_factor))
        return irb_fail(err, IRB_E_INPUT,
                        "tessellation factors: expected 1 <= f_min <= f_max <= %g, found f[%g,%g]",
                        most_factor, f_min, f_max);
    if (order != 3 && order != 5)
        return irb_fail(err, IRB_E_INPUT, "smoothstep: expected order 3 or 5, found %d", order);
    return true;
}
