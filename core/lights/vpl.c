/* SPDX-License-Identifier: MIT */
#include "core/lights/vpl.h"

#include <math.h>
#include <stdlib.h>

const char *const irb_vpl_sampling_names[] = {"all", "uniform", "importance", "map", NULL};

/* Shader storage bindings of shaders/lights/. */
enum { LIGHTS_BINDING = 0, RUNS_BINDING = 1, COUNTER_BINDING = 3 }; /* 2: the pyramid */
enum { RUN_GROUP = 64 };                                            /* work group size there */

struct irb_vpl_sampler {
    struct irb_program *count, *scan, *write;
    struct irb_pyramid *pyramid; /* of the flux; IMPORTANCE only */
    struct irb_buffer *runs;
    int resolution;
    enum irb_layout layout; /* of the RSM that the programs read */
};

static struct irb_program *create_program(struct irb_gl *gl, enum irb_vpl_sampling sampling,
                                          enum irb_layout layout, const char *name,
                                          const char *path, struct irb_error *err)
{
    static const char *const sampling_defines[] = {"SAMPLING 0", "SAMPLING 1", "SAMPLING 2",
                                                   "SAMPLING 3"};
    const char *const defines[] = {sampling_defines[sampling], irb_rsm_define(layout), NULL};
    return irb_program_create(
        gl, &(struct irb_program_desc){.name = name, .compute = path, .defines = defines}, err);
}

static void destroy_programs(struct irb_vpl_sampler *s)
{
    struct irb_program **const programs[] = {&s->count, &s->scan, &s->write};
    for (size_t i = 0; i < sizeof programs / sizeof *programs; i++) {
        irb_program_destroy(*programs[i]);
        *programs[i] = NULL;
    }
}

static bool create_programs(struct irb_vpl_set *set, enum irb_layout layout, struct irb_error *err)
{
    struct irb_gl *gl = set->gl;
    struct irb_vpl_sampler *s = set->sampler;
    const enum irb_vpl_sampling sampling = set->sampling;
    destroy_programs(s);
    s->layout = layout;
    return (s->count =
                create_program(gl, sampling, layout, "vpl: count", "lights/vpl_count.comp", err)) &&
           (s->scan =
                create_program(gl, sampling, layout, "vpl: scan", "lights/vpl_scan.comp", err)) &&
           (s->write =
                create_program(gl, sampling, layout, "vpl: write", "lights/vpl_write.comp", err));
}

/* Candidates that one invocation walks through: about the square root of their number, which
 * balances the parallel passes and the sequential scan between them. */
static int run_length_of(int candidates)
{
    int length = (int)sqrt((double)candidates);
    return length > 0 ? length : 1;
}

static int run_count_of(int candidates)
{
    int length = run_length_of(candidates);
    return (candidates + length - 1) / length;
}

static bool create_sampler(struct irb_vpl_set *set, int resolution, struct irb_error *err)
{
    struct irb_gl *gl = set->gl;
    struct irb_vpl_sampler *s = set->sampler = calloc(1, sizeof *s);
    if (!s)
        return irb_fail(err, IRB_E_MEMORY, "out of memory");
    s->resolution = resolution;
    if (create_programs(set, IRB_LAYOUT_FULL, err))
        /* the most runs that any number of candidates up to the capacity has, with some to spare */
        s->runs = irb_buffer_create(gl, "vpl: runs", 4 * (run_count_of(set->capacity) + (int64_t)8),
                                    NULL, err);
    if (s->runs && set->sampling == IRB_VPL_IMPORTANCE)
        s->pyramid = irb_pyramid_create(gl, resolution, err);
    return s->runs && (set->sampling != IRB_VPL_IMPORTANCE || s->pyramid);
}

/* Fails unless the lights fit into what a shader storage block can hold. */
static bool check_size(struct irb_gl *gl, int64_t lights, int64_t resolution, struct irb_error *err)
{
    GLint64 most = 0;
    gl->api.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (lights < 1 || resolution < 1)
        return irb_fail(err, IRB_E_INTERNAL, "virtual lights: room for %lld of an RSM of %lld",
                        (long long)lights, (long long)resolution);
    if (lights * IRB_VPL_BYTES > most)
        return irb_fail(err, IRB_E_INPUT,
                        "virtual lights: %lld lights from an RSM of %lld x %lld texels exceed the "
                        "driver's %lld MiB for one buffer; use a smaller RSM or fewer samples",
                        (long long)lights, (long long)resolution, (long long)resolution,
                        (long long)(most >> 20));
    return true;
}

struct irb_vpl_set *irb_vpl_set_create(struct irb_gl *gl, enum irb_vpl_sampling sampling,
                                       int rsm_resolution, int capacity, struct irb_error *err)
{
    int64_t lights = capacity, texels = (int64_t)rsm_resolution * rsm_resolution;
    if (sampling == IRB_VPL_ALL && lights < texels)
        lights = texels;
    int64_t blocks = (lights + IRB_VPL_BLOCK - 1) / IRB_VPL_BLOCK;
    if (!check_size(gl, blocks * IRB_VPL_BLOCK, rsm_resolution, err))
        return NULL;
    struct irb_vpl_set *set = calloc(1, sizeof *set);
    if (!set) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    set->gl = gl;
    set->sampling = sampling;
    set->capacity = (int)lights;
    set->lights =
        irb_buffer_create(gl, "vpl: lights", blocks * IRB_VPL_BLOCK * IRB_VPL_BYTES, NULL, err);
    if (set->lights)
        set->counter = irb_buffer_create(gl, "vpl: counter", sizeof(uint32_t), NULL, err);
    if (set->counter && create_sampler(set, rsm_resolution, err))
        return set;
    irb_vpl_set_destroy(set);
    return NULL;
}

