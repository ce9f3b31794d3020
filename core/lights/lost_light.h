/* SPDX-License-Identifier: MIT
 *
 * What a bound on the geometry term takes of the light of the split buffers, and its share of all:
 * lost energy is reported, not hidden.
 */
#ifndef IRB_LIGHTS_LOST_LIGHT_H
#define IRB_LIGHTS_LOST_LIGHT_H

#include "core/frame/interleave.h"

struct irb_lost_light {
    struct irb_gl *gl;         /* borrowed; all else may be zero */
    struct irb_texture *image; /* R32F, of the split buffers' size: irradiance that the bound took,
                                  mean of the channels, W/m2; NULL until there is a bound */
    bool valid;                /* there was a bound when the frame was last prepared */
    struct irb_program *sum;
};

void irb_lost_light_destroy(struct irb_lost_light *lost); /* frees what it owns */

/* Whether `image` is there and of the split buffers' size. */
bool irb_lost_light_fits(const struct irb_lost_light *lost, const struct irb_interleave *il);
/* bound: 0 for none. Makes the image where it is missing; its contents are undefined. */
bool irb_lost_light_prepare(struct irb_lost_light *lost, const struct irb_interleave *il,
                            float bound, struct irb_error *err);

/* Share of the light of `il->split` and `image` that is in `image`, [0,1]; 0 where there was no
 * bound, or no light. Waits for the GPU. */
bool irb_lost_light_share(struct irb_lost_light *lost, const struct irb_interleave *il,
                          double *share, struct irb_error *err);

#endif
