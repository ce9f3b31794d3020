/* SPDX-License-Identifier: MIT */
#include "core/lights/importance.h"
#include "core/frame/light_gl.h"

#include <stdlib.h>

/* Bindings and work groups of shaders/lights/importance*.comp. */
enum { STATE_BINDING = 0, SAMPLES_BINDING = 1, SAMPLES_UNIFORM_BINDING = 0 };
enum { TEXEL_GROUP = 8, SAMPLE_GROUP = 64 };
enum { STATE_BYTES = 8, SAMPLE_BYTES = 32 };
enum { SAMPLES_BYTES = IRB_IMPORTANCE_MOST_VIEW_SAMPLES * SAMPLE_BYTES };

struct irb_importance_passes {
    struct irb_buffer *state;         /* largest rho_f, as bits; view samples that are valid */
    struct irb_buffer *samples;       /* position and normal */
    struct irb_program *brdf, *final; /* for one layout of the RSM */
    struct irb_program *view;         /* for one layout of the G-buffer */
    enum irb_layout rsm_layout, gbuffer_layout;
};

struct irb_importance *irb_importance_create(struct irb_gl *gl, int rsm_resolution,
                                             struct irb_error *err)
{
    const struct irb_texture_desc map = {
        .name = "importance", .format = GL_R32F, .width = rsm_resolution, .height = rsm_resolution};
    struct irb_importance *importance = calloc(1, sizeof *importance);
    struct irb_importance_passes *own = calloc(1, sizeof *own);
    if (!importance || !own) {
        free(importance);
        free(own);
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    importance->gl = gl;
    importance->own = own;
    if ((importance->map = irb_texture_create(gl, &map, err)) &&
        (own->state = irb_buffer_create(gl, "importance: state", STATE_BYTES, NULL, err)) &&
        (own->samples = irb_buffer_create(gl, "importance: samples", SAMPLES_BYTES, NULL, err)))
        return importance;
    irb_importance_destroy(importance);
    return NULL;
}

static void destroy_program(struct irb_program **program)
{
    irb_program_destroy(*program);
    *program = NULL;
}

void irb_importance_destroy(struct irb_importance *importance)
{
    if (!importance)
        return;
    struct irb_importance_passes *own = importance->own;
    destroy_program(&own->brdf);
    destroy_program(&own->final);
    destroy_program(&own->view);
    irb_buffer_destroy(own->state);
    irb_buffer_destroy(own->samples);
    free(own);
    irb_texture_destroy(importance->map);
    free(importance);
}

static bool create_program(struct irb_gl *gl, struct irb_program **out, const char *name,
                           const char *path, const char *layout, struct irb_error *err)
{
    char samples[40];
    snprintf(samples, sizeof samples, "MOST_VIEW_SAMPLES %d", IRB_IMPORTANCE_MOST_VIEW_SAMPLES);
    const char *const defines[] = {layout, samples, NULL};
    if (!*out)
        *out = irb_program_create(
            gl, &(struct irb_program_desc){.name = name, .compute = path, .defines = defines}, err);
    return *out != NULL;
}

/* gbuffer: NULL without view samples. */
static bool prepare_programs(struct irb_importance *importance, const struct irb_rsm *rsm,
                             const struct irb_gbuffer *gbuffer, struct irb_error *err)
{
    struct irb_gl *gl = importance->gl;
    struct irb_importance_passes *own = importance->own;
    if (own->rsm_layout != rsm->layout) {
        destroy_program(&own->brdf);
        destroy_program(&own->final);
        own->rsm_layout = rsm->layout;
    }
    if (gbuffer && own->gbuffer_layout != gbuffer->layout) {
        destroy_program(&own->view);
        own->gbuffer_layout = gbuffer->layout;
    }
    const char *layout = irb_rsm_define(rsm->layout);
    return create_program(gl, &own->brdf, "importance: brdf", "lights/importance_brdf.comp", layout,
                          err) &&
           create_program(gl, &own->final, "importance", "lights/importance.comp", layout, err) &&
           (!gbuffer ||
            create_program(gl, &own->view, "importance: view", "lights/importance_view.comp",
                           irb_gbuffer_define(gbuffer->layout), err));
}

static void dispatch_texels(const struct irb_importance *importance)
{
    const struct irb_gl_api *api = &importance->gl->api;
    const unsigned groups = (unsigned)(importance->map->width + TEXEL_GROUP - 1) / TEXEL_GROUP;
    api->DispatchCompute(groups, groups, 1);
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                       GL_UNIFORM_BARRIER_BIT);
}

