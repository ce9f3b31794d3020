/* SPDX-License-Identifier: MIT */
#include "methods/rsm/gather.h"

#include <stdio.h>
#include <stdlib.h>

/* Work group of shaders/methods/rsm/gather.comp, and of lost_energy.comp. */
enum { GROUP = 8, ROW_GROUP = 64 };

/* Side of the square of pixels that an invocation gathers for. llvmpipe: 4 runs about five times as
 * fast as 1, since loading a light costs more there than using it. Hardware loads uniforms through
 * a cache that all lanes share and wants many invocations instead. Source: ours. */
enum { TILE_SOFTWARE = 4, TILE_HARDWARE = 1 };

static struct irb_program *create_program(struct irb_gl *gl, const char *name, int tile,
                                          bool clamped, struct irb_error *err)
{
    char tile_define[32], block_define[32];
    snprintf(tile_define, sizeof tile_define, "TILE %d", tile);
    snprintf(block_define, sizeof block_define, "VPL_BLOCK %d", IRB_VPL_BLOCK);
    const char *const defines[] = {tile_define, block_define, clamped ? "CLAMPED 1" : NULL, NULL};
    return irb_program_create(gl,
                              &(struct irb_program_desc){.name = name,
                                                         .compute = "methods/rsm/gather.comp",
                                                         .defines = defines},
                              err);
}

struct rsm_gather *rsm_gather_create(struct irb_gl *gl, int width, int height,
                                     struct irb_error *err)
{
    struct rsm_gather *g = calloc(1, sizeof *g);
    if (!g) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    g->gl = gl;
    g->tile = gl->software ? TILE_SOFTWARE : TILE_HARDWARE;
    const struct irb_texture_desc desc = {
        .name = "rsm: irradiance", .format = GL_RGBA32F, .width = width, .height = height};
    const struct irb_program_desc energy = {.name = "rsm: lost energy",
                                            .compute = "methods/rsm/lost_energy.comp"};
    if ((g->irradiance = irb_texture_create(gl, &desc, err)) &&
        (g->rows = irb_buffer_create(gl, "rsm: row sums", height * (int64_t)8, NULL, err)) &&
        (g->plain = create_program(gl, "rsm: gather", g->tile, false, err)) &&
        (g->clamped = create_program(gl, "rsm: clamped gather", g->tile, true, err)) &&
        (g->energy = irb_program_create(gl, &energy, err)))
        return g;
    rsm_gather_destroy(g);
    return NULL;
}

void rsm_gather_destroy(struct rsm_gather *gather)
{
    if (!gather)
        return;
    irb_texture_destroy(gather->irradiance);
    irb_program_destroy(gather->plain);
    irb_program_destroy(gather->clamped);
    irb_program_destroy(gather->energy);
    irb_buffer_destroy(gather->rows);
    free(gather);
}

/* One dispatch a block; no lights at all still take one, which writes zeros. */
bool rsm_gather_run(struct rsm_gather *gather, const struct irb_gbuffer *gbuffer,
                    const struct irb_vpl_set *lights, float bound, struct irb_error *err)
{
    const struct irb_gl_api *api = &gather->gl->api;
    const struct irb_program *program = bound > 0 ? gather->clamped : gather->plain;
    const int blocks = irb_vpl_set_blocks(lights) > 0 ? irb_vpl_set_blocks(lights) : 1;
    const int side = GROUP * gather->tile;
    const unsigned columns = (unsigned)((gather->irradiance->width + side - 1) / side);
    const unsigned rows = (unsigned)((gather->irradiance->height + side - 1) / side);
    const int64_t block_bytes = (int64_t)IRB_VPL_BLOCK * IRB_VPL_BYTES;

    irb_program_use(program);
    api->BindTextureUnit(0, gbuffer->position->id);
    api->BindTextureUnit(1, gbuffer->normal->id);
    irb_program_int(program, "gbuffer_position", 0);
    irb_program_int(program, "gbuffer_normal", 1);
    irb_program_float(program, "bound", bound);
    api->BindImageTexture(0, gather->irradiance->id, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    for (int block = 0; block < blocks; block++) {
        int rest = lights->count - block * IRB_VPL_BLOCK;
        irb_program_int(program, "light_count", rest < IRB_VPL_BLOCK ? rest : IRB_VPL_BLOCK);
        irb_program_int(program, "first_block", block == 0);
        api->BindBufferRange(GL_UNIFORM_BUFFER, 0, lights->lights->id, block * block_bytes,
                             block_bytes);
        api->DispatchCompute(columns, rows, 1);
        api->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    }
    api->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                       GL_FRAMEBUFFER_BARRIER_BIT);
    return irb_gl_check(gather->gl, "rsm: gather", err);
}

bool rsm_gather_lost(struct rsm_gather *gather, double *share, struct irb_error *err)
{
    const struct irb_gl_api *api = &gather->gl->api;
    const int height = gather->irradiance->height;
    const size_t bytes = (size_t)height * 2 * sizeof(float);

    irb_program_use(gather->energy);
    api->BindTextureUnit(0, gather->irradiance->id);
    irb_program_int(gather->energy, "irradiance", 0);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, gather->rows->id);
    api->DispatchCompute((unsigned)(height + ROW_GROUP - 1) / ROW_GROUP, 1, 1);
    float *rows = malloc(bytes);
    if (!rows)
        return irb_fail(err, IRB_E_MEMORY, "rsm: out of memory for %d row sums", height);
    bool ok = irb_buffer_read(gather->rows, 0, (int64_t)bytes, rows, err);
    double kept = 0, lost = 0;
    for (int y = 0; ok && y < height; y++) {
        kept += rows[2 * y];
        lost += rows[2 * y + 1];
    }
    free(rows);
    *share = kept + lost > 0 ? lost / (kept + lost) : 0;
    return ok;
}
