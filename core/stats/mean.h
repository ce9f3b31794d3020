/* SPDX-License-Identifier: MIT
 *
 * The mean of a list of numbers.
 */
#ifndef IRB_STATS_MEAN_H
#define IRB_STATS_MEAN_H

/* Equal numbers have exactly their own value as mean. count >= 1. */
static inline double irb_mean(const double *x, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += x[i] - x[0];
    return x[0] + sum / count;
}

#endif
