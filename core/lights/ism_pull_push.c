/* SPDX-License-Identifier: MIT */
#include "core/lights/ism.h"

#include "core/lights/ism_passes.h"

#include <stdlib.h>

/* Work group sizes of shaders/lights/ism_pull.comp and ism_push.comp; ism_coverage.comp. */
enum { GROUP = 8, ROWS_GROUP = 64 };

/* MEAN: greatest relative difference of distances that are averaged. Ours. */
static const float closeness = 0.1f;

void irb_ism_destroy_pull_push(struct irb_ism_passes *passes)
{
    for (int i = 0; i < IRB_ISM_PULLS; i++) {
        irb_program_destroy(passes->pull[i]);
        irb_program_destroy(passes->push[i]);
    }
    irb_texture_destroy(passes->pyramid);
    irb_program_destroy(passes->coverage);
    irb_buffer_destroy(passes->filled);
}

/* ---- Pull-push ---- */

static bool make_programs(struct irb_ism *ism, int pull, struct irb_error *err)
{
    struct irb_ism_passes *passes = ism->passes;
    const char *const defines[] = {pull == IRB_ISM_MEAN ? "MEAN 1" : "MEAN 0", NULL};
    const struct irb_program_desc pull_desc = {
        .name = "ism: pull", .compute = "lights/ism_pull.comp", .defines = defines};
    const struct irb_program_desc push_desc = {
        .name = "ism: push", .compute = "lights/ism_push.comp", .defines = defines};
    if (!passes->pull[pull])
        passes->pull[pull] = irb_program_create(ism->gl, &pull_desc, err);
    if (passes->pull[pull] && !passes->push[pull])
        passes->push[pull] = irb_program_create(ism->gl, &push_desc, err);
    return passes->pull[pull] && passes->push[pull];
}

static bool make_pyramid(struct irb_ism *ism, int levels, struct irb_error *err)
{
    struct irb_texture **pyramid = &ism->passes->pyramid;
    if (*pyramid && (*pyramid)->levels >= levels)
        return true;
    irb_texture_destroy(*pyramid);
    *pyramid = irb_texture_create(ism->gl,
                                  &(struct irb_texture_desc){.name = "ism: pyramid",
                                                             .format = GL_R32UI,
                                                             .width = ism->atlas->width / 2,
                                                             .height = ism->atlas->height / 2,
                                                             .levels = levels},
                                  err);
    return *pyramid != NULL;
}

/* Level 0 is the atlas. */
static void bind_level(const struct irb_ism *ism, unsigned unit, int level, unsigned access)
{
    const struct irb_texture *texture = level ? ism->passes->pyramid : ism->atlas;
    ism->gl->api.BindImageTexture(unit, texture->id, level ? level - 1 : 0, GL_FALSE, 0, access,
                                  GL_R32UI);
}

/* One invocation for each texel of the maps in use on a level; only the first row may be partly in
 * use from left to right. */
