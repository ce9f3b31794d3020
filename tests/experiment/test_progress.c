/* SPDX-License-Identifier: MIT
 *
 * Progress of a run: never back, never outside [0,1], whatever is said of the work.
 */
#include "core/base/hash.h"
#include "core/experiment/progress.h"
#include "core/experiment/stage.h"
#include "tests/support/compare.h"

#include <math.h>

static unsigned history(const void *params)
{
    return *(const int *)params ? IRB_NEEDS_HISTORY : IRB_NEEDS_NOTHING;
}

static const struct irb_option no_options[] = {IRB_OPTION_END};
static const struct irb_method method = {
    .name = "m", .params = no_options, .params_size = sizeof(int), .needs = history};
static int keeps = 1, forgets = 0;
static struct irb_trial trials[] = {{.method = &method, .params = &keeps},
                                    {.method = &method, .params = &forgets}};

static struct irb_config config_of(int frames, int scenes, int trial_count)
{
    return (struct irb_config){.render = {.width = 64, .height = 48, .frames = frames, .settle = 3},
                               .scene_count = scenes,
                               .trials = trials,
                               .trial_count = trial_count,
                               .seed_count = 1,
                               .repeats = 2};
}

/* 8 frames, 3 settle frames with a history and 1 of warm-up without: 11 + 9 units a round. */
static void test_plan(void **state)
{
    (void)state;
    const struct irb_config config = config_of(8, 3, 2);
    assert_int_equal(irb_progress_trial_units(&config, &trials[0]), 11);
    assert_int_equal(irb_progress_trial_units(&config, &trials[1]), 9);
    struct irb_progress p = irb_progress_plan(&config, IRB_STAGE_ALL, false);
    REQUIRE_NEAR(p.kinds[IRB_PROGRESS_REFERENCE].total, 3 * 8, 0);
    REQUIRE_NEAR(p.kinds[IRB_PROGRESS_RENDER].total, 3 * 2 * 20, 0);
    REQUIRE_NEAR(p.kinds[IRB_PROGRESS_SCORE].total, 3 * 2 * 8, 0);
    REQUIRE_NEAR(p.kinds[IRB_PROGRESS_PICTURES].total, 3 * 2 * 8, 0);
    REQUIRE_NEAR(p.kinds[IRB_PROGRESS_KEEP].total, 3 * 2 * 4, 0);
    p = irb_progress_plan(&config, IRB_STAGE_SCORE, false);
    REQUIRE_NEAR(p.kinds[IRB_PROGRESS_REFERENCE].total + p.kinds[IRB_PROGRESS_RENDER].total, 0, 0);
}

/* Without settle frames a history is warmed up as well. */
static void test_no_settle_frames(void **state)
{
    (void)state;
    struct irb_config config = config_of(8, 3, 2);
    config.render.settle = 0;
    assert_int_equal(irb_progress_trial_units(&config, &trials[0]), 9);
    assert_int_equal(irb_progress_trial_units(&config, &trials[1]), 9);
}

/* Two scenes of 4 rounds of 20 units, 1 s each, and 60 s of time from t = 0: a round of each scene
 * is rendered in any case. */
static void test_deadline(void **state)
{
    (void)state;
    const struct irb_config config = config_of(8, 2, 2);
    struct irb_progress p = irb_progress_plan(&config, IRB_STAGE_RENDER, false);
    p.deadline_s = 60;
    irb_progress_round(&p, 1);
    irb_progress_begin(&p, IRB_PROGRESS_RENDER, 0);
    irb_progress_step(&p, 10, 10);
    REQUIRE_NEAR(irb_progress_left_s(&p, 10), 50, 1e-9); /* of 70 */
    irb_progress_step(&p, 10, 55);                       /* slower: 2.75 s */
    REQUIRE_NEAR(irb_progress_left_s(&p, 55), 20 * 2.75, 1e-9);
    irb_progress_leave_out(&p, IRB_PROGRESS_RENDER, 20);
    irb_progress_round(&p, 0);
    irb_progress_begin(&p, IRB_PROGRESS_RENDER, 60);
    irb_progress_step(&p, 20, 60);
    REQUIRE_NEAR(irb_progress_left_s(&p, 61), 0, 0);
    REQUIRE_NEAR(irb_progress_fraction(&p), 40. / 80, 1e-9); /* what is left out is not done */
}

