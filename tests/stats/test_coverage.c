/* SPDX-License-Identifier: MIT
 *
 * How often a 95 % interval from five seeds holds the truth, over 2000 simulated trials each
 * (standard error 0.5 %): means and paired ratios, of seeds and of seeds that are means of frames.
 */
#include "tests/stats/random.h"

#include <stdio.h>

enum { TRIALS = 2000, SEEDS = 5, FRAMES = 24 };

static void normal_seeds(void **state)
{
    (void)state;
    struct random random = {101, 0};
    struct coverage coverage = {0};
    for (int t = 0; t < TRIALS; t++) {
        double units[SEEDS];
        for (int i = 0; i < SEEDS; i++)
            units[i] = 3 + random_normal(&random);
        struct irb_interval interval = irb_mean_interval(units, SEEDS, 0.95);
        coverage_add(&coverage, &interval, 3);
    }
    require_covers(&coverage, "5 seeds, normal");
}

static void lognormal_seeds(void **state)
{
    (void)state;
    for (int tenths = 1; tenths <= 3; tenths++) {
        const double sigma = 0.1 * tenths;
        struct random random = {110 + (uint64_t)tenths, 0};
        struct coverage coverage = {0};
        for (int t = 0; t < TRIALS; t++) {
            double units[SEEDS];
            for (int i = 0; i < SEEDS; i++)
                units[i] = exp(sigma * random_normal(&random));
            struct irb_interval interval = irb_mean_interval(units, SEEDS, 0.95);
            coverage_add(&coverage, &interval, exp(0.5 * sigma * sigma));
        }
        char what[64];
        snprintf(what, sizeof what, "5 seeds, lognormal, sigma %.1f", sigma);
        require_covers(&coverage, what);
    }
}

static void ratio_of(double sigma, double rho, double ratio, uint64_t seed)
{
    struct random random = {seed, 0};
    struct coverage coverage = {0};
    for (int t = 0; t < TRIALS; t++) {
        double a[SEEDS], b[SEEDS];
        for (int i = 0; i < SEEDS; i++) {
            double x = random_normal(&random), y = random_normal(&random);
            a[i] = ratio * exp(sigma * x);
            b[i] = exp(sigma * (rho * x + sqrt(1 - rho * rho) * y));
        }
        struct irb_interval interval = irb_ratio_interval(a, b, SEEDS, 0.95);
        coverage_add(&coverage, &interval, ratio);
    }
    char what[64];
    snprintf(what, sizeof what, "5 pairs, sigma %.1f, correlation %.1f", sigma, rho);
    require_covers(&coverage, what);
}

static void ratios(void **state)
{
    (void)state;
    ratio_of(0.1, 0, 0.8, 120);
    ratio_of(0.1, 0.9, 1, 121);
    ratio_of(0.2, 0.5, 3, 122);
    ratio_of(0.3, 0, 1, 123);
    ratio_of(0.3, 0.5, 0.2, 124);
    ratio_of(0.3, 0.9, 1, 125);
}

/* A seed's unit is the mean over its frames, however these correlate. */
static void seeds_of_frames(void **state)
{
    (void)state;
    for (int r = 0; r < 2; r++) {
        const double rho = r ? 0.8 : 0.5;
        struct random random = {130 + (uint64_t)r, 0};
        struct coverage coverage = {0};
        for (int t = 0; t < TRIALS; t++) {
            double frames[FRAMES], units[SEEDS];
            for (int i = 0; i < SEEDS; i++) {
                random_frames(&random, rho, FRAMES, frames);
                units[i] = 10 + mean_of_all(frames, FRAMES);
            }
            struct irb_interval interval = irb_mean_interval(units, SEEDS, 0.95);
            coverage_add(&coverage, &interval, 10);
        }
        char what[64];
        snprintf(what, sizeof what, "5 seeds of 24 frames, AR(1) %.1f", rho);
        require_covers(&coverage, what);
    }
}

/* Why: with the same frames as units of their own the interval is too narrow by a half and more. */
static void frames_are_no_units(void **state)
{
    (void)state;
    for (int r = 0; r < 2; r++) {
        struct random random = {140 + (uint64_t)r, 0};
        struct coverage coverage = {0};
        for (int t = 0; t < 100; t++) {
            double frames[SEEDS * FRAMES];
            for (int i = 0; i < SEEDS; i++)
                random_frames(&random, r ? 0.8 : 0.5, FRAMES, frames + i * FRAMES);
            struct irb_interval interval = irb_mean_interval(frames, SEEDS * FRAMES, 0.95);
            coverage_add(&coverage, &interval, 0);
        }
        double percent = coverage_percent(&coverage, r ? "frames as units, AR(1) 0.8"
                                                       : "frames as units, AR(1) 0.5");
        REQUIRE_CMP(percent, <, r ? 60 : 85);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normal_seeds),
        cmocka_unit_test(lognormal_seeds),
        cmocka_unit_test(ratios),
        cmocka_unit_test(seeds_of_frames),
        cmocka_unit_test(frames_are_no_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
