/* SPDX-License-Identifier: MIT */
#include "core/frame/composite.h"

#include <math.h>

static const float inverse_pi = 0.318309886183790672f;
static const double reinhard_key = 0.18; /* Reinhard 2002, "a", the middle of the road */

static double luminance(const float rgb[3])
{
    /* Rec.709 primaries, D65 */
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

static bool fits(const struct irb_gbuffer_image *gbuffer, const struct irb_image *image,
                 const char *what, struct irb_error *err)
{
    if (!image || (image->width == gbuffer->width && image->height == gbuffer->height &&
                   image->channels >= 3))
        return true;
    return irb_fail(err, IRB_E_INPUT,
                    "composite: %s has %dx%d pixels of %d channels, expected %dx%d of at least 3",
                    what, image->width, image->height, image->channels, gbuffer->width,
                    gbuffer->height);
}

static const float *pixel_of(const struct irb_image *image, size_t pixel)
{
    return image->data + pixel * (size_t)image->channels;
}

bool irb_composite(const struct irb_gbuffer_image *gbuffer, const struct irb_image *direct,
                   const struct irb_image *irradiance, const struct irb_image *radiance,
                   struct irb_image *indirect, struct irb_image *full, struct irb_error *err)
{
    if (!fits(gbuffer, direct, "direct", err) || !fits(gbuffer, irradiance, "irradiance", err) ||
        !fits(gbuffer, radiance, "radiance", err))
        return false;
    struct irb_image unused = {0}, *out = indirect ? indirect : &unused;
    if (!irb_image_create(out, gbuffer->width, gbuffer->height, 3, err))
        return false;
    if (full && !irb_image_create(full, gbuffer->width, gbuffer->height, 3, err)) {
        irb_image_destroy(out);
        return false;
    }
    for (size_t i = 0; i < irb_image_pixels(out); i++) {
        if (!irb_gbuffer_image_covered(gbuffer, i))
            continue;
        for (size_t c = 0; c < 3; c++) {
            float value =
                pixel_of(&gbuffer->diffuse, i)[c] * inverse_pi * pixel_of(irradiance, i)[c];
            if (radiance)
                value += pixel_of(radiance, i)[c];
            out->data[3 * i + c] = value;
            if (full)
                full->data[3 * i + c] = pixel_of(direct, i)[c] + value;
        }
    }
    irb_image_destroy(&unused);
    return true;
}

double irb_exposure_of(const struct irb_image *radiance, const struct irb_gbuffer_image *gbuffer)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < irb_image_pixels(radiance); i++) {
        if (gbuffer && !irb_gbuffer_image_covered(gbuffer, i))
            continue;
        double l = luminance(pixel_of(radiance, i));
        if (!(l > 0) || !isfinite(l))
            continue;
        sum += log(l);
        count++;
    }
    return count ? reinhard_key / exp(sum / (double)count) : 1;
}

/* IEC 61966-2-1 */
static double srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

static float tonemap_channel(double value, double exposed_luminance, double exposure)
{
    /* also NaN */
    if (!(value > 0))
        return 0;
    if (isinf(value))
        return 1;
    double l = exposed_luminance > 0 ? exposed_luminance : 0;
    double mapped = isfinite(l) ? value * exposure / (1 + l) : 0;
    return (float)srgb_encode(mapped < 1 ? mapped : 1);
}

bool irb_tonemap(const struct irb_image *radiance, double exposure, struct irb_image *srgb,
                 struct irb_error *err)
{
    if (radiance->channels < 3)
        return irb_fail(err, IRB_E_INPUT, "tone mapping: %d channels found, expected at least 3",
                        radiance->channels);
    if (!irb_image_create(srgb, radiance->width, radiance->height, 3, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(radiance); i++) {
        const float *rgb = pixel_of(radiance, i);
        double l = luminance(rgb) * exposure;
        for (size_t c = 0; c < 3; c++)
            srgb->data[3 * i + c] = tonemap_channel(rgb[c], l, exposure);
    }
    return true;
}
