/* SPDX-License-Identifier: MIT
 *
 * What the units of a trial are, and which intervals they give: against core/stats called on the
 * numbers that were stored.
 */
#include "core/report/analysis.h"
#include "core/stats/blocks.h"
#include "tests/report/trials.h"

#define M(name) IRB_METRIC_##name

static char folder[] = "/tmp/irb_analysis_XXXXXX";
static const double of_a[] = {1, 2, 3, 6}, of_b[] = {2, 3, 5, 9};
enum { SEEDS = 4, FRAMES = 97, BIAS_FRAMES = 96 };

/* Scene "seeds": a and b with four seeds, b's stored backwards and one more; c with noise; d, whose
 * values are b's times 1.01 and 0.99 in turn; z, which has no pops; two, with two seeds. */
static void fill_seeds(struct irb_store *store)
{
    for (int i = 0; i < SEEDS; i++) {
        int64_t a = trials_add(store, "seeds", "m", "a", "{}", i);
        int64_t c = trials_add(store, "seeds", "m", "c", "{}", i);
        int64_t d = trials_add(store, "seeds", "m", "d", "{}", i);
        int64_t z = trials_add(store, "seeds", "m", "z", "{}", i);
        int64_t b = trials_add(store, "seeds", "n", "b", "{}", SEEDS - 1 - i);
        const struct irb_store_value a_values[] = {{"indirect_relmse", of_a[i]},
                                                   {"indirect_energy_ratio", 0.9 + 0.01 * i},
                                                   {"indirect_pop_share", 0.1 + 0.01 * i}};
        const struct irb_store_value c_values[] = {
            {"indirect_relmse", of_a[i]},      {"indirect_rmse", 2 + of_a[i]},
            {"reference_noise", 1.5},          {"reference_noise_rmse", 0.5},
            {"indirect_flicker", 2 + of_a[i]}, {"reference_flicker", 1.5},
            {"indirect_flip", of_a[i]},        {"indirect_flip_noise", 0.25}};
        const struct irb_store_value b_values[] = {{"indirect_relmse", of_b[SEEDS - 1 - i]},
                                                   {"indirect_energy_ratio", 1.1 - 0.02 * i}};
        trials_scores(store, a, -1, a_values, 3);
        trials_scores(store, c, -1, c_values, 8);
        trials_scores(store, b, -1, b_values, 2);
        trials_score(store, d, -1, "indirect_relmse", of_b[i] * (i % 2 ? 0.99 : 1.01));
        trials_score(store, z, -1, "indirect_pop_share", 0);
    }
    int64_t more = trials_add(store, "seeds", "n", "b", "{}", 99);
    trials_score(store, more, -1, "indirect_relmse", 1000);
    for (int i = 0; i < 2; i++)
        trials_score(store, trials_add(store, "seeds", "m", "two", "{}", i), -1, "indirect_relmse",
                     of_a[i]);
}

static double rmse_at(int frame, double scale)
{
    return scale * (2 + sin(0.7 * frame) + 0.01 * frame);
}

/* Root of the mean of the squares, as scoring makes it. */
static double rmse_of(double scale)
{
    double squares = 0;
    for (int f = 0; f < FRAMES; f++)
        squares += rmse_at(f, scale) * rmse_at(f, scale);
    return sqrt(squares / FRAMES);
}

