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

enum { IRB_FLIP_MAX_EXPOSURES = 24 }; /* one a stop is more than any scene's range needs */

/* Exposures (log2) from the reference's maximum and median luminance under the ACES tone map
 * (2021 paper, section 4): start takes the maximum to 85 % of the display's range, stop the median.
 * Taken from pixels with luminance > 0 (mask != 0 where a mask is given), once for a sequence: a
 * median of 0, usual for indirect light on black, would have no exposure. */
struct irb_flip_exposures {
    double start, stop;
    int count; /* max(2, ceil(stop - start)), at most IRB_FLIP_MAX_EXPOSURES; evenly spread */
};

/* From the luminances of one or more reference images (3 channels, one size); false when no pixel
 * is lit (or memory is out). masks, or any of them, may be NULL: all pixels. The median of an even
 * count is the lower of the middle two. */
bool irb_flip_exposures_of(const struct irb_image *const *references, const uint8_t *const *masks,
                           int image_count, struct irb_flip_exposures *out);

/* Over the pixels of the mask; all NaN when there is none. */
struct irb_flip_scores {
    double mean, min, max;
    double weighted_median; /* half of the sum of all values lies in values up to this one */
};

/* Linear HDR images, 3 channels, one size. The map (1 channel, values in [0,1]) is created when
 * `map` is not NULL. Scores are over mask != 0 (NULL = all); the map is everywhere. threads 0 =
 * all cores; the result does not depend on it. Negative values and NaN count as 0, infinity as
 * white. Identical images give exactly 0. ppd in (0, 1000]. */
bool irb_flip_hdr(const struct irb_image *test, const struct irb_image *reference,
                  const uint8_t *mask, const struct irb_flip_exposures *exposures, double ppd,
                  int threads, struct irb_image *map, struct irb_flip_scores *scores,
                  struct irb_error *err);

/* A reference image prepared for many test images: displayed, filtered and taken to CIELab and
 * feature strengths at each exposure. 20 bytes a pixel and exposure (256 x 192 at 8 exposures:
 * 7.5 MiB); while it is made, 28 bytes a pixel more. The image is not needed afterwards. NULL on
 * failure. Owned by the caller; never written again, so threads may share it. */
struct irb_flip_reference;
struct irb_flip_reference *irb_flip_reference_create(const struct irb_image *reference,
                                                     const struct irb_flip_exposures *exposures,
                                                     double ppd, int threads,
                                                     struct irb_error *err);
void irb_flip_reference_destroy(struct irb_flip_reference *reference); /* NULL: nothing */

/* The same bits as irb_flip_hdr with the image, exposures and ppd that made the reference. */
bool irb_flip_hdr_prepared(const struct irb_image *test, const struct irb_flip_reference *reference,
                           const uint8_t *mask, int threads, struct irb_image *map,
                           struct irb_flip_scores *scores, struct irb_error *err);

/* As irb_flip_hdr; `exposure_map` (1 channel, created) holds the exposure at which a pixel's error
 * is largest, as i/(count-1) in [0,1]; the lowest of equals. */
bool irb_flip_hdr_maps(const struct irb_image *test, const struct irb_image *reference,
                       const uint8_t *mask, const struct irb_flip_exposures *exposures, double ppd,
                       int threads, struct irb_image *map, struct irb_image *exposure_map,
                       struct irb_flip_scores *scores, struct irb_error *err);

/* LDR-FLIP in two steps, for an image that is compared more than once: a view is the analysis of
 * one displayed image (3 channels, linear values in [0,1] as irb_display makes them), 20 bytes a
 * pixel. Owned by the caller; freed with irb_flip_reference_destroy. Views are made with one ppd.
 */
struct irb_flip_reference *irb_flip_view_create(const struct irb_image *linear, double ppd,
                                                int threads, struct irb_error *err);
bool irb_flip_views(const struct irb_flip_reference *test,
                    const struct irb_flip_reference *reference, const uint8_t *mask, int threads,
                    struct irb_image *map, struct irb_flip_scores *scores, struct irb_error *err);

/* sRGB-encoded images with values in [0,1] (clamped; NaN counts as 0). */
bool irb_flip_ldr(const struct irb_image *test, const struct irb_image *reference,
                  const uint8_t *mask, double ppd, int threads, struct irb_image *map,
                  struct irb_flip_scores *scores, struct irb_error *err);

#endif
