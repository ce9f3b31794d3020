/* SPDX-License-Identifier: MIT */
#include "methods/rsm/pixels.h"

#include <stdio.h>

#include "core/lights/vpl.h"
#include "methods/rsm/polar.h"

/* Work group side in shaders/methods/rsm/pixels.glsl. */
enum { GROUP = 8 };
enum { LIST_BINDING = 1, WORK_BINDING = 2 };

void rsm_programs_init(struct rsm_programs *programs, struct irb_gl *gl, const char *shader,
                       int software_tile)
{
    *programs =
        (struct rsm_programs){.gl = gl, .shader = shader, .tile = gl->software ? software_tile : 1};
}

void rsm_programs_destroy(struct rsm_programs *programs)
{
    for (int i = 0; i < RSM_VARIANTS; i++)
        irb_program_destroy(programs->program[i]);
    *programs = (struct rsm_programs){0};
}

const struct irb_program *rsm_programs_get(struct rsm_programs *programs, unsigned variant,
                                           const struct rsm_pixels *pixels, struct irb_error *err)
{
    const bool slim = pixels->gbuffer->layout == IRB_LAYOUT_SLIM;
    variant |= (pixels->list ? RSM_LIST : 0u) | (slim ? RSM_SLIM_GBUFFER : 0u);
    struct irb_program **program = &programs->program[variant];
    char tile[32], lights[32], pattern[32];
    if (*program)
        return *program;
    snprintf(tile, sizeof tile, "TILE %d", programs->tile);
    snprintf(lights, sizeof lights, "VPL_BLOCK %d", IRB_VPL_BLOCK);
    snprintf(pattern, sizeof pattern, "PATTERN_BLOCK %d", RSM_PATTERN_BLOCK);
    const char *defines[10] = {
        tile,
        lights,
        pattern,
        variant & RSM_LIST ? "LIST 1" : "LIST 0",
        variant & RSM_PACKED ? "PACKED 1" : "PACKED 0",
        irb_gbuffer_define(pixels->gbuffer->layout),
        irb_rsm_define(variant & RSM_SLIM_RSM ? IRB_LAYOUT_SLIM : IRB_LAYOUT_FULL),
    };
    int count = 7;
    if (variant & RSM_CLAMPED)
        defines[count++] = "CLAMPED 1";
    if (variant & RSM_OFFSET)
        defines[count++] = "OFFSET 1";
    *program = irb_program_create(programs->gl,
                                  &(struct irb_program_desc){.name = programs->shader,
                                                             .compute = programs->shader,
                                                             .defines = defines},
                                  err);
    return *program;
}

int rsm_programs_group_pixels(const struct rsm_programs *programs)
{
    return GROUP * GROUP * programs->tile * programs->tile;
}

int rsm_pixels_bind(const struct rsm_pixels *pixels, const struct irb_program *program,
                    int first_unit)
{
    const struct irb_gl_api *api = &pixels->gbuffer->gl->api;
    irb_program_use(program);
    irb_program_int(program, "scale", pixels->scale);
    api->BindImageTexture(0, pixels->target->id, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    if (pixels->list) {
        api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, LIST_BINDING, pixels->list->id);
        api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, WORK_BINDING, pixels->work->id);
    }
    return irb_gbuffer_bind(pixels->gbuffer, program, first_unit);
}

void rsm_pixels_dispatch(const struct rsm_programs *programs, const struct rsm_pixels *pixels)
{
    const struct irb_gl_api *api = &programs->gl->api;
    const int side = GROUP * programs->tile;
    if (pixels->list) {
        api->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pixels->work->id);
        api->DispatchComputeIndirect(0);
        api->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    } else {
        api->DispatchCompute((unsigned)((pixels->target->width + side - 1) / side),
                             (unsigned)((pixels->target->height + side - 1) / side), 1);
    }
    api->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

bool rsm_pixels_finish(const struct rsm_pixels *pixels, const char *site, struct irb_error *err)
{
    struct irb_gl *gl = pixels->gbuffer->gl;
    gl->api.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                          GL_FRAMEBUFFER_BARRIER_BIT);
    return irb_gl_check(gl, site, err);
}
