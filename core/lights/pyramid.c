/* SPDX-License-Identifier: MIT */
#include "core/lights/pyramid.h"

#include <stdlib.h>

enum { PYRAMID_BINDING = 2 }; /* in shaders/lights/warp.glsl and pyramid.comp */
enum { GROUP = 8 };           /* work group side in pyramid.comp */
enum { MOST_LEVELS = 15 };    /* offsets stay within 31 bits */

/* Number of floats in the levels before `level`. */
static int64_t offset_of(int levels, int level)
{
    return (((int64_t)1 << 2 * levels) - ((int64_t)1 << 2 * (levels - level))) / 3;
}

static bool check_size(struct irb_gl *gl, int resolution, int levels, struct irb_error *err)
{
    GLint64 most = 0;
    gl->api.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (resolution < 1)
        return irb_fail(err, IRB_E_INTERNAL, "pyramid of a map of %d texels a side", resolution);
    if (levels > MOST_LEVELS || 4 * offset_of(levels, levels) > most)
        return irb_fail(err, IRB_E_INPUT,
                        "pyramid of a map of %d x %d texels exceeds the driver's %lld MiB for one "
                        "buffer; use a smaller RSM",
                        resolution, resolution, (long long)(most >> 20));
    return true;
}

struct irb_pyramid *irb_pyramid_create(struct irb_gl *gl, int resolution, struct irb_error *err)
{
    int levels = 1;
    while (levels < 31 && 1 << (levels - 1) < resolution)
        levels++;
    if (!check_size(gl, resolution, levels, err))
        return NULL;
    struct irb_pyramid *pyramid = calloc(1, sizeof *pyramid);
    if (!pyramid) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    pyramid->gl = gl;
    pyramid->resolution = resolution;
    pyramid->levels = levels;
    pyramid->sums = irb_buffer_create(gl, "pyramid", 4 * offset_of(levels, levels), NULL, err);
    if (pyramid->sums)
        return pyramid;
    irb_pyramid_destroy(pyramid);
    return NULL;
}

void irb_pyramid_destroy(struct irb_pyramid *pyramid)
{
    if (!pyramid)
        return;
    irb_program_destroy(pyramid->flux);
    irb_program_destroy(pyramid->map);
    irb_buffer_destroy(pyramid->sums);
    free(pyramid);
}

static struct irb_program *create_program(struct irb_gl *gl, const char *source, const char *layout,
                                          struct irb_error *err)
{
    const char *const defines[] = {source, layout, NULL};
    return irb_program_create(gl,
                              &(struct irb_program_desc){.name = "pyramid",
                                                         .compute = "lights/pyramid.comp",
                                                         .defines = defines},
                              err);
}

/* The program is in use and its map bound. */
static bool build(const struct irb_pyramid *pyramid, const struct irb_program *program,
                  struct irb_error *err)
{
    const struct irb_gl_api *api = &pyramid->gl->api;
    const int levels = pyramid->levels;

    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, PYRAMID_BINDING, pyramid->sums->id);
    irb_program_int(program, "resolution", pyramid->resolution);
    for (int level = 0; level < levels; level++) {
        int side = 1 << (levels - 1 - level);
        unsigned groups = (unsigned)(side + GROUP - 1) / GROUP;
        irb_program_int(program, "level", level);
        irb_program_int(program, "side", side);
        irb_program_int(program, "offset", (int)offset_of(levels, level));
        irb_program_int(program, "finer_offset", level ? (int)offset_of(levels, level - 1) : 0);
        api->DispatchCompute(groups, groups, 1);
        api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    return irb_gl_check(pyramid->gl, "pyramid: build", err);
}

static bool check_resolution(const struct irb_pyramid *pyramid, int width, int height,
                             struct irb_error *err)
{
    if (width == pyramid->resolution && height == pyramid->resolution)
        return true;
    return irb_fail(err, IRB_E_INTERNAL, "pyramid for %d texels a side, given a map of %d x %d",
                    pyramid->resolution, width, height);
}

bool irb_pyramid_build_flux(struct irb_pyramid *pyramid, const struct irb_rsm *rsm,
                            struct irb_error *err)
{
    if (!check_resolution(pyramid, rsm->resolution, rsm->resolution, err))
        return false;
    if (pyramid->flux && pyramid->flux_layout != rsm->layout) {
        irb_program_destroy(pyramid->flux);
        pyramid->flux = NULL;
    }
    if (!pyramid->flux)
        pyramid->flux =
            create_program(pyramid->gl, "SOURCE_MAP 0", irb_rsm_define(rsm->layout), err);
    if (!pyramid->flux)
        return false;
    pyramid->flux_layout = rsm->layout;
    irb_program_use(pyramid->flux);
    irb_rsm_bind(rsm, pyramid->flux, 0);
    return build(pyramid, pyramid->flux, err);
}

bool irb_pyramid_build(struct irb_pyramid *pyramid, const struct irb_texture *map,
                       struct irb_error *err)
{
    if (!check_resolution(pyramid, map->width, map->height, err))
        return false;
    if (!pyramid->map)
        pyramid->map =
            create_program(pyramid->gl, "SOURCE_MAP 1", irb_rsm_define(IRB_LAYOUT_FULL), err);
    if (!pyramid->map)
        return false;
    irb_program_use(pyramid->map);
    pyramid->gl->api.BindTextureUnit(0, map->id);
    irb_program_int(pyramid->map, "map", 0);
    return build(pyramid, pyramid->map, err);
}

void irb_pyramid_bind(const struct irb_pyramid *pyramid, const struct irb_program *program)
{
    pyramid->gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, PYRAMID_BINDING, pyramid->sums->id);
    irb_program_int(program, "pyramid_levels", pyramid->levels);
    irb_program_int(program, "pyramid_resolution", pyramid->resolution);
}
