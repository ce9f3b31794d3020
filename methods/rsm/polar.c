/* SPDX-License-Identifier: MIT */
#include "methods/rsm/polar.h"

#include "core/sampling/halton.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const rsm_weight_names[] = {"xi2", "xi1", NULL};
const char *const rsm_fetch_names[] = {"packed", "full", NULL};

/* Side of the square of pixels that an invocation gathers for on software rasterisers. */
enum { TILE = 2, PACK_GROUP = 8 };
/* PACKED_FLUX_STEPS of shaders/methods/rsm/packed.glsl. */
static const float flux_steps = 1024;
/* Below it a light is dark: flux_steps over its flux would leave a float's range. W. */
static const float least_flux = 1e-30f;

struct rsm_polar *rsm_polar_create(struct irb_gl *gl, struct irb_error *err)
{
    struct rsm_polar *polar = calloc(1, sizeof *polar);
    if (!polar) {
        irb_fail(err, IRB_E_MEMORY, "rsm: out of memory");
        return NULL;
    }
    rsm_programs_init(&polar->programs, gl, "methods/rsm/polar.comp", TILE);
    return polar;
}

void rsm_polar_destroy(struct rsm_polar *polar)
{
    if (!polar)
        return;
    rsm_programs_destroy(&polar->programs);
    irb_program_destroy(polar->pack[IRB_LAYOUT_FULL]);
    irb_program_destroy(polar->pack[IRB_LAYOUT_SLIM]);
    irb_texture_destroy(polar->packed);
    irb_buffer_destroy(polar->samples);
    free(polar);
}

static void halton(const struct rsm_pattern *pattern, int i, float xi[2])
{
    irb_halton_2d(pattern->first + (uint32_t)i + 1, xi);
}

double rsm_pattern_square_sum(const struct rsm_pattern *pattern)
{
    double sum = 0;
    for (int i = 0; i < pattern->samples; i++) {
        float xi[2];
        halton(pattern, i, xi);
        sum += (double)xi[0] * xi[0];
    }
    return sum;
}

/* Offset r_max xi_1 (cos 2 pi xi_2, sin 2 pi xi_2). A sample's density per area is
 * 1/(2 pi r_max^2 xi_1), so that XI1 is 1/(N density); XI2 gives the disc's area in all. */
void rsm_pattern_sample(const struct rsm_pattern *pattern, double square_sum, int i, float out[3])
{
    float xi[2];
    halton(pattern, i, xi);
    const double radius = (double)pattern->radius * pattern->resolution; /* texels */
    const double angle = 2 * M_PI * xi[1];
    out[0] = (float)(radius * xi[0] * cos(angle));
    out[1] = (float)(radius * xi[0] * sin(angle));
    if (pattern->weight == RSM_WEIGHT_XI1)
        out[2] = (float)(2 * M_PI * radius * radius * xi[0] / pattern->samples);
    else
        out[2] = square_sum > 0 ? (float)(M_PI * radius * radius * xi[0] * xi[0] / square_sum) : 0;
}

static bool make_pattern(struct rsm_polar *polar, const struct rsm_pattern *pattern,
                         struct irb_error *err)
{
    const int64_t blocks = (pattern->samples + (int64_t)RSM_PATTERN_BLOCK - 1) / RSM_PATTERN_BLOCK;
    const int64_t bytes = blocks * RSM_PATTERN_BLOCK * RSM_PATTERN_BYTES;
    if (polar->samples && !memcmp(&polar->pattern, pattern, sizeof *pattern))
        return true;
    float *samples = calloc(1, (size_t)bytes);
    if (!samples)
        return irb_fail(err, IRB_E_MEMORY, "rsm: out of memory for %d samples", pattern->samples);
    const double square_sum = rsm_pattern_square_sum(pattern);
    for (int i = 0; i < pattern->samples; i++)
        rsm_pattern_sample(pattern, square_sum, i, samples + 4 * (size_t)i);
    irb_buffer_destroy(polar->samples);
    polar->samples = irb_buffer_create(polar->programs.gl, "rsm: pattern", bytes, samples, err);
    polar->pattern = *pattern;
    free(samples);
    return polar->samples != NULL;
}

