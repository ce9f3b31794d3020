/* SPDX-License-Identifier: MIT */
#include "core/lights/cluster_census.h"

#include <stdlib.h>

enum { ROW_GROUP = 64 }; /* work group of shaders/lights/cluster_census.comp */

/* What it sums for a row. */
struct row {
    float lit, uncovered, flux, uncovered_flux;
};

bool irb_cluster_counter_create(struct irb_cluster_counter *counter, struct irb_gl *gl,
                                int resolution, struct irb_error *err)
{
    const int64_t bytes = resolution * (int64_t)sizeof(struct row);
    *counter = (struct irb_cluster_counter){.gl = gl};
    counter->rows = irb_buffer_create(gl, "cluster census: rows", bytes, NULL, err);
    return counter->rows != NULL;
}

void irb_cluster_counter_destroy(struct irb_cluster_counter *counter)
{
    irb_buffer_destroy(counter->rows);
    irb_program_destroy(counter->program[IRB_LAYOUT_FULL]);
    irb_program_destroy(counter->program[IRB_LAYOUT_SLIM]);
    *counter = (struct irb_cluster_counter){.gl = counter->gl};
}

static const struct irb_program *program_of(struct irb_cluster_counter *counter,
                                            enum irb_layout layout, struct irb_error *err)
{
    struct irb_program **program = &counter->program[layout];
    const char *const defines[] = {irb_rsm_define(layout), NULL};
    const struct irb_program_desc desc = {
        .name = "cluster census", .compute = "lights/cluster_census.comp", .defines = defines};
    if (!*program)
        *program = irb_program_create(counter->gl, &desc, err);
    return *program;
}

static bool sum_rows(const struct irb_cluster_counter *counter, struct irb_cluster_census *out,
                     struct irb_error *err)
{
    struct row *rows = malloc((size_t)counter->rows->bytes);
    if (!rows)
        return irb_fail(err, IRB_E_MEMORY, "cluster census: out of memory");
    bool ok = irb_buffer_read(counter->rows, 0, counter->rows->bytes, rows, err);
    *out = (struct irb_cluster_census){0};
    for (size_t y = 0; ok && y < (size_t)counter->rows->bytes / sizeof *rows; y++) {
        out->lit += (int)rows[y].lit;
        out->uncovered += (int)rows[y].uncovered;
        out->flux += rows[y].flux;
        out->uncovered_flux += rows[y].uncovered_flux;
    }
    free(rows);
    return ok;
}

bool irb_cluster_count(struct irb_cluster_counter *counter, const struct irb_rsm *rsm,
                       const struct irb_texture *map, struct irb_cluster_census *out,
                       struct irb_error *err)
{
    const struct irb_gl_api *api = &counter->gl->api;
    const struct irb_program *program = program_of(counter, rsm->layout, err);
    if (!program)
        return false;
    irb_program_use(program);
    const int unit = irb_rsm_bind(rsm, program, 0);
    api->BindTextureUnit((GLuint)unit, map->id);
    irb_program_int(program, "cluster_map", unit);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counter->rows->id);
    api->DispatchCompute((unsigned)(rsm->resolution + ROW_GROUP - 1) / ROW_GROUP, 1, 1);
    api->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    return sum_rows(counter, out, err) && irb_gl_check(counter->gl, "cluster census", err);
}