static void dispatch(const struct irb_ism *ism, const struct irb_program *program, int level)
{
    const int columns = ism->count < ism->maps_a_row ? ism->count : ism->maps_a_row;
    const int size = ism->map_size >> level;
    const int extent[2] = {columns * size, irb_ism_rows(ism, ism->count) * size};
    irb_program_ivec2(program, "extent", extent);
    ism->gl->api.DispatchCompute((unsigned)(extent[0] + GROUP - 1) / GROUP,
                                 (unsigned)(extent[1] + GROUP - 1) / GROUP, 1);
    ism->gl->api.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

static void run_levels(const struct irb_ism *ism, int levels, int pull)
{
    const struct irb_program *program = ism->passes->pull[pull];
    irb_program_use(program);
    irb_program_float(program, "closeness", closeness);
    for (int level = 1; level <= levels; level++) {
        bind_level(ism, 0, level - 1, GL_READ_ONLY);
        bind_level(ism, 1, level, GL_WRITE_ONLY);
        dispatch(ism, program, level);
    }
    program = ism->passes->push[pull];
    irb_program_use(program);
    irb_program_float(program, "closeness", closeness);
    for (int level = levels; level >= 1; level--) {
        bind_level(ism, 0, level - 1, GL_READ_WRITE);
        bind_level(ism, 1, level, GL_READ_ONLY);
        irb_program_int(program, "parent_size", ism->map_size >> level);
        dispatch(ism, program, level - 1);
    }
}

bool irb_ism_pull_push(struct irb_ism *ism, const struct irb_ism_settings *settings,
                       struct irb_error *err)
{
    const int levels = settings->pull_push, pull = settings->pull;
    if (levels < 0 || levels > 16 || ism->map_size % (1 << levels))
        return irb_fail(err, IRB_E_INPUT,
                        "ism: %d pull-push levels need maps whose side is a multiple of 2^%d, "
                        "found %d texels",
                        levels, levels, ism->map_size);
    if (pull != IRB_ISM_MEDIAN && pull != IRB_ISM_MEAN)
        return irb_fail(err, IRB_E_INTERNAL, "ism: no such pull: %d", pull);
    if (!levels || !ism->count)
        return true;
    if (!make_programs(ism, pull, err) || !make_pyramid(ism, levels, err))
        return false;
    run_levels(ism, levels, pull);
    ism->gl->api.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                               GL_FRAMEBUFFER_BARRIER_BIT);
    return irb_gl_check(ism->gl, "ism: pull-push", err);
}

/* ---- Coverage ---- */

static bool count_filled(struct irb_ism *ism, uint32_t *filled, struct irb_error *err)
{
    const struct irb_gl_api *api = &ism->gl->api;
    struct irb_ism_passes *passes = ism->passes;
    const int64_t bytes = (int64_t)ism->capacity * (int64_t)sizeof *filled;
    const uint32_t zero = 0;
    if (!passes->coverage)
        passes->coverage =
            irb_program_create(ism->gl,
                               &(struct irb_program_desc){.name = "ism: coverage",
                                                          .compute = "lights/ism_coverage.comp"},
                               err);
    if (passes->coverage && !passes->filled)
        passes->filled = irb_buffer_create(ism->gl, "ism: filled", bytes, NULL, err);
    if (!passes->filled)
        return false;
    api->ClearNamedBufferData(passes->filled->id, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    irb_program_use(passes->coverage);
    irb_program_int(passes->coverage, "map_size", ism->map_size);
    irb_program_int(passes->coverage, "maps_a_row", ism->maps_a_row);
    bind_level(ism, 0, 0, GL_READ_ONLY);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, passes->filled->id);
    api->DispatchCompute((unsigned)(ism->map_size + ROWS_GROUP - 1) / ROWS_GROUP,
                         (unsigned)ism->count, 1);
    return irb_buffer_read(passes->filled, 0, bytes, filled, err);
}

/* Texels of a map with centres in the unit disc, as shaders/lights/ism_coverage.comp has them. */
static int disc_texels(int size)
{
    int count = 0;
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            int u = 2 * x + 1 - size, v = 2 * y + 1 - size;
            count += u * u + v * v <= size * size;
        }
    return count;
}

bool irb_ism_coverage(struct irb_ism *ism, double *share, struct irb_error *err)
{
    static const int vectors = IRB_VPL_BYTES / sizeof(float[4]);
    uint32_t filled[IRB_VPL_BLOCK];
    float lights[IRB_VPL_BLOCK][IRB_VPL_BYTES / sizeof(float)];
    int lit = 0;
    uint64_t sum = 0;
    *share = 0;
    if (!ism->count)
        return true;
    if (!count_filled(ism, filled, err) ||
        !irb_buffer_read(ism->passes->lights, 0, (int64_t)ism->count * IRB_VPL_BYTES, lights, err))
        return false;
    for (int l = 0; l < ism->count; l++) {
        const float *flux = &lights[l][4 * (vectors - 1)];
        if (!(flux[0] > 0) && !(flux[1] > 0) && !(flux[2] > 0))
            continue;
        lit++;
        sum += filled[l];
    }
    if (lit)
        *share = (double)sum / ((double)lit * disc_texels(ism->map_size));
    return true;
}