/* Scene "frames": a and b with one seed and many frames; short with too few. */
static void fill_frames(struct irb_store *store)
{
    int64_t a = trials_add(store, "frames", "m", "a", "{}", 1);
    int64_t b = trials_add(store, "frames", "m", "b", "{}", 1);
    int64_t few = trials_add(store, "frames", "m", "short", "{}", 1);
    for (int f = 0; f < FRAMES; f++) {
        const struct irb_store_value values[] = {{"indirect_rmse", rmse_at(f, 1)},
                                                 {"indirect_bias", 0.1 + 0.01 * cos(f)},
                                                 {"indirect_flip", 0.5 + 0.1 * sin(f)}};
        trials_scores(store, a, f, values, f < BIAS_FRAMES ? 3 : 1);
        trials_score(store, b, f, "indirect_rmse", rmse_at(f, 2) * (1 + 0.1 * cos(3 * f)));
        trials_time(store, a, f, 10 + f % 3 + (f == 5 ? 100 : 0));
        if (f < 8)
            trials_score(store, few, f, "indirect_rmse", 1);
    }
    const struct irb_store_value a_values[] = {{"indirect_rmse", rmse_of(1)},
                                               {"indirect_bias", 0.1},
                                               {"indirect_energy_ratio", 1.25},
                                               {"indirect_flip", 0.5}};
    trials_scores(store, a, -1, a_values, 4);
    trials_score(store, b, -1, "indirect_rmse", rmse_of(2));
    trials_score(store, few, -1, "indirect_rmse", 1);
}

/* Scene "repeats": frames of 1 seed in 4 whole repeats and one that was cut off. */
static const double rounds[2][4][3] = {{{1, 2, 9}, {2, 3, 3}, {4, 4, 4}, {3, 5, 8}},
                                       {{2, 3, 4}, {5, 5, 6}, {7, 7, 9}, {6, 8, 9}}};

static void fill_repeats(struct irb_store *store)
{
    static const char *const names[] = {"a", "b"};
    for (int t = 0; t < 2; t++) {
        int64_t id = trials_add(store, "repeats", "m", names[t], "{}", 1);
        for (int r = 0; r < 4; r++)
            for (int f = 0; f < 3; f++) {
                if (r)
                    trials_repeat(store, id, r, f, rounds[t][r][f]);
                else
                    trials_time(store, id, f, rounds[t][r][f]);
            }
        trials_repeat(store, id, 4, 0, 1000);
    }
}

/* Scene "partial": a run that goes on, whose second seed has one frame of three so far. */
static void fill_partial(struct irb_store *store)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_store_set_meta(store, "scene/partial/keys", "a a\nb b\nc c\n", &err));
    int64_t whole = trials_add(store, "partial", "m", "a", "{}", 1);
    int64_t partial = trials_add(store, "partial", "m", "a", "{}", 2);
    trials_score(store, whole, 0, "indirect_flip", 1);
    trials_score(store, whole, -1, "indirect_flip", 2);
    trials_score(store, partial, 0, "indirect_flip", 100);
}

/* Scene "drawless": e and f have the same in each seed, g too, but no frames. Over a frame's RMSE f
 * is 1 +- 0.1, and a millionth more over the sequence. */
static double frame_of_f(int frame)
{
    return rmse_at(frame, 1) * (1 + 0.1 * cos(3 * frame));
}

static void fill_drawless(struct irb_store *store)
{
    for (int seed = 0; seed < SEEDS; seed++) {
        int64_t e = trials_add(store, "drawless", "m", "e", "{}", seed);
        int64_t f = trials_add(store, "drawless", "m", "f", "{}", seed);
        int64_t g = trials_add(store, "drawless", "m", "g", "{}", seed);
        for (int frame = 0; frame < FRAMES; frame++) {
            trials_score(store, e, frame, "indirect_rmse", rmse_at(frame, 1));
            trials_score(store, f, frame, "indirect_rmse", frame_of_f(frame));
        }
        const struct irb_store_value values[] = {{"indirect_rmse", rmse_of(1)}, {"gl_bytes", 3}};
        trials_scores(store, e, -1, values, 2);
        trials_score(store, f, -1, "indirect_rmse", rmse_of(1.000001));
        const struct irb_store_value twice[] = {{"indirect_rmse", rmse_of(2)}, {"gl_bytes", 6}};
        trials_scores(store, g, -1, twice, 2);
    }
}

/* Scene "energy", by seed: p is right in the mean and far off in each; q and s are off by as much
 * on either side; r is off by a fifth of that. */
static const double energies[][SEEDS] = {{0.9, 1.1, 0.88, 1.13},
                                         {1.05, 1.055, 1.05, 1.046},
                                         {0.99, 0.991, 0.988, 0.99},
                                         {0.95, 0.946, 0.949, 0.954}};

