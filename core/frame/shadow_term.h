/* SPDX-License-Identifier: MIT
 *
 * The share of the indirect light that is in shadow as an image of its own, white where all is, as
 * in the thesis's figures (6.2, 6.4): a debug layer of methods whose irradiance holds it in alpha
 * (core/frame/interleave.h).
 */
#ifndef IRB_FRAME_SHADOW_TERM_H
#define IRB_FRAME_SHADOW_TERM_H

#include "core/gl/objects.h"
#include "core/gl/program.h"

struct irb_shadow_term {
    struct irb_gl *gl;         /* borrowed */
    struct irb_texture *image; /* R32F, [0,1] */
    struct irb_program *program;
};

struct irb_shadow_term *irb_shadow_term_create(struct irb_gl *gl, int width, int height,
                                               struct irb_error *err);
void irb_shadow_term_destroy(struct irb_shadow_term *term); /* NULL is fine */

/* irradiance: RGBA32F of the image's size. */
bool irb_shadow_term_draw(struct irb_shadow_term *term, const struct irb_texture *irradiance,
                          struct irb_error *err);

#endif
