/* SPDX-License-Identifier: MIT
 *
 * Buffers, programs and the life of a set of clusters.
 */
#include "methods/acrsm/clusters.h"

#include "core/sampling/sobol.h"

#include <stdio.h>
#include <stdlib.h>

/* Shader storage and uniform bindings of shaders/methods/acrsm/; 2 is the pyramid's. */
enum {
    CLUSTERS_BINDING = 0,
    EVALUATION_BINDING = 1,
    LISTS_BINDING = 3,
    CANDIDATES_BINDING = 4,
    PRESENCE_BINDING = 5,
    LIGHTS_BINDING = 6,
    CARRY_BINDING = 7,
};
enum { TILE_SIDE = 32 };
enum { CARRY_BYTES = 64 }; /* of one invocation, at most */

/* For acrsm_cluster.count; shaders/methods/acrsm/cluster.glsl. */
enum { UNBORN = -1 };

static const struct {
    const char *path;
    const char *define; /* NULL, or beside that of the RSM's layout */
    const char *other;
} sources[ACRSM_PROGRAMS] = {
    [ACRSM_EVALUATE] = {"evaluate.comp", "NEIGHBOURS 0"},
    [ACRSM_EVALUATE_MAP] = {"evaluate.comp", "NEIGHBOURS 1"},
    [ACRSM_MERGE_SPLIT] = {"merge_split.comp"},
    [ACRSM_CARRY_LIGHT] = {"carry.comp", "SPACE 0"},
    [ACRSM_CARRY_WORLD] = {"carry.comp", "SPACE 1"},
    [ACRSM_RESEED] = {"reseed.comp"},
    [ACRSM_SEED] = {"seed.comp"},
    [ACRSM_BIN] = {"bin.comp"},
    [ACRSM_MAP] = {"map.comp", "COVER 0", "SIGNED_NORMALS 0"},
    [ACRSM_MAP + 1] = {"map.comp", "COVER 0", "SIGNED_NORMALS 1"},
    [ACRSM_MAP + 2] = {"map.comp", "COVER 1", "SIGNED_NORMALS 0"},
    [ACRSM_MAP + 3] = {"map.comp", "COVER 1", "SIGNED_NORMALS 1"},
    [ACRSM_AVERAGE] = {"average.comp"},
    [ACRSM_CENTRES] = {"centres.comp"},
    [ACRSM_LIGHTS] = {"lights.comp", "FLUX 0"},
    [ACRSM_LIGHTS + 1] = {"lights.comp", "FLUX 1"},
    [ACRSM_LIGHTS + 2] = {"lights.comp", "FLUX 2"},
    [ACRSM_PICTURE] = {"debug.comp", "LAYER 0"},
    [ACRSM_PICTURE + 1] = {"debug.comp", "LAYER 1"},
};

static void destroy_programs(struct acrsm_clusters *c)
{
    for (int i = 0; i < ACRSM_PROGRAMS; i++) {
        irb_program_destroy(c->program[i]);
        c->program[i] = NULL;
    }
}

const struct irb_program *acrsm_program(struct acrsm_clusters *c, enum acrsm_program which,
                                        struct irb_error *err)
{
    char path[64], name[64];
    const char *const defines[] = {irb_rsm_define(c->layout), sources[which].define,
                                   sources[which].other, NULL};
    if (c->program[which])
        return c->program[which];
    snprintf(path, sizeof path, "methods/acrsm/%s", sources[which].path);
    snprintf(name, sizeof name, "acrsm: %s", sources[which].path);
    c->program[which] = irb_program_create(
        c->gl, &(struct irb_program_desc){.name = name, .compute = path, .defines = defines}, err);
    return c->program[which];
}

static int64_t tile_count(int resolution)
{
    int64_t tiles = (resolution + TILE_SIDE - 1) / TILE_SIDE;
    return tiles * tiles;
}

static bool create_buffers(struct acrsm_clusters *c, struct irb_error *err)
{
    const int64_t most = ACRSM_CLUSTERS_MOST, tiles = tile_count(c->resolution);
    const int64_t words = (tiles + 31) / 32;
    struct irb_gl *gl = c->gl;
    return (c->state = irb_buffer_create(
                gl, "acrsm: clusters", most * (int64_t)sizeof(struct acrsm_cluster), NULL, err)) &&
           (c->evaluation = irb_buffer_create(
                gl, "acrsm: evaluation", most * (int64_t)(sizeof(struct acrsm_verification) + 4),
                NULL, err)) &&
           (c->lists = irb_buffer_create(gl, "acrsm: lists", 16 + most * 8, NULL, err)) &&
           (c->candidates =
                irb_buffer_create(gl, "acrsm: candidates", tiles * (most / 8), NULL, err)) &&
           (c->presence = irb_buffer_create(gl, "acrsm: presence", words * 4 * most, NULL, err)) &&
           irb_cluster_counter_create(&c->counter, gl, c->resolution, err) &&
           (c->lights =
                irb_buffer_create(gl, "acrsm: lights", IRB_VPL_BLOCK * IRB_VPL_BYTES, NULL, err));
}