static void fill_energy(struct irb_store *store)
{
    static const char *const names[] = {"p", "q", "r", "s"};
    for (int t = 0; t < 4; t++)
        for (int seed = 0; seed < SEEDS; seed++)
            trials_score(store, trials_add(store, "energy", "m", names[t], "{}", seed), -1,
                         "indirect_energy_ratio", energies[t][seed]);
}

static struct irb_analysis analysis;

static int set_up(void **state)
{
    struct irb_error err = {0};
    struct irb_store *store = trials_open(folder);
    *state = store;
    fill_seeds(store);
    fill_frames(store);
    fill_repeats(store);
    fill_partial(store);
    fill_drawless(store);
    fill_energy(store);
    return irb_analysis_read(&analysis, store, 0.95, &err) ? 0 : -1;
}

static int tear_down(void **state)
{
    irb_analysis_destroy(&analysis);
    return trials_close(*state, folder);
}

static int scene_named(const char *name)
{
    int scene = irb_analysis_scene_find(&analysis, name);
    assert_true(scene >= 0);
    return scene;
}

static int trial_named(const char *scene, const char *name)
{
    int trial = irb_analysis_trial_find(&analysis.scenes[scene_named(scene)], name);
    assert_true(trial >= 0);
    return trial;
}

static struct irb_measure measure(const char *scene, const char *trial, int metric)
{
    return analysis.scenes[scene_named(scene)].trials[trial_named(scene, trial)].measures[metric];
}

static struct irb_measure ratio(const char *scene, const char *a, const char *b, int metric)
{
    return irb_analysis_ratio(&analysis, scene_named(scene), trial_named(scene, a),
                              trial_named(scene, b), metric);
}

static enum irb_verdict compare(const char *scene, const char *a, const char *b, int metric)
{
    return irb_analysis_compare(&analysis, scene_named(scene), trial_named(scene, a),
                                trial_named(scene, b), metric);
}

static void expect_interval(struct irb_measure m, enum irb_unit unit, int units, double value,
                            double low, double high)
{
    assert_int_equal(m.unit, unit);
    assert_int_equal(m.interval.units, units);
    REQUIRE_REL(m.interval.value, value, 1e-12);
    REQUIRE_REL(m.interval.low, low, 1e-12);
    REQUIRE_REL(m.interval.high, high, 1e-12);
}

static void test_seeds(void **state)
{
    (void)state;
    struct irb_interval mean = irb_mean_interval(of_a, SEEDS, 0.95);
    expect_interval(measure("seeds", "a", M(indirect_relmse)), IRB_UNIT_SEED, SEEDS, 3, mean.low,
                    mean.high);
    /* seed 99 has no partner */
    struct irb_interval pairs = irb_ratio_interval(of_a, of_b, SEEDS, 0.95);
    expect_interval(ratio("seeds", "a", "b", M(indirect_relmse)), IRB_UNIT_SEED, SEEDS, 12. / 19,
                    pairs.low, pairs.high);
    assert_int_equal(measure("seeds", "b", M(indirect_relmse)).interval.units, SEEDS + 1);
    assert_int_equal(compare("seeds", "a", "b", M(indirect_relmse)), IRB_VERDICT_BETTER);
    assert_int_equal(compare("seeds", "b", "a", M(indirect_relmse)), IRB_VERDICT_WORSE);
    assert_int_equal(compare("seeds", "b", "d", M(indirect_relmse)), IRB_VERDICT_SAME);
    assert_int_equal(compare("seeds", "a", "a", M(indirect_relmse)), IRB_VERDICT_SAME);
    /* two seeds, no frames: a value, no interval */
    struct irb_measure two = measure("seeds", "two", M(indirect_relmse));
    assert_int_equal(two.unit, IRB_UNIT_NONE);
    REQUIRE_NEAR(two.interval.value, 1.5, 0);
    assert_true(isnan(two.interval.low) && isnan(two.interval.high));
    assert_int_equal(compare("seeds", "two", "a", M(indirect_relmse)), IRB_VERDICT_UNKNOWN);
    REQUIRE_REL(ratio("seeds", "two", "b", M(indirect_relmse)).interval.value, 1.5 / 2.5, 1e-12);
}

