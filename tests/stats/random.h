/* SPDX-License-Identifier: MIT
 *
 * Normal numbers and series of them for simulated trials, and how often an interval is right.
 */
#ifndef IRB_TESTS_STATS_RANDOM_H
#define IRB_TESTS_STATS_RANDOM_H

#include "core/stats/rng.h"

#include "core/stats/interval.h"

#include "tests/support/compare.h"

struct random {
    uint64_t seed, counter;
};

/* In (0,1). */
static inline double random_uniform(struct random *random)
{
    return ((double)(irb_rng_bits(random->seed, random->counter++) >> 11) + 0.5) * 0x1p-53;
}

/* Box and Muller 1958. */
static inline double random_normal(struct random *random)
{
    double radius = sqrt(-2 * log(random_uniform(random)));
    return radius * cos(2 * 3.14159265358979323846 * random_uniform(random));
}

/* Frames of mean 0 and variance 1 that correlate with the one before by rho: AR(1). */
static inline void random_frames(struct random *random, double rho, int count, double *frames)
{
    for (int i = 0; i < count; i++) {
        double fresh = random_normal(random);
        frames[i] = i ? rho * frames[i - 1] + sqrt(1 - rho * rho) * fresh : fresh;
    }
}

static inline double mean_of_all(const double *x, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += x[i];
    return sum / count;
}

struct coverage {
    int trials, hits;
};

static inline void coverage_add(struct coverage *coverage, const struct irb_interval *interval,
                                double truth)
{
    coverage->trials++;
    coverage->hits += irb_interval_contains(interval, truth);
}

/* %, printed too. */
static inline double coverage_percent(const struct coverage *coverage, const char *what)
{
    double percent = 100.0 * coverage->hits / coverage->trials;
    print_message("%-52s covered in %5.2f %% of %d\n", what, percent, coverage->trials);
    return percent;
}

static inline void require_covers(const struct coverage *coverage, const char *what)
{
    double percent = coverage_percent(coverage, what);
    REQUIRE_CMP(percent, >=, 93);
    REQUIRE_CMP(percent, <=, 97);
}

#endif
