/* SPDX-License-Identifier: MIT */
#include "core/lights/vals.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

const char *const irb_vals_start_names[] = {"restart", "reuse", NULL};
const char *const irb_vals_area_names[] = {"moment", "max", NULL};
const char *const irb_vals_centre_names[] = {"mean", "lifted", "member", NULL};

/* Shader storage bindings and work group of shaders/lights/vals_*. */
enum {
    VPLS_BINDING,
    VALS_BINDING,
    ASSIGNMENT_BINDING,
    STATISTICS_BINDING,
    ORDERED_BINDING,
    MEANS_BINDING
};
enum { KMEANS_GROUP = 256, GROUP = 64 };

struct statistics_record {
    uint32_t in_use, iterations, converged;
};

static struct irb_program *create_program(struct irb_gl *gl, const char *name, const char *path,
                                          struct irb_error *err)
{
    char vpls[32], vals[32];
    snprintf(vpls, sizeof vpls, "MOST_VPLS %d", IRB_VALS_MOST_LIGHTS);
    snprintf(vals, sizeof vals, "MOST_VALS %d", IRB_VALS_MOST);
    const char *const defines[] = {vpls, vals, NULL};
    return irb_program_create(
        gl, &(struct irb_program_desc){.name = name, .compute = path, .defines = defines}, err);
}

static bool create_buffers(struct irb_vals *v, struct irb_error *err)
{
    static const struct statistics_record none;
    const int64_t lights = (int64_t)IRB_VALS_MOST_LIGHTS * IRB_VPL_BYTES;
    return (v->vals = irb_buffer_create(v->gl, "vals: records",
                                        (int64_t)IRB_VPL_BLOCK * IRB_VPL_BYTES, NULL, err)) &&
           (v->assignment = irb_buffer_create(v->gl, "vals: assignment",
                                              (int64_t)IRB_VALS_MOST_LIGHTS * 4, NULL, err)) &&
           (v->ordered = irb_buffer_create(v->gl, "vals: ordered", lights, NULL, err)) &&
           (v->means = irb_buffer_create(v->gl, "vals: means", (int64_t)IRB_VALS_MOST * 2 * 16,
                                         NULL, err)) &&
           (v->statistics = irb_buffer_create(v->gl, "vals: statistics", sizeof none, &none, err));
}

struct irb_vals *irb_vals_create(struct irb_gl *gl, struct irb_error *err)
{
    struct irb_vals *v = calloc(1, sizeof *v);
    if (!v) {
        irb_fail(err, IRB_E_MEMORY, "vals: out of memory");
        return NULL;
    }
    v->gl = gl;
    if (create_buffers(v, err) &&
        (v->kmeans = create_program(gl, "vals: k-means", "lights/vals_kmeans.comp", err)) &&
        (v->finish = create_program(gl, "vals: records", "lights/vals_finish.comp", err)) &&
        (v->order = create_program(gl, "vals: order", "lights/vals_order.comp", err)))
        return v;
    irb_vals_destroy(v);
    return NULL;
}

void irb_vals_destroy(struct irb_vals *v)
{
    if (!v)
        return;
    irb_program_destroy(v->kmeans);
    irb_program_destroy(v->finish);
    irb_program_destroy(v->order);
    irb_buffer_destroy(v->vals);
    irb_buffer_destroy(v->assignment);
    irb_buffer_destroy(v->ordered);
    irb_buffer_destroy(v->means);
    irb_buffer_destroy(v->statistics);
    free(v);
}

void irb_vals_forget(struct irb_vals *v)
{
    v->has_history = false;
}

static void barrier(const struct irb_vals *v)
{
    v->gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT |
                             GL_BUFFER_UPDATE_BARRIER_BIT);
}

static void bind(const struct irb_vals *v, const struct irb_virtual_lights *vpls)
{
    const struct irb_gl_api *api = &v->gl->api;
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, VPLS_BINDING, vpls->buffer->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, VALS_BINDING, v->vals->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, ASSIGNMENT_BINDING, v->assignment->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, STATISTICS_BINDING, v->statistics->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, ORDERED_BINDING, v->ordered->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, MEANS_BINDING, v->means->id);
}

