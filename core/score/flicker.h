/* SPDX-License-Identifier: MIT
 *
 * Flicker: the change of the error from one frame to the next, which is no change of the reference.
 * With e_t = I_t - R_t the temporal residual is |e_t - e_(t-1)|, where |e|^2 is the mean over the
 * channels; it counts where a pixel counts in both frames (core/score/metrics.h).
 *
 * Everywhere `previous` and `current` are the pairs of frames t-1 and t with one surface to a pixel
 * (core/score/reproject.h brings them there), and mean_reference is the sequence's, in the images'
 * unit.
 */
#ifndef IRB_SCORE_FLICKER_H
#define IRB_SCORE_FLICKER_H

#include "core/score/metrics.h"

struct irb_flicker_scores {
    double flicker;   /* sqrt(mean |e_t - e_(t-1)|^2) / mean R; identical inputs give exactly 0 */
    double pop_share; /* share of pixels with |e_t - e_(t-1)| > 0.1 max(R_t, 0.1 mean R) */
};

/* A mean reference of 0 gives flicker 0 for no residual, else infinity. */
struct irb_flicker_scores irb_score_flicker(const struct irb_pair *previous,
                                            const struct irb_pair *current, double mean_reference);

/* |e_t - e_(t-1)| / mean R of each pixel; 1 channel, created. 0 where the pixel does not count, and
 * everywhere if the mean reference is 0; at most FLT_MAX. */
bool irb_residual_map(const struct irb_pair *previous, const struct irb_pair *current,
                      double mean_reference, struct irb_image *map, struct irb_error *err);

/* ---- a whole sequence, pixel by pixel ---- */

/* Grows by a frame at a time: 16 bytes a pixel. */
struct irb_flicker_sum {
    int width, height;
    double *square;  /* of the residuals, over mean R squared */
    uint32_t *pops;  /* of the two, so many were pops */
    uint32_t *pairs; /* of frames in which the pixel counts */
};
bool irb_flicker_sum_create(struct irb_flicker_sum *sum, int width, int height,
                            struct irb_error *err);
void irb_flicker_sum_destroy(struct irb_flicker_sum *sum);
void irb_flicker_sum_add(struct irb_flicker_sum *sum, const struct irb_pair *previous,
                         const struct irb_pair *current, double mean_reference);

/* 1 channel each, created; all 0 where a pixel never counts. On failure none is left. */
struct irb_flicker_maps {
    struct irb_image flicker; /* root of the mean square of the residual over mean R */
    struct irb_image pops;    /* how many */
    struct irb_image pairs;   /* of so many pairs of frames */
};
bool irb_flicker_maps_of(struct irb_flicker_maps *maps, const struct irb_flicker_sum *sum,
                         struct irb_error *err);
void irb_flicker_maps_destroy(struct irb_flicker_maps *maps);

#endif
