/* SPDX-License-Identifier: MIT */
#include "core/lights/csm.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *const irb_csm_prefilter_names[] = {"mip", "sat", NULL};

/* Bindings and work groups of shaders/lights/csm_*.comp. */
enum { RANGES_BINDING = 0, IMAGES_BINDING = 0, GROUP = 8, LINE_GROUP = 64 };

struct irb_csm_passes {
    struct irb_program *range, *basis, *filter;
};

static int faces_of(enum irb_raster_projection projection)
{
    return projection == IRB_RASTER_HEMICUBE ? 3 : 1;
}

/* CSM_LAYERS. */
static int layers_of(int order)
{
    return 1 + 2 * ((order + 1) / 2);
}

int irb_csm_most(struct irb_gl *gl, enum irb_raster_projection projection, int size, int order)
{
    const int layers = faces_of(projection) * layers_of(order);
    const int64_t bytes = (int64_t)size * size * layers * 16 * 4 / 3; /* mipmaps: a third more */
    GLint most_layers = 0;

    gl->api.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_layers);
    int64_t most = ((int64_t)IRB_CSM_MOST_MIB << 20) / (bytes > 0 ? bytes : 1);
    most = most < most_layers / layers ? most : most_layers / layers;
    most = most < IRB_CSM_MAPS_MOST ? most : IRB_CSM_MAPS_MOST;
    return most > 1 ? (int)most : 1;
}

static bool check(struct irb_gl *gl, enum irb_raster_projection projection, int size, int capacity,
                  int order, struct irb_error *err)
{
    if (size < 4 || size & (size - 1))
        return irb_fail(err, IRB_E_INPUT,
                        "soft shadow maps: expected a power of two of at least 4 texels, found %d",
                        size);
    if (order < 1 || order > IRB_CSM_ORDER_MOST)
        return irb_fail(err, IRB_E_INPUT, "soft shadow maps: expected an order of 1..%d, found %d",
                        IRB_CSM_ORDER_MOST, order);
    const int most = irb_csm_most(gl, projection, size, order);
    if (capacity < 1 || capacity > most)
        return irb_fail(err, IRB_E_INPUT,
                        "soft shadow maps: expected 1..%d maps of %d x %d texels and order %d at a "
                        "time (%d MiB), found %d",
                        most, size, size, order, IRB_CSM_MOST_MIB, capacity);
    return true;
}

static bool create_programs(struct irb_csm *csm, struct irb_error *err)
{
    struct irb_csm_passes *p = csm->passes;
    char order[32];
    snprintf(order, sizeof order, "CSM_ORDER %d", csm->order);
    const char *const defines[] = {order, NULL};
    const struct irb_program_desc range = {.name = "csm: range",
                                           .compute = "lights/csm_range.comp"};
    const struct irb_program_desc basis = {
        .name = "csm: basis", .compute = "lights/csm_basis.comp", .defines = defines};
    const struct irb_program_desc filter = {
        .name = "csm: prefilter",
        .compute = csm->prefilter == IRB_CSM_SAT ? "lights/csm_sat.comp" : "lights/csm_mip.comp"};
    return (p->range = irb_program_create(csm->gl, &range, err)) &&
           (p->basis = irb_program_create(csm->gl, &basis, err)) &&
           (p->filter = irb_program_create(csm->gl, &filter, err));
}

static bool create_objects(struct irb_csm *csm, struct irb_error *err)
{
    const struct irb_texture_desc desc = {.name = "csm: images",
                                          .format = GL_RGBA32F,
                                          .width = csm->size,
                                          .height = csm->size,
                                          .layers =
                                              csm->capacity * csm->faces * layers_of(csm->order),
                                          .levels = csm->levels,
                                          .linear = true};
    if (!(csm->passes = calloc(1, sizeof *csm->passes)))
        return irb_fail(err, IRB_E_MEMORY, "out of memory");
    return (csm->images = irb_texture_create(csm->gl, &desc, err)) &&
           (csm->ranges = irb_buffer_create(csm->gl, "csm: ranges", (int64_t)IRB_CSM_MAPS_MOST * 16,
                                            NULL, err)) &&
           (csm->weights = irb_buffer_create(csm->gl, "csm: weights",
                                             (int64_t)IRB_CSM_ORDER_MOST * 16, NULL, err)) &&
           create_programs(csm, err);
}

