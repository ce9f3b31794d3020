/* SPDX-License-Identifier: MIT */
#include "core/lights/point_need.h"

#include "core/lights/tessellation.h"

#include <math.h>
#include <stdlib.h>

/* From this many of its radii on a triangle is taken for a point: F is off by about 1/64 of itself.
 */
static const double far_radii = 8;
/* Sine of the least elevation above a light's plane, as in shaders/lights/ism_splat.glsl: below are
 * points of the surface that it stands on, up to rounding. */
static const double horizon = 1e-3;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

struct world_triangle {
    double corners[3][3], centre[3];
    double area_vector[3]; /* unit normal * area, m2 */
    double radius2;        /* of the corners about the centre, m2 */
};

static void place(const struct irb_scene *scene, const struct irb_object *object, uint32_t triangle,
                  struct world_triangle *out)
{
    const float *positions = irb_scene_current_positions(scene), *m = object->transform;
    double edges[2][3];
    for (int k = 0; k < 3; k++) {
        const float *p = positions + 3 * (size_t)scene->indices[3 * (size_t)triangle + (size_t)k];
        for (int r = 0; r < 3; r++)
            out->corners[k][r] =
                (double)m[r] * p[0] + (double)m[4 + r] * p[1] + (double)m[8 + r] * p[2] + m[12 + r];
    }
    for (int r = 0; r < 3; r++) {
        edges[0][r] = out->corners[1][r] - out->corners[0][r];
        edges[1][r] = out->corners[2][r] - out->corners[0][r];
        out->centre[r] = out->corners[0][r] + (edges[0][r] + edges[1][r]) / 3;
    }
    cross(edges[0], edges[1], out->area_vector);
    out->radius2 = 0;
    for (int r = 0; r < 3; r++)
        out->area_vector[r] *= 0.5;
    for (int k = 0; k < 3; k++) {
        double d[3];
        for (int r = 0; r < 3; r++)
            d[r] = out->corners[k][r] - out->centre[r];
        out->radius2 = fmax(out->radius2, dot(d, d));
    }
}

/* The part of a triangle above the plane of normal n through the origin: up to 4 corners. */
static int clip(const double v[3][3], const double n[3], double out[4][3])
{
    double height[3];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        height[i] = dot(v[i], n);
        if (!(height[i] > horizon * sqrt(dot(v[i], v[i]))))
            height[i] = fmin(height[i], 0);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        if (height[i] > 0) {
            for (int r = 0; r < 3; r++)
                out[count][r] = v[i][r];
            count++;
        }
        if ((height[i] > 0) != (height[j] > 0)) {
            const double t = height[i] / (height[i] - height[j]);
            for (int r = 0; r < 3; r++)
                out[count][r] = v[i][r] + t * (v[j][r] - v[i][r]);
            count++;
        }
    }
    return count;
}

/* Contour integral (Lambert 1760; Baum et al. 1989, eq. 8) of what lies above the light's plane;
 * corners from the light. */
static double contour(const double corners[3][3], const double n[3])
{
    double v[4][3], sum = 0;
    const int count = clip(corners, n, v);
    for (int i = 0; i < count; i++) {
        const double *a = v[i], *b = v[(i + 1) % count];
        double c[3];
        cross(a, b, c);
        const double sine = sqrt(dot(c, c));
        if (sine > 0)
            sum += atan2(sine, dot(a, b)) * dot(n, c) / sine;
    }
    return fmin(fabs(sum) / (2 * M_PI), 1);
}

static double form_factor(const struct world_triangle *triangle, const struct irb_need_light *light)
{
    const double n[3] = {light->normal[0], light->normal[1], light->normal[2]};
    double d[3], corners[3][3];
    for (int r = 0; r < 3; r++)
        d[r] = triangle->centre[r] - light->position[r];
    const double d2 = dot(d, d);
    if (d2 > far_radii * far_radii * triangle->radius2) {
        const double height = dot(d, n);
        return height > horizon * sqrt(d2)
                   ? height * fabs(dot(d, triangle->area_vector)) / (M_PI * d2 * d2)
                   : 0;
    }
    for (int k = 0; k < 3; k++)
        for (int r = 0; r < 3; r++)
            corners[k][r] = triangle->corners[k][r] - light->position[r];
    return contour((const double(*)[3])corners, n);
}

