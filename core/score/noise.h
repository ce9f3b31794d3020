/* SPDX-License-Identifier: MIT
 *
 * An image with more noise of a kind that it has already: by how much a metric grows with a second
 * dose is how much the first one makes of it, to first order in the variance (simulation
 * extrapolation: Cook and Stefanski 1994, "Simulation-Extrapolation Estimation in Parametric
 * Measurement Error Models", 10.1080/01621459.1994.10476871).
 */
#ifndef IRB_SCORE_NOISE_H
#define IRB_SCORE_NOISE_H

#include "core/image/image.h"

#include <stdint.h>

/* The pixel's number of a standard normal sequence (Box and Muller 1958): the same for the same
 * seed and pixel, on any thread. */
double irb_normal(uint64_t seed, size_t pixel);

/* noisy = image max(0, 1 + z s), with z = irb_normal and s the relative standard deviation (1
 * channel): a pixel keeps its colour, and is never negative. Where s is not finite it is taken for
 * 0. *noisy is created. */
bool irb_noisy_image(const struct irb_image *image, const struct irb_image *relative_deviation,
                     uint64_t seed, struct irb_image *noisy, struct irb_error *err);

#endif