/* Mipmaps down to 2 x 2, so that a texel never holds both halves of a hemicube's face. */
static int levels_of(enum irb_csm_prefilter prefilter, int size)
{
    int levels = 0;
    for (; size > 1; size /= 2)
        levels++;
    return prefilter == IRB_CSM_MIP ? levels : 1;
}

struct irb_csm *irb_csm_create(struct irb_gl *gl, enum irb_raster_projection projection, int size,
                               int capacity, int order, enum irb_csm_prefilter prefilter,
                               struct irb_error *err)
{
    if (!check(gl, projection, size, capacity, order, err))
        return NULL;
    struct irb_csm *csm = calloc(1, sizeof *csm);
    if (!csm) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    csm->gl = gl;
    csm->projection = projection;
    csm->prefilter = prefilter;
    csm->size = size;
    csm->capacity = capacity;
    csm->order = order;
    csm->faces = faces_of(projection);
    csm->levels = levels_of(prefilter, size);
    csm->span = 1;
    if (create_objects(csm, err))
        return csm;
    irb_csm_destroy(csm);
    return NULL;
}

void irb_csm_destroy(struct irb_csm *csm)
{
    if (!csm)
        return;
    if (csm->passes) {
        irb_program_destroy(csm->passes->range);
        irb_program_destroy(csm->passes->basis);
        irb_program_destroy(csm->passes->filter);
    }
    free(csm->passes);
    irb_texture_destroy(csm->images);
    irb_buffer_destroy(csm->ranges);
    irb_buffer_destroy(csm->weights);
    free(csm);
}

/* Half the width of the series's step: its first extremum lies there. */
static float half_step(int order)
{
    return 0.5f / (float)order;
}

/* |z - d| + offset <= 1 - half step: the step's other end, at z - d = +-1, is not reached. Low
 * orders keep half of the depths' range at least. */
static float span_of(const struct irb_csm *csm, const struct irb_csm_settings *s)
{
    const float offset = fmaxf(s->offset, s->search_offset);
    return fmaxf(1 - (1 + fmaxf(offset, 0)) * half_step(csm->order), 0.5f);
}

/* a_k = 2/c_k exp(-alpha (k/M)^2). */
static bool write_weights(const struct irb_csm *csm, float damping, struct irb_error *err)
{
    float weights[IRB_CSM_ORDER_MOST][4] = {{0}};
    for (int k = 1; k <= csm->order; k++) {
        const double share = (double)k / csm->order;
        weights[k - 1][0] = (float)(2 / (M_PI * (2 * k - 1)) * exp(-damping * share * share));
    }
    return irb_buffer_write(csm->weights, 0, sizeof weights, weights, err);
}

static void barrier(const struct irb_csm *csm)
{
    csm->gl->api.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                               GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                               GL_UNIFORM_BARRIER_BIT);
}

static void use(const struct irb_csm *csm, const struct irb_program *program,
                const struct irb_raster_maps *maps)
{
    irb_program_use(program);
    irb_raster_maps_bind(maps, program, 0);
    irb_program_int(program, "faces", csm->faces);
    irb_program_float(program, "span", csm->span);
    csm->gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RANGES_BINDING, csm->ranges->id);
}

bool irb_csm_basis(struct irb_csm *csm, const struct irb_raster_maps *maps,
                   const struct irb_csm_settings *settings, struct irb_error *err)
{
    const struct irb_gl_api *api = &csm->gl->api;
    const unsigned groups = (unsigned)(csm->size + GROUP - 1) / GROUP;

    if (maps->projection != csm->projection || maps->size != csm->size ||
        maps->count > csm->capacity)
        return irb_fail(err, IRB_E_INTERNAL,
                        "soft shadow maps: made for %d of %d texels, not for %d of %d",
                        csm->capacity, csm->size, maps->count, maps->size);
    csm->span = span_of(csm, settings);
    csm->count = maps->count;
    if (!write_weights(csm, settings->damping, err))
        return false;
    if (!maps->count)
        return true;
    use(csm, csm->passes->range, maps);
    api->DispatchCompute((unsigned)maps->count, 1, 1);
    barrier(csm);
    use(csm, csm->passes->basis, maps);
    api->BindImageTexture(IMAGES_BINDING, csm->images->id, 0, GL_TRUE, 0, GL_WRITE_ONLY,
                          GL_RGBA32F);
    api->DispatchCompute(groups, groups, (unsigned)(maps->count * csm->faces));
    barrier(csm);
    return irb_gl_check(csm->gl, "soft shadow maps: basis", err);
}

