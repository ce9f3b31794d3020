/* SPDX-License-Identifier: MIT */
#include "methods/ism/debug.h"

#include <stdlib.h>

enum { GROUP = 8 }; /* work group side of shaders/methods/ism/shadow_term.comp */

struct ism_debug *ism_debug_create(struct irb_gl *gl, int width, int height, struct irb_error *err)
{
    const struct irb_texture_desc image = {
        .name = "ism: shadow term", .format = GL_R32F, .width = width, .height = height};
    const struct irb_program_desc program = {.name = "ism: shadow term",
                                             .compute = "methods/ism/shadow_term.comp"};
    struct ism_debug *debug = calloc(1, sizeof *debug);
    if (!debug) {
        irb_fail(err, IRB_E_MEMORY, "ism: out of memory");
        return NULL;
    }
    debug->gl = gl;
    if ((debug->shadow_term = irb_texture_create(gl, &image, err)) &&
        (debug->program = irb_program_create(gl, &program, err)))
        return debug;
    ism_debug_destroy(debug);
    return NULL;
}

void ism_debug_destroy(struct ism_debug *debug)
{
    if (!debug)
        return;
    irb_texture_destroy(debug->shadow_term);
    irb_program_destroy(debug->program);
    free(debug);
}

static bool fill_shadow_term(struct ism_debug *debug, const struct irb_texture *irradiance,
                             struct irb_error *err)
{
    const struct irb_gl_api *api = &debug->gl->api;
    irb_program_use(debug->program);
    api->BindTextureUnit(0, irradiance->id);
    irb_program_int(debug->program, "irradiance", 0);
    api->BindImageTexture(0, debug->shadow_term->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    api->DispatchCompute((unsigned)(irradiance->width + GROUP - 1) / GROUP,
                         (unsigned)(irradiance->height + GROUP - 1) / GROUP, 1);
    api->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    return irb_gl_check(debug->gl, "ism: shadow term", err);
}

static void add_layer(struct irb_frame_output *out, const char *name,
                      const struct irb_texture *texture, enum irb_debug_kind kind)
{
    out->debug[out->debug_count].name = name;
    out->debug[out->debug_count].texture = texture;
    out->debug[out->debug_count++].kind = kind;
}

bool ism_debug_layers(struct ism_debug *debug, const struct ism_objects *objects, bool maps,
                      struct irb_frame_output *out, struct irb_error *err)
{
    if (!fill_shadow_term(debug, objects->irradiance, err))
        return false;
    if (maps)
        add_layer(out, "ism-atlas", objects->maps->atlas, IRB_DEBUG_DISTANCE);
    add_layer(out, "split", objects->interleave->split, IRB_DEBUG_RADIANCE);
    add_layer(out, "shadow-term", debug->shadow_term, IRB_DEBUG_SCALAR);
    return true;
}
