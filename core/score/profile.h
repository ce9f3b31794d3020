/* SPDX-License-Identifier: MIT
 *
 * A space-time profile: one row of the image in every frame, one below the other. What rests makes
 * vertical lines, what moves evenly makes slanted ones, and flicker makes steps and dashes.
 */
#ifndef IRB_SCORE_PROFILE_H
#define IRB_SCORE_PROFILE_H

#include "core/image/image.h"

/* Adds to rows[y] the sum of |b - a| over the row's pixels and channels; what is not finite counts
 * nothing. Both images have one size; rows has its height. */
void irb_row_change_add(double *rows, const struct irb_image *a, const struct irb_image *b);
/* The row with the largest value, of equals the uppermost; the middle one (height/2) where all are
 * 0. */
int irb_busiest_row(const double *rows, int height);

/* Copies row `row` of the image to row `to` of the profile. */
void irb_profile_set(struct irb_image *profile, int to, const struct irb_image *image, int row);

/* The picture: `result` to the left, `reference` to the right, tone-mapped at `exposure`, each of
 * their rows 3 to 16 pixels high (what makes 256 pixels, where that is in between). Both have 3
 * channels and one size. sheet: 3 channels, sRGB in [0,1]; created. */
bool irb_profile_sheet(const struct irb_image *result, const struct irb_image *reference,
                       double exposure, struct irb_image *sheet, struct irb_error *err);

#endif