static unsigned layers_in_use(const struct irb_csm *csm)
{
    return (unsigned)(csm->count * csm->faces * layers_of(csm->order));
}

static void make_mipmaps(const struct irb_csm *csm, const struct irb_program *program)
{
    const struct irb_gl_api *api = &csm->gl->api;

    api->BindTextureUnit(0, csm->images->id);
    irb_program_int(program, "images", 0);
    for (int level = 1; level < csm->levels; level++) {
        const unsigned groups = (unsigned)((csm->size >> level) + GROUP - 1) / GROUP;
        irb_program_int(program, "level", level);
        api->BindImageTexture(IMAGES_BINDING, csm->images->id, level, GL_TRUE, 0, GL_WRITE_ONLY,
                              GL_RGBA32F);
        api->DispatchCompute(groups, groups, layers_in_use(csm));
        barrier(csm);
    }
}

static void make_tables(const struct irb_csm *csm, const struct irb_program *program)
{
    const struct irb_gl_api *api = &csm->gl->api;

    api->BindImageTexture(IMAGES_BINDING, csm->images->id, 0, GL_TRUE, 0, GL_READ_WRITE,
                          GL_RGBA32F);
    for (int axis = 0; axis < 2; axis++) {
        irb_program_int(program, "axis", axis);
        api->DispatchCompute((unsigned)(csm->size + LINE_GROUP - 1) / LINE_GROUP,
                             layers_in_use(csm), 1);
        barrier(csm);
    }
}

bool irb_csm_prefilter(struct irb_csm *csm, struct irb_error *err)
{
    if (!csm->count)
        return true;
    irb_program_use(csm->passes->filter);
    if (csm->prefilter == IRB_CSM_SAT)
        make_tables(csm, csm->passes->filter);
    else
        make_mipmaps(csm, csm->passes->filter);
    return irb_gl_check(csm->gl, "soft shadow maps: prefilter", err);
}

void irb_csm_defines(const struct irb_csm *csm, int binding, struct irb_csm_defines *out)
{
    snprintf(out->text[0], sizeof out->text[0], "CSM_ORDER %d", csm->order);
    snprintf(out->text[1], sizeof out->text[1], "CSM_SAT %d", csm->prefilter == IRB_CSM_SAT);
    snprintf(out->text[2], sizeof out->text[2], "CSM_MOST %d", IRB_CSM_MAPS_MOST);
    snprintf(out->text[3], sizeof out->text[3], "CSM_ORDER_MOST %d", IRB_CSM_ORDER_MOST);
    snprintf(out->text[4], sizeof out->text[4], "CSM_RANGES %d", binding);
    snprintf(out->text[5], sizeof out->text[5], "CSM_WEIGHTS %d", binding + 1);
    for (int i = 0; i < 6; i++)
        out->list[i] = out->text[i];
    out->list[6] = irb_raster_define(csm->projection);
    out->list[7] = NULL;
}

int irb_csm_bind(const struct irb_csm *csm, const struct irb_program *program,
                 const struct irb_csm_settings *settings, int binding, int first_unit)
{
    const struct irb_gl_api *api = &csm->gl->api;
    const float half = half_step(csm->order);

    api->BindTextureUnit((GLuint)first_unit, csm->images->id);
    irb_program_int(program, "csm_images", first_unit);
    irb_program_int(program, "csm_size", csm->size);
    irb_program_int(program, "csm_levels", csm->levels);
    irb_program_float(program, "csm_span", csm->span);
    irb_program_float(program, "csm_offset", settings->offset * half);
    irb_program_float(program, "csm_search_offset", settings->search_offset * half);
    irb_program_float(program, "csm_scale", settings->scale);
    irb_program_float(program, "csm_search_scale", settings->search_scale);
    irb_program_float(program, "csm_penumbra_scale", settings->penumbra_scale);
    api->BindBufferBase(GL_UNIFORM_BUFFER, (GLuint)binding, csm->ranges->id);
    api->BindBufferBase(GL_UNIFORM_BUFFER, (GLuint)binding + 1, csm->weights->id);
    return first_unit + 1;
}
