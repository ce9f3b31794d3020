/* SPDX-License-Identifier: MIT
 *
 * Speed of the lighting of a split G-buffer, in one process, interleaved: a view inside the
 * coloured box, lights on what its lamp lights, their shadow maps traced on the CPU. Milliseconds,
 * median and least of REPEATS, and million pixel-light pairs a second.
 *
 *     bench_shade [auto|osmesa|egl]          77 without a backend
 */
#include "core/base/clock.h"
#include "core/frame/rsm.h"
#include "core/lights/shade.h"
#include "core/scene/builtin.h"
#include "tests/lights/shade_scene.h"
#include "tests/support/raycast.h"

#include <stdio.h>

enum { WIDTH = 800, HEIGHT = 600, RSM = 64, MAP = 128, LIGHTS_MOST = 512, REPEATS = 9 };
enum { RASTER_LIGHTS = 128 };

static const struct {
    const char *name;
    int lights, tiles, visibility, taps;
} passes[] = {
    {"none", 128, 3, IRB_SHADE_NONE, 16},         {"binary", 128, 3, IRB_SHADE_BINARY, 16},
    {"raster", 128, 3, IRB_SHADE_RASTER, 16},     {"PCSS 8 + 8", 128, 3, IRB_SHADE_PCSS, 8},
    {"PCSS 16 + 16", 128, 3, IRB_SHADE_PCSS, 16}, {"none", 512, 4, IRB_SHADE_NONE, 16},
    {"binary", 512, 4, IRB_SHADE_BINARY, 16},
};
/* Then the passes round it, at 3 x 3. */
enum { SHADE_PASSES = sizeof passes / sizeof *passes, SPLIT = SHADE_PASSES, MERGE, FILTER, PASSES };

struct bench {
    struct irb_gl *gl;
    struct irb_scene *scene;
    struct irb_gbuffer *gbuffer;
    struct irb_ism ism;
    struct irb_raster_maps *raster; /* hemicubes of the first RASTER_LIGHTS */
    struct irb_buffer *lights;
    struct irb_interleave *interleave[5]; /* by tiles a side */
    struct irb_shade *shade;
    struct irb_texture *out;
};

static void must(bool ok, const struct irb_error *err)
{
    if (ok)
        return;
    fprintf(stderr, "bench_shade: %s\n", err->message);
    exit(irb_error_status(err->code));
}

static double nearest(const void *cast, const double from[3], const double along[3])
{
    return raycast_nearest(cast, from, along, 1e-4);
}

/* Lights on texels of the lamp's RSM, evenly over the lit ones, and their maps. */
static void make_lights(struct bench *b, const struct irb_scene_gl *scene,
                        const struct irb_light *lamp)
{
    struct irb_error err = {0};
    static struct shade_light lights[LIGHTS_MOST];
    struct irb_image position, normal, flux;
    int lit[RSM * RSM], count = 0;
    struct raycast cast;
    struct irb_rsm *rsm = irb_rsm_create(b->gl, RSM, &err);
    raycast_create(&cast, b->scene);
    must(rsm && irb_rsm_render(rsm, scene, lamp, &err) &&
             irb_texture_read(rsm->position, 3, &position, &err) &&
             irb_texture_read(rsm->normal, 3, &normal, &err) &&
             irb_texture_read(rsm->flux, 3, &flux, &err) &&
             shade_maps_create(&b->ism, b->gl, MAP, LIGHTS_MOST, &err),
         &err);
    for (int i = 0; i < RSM * RSM; i++)
        if (flux.data[3 * i] > 0)
            lit[count++] = i;
    for (int l = 0; l < LIGHTS_MOST; l++) {
        /* a stride that is prime to the count, so that the first 128 lie everywhere too */
        const size_t texel = 3 * (size_t)lit[(l * 1009L) % count];
        memcpy(lights[l].position, position.data + texel, 12);
        memcpy(lights[l].normal, normal.data + texel, 12);
        memcpy(lights[l].flux, flux.data + texel, 12);
        lights[l].area = 0.5f / 128; /* m2: half a square metre is lit */
        shade_map_fill(&b->ism, l, &lights[l], nearest, &cast, NULL);
    }
    must((b->lights = shade_lights_upload(b->gl, lights, LIGHTS_MOST, &err)), &err);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    irb_image_destroy(&flux);
    irb_rsm_destroy(rsm);
    raycast_destroy(&cast);
    const struct irb_virtual_lights first = {b->lights, RASTER_LIGHTS};
    b->raster = irb_raster_maps_create(b->gl, IRB_RASTER_HEMICUBE, MAP, RASTER_LIGHTS, &err);
    must(b->raster &&
             irb_raster_maps_render(b->raster, scene, &first, 0, RASTER_LIGHTS, 1e-3f, &err),
         &err);
}

