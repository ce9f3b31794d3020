/* SPDX-License-Identifier: MIT */
#include "methods/rsm/lowres.h"

#include <math.h>
#include <stdlib.h>

/* Work groups and bindings of shaders/methods/rsm/interpolate.comp and list.comp. */
enum { PIXEL_GROUP = 8, RUN_GROUP = 64 };
enum { FLAGS_BINDING = 0, LIST_BINDING = 1, WORK_BINDING = 2, RUNS_BINDING = 3 };
enum { WORK_LISTED = 3, WORK_COVERED = 4, WORK_WORDS = 8 };

/* About the square root: balances the parallel passes and the sequential scan between them. */
static unsigned run_length_of(const struct rsm_lowres *lowres)
{
    unsigned length = (unsigned)sqrt((double)lowres->width * lowres->height);
    return length > 0 ? length : 1;
}

static unsigned run_count_of(const struct rsm_lowres *lowres)
{
    const unsigned pixels = (unsigned)lowres->width * (unsigned)lowres->height;
    return (pixels + run_length_of(lowres) - 1) / run_length_of(lowres);
}

static struct irb_program *create_pass(struct irb_gl *gl, const char *name, const char *define,
                                       struct irb_error *err)
{
    const char *const defines[] = {define, NULL};
    return irb_program_create(gl,
                              &(struct irb_program_desc){.name = name,
                                                         .compute = "methods/rsm/list.comp",
                                                         .defines = defines},
                              err);
}

static bool create_objects(struct rsm_lowres *l, struct irb_error *err)
{
    const int64_t pixels = (int64_t)l->width * l->height;
    const struct irb_texture_desc image = {.name = "rsm: low-resolution irradiance",
                                           .format = GL_RGBA32F,
                                           .width = (l->width + l->scale - 1) / l->scale,
                                           .height = (l->height + l->scale - 1) / l->scale};
    return (l->image = irb_texture_create(l->gl, &image, err)) &&
           (l->flags = irb_buffer_create(l->gl, "rsm: flags", 4 * pixels, NULL, err)) &&
           (l->list = irb_buffer_create(l->gl, "rsm: list", 4 * pixels, NULL, err)) &&
           (l->work = irb_buffer_create(l->gl, "rsm: work", 4 * WORK_WORDS, NULL, err)) &&
           (l->runs =
                irb_buffer_create(l->gl, "rsm: runs", 8 * (int64_t)run_count_of(l), NULL, err)) &&
           (l->count = create_pass(l->gl, "rsm: count", "PASS 0", err)) &&
           (l->scan = create_pass(l->gl, "rsm: scan", "PASS 1", err)) &&
           (l->write = create_pass(l->gl, "rsm: list", "PASS 2", err));
}

struct rsm_lowres *rsm_lowres_create(struct irb_gl *gl, int width, int height, int scale,
                                     struct irb_error *err)
{
    struct rsm_lowres *lowres = calloc(1, sizeof *lowres);
    if (!lowres) {
        irb_fail(err, IRB_E_MEMORY, "rsm: out of memory");
        return NULL;
    }
    lowres->gl = gl;
    lowres->width = width;
    lowres->height = height;
    lowres->scale = scale;
    if (create_objects(lowres, err))
        return lowres;
    rsm_lowres_destroy(lowres);
    return NULL;
}

void rsm_lowres_destroy(struct rsm_lowres *lowres)
{
    if (!lowres)
        return;
    irb_texture_destroy(lowres->image);
    irb_buffer_destroy(lowres->flags);
    irb_buffer_destroy(lowres->list);
    irb_buffer_destroy(lowres->work);
    irb_buffer_destroy(lowres->runs);
    irb_program_destroy(lowres->interpolate[IRB_LAYOUT_FULL]);
    irb_program_destroy(lowres->interpolate[IRB_LAYOUT_SLIM]);
    irb_program_destroy(lowres->count);
    irb_program_destroy(lowres->scan);
    irb_program_destroy(lowres->write);
    free(lowres);
}

static bool interpolate(struct rsm_lowres *lowres, const struct irb_gbuffer *gbuffer,
                        const struct rsm_agreement *agreement, const struct irb_texture *irradiance,
                        struct irb_error *err)
{
    const struct irb_gl_api *api = &lowres->gl->api;
    struct irb_program **program = &lowres->interpolate[gbuffer->layout];
    if (!*program) {
        const char *const defines[] = {irb_gbuffer_define(gbuffer->layout), NULL};
        const struct irb_program_desc desc = {.name = "rsm: interpolate",
                                              .compute = "methods/rsm/interpolate.comp",
                                              .defines = defines};
        *program = irb_program_create(lowres->gl, &desc, err);
    }
    if (!*program)
        return false;
    irb_program_use(*program);
    const int unit = irb_gbuffer_bind(gbuffer, *program, 0);
    api->BindTextureUnit((GLuint)unit, lowres->image->id);
    irb_program_int(*program, "low", unit);
    irb_program_int(*program, "scale", lowres->scale);
    irb_program_float(*program, "position_threshold", agreement->position);
    irb_program_float(*program, "normal_threshold", agreement->normal);
    api->BindImageTexture(0, irradiance->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    api->DispatchCompute((unsigned)(lowres->width + PIXEL_GROUP - 1) / PIXEL_GROUP,
                         (unsigned)(lowres->height + PIXEL_GROUP - 1) / PIXEL_GROUP, 1);
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return true;
}

static void run_pass(const struct rsm_lowres *lowres, const struct irb_program *program,
                     unsigned groups, int group_pixels)
{
    const struct irb_gl_api *api = &lowres->gl->api;
    irb_program_use(program);
    irb_program_uint(program, "pixels", (unsigned)lowres->width * (unsigned)lowres->height);
    irb_program_uint(program, "width", (unsigned)lowres->width);
    irb_program_uint(program, "run_length", run_length_of(lowres));
    irb_program_uint(program, "run_count", run_count_of(lowres));
    irb_program_uint(program, "group_pixels", (unsigned)group_pixels);
    api->DispatchCompute(groups, 1, 1);
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

bool rsm_lowres_interpolate(struct rsm_lowres *lowres, const struct irb_gbuffer *gbuffer,
                            const struct rsm_agreement *agreement,
                            const struct irb_texture *irradiance, int group_pixels,
                            struct irb_error *err)
{
    const struct irb_gl_api *api = &lowres->gl->api;
    const unsigned groups = (run_count_of(lowres) + RUN_GROUP - 1) / RUN_GROUP;
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, FLAGS_BINDING, lowres->flags->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, LIST_BINDING, lowres->list->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, WORK_BINDING, lowres->work->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, RUNS_BINDING, lowres->runs->id);
    if (!interpolate(lowres, gbuffer, agreement, irradiance, err))
        return false;
    run_pass(lowres, lowres->count, groups, group_pixels);
    run_pass(lowres, lowres->scan, 1, group_pixels);
    run_pass(lowres, lowres->write, groups, group_pixels);
    return irb_gl_check(lowres->gl, "rsm: interpolate", err);
}

bool rsm_lowres_share(struct rsm_lowres *lowres, double *share, struct irb_error *err)
{
    uint32_t work[WORK_WORDS];
    if (!irb_buffer_read(lowres->work, 0, sizeof work, work, err))
        return false;
    *share = work[WORK_COVERED] ? (double)work[WORK_LISTED] / work[WORK_COVERED] : 0;
    return true;
}
