/* SPDX-License-Identifier: MIT */
#include "methods/rsm_clustering/area_lights.h"

#include <stdio.h>
#include <stdlib.h>

const char *const rsc_area_names[] = {"texels", "moment", "max", NULL};

/* Of shaders/methods/rsm_clustering/area_lights.comp. */
enum { DISCS_BINDING = 6, POLYGONS_BINDING = 7, GROUP = 32 };
enum { VECTOR_BYTES = 16, LIGHT_VECTORS = 3 };

struct rsc_area_lights *rsc_area_lights_create(struct irb_gl *gl, struct irb_error *err)
{
    struct rsc_area_lights *lights = calloc(1, sizeof *lights);
    if (!lights) {
        irb_fail(err, IRB_E_MEMORY, "rsm-clustering: out of memory");
        return NULL;
    }
    lights->gl = gl;
    return lights;
}

void rsc_area_lights_destroy(struct rsc_area_lights *lights)
{
    if (!lights)
        return;
    for (int i = 0; i < 2 * 2 * 3; i++)
        irb_program_destroy(lights->programs[i / 6][i / 3 % 2][i % 3]);
    irb_buffer_destroy(lights->discs);
    irb_buffer_destroy(lights->polygons);
    free(lights);
}

/* In whole blocks. */
static int64_t light_slots(int clusters)
{
    return (clusters + (int64_t)IRB_VPL_BLOCK - 1) / IRB_VPL_BLOCK * IRB_VPL_BLOCK;
}

static bool make_room(struct irb_gl *gl, struct irb_buffer **buffer, const char *name,
                      int64_t bytes, struct irb_error *err)
{
    if (*buffer && (*buffer)->bytes >= bytes)
        return true;
    irb_buffer_destroy(*buffer);
    *buffer = irb_buffer_create(gl, name, bytes, NULL, err);
    return *buffer != NULL;
}

bool rsc_area_lights_prepare(struct rsc_area_lights *lights, int clusters, int corners,
                             struct irb_error *err)
{
    const int64_t slots = light_slots(clusters);
    return make_room(lights->gl, &lights->discs, "rsm-clustering: discs",
                     slots * LIGHT_VECTORS * VECTOR_BYTES, err) &&
           (!corners || make_room(lights->gl, &lights->polygons, "rsm-clustering: polygons",
                                  slots * (LIGHT_VECTORS + corners / 2) * VECTOR_BYTES, err));
}

static const struct irb_program *program_of(struct rsc_area_lights *lights, enum irb_layout layout,
                                            const struct rsc_settings *settings, int corners,
                                            struct irb_error *err)
{
    const bool sorted = settings->reduction == RSC_SORT;
    struct irb_program **program = &lights->programs[layout][sorted][corners / 8];
    char define[32];
    snprintf(define, sizeof define, "CORNERS %d", corners);
    const char *const defines[] = {irb_rsm_define(layout), rsc_members_define(settings), define,
                                   NULL};
    if (!*program)
        *program = irb_program_create(
            lights->gl,
            &(struct irb_program_desc){.name = "rsm-clustering: area lights",
                                       .compute = "methods/rsm_clustering/area_lights.comp",
                                       .defines = defines},
            err);
    return *program;
}

bool rsc_area_lights_make(struct rsc_area_lights *lights, const struct rsc_clusters *clusters,
                          const struct irb_rsm *rsm, const struct rsc_settings *settings,
                          enum rsc_area area, int corners, struct irb_error *err)
{
    const struct irb_gl_api *api = &lights->gl->api;
    if (corners != 0 && corners != 8 && corners != 16)
        return irb_fail(err, IRB_E_INTERNAL, "rsm-clustering: %d corners", corners);
    const int64_t slots = light_slots(settings->clusters);
    const struct irb_program *program = program_of(lights, rsm->layout, settings, corners, err);
    if (!program)
        return false;
    irb_program_use(program);
    rsc_members_bind(clusters, program, rsm, settings);
    irb_program_uint(program, "light_count", (unsigned)slots);
    irb_program_int(program, "area", (int)area);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, DISCS_BINDING, lights->discs->id);
    if (corners)
        api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, POLYGONS_BINDING, lights->polygons->id);
    rsc_members_dispatch(clusters, program, settings, corners + 2, (int)slots, GROUP);
    api->MemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    lights->count = settings->clusters;
    lights->corners = corners;
    return irb_gl_check(lights->gl, "rsm-clustering: area lights", err);
}

struct irb_virtual_lights rsc_area_lights_discs(const struct rsc_area_lights *lights)
{
    return (struct irb_virtual_lights){.buffer = lights->discs, .count = lights->count};
}

struct irb_virtual_lights rsc_area_lights_view(const struct rsc_area_lights *lights)
{
    if (!lights->corners)
        return rsc_area_lights_discs(lights);
    return (struct irb_virtual_lights){
        .buffer = lights->polygons, .count = lights->count, .corners = lights->corners};
}
