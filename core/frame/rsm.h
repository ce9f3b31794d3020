/* SPDX-License-Identifier: MIT
 *
 * The reflective shadow map: the light's G-buffer (Dachsbacher and Stamminger 2005; thesis 3.2.2,
 * 5.1.1) in full precision, with the exact solid angle of every texel.
 *
 * Spot: a square perspective image that encloses the cone. Directional: an orthographic image of
 * the beam. Texels outside the cone or without geometry have zero flux.
 */
#ifndef IRB_FRAME_RSM_H
#define IRB_FRAME_RSM_H

#include "core/frame/scene_gl.h"
#include "core/scene/light.h"

struct irb_rsm {
    int resolution;               /* texels a side */
    struct irb_texture *position; /* RGBA32F: world position (m); 1 where there is geometry */
    struct irb_texture *normal;   /* RGBA32F: unit shading normal on the lit side; Euclidean
                                     distance to the light (spot) or along the beam (m) */
    struct irb_texture *flux;     /* RGBA32F: reflected flux Phi_p = k_d I dw_p (W); flux in,
                                     averaged over the channels (W) */
    struct irb_texture *specular; /* RGBA32F: k_s; exponent: for importance (thesis 4.5) */
    struct irb_texture *depth;    /* DEPTH_COMPONENT32F, reversed (1 near, 0 far): the rasteriser's
                                     own, for comparisons take the distance in normal.w */
    struct irb_framebuffer *framebuffer;
    struct irb_program *program;
    float view_projection[16]; /* world -> clip of the last render, depth 1..0 */
    float half_extent;         /* of the image in the last render: tan(omega_s) at distance 1, or
                                  the beam's half side (m) */
    struct irb_gl *gl;         /* borrowed */
};

struct irb_rsm *irb_rsm_create(struct irb_gl *gl, int resolution, struct irb_error *err);
void irb_rsm_destroy(struct irb_rsm *rsm);
/* Spot: nothing nearer than 1e-5 of the current bounds' diagonal (along the axis) is seen, and
 * there is no far end. Directional: from the light's plane to the end of the bounds. */
bool irb_rsm_render(struct irb_rsm *rsm, const struct irb_scene_gl *scene,
                    const struct irb_light *light, struct irb_error *err);

#endif
