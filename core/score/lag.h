/* SPDX-License-Identifier: MIT
 *
 * How many frames a method is behind: the whole number tau of frames that minimises the mean of
 * |I_t - R_(t-tau)| over a sequence. A method that reuses old frames trades flicker for lag.
 *
 * Differences are taken at the pixels of a regular grid, at most IRB_LAG_PIXELS of them: a mean
 * over the image needs no more, and the references of a whole sequence stay in memory.
 *
 * Does not: follow a camera or objects that move; there is no lag then.
 */
#ifndef IRB_SCORE_LAG_H
#define IRB_SCORE_LAG_H

#include "core/image/image.h"

#include <stdint.h>

enum {
    IRB_LAG_FIRST = -3, /* frames: ahead of the reference */
    IRB_LAG_LAST = 8,   /* behind it */
    IRB_LAG_COUNT = IRB_LAG_LAST - IRB_LAG_FIRST + 1,
    IRB_LAG_PIXELS = 1 << 14,
};

/* The shifts that are tried: fewer in short sequences, so that every one is judged on the same
 * frames and these are half of the sequence or more. first > last where the sequence is too short
 * (below 6 frames). */
struct irb_lag_range {
    int first, last;
};
struct irb_lag_range irb_lag_range(int frames);

/* The reference images of a sequence at the grid's pixels: 12 bytes a pixel and frame. */
struct irb_lag_reference;
struct irb_lag_reference *irb_lag_reference_create(int width, int height, int frames,
                                                   struct irb_error *err);
void irb_lag_reference_destroy(struct irb_lag_reference *reference); /* NULL: nothing */
/* image: 3 channels, of the size given. */
void irb_lag_reference_set(struct irb_lag_reference *reference, int frame,
                           const struct irb_image *image);

/* errors[i] = mean |image - R_(frame-tau)| with tau = IRB_LAG_FIRST + i, over channels and the
 * grid's pixels under the mask (NULL = all) that are finite; NaN where the sequence has no such
 * frame. */
void irb_lag_errors(const struct irb_lag_reference *reference, int frame,
                    const struct irb_image *image, const uint8_t *mask,
                    double errors[IRB_LAG_COUNT]);

/* The lag of a sequence in frames, from the errors of all its frames; of equals the one nearest to
 * 0. NaN where the sequence is too short, an error is missing, or the reference does not change:
 * where the means differ by less than 1e-6 of the mean reference (source: ours). */
double irb_lag(const double (*errors)[IRB_LAG_COUNT], int frames, double mean_reference);

#endif
