/* SPDX-License-Identifier: MIT */
#include "core/frame/shadow_term.h"

#include <stdlib.h>

enum { GROUP = 8 }; /* work group side of shaders/frame/shadow_term.comp */

struct irb_shadow_term *irb_shadow_term_create(struct irb_gl *gl, int width, int height,
                                               struct irb_error *err)
{
    const struct irb_texture_desc image = {
        .name = "shadow term", .format = GL_R32F, .width = width, .height = height};
    const struct irb_program_desc program = {.name = "shadow term",
                                             .compute = "frame/shadow_term.comp"};
    struct irb_shadow_term *term = calloc(1, sizeof *term);
    if (!term) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    term->gl = gl;
    if ((term->image = irb_texture_create(gl, &image, err)) &&
        (term->program = irb_program_create(gl, &program, err)))
        return term;
    irb_shadow_term_destroy(term);
    return NULL;
}

void irb_shadow_term_destroy(struct irb_shadow_term *term)
{
    if (!term)
        return;
    irb_texture_destroy(term->image);
    irb_program_destroy(term->program);
    free(term);
}

bool irb_shadow_term_draw(struct irb_shadow_term *term, const struct irb_texture *irradiance,
                          struct irb_error *err)
{
    const struct irb_gl_api *api = &term->gl->api;
    irb_program_use(term->program);
    api->BindTextureUnit(0, irradiance->id);
    irb_program_int(term->program, "irradiance", 0);
    api->BindImageTexture(0, term->image->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
    api->DispatchCompute((unsigned)(irradiance->width + GROUP - 1) / GROUP,
                         (unsigned)(irradiance->height + GROUP - 1) / GROUP, 1);
    api->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    return irb_gl_check(term->gl, "shadow term", err);
}
