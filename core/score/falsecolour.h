/* SPDX-License-Identifier: MIT
 *
 * False colour for previews of 1-channel maps. Results are sRGB-encoded, 3 channels, ready for
 * irb_png_write. NaN shows as pure green, which neither scale contains.
 */
#ifndef IRB_SCORE_FALSECOLOUR_H
#define IRB_SCORE_FALSECOLOUR_H

#include "core/image/image.h"

/* "magma" (van der Walt and Smith, matplotlib 1.5, 2015, CC0): lightness grows evenly from black at
 * value / maximum = 0 to a pale yellow at 1 and above. maximum > 0. rgb is created. */
bool irb_falsecolour(const struct irb_image *map, double maximum, struct irb_image *rgb,
                     struct irb_error *err);

/* For signed maps: value / maximum from -1 (blue: too dark) over 0 (near white) to 1 (red: too
 * bright), straight lines in CIELab, so that equal differences look equal and both signs weigh the
 * same. maximum > 0. rgb is created. */
bool irb_falsecolour_signed(const struct irb_image *map, double maximum, struct irb_image *rgb,
                            struct irb_error *err);

#endif
