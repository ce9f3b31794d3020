/* SPDX-License-Identifier: MIT
 *
 * Speed of rsm's gather against bare loops of the same arithmetic, in one process, interleaved:
 * million pixel-samples a second, median of REPEATS. A bare loop is one pass over 1024 lights in
 * one uniform block: no sampling, no light count, no accumulation over blocks. It is timed with one
 * pixel an invocation, as such a loop is usually written, and with the tile of pixels that the
 * method uses on software rasterisers. The polar gather has bare loops of its own, in which each
 * pixel fetches texels for itself, and an RSM of 512 x 512. The method runs as it does in a frame,
 * for every pixel (gather_scale=1); its gather stage counts.
 *
 *     bench_rsm_gather [auto|osmesa|egl] [--check]
 *
 * --check: exit status 1 where a mode is below 60 % of one of its bare loops. 77 without a backend.
 */
#include "core/base/clock.h"
#include "core/frame/gbuffer.h"
#include "core/frame/rsm.h"
#include "core/scene/builtin.h"
#include "methods/method.h"
#include "methods/rsm/polar.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern const struct irb_method irb_method_rsm;
static const struct irb_method *const rsm = &irb_method_rsm;

/* Mode `all` takes every lit texel: of 40^2 about two thirds, so that all modes fill a block. */
enum { WIDTH = 512, HEIGHT = 384, RESOLUTION = 40, POLAR_RESOLUTION = 512, REPEATS = 11 };
enum { STAGE_GATHER = 1, BLOCK_LIGHTS = 1024, LIGHT_FLOATS = 12, GROUP = 8 };
enum { MODES = 5, BARE_LOOPS = 4, BARE = MODES, PASSES = MODES + BARE_LOOPS, POLAR_SAMPLES = 400 };

static const struct {
    const char *name, *mode, *samples, *fetch;
    int bare[2]; /* its yardsticks */
} modes[MODES] = {
    {"all", "all", "1024", "packed", {0, 1}},
    {"uniform", "uniform", "1024", "packed", {0, 1}},
    {"importance", "importance", "1024", "packed", {0, 1}},
    {"polar", "polar", "400", "packed", {2, 2}},
    {"polar, full", "polar", "400", "full", {3, 3}},
};
static const struct {
    const char *name, *shader, *define;
    int tile, samples;
} bare_loops[BARE_LOOPS] = {
    {"1 pixel", "methods/rsm/bench_bare_loop.comp", "TILE 1", 1, BLOCK_LIGHTS},
    {"4 x 4", "methods/rsm/bench_bare_loop.comp", "TILE 4", 4, BLOCK_LIGHTS},
    {"one fetch", "methods/rsm/bench_bare_polar.comp", "PACKED 1", 1, POLAR_SAMPLES},
    {"three fetches", "methods/rsm/bench_bare_polar.comp", "PACKED 0", 1, POLAR_SAMPLES},
};

static const double least_share = 0.6; /* of the bare loop */

struct bench {
    struct irb_gl *gl;
    struct irb_scene *scene;
    struct irb_scene_gl *scene_gl;
    struct irb_gbuffer *gbuffer;
    struct irb_rsm *rsm, *polar_rsm;
    struct rsm_polar *polar; /* its packed map is the bare loop's */
    struct irb_light light;
    struct irb_camera camera;
    struct irb_timer *timer;
    void *state[MODES], *params[MODES];
    double vpls[MODES];
    struct irb_program *bare[BARE_LOOPS];
    struct irb_buffer *lights;
    struct irb_texture *target;
};

static void must(bool ok, const struct irb_error *err)
{
    if (ok)
        return;
    fprintf(stderr, "bench_rsm_gather: %s\n", err->message);
    exit(irb_error_status(err->code));
}