/* All that is left is to keep images: not the end. */
static void test_keeping(void **state)
{
    (void)state;
    const struct irb_config config = config_of(8, 1, 2);
    struct irb_progress p = irb_progress_plan(&config, IRB_STAGE_SCORE, true);
    irb_progress_skip_trials(&p, IRB_PROGRESS_SCORE, 2);
    irb_progress_skip_trials(&p, IRB_PROGRESS_PICTURES, 1);
    irb_progress_begin(&p, IRB_PROGRESS_PICTURES, 0);
    irb_progress_step(&p, 8, 8);
    assert_true(irb_progress_fraction(&p) < 1);
    irb_progress_begin(&p, IRB_PROGRESS_KEEP, 8);
    irb_progress_step(&p, 4, 20);
    irb_progress_part(&p, 2);
    REQUIRE_NEAR(irb_progress_left_s(&p, 20), 3 * (16 - 4 - 2), 1e-9);
    irb_progress_leave_out_trials(&p, 1); /* 8 frames of each kind */
    REQUIRE_NEAR(irb_progress_left_s(&p, 20), 3 * 2, 1e-9);
    irb_progress_step(&p, 12, 30);
    REQUIRE_NEAR(irb_progress_fraction(&p), 1, 0);
}

/* Units of 2 s and of 0.5 s: 8 references, then 40 frames that are rendered: 16 s and 20 s. */
static void test_measured(void **state)
{
    (void)state;
    const struct irb_config config = config_of(8, 1, 2);
    struct irb_progress p = irb_progress_plan(&config, IRB_STAGE_PREPARE | IRB_STAGE_RENDER, false);
    double now = 100;
    irb_progress_begin(&p, IRB_PROGRESS_REFERENCE, now);
    for (int i = 0; i < 8; i++)
        irb_progress_step(&p, 1, now += 2);
    irb_progress_begin(&p, IRB_PROGRESS_RENDER, now += 50); /* nobody's time */
    for (int i = 0; i < 10; i++)
        irb_progress_step(&p, 1, now += 0.5);
    REQUIRE_NEAR(irb_progress_left_s(&p, now), 15, 1e-9);
    REQUIRE_NEAR(irb_progress_fraction(&p), 21. / 36, 1e-9);
    irb_progress_part(&p, 0.5);
    REQUIRE_NEAR(irb_progress_left_s(&p, now), 14.75, 1e-9);
    irb_progress_skip(&p, IRB_PROGRESS_RENDER, 29);
    irb_progress_step(&p, 1, now += 0.5);
    REQUIRE_NEAR(irb_progress_left_s(&p, now), 0, 0);
    REQUIRE_NEAR(irb_progress_fraction(&p), 1, 0);
}

/* References that are there are no work. */
static void test_cached(void **state)
{
    (void)state;
    const struct irb_config config = config_of(10, 1, 1);
    struct irb_progress p = irb_progress_plan(&config, IRB_STAGE_PREPARE, false);
    irb_progress_skip(&p, IRB_PROGRESS_REFERENCE, 6);
    irb_progress_begin(&p, IRB_PROGRESS_REFERENCE, 0);
    irb_progress_step(&p, 1, 3);
    REQUIRE_NEAR(irb_progress_fraction(&p), 0.25, 1e-12);
    REQUIRE_NEAR(irb_progress_left_s(&p, 3), 9, 1e-12);
}

static void test_any_order(void **state)
{
    (void)state;
    for (uint64_t run = 0; run < 200; run++) {
        uint64_t random = irb_hash_mix(run, 7);
        const struct irb_config config = config_of((int)(random % 5), (int)(random % 3), 2);
        struct irb_progress p =
            irb_progress_plan(&config, (unsigned)(random >> 8) % 8, random & 64);
        double now = 0, before = 0;
        for (int step = 0; step < 100; step++) {
            random = irb_hash_mix(random, (uint64_t)step);
            enum irb_progress_kind kind = random % IRB_PROGRESS_KINDS;
            double units = (double)(random >> 8 & 7), share = (double)(random >> 16 & 15) / 10;
            now += (double)(random >> 24 & 3); /* also none at all */
            if (random & 1)
                irb_progress_begin(&p, kind, now);
            if (random & 2)
                irb_progress_step(&p, units, now);
            if (random & 4)
                irb_progress_skip(&p, kind, units);
            if (random & 8)
                irb_progress_part(&p, share);
            double fraction = irb_progress_fraction(&p), left = irb_progress_left_s(&p, now);
            assert_true(fraction >= before && fraction <= 1);
            assert_true(left >= 0 && isfinite(left));
            before = fraction;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plan),      cmocka_unit_test(test_no_settle_frames),
        cmocka_unit_test(test_deadline),  cmocka_unit_test(test_keeping),
        cmocka_unit_test(test_measured),  cmocka_unit_test(test_cached),
        cmocka_unit_test(test_any_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
