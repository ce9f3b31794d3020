/* SPDX-License-Identifier: MIT */
#include "core/stats/interval.h"
#include "core/stats/mean.h"
#include "core/stats/rng.h"

#include <math.h>
#include <stdlib.h>

enum {
    ENUMERATED_UNITS = 5, /* up to which all count^count resamples are gone through */
    LEAST_RESAMPLES = 2048,
};

const char *const irb_unit_names[IRB_UNIT_COUNT] = {"none", "seed", "repeat", "block"};

/* z = (x - mean)/s with the sample's standard deviation s; all 0 where s is 0. Returns s. The
 * squares are those of deviations over the largest, so that none leaves a double's range. */
static double standardise(const double *x, int count, double mean, double *z)
{
    double largest = 0, squares = 0;
    for (int i = 0; i < count; i++) {
        z[i] = x[i] - mean;
        largest = fmax(largest, fabs(z[i]));
    }
    for (int i = 0; i < count && largest > 0; i++) {
        z[i] /= largest;
        squares += z[i] * z[i];
    }
    double deviation = sqrt(squares / (count - 1));
    for (int i = 0; i < count && deviation > 0; i++)
        z[i] /= deviation;
    return largest * deviation;
}

/* By size of the deviation: neither the units' order nor their sign then changes what is drawn. */
static int by_size(const void *a, const void *b)
{
    double x = fabs(*(const double *)a), y = fabs(*(const double *)b);
    return (x > y) - (x < y);
}

static double t_of(const double *y, int count)
{
    double mean = 0, squares = 0;
    for (int i = 0; i < count; i++)
        mean += y[i];
    mean /= count;
    for (int i = 0; i < count; i++)
        squares += (y[i] - mean) * (y[i] - mean);
    return squares > 0 ? mean / sqrt(squares / ((double)count * (count - 1))) : 0;
}

/* Resamples: whole rounds of all count^count of few units, random ones of many. */
static int resamples_of(int count)
{
    if (count > ENUMERATED_UNITS)
        return LEAST_RESAMPLES;
    int all = 1;
    for (int i = 0; i < count; i++)
        all *= count;
    return (LEAST_RESAMPLES + all - 1) / all * all;
}

/* The studentised means of both smoothed resamples number r. y: scratch of 2*count. */
static void resample(const double *z, int count, uint64_t r, double *y, double t[2])
{
    const double width = 1 / sqrt(count);
    uint64_t digits = r;
    for (int i = 0; i < count; i++, digits /= (uint64_t)count) {
        uint64_t counter = r * (uint64_t)count + (uint64_t)i;
        int pick = count <= ENUMERATED_UNITS ? (int)(digits % (uint64_t)count)
                                             : irb_rng_below(1, counter, count);
        double noise = width * irb_rng_bell(2, counter);
        y[i] = z[pick] + noise;
        y[count + i] = z[pick] - noise;
    }
    t[0] = t_of(y, count);
    t[1] = t_of(y + count, count);
}

/* Puts t among the `rank` smallest so far, which rise. */
static void keep_smallest(double *smallest, int rank, double t)
{
    int i = rank - 1;
    if (!(t < smallest[i]))
        return;
    for (; i > 0 && t < smallest[i - 1]; i--)
        smallest[i] = smallest[i - 1];
    smallest[i] = t;
}

/* The studentised mean that a share (1 - confidence)/2 of the resamples falls below, or rises
 * above: the quantiles k/(B + 1) of B. z: standardised units. false: no memory. */
static bool t_bounds(double *z, int count, double confidence, double bounds[2])
{
    const int resamples = resamples_of(count), drawn = 2 * resamples;
    int rank = (int)(0.5 * (1 - confidence) * (drawn + 1));
    rank = rank < 1 ? 1 : rank;
    double *tails = malloc((2 * (size_t)rank + 2 * (size_t)count) * sizeof *tails);
    if (!tails)
        return false;
    for (int i = 0; i < 2 * rank; i++)
        tails[i] = INFINITY;
    qsort(z, (size_t)count, sizeof *z, by_size);
    for (int r = 0; r < resamples; r++) {
        double t[2];
        resample(z, count, (uint64_t)r, tails + 2 * rank, t);
        for (int i = 0; i < 2; i++) {
            keep_smallest(tails, rank, t[i]);
            keep_smallest(tails + rank, rank, -t[i]);
        }
    }
    bounds[0] = tails[rank - 1];
    bounds[1] = -tails[2 * rank - 1];
    free(tails);
    return true;
}

/* How far the mean's interval reaches: {low, high} - mean. NaN where there is none. */
static void reach_of(const double *x, int count, double mean, double confidence, double reach[2])
{
    double bounds[2], *z = NULL;
    reach[0] = reach[1] = NAN;
    if (count < IRB_INTERVAL_LEAST_UNITS || !(confidence > 0 && confidence < 1) ||
        !(z = malloc((size_t)count * sizeof *z)))
        return;
    double deviation = standardise(x, count, mean, z);
    if (deviation == 0) {
        reach[0] = reach[1] = 0;
    } else if (deviation < INFINITY && t_bounds(z, count, confidence, bounds)) {
        double error = deviation / sqrt(count);
        reach[0] = fmin(0, -bounds[1] * error);
        reach[1] = fmax(0, -bounds[0] * error);
    }
    free(z);
}

struct irb_interval irb_mean_interval(const double *units, int count, double confidence)
{
    struct irb_interval interval = {NAN, NAN, NAN, count};
    if (count < 1)
        return interval;
    double reach[2];
    interval.value = irb_mean(units, count);
    reach_of(units, count, interval.value, confidence, reach);
    interval.low = interval.value + reach[0];
    interval.high = interval.value + reach[1];
    return interval;
}

struct irb_interval irb_ratio_interval(const double *a, const double *b, int count,
                                       double confidence)
{
    struct irb_interval interval = {NAN, NAN, NAN, count};
    double *influence = count < 1 ? NULL : malloc((size_t)count * sizeof *influence);
    if (!influence)
        return interval;
    const double mean_a = irb_mean(a, count), mean_b = irb_mean(b, count);
    const bool log_scale = mean_a > 0 && mean_b > 0;
    interval.value = mean_a == mean_b ? 1 : mean_b == 0 ? INFINITY : mean_a / mean_b;
    for (int i = 0; i < count; i++)
        influence[i] = log_scale ? a[i] / mean_a - b[i] / mean_b : 0;
    double reach[2];
    reach_of(influence, count, 0, confidence, reach);
    if (log_scale) {
        interval.low = interval.value * exp(reach[0]);
        interval.high = interval.value * exp(reach[1]);
    } else if (mean_a >= 0 && mean_b >= 0 && count >= IRB_INTERVAL_LEAST_UNITS) {
        interval.low = interval.high = interval.value;
    }
    free(influence);
    return interval;
}

bool irb_interval_contains(const struct irb_interval *interval, double x)
{
    return interval->low <= x && x <= interval->high;
}

static double less(double x, double noise, bool root)
{
    double square = fmax(0, (root ? x * x : x) - noise);
    return root ? sqrt(square) : square;
}

struct irb_interval irb_interval_less_noise(struct irb_interval interval, double noise, bool root)
{
    if (!isnan(interval.low))
        interval.low = less(fmax(0, interval.low), fmax(0, noise), root);
    return interval;
}
