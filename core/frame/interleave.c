/* SPDX-License-Identifier: MIT */
#include "core/frame/interleave.h"

#include <stdio.h>
#include <stdlib.h>

/* Work group side of shaders/frame/interleave_*.comp. */
enum { GROUP = 8 };

struct irb_interleave_passes {
    struct irb_program *split[2], *filter[2]; /* by the G-buffer's layout, when first asked for */
    struct irb_program *merge;
};

static struct irb_program *create_program(const struct irb_interleave *il, enum irb_layout layout,
                                          const char *name, const char *path, struct irb_error *err)
{
    char across[32], up[32];
    snprintf(across, sizeof across, "TILES_X %d", il->n);
    snprintf(up, sizeof up, "TILES_Y %d", il->m);
    const char *const defines[] = {across, up, irb_gbuffer_define(layout), NULL};
    return irb_program_create(
        il->gl, &(struct irb_program_desc){.name = name, .compute = path, .defines = defines}, err);
}

static struct irb_texture *create_texture(struct irb_gl *gl, const char *name, int width,
                                          int height, struct irb_error *err)
{
    return irb_texture_create(
        gl,
        &(struct irb_texture_desc){
            .name = name, .format = GL_RGBA32F, .width = width, .height = height},
        err);
}

static bool create_objects(struct irb_interleave *il, struct irb_error *err)
{
    const int width = il->n * il->tile_width, height = il->m * il->tile_height;

    if (!(il->passes = calloc(1, sizeof *il->passes)))
        return irb_fail(err, IRB_E_MEMORY, "out of memory");
    il->position = create_texture(il->gl, "interleave: position", width, height, err);
    if (il->position)
        il->normal = create_texture(il->gl, "interleave: normal", width, height, err);
    if (il->normal)
        il->geometric = create_texture(il->gl, "interleave: geometric normal", width, height, err);
    if (il->geometric)
        il->split = create_texture(il->gl, "interleave: split", width, height, err);
    if (il->split)
        il->merged = create_texture(il->gl, "interleave: merged", il->width, il->height, err);
    if (il->merged)
        il->passes->merge = create_program(il, IRB_LAYOUT_FULL, "interleave: merge",
                                           "frame/interleave_merge.comp", err);
    return il->passes->merge != NULL;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

struct irb_interleave *irb_interleave_create(struct irb_gl *gl, int width, int height, int n, int m,
                                             struct irb_error *err)
{
    if (n < 1 || m < 1 || n > IRB_INTERLEAVE_MOST || m > IRB_INTERLEAVE_MOST || width < 1 ||
        height < 1) {
        irb_fail(err, IRB_E_INTERNAL, "interleave: %d x %d tiles of %d x %d pixels", n, m, width,
                 height);
        return NULL;
    }
    struct irb_interleave *il = calloc(1, sizeof *il);
    if (!il) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    il->gl = gl;
    il->width = width;
    il->height = height;
    il->n = smaller(n, width);
    il->m = smaller(m, height);
    il->tile_width = (width + il->n - 1) / il->n;
    il->tile_height = (height + il->m - 1) / il->m;
    if (create_objects(il, err))
        return il;
    irb_interleave_destroy(il);
    return NULL;
}

bool irb_interleave_prepare(struct irb_interleave **interleave, struct irb_gl *gl, int width,
                            int height, int n, int m, struct irb_error *err)
{
    const struct irb_interleave *have = *interleave;
    if (have && have->width == width && have->height == height && have->n == smaller(n, width) &&
        have->m == smaller(m, height))
        return true;
    irb_interleave_destroy(*interleave);
    *interleave = irb_interleave_create(gl, width, height, n, m, err);
    return *interleave != NULL;
}

void irb_interleave_destroy(struct irb_interleave *il)
{
    if (!il)
        return;
    for (int layout = 0; il->passes && layout < 2; layout++) {
        irb_program_destroy(il->passes->split[layout]);
        irb_program_destroy(il->passes->filter[layout]);
    }
    irb_program_destroy(il->passes ? il->passes->merge : NULL);
    free(il->passes);
    irb_texture_destroy(il->position);
    irb_texture_destroy(il->normal);
    irb_texture_destroy(il->geometric);
    irb_texture_destroy(il->split);
    irb_texture_destroy(il->merged);
    free(il);
}

static void use_program(const struct irb_interleave *il, const struct irb_program *program)
{
    irb_program_use(program);
    irb_program_ivec2(program, "interleave_tile", (const int[]){il->tile_width, il->tile_height});
}

/* One invocation a pixel of `layers` images, and a barrier for what they wrote. */
static bool dispatch(const struct irb_interleave *il, int width, int height, int layers,
                     const char *site, struct irb_error *err)
{
    const struct irb_gl_api *api = &il->gl->api;

    api->DispatchCompute((unsigned)(width + GROUP - 1) / GROUP,
                         (unsigned)(height + GROUP - 1) / GROUP, (unsigned)layers);
    api->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                       GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    return irb_gl_check(il->gl, site, err);
}

static void bind_image(const struct irb_interleave *il, unsigned unit,
                       const struct irb_texture *texture)
{
    il->gl->api.BindImageTexture(unit, texture->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
}

/* Fails where an image is not of the size that was asked for at creation. */
static bool check_size(const struct irb_interleave *il, const char *what, int width, int height,
                       struct irb_error *err)
{
    if (width == il->width && height == il->height)
        return true;
    return irb_fail(err, IRB_E_INTERNAL, "interleave: made for %d x %d pixels, the %s has %d x %d",
                    il->width, il->height, what, width, height);
}

/* Made when first asked for, since most runs see one layout. */
static const struct irb_program *program_of(const struct irb_interleave *il,
                                            struct irb_program *programs[2],
                                            const struct irb_gbuffer *gbuffer, const char *name,
                                            const char *path, struct irb_error *err)
{
    struct irb_program **program = &programs[gbuffer->layout == IRB_LAYOUT_SLIM];
    if (!check_size(il, "G-buffer", gbuffer->width, gbuffer->height, err))
        return NULL;
    if (!*program)
        *program = create_program(il, gbuffer->layout, name, path, err);
    return *program;
}

bool irb_interleave_split(struct irb_interleave *il, const struct irb_gbuffer *gbuffer,
                          struct irb_error *err)
{
    const struct irb_program *program = program_of(
        il, il->passes->split, gbuffer, "interleave: split", "frame/interleave_split.comp", err);
    if (!program)
        return false;
    use_program(il, program);
    irb_gbuffer_bind(gbuffer, program, 0);
    bind_image(il, 0, il->position);
    bind_image(il, 1, il->normal);
    bind_image(il, 2, il->geometric);
    return dispatch(il, il->tile_width, il->tile_height, il->n * il->m, "interleave: split", err);
}

bool irb_interleave_merge(struct irb_interleave *il, struct irb_error *err)
{
    use_program(il, il->passes->merge);
    il->gl->api.BindTextureUnit(0, il->split->id);
    irb_program_int(il->passes->merge, "split_image", 0);
    bind_image(il, 0, il->merged);
    return dispatch(il, il->width, il->height, 1, "interleave: merge", err);
}

bool irb_interleave_filter(struct irb_interleave *il, const struct irb_gbuffer *gbuffer,
                           float depth, float cosine, const struct irb_texture *out,
                           struct irb_error *err)
{
    const struct irb_program *program = program_of(
        il, il->passes->filter, gbuffer, "interleave: filter", "frame/interleave_filter.comp", err);
    if (!program || !check_size(il, "target", out->width, out->height, err))
        return false;
    use_program(il, program);
    const int unit = irb_gbuffer_bind(gbuffer, program, 0);
    il->gl->api.BindTextureUnit((unsigned)unit, il->merged->id);
    irb_program_int(program, "merged", unit);
    irb_program_float(program, "filter_depth", depth);
    irb_program_float(program, "filter_cosine", cosine);
    bind_image(il, 0, out);
    return dispatch(il, il->width, il->height, 1, "interleave: filter", err);
}
