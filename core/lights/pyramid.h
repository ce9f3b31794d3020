/* SPDX-License-Identifier: MIT
 *
 * Pyramid of sums over a square map, for hierarchical sample warping (Clarberg et al. 2005; thesis
 * 4.5, algorithm 5.3): shaders/lights/warp.glsl walks down it.
 */
#ifndef IRB_LIGHTS_PYRAMID_H
#define IRB_LIGHTS_PYRAMID_H

#include "core/frame/rsm.h"

struct irb_pyramid {
    struct irb_buffer *sums; /* floats, level by level from the finest, which is padded with zeros
                                to a power of two a side; the total is the last */
    int resolution;          /* of the map */
    int levels;              /* log2 of the padded side, + 1 */
    struct irb_program *flux, *map; /* private; made when first asked for */
    enum irb_layout flux_layout;    /* private: of the RSM that `flux` reads */
    struct irb_gl *gl;              /* borrowed */
};

/* IRB_E_INPUT when the sums exceed the driver's limit for shader storage (GL guarantees 128 MiB: a
 * side of 4096). */
struct irb_pyramid *irb_pyramid_create(struct irb_gl *gl, int resolution, struct irb_error *err);
void irb_pyramid_destroy(struct irb_pyramid *pyramid);

/* Sums of the luminance of the RSM's reflected flux. Same input, same bits. */
bool irb_pyramid_build_flux(struct irb_pyramid *pyramid, const struct irb_rsm *rsm,
                            struct irb_error *err);
/* Sums of an R32F map of resolution^2. Negative and non-finite values count as 0, values beyond
 * 1e30 as that, so that no sum overflows. */
bool irb_pyramid_build(struct irb_pyramid *pyramid, const struct irb_texture *map,
                       struct irb_error *err);

/* Shader storage binding 2 and the uniforms of shaders/lights/warp.glsl. */
void irb_pyramid_bind(const struct irb_pyramid *pyramid, const struct irb_program *program);

#endif