struct acrsm_clusters *acrsm_clusters_create(struct irb_gl *gl, int rsm_resolution,
                                             struct irb_error *err)
{
    struct acrsm_clusters *c = calloc(1, sizeof *c);
    if (!c) {
        irb_fail(err, IRB_E_MEMORY, "acrsm: out of memory");
        return NULL;
    }
    c->gl = gl;
    c->resolution = rsm_resolution;
    const struct irb_texture_desc desc = {.name = "acrsm: cluster map",
                                          .format = GL_RG32UI,
                                          .width = rsm_resolution,
                                          .height = rsm_resolution};
    if ((c->map = irb_texture_create(gl, &desc, err)) && create_buffers(c, err) &&
        acrsm_clusters_begin(c, 0, err))
        return c;
    acrsm_clusters_destroy(c);
    return NULL;
}

void acrsm_clusters_destroy(struct acrsm_clusters *c)
{
    if (!c)
        return;
    destroy_programs(c);
    irb_texture_destroy(c->map);
    irb_buffer_destroy(c->state);
    irb_buffer_destroy(c->evaluation);
    irb_buffer_destroy(c->lights);
    irb_buffer_destroy(c->lists);
    irb_buffer_destroy(c->candidates);
    irb_buffer_destroy(c->presence);
    irb_cluster_counter_destroy(&c->counter);
    irb_buffer_destroy(c->carry);
    free(c);
}

static bool write_zeros(const struct irb_buffer *buffer, struct irb_error *err)
{
    void *zeros = calloc(1, (size_t)buffer->bytes);
    if (!zeros)
        return irb_fail(err, IRB_E_MEMORY, "acrsm: out of memory");
    bool ok = irb_buffer_write((struct irb_buffer *)buffer, 0, buffer->bytes, zeros, err);
    free(zeros);
    return ok;
}

bool acrsm_clusters_begin(struct acrsm_clusters *c, uint64_t seed, struct irb_error *err)
{
    c->active = 0;
    c->frame = 0;
    c->lit_once = false;
    c->seed = irb_hash_u32((uint32_t)seed, (uint32_t)(seed >> 32));
    return write_zeros(c->state, err) && write_zeros(c->evaluation, err) &&
           write_zeros(c->lists, err) && write_zeros(c->lights, err);
}

/* Clusters first..count-1 have never been seeded. */
static bool write_unborn(struct acrsm_clusters *c, int first, int count, struct irb_error *err)
{
    struct acrsm_cluster unborn[ACRSM_CLUSTERS_MOST] = {0};
    for (int i = first; i < count; i++)
        unborn[i].count = UNBORN;
    const int64_t size = sizeof *unborn;
    return count <= first ||
           irb_buffer_write(c->state, first * size, (count - first) * size, unborn + first, err);
}

bool acrsm_clusters_frame(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                          const struct acrsm_settings *settings, struct irb_error *err)
{
    if (rsm->resolution != c->resolution || settings->clusters < 1 ||
        settings->clusters > ACRSM_CLUSTERS_MOST)
        return irb_fail(err, IRB_E_INTERNAL,
                        "acrsm: %d clusters over %d texels a side, made for %d", settings->clusters,
                        rsm->resolution, c->resolution);
    if (rsm->layout != c->layout)
        destroy_programs(c);
    c->layout = rsm->layout;
    bool ok = write_unborn(c, c->active, settings->clusters, err);
    c->active = settings->clusters;
    c->frame++;
    return ok;
}

void acrsm_bind_buffers(const struct acrsm_clusters *c)
{
    const struct irb_gl_api *api = &c->gl->api;
    api->BindBufferBase(GL_UNIFORM_BUFFER, CLUSTERS_BINDING, c->state->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, CLUSTERS_BINDING, c->state->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, EVALUATION_BINDING, c->evaluation->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, LISTS_BINDING, c->lists->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, CANDIDATES_BINDING, c->candidates->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, PRESENCE_BINDING, c->presence->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, LIGHTS_BINDING, c->lights->id);
}

void acrsm_barrier(const struct acrsm_clusters *c)
{
    c->gl->api.MemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                             GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                             GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void acrsm_dispatch(const struct acrsm_clusters *c, int64_t invocations)
{
    c->gl->api.DispatchCompute((unsigned)((invocations + ACRSM_GROUP - 1) / ACRSM_GROUP), 1, 1);
    acrsm_barrier(c);
}

/* Makes and binds what a pass leaves for its next dispatch. */
static bool prepare_carry(struct acrsm_clusters *c, struct irb_error *err)
{
    const int64_t bytes = (int64_t)ACRSM_CLUSTERS_MOST * ACRSM_GROUP * CARRY_BYTES;
    if (!c->carry && !(c->carry = irb_buffer_create(c->gl, "acrsm: carry", bytes, NULL, err)))
        return false;
    c->gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, CARRY_BINDING, c->carry->id);
    return true;
}

bool acrsm_dispatch_parts(struct acrsm_clusters *c, const struct irb_program *program, int parts,
                          int at_once, struct irb_error *err)
{
    if (parts > at_once && !prepare_carry(c, err))
        return false;
    for (int first = 0; first < parts; first += at_once) {
        irb_program_int(program, "first_part", first);
        irb_program_int(program, "end_part", first + at_once < parts ? first + at_once : parts);
        acrsm_dispatch(c, ACRSM_GROUP * (int64_t)c->active);
    }
    return true;
}

uint32_t acrsm_frame_seed(const struct acrsm_clusters *c)
{
    return irb_hash_u32(c->seed, c->frame);
}
