/* SPDX-License-Identifier: MIT */
#include "methods/rsm_clustering/clusters.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *const rsc_reduction_names[] = {"sort", "window", "direct", NULL};

/* Storage bindings and work groups of shaders/methods/rsm_clustering/. */
enum { CLUSTERS_BINDING = 0, KEYS_BINDING = 1, CARRY_BINDING = 2, LIST_BINDING = 3 };
enum { CELLS_BINDING = 4 };
enum { RECORDS_BINDING = 5 };
enum { CLUSTER_GROUP = 64, UPDATE_GROUP = 32, TEXEL_GROUP = 8, REORDER_GROUP = 64 };
enum { LIST_BYTES = 48, RECORD_BYTES = 48, KEY_BITS = 32 };
enum { CARRY_BYTES = 17 * 16 }; /* at most: area lights of 16 corners */

enum pass { SEED, LIST, ASSIGN, REORDER, UPDATE_SORTED, UPDATE_DIRECT, PASSES };
static const struct {
    const char *name, *path, *define;
} pass_table[PASSES] = {
    {"rsm-clustering: seed", "methods/rsm_clustering/seed.comp", NULL},
    {"rsm-clustering: grid", "methods/rsm_clustering/list.comp", NULL},
    {"rsm-clustering: assign", "methods/rsm_clustering/assign.comp", NULL},
    {"rsm-clustering: reorder", "methods/rsm_clustering/reorder.comp", NULL},
    {"rsm-clustering: update", "methods/rsm_clustering/update.comp", "SORTED 1"},
    {"rsm-clustering: update", "methods/rsm_clustering/update.comp", "SORTED 0"},
};

struct rsc_passes {
    struct irb_program *program[PASSES][2]; /* by the RSM's layout; made when first asked for */
    struct irb_sort *sort;
    struct irb_buffer *cell_keys, *list, *cell_starts; /* of the grid */
    struct irb_buffer *texel_keys, *records;           /* RSC_SORT only */
    struct irb_buffer *carry; /* sums of walks that go on in another dispatch */
    struct irb_cluster_counter counter;
};

struct rsc_clusters *rsc_clusters_create(struct irb_gl *gl, int resolution, struct irb_error *err)
{
    const struct irb_texture_desc map = {.name = "rsm-clustering: cluster map",
                                         .format = GL_R32UI,
                                         .width = resolution,
                                         .height = resolution};
    struct rsc_clusters *c = calloc(1, sizeof *c);
    struct rsc_passes *passes = calloc(1, sizeof *passes);
    if (!c || !passes) {
        free(c);
        free(passes);
        irb_fail(err, IRB_E_MEMORY, "rsm-clustering: out of memory");
        return NULL;
    }
    c->gl = gl;
    c->resolution = resolution;
    c->passes = passes;
    if ((c->map = irb_texture_create(gl, &map, err)) && (passes->sort = irb_sort_create(gl, err)) &&
        irb_cluster_counter_create(&passes->counter, gl, resolution, err))
        return c;
    rsc_clusters_destroy(c);
    return NULL;
}

void rsc_clusters_destroy(struct rsc_clusters *c)
{
    if (!c)
        return;
    struct rsc_passes *p = c->passes;
    for (int i = 0; i < PASSES; i++) {
        irb_program_destroy(p->program[i][IRB_LAYOUT_FULL]);
        irb_program_destroy(p->program[i][IRB_LAYOUT_SLIM]);
    }
    irb_sort_destroy(p->sort);
    irb_buffer_destroy(p->cell_keys);
    irb_buffer_destroy(p->list);
    irb_buffer_destroy(p->cell_starts);
    irb_buffer_destroy(p->texel_keys);
    irb_buffer_destroy(p->records);
    irb_buffer_destroy(p->carry);
    irb_cluster_counter_destroy(&p->counter);
    free(p);
    irb_buffer_destroy(c->clusters);
    irb_texture_destroy(c->map);
    free(c);
}

void rsc_clusters_forget(struct rsc_clusters *c)
{
    c->count = 0;
}

static int texel_bits_of(int resolution)
{
    int bits = 1;
    while ((int64_t)1 << bits < (int64_t)resolution * resolution)
        bits++;
    return bits;
}

