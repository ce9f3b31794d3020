/* SPDX-License-Identifier: MIT
 *
 * Time that imperfect shadow maps take, in one process, the passes interleaved: milliseconds,
 * median of REPEATS. LIGHTS virtual lights are drawn from the scene's reflective shadow map by
 * importance, a map of 128 x 128 texels each; points are the thesis's f[F_MIN,F_MAX], and a million
 * random ones.
 *
 *     bench_ism [auto|osmesa|egl] [SCENE] [F_MIN F_MAX] [LIGHTS] [--check]
 *
 * --check: exit status 1 where the atomic splatter is not LEAST_RATIO times as fast as the raster
 * one. 77 without a backend.
 */
#include "core/base/clock.h"
#include "core/lights/ism.h"
#include "core/lights/vpl.h"
#include "core/scene/builtin.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPEATS = 9, RESOLUTION = 128, MAP_SIZE = 128, AREA_POINTS = 1000000, PASSES = 6 };
static const double least_ratio = 10;

enum { ATOMIC, RASTER, TESSELLATION, AREA, PULL_PUSH_1, PULL_PUSH_2 };
static const char *const pass_names[PASSES] = {"atomic",       "raster",      "tessellation",
                                               "atomic, area", "pull-push 1", "pull-push 2"};

struct bench {
    struct irb_gl *gl;
    struct irb_scene *scene;
    struct irb_scene_gl *scene_gl;
    struct irb_rsm *rsm;
    struct irb_vpl_set *lights;
    struct irb_points *tessellated, *random;
    struct irb_ism *ism;
    struct irb_ism_settings settings;
    double ms[PASSES][REPEATS], coverage[PASSES];
};

static void must(bool ok, const struct irb_error *err)
{
    if (ok)
        return;
    fprintf(stderr, "bench_ism: %s\n", err->message);
    exit(irb_error_status(err->code));
}

/* A built-in's own light; in a file without one, a wide one that looks down from its middle. */
static struct irb_light light_of(const struct irb_scene *scene)
{
    struct irb_light light = {.type = IRB_LIGHT_SPOT, .intensity = {1, 1, 1}, .outer = 1};
    const struct irb_builtin *builtin = irb_builtin_find(scene->name);
    if (builtin) {
        struct irb_animation animation;
        builtin->view(&animation);
        irb_animation_light(&animation, scene, 0, &light);
        irb_animation_destroy(&animation);
    } else {
        for (int i = 0; i < 3; i++)
            light.position[i] = 0.5f * (scene->bounds_min[i] + scene->bounds_max[i]);
        light.direction[1] = -1;
    }
    return light;
}

static double make_points(struct bench *b)
{
    struct irb_error err = {0};
    const struct irb_points_desc tessellated = {.kind = IRB_POINTS_TESSELLATION,
                                                .f_min = b->settings.f_min,
                                                .f_max = b->settings.f_max,
                                                .smoothstep = b->settings.smoothstep};
    const struct irb_points_desc random = {
        .kind = IRB_POINTS_AREA, .count = AREA_POINTS, .seed = 1};
    double start = irb_clock_s();
    must((b->tessellated = irb_points_create(b->gl, b->scene_gl, &tessellated, &err)), &err);
    double ms = 1e3 * (irb_clock_s() - start);
    must((b->random = irb_points_create(b->gl, b->scene_gl, &random, &err)), &err);
    return ms;
}

static void make(struct bench *b, const char *scene, int lights)
{
    struct irb_error err = {0};
    must((b->scene = irb_scene_load(scene, NULL, &err)), &err);
    const struct irb_light light = light_of(b->scene);
    must((b->scene_gl = irb_scene_gl_create(b->gl, b->scene, &err)), &err);
    must((b->rsm = irb_rsm_create(b->gl, RESOLUTION, &err)), &err);
    must(irb_rsm_render(b->rsm, b->scene_gl, &light, &err), &err);
    must((b->lights = irb_vpl_set_create(b->gl, IRB_VPL_IMPORTANCE, RESOLUTION, lights, &err)),
         &err);
    must(irb_vpl_set_sample(b->lights, b->rsm, lights, 0, &err), &err);
    must((b->ism = irb_ism_create(b->gl, MAP_SIZE, lights, &err)), &err);
}

