/* SPDX-License-Identifier: MIT
 *
 * What is scored between a frame and the one before it: the same surface in both, the residual's
 * change, and FLIP against the image that would have followed the reference.
 */
#ifndef IRB_EXPERIMENT_SCORE_TEMPORAL_H
#define IRB_EXPERIMENT_SCORE_TEMPORAL_H

#include "core/experiment/target.h"
#include "core/score/flicker.h"
#include "core/score/reproject.h"

/* The previous frame's pair, brought to this frame's pixels where camera or objects moved. */
struct irb_warped_pair {
    struct irb_pair pair;
    struct irb_image test, reference; /* owned where warped */
    uint8_t *mask;                    /* owned where warped */
};

/* motion NULL: the view rests, and `pair` is the previous frame's own. *out is to be destroyed
 * after a failure too. */
bool irb_warp_pair(struct irb_warped_pair *out, const struct irb_pair *previous,
                   const struct irb_reprojection *motion, struct irb_error *err);
void irb_warped_pair_destroy(struct irb_warped_pair *warped);

/* LDR-FLIP between the current test image, of which `shown` is the view, and max(0, I_(t-1) + R_t -
 * R_(t-1)). */
struct irb_temporal_flip {
    double mean;          /* over pixels that count in both frames; NaN for none */
    struct irb_image map; /* 1 channel; owned */
    uint8_t *mask;        /* the pixels that count; owned */
};
bool irb_temporal_flip(struct irb_temporal_flip *out, const struct irb_pair *previous,
                       const struct irb_pair *current, const struct irb_target_view *shown,
                       double exposure, struct irb_error *err);
/* The mean over those of the pixels that `mask` has; NaN for none. */
bool irb_temporal_flip_mean(const struct irb_temporal_flip *flip, const uint8_t *mask, double *mean,
                            struct irb_error *err);
void irb_temporal_flip_destroy(struct irb_temporal_flip *flip);

#endif
