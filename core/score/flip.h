/* SPDX-License-Identifier: MIT
 *
 * FLIP for HDR images (Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range
 * Images", 10.2312/egs.20211015) and its LDR base (Andersson et al. 2020, 10.1145/3406183).
 */
#ifndef IRB_SCORE_FLIP_H
#define IRB_SCORE_FLIP_H

#include "core/image/image.h"

#include <stdint.h>

#define IRB_FLIP_PPD 67.02 /* pixels per degree: 0.7 m from a 0.7 m wide 3840-pixel display */

/* Exposures (log2) from the reference's maximum and median luminance under the ACES tone map.
 * Taken from pixels with luminance > 0 (mask != 0 where a mask is given), once for a sequence. */
struct irb_flip_exposures {
    double start, stop;
    int count; /* at least 2 */
};

/* From the luminances of one or more reference images (3 channels, one size); false when no pixel
 * is lit. */
bool irb_flip_exposures_of(const struct irb_image *const *references, const uint8_t *const *masks,
                           int image_count, struct irb_flip_exposures *out);

struct irb_flip_scores {
    double mean, min, max;
    double weighted_median; /* as the public tool prints it */
};

/* Linear HDR images, 3 channels, one size. The map (1 channel, values in [0,1]) is created when
 * `map` is not NULL. Scores are over mask != 0 (NULL = all); the map is everywhere. threads 0 =
 * all cores; the result does not depend on it. */
bool irb_flip_hdr(const struct irb_image *test, const struct irb_image *reference,
                  const uint8_t *mask, const struct irb_flip_exposures *exposures, double ppd,
                  int threads, struct irb_image *map, struct irb_flip_scores *scores,
                  struct irb_error *err);

/* sRGB-encoded images with values in [0,1]. */
bool irb_flip_ldr(const struct irb_image *test, const struct irb_image *reference,
                  const uint8_t *mask, double ppd, int threads, struct irb_image *map,
                  struct irb_flip_scores *scores, struct irb_error *err);

#endif
