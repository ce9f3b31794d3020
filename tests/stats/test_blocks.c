/* SPDX-License-Identifier: MIT
 *
 * Blocks of frames: what they are made of, which series have none, and how often intervals from
 * them hold the truth.
 */
#include "core/stats/blocks.h"
#include "tests/stats/random.h"

#include <stdio.h>

enum { TRIALS = 2000, MOST_FRAMES = 1024 };

static void short_series(void **state)
{
    (void)state;
    struct random random = {201, 0};
    double frames[MOST_FRAMES], means[IRB_BLOCKS_MOST], others[IRB_BLOCKS_MOST];
    random_frames(&random, 0, MOST_FRAMES, frames);
    for (int count = 0; count < IRB_BLOCKS_LEAST_FRAMES; count++) {
        assert_int_equal(irb_blocks(frames, count, means), 0);
        assert_int_equal(irb_blocks_pair(frames, frames, count, means, others), 0);
    }
    assert_int_equal(irb_blocks(frames, IRB_BLOCKS_LEAST_FRAMES, means), 3);
    assert_int_equal(irb_blocks(frames, 128, means), 4);
    assert_int_equal(irb_blocks(frames, MOST_FRAMES, means), IRB_BLOCKS_MOST);
}

/* All frames belong to a block, each to one. */
static void means_of_blocks(void **state)
{
    (void)state;
    struct random random = {202, 0};
    double frames[100], means[IRB_BLOCKS_MOST];
    random_frames(&random, 0.2, 100, frames);
    assert_int_equal(irb_blocks(frames, 96, means), 3);
    for (int b = 0; b < 3; b++)
        REQUIRE_NEAR(means[b], mean_of_all(frames + 32 * b, 32), 1e-14);
    assert_int_equal(irb_blocks(frames, 100, means), 3);
    const int ends[] = {0, 33, 66, 100};
    for (int b = 0; b < 3; b++)
        REQUIRE_NEAR(means[b], mean_of_all(frames + ends[b], ends[b + 1] - ends[b]), 1e-14);
    for (int i = 0; i < 100; i++)
        frames[i] = 0.1;
    assert_int_equal(irb_blocks(frames, 100, means), 3);
    struct irb_interval interval = irb_mean_interval(means, 3, 0.95);
    REQUIRE_CMP(interval.low, ==, 0.1);
    REQUIRE_CMP(interval.high, ==, 0.1);
}

/* A slow rise has three blocks, however long it is, and a wide interval; of two that rise alike the
 * ratio is known well. */
static void slow_series(void **state)
{
    (void)state;
    struct random random = {203, 0};
    double a[200], b[200], means_a[IRB_BLOCKS_MOST], means_b[IRB_BLOCKS_MOST];
    for (int i = 0; i < 200; i++) {
        b[i] = 1 + 0.05 * i;
        a[i] = 0.7 * b[i] * exp(0.02 * random_normal(&random));
    }
    assert_int_equal(irb_blocks(b, 200, means_b), 3);
    struct irb_interval interval = irb_mean_interval(means_b, 3, 0.95);
    REQUIRE_CMP(interval.high - interval.low, >, 0.05 * 200);
    int blocks = irb_blocks_pair(a, b, 200, means_a, means_b);
    assert_int_equal(blocks, 6);
    interval = irb_ratio_interval(means_a, means_b, blocks, 0.95);
    assert_true(irb_interval_contains(&interval, 0.7));
    REQUIRE_CMP(interval.high - interval.low, <, 0.02);
}

/* The longer the correlation, the fewer the blocks. */
static void longer_blocks(void **state)
{
    (void)state;
    struct random random = {204, 0};
    double frames[MOST_FRAMES], means[IRB_BLOCKS_MOST];
    random_frames(&random, 0.95, MOST_FRAMES, frames);
    int blocks = irb_blocks(frames, MOST_FRAMES, means);
    REQUIRE_CMP(blocks, >=, 4); /* 1024/(7 x 19.5) = 7.5 */
    REQUIRE_CMP(blocks, <=, 12);
}

static void coverage_of(double rho, int count, uint64_t seed)
{
    struct random random = {seed, 0};
    struct coverage coverage = {0};
    for (int t = 0; t < TRIALS; t++) {
        double frames[MOST_FRAMES], means[IRB_BLOCKS_MOST];
        random_frames(&random, rho, count, frames);
        int blocks = irb_blocks(frames, count, means);
        struct irb_interval interval = irb_mean_interval(means, blocks, 0.95);
        coverage_add(&coverage, &interval, 0);
    }
    char what[64];
    snprintf(what, sizeof what, "blocks of %d frames, AR(1) %.1f", count, rho);
    require_covers(&coverage, what);
}

static void covers(void **state)
{
    (void)state;
    coverage_of(0, IRB_BLOCKS_LEAST_FRAMES, 210);
    coverage_of(0.5, IRB_BLOCKS_LEAST_FRAMES, 211);
    coverage_of(0.8, IRB_BLOCKS_LEAST_FRAMES, 212);
    coverage_of(0.8, 64, 213);
    coverage_of(0.8, 96, 214);
    coverage_of(0.8, 256, 215);
    coverage_of(0.9, 256, 216);
}

/* Two methods under the same animation: errors that it moves alike, and noise of either. */
static void ratio_covers(void **state)
{
    (void)state;
    enum { COUNT = 72 };
    struct random random = {220, 0};
    struct coverage coverage = {0};
    for (int t = 0; t < TRIALS; t++) {
        double common[COUNT], x[COUNT], y[COUNT];
        double means_a[IRB_BLOCKS_MOST], means_b[IRB_BLOCKS_MOST];
        random_frames(&random, 0.98, COUNT, common);
        random_frames(&random, 0.5, COUNT, x);
        random_frames(&random, 0.5, COUNT, y);
        for (int i = 0; i < COUNT; i++) {
            x[i] = 2 * exp(0.3 * common[i] + 0.1 * x[i]);
            y[i] = exp(0.3 * common[i] + 0.1 * y[i]);
        }
        int blocks = irb_blocks_pair(x, y, COUNT, means_a, means_b);
        struct irb_interval interval = irb_ratio_interval(means_a, means_b, blocks, 0.95);
        coverage_add(&coverage, &interval, 2);
    }
    require_covers(&coverage, "ratio by blocks of 72 frames");
}

/* Why: the same frames as units of their own. */
static void frames_are_no_units(void **state)
{
    (void)state;
    for (int r = 0; r < 2; r++) {
        struct random random = {230 + (uint64_t)r, 0};
        struct coverage coverage = {0};
        for (int t = 0; t < 400; t++) {
            double frames[IRB_BLOCKS_LEAST_FRAMES];
            random_frames(&random, r ? 0.8 : 0.5, IRB_BLOCKS_LEAST_FRAMES, frames);
            struct irb_interval interval = irb_mean_interval(frames, IRB_BLOCKS_LEAST_FRAMES, 0.95);
            coverage_add(&coverage, &interval, 0);
        }
        double percent = coverage_percent(&coverage, r ? "48 frames as units, AR(1) 0.8"
                                                       : "48 frames as units, AR(1) 0.5");
        REQUIRE_CMP(percent, <, r ? 60 : 85);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_series),
        cmocka_unit_test(means_of_blocks),
        cmocka_unit_test(slow_series),
        cmocka_unit_test(longer_blocks),
        cmocka_unit_test(covers),
        cmocka_unit_test(ratio_covers),
        cmocka_unit_test(frames_are_no_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
