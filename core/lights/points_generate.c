/* SPDX-License-Identifier: MIT */
#include "core/lights/points.h"

#include "core/lights/points_parts.h"
#include "core/lights/tessellation.h"

#include <stdlib.h>

static int64_t most_bytes(const struct irb_points_desc *desc)
{
    return desc->most_bytes > 0 ? desc->most_bytes : (int64_t)IRB_POINTS_MOST_BYTES;
}

static bool refuse(const struct irb_points_desc *desc, const char *about, double count,
                   struct irb_error *err)
{
    const double mib = 1 << 20;
    return irb_fail(err, IRB_E_MEMORY,
                    "points: %s%.0f points take %.1f MiB, above the bound of %.1f MiB; ask for %s",
                    about, count, count * (double)sizeof(struct irb_point) / mib,
                    (double)most_bytes(desc) / mib,
                    desc->kind == IRB_POINTS_AREA ? "fewer points" : "smaller factors");
}

/* Of all objects at rest, m2. */
static double scene_area(const struct irb_scene *scene)
{
    double sum = 0, edges[3];
    for (int o = 0; o < scene->object_count; o++)
        for (uint32_t i = 0; i < scene->objects[o].triangle_count; i++)
            sum += irb_triangle_size(scene, scene->objects[o].first_triangle + i, edges);
    return sum;
}

/* What AREA has to draw from. */
static double scene_weight(const struct irb_scene *scene, const struct irb_points_desc *desc)
{
    double sum = 0;
    for (int o = 0; o < scene->object_count; o++)
        for (uint32_t i = 0; i < scene->objects[o].triangle_count; i++)
            sum += irb_points_weight(scene, desc, scene->objects[o].first_triangle + i);
    return sum;
}

static bool check_desc(const struct irb_points_desc *desc, struct irb_error *err)
{
    if (desc->kind == IRB_POINTS_TESSELLATION)
        return irb_tessellation_check((double)desc->f_min, (double)desc->f_max, desc->smoothstep,
                                      err);
    if (desc->kind != IRB_POINTS_AREA || desc->count < 0)
        return irb_fail(err, IRB_E_INPUT, "points: expected a count of at least 0, found %d",
                        desc->count);
    return true;
}

bool irb_points_count(const struct irb_scene *scene, const struct irb_points_desc *desc,
                      uint64_t *count, struct irb_error *err)
{
    struct irb_points_sink sink = {.most = (uint64_t)most_bytes(desc) / sizeof(struct irb_point)};
    *count = 0;
    if (!check_desc(desc, err))
        return false;
    if (desc->kind == IRB_POINTS_AREA) {
        *count = scene_weight(scene, desc) > 0 ? (uint64_t)desc->count : 0;
        return *count <= sink.most || refuse(desc, "", (double)*count, err);
    }
    if (!irb_points_tessellate(scene, desc, &sink, NULL, err))
        return false;
    *count = sink.count;
    return !irb_points_sink_is_over(&sink) ||
           refuse(desc, "about ", irb_points_tessellate_estimate(scene, desc), err);
}

/* One run for each object that has points. */
static void find_runs(const struct irb_scene *scene, struct irb_point_list *list)
{
    uint64_t next = 0;
    for (int o = 0; o < scene->object_count; o++) {
        const struct irb_object *object = &scene->objects[o];
        const uint64_t first = next;
        while (next < list->count &&
               list->points[next].triangle - object->first_triangle < object->triangle_count)
            next++;
        if (next > first)
            list->runs[list->run_count++] = (struct irb_points_run){
                .object = o, .first = (uint32_t)first, .count = (uint32_t)(next - first)};
    }
}

static bool fill(const struct irb_scene *scene, const struct irb_points_desc *desc,
                 struct irb_point_list *list, struct irb_error *err)
{
    struct irb_points_sink sink = {.points = list->points, .most = list->count};
    const bool ok = desc->kind == IRB_POINTS_AREA
                        ? irb_points_draw(scene, desc, &sink, list->density, err)
                        : irb_points_tessellate(scene, desc, &sink, list->density, err);
    list->count = sink.count;
    list->area = scene_area(scene);
    if (ok)
        find_runs(scene, list);
    return ok;
}

bool irb_points_generate(const struct irb_scene *scene, const struct irb_points_desc *desc,
                         struct irb_point_list *list, struct irb_error *err)
{
    *list = (struct irb_point_list){0};
    if (!irb_points_count(scene, desc, &list->count, err))
        return false;
    list->points = malloc((list->count + 1) * sizeof *list->points);
    list->runs = malloc((size_t)(scene->object_count + 1) * sizeof *list->runs);
    list->density = calloc((size_t)scene->triangle_count + 1, sizeof *list->density);
    bool ok = list->points && list->runs && list->density;
    if (!ok)
        irb_fail(err, IRB_E_MEMORY, "points: out of memory for %llu points",
                 (unsigned long long)list->count);
    ok = ok && fill(scene, desc, list, err);
    if (!ok)
        irb_point_list_destroy(list);
    return ok;
}

void irb_point_list_destroy(struct irb_point_list *list)
{
    free(list->points);
    free(list->runs);
    free(list->density);
    *list = (struct irb_point_list){0};
}