static void make(struct bench *b)
{
    struct irb_error err = {0};
    struct irb_animation animation;
    struct irb_light lamp;
    struct irb_camera camera;
    must((b->scene = irb_scene_load("cornell", NULL, &err)), &err);
    irb_builtin_find("cornell")->view(&animation);
    irb_animation_light(&animation, b->scene, 0, &lamp);
    irb_animation_camera(&animation, b->scene, 0, &camera);
    irb_animation_destroy(&animation);
    camera.position[2] = 0.05f; /* inside, so that every pixel shows geometry */
    camera.target[2] = 0.3f;
    camera.vertical_fov = 1.2f;
    struct irb_scene_gl *scene = irb_scene_gl_create(b->gl, b->scene, &err);
    must(scene && (b->gbuffer = irb_gbuffer_create(b->gl, WIDTH, HEIGHT, &err)) &&
             irb_gbuffer_render(b->gbuffer, scene, &camera, &err),
         &err);
    make_lights(b, scene, &lamp);
    irb_scene_gl_destroy(scene);
    for (int n = 3; n <= 4; n++) {
        b->interleave[n] = irb_interleave_create(b->gl, WIDTH, HEIGHT, n, n, &err);
        must(b->interleave[n] && irb_interleave_split(b->interleave[n], b->gbuffer, &err), &err);
    }
    const struct irb_texture_desc out = {
        .name = "filtered", .format = GL_RGBA32F, .width = WIDTH, .height = HEIGHT};
    must((b->out = irb_texture_create(b->gl, &out, &err)) != NULL, &err);
    must((b->shade = irb_shade_create(b->gl, &err)) != NULL, &err);
}

static void run_shade(struct bench *b, int pass)
{
    struct irb_error err = {0};
    const struct irb_virtual_lights lights = {b->lights, passes[pass].lights};
    const struct irb_shade_settings settings = {.visibility = passes[pass].visibility,
                                                .bias = 0.01f,
                                                .slope = 1,
                                                .offset = 1e-4f,
                                                .taps = passes[pass].taps,
                                                .blocker_taps = passes[pass].taps,
                                                .search_scale = 3,
                                                .penumbra_scale = 1};
    const struct irb_shade_batch all = {.count = lights.count, .raster = b->raster};
    must(irb_shade_run_batch(b->shade, b->interleave[passes[pass].tiles], &lights, &b->ism,
                             &settings, &all, &err),
         &err);
}

static double time_pass(struct bench *b, int pass)
{
    struct irb_error err = {0};
    struct irb_interleave *il = b->interleave[3];
    b->gl->api.Finish();
    double start = irb_clock_s();
    if (pass < SHADE_PASSES)
        run_shade(b, pass);
    else if (pass == SPLIT)
        must(irb_interleave_split(il, b->gbuffer, &err), &err);
    else if (pass == MERGE)
        must(irb_interleave_merge(il, &err), &err);
    else
        must(irb_interleave_filter(il, b->gbuffer, 0.01f, 0.9f, b->out, &err), &err);
    b->gl->api.Finish();
    return 1e3 * (irb_clock_s() - start);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_results(const struct bench *b, double ms[PASSES][REPEATS])
{
    static const char *const others[] = {"split", "merge", "filter"};
    printf("%s, %d x %d pixels\n%-14s %6s %6s %8s %8s %8s\n", b->gl->renderer, WIDTH, HEIGHT,
           "pass", "lights", "tiles", "ms", "least", "M/s");
    for (int i = 0; i < PASSES; i++) {
        qsort(ms[i], REPEATS, sizeof(double), compare);
        if (i >= SHADE_PASSES) {
            printf("%-14s %6s %6s %8.1f %8.1f\n", others[i - SPLIT], "", "3 x 3",
                   ms[i][REPEATS / 2], ms[i][0]);
            continue;
        }
        const double pairs =
            (double)WIDTH * HEIGHT * passes[i].lights / (passes[i].tiles * passes[i].tiles);
        printf("%-14s %6d %2d x %d %8.1f %8.1f %8.1f\n", passes[i].name, passes[i].lights,
               passes[i].tiles, passes[i].tiles, ms[i][REPEATS / 2], ms[i][0],
               pairs / ms[i][REPEATS / 2] / 1e3);
    }
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
    struct bench b = {0};
    double ms[PASSES][REPEATS];
    const struct irb_gl_desc desc = {.backend = backend_of(argc, argv)};
    b.gl = irb_gl_create(&desc, &err);
    if (!b.gl) {
        printf("skipped: %s\n", err.message);
        return 77;
    }
    make(&b);
    for (int repeat = -1; repeat < REPEATS; repeat++) /* the first round compiles */
        for (int i = 0; i < PASSES; i++) {
            double t = time_pass(&b, i);
            if (repeat >= 0)
                ms[i][repeat] = t;
        }
    print_results(&b, ms);
    for (int n = 3; n <= 4; n++)
        irb_interleave_destroy(b.interleave[n]);
    irb_shade_destroy(b.shade);
    irb_raster_maps_destroy(b.raster);
    irb_texture_destroy(b.out);
    irb_texture_destroy(b.ism.atlas);
    irb_buffer_destroy(b.lights);
    irb_gbuffer_destroy(b.gbuffer);
    irb_scene_destroy(b.scene);
    irb_gl_destroy(b.gl);
    return 0;
}
