/* SPDX-License-Identifier: MIT
 *
 * Convolution soft shadow maps of distances that a test writes, and look-ups in them. Include after
 * compare.h.
 */
#ifndef IRB_TESTS_LIGHTS_CSM_FIXTURE_H
#define IRB_TESTS_LIGHTS_CSM_FIXTURE_H

#include "core/lights/csm.h"
#include "tests/lights/raster_fixture.h"

/* Distance (m, INFINITY for nothing) that texel (x, y) of a face of a map holds; d is its unit
 * direction, or NULL where a paraboloid has none. */
typedef double (*csm_distance)(const void *user, int map, int face, int x, int y,
                               const double d[3]);

/* Kinds of query in shaders/test_csm.comp. */
enum { CSM_VISIBILITY, CSM_LIT, CSM_BLOCKER };

struct csm_query {
    float q[3], map;
    float radius, kind, side, z;
};

struct csm_fixture {
    struct irb_raster_maps *maps;
    struct irb_csm *csm;
    struct irb_csm_settings settings;
    struct irb_program *program;
    float range[IRB_CSM_MAPS_MOST]; /* farthest distance of each map, m */
};

static const struct irb_csm_settings csm_plain = {
    .scale = 1, .search_scale = 1, .penumbra_scale = 1};

static inline void csm_fill(struct csm_fixture *f, csm_distance distance, const void *user)
{
    struct irb_error err = {0};
    struct irb_image image;
    const int size = f->maps->size, layers = f->maps->capacity * f->maps->faces;
    REQUIRE_OK(irb_image_create(&image, size, size * layers, 1, &err));
    for (int layer = 0; layer < layers; layer++) {
        const int map = layer / f->maps->faces, face = layer % f->maps->faces;
        if (!face)
            f->range[map] = 0;
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++) {
                double d[3];
                bool inside = fixture_texel_direction(f->maps->projection, size, face, x, y, d);
                float value = (float)distance(user, map, face, x, y, inside ? d : NULL);
                if (isfinite(value))
                    f->range[map] = fmaxf(f->range[map], value);
                image.data[(layer * size + size - 1 - y) * size + x] = value;
            }
    }
    REQUIRE_OK(irb_texture_write(f->maps->distance, &image, &err));
    f->maps->count = f->maps->capacity;
    irb_image_destroy(&image);
}

static inline void csm_create(struct csm_fixture *f, struct irb_gl *gl,
                              enum irb_raster_projection projection, int size, int capacity,
                              csm_distance distance, const void *user)
{
    struct irb_error err = {0};
    *f = (struct csm_fixture){.settings = csm_plain};
    f->maps = irb_raster_maps_create(gl, projection, size, capacity, &err);
    REQUIRE_OK(f->maps);
    csm_fill(f, distance, user);
}

static inline void csm_destroy(struct csm_fixture *f)
{
    irb_program_destroy(f->program);
    irb_csm_destroy(f->csm);
    irb_raster_maps_destroy(f->maps);
}

/* Basis images of the maps as they are, with f->settings. */
static inline void csm_update(const struct csm_fixture *f)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_csm_basis(f->csm, f->maps, &f->settings, &err));
    REQUIRE_OK(irb_csm_prefilter(f->csm, &err));
}

/* Basis images of another order or prefilter. */
static inline void csm_make(struct csm_fixture *f, int order, enum irb_csm_prefilter prefilter)
{
    struct irb_error err = {0};
    struct irb_csm_defines defines;
    irb_program_destroy(f->program);
    irb_csm_destroy(f->csm);
    f->csm = irb_csm_create(f->maps->gl, f->maps->projection, f->maps->size, f->maps->capacity,
                            order, prefilter, &err);
    REQUIRE_OK(f->csm);
    csm_update(f);
    irb_csm_defines(f->csm, 2, &defines);
    f->program = irb_program_create(f->maps->gl,
                                    &(struct irb_program_desc){.name = "test csm",
                                                               .compute = "test_csm.comp",
                                                               .defines = defines.list},
                                    &err);
    REQUIRE_OK(f->program);
}

/* One answer a query; the caller frees them. */
static inline float *csm_ask(const struct csm_fixture *f, const struct csm_query *queries,
                             int count)
{
    struct irb_error err = {0};
    struct irb_gl *gl = f->maps->gl;
    const int64_t bytes = (int64_t)count * (int64_t)sizeof(float);
    float *answers = malloc((size_t)bytes);
    struct irb_buffer *in =
        irb_buffer_create(gl, "queries", count * (int64_t)sizeof *queries, queries, &err);
    struct irb_buffer *out = irb_buffer_create(gl, "answers", bytes, NULL, &err);
    REQUIRE_OK(in && out);
    irb_program_use(f->program);
    irb_csm_bind(f->csm, f->program, &f->settings, 2, 0);
    irb_program_uint(f->program, "count", (unsigned)count);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, in->id);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, out->id);
    gl->api.DispatchCompute((unsigned)(count + 63) / 64, 1, 1);
    REQUIRE_OK(irb_buffer_read(out, 0, bytes, answers, &err));
    irb_buffer_destroy(in);
    irb_buffer_destroy(out);
    for (int i = 0; i < count; i++)
        assert_true(isfinite(answers[i]));
    return answers;
}

#endif
