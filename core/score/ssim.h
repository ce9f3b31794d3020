/* SPDX-License-Identifier: MIT
 *
 * Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004, "Image Quality Assessment: From
 * Error Visibility to Structural Similarity", 10.1109/TIP.2003.819861, eq. 13): Gaussian window of
 * 11 x 11 pixels, sigma 1.5, K1 = 0.01, K2 = 0.03, L = 1, at full resolution (the paper's later
 * suggestion to shrink large images first is not followed).
 */
#ifndef IRB_SCORE_SSIM_H
#define IRB_SCORE_SSIM_H

#include "core/image/image.h"

#include <stdint.h>

enum { IRB_SSIM_RADIUS = 5 }; /* pixels: the window is 2 * 5 + 1 wide */

/* 1-channel images of one size with values in [0,1]. *mean is over the pixels of the mask (NULL =
 * all) whose window lies inside the image; NaN where there is none. The map (1 channel, created
 * where `map` is not NULL) is 1 where the window does not fit. Sums are in double; equal images
 * give exactly 1. Values are in [-1, 1]. */
bool irb_ssim(const struct irb_image *test, const struct irb_image *reference, const uint8_t *mask,
              struct irb_image *map, double *mean, struct irb_error *err);

#endif
