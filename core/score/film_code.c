/* SPDX-License-Identifier: MIT */
#include "core/score/film_code.h"

#include <math.h>

enum { LARGEST = 255 };

static const double v0_share = 0.01; /* of the mean: the share of relMSE's eps */
static const double headroom = 4;    /* a result may be brighter than its reference */

struct irb_film_scale irb_film_scale_of(double mean, double percentile)
{
    double brightest = fmax(mean, percentile);
    if (!(mean > 0) || !isfinite(brightest))
        return (struct irb_film_scale){0, 0};
    return (struct irb_film_scale){v0_share * mean, headroom * brightest};
}

static bool usable(const struct irb_film_scale *scale)
{
    return scale->v0 > 0 && scale->vmax > 0;
}

/* Codes a doubling of 1 + v/v0. */
static double codes_a_doubling(const struct irb_film_scale *scale)
{
    return LARGEST / log2(1 + scale->vmax / scale->v0);
}

static unsigned char encode(double v0, double vmax, double codes, float v)
{
    if (!(v > 0))
        return 0;
    return v >= vmax ? LARGEST : (unsigned char)lrint(codes * log2(1 + v / v0));
}

unsigned char irb_film_encode(const struct irb_film_scale *scale, float v)
{
    return usable(scale) ? encode(scale->v0, scale->vmax, codes_a_doubling(scale), v) : 0;
}

double irb_film_decode(const struct irb_film_scale *scale, unsigned char code)
{
    return usable(scale) ? scale->v0 * (exp2(code / codes_a_doubling(scale)) - 1) : 0;
}

bool irb_film_encode_image(const struct irb_film_scale *scale, const struct irb_image *image,
                           struct irb_image *coded, struct irb_error *err)
{
    if (!irb_image_create(coded, image->width, image->height, image->channels, err))
        return false;
    size_t values = irb_image_pixels(image) * (size_t)image->channels;
    double codes = usable(scale) ? codes_a_doubling(scale) : 0;
    for (size_t i = 0; codes > 0 && i < values; i++)
        coded->data[i] = (float)encode(scale->v0, scale->vmax, codes, image->data[i]) / LARGEST;
    return true;
}