/* Where the best is not 0, or a value is, differences of the distances from the best decide. */
static void test_differences(void **state)
{
    (void)state;
    assert_int_equal(compare("seeds", "z", "a", M(indirect_pop_share)), IRB_VERDICT_BETTER);
    assert_int_equal(compare("seeds", "a", "z", M(indirect_pop_share)), IRB_VERDICT_WORSE);
    assert_true(isnan(ratio("seeds", "z", "a", M(indirect_pop_share)).interval.value));
    /* 1 - a = .1 .09 .08 .07, b - 1 = .04 .06 .08 .1 by seed: which mean is farther off? */
    double difference[SEEDS];
    for (int i = 0; i < SEEDS; i++)
        difference[i] = (0.1 - 0.01 * i) - (0.1 - 0.02 * (SEEDS - 1 - i));
    struct irb_interval expected = irb_mean_interval(difference, SEEDS, 0.95);
    assert_true(irb_interval_contains(&expected, 0));
    assert_int_equal(compare("seeds", "a", "b", M(indirect_energy_ratio)), IRB_VERDICT_SAME);
}

/* Ranked are means: what is as far off in each seed as p is not worse for it. */
static void test_energy(void **state)
{
    (void)state;
    REQUIRE_CMP(fabs(measure("energy", "p", M(indirect_energy_ratio)).interval.value - 1), <, 0.01);
    assert_int_equal(compare("energy", "p", "q", M(indirect_energy_ratio)), IRB_VERDICT_SAME);
    assert_int_equal(compare("energy", "q", "p", M(indirect_energy_ratio)), IRB_VERDICT_SAME);
    assert_int_equal(compare("energy", "q", "s", M(indirect_energy_ratio)), IRB_VERDICT_SAME);
    assert_int_equal(compare("energy", "r", "q", M(indirect_energy_ratio)), IRB_VERDICT_BETTER);
    assert_int_equal(compare("energy", "q", "r", M(indirect_energy_ratio)), IRB_VERDICT_WORSE);
    assert_int_equal(compare("energy", "r", "s", M(indirect_energy_ratio)), IRB_VERDICT_BETTER);
    assert_int_equal(compare("energy", "s", "r", M(indirect_energy_ratio)), IRB_VERDICT_WORSE);
}

/* Seeds that change nothing are no units, and no certainty. */
static void test_equal_seeds(void **state)
{
    (void)state;
    double e[FRAMES], f[FRAMES], blocks_e[IRB_BLOCKS_MOST], blocks_f[IRB_BLOCKS_MOST];
    for (int frame = 0; frame < FRAMES; frame++) {
        e[frame] = pow(rmse_at(frame, 1), 2);
        f[frame] = pow(frame_of_f(frame), 2);
    }
    int count = irb_blocks(e, FRAMES, blocks_e);
    struct irb_interval mean = irb_mean_interval(blocks_e, count, 0.95);
    struct irb_measure found = measure("drawless", "e", M(indirect_rmse));
    assert_int_equal(found.unit, IRB_UNIT_BLOCK);
    REQUIRE_REL(found.interval.low / found.interval.value, sqrt(mean.low / mean.value), 1e-9);
    count = irb_blocks_pair(e, f, FRAMES, blocks_e, blocks_f);
    struct irb_interval pairs = irb_ratio_interval(blocks_e, blocks_f, count, 0.95);
    found = ratio("drawless", "e", "f", M(indirect_rmse));
    assert_int_equal(found.unit, IRB_UNIT_BLOCK);
    REQUIRE_REL(found.interval.value, 1 / 1.000001, 1e-12);
    REQUIRE_REL(found.interval.high / found.interval.value, sqrt(pairs.high / pairs.value), 1e-9);
    assert_int_equal(compare("drawless", "e", "f", M(indirect_rmse)), IRB_VERDICT_SAME);
    /* no frames: nothing says how much they vary */
    assert_int_equal(measure("drawless", "g", M(indirect_rmse)).unit, IRB_UNIT_NONE);
    found = ratio("drawless", "g", "e", M(indirect_rmse));
    assert_int_equal(found.unit, IRB_UNIT_NONE);
    REQUIRE_REL(found.interval.value, 2, 1e-12);
    assert_int_equal(compare("drawless", "g", "e", M(indirect_rmse)), IRB_VERDICT_UNKNOWN);
    /* memory is what it is */
    expect_interval(ratio("drawless", "g", "e", M(gl_bytes)), IRB_UNIT_SEED, SEEDS, 2, 2, 2);
    assert_int_equal(compare("drawless", "g", "e", M(gl_bytes)), IRB_VERDICT_WORSE);
}

