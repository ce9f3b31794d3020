/* SPDX-License-Identifier: MIT */
#include "core/score/metrics.h"

#include "core/score/quantile.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { CHANNELS = 3 };

static bool masked(const uint8_t *mask, size_t pixel)
{
    return mask && !mask[pixel];
}

static bool finite3(const float *v)
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static bool pair_finite(const struct irb_pair *pair, size_t pixel)
{
    return finite3(pair->test->data + CHANNELS * pixel) &&
           finite3(pair->reference->data + CHANNELS * pixel);
}

bool irb_pair_counts(const struct irb_pair *pair, size_t pixel)
{
    return !masked(pair->mask, pixel) && pair_finite(pair, pixel);
}

struct irb_error_scores irb_score_errors(const struct irb_pair *pair, double eps)
{
    struct irb_error_scores scores = {0};
    double square = 0, relative = 0, symmetric = 0, difference = 0;
    double test_sum = 0, reference_sum = 0, level = sqrt(eps);
    size_t pixels = irb_image_pixels(pair->test);
    for (size_t i = 0; i < pixels; i++) {
        if (masked(pair->mask, i))
            continue;
        const float *test = pair->test->data + CHANNELS * i;
        const float *reference = pair->reference->data + CHANNELS * i;
        if (!pair_finite(pair, i)) {
            scores.non_finite++;
            continue;
        }
        scores.negative += test[0] < 0 || test[1] < 0 || test[2] < 0;
        scores.pixels++;
        for (int c = 0; c < CHANNELS; c++) {
            double v = test[c], r = reference[c], d = v - r;
            square += d * d;
            relative += d * d / (r * r + eps);
            symmetric += fabs(d) / (fabs(v) + fabs(r) + level);
            difference += d;
            test_sum += v;
            reference_sum += r;
        }
    }
    double count = (double)scores.pixels * CHANNELS; /* 0/0 is the NaN for no pixels */
    scores.rmse = sqrt(square / count);
    scores.relmse = relative / count;
    scores.smape = symmetric / count;
    scores.bias = difference / count;
    scores.energy_ratio = reference_sum != 0 ? test_sum / reference_sum : NAN;
    return scores;
}

double irb_relmse_eps(double mean_reference)
{
    double eps = 0.01 * mean_reference * 0.01 * mean_reference;
    double least = (double)FLT_MIN * FLT_MIN;
    return eps > least ? eps : least;
}

double irb_psnr(double rmse, double peak)
{
    return peak > 0 ? 20 * log10(peak / rmse) : NAN;
}

double irb_value_percentile(const struct irb_image *const *images, const uint8_t *const *masks,
                            int image_count, double fraction)
{
    struct irb_quantile *quantile = irb_quantile_create(fraction);
    if (!quantile)
        return NAN;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < image_count; i++) {
            size_t channels = (size_t)images[i]->channels;
            for (size_t p = 0; p < channels * irb_image_pixels(images[i]); p++) {
                float value = images[i]->data[p];
                if (isfinite(value) && !masked(masks ? masks[i] : NULL, p / channels))
                    irb_quantile_add(quantile, value > 0 ? value : 0, 1);
            }
        }
        irb_quantile_pass_done(quantile);
    }
    return irb_quantile_finish(quantile);
}

double irb_masked_mean(const struct irb_image *image, const uint8_t *mask)
{
    double sum = 0;
    long count = 0;
    size_t pixels = irb_image_pixels(image);
    for (size_t i = 0; i < pixels; i++) {
        if (masked(mask, i))
            continue;
        for (int c = 0; c < image->channels; c++) {
            float value = image->data[i * (size_t)image->channels + (size_t)c];
            if (isfinite(value)) {
                sum += value;
                count++;
            }
        }
    }
    return sum / (double)count;
}

bool irb_relmse_map(const struct irb_pair *pair, double eps, struct irb_image *map,
                    struct irb_error *err)
{
    if (!irb_image_create(map, pair->test->width, pair->test->height, 1, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(map); i++) {
        if (masked(pair->mask, i))
            continue;
        double sum = 0;
        for (int c = 0; c < CHANNELS; c++) {
            double v = pair->test->data[CHANNELS * i + (size_t)c];
            double r = pair->reference->data[CHANNELS * i + (size_t)c];
            sum += (v - r) * (v - r) / (r * r + eps);
        }
        map->data[i] = pair_finite(pair, i) ? (float)(sum / CHANNELS) : NAN;
    }
    return true;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

struct irb_summary irb_summarise(const double *values, int count)
{
    struct irb_summary summary = {NAN, NAN, NAN, NAN};
    double *sorted = count > 0 ? malloc((size_t)count * sizeof *sorted) : NULL;
    int n = 0;
    for (int i = 0; sorted && i < count; i++)
        if (!isnan(values[i]))
            sorted[n++] = values[i];
    if (n > 0) {
        qsort(sorted, (size_t)n, sizeof *sorted, ascending);
        double sum = 0;
        for (int i = 0; i < n; i++)
            sum += sorted[i];
        summary.mean = sum / n;
        summary.median = n % 2 ? sorted[n / 2] : 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]);
        /* nearest rank: ceil(0.95 n), in integers */
        summary.p95 = sorted[(95 * n + 99) / 100 - 1];
        summary.worst = sorted[n - 1];
    }
    free(sorted);
    return summary;
}
