/* SPDX-License-Identifier: MIT */
#include "core/lights/val_lighting.h"

#include <stdio.h>
#include <stdlib.h>

/* Work group side of shaders/lights/val_light.comp, pixels an invocation a side, and bindings. */
enum { GROUP = 8, TILE = 2, SIDE = GROUP * TILE };
enum { LIGHTS_BINDING = 0, VALS_BINDING = 1, CSM_BINDING = 2, SPLIT_IMAGE = 0, LOST_IMAGE = 1 };

const char *const irb_vals_map_size_names[] = {"64", "128", "256", "512", NULL};

int irb_vals_map_side(int map_size)
{
    return 64 << map_size;
}

void irb_val_lighting_init(struct irb_val_lighting *l, struct irb_gl *gl)
{
    *l = (struct irb_val_lighting){.gl = gl, .lost.gl = gl};
}

static void destroy_maps(struct irb_val_lighting *l)
{
    irb_raster_maps_destroy(l->maps);
    irb_csm_destroy(l->csm);
    l->maps = NULL;
    l->csm = NULL;
}

static void destroy_programs(struct irb_program *programs[2][2])
{
    for (int i = 0; i < 2 * 2; i++) {
        irb_program_destroy(programs[i / 2][i % 2]);
        programs[i / 2][i % 2] = NULL;
    }
}

static struct irb_program **program_of(struct irb_val_lighting *l,
                                       const struct irb_val_lighting_settings *s)
{
    return &l->programs[s->visibility][s->discs][s->bound > 0];
}

