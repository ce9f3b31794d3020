/* SPDX-License-Identifier: MIT */
#include "core/score/noise.h"
#include "core/base/hash.h"

#include <math.h>

/* Uniform in (0,1]: its logarithm is finite. */
static double uniform(uint64_t bits)
{
    return (double)((bits >> 11) + 1) * 0x1p-53;
}

double irb_normal(uint64_t seed, size_t pixel)
{
    double radius = sqrt(-2 * log(uniform(irb_hash_mix(seed, 2 * pixel))));
    return radius * cos(2 * M_PI * uniform(irb_hash_mix(seed, 2 * pixel + 1)));
}

bool irb_noisy_image(const struct irb_image *image, const struct irb_image *relative_deviation,
                     uint64_t seed, struct irb_image *noisy, struct irb_error *err)
{
    if (!irb_image_create(noisy, image->width, image->height, image->channels, err))
        return false;
    size_t channels = (size_t)image->channels;
    for (size_t i = 0; i < irb_image_pixels(image); i++) {
        double deviation = relative_deviation->data[i], factor = 1;
        if (isfinite(deviation) && deviation > 0)
            factor = fmax(0, 1 + irb_normal(seed, i) * deviation);
        for (size_t c = channels * i; c < channels * (i + 1); c++)
            noisy->data[c] = (float)(image->data[c] * factor);
    }
    return true;
}