static double time_once(struct bench *b, int pass)
{
    struct irb_error err = {0};
    const struct irb_virtual_lights lights = irb_vpl_set_view(b->lights);
    struct irb_ism_settings s = b->settings;
    s.splatter = pass == RASTER         ? IRB_ISM_RASTER
                 : pass == TESSELLATION ? IRB_ISM_TESSELLATION
                                        : IRB_ISM_ATOMIC;
    s.pull_push = pass == PULL_PUSH_2 ? 2 : 1;
    b->gl->api.Finish();
    double start = irb_clock_s();
    if (pass < PULL_PUSH_1)
        must(irb_ism_splat(b->ism, b->scene_gl,
                           pass == TESSELLATION ? NULL
                           : pass == AREA       ? b->random
                                                : b->tessellated,
                           &lights, &s, &err),
             &err);
    else
        must(irb_ism_pull_push(b->ism, &s, &err), &err);
    b->gl->api.Finish();
    const double ms = 1e3 * (irb_clock_s() - start);
    must(irb_ism_coverage(b->ism, &b->coverage[pass], &err), &err);
    return ms;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double print_result(struct bench *b, double points_ms)
{
    printf("%s, %s, %d lights, f[%g,%g]: %llu points (%.0f ms to make)\n", b->gl->renderer,
           b->scene->name, b->lights->count, (double)b->settings.f_min, (double)b->settings.f_max,
           (unsigned long long)b->tessellated->count, points_ms);
    for (int pass = 0; pass < PASSES; pass++) {
        qsort(b->ms[pass], REPEATS, sizeof(double), compare);
        printf("%-14s %8.1f ms   covered %.3f\n", pass_names[pass], b->ms[pass][REPEATS / 2],
               b->coverage[pass]);
    }
    const double ratio = b->ms[RASTER][REPEATS / 2] / b->ms[ATOMIC][REPEATS / 2];
    printf("atomic is %.1f times as fast as raster\n", ratio);
    return ratio;
}

static void destroy(struct bench *b)
{
    irb_ism_destroy(b->ism);
    irb_points_destroy(b->tessellated);
    irb_points_destroy(b->random);
    irb_vpl_set_destroy(b->lights);
    irb_rsm_destroy(b->rsm);
    irb_scene_gl_destroy(b->scene_gl);
    irb_scene_destroy(b->scene);
    irb_gl_destroy(b->gl);
}

static enum irb_backend backend_of(int argc, char **argv)
{
    for (int i = 0; argc > 1 && irb_backend_names[i]; i++)
        if (!strcmp(argv[1], irb_backend_names[i]))
            return (enum irb_backend)i;
    return IRB_BACKEND_AUTO;
}

int main(int argc, char **argv)
{
    struct irb_error err = {0};
    struct bench b = {.settings = {.splat_factor = 1,
                                   .splat_scale = 1,
                                   .splat_size = IRB_ISM_SIZE_SURFACE,
                                   .splat_most = 5,
                                   .near = 0.001f,
                                   .f_min = 5,
                                   .f_max = 32,
                                   .smoothstep = 3}};
    const struct irb_gl_desc desc = {.backend = backend_of(argc, argv)};
    const bool check = argc > 1 && !strcmp(argv[argc - 1], "--check");
    argc -= check;
    if (argc > 4) {
        b.settings.f_min = strtof(argv[3], NULL);
        b.settings.f_max = strtof(argv[4], NULL);
    }
    if (!(b.gl = irb_gl_create(&desc, &err))) {
        printf("skipped: %s\n", err.message);
        return 77;
    }
    make(&b, argc > 2 ? argv[2] : "cornell-objects", argc > 5 ? atoi(argv[5]) : 128);
    const double points_ms = make_points(&b);
    for (int repeat = -1; repeat < REPEATS; repeat++) /* the first round compiles */
        for (int pass = 0; pass < PASSES; pass++) {
            double ms = time_once(&b, pass);
            if (repeat >= 0)
                b.ms[pass][repeat] = ms;
        }
    const double ratio = print_result(&b, points_ms);
    destroy(&b);
    return !check || ratio >= least_ratio ? 0 : 1;
}