void irb_val_lighting_destroy(struct irb_val_lighting *l)
{
    destroy_maps(l);
    destroy_programs(l->programs[0]);
    destroy_programs(l->programs[1]);
    irb_lost_light_destroy(&l->lost);
    irb_val_lighting_init(l, l->gl);
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static bool prepare_maps(struct irb_val_lighting *l, const struct irb_val_lighting_settings *s,
                         int vals, struct irb_error *err)
{
    const int most = smaller(irb_csm_most(l->gl, s->projection, s->size, s->order),
                             irb_raster_maps_most(l->gl, s->projection, s->size));
    const int capacity = smaller(vals, most);
    const struct irb_csm *have = l->csm;
    const bool same_shader = have && have->projection == s->projection &&
                             have->prefilter == s->prefilter && have->order == s->order;
    if (same_shader && have->size == s->size && have->capacity >= capacity)
        return true;
    if (!same_shader)
        destroy_programs(l->programs[1]);
    destroy_maps(l);
    l->maps = irb_raster_maps_create(l->gl, s->projection, s->size, capacity, err);
    if (l->maps)
        l->csm =
            irb_csm_create(l->gl, s->projection, s->size, capacity, s->order, s->prefilter, err);
    return l->csm != NULL;
}

static bool prepare_program(struct irb_val_lighting *l, const struct irb_val_lighting_settings *s,
                            struct irb_error *err)
{
    struct irb_program **program = program_of(l, s);
    struct irb_csm_defines csm;
    char block[32], vals[32], tile[32];
    const char *defines[16] = {s->visibility ? "VISIBILITY 1" : "VISIBILITY 0",
                               s->discs ? "DISCS 1" : "DISCS 0", block, vals, tile};
    int count = 5;
    if (*program)
        return true;
    snprintf(block, sizeof block, "VPL_BLOCK %d", IRB_VPL_BLOCK);
    snprintf(tile, sizeof tile, "TILE %d", TILE);
    snprintf(vals, sizeof vals, "MOST_VALS %d", IRB_VALS_MOST);
    if (s->bound > 0)
        defines[count++] = "CLAMPED 1";
    if (s->visibility) {
        irb_csm_defines(l->csm, CSM_BINDING, &csm);
        for (int i = 0; csm.list[i]; i++)
            defines[count++] = csm.list[i];
    }
    const struct irb_program_desc desc = {
        .name = "vals: light", .compute = "lights/val_light.comp", .defines = defines};
    *program = irb_program_create(l->gl, &desc, err);
    return *program != NULL;
}

bool irb_val_lighting_prepare(struct irb_val_lighting *l, const struct irb_interleave *il,
                              const struct irb_val_lighting_settings *s, int vals,
                              struct irb_error *err)
{
    return (!s->visibility || prepare_maps(l, s, vals, err)) &&
           irb_lost_light_prepare(&l->lost, il, s->bound, err) && prepare_program(l, s, err);
}

bool irb_val_lighting_next(const struct irb_val_lighting *l,
                           const struct irb_val_lighting_settings *s, int vals,
                           struct irb_val_batch *batch)
{
    const bool is_first = batch->count < 0;
    const int first = is_first ? 0 : batch->first + batch->count;
    const int most = s->visibility ? l->csm->capacity : IRB_VALS_MOST;
    *batch = (struct irb_val_batch){.first = first, .count = smaller(vals - first, most)};
    return is_first || batch->count > 0;
}

bool irb_val_lighting_maps(struct irb_val_lighting *l, const struct irb_scene_gl *scene,
                           const struct irb_vals *vals, const struct irb_val_lighting_settings *s,
                           const struct irb_val_batch *batch, struct irb_error *err)
{
    const struct irb_virtual_lights lights = irb_vals_view(vals);
    return irb_raster_maps_render(l->maps, scene, &lights, batch->first, batch->count, s->near,
                                  err);
}

static void bind(const struct irb_val_lighting *l, const struct irb_program *program,
                 const struct irb_interleave *il, const struct irb_vals *vals,
                 const struct irb_val_lighting_settings *s, const struct irb_val_batch *batch)
{
    const struct irb_gl_api *api = &l->gl->api;

    api->BindTextureUnit(0, il->position->id);
    irb_program_int(program, "split_position", 0);
    api->BindTextureUnit(1, il->normal->id);
    irb_program_int(program, "split_normal", 1);
    api->BindImageTexture(SPLIT_IMAGE, il->split->id, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    if (s->bound > 0)
        api->BindImageTexture(LOST_IMAGE, l->lost.image->id, 0, GL_FALSE, 0, GL_READ_WRITE,
                              GL_R32F);
    api->BindBufferRange(GL_UNIFORM_BUFFER, VALS_BINDING, vals->vals->id, 0,
                         (GLsizeiptr)IRB_VALS_MOST * IRB_VPL_BYTES);
    if (s->visibility)
        irb_csm_bind(l->csm, program, &s->csm, CSM_BINDING, 2);
    irb_program_ivec2(program, "tile_size", (const int[]){il->tile_width, il->tile_height});
    irb_program_int(program, "tiles_across", il->n);
    irb_program_int(program, "tile_count", il->n * il->m);
    irb_program_int(program, "vpl_count", vals->vpls);
    irb_program_int(program, "first_val", batch->first);
    irb_program_int(program, "last_val", batch->first + batch->count);
    irb_program_float(program, "bound", s->bound);
}

bool irb_val_lighting_run(struct irb_val_lighting *l, const struct irb_interleave *il,
                          const struct irb_vals *vals, const struct irb_val_lighting_settings *s,
                          const struct irb_val_batch *batch, struct irb_error *err)
{
    const struct irb_gl_api *api = &l->gl->api;
    const struct irb_program *program = *program_of(l, s);
    const int64_t bytes = (int64_t)IRB_VPL_BLOCK * IRB_VPL_BYTES;

    irb_program_use(program);
    bind(l, program, il, vals, s, batch);
    /* no lights at all still take one dispatch, which writes zeros */
    for (int begin = 0; begin == 0 || begin < vals->vpls; begin += IRB_VPL_BLOCK) {
        irb_program_int(program, "block_begin", begin);
        irb_program_int(program, "block_end", smaller(begin + IRB_VPL_BLOCK, vals->vpls));
        irb_program_int(program, "accumulate", begin > 0 || batch->first > 0);
        api->BindBufferRange(GL_UNIFORM_BUFFER, LIGHTS_BINDING, vals->ordered->id,
                             begin / IRB_VPL_BLOCK * bytes, bytes);
        api->DispatchCompute((unsigned)((il->tile_width + SIDE - 1) / SIDE),
                             (unsigned)((il->tile_height + SIDE - 1) / SIDE),
                             (unsigned)(il->n * il->m));
        api->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                           GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    }
    return irb_gl_check(l->gl, "vals: light", err);
}

bool irb_val_lighting_shade(struct irb_val_lighting *l, const struct irb_scene_gl *scene,
                            const struct irb_interleave *il, const struct irb_vals *lights,
                            int vals, const struct irb_val_lighting_settings *s,
                            struct irb_timer *timer, const struct irb_val_stages *stages,
                            struct irb_error *err)
{
    struct irb_val_batch batch = {.count = -1};
    bool ok = true;
    while (ok && irb_val_lighting_next(l, s, vals, &batch)) {
        if (s->visibility && batch.count > 0) {
            IRB_TIMED(ok, timer, stages->maps,
                      irb_val_lighting_maps(l, scene, lights, s, &batch, err));
            IRB_TIMED(ok, timer, stages->basis, irb_csm_basis(l->csm, l->maps, &s->csm, err));
            IRB_TIMED(ok, timer, stages->prefilter, irb_csm_prefilter(l->csm, err));
        }
        IRB_TIMED(ok, timer, stages->light, irb_val_lighting_run(l, il, lights, s, &batch, err));
    }
    return ok;
}

bool irb_val_lighting_lost(struct irb_val_lighting *l, const struct irb_interleave *il,
                           double *share, struct irb_error *err)
{
    return irb_lost_light_share(&l->lost, il, share, err);
}