static bool has_flux(const struct irb_need_light *light)
{
    return light->flux[0] > 0 || light->flux[1] > 0 || light->flux[2] > 0;
}

static double mean_form_factor(const struct world_triangle *triangle,
                               const struct irb_need_light *lights, int count)
{
    double sum = 0;
    int lit = 0;
    for (int l = 0; l < count; l++)
        if (has_flux(&lights[l])) {
            sum += form_factor(triangle, &lights[l]);
            lit++;
        }
    return lit ? sum / lit : 0;
}

void irb_point_need(const struct irb_scene *scene, const struct irb_need_light *lights, int count,
                    double *need)
{
    struct world_triangle triangle;
    for (uint32_t t = 0; t < scene->triangle_count; t++)
        need[t] = 0;
    for (int o = 0; o < scene->object_count; o++) {
        const struct irb_object *object = &scene->objects[o];
        for (uint32_t i = 0; i < object->triangle_count; i++) {
            const uint32_t t = object->first_triangle + i;
            place(scene, object, t, &triangle);
            need[t] = mean_form_factor(&triangle, lights, count);
        }
    }
}

/* Every k-th light of the view, `selected` of them. */
static bool read_lights(const struct irb_virtual_lights *view, struct irb_need_light *lights,
                        int *selected, struct irb_error *err)
{
    *selected = view->count < IRB_NEED_LIGHTS ? view->count : IRB_NEED_LIGHTS;
    if (!view->count)
        return true;
    const int64_t bytes = (int64_t)view->count * IRB_VPL_BYTES;
    struct irb_need_light *all = malloc((size_t)bytes);
    if (!all)
        return irb_fail(err, IRB_E_MEMORY, "points: out of memory");
    const bool ok = irb_buffer_read(view->buffer, 0, bytes, all, err);
    for (int i = 0; ok && i < *selected; i++)
        lights[i] = all[(int64_t)i * view->count / *selected];
    free(all);
    return ok;
}

/* Areas at rest of the triangles of objects; others have no points. */
static double measure_areas(const struct irb_scene *scene, float *areas)
{
    double sum = 0, edges[3];
    for (uint32_t t = 0; t < scene->triangle_count; t++)
        areas[t] = 0;
    for (int o = 0; o < scene->object_count; o++)
        for (uint32_t i = 0; i < scene->objects[o].triangle_count; i++) {
            const uint32_t t = scene->objects[o].first_triangle + i;
            const double area = irb_triangle_size(scene, t, edges);
            areas[t] = (float)area;
            sum += area;
        }
    return sum;
}

bool irb_point_weights(const struct irb_scene *scene, const struct irb_virtual_lights *lights,
                       float by_need, float *weights, struct irb_error *err)
{
    struct irb_need_light selected[IRB_NEED_LIGHTS];
    int count;
    if (!read_lights(lights, selected, &count, err))
        return false;
    double *need = malloc(((size_t)scene->triangle_count + 1) * sizeof *need);
    if (!need)
        return irb_fail(err, IRB_E_MEMORY, "points: out of memory");
    irb_point_need(scene, selected, count, need);
    const double area = measure_areas(scene, weights);
    double sum = 0;
    for (uint32_t t = 0; t < scene->triangle_count; t++)
        sum += weights[t] > 0 ? need[t] : 0;
    const double share = sum > 0 ? (double)by_need : 0;
    for (uint32_t t = 0; t < scene->triangle_count; t++)
        if (weights[t] > 0)
            weights[t] = (float)((1 - share) * (double)weights[t] / area +
                                 (share > 0 ? share * need[t] / sum : 0));
    free(need);
    return true;
}