/* One number stays unused, so that no key is the one that means nothing. */
int64_t rsc_most_sorted(int resolution)
{
    const int bits = KEY_BITS - texel_bits_of(resolution);
    return bits > 0 ? ((int64_t)1 << bits) - 1 : 0;
}

/* The grid is sqrt(k) x sqrt(k). */
static int cells_of(int clusters)
{
    int cells = (int)sqrt((double)clusters);
    while (cells * cells < clusters)
        cells++;
    return cells;
}

/* Fails where a buffer can't hold all records. */
static bool check_sort(const struct rsc_clusters *c, int clusters, struct irb_error *err)
{
    GLint64 bytes = 0;
    c->gl->api.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    if (clusters > rsc_most_sorted(c->resolution))
        return irb_fail(err, IRB_E_INTERNAL, "rsm-clustering: %d clusters in keys of %d bits",
                        clusters, KEY_BITS);
    if ((int64_t)c->resolution * c->resolution * RECORD_BYTES > bytes)
        return irb_fail(err, IRB_E_INPUT,
                        "rsm-clustering: reduction=sort copies the RSM, and %d x %d texels exceed "
                        "the driver's %lld MiB for one buffer; use reduction=window",
                        c->resolution, c->resolution, (long long)(bytes >> 20));
    return true;
}

/* Makes the buffer at least `bytes` large; what was in it is kept. */
static bool grow(struct irb_gl *gl, struct irb_buffer **buffer, const char *name, int64_t bytes,
                 struct irb_error *err)
{
    struct irb_buffer *old = *buffer;
    if (old && old->bytes >= bytes)
        return true;
    struct irb_buffer *grown = irb_buffer_create(gl, name, bytes, NULL, err);
    if (!grown)
        return false;
    if (old) {
        gl->api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        gl->api.CopyNamedBufferSubData(old->id, grown->id, 0, 0, old->bytes);
    }
    irb_buffer_destroy(old);
    *buffer = grown;
    return true;
}

bool rsc_clusters_prepare(struct rsc_clusters *c, const struct rsc_settings *s,
                          struct irb_error *err)
{
    struct rsc_passes *p = c->passes;
    const int64_t clusters = s->clusters, texels = (int64_t)c->resolution * c->resolution;
    const int64_t cells = cells_of(s->clusters);
    if (clusters < 1 || clusters > RSC_MOST_CLUSTERS)
        return irb_fail(err, IRB_E_INTERNAL, "rsm-clustering: %d clusters", s->clusters);
    if (!grow(c->gl, &c->clusters, "rsm-clustering: clusters",
              clusters * (int64_t)sizeof(struct rsc_cluster), err) ||
        !grow(c->gl, &p->cell_keys, "rsm-clustering: cell keys", irb_sort_bytes(s->clusters),
              err) ||
        !grow(c->gl, &p->list, "rsm-clustering: list", clusters * LIST_BYTES, err) ||
        !grow(c->gl, &p->cell_starts, "rsm-clustering: cells", (cells * cells + 1) * 4, err) ||
        !grow(c->gl, &p->carry, "rsm-clustering: carry", clusters * CARRY_BYTES, err))
        return false;
    return s->reduction != RSC_SORT ||
           (check_sort(c, s->clusters, err) &&
            grow(c->gl, &p->texel_keys, "rsm-clustering: texel keys", irb_sort_bytes((int)texels),
                 err) &&
            grow(c->gl, &p->records, "rsm-clustering: records", texels * RECORD_BYTES, err));
}

/* In use; NULL on failure. */
static const struct irb_program *use_pass(struct rsc_clusters *c, enum pass pass,
                                          enum irb_layout layout, struct irb_error *err)
{
    struct irb_program **program = &c->passes->program[pass][layout];
    char bits[32];
    snprintf(bits, sizeof bits, "CLUSTER_BITS %d", RSC_CLUSTER_BITS);
    const char *const defines[] = {bits, irb_rsm_define(layout), pass_table[pass].define, NULL};
    if (!*program)
        *program = irb_program_create(c->gl,
                                      &(struct irb_program_desc){.name = pass_table[pass].name,
                                                                 .compute = pass_table[pass].path,
                                                                 .defines = defines},
                                      err);
    if (*program)
        irb_program_use(*program);
    return *program;
}

static void bind(const struct rsc_clusters *c, int binding, const struct irb_buffer *buffer)
{
    c->gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)binding, buffer ? buffer->id : 0);
}