static void test_noise(void **state)
{
    (void)state;
    double of_c[SEEDS];
    struct irb_interval mean = irb_mean_interval(of_a, SEEDS, 0.95);
    struct irb_interval rel = measure("seeds", "c", M(indirect_relmse)).interval;
    REQUIRE_NEAR(rel.value, 3, 0);
    REQUIRE_NEAR(rel.low, fmax(0, mean.low - 1.5), 1e-12);
    REQUIRE_REL(rel.high, mean.high, 1e-12);
    /* its square is less the noise's own, whatever relMSE's share is: half of it here */
    for (int i = 0; i < SEEDS; i++)
        of_c[i] = 2 + of_a[i];
    mean = irb_mean_interval(of_c, SEEDS, 0.95);
    REQUIRE_CMP(mean.low, >, 0.5);
    REQUIRE_NEAR(measure("seeds", "c", M(indirect_rmse)).interval.low,
                 sqrt(mean.low * mean.low - 0.5 * 0.5), 1e-12);
    /* what flicker's noise stays below is taken off nothing */
    REQUIRE_NEAR(measure("seeds", "c", M(indirect_flicker)).interval.low, mean.low, 1e-12);
    mean = irb_mean_interval(of_a, SEEDS, 0.95);
    REQUIRE_NEAR(measure("seeds", "c", M(indirect_flip)).interval.low, fmax(0, mean.low - 0.25),
                 1e-12);
    const struct irb_analysis_scene *scene = &analysis.scenes[scene_named("seeds")];
    assert_false(scene->trials[trial_named("seeds", "c")].at_noise[M(indirect_relmse)]);
    /* as measured: the same noise is in both */
    struct irb_interval same = ratio("seeds", "c", "a", M(indirect_relmse)).interval;
    REQUIRE_NEAR(same.value, 1, 0);
    REQUIRE_NEAR(same.high, 1, 0);
}

static void test_blocks(void **state)
{
    (void)state;
    double a[FRAMES], b[FRAMES], blocks_a[IRB_BLOCKS_MOST], blocks_b[IRB_BLOCKS_MOST];
    for (int f = 0; f < FRAMES; f++) {
        a[f] = pow(rmse_at(f, 1), 2);
        b[f] = pow(rmse_at(f, 2) * (1 + 0.1 * cos(3 * f)), 2);
    }
    int count = irb_blocks(a, FRAMES, blocks_a);
    assert_true(count >= 3);
    /* of the mean square; its root at the value of the table */
    struct irb_interval mean = irb_mean_interval(blocks_a, count, 0.95);
    double move = rmse_of(1) / sqrt(mean.value);
    expect_interval(measure("frames", "a", M(indirect_rmse)), IRB_UNIT_BLOCK, count, rmse_of(1),
                    move * sqrt(mean.low), move * sqrt(mean.high));
    count = irb_blocks_pair(a, b, FRAMES, blocks_a, blocks_b);
    assert_true(count >= 3);
    struct irb_interval pairs = irb_ratio_interval(blocks_a, blocks_b, count, 0.95);
    move = 0.5 / sqrt(pairs.value);
    expect_interval(ratio("frames", "a", "b", M(indirect_rmse)), IRB_UNIT_BLOCK, count, 0.5,
                    move * sqrt(pairs.low), move * sqrt(pairs.high));
    assert_int_equal(compare("frames", "a", "b", M(indirect_rmse)), IRB_VERDICT_BETTER);
    assert_int_equal(measure("frames", "short", M(indirect_rmse)).unit, IRB_UNIT_NONE);
    assert_int_equal(compare("frames", "short", "a", M(indirect_rmse)), IRB_VERDICT_UNKNOWN);
}

