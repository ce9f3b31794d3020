/* SPDX-License-Identifier: MIT
 *
 * The logarithmic code by which films hold radiance in 8 bits a channel: equal steps are equal
 * ratios well above v0, and equal differences below it.
 *
 *     code = 255 log2(1 + v/v0) / log2(1 + vmax/v0)
 *
 * With vmax = 4000 v0 a step is 3 % of a bright value, and v0/30 near black.
 */
#ifndef IRB_SCORE_FILM_CODE_H
#define IRB_SCORE_FILM_CODE_H

#include "core/image/image.h"

struct irb_film_scale {
    double v0;   /* below it the code is nearly linear; unit of the image */
    double vmax; /* has code 255, and so has all above it */
};

/* From the mean of a sequence's reference and its 99.99th percentile: v0 = 0.01 mean, vmax = 4
 * percentiles, but at least 4 means. Both are 0 for a black sequence, whose codes are all 0. */
#define IRB_FILM_FRACTION 0.9999
struct irb_film_scale irb_film_scale_of(double mean, double percentile);

/* 0 for 0, for what is negative and for NaN; 255 for infinity. Never falls as v grows. */
unsigned char irb_film_encode(const struct irb_film_scale *scale, float v);
/* The value that has the code before rounding: within half a step of all that have it. */
double irb_film_decode(const struct irb_film_scale *scale, unsigned char code);

/* Codes over 255, of all channels: what irb_jpeg_write takes. *coded is created. */
bool irb_film_encode_image(const struct irb_film_scale *scale, const struct irb_image *image,
                           struct irb_image *coded, struct irb_error *err);

#endif