static void make_frame(struct bench *b)
{
    struct irb_error err = {0};
    struct irb_animation animation;
    must((b->scene = irb_scene_load("cornell", NULL, &err)), &err);
    irb_builtin_find("cornell")->view(&animation);
    irb_animation_light(&animation, b->scene, 0, &b->light);
    irb_animation_camera(&animation, b->scene, 0, &b->camera);
    irb_animation_destroy(&animation);
    b->camera.position[2] = 0.05f; /* inside, so that every pixel shows geometry */
    b->camera.vertical_fov = 1.2f;
    must((b->scene_gl = irb_scene_gl_create(b->gl, b->scene, &err)), &err);
    must((b->gbuffer = irb_gbuffer_create(b->gl, WIDTH, HEIGHT, &err)), &err);
    must((b->rsm = irb_rsm_create(b->gl, RESOLUTION, &err)), &err);
    must(irb_gbuffer_render(b->gbuffer, b->scene_gl, &b->camera, &err), &err);
    must(irb_rsm_render(b->rsm, b->scene_gl, &b->light, &err), &err);
    must((b->polar_rsm = irb_rsm_create(b->gl, POLAR_RESOLUTION, &err)), &err);
    must(irb_rsm_render(b->polar_rsm, b->scene_gl, &b->light, &err), &err);
    must((b->polar = rsm_polar_create(b->gl, &err)), &err);
    const struct rsm_pattern pattern = {
        .samples = POLAR_SAMPLES, .radius = 0.3f, .resolution = POLAR_RESOLUTION};
    must(rsm_polar_prepare(b->polar, b->polar_rsm, &pattern, RSM_FETCH_PACKED, &err), &err);
    must((b->timer = irb_timer_create(b->gl, &err)), &err);
}

static void make_methods(struct bench *b)
{
    struct irb_error err = {0};
    for (int i = 0; i < MODES; i++) {
        b->params[i] = calloc(1, rsm->params_size);
        irb_options_default(rsm->params, b->params[i]);
        const char *const settings[][2] = {{"mode", modes[i].mode},
                                           {"samples", modes[i].samples},
                                           {"fetch", modes[i].fetch},
                                           {"gather_scale", "1"}};
        for (int k = 0; k < 4; k++)
            must(irb_option_set(rsm->params, b->params[i], settings[k][0], settings[k][1], &err),
                 &err);
        must((b->state[i] = rsm->create(b->gl, b->scene_gl, WIDTH, HEIGHT, b->params[i], &err)),
             &err);
    }
}

static void make_bare_loops(struct bench *b)
{
    struct irb_error err = {0};
    static float lights[BLOCK_LIGHTS * LIGHT_FLOATS];
    for (int i = 0; i < BLOCK_LIGHTS; i++) {
        float *light = lights + i * LIGHT_FLOATS;
        light[0] = 0.5f * (float)(i % 32) / 32;
        light[2] = 0.5f * (float)i / BLOCK_LIGHTS;
        light[5] = 1;
        light[8] = light[9] = light[10] = 1e-3f;
    }
    must((b->lights = irb_buffer_create(b->gl, "bare: lights", sizeof lights, lights, &err)), &err);
    for (int i = 0; i < BARE_LOOPS; i++) {
        const char *const defines[] = {bare_loops[i].define, NULL};
        const struct irb_program_desc program = {
            .name = "bare loop", .compute = bare_loops[i].shader, .defines = defines};
        must((b->bare[i] = irb_program_create(b->gl, &program, &err)), &err);
    }
    const struct irb_texture_desc target = {
        .name = "bare: target", .format = GL_RGBA32F, .width = WIDTH, .height = HEIGHT};
    must((b->target = irb_texture_create(b->gl, &target, &err)), &err);
}

