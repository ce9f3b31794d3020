/* SPDX-License-Identifier: MIT
 *
 * A method module for tests of a whole run, with debug layers, statistics and a parameter that may
 * have keys. Its irradiance is clusters/64 in every pixel; with IRB_TEST_HISTORY it keeps half of
 * the frame before's and adds half of that.
 */
#include "core/gl/objects.h"
#include "methods/method.h"

#include <GL/glcorearb.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ATLAS = 16, ATLAS_HEIGHT = 8, MOST_EXTRA = 60 };

struct params {
    int clusters;
    float distance;
    int extra;
};

static const struct irb_option options[] = {
    IRB_OPTION_INT(struct params, clusters, 16, 1, 512, "", "irradiance times 64", "ours"),
    IRB_OPTION_FLOAT(struct params, distance, 2, 0, 100, "m", "in the atlas", "ours"),
    IRB_OPTION_INT(struct params, extra, 0, 0, MOST_EXTRA, "",
                   "statistics beside its two, and debug layers beside its three", "ours"),
    IRB_OPTION_END,
};
static const char *const stages[] = {"warp", "average", "light", NULL};
enum { STAGE_WARP, STAGE_AVERAGE, STAGE_LIGHT };

struct state {
    struct irb_gl *gl;
    struct irb_texture *irradiance, *map, *split, *atlas; /* all but the first made on demand */
    int width, height, frames;
    float light;
    char names[MOST_EXTRA][16]; /* of what is extra */
};

static struct irb_texture *make(struct state *s, unsigned format, int width, int height,
                                struct irb_error *err)
{
    return irb_texture_create(
        s->gl,
        &(struct irb_texture_desc){
            .name = "test", .format = format, .width = width, .height = height},
        err);
}

static void *create(struct irb_gl *gl, const struct irb_scene_gl *scene, int width, int height,
                    const void *params, struct irb_error *err)
{
    (void)scene, (void)params;
    struct state *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    *s = (struct state){.gl = gl, .width = width, .height = height};
    s->irradiance = make(s, GL_RGBA32F, width, height, err);
    for (int i = 0; i < MOST_EXTRA; i++)
        snprintf(s->names[i], sizeof s->names[i], "extra-%d", i);
    return s;
}

static bool resize(void *state, int width, int height, struct irb_error *err)
{
    (void)state, (void)width, (void)height;
    return irb_fail(err, IRB_E_INTERNAL, "not for this");
}

static bool begin_sequence(void *state, const void *params, uint64_t seed, struct irb_error *err)
{
    (void)params, (void)seed, (void)err;
    struct state *s = state;
    s->frames = 0;
    s->light = 0;
    return true;
}

/* Three layers: of the image's size, half of it, and an atlas. */
static bool add_debug(struct state *s, const struct params *p, struct irb_frame_output *out,
                      struct irb_error *err)
{
    const struct irb_gl_api *api = &s->gl->api;
    if (!s->map && (!(s->map = make(s, GL_RGBA32F, s->width, s->height, err)) ||
                    !(s->split = make(s, GL_RGBA32F, s->width / 2, s->height / 2, err)) ||
                    !(s->atlas = make(s, GL_R32UI, ATLAS, ATLAS_HEIGHT, err))))
        return false;
    const float colour[] = {(float)p->clusters / 512, 0.25f, 0.5f, 1};
    uint32_t bits, infinity = 0x7f800000;
    memcpy(&bits, &p->distance, sizeof bits);
    api->ClearTexImage(s->map->id, 0, GL_RGBA, GL_FLOAT, colour);
    api->ClearTexImage(s->split->id, 0, GL_RGBA, GL_FLOAT, colour);
    api->ClearTexImage(s->atlas->id, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &infinity);
    api->ClearTexSubImage(s->atlas->id, 0, 0, 0, 0, ATLAS / 2, ATLAS_HEIGHT, 1, GL_RED_INTEGER,
                          GL_UNSIGNED_INT, &bits);
    out->debug_count = 3;
    out->debug[0].name = "cluster-map";
    out->debug[0].texture = s->map;
    out->debug[1].name = "split";
    out->debug[1].texture = s->split;
    out->debug[1].kind = IRB_DEBUG_RADIANCE;
    out->debug[2].name = "ism-atlas";
    out->debug[2].texture = s->atlas;
    out->debug[2].kind = IRB_DEBUG_DISTANCE;
    for (int i = 0; i < p->extra; i++)
        irb_output_layer(out, s->names[i], s->map, IRB_DEBUG_COLOUR);
    return true;
}

static bool render_frame(void *state, const struct irb_frame_inputs *inputs,
                         struct irb_frame_output *output, struct irb_error *err)
{
    struct state *s = state;
    const struct params *p = inputs->params;
    const float light = (float)p->clusters / 64;
    irb_timer_begin(inputs->timer, STAGE_WARP);
    s->light = IRB_TEST_HISTORY ? 0.5f * s->light + 0.5f * light : light;
    s->frames++;
    irb_timer_end(inputs->timer);
    irb_timer_begin(inputs->timer, STAGE_LIGHT);
    const float texel[] = {s->light, s->light, s->light, 0};
    s->gl->api.ClearTexImage(s->irradiance->id, 0, GL_RGBA, GL_FLOAT, texel);
    irb_timer_end(inputs->timer);
    *output = (struct irb_frame_output){
        .irradiance = s->irradiance,
        .uncovered_flux = 0.25,
        .clamped_light = inputs->frame % 2 ? 0.5 : NAN,
        .statistics = {{"split_share", inputs->frame % 2 ? 0.5 : 0.25}, {"clusters", p->clusters}},
        .statistic_count = 2,
    };
    for (int i = 0; i < p->extra; i++)
        irb_output_statistic(output, s->names[i], i);
    return !inputs->debug || add_debug(s, p, output, err);
}

static void destroy(void *state)
{
    struct state *s = state;
    irb_texture_destroy(s->irradiance);
    irb_texture_destroy(s->map);
    irb_texture_destroy(s->split);
    irb_texture_destroy(s->atlas);
    free(s);
}

static unsigned needs(const void *params)
{
    (void)params;
    return IRB_TEST_HISTORY ? IRB_NEEDS_HISTORY : IRB_NEEDS_NOTHING;
}

static const struct irb_method method = {
    .abi = IRB_METHOD_ABI,
    .name = IRB_TEST_HISTORY ? "test-history" : "test-debug",
    .title = "A method for tests",
    .citation = "none",
    .path_classes = "LDDE",
    .params_size = sizeof(struct params),
    .params = options,
    .stages = stages,
    .needs = needs,
    .create = create,
    .resize = resize,
    .begin_sequence = begin_sequence,
    .render_frame = render_frame,
    .destroy = destroy,
};

const struct irb_method *irb_method_module(void);
const struct irb_method *irb_method_module(void)
{
    return &method;
}
