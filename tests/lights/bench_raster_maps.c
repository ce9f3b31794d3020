/* SPDX-License-Identifier: MIT
 *
 * Time that rasterised shadow maps take: milliseconds a light and million triangles (times lights)
 * a second, median of REPEATS, both projections interleaved.
 *
 *     bench_raster_maps [auto|osmesa|egl] [SCENE] [SIZE] [LIGHTS]
 *
 * Exit status 77 without a backend.
 */
#include "core/base/clock.h"
#include "core/lights/raster_maps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPEATS = 9, PROJECTIONS = 2, LIGHT_FLOATS = 12 };

static void must(bool ok, const struct irb_error *err)
{
    if (ok)
        return;
    fprintf(stderr, "bench_raster_maps: %s\n", err->message);
    exit(irb_error_status(err->code));
}

/* On the six sides of the scene's bounds, looking in. */
static struct irb_buffer *make_lights(struct irb_gl *gl, const struct irb_scene *scene)
{
    static float lights[IRB_VPL_BLOCK * LIGHT_FLOATS];
    struct irb_error err = {0};
    for (int l = 0; l < IRB_VPL_BLOCK; l++) {
        float *light = lights + l * LIGHT_FLOATS;
        const int axis = l % 3, side = l / 3 % 2;
        for (int i = 0; i < 3; i++) {
            /* golden-ratio steps over each side */
            double u = (l + 1) * (i == (axis + 1) % 3 ? 0.7548776662 : 0.5698402910);
            u = i == axis ? side : u - (double)(long)u;
            light[i] =
                scene->bounds_min[i] + (float)u * (scene->bounds_max[i] - scene->bounds_min[i]);
        }
        light[4 + axis] = side ? -1 : 1;
    }
    struct irb_buffer *buffer = irb_buffer_create(gl, "lights", sizeof lights, lights, &err);
    must(buffer, &err);
    return buffer;
}

static double time_once(struct irb_raster_maps *maps, const struct irb_scene_gl *scene,
                        const struct irb_virtual_lights *lights)
{
    struct irb_error err = {0};
    maps->gl->api.Finish();
    double start = irb_clock_s();
    must(irb_raster_maps_render(maps, scene, lights, 0, lights->count,
                                1e-3f * irb_scene_diagonal(scene->scene), &err),
         &err);
    maps->gl->api.Finish();
    return 1e3 * (irb_clock_s() - start);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void report(const struct irb_raster_maps *maps, double *ms, const struct irb_scene *scene)
{
    qsort(ms, REPEATS, sizeof *ms, by_value);
    const double median = ms[REPEATS / 2], lights = maps->count;
    printf("%-10s  %8.1f ms  %7.2f ms a light  %6.2f M triangles/s  (%.1f to %.1f ms)\n",
           irb_raster_projection_names[maps->projection], median, median / lights,
           scene->triangle_count * lights / median / 1e3, ms[0], ms[REPEATS - 1]);
}

static enum irb_backend backend_of(const char *name)
{
    for (int i = 0; irb_backend_names[i]; i++)
        if (strcmp(irb_backend_names[i], name) == 0)
            return (enum irb_backend)i;
    return IRB_BACKEND_AUTO;
}

int main(int argc, char **argv)
{
    struct irb_error err = {0};
    const struct irb_gl_desc desc = {.backend = backend_of(argc > 1 ? argv[1] : "auto")};
    const int size = argc > 3 ? atoi(argv[3]) : 128, lights = argc > 4 ? atoi(argv[4]) : 64;
    struct irb_gl *gl = irb_gl_create(&desc, &err);
    if (!gl) {
        printf("skipped: %s\n", err.message);
        return 77;
    }
    struct irb_scene *scene = irb_scene_load(argc > 2 ? argv[2] : "cornell-objects", NULL, &err);
    must(scene, &err);
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    must(scene_gl, &err);
    struct irb_buffer *buffer = make_lights(gl, scene);
    struct irb_virtual_lights view = {.buffer = buffer, .count = lights};
    struct irb_raster_maps *maps[PROJECTIONS];
    double ms[PROJECTIONS][REPEATS];
    for (int p = 0; p < PROJECTIONS; p++) {
        maps[p] = irb_raster_maps_create(gl, (enum irb_raster_projection)p, size, lights, &err);
        must(maps[p], &err);
        time_once(maps[p], scene_gl, &view);
    }
    for (int i = 0; i < REPEATS; i++)
        for (int p = 0; p < PROJECTIONS; p++)
            ms[p][i] = time_once(maps[p], scene_gl, &view);
    printf("%s: %u triangles, %d lights, %d x %d, %s\n", scene->name, scene->triangle_count, lights,
           size, size, gl->renderer);
    for (int p = 0; p < PROJECTIONS; p++) {
        report(maps[p], ms[p], scene);
        irb_raster_maps_destroy(maps[p]);
    }
    irb_buffer_destroy(buffer);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
    irb_gl_destroy(gl);
    return 0;
}
