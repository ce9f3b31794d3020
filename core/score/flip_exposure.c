/* SPDX-License-Identifier: MIT */
#include "core/score/flip_exposure.h"

#include "core/score/flip.h"
#include "core/score/quantile.h"

#include <math.h>

/* Share of the display's range that the brightest and the median pixel are taken to. */
static const double target_level = 0.85;

/* Rec.709 luminance; 0 for what has none. */
static float luminance(const float *rgb)
{
    float y = 0.212636822f * rgb[0] + 0.715182982f * rgb[1] + 0.072180196f * rgb[2];
    return isfinite(y) && y > 0 ? y : 0;
}

/* The x that the tone map takes to `target_level`: the positive root of
 * (a0 - t b0) x^2 + (a1 - t b1) x - t b2 = 0. */
static double level_before_tone_map(void)
{
    double a = IRB_ACES_A0 - target_level * IRB_ACES_B0;
    double b = IRB_ACES_A1 - target_level * IRB_ACES_B1;
    double c = -target_level * IRB_ACES_B2;
    return (-b + sqrt(b * b - 4 * a * c)) / (2 * a);
}

static float add_luminances(struct irb_quantile *median, const struct irb_image *image,
                            const uint8_t *mask)
{
    float largest = 0;
    for (size_t i = 0; i < irb_image_pixels(image); i++) {
        float y = mask && !mask[i] ? 0 : luminance(image->data + 3 * i);
        if (y > 0)
            irb_quantile_add(median, y, 1);
        largest = y > largest ? y : largest;
    }
    return largest;
}

bool irb_flip_exposures_of(const struct irb_image *const *references, const uint8_t *const *masks,
                           int image_count, struct irb_flip_exposures *out)
{
    struct irb_quantile *quantile = irb_quantile_create(0.5);
    if (!quantile)
        return false;
    float largest = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < image_count; i++) {
            float y = add_luminances(quantile, references[i], masks ? masks[i] : NULL);
            largest = y > largest ? y : largest;
        }
        irb_quantile_pass_done(quantile);
    }
    double median = irb_quantile_finish(quantile), level = level_before_tone_map();
    if (!(largest > 0))
        return false;
    out->start = log2(level / largest);
    out->stop = log2(level / median);
    double count = fmax(2, ceil(out->stop - out->start));
    out->count = (int)fmin(count, IRB_FLIP_MAX_EXPOSURES);
    return true;
}