/* Dispatches that make up to s->iterations, each as many as IRB_LOOP_ROUNDS_MOST lets it; those
 * after convergence do nothing. */
static void iterate(const struct irb_vals *v, int vpls, const struct irb_vals_settings *s,
                    bool reuse)
{
    const int own = (vpls + KMEANS_GROUP - 1) / KMEANS_GROUP; /* VPLs of one invocation */
    const int rounds = own * (s->vals + 3) + vpls + 4;
    const int at_once = (IRB_LOOP_ROUNDS_MOST - vpls) / rounds; /* less the search for lit ones */

    irb_program_use(v->kmeans);
    irb_program_int(v->kmeans, "vpl_count", vpls);
    irb_program_int(v->kmeans, "val_count", s->vals);
    irb_program_int(v->kmeans, "tiles", s->tiles > 1 ? s->tiles : 1);
    irb_program_int(v->kmeans, "reuse", reuse);
    irb_program_float(v->kmeans, "weight_distance", s->weight_distance);
    irb_program_float(v->kmeans, "weight_angle", s->weight_angle);
    for (int done = 0; done < s->iterations; done += at_once) {
        const int rest = s->iterations - done;
        irb_program_int(v->kmeans, "fresh", done == 0);
        irb_program_int(v->kmeans, "iterations", rest < at_once ? rest : at_once);
        v->gl->api.DispatchCompute(1, 1, 1);
        barrier(v);
    }
}

bool irb_vals_cluster(struct irb_vals *v, const struct irb_virtual_lights *vpls,
                      const struct irb_vals_settings *s, struct irb_error *err)
{
    static const struct statistics_record none = {.converged = 1};

    if (vpls->count > IRB_VALS_MOST_LIGHTS || s->vals < 1 || s->vals > IRB_VALS_MOST ||
        s->iterations < 1)
        return irb_fail(err, IRB_E_INTERNAL, "vals: %d VALs of %d lights", s->vals, vpls->count);
    if (!vpls->count)
        return irb_buffer_write(v->statistics, 0, sizeof none, &none, err);
    bind(v, vpls);
    iterate(v, vpls->count, s, s->start == IRB_VALS_REUSE && v->has_history && v->count == s->vals);
    irb_program_use(v->finish);
    irb_program_int(v->finish, "vpl_count", vpls->count);
    irb_program_int(v->finish, "val_count", s->vals);
    irb_program_int(v->finish, "area_kind", (int)s->area);
    irb_program_int(v->finish, "stand", (int)s->centre);
    v->gl->api.DispatchCompute((unsigned)(s->vals + GROUP - 1) / GROUP, 1, 1);
    barrier(v);
    v->count = s->vals;
    v->has_history = true;
    return irb_gl_check(v->gl, "vals: k-means", err);
}

bool irb_vals_order(struct irb_vals *v, const struct irb_virtual_lights *vpls, int tiles,
                    struct irb_error *err)
{
    v->vpls = vpls->count;
    if (!vpls->count)
        return true;
    irb_program_use(v->order);
    bind(v, vpls);
    irb_program_int(v->order, "vpl_count", vpls->count);
    irb_program_int(v->order, "tiles", tiles);
    v->gl->api.DispatchCompute((unsigned)(vpls->count + GROUP - 1) / GROUP, 1, 1);
    barrier(v);
    return irb_gl_check(v->gl, "vals: order", err);
}

bool irb_vals_statistics(const struct irb_vals *v, struct irb_vals_statistics *out,
                         struct irb_error *err)
{
    struct statistics_record record = {0};
    if (!irb_buffer_read(v->statistics, 0, sizeof record, &record, err))
        return false;
    *out = (struct irb_vals_statistics){.in_use = (int)record.in_use,
                                        .iterations = (int)record.iterations,
                                        .converged = record.converged != 0};
    return true;
}