static void dispatch(const struct rsc_clusters *c, int width, int group)
{
    c->gl->api.DispatchCompute((unsigned)(width + group - 1) / (unsigned)group, 1, 1);
    c->gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

bool rsc_clusters_seed(struct rsc_clusters *c, const struct irb_rsm *rsm,
                       const struct irb_pyramid *pyramid, const struct rsc_settings *s,
                       struct irb_error *err)
{
    const struct irb_program *program = use_pass(c, SEED, rsm->layout, err);
    if (!program)
        return false;
    irb_rsm_bind(rsm, program, 0);
    irb_pyramid_bind(pyramid, program);
    bind(c, CLUSTERS_BINDING, c->clusters);
    bind(c, KEYS_BINDING, c->passes->cell_keys);
    irb_program_uint(program, "cluster_count", (unsigned)s->clusters);
    irb_program_uint(program, "kept_count", (unsigned)c->count);
    irb_program_uint(program, "first", s->first);
    irb_program_int(program, "cells", cells_of(s->clusters));
    dispatch(c, s->clusters, CLUSTER_GROUP);
    c->count = s->clusters;
    return irb_gl_check(c->gl, pass_table[SEED].name, err);
}

static void set_metric(const struct irb_program *program, const struct rsc_settings *s)
{
    irb_program_vec3(program, "metric_weights",
                     (const float[]){s->weight_distance, s->weight_normal, s->weight_colour});
}

bool rsc_clusters_grid(struct rsc_clusters *c, const struct rsc_settings *s, struct irb_error *err)
{
    const int cells = cells_of(s->clusters);
    const struct irb_program *program = NULL;
    if (!irb_sort_run(c->passes->sort, c->passes->cell_keys, s->clusters, err) ||
        !(program = use_pass(c, LIST, IRB_LAYOUT_FULL, err)))
        return false;
    set_metric(program, s);
    bind(c, CLUSTERS_BINDING, c->clusters);
    bind(c, KEYS_BINDING, c->passes->cell_keys);
    bind(c, LIST_BINDING, c->passes->list);
    bind(c, CELLS_BINDING, c->passes->cell_starts);
    irb_program_uint(program, "cluster_count", (unsigned)s->clusters);
    irb_program_int(program, "cells", cells);
    dispatch(c, cells * cells + 1, CLUSTER_GROUP); /* more than there are clusters */
    return irb_gl_check(c->gl, pass_table[LIST].name, err);
}

bool rsc_clusters_assign(struct rsc_clusters *c, const struct irb_rsm *rsm,
                         const struct rsc_settings *s, struct irb_error *err)
{
    const struct irb_gl_api *api = &c->gl->api;
    const struct irb_program *program = use_pass(c, ASSIGN, rsm->layout, err);
    const unsigned groups = (unsigned)(c->resolution + TEXEL_GROUP - 1) / TEXEL_GROUP;
    if (!program)
        return false;
    irb_rsm_bind(rsm, program, 0);
    set_metric(program, s);
    bind(c, KEYS_BINDING, s->reduction == RSC_SORT ? c->passes->texel_keys : NULL);
    bind(c, LIST_BINDING, c->passes->list);
    bind(c, CELLS_BINDING, c->passes->cell_starts);
    api->BindImageTexture(0, c->map->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32UI);
    irb_program_int(program, "cells", cells_of(s->clusters));
    irb_program_int(program, "reach", s->reach);
    irb_program_int(program, "texel_bits",
                    s->reduction == RSC_SORT ? texel_bits_of(c->resolution) : 0);
    api->DispatchCompute(groups, groups, 1);
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                       GL_TEXTURE_UPDATE_BARRIER_BIT);
    return irb_gl_check(c->gl, pass_table[ASSIGN].name, err);
}

bool rsc_clusters_sort(struct rsc_clusters *c, const struct irb_rsm *rsm,
                       const struct rsc_settings *s, struct irb_error *err)
{
    const int texels = c->resolution * c->resolution;
    const struct irb_program *program = NULL;
    if (s->reduction != RSC_SORT)
        return true;
    if (!irb_sort_run(c->passes->sort, c->passes->texel_keys, texels, err) ||
        !(program = use_pass(c, REORDER, rsm->layout, err)))
        return false;
    irb_rsm_bind(rsm, program, 0);
    bind(c, KEYS_BINDING, c->passes->texel_keys);
    bind(c, RECORDS_BINDING, c->passes->records);
    irb_program_int(program, "texel_bits", texel_bits_of(c->resolution));
    dispatch(c, texels, REORDER_GROUP);
    return irb_gl_check(c->gl, pass_table[REORDER].name, err);
}

