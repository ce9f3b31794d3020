/* SPDX-License-Identifier: MIT
 *
 * A contact sheet of one frame for people: the result, the reference and the error side by side.
 *
 *     full image            reference             signed error of indirect light
 *     indirect light        its reference         HDR-FLIP of indirect light
 */
#ifndef IRB_SCORE_SHEET_H
#define IRB_SCORE_SHEET_H

#include "core/image/image.h"

struct irb_sheet_inputs {
    const struct irb_image *full, *indirect, *reference_full,
        *reference_indirect;               /* RGB radiance */
    const struct irb_image *flip_indirect; /* 1 channel in [0,1] */
    double exposure;                       /* of all four; fixed for the sequence */
    double mean_indirect;                  /* the signed error's colours end at +- this */
};

/* sheet: 3 channels, sRGB in [0,1]; created. */
bool irb_sheet_make(const struct irb_sheet_inputs *inputs, struct irb_image *sheet,
                    struct irb_error *err);

#endif