static void bind_bare_loop(struct bench *b, const struct irb_program *program, int samples)
{
    const struct irb_gl_api *api = &b->gl->api;
    const struct {
        const char *name;
        const struct irb_texture *texture;
    } inputs[] = {
        {"gbuffer_position", b->gbuffer->position}, {"gbuffer_normal", b->gbuffer->normal},
        {"packed_rsm", b->polar->packed},           {"rsm_position", b->polar_rsm->position},
        {"rsm_normal", b->polar_rsm->normal},       {"rsm_flux", b->polar_rsm->flux},
    };
    irb_program_use(program);
    for (unsigned i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        api->BindTextureUnit(i, inputs[i].texture->id);
        irb_program_int(program, inputs[i].name, (int)i);
    }
    irb_program_int(program, "sample_count", samples);
    api->BindBufferBase(GL_UNIFORM_BUFFER, 0, b->lights->id);
    api->BindImageTexture(0, b->target->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
}

static double time_bare_loop(struct bench *b, int loop)
{
    const unsigned side = (unsigned)(GROUP * bare_loops[loop].tile);
    struct irb_error err = {0};
    double ms[IRB_MAX_STAGES];
    irb_timer_begin(b->timer, STAGE_GATHER);
    bind_bare_loop(b, b->bare[loop], bare_loops[loop].samples);
    b->gl->api.DispatchCompute(WIDTH / side, HEIGHT / side, 1);
    irb_timer_end(b->timer);
    irb_timer_collect(b->timer, ms);
    must(irb_gl_check(b->gl, "bare loop", &err), &err);
    return ms[STAGE_GATHER];
}

static double time_method(struct bench *b, int mode)
{
    struct irb_error err = {0};
    double ms[IRB_MAX_STAGES];
    struct irb_frame_output out;
    const struct irb_frame_inputs inputs = {.scene = b->scene_gl,
                                            .light = &b->light,
                                            .camera = &b->camera,
                                            .gbuffer = b->gbuffer,
                                            .rsm = strcmp(modes[mode].mode, "polar") ? b->rsm
                                                                                     : b->polar_rsm,
                                            .params = b->params[mode],
                                            .timer = b->timer};
    must(rsm->render_frame(b->state[mode], &inputs, &out, &err), &err);
    irb_timer_collect(b->timer, ms);
    b->vpls[mode] = out.statistics[0].value;
    return ms[STAGE_GATHER];
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Medians in million pixel-samples a second; false where one is below the share that is asked. */
static bool print_result(const struct bench *b, double ms[PASSES][REPEATS])
{
    double rate[PASSES];
    bool fast = true;
    printf("%s, clock %s\n", b->gl->renderer, irb_timer_clock(b->timer));
    printf("%-14s %8s %8s\n", "gather", "samples", "M/s");
    for (int i = PASSES - 1; i >= 0; i--) {
        double samples = i >= BARE ? bare_loops[i - BARE].samples : b->vpls[i];
        const char *name = i >= BARE ? bare_loops[i - BARE].name : modes[i].name;
        qsort(ms[i], REPEATS, sizeof(double), compare);
        rate[i] = WIDTH * HEIGHT * samples / (ms[i][REPEATS / 2] * 1e3);
        printf("%-14s %8.0f %8.0f", name, samples, rate[i]);
        for (int k = 0; k < 2 && i < BARE; k++) {
            const int loop = modes[i].bare[k];
            if (k && loop == modes[i].bare[0])
                continue;
            printf("  %.0f %% of %s", 100 * rate[i] / rate[BARE + loop], bare_loops[loop].name);
            fast = fast && rate[i] >= least_share * rate[BARE + loop];
        }
        printf("%s\n", i >= BARE ? "  (bare loop)" : "");
    }
    return fast;
}

static void destroy(struct bench *b)
{
    for (int i = 0; i < MODES; i++) {
        rsm->destroy(b->state[i]);
        free(b->params[i]);
    }
    for (int i = 0; i < BARE_LOOPS; i++)
        irb_program_destroy(b->bare[i]);
    irb_buffer_destroy(b->lights);
    irb_texture_destroy(b->target);
    irb_timer_destroy(b->timer);
    irb_rsm_destroy(b->rsm);
    irb_rsm_destroy(b->polar_rsm);
    rsm_polar_destroy(b->polar);
    irb_gbuffer_destroy(b->gbuffer);
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
    struct bench b = {0};
    double ms[PASSES][REPEATS];
    struct irb_gl_desc desc = {.backend = backend_of(argc, argv)};
    b.gl = irb_gl_create(&desc, &err);
    if (!b.gl) {
        printf("skipped: %s\n", err.message);
        return 77;
    }
    make_frame(&b);
    make_methods(&b);
    make_bare_loops(&b);
    for (int repeat = -1; repeat < REPEATS; repeat++) /* the first round compiles */
        for (int i = 0; i < PASSES; i++) {
            double t = i >= BARE ? time_bare_loop(&b, i - BARE) : time_method(&b, i);
            if (repeat >= 0)
                ms[i][repeat] = t;
        }
    bool fast = print_result(&b, ms);
    destroy(&b);
    return fast || argc < 3 || strcmp(argv[2], "--check") ? 0 : 1;
}