static void run_brdf(const struct irb_importance *importance, const struct irb_rsm *rsm,
                     const struct irb_light *light, float diffuse_weight)
{
    const struct irb_program *program = importance->own->brdf;
    irb_program_use(program);
    irb_rsm_bind(rsm, program, 0);
    irb_light_uniforms(light, program);
    irb_program_int(program, "resolution", rsm->resolution);
    irb_program_float(program, "half_extent", rsm->half_extent);
    irb_program_float(program, "diffuse_weight", diffuse_weight);
    dispatch_texels(importance);
}

static void run_view(const struct irb_importance *importance, const struct irb_gbuffer *gbuffer,
                     int samples, unsigned first)
{
    const struct irb_gl_api *api = &importance->gl->api;
    const struct irb_program *program = importance->own->view;
    irb_program_use(program);
    irb_gbuffer_bind(gbuffer, program, 0);
    irb_program_uint(program, "sample_count", (unsigned)samples);
    irb_program_uint(program, "first", first);
    api->DispatchCompute((unsigned)(samples + SAMPLE_GROUP - 1) / SAMPLE_GROUP, 1, 1);
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT);
}

static void run_final(const struct irb_importance *importance, const struct irb_rsm *rsm,
                      const struct irb_importance_settings *settings, int samples)
{
    const struct irb_program *program = importance->own->final;
    irb_program_use(program);
    irb_rsm_bind(rsm, program, 0);
    irb_program_int(program, "sample_count", samples);
    irb_program_float(program, "view_weight", settings->view_weight);
    irb_program_int(program, "normalise", settings->norm == IRB_IMPORTANCE_NORM_MAX);
    irb_program_int(program, "view_form", settings->view_form);
    irb_program_float(program, "view_nearest", settings->view_nearest);
    dispatch_texels(importance);
}

static bool check(const struct irb_importance *importance, const struct irb_rsm *rsm,
                  const struct irb_gbuffer *gbuffer, int samples, struct irb_error *err)
{
    if (rsm->resolution != importance->map->width)
        return irb_fail(err, IRB_E_INTERNAL, "importance: made for an RSM of %d texels, given %d",
                        importance->map->width, rsm->resolution);
    if (samples && (!gbuffer || samples < 0 || samples > IRB_IMPORTANCE_MOST_VIEW_SAMPLES))
        return irb_fail(err, IRB_E_INTERNAL, "importance: %d view samples of %s; at most %d",
                        samples, gbuffer ? "a G-buffer" : "no G-buffer",
                        IRB_IMPORTANCE_MOST_VIEW_SAMPLES);
    return true;
}

bool irb_importance_compute(struct irb_importance *importance, const struct irb_rsm *rsm,
                            const struct irb_light *light, const struct irb_gbuffer *gbuffer,
                            const struct irb_importance_settings *settings, struct irb_error *err)
{
    static const uint32_t zero[STATE_BYTES / 4] = {0};
    const struct irb_gl_api *api = &importance->gl->api;
    const struct irb_importance_passes *own = importance->own;
    const int samples = settings->view_weight > 0 ? settings->view_samples : 0;
    if (!check(importance, rsm, gbuffer, samples, err) ||
        !prepare_programs(importance, rsm, samples ? gbuffer : NULL, err) ||
        !irb_buffer_write(own->state, 0, STATE_BYTES, zero, err))
        return false;
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, STATE_BINDING, own->state->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, SAMPLES_BINDING, own->samples->id);
    api->BindBufferBase(GL_UNIFORM_BUFFER, SAMPLES_UNIFORM_BINDING, own->samples->id);
    api->BindImageTexture(0, importance->map->id, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32F);
    run_brdf(importance, rsm, light, settings->diffuse_weight);
    if (samples)
        run_view(importance, gbuffer, samples, settings->first);
    run_final(importance, rsm, settings, samples);
    api->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    return irb_gl_check(importance->gl, "importance", err);
}
