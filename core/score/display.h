/* SPDX-License-Identifier: MIT
 *
 * What SSIM and LDR-FLIP compare: an image as a display shows it, tone-mapped at one exposure for a
 * whole sequence.
 */
#ifndef IRB_SCORE_DISPLAY_H
#define IRB_SCORE_DISPLAY_H

#include "core/image/image.h"

struct irb_displayed {
    struct irb_image linear; /* 3 channels in [0,1]: what the display emits, not yet encoded */
    struct irb_image luma;   /* 1 channel in [0,1]: 0.2126 R' + 0.7152 G' + 0.0722 B' of the
                                sRGB-encoded values (Rec.709, 3.2), what SSIM compares */
};

/* irb_tonemap's Reinhard operator in single precision: the same values within 2e-6. exposure 0: the
 * image is display-referred and is only clamped to [0,1]. NaN and negative values show black,
 * infinity white. Both images are created; on failure neither is left. */
bool irb_display(const struct irb_image *radiance, double exposure, struct irb_displayed *out,
                 struct irb_error *err);
void irb_displayed_destroy(struct irb_displayed *displayed);

/* |a - b| of the sRGB-encoded values, 3 channels in [0,1]: what an eye at the display would
 * subtract. *out is created with the images' size, which is the same. */
bool irb_displayed_difference(const struct irb_displayed *a, const struct irb_displayed *b,
                              struct irb_image *out, struct irb_error *err);

#endif