void irb_vpl_set_destroy(struct irb_vpl_set *set)
{
    if (!set)
        return;
    if (set->sampler) {
        destroy_programs(set->sampler);
        irb_pyramid_destroy(set->sampler->pyramid);
        irb_buffer_destroy(set->sampler->runs);
        free(set->sampler);
    }
    irb_buffer_destroy(set->lights);
    irb_buffer_destroy(set->counter);
    free(set);
}

static void set_candidates(const struct irb_vpl_set *set, const struct irb_program *program,
                           const struct irb_rsm *rsm, const struct irb_pyramid *pyramid,
                           int candidates, unsigned first)
{
    irb_program_use(program);
    irb_rsm_bind(rsm, program, 0);
    if (pyramid)
        irb_pyramid_bind(pyramid, program);
    irb_program_float(program, "normal_offset", set->normal_offset);
    irb_program_int(program, "resolution", set->sampler->resolution);
    irb_program_uint(program, "candidates", (unsigned)candidates);
    irb_program_uint(program, "first", first);
    irb_program_uint(program, "tiles", set->tiles > 1 ? (unsigned)set->tiles : 1u);
    irb_program_uint(program, "run_length", (unsigned)run_length_of(candidates));
}

static void bind_outputs(const struct irb_vpl_set *set)
{
    const struct irb_gl_api *api = &set->gl->api;
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, LIGHTS_BINDING, set->lights->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, RUNS_BINDING, set->sampler->runs->id);
    api->BindBufferBase(GL_SHADER_STORAGE_BUFFER, COUNTER_BINDING, set->counter->id);
}

/* Zero flux from the last light to the end of its block. */
static bool clear_rest(const struct irb_vpl_set *set, struct irb_error *err)
{
    static const char zeros[IRB_VPL_BLOCK * IRB_VPL_BYTES];
    int64_t rest = (int64_t)irb_vpl_set_blocks(set) * IRB_VPL_BLOCK - set->count;
    return !rest || irb_buffer_write(set->lights, (int64_t)set->count * IRB_VPL_BYTES,
                                     rest * IRB_VPL_BYTES, zeros, err);
}

/* Count, scan, write. */
static bool run_passes(struct irb_vpl_set *set, const struct irb_rsm *rsm,
                       const struct irb_pyramid *pyramid, int candidates, unsigned first,
                       struct irb_error *err)
{
    const struct irb_gl_api *api = &set->gl->api;
    const struct irb_vpl_sampler *s = set->sampler;
    const int runs = run_count_of(candidates);
    const unsigned groups = (unsigned)(runs + RUN_GROUP - 1) / RUN_GROUP;

    bind_outputs(set);
    set_candidates(set, s->count, rsm, pyramid, candidates, first);
    api->DispatchCompute(groups, 1, 1);
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    irb_program_use(s->scan);
    irb_program_uint(s->scan, "run_count", (unsigned)runs);
    api->DispatchCompute(1, 1, 1);
    api->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    set_candidates(set, s->write, rsm, pyramid, candidates, first);
    api->DispatchCompute(groups, 1, 1);
    api->MemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                       GL_SHADER_STORAGE_BARRIER_BIT);
    uint32_t count = 0;
    if (!irb_buffer_read(set->counter, 0, sizeof count, &count, err))
        return false;
    set->count = (int)count;
    return clear_rest(set, err) && irb_gl_check(set->gl, "vpl: sample", err);
}

/* Whether the set is of the kind, and made for the RSM and as many candidates; its programs are
 * made anew where the RSM has another layout. */
static bool prepare(struct irb_vpl_set *set, const struct irb_rsm *rsm, bool map, int candidates,
                    struct irb_error *err)
{
    const struct irb_vpl_sampler *s = set->sampler;
    if (map != (set->sampling == IRB_VPL_MAP))
        return irb_fail(err, IRB_E_INTERNAL, "virtual lights: made for the sampling '%s'",
                        irb_vpl_sampling_names[set->sampling]);
    if (rsm->resolution != s->resolution || candidates < 1 || candidates > set->capacity)
        return irb_fail(err, IRB_E_INTERNAL,
                        "virtual lights: made for %d of an RSM of %d texels a side, asked for %d "
                        "of one of %d",
                        set->capacity, s->resolution, candidates, rsm->resolution);
    return rsm->layout == s->layout || create_programs(set, rsm->layout, err);
}

bool irb_vpl_set_sample(struct irb_vpl_set *set, const struct irb_rsm *rsm, int samples,
                        unsigned first, struct irb_error *err)
{
    const struct irb_vpl_sampler *s = set->sampler;
    const int candidates = set->sampling == IRB_VPL_ALL ? s->resolution * s->resolution : samples;
    return prepare(set, rsm, false, candidates, err) &&
           (!s->pyramid || irb_pyramid_build_flux(s->pyramid, rsm, err)) &&
           run_passes(set, rsm, s->pyramid, candidates, first, err);
}

bool irb_vpl_set_sample_map(struct irb_vpl_set *set, const struct irb_rsm *rsm,
                            const struct irb_pyramid *pyramid, int samples, unsigned first,
                            struct irb_error *err)
{
    if (pyramid->resolution != rsm->resolution)
        return irb_fail(err, IRB_E_INTERNAL,
                        "virtual lights: a pyramid of %d texels a side for an RSM of %d",
                        pyramid->resolution, rsm->resolution);
    return prepare(set, rsm, true, samples, err) &&
           run_passes(set, rsm, pyramid, samples, first, err);
}
