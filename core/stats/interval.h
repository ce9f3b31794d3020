/* SPDX-License-Identifier: MIT
 *
 * Confidence intervals of a mean and of a ratio of two means, from a handful of independent units:
 * seeds, whole repeats, or blocks of frames (core/stats/blocks.h). Frames are correlated; a single
 * one is never a unit.
 *
 * Method: the smoothed bootstrap-t. A resample is `count` units drawn with replacement, each with
 * noise of variance s^2/count added; t = (its mean - the units' mean)/(its standard error); the
 * interval is mean - t_high se .. mean - t_low se, with quantiles of t at k/(B + 1) (Hall 1988,
 * 1992; Efron and Tibshirani 1993, section 12.5; Davison and Hinkley 1997, section 5.2; smoothed:
 * their section 3.4). The noise is not tuned to any shape: resamples of the units alone have the
 * variance (count - 1)/count s^2, and with it they have s^2, the unbiased one (Hesterberg 2004,
 * "Unbiasing the bootstrap", Proc. ASA Section on Statistics and the Environment). Its density is a
 * cubic B-spline, which needs no function of a math library. Up to 5 units all count^count
 * resamples are gone through, as often as makes 2048 or more; of more units 2048 are drawn. Each
 * comes with its noise and with the negative of that.
 *
 * Why not plainer: coverage of 95 % intervals from 5 units, and their mean half-width in standard
 * errors (2000 trials, so +- 0.5; of this 10000; sigma is that of lognormal units):
 *
 *                              normal      sigma 0.3   sigma 0.6   uniform     exponential
 *     Student's t              95.0  2.8   94.0  2.8   90.0  2.8   92.2  2.8   87.8  2.8
 *     BCa, all 3125            83.9  1.8   83.6  1.8   80.4  1.8   85.5  1.8   80.4  1.8
 *     bootstrap-t, all 3125    95.3  4.4   95.2  4.5   92.5  5.3   95.0  5.0   94.0  6.5
 *     this                     95.4  3.1   94.2  3.1   92.1  3.2   95.3  3.2   91.5  3.2
 *
 * Bootstrap-t without noise covers too, but a resample in ten consists of two different units,
 * often close ones, and 5 in 3125 of one alone: t is then huge or not defined (for a third of all,
 * where four of five units are equal), and intervals get half as long again (Polansky 2000,
 * Canadian J. of Statistics 28, is about this). Coverage and half-width for other numbers of units:
 *
 *     units                    3           4           8           20
 *     normal                   96.2  5.1   95.6  3.8   95.2  2.5   95.0  2.1
 *     sigma 0.1                96.0  5.1   95.1  3.8   94.8  2.6   95.3  2.1
 *     sigma 0.3                95.3  5.1   94.8  3.8   94.5  2.6   94.3  2.2
 *
 * Ratios of 5 pairs of lognormal units, sigma 0.1 to 0.3, correlated by 0, 0.5 or 0.9: 94.5 to
 * 95.2 (4000 trials each); sigma 0.6: 90.7 to 92.7.
 * What is much more skewed than errors are (sigma 0.6 and up, exponential) is covered too seldom
 * from 5 units.
 *
 * Same units, same bits. The order of the units doesn't matter (but for rounding); units times a
 * power of two give bounds times it, exactly; units with the opposite sign the mirrored interval.
 *
 * Does not: know a range. The low end of a mean of positive units may be negative.
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

/* The mean of the units and its interval; confidence in (0,1), 0.95 as a rule. Equal units:
 * low = value = high. Less than IRB_INTERVAL_LEAST_UNITS units, or one that is not finite: low and
 * high are NaN; so is the value of no units, or with a NaN among them. */
struct irb_interval irb_mean_interval(const double *units, int count, double confidence);

/* mean(a)/mean(b) of units in pairs (the same seed, the same block), on the log scale: the
 * bootstrap above of u_i = a_i/mean(a) - b_i/mean(b), the influence of pair i on the logarithm,
 * whose standard error is the delta method's (Davison and Hinkley 1997, section 2.7). What a and b
 * have in common falls out. The interval of b/a is the inverse. Equal pairs, and units of b that
 * are those of a times a power of two: low = value = high. For units >= 0. All 0 in a: 0, in b:
 * infinity, in both: 1 (equal), each with low = high = value, since there is no telling by how
 * much. A mean < 0 has no logarithm: low and high are NaN. Number of units, not finite ones: as
 * above. */
struct irb_interval irb_ratio_interval(const double *a, const double *b, int count,
                                       double confidence);

/* Whether x lies in it, bounds included; never where there is no interval. */
bool irb_interval_contains(const struct irb_interval *interval, double x);

/* The interval of an error that was measured against a reference with noise of its own. The noise
 * does not depend on the method, so that in expectation
 *     measured mean square = true mean square + mean square of the noise,
 * and the true error may be lower by that: low = max(0, low - noise), or sqrt(max(0, low^2 -
 * noise)) for the root of a mean square (root: RMSE). noise >= 0 is a mean square in either case,
 * and normalised as the error is (relMSE's is the metric reference_noise). NaN or negative: taken
 * as 0. value and high stay: the value is what was measured, and taking off nothing is the safe
 * side for high. That is for mean squares and their roots: FLIP and mean absolute errors do not add
 * like this. Where by how much the noise raises such an error has been measured (FLIP's is the
 * metric indirect_flip_noise, by extrapolation), that amount may be taken off likewise, root =
 * false. */
struct irb_interval irb_interval_less_noise(struct irb_interval interval, double noise, bool root);

#endif