static bool make_packed_texture(struct rsm_polar *polar, int side, struct irb_error *err)
{
    if (polar->packed && polar->packed->width == side)
        return true;
    irb_texture_destroy(polar->packed);
    polar->packed = irb_texture_create(
        polar->programs.gl,
        &(struct irb_texture_desc){
            .name = "rsm: packed", .format = GL_RGBA32UI, .width = side, .height = side},
        err);
    return polar->packed != NULL;
}

static bool pack(struct rsm_polar *polar, const struct irb_rsm *rsm, struct irb_error *err)
{
    const struct irb_gl_api *api = &polar->programs.gl->api;
    struct irb_program **program = &polar->pack[rsm->layout];
    const int side = rsm->resolution + 2;
    const unsigned groups = (unsigned)(side + PACK_GROUP - 1) / PACK_GROUP;
    const float largest = irb_rsm_largest_flux(rsm);

    if (!*program) {
        const char *const defines[] = {irb_rsm_define(rsm->layout), NULL};
        *program = irb_program_create(polar->programs.gl,
                                      &(struct irb_program_desc){.name = "rsm: pack",
                                                                 .compute = "methods/rsm/pack.comp",
                                                                 .defines = defines},
                                      err);
    }
    if (!*program || !make_packed_texture(polar, side, err))
        return false;
    irb_program_use(*program);
    irb_rsm_bind(rsm, *program, 0);
    irb_program_float(*program, "flux_unit", largest > least_flux ? flux_steps / largest : 0);
    api->BindImageTexture(0, polar->packed->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32UI);
    api->DispatchCompute(groups, groups, 1);
    api->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return irb_gl_check(polar->programs.gl, "rsm: pack", err);
}

bool rsm_polar_prepare(struct rsm_polar *polar, const struct irb_rsm *rsm,
                       const struct rsm_pattern *pattern, int fetch, struct irb_error *err)
{
    return make_pattern(polar, pattern, err) && (fetch == RSM_FETCH_FULL || pack(polar, rsm, err));
}

static const struct irb_program *bind(struct rsm_polar *polar, const struct rsm_pixels *pixels,
                                      const struct irb_rsm *rsm, const struct rsm_polar_settings *s,
                                      struct irb_error *err)
{
    const bool packed = s->fetch == RSM_FETCH_PACKED;
    const unsigned variant = (s->bound > 0 ? RSM_CLAMPED : 0u) | (packed ? RSM_PACKED : 0u) |
                             (s->normal_offset > 0 ? RSM_OFFSET : 0u) |
                             (rsm->layout == IRB_LAYOUT_SLIM ? RSM_SLIM_RSM : 0u);
    const struct irb_program *program = rsm_programs_get(&polar->programs, variant, pixels, err);
    if (!program)
        return NULL;
    int unit = rsm_pixels_bind(pixels, program, 0);
    unit = irb_rsm_bind(rsm, program, unit);
    if (packed) {
        polar->programs.gl->api.BindTextureUnit((GLuint)unit, polar->packed->id);
        irb_program_int(program, "packed_rsm", unit);
        irb_program_float(program, "flux_unit", irb_rsm_largest_flux(rsm) / flux_steps);
    }
    irb_program_float(program, "bound", s->bound);
    irb_program_float(program, "normal_offset", s->normal_offset);
    return program;
}

bool rsm_polar_run(struct rsm_polar *polar, const struct rsm_pixels *pixels,
                   const struct irb_rsm *rsm, const struct rsm_polar_settings *settings,
                   struct irb_error *err)
{
    const struct irb_gl_api *api = &polar->programs.gl->api;
    const struct irb_program *program = bind(polar, pixels, rsm, settings, err);
    const int64_t block_bytes = (int64_t)RSM_PATTERN_BLOCK * RSM_PATTERN_BYTES;
    if (!program)
        return false;
    for (int begin = 0; begin < polar->pattern.samples; begin += RSM_PATTERN_BLOCK) {
        const int rest = polar->pattern.samples - begin;
        irb_program_int(program, "sample_count",
                        rest < RSM_PATTERN_BLOCK ? rest : RSM_PATTERN_BLOCK);
        irb_program_int(program, "first_block", begin == 0);
        api->BindBufferRange(GL_UNIFORM_BUFFER, 0, polar->samples->id,
                             (GLintptr)begin * RSM_PATTERN_BYTES, block_bytes);
        rsm_pixels_dispatch(&polar->programs, pixels);
    }
    return rsm_pixels_finish(pixels, "rsm: polar gather", err);
}