const char *rsc_members_define(const struct rsc_settings *s)
{
    return s->reduction == RSC_SORT ? "SORTED 1" : "SORTED 0";
}

void rsc_members_bind(const struct rsc_clusters *c, const struct irb_program *program,
                      const struct irb_rsm *rsm, const struct rsc_settings *s)
{
    const int unit = irb_rsm_bind(rsm, program, 0);
    bind(c, CLUSTERS_BINDING, c->clusters);
    bind(c, CARRY_BINDING, c->passes->carry);
    irb_program_uint(program, "cluster_count", (unsigned)s->clusters);
    irb_program_float(program, "flux_unit", irb_rsm_flux_unit(rsm));
    if (s->reduction == RSC_SORT) {
        bind(c, KEYS_BINDING, c->passes->texel_keys);
        bind(c, RECORDS_BINDING, c->passes->records);
        irb_program_int(program, "texel_bits", texel_bits_of(c->resolution));
        irb_program_uint(program, "texel_count", (unsigned)(c->resolution * c->resolution));
        return;
    }
    c->gl->api.BindTextureUnit((GLuint)unit, c->map->id);
    irb_program_int(program, "cluster_map", unit);
    irb_program_int(program, "cells", cells_of(s->clusters));
    irb_program_int(program, "reach", s->reduction == RSC_WINDOW ? s->reach : -1);
}

/* Texels that a cluster walks over, at most: all may be its own. */
static int64_t longest_walk(const struct rsc_clusters *c, const struct rsc_settings *s)
{
    const int64_t n = c->resolution, cells = cells_of(s->clusters);
    const int64_t window = ((2 * (int64_t)s->reach + 1) * n + cells - 1) / cells;
    const int64_t side = s->reduction == RSC_WINDOW && s->reach >= 0 && window < n ? window : n;
    return side * side;
}

void rsc_members_dispatch(const struct rsc_clusters *c, const struct irb_program *program,
                          const struct rsc_settings *s, int rounds, int width, int group)
{
    const int64_t texels = longest_walk(c, s), at_once = IRB_LOOP_ROUNDS_MOST / rounds;
    irb_program_uint(program, "part_rounds", (unsigned)at_once);
    for (int64_t part = 0; part * at_once < texels; part++) {
        irb_program_uint(program, "part", (unsigned)part);
        dispatch(c, width, group);
    }
}

bool rsc_clusters_update(struct rsc_clusters *c, const struct irb_rsm *rsm,
                         const struct rsc_settings *s, struct irb_error *err)
{
    const enum pass pass = s->reduction == RSC_SORT ? UPDATE_SORTED : UPDATE_DIRECT;
    const struct irb_program *program = use_pass(c, pass, rsm->layout, err);
    if (!program)
        return false;
    rsc_members_bind(c, program, rsm, s);
    rsc_members_dispatch(c, program, s, 1, s->clusters, UPDATE_GROUP);
    return irb_gl_check(c->gl, pass_table[pass].name, err);
}

static bool count_clusters(const struct rsc_clusters *c, struct rsc_census *census,
                           struct irb_error *err)
{
    const size_t bytes = (size_t)c->count * sizeof(struct rsc_cluster);
    struct rsc_cluster *clusters = malloc(bytes + 1);
    if (!clusters)
        return irb_fail(err, IRB_E_MEMORY, "rsm-clustering: out of memory");
    bool ok = !c->count || irb_buffer_read(c->clusters, 0, (int64_t)bytes, clusters, err);
    for (int i = 0; ok && i < c->count; i++) {
        census->in_use += clusters[i].texels > 0;
        census->seeded += clusters[i].seeded > 0;
    }
    free(clusters);
    return ok;
}

bool rsc_clusters_count(struct rsc_clusters *c, const struct irb_rsm *rsm,
                        struct rsc_census *census, struct irb_error *err)
{
    *census = (struct rsc_census){0};
    return irb_cluster_count(&c->passes->counter, rsm, c->map, &census->texels, err) &&
           count_clusters(c, census, err);
}
