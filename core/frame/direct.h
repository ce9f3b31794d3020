/* SPDX-License-Identifier: MIT
 *
 * Direct light (thesis 5.3.4): Lambert + Blinn, shadow from the RSM's distances with 25-tap PCF.
 */
#ifndef IRB_FRAME_DIRECT_H
#define IRB_FRAME_DIRECT_H

#include "core/frame/gbuffer.h"
#include "core/frame/rsm.h"

struct irb_direct {
    struct irb_texture *radiance; /* RGBA32F: direct radiance towards the eye, W/(m2 sr) */
    struct irb_framebuffer *framebuffer;
    struct irb_program *program;
    struct irb_gl *gl; /* borrowed */
};

struct irb_direct *irb_direct_create(struct irb_gl *gl, int width, int height,
                                     struct irb_error *err);
void irb_direct_destroy(struct irb_direct *direct);
/* `rsm` was rendered for the same light, `gbuffer` (of this size) for the same camera. Pixels
 * without geometry are zero. */
bool irb_direct_render(struct irb_direct *direct, const struct irb_gbuffer *gbuffer,
                       const struct irb_rsm *rsm, const struct irb_light *light,
                       const struct irb_camera *camera, struct irb_error *err);

#endif
