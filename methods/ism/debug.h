/* SPDX-License-Identifier: MIT
 *
 * Debug layers of imperfect shadow maps: the atlas, the split buffer, the shadow term.
 */
#ifndef IRB_METHODS_ISM_DEBUG_H
#define IRB_METHODS_ISM_DEBUG_H

#include "methods/ism/objects.h"
#include "methods/method.h"

struct ism_debug {
    struct irb_gl *gl;               /* borrowed */
    struct irb_texture *shadow_term; /* R32F: share of light in shadow */
    struct irb_program *program;
};

struct ism_debug *ism_debug_create(struct irb_gl *gl, int width, int height, struct irb_error *err);
void ism_debug_destroy(struct ism_debug *debug);
/* Appends the layers of the frame that was just rendered; the atlas only where `maps`. */
bool ism_debug_layers(struct ism_debug *debug, const struct ism_objects *objects, bool maps,
                      struct irb_frame_output *out, struct irb_error *err);

#endif
