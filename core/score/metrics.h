/* SPDX-License-Identifier: MIT
 *
 * Image metrics on linear HDR images, over pixels with geometry (mask != 0). Each follows the
 * public definition it names; sums are in double, in the order of the pixels.
 *
 * A pixel counts where the mask says so and every channel of every image in question is finite.
 * Where no pixel counts, means and ratios are NaN and counts are 0.
 */
#ifndef IRB_SCORE_METRICS_H
#define IRB_SCORE_METRICS_H

#include "core/image/image.h"

#include <stdint.h>

/* test v, reference r: 3 channels, one size; mask: width*height bytes, NULL = all. */
struct irb_pair {
    const struct irb_image *test, *reference;
    const uint8_t *mask;
};

/* Whether the pixel counts. */
bool irb_pair_counts(const struct irb_pair *pair, size_t pixel);

struct irb_error_scores {
    double rmse;         /* sqrt(mean (v-r)^2) over pixels and channels; units of the image */
    double relmse;       /* mean (v-r)^2/(r^2 + eps); no unit */
    double smape;        /* mean |v-r|/(|v| + |r| + sqrt(eps)), [0,1] for values of one sign; the
                            symmetric error of Vogels et al. 2018, 10.1145/3197517.3201388, with
                            a bound on darkness that follows the scene */
    double bias;         /* mean (v-r); units of the image */
    double energy_ratio; /* sum v / sum r; NaN where sum r = 0 */
    long non_finite;     /* pixels with a NaN or Inf; they are left out of all other figures */
    long negative;       /* pixels with a negative channel in the test image */
    long pixels;         /* that count */
};

/* eps > 0: (0.01 * mean reference of the sequence)^2, see irb_relmse_eps. */
struct irb_error_scores irb_score_errors(const struct irb_pair *pair, double eps);

/* (0.01 * mean)^2, W2/(m4 sr2) for radiance, bounded below by the smallest normal float squared for
 * black references. */
double irb_relmse_eps(double mean_reference);

/* Peak signal-to-noise ratio, 20 log10(peak/rmse) in dB; infinite for an RMSE of 0, NaN for a black
 * reference (peak 0). */
double irb_psnr(double rmse, double peak);

/* PSNR's peak: this fraction of the reference's values; the brightest few, where a light is seen or
 * an estimate went astray, would set the scale for all. */
#define IRB_PSNR_PEAK_FRACTION 0.999

/* The smallest value that `fraction` of all values do not exceed (nearest rank), over channels and
 * the pixels under the masks that are finite; negative values count as 0. masks, or any of them,
 * may be NULL: all pixels. NaN when memory is out, 0 for no value. */
double irb_value_percentile(const struct irb_image *const *images, const uint8_t *const *masks,
                            int image_count, double fraction);

/* Mean over pixels and channels of the finite values under the mask. */
double irb_masked_mean(const struct irb_image *image, const uint8_t *mask);

/* Squared error map |v-r|^2/(r^2+eps), mean over channels; 1 channel, created. 0 where the mask is
 * 0, NaN where a pixel is not finite. */
bool irb_relmse_map(const struct irb_pair *pair, double eps, struct irb_image *map,
                    struct irb_error *err);

/* Mean, median (of an even count the mean of the middle two), 95th percentile (nearest rank) and
 * maximum; values need not be sorted, NaNs among them are left out. NaN for none. */
struct irb_summary {
    double mean, median, p95, worst;
};
struct irb_summary irb_summarise(const double *values, int count);

#endif
