/* SPDX-License-Identifier: MIT
 *
 * FLIP by the letter: double precision, two-dimensional kernels, no separation, YCxCz at its usual
 * scale. Slow, and shares nothing with the code under test but the constants.
 */
#ifndef IRB_TESTS_SCORE_FLIP_BRUTE_H
#define IRB_TESTS_SCORE_FLIP_BRUTE_H

#include "core/image/image.h"

/* Linear RGB in [0,1]; one value a pixel into `out`. */
void flip_brute(const struct irb_image *test, const struct irb_image *reference, double ppd,
                double *out);

#endif