/* 1 + bias / mean reference; the mean is 0.4 by the sequence's 0.25 = 0.1 / 0.4. */
static void test_blocks_of_energy(void **state)
{
    (void)state;
    double ratios[BIAS_FRAMES], blocks[IRB_BLOCKS_MOST];
    for (int f = 0; f < BIAS_FRAMES; f++)
        ratios[f] = 1 + (0.1 + 0.01 * cos(f)) / 0.4;
    int count = irb_blocks(ratios, BIAS_FRAMES, blocks);
    struct irb_interval mean = irb_mean_interval(blocks, count, 0.95);
    struct irb_interval found = measure("frames", "a", M(indirect_energy_ratio)).interval;
    REQUIRE_REL(found.value, 1.25, 1e-12);
    REQUIRE_REL(found.low / found.value, mean.low / mean.value, 1e-9);
    REQUIRE_REL(found.high / found.value, mean.high / mean.value, 1e-9);
}

/* The median stays the value, though the mean of the blocks is larger by the frame of 110 ms. */
static void test_blocks_of_time(void **state)
{
    (void)state;
    struct irb_measure time = measure("frames", "a", M(frame_ms));
    assert_int_equal(time.unit, IRB_UNIT_BLOCK);
    REQUIRE_NEAR(time.interval.value, 11, 0);
    REQUIRE_CMP(time.interval.low, <, 11);
    REQUIRE_CMP(time.interval.high, >, 11);
}

static double middle(const double v[3])
{
    return fmax(fmin(v[0], v[1]), fmin(fmax(v[0], v[1]), v[2]));
}

static void test_repeats(void **state)
{
    (void)state;
    double a[4], b[4];
    for (int r = 0; r < 4; r++) {
        a[r] = middle(rounds[0][r]);
        b[r] = middle(rounds[1][r]);
    }
    struct irb_measure time = measure("repeats", "a", M(frame_ms));
    struct irb_interval mean = irb_mean_interval(a, 4, 0.95);
    double value = time.interval.value; /* the median of all */
    REQUIRE_NEAR(value, 4, 0);
    expect_interval(time, IRB_UNIT_REPEAT, 4, 4, mean.low * value / mean.value,
                    mean.high * value / mean.value);
    struct irb_measure pairs = ratio("repeats", "a", "b", M(frame_ms));
    struct irb_interval expected = irb_ratio_interval(a, b, 4, 0.95);
    assert_int_equal(pairs.unit, IRB_UNIT_REPEAT);
    REQUIRE_REL(pairs.interval.low / pairs.interval.value, expected.low / expected.value, 1e-12);
    REQUIRE_REL(pairs.interval.high / pairs.interval.value, expected.high / expected.value, 1e-12);
    assert_int_equal(measure("repeats", "a", M(frame_ms_worst)).unit, IRB_UNIT_NONE);
}

static void test_partial(void **state)
{
    (void)state;
    const struct irb_analysis_scene *scene = &analysis.scenes[scene_named("partial")];
    assert_int_equal(scene->trial_count, 1);
    assert_int_equal(scene->trials[0].seed_count, 1);
    assert_int_equal(scene->trials[0].seeds[0].seed, 1);
    REQUIRE_NEAR(measure("partial", "a", M(indirect_flip)).interval.value, 2, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_differences),
        cmocka_unit_test(test_energy),
        cmocka_unit_test(test_equal_seeds),
        cmocka_unit_test(test_noise),
        cmocka_unit_test(test_blocks),
        cmocka_unit_test(test_blocks_of_energy),
        cmocka_unit_test(test_blocks_of_time),
        cmocka_unit_test(test_repeats),
        cmocka_unit_test(test_partial),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
