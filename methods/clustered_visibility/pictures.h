/* SPDX-License-Identifier: MIT
 *
 * Debug layers: the VPLs in the colours of their VALs on the RSM (thesis figure 3.9), what part of
 * the light is in shadow, the VALs' shadow maps, and the basis images of one.
 */
#ifndef IRB_METHODS_CLUSTERED_VISIBILITY_PICTURES_H
#define IRB_METHODS_CLUSTERED_VISIBILITY_PICTURES_H

#include "core/frame/rsm.h"
#include "core/frame/shadow_term.h"
#include "core/lights/csm.h"
#include "core/lights/vals.h"

struct cv_pictures {
    struct irb_gl *gl;        /* borrowed */
    struct irb_texture *vals; /* RGBA32F, RSM: [0,1] */
    struct irb_shadow_term *shadow;
    struct irb_texture
        *basis; /* RGBA32F array: sin, cos, sin, cos as (v + 1)/2; NULL without maps */
    struct irb_program *surfaces[2], *points, *images; /* private; by the RSM's layout */
    struct irb_framebuffer *on_vals;
};

struct cv_pictures *cv_pictures_create(struct irb_gl *gl, int resolution, int width, int height,
                                       struct irb_error *err);
void cv_pictures_destroy(struct cv_pictures *pictures);

/* irradiance: alpha is the share. csm: of the last batch, or NULL. */
bool cv_pictures_draw(struct cv_pictures *pictures, const struct irb_rsm *rsm,
                      const struct irb_vals *vals, const struct irb_texture *irradiance,
                      const struct irb_csm *csm, struct irb_error *err);

#endif
