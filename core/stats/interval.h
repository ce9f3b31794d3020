/* SPDX-License-Identifier: MIT
 *
 * Confidence intervals of a mean and of a ratio of two means, from a handful of independent units:
 * seeds, whole repeats, or blocks of frames (core/stats/blocks.h). Frames are correlated; a single
 * one is never a unit.
 */
#ifndef IRB_STATS_INTERVAL_H
#define IRB_STATS_INTERVAL_H

#include <stdbool.h>

enum {
    IRB_INTERVAL_LEAST_UNITS = 3, /* fewer have no interval: low and high are NaN */
};

struct irb_interval {
    double value, low, high; /* low <= value <= high, or NaN low and high */
    int units;
};

enum irb_unit { IRB_UNIT_NONE, IRB_UNIT_SEED, IRB_UNIT_REPEAT, IRB_UNIT_BLOCK, IRB_UNIT_COUNT };
extern const char *const irb_unit_names[IRB_UNIT_COUNT]; /* "none", "seed", "repeat", "block" */

/* The mean of the units and its interval; confidence in (0,1), 0.95 as a rule. */
struct irb_interval irb_mean_interval(const double *units, int count, double confidence);

/* mean(a)/mean(b) of units in pairs (the same seed, the same block), on the log scale, so that the
 * interval of b/a is the inverse. */
struct irb_interval irb_ratio_interval(const double *a, const double *b, int count,
                                       double confidence);

/* Whether x lies in it, bounds included; never where there is no interval. */
bool irb_interval_contains(const struct irb_interval *interval, double x);

/* The interval of a mean-square error less the mean square that the reference's own noise makes:
 * low = max(0, low - noise). root: that of its root; noise is a mean square all the same:
 * low = sqrt(max(0, low^2 - noise)). */
struct irb_interval irb_interval_less_noise(struct irb_interval interval, double noise, bool root);

#endif
