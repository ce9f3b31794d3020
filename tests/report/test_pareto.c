/* SPDX-License-Identifier: MIT
 *
 * Fronts and questions by brute force over points that the test draws; and runs that cannot answer.
 */
#include "core/report/pareto.h"
#include "tests/report/trials.h"

#define M(name) IRB_METRIC_##name

enum { POINTS = 40, SETS = 200 };
static char folder[] = "/tmp/irb_pareto_XXXXXX";

static unsigned draw(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 16;
}

/* From few values, so that points are often equal in one or both; some have none. */
static double coordinate(unsigned *state)
{
    unsigned r = draw(state) % 13;
    return r == 12 ? NAN : 1 + r;
}

/* By sorting instead of by comparing all pairs: the front is what is as good as the best so far
 * when points come in order of cost. */
static bool on_front(const double *error, const double *cost, int count, int i)
{
    double best_before = INFINITY, best_level = INFINITY;
    if (isnan(error[i]) || isnan(cost[i]))
        return false;
    for (int j = 0; j < count; j++) {
        if (isnan(error[j]) || isnan(cost[j]))
            continue;
        if (cost[j] < cost[i])
            best_before = fmin(best_before, error[j]);
        if (cost[j] == cost[i])
            best_level = fmin(best_level, error[j]);
    }
    return error[i] == best_level && error[i] < best_before;
}

static void test_fronts(void **state)
{
    (void)state;
    unsigned dice = 1;
    for (int set = 0; set < SETS; set++) {
        double error[POINTS], cost[POINTS];
        bool front[POINTS];
        int count = 1 + (int)(draw(&dice) % POINTS);
        for (int i = 0; i < count; i++) {
            error[i] = coordinate(&dice);
            cost[i] = coordinate(&dice);
        }
        irb_pareto_front(error, cost, count, front);
        for (int i = 0; i < count; i++)
            assert_int_equal(front[i], on_front(error, cost, count, i));
    }
}

/* Scene "many": POINTS trials of three methods with 3 seeds, values that the test draws. Scene
 * "line": methods a and b with times 10, 100 and 20, 200 and errors 0.4, 0.1 and 0.9, 0.3;
 * b's error at 20 ms jitters as much as a's does not. Scene "apart": a to 10 ms, b from 20 ms. */
static double many_error[POINTS], many_time[POINTS];

static void add_point(struct irb_store *store, const char *scene, const char *method,
                      const char *trial, double error, double jitter, double ms)
{
    for (int seed = 0; seed < 3; seed++) {
        int64_t id = trials_add(store, scene, method, trial, "{}", seed);
        trials_score(store, id, -1, "indirect_flip", error * (1 + jitter * (seed - 1)));
        trials_time(store, id, 0, ms);
    }
}

/* Scene "noise": FLIP, relMSE and time of five trials, of which three are not above the reference's
 * noise of 0.1 (relMSE). */
static const struct {
    const char *name;
    double flip, relmse, ms;
} noisy[] = {{"below", 0.3, 0.05, 20},
             {"cheap", 0.4, 0.09, 10},
             {"above", 0.9, 0.2, 5},
             {"exact", 0.25, 0.02, 40},
             {"odd", 0.35, 0.3, 4}};

static void fill_noise(struct irb_store *store)
{
    for (size_t t = 0; t < sizeof noisy / sizeof *noisy; t++)
        for (int seed = 0; seed < 3; seed++) {
            int64_t id = trials_add(store, "noise", "m", noisy[t].name, "{}", seed);
            double jitter = 1 + 0.01 * (seed - 1);
            const struct irb_store_value values[] = {{"indirect_flip", noisy[t].flip * jitter},
                                                     {"indirect_relmse", noisy[t].relmse * jitter},
                                                     {"reference_noise", 0.1}};
            trials_scores(store, id, -1, values, 3);
            trials_time(store, id, 0, noisy[t].ms * (1 + 0.001 * seed));
        }
}

static struct irb_analysis analysis;

static int set_up(void **state)
{
    static const char *const methods[] = {"a", "b", "c"};
    struct irb_error err = {0};
    struct irb_store *store = trials_open(folder);
    unsigned dice = 7;
    *state = store;
    for (int i = 0; i < POINTS; i++) {
        char name[16];
        snprintf(name, sizeof name, "t%d", i);
        many_error[i] = 1 + draw(&dice) % 50;
        many_time[i] = 1 + draw(&dice) % 50;
        add_point(store, "many", methods[i % 3], name, many_error[i], 0, many_time[i]);
    }
    add_point(store, "line", "a", "a:1", 0.4, 0, 10);
    add_point(store, "line", "a", "a:2", 0.1, 0, 100);
    add_point(store, "line", "b", "b:1", 0.42, 0.2, 20);
    add_point(store, "line", "b", "b:2", 0.3, 0, 200);
    add_point(store, "line", "b", "b:slow", 0.5, 0, 150); /* dominated */
    add_point(store, "apart", "a", "a", 1, 0, 10);
    add_point(store, "apart", "b", "b", 1, 0, 20);
    add_point(store, "apart", "b", "b:slow", 0.5, 0, 80);
    trials_add(store, "bare", "a", "a", "{}", 1);
    fill_noise(store);
    return irb_analysis_read(&analysis, store, 0.95, &err) ? 0 : -1;
}

static int tear_down(void **state)
{
    irb_analysis_destroy(&analysis);
    return trials_close(*state, folder);
}

static struct irb_question least_error(const char *scene, double within, const char *method)
{
    return (struct irb_question){irb_analysis_scene_find(&analysis, scene), M(indirect_flip),
                                 M(frame_ms), within, method};
}

static struct irb_question least_time(const char *scene, double error, const char *method)
{
    return (struct irb_question){irb_analysis_scene_find(&analysis, scene), M(frame_ms),
                                 M(indirect_flip), error, method};
}

/* Each question for every bound that can matter, and between them. */
static void test_questions(void **state)
{
    (void)state;
    for (double bound = 0.5; bound < 52; bound += 0.5)
        for (int by_time = 0; by_time < 2; by_time++) {
            const double *wanted = by_time ? many_error : many_time;
            const double *bounded = by_time ? many_time : many_error;
            struct irb_question q =
                by_time ? least_error("many", bound, NULL) : least_time("many", bound, NULL);
            struct irb_answer answer = irb_ask(&analysis, &q);
            double least = INFINITY;
            for (int i = 0; i < POINTS; i++)
                if (bounded[i] <= bound)
                    least = fmin(least, wanted[i]);
            assert_int_equal(answer.trial < 0, least == INFINITY);
            for (int i = 0; answer.trial >= 0 && i < POINTS; i++) {
                /* without spread nothing but equal values is indistinguishable */
                bool equal = i != answer.trial && bounded[i] <= bound && wanted[i] == least;
                assert_int_equal(answer.as_good[i], equal);
            }
            if (answer.trial >= 0) {
                REQUIRE_NEAR(wanted[answer.trial], least, 0);
                REQUIRE_CMP(bounded[answer.trial], <=, bound);
            }
            irb_answer_free(&answer);
        }
}

static int trial(const char *scene, const char *name)
{
    return irb_analysis_trial_find(&analysis.scenes[irb_analysis_scene_find(&analysis, scene)],
                                   name);
}

static void test_ties_and_misses(void **state)
{
    (void)state;
    struct irb_question q = least_error("line", 50, NULL);
    struct irb_answer answer = irb_ask(&analysis, &q);
    assert_int_equal(answer.trial, trial("line", "a:1"));
    assert_true(answer.as_good[trial("line", "b:1")]);
    assert_false(answer.as_good[trial("line", "a:2")]); /* beyond the time */
    irb_answer_free(&answer);
    q = least_error("line", 9, NULL);
    answer = irb_ask(&analysis, &q);
    assert_int_equal(answer.trial, -1);
    assert_int_equal(answer.nearest, trial("line", "a:1"));
    irb_answer_free(&answer);
    q = least_time("line", 0.2, "b");
    answer = irb_ask(&analysis, &q);
    assert_int_equal(answer.trial, -1);
    assert_int_equal(answer.nearest, trial("line", "b:2"));
    irb_answer_free(&answer);
    q = least_error("bare", 10, NULL);
    answer = irb_ask(&analysis, &q);
    assert_int_equal(answer.trial, -1);
    assert_int_equal(answer.nearest, -1);
    irb_answer_free(&answer);
}

static void test_brackets(void **state)
{
    (void)state;
    struct irb_question q = least_error("line", sqrt(10 * 100), "a");
    struct irb_bracket bracket = irb_bracket(&analysis, &q);
    assert_int_equal(bracket.below, trial("line", "a:1"));
    assert_int_equal(bracket.above, trial("line", "a:2"));
    REQUIRE_REL(bracket.between, sqrt(0.4 * 0.1), 1e-12);
    /* the dominated point is no bracket */
    q = least_error("line", 160, "b");
    bracket = irb_bracket(&analysis, &q);
    assert_int_equal(bracket.below, trial("line", "b:1"));
    assert_int_equal(bracket.above, trial("line", "b:2"));
    q = least_error("line", 1000, "b");
    bracket = irb_bracket(&analysis, &q);
    assert_int_equal(bracket.below, trial("line", "b:2"));
    assert_int_equal(bracket.above, -1);
    assert_true(isnan(bracket.between));
    q = least_time("line", 0.2, "a");
    bracket = irb_bracket(&analysis, &q);
    REQUIRE_REL(bracket.between, 10 * pow(10, log(0.4 / 0.2) / log(0.4 / 0.1)), 1e-12);
}

static void test_budgets(void **state)
{
    (void)state;
    double budgets[IRB_MOST_BUDGETS];
    const struct irb_analysis_scene *scene =
        &analysis.scenes[irb_analysis_scene_find(&analysis, "line")];
    /* a covers 10 to 100 ms, b 20 to 200 */
    assert_int_equal(irb_common_budgets(scene, M(indirect_flip), M(frame_ms), budgets), 3);
    REQUIRE_NEAR(budgets[0], 20, 0);
    REQUIRE_REL(budgets[1], sqrt(20 * 100), 1e-12);
    REQUIRE_NEAR(budgets[2], 100, 0);
    scene = &analysis.scenes[irb_analysis_scene_find(&analysis, "apart")];
    assert_int_equal(irb_common_budgets(scene, M(indirect_flip), M(frame_ms), budgets), 3);
    REQUIRE_NEAR(budgets[0], 20, 0);
    REQUIRE_NEAR(budgets[2], 80, 0);
    assert_int_equal(irb_common_budgets(scene, M(frame_ms), M(indirect_flip), budgets), 1);
    REQUIRE_NEAR(budgets[0], 1, 0);
    scene = &analysis.scenes[irb_analysis_scene_find(&analysis, "bare")];
    assert_int_equal(irb_common_budgets(scene, M(indirect_flip), M(frame_ms), budgets), 0);
}

static void expect_front(int error, bool below, bool cheap, bool above, bool exact, bool odd)
{
    bool front[5];
    irb_scene_front(&analysis.scenes[irb_analysis_scene_find(&analysis, "noise")], NULL, error,
                    M(frame_ms), front);
    const bool expected[] = {below, cheap, above, exact, odd};
    for (int i = 0; i < 5; i++)
        assert_int_equal(front[i], expected[i]);
}

/* Below the noise there is no less: the cheapest is as good as any. */
static void test_noise(void **state)
{
    (void)state;
    expect_front(M(indirect_relmse), false, true, true, false, true);
    /* the noise makes a FLIP of up to 0.4 */
    expect_front(M(indirect_flip), false, false, false, false, true);
    struct irb_question q = {irb_analysis_scene_find(&analysis, "noise"), M(indirect_relmse),
                             M(frame_ms), 50, NULL};
    struct irb_answer answer = irb_ask(&analysis, &q);
    assert_int_equal(answer.trial, trial("noise", "cheap"));
    assert_true(answer.as_good[trial("noise", "below")]);
    assert_true(answer.as_good[trial("noise", "exact")]);
    assert_false(answer.as_good[trial("noise", "above")]);
    assert_false(answer.untold[trial("noise", "above")]);
    irb_answer_free(&answer);
    /* what was measured meets a bound */
    q = (struct irb_question){q.scene, M(frame_ms), M(indirect_relmse), 0.06, NULL};
    answer = irb_ask(&analysis, &q);
    assert_int_equal(answer.trial, trial("noise", "below"));
    irb_answer_free(&answer);
    /* and no budget asks for less than the noise */
    double budgets[IRB_MOST_BUDGETS];
    irb_common_budgets(&analysis.scenes[q.scene], M(frame_ms), M(indirect_relmse), budgets);
    REQUIRE_NEAR(budgets[0], 0.1, 0);
}

/* Values without an interval, of which one is the least. */
static void test_untold(void **state)
{
    (void)state;
    struct irb_question q = least_error("apart", 100, NULL);
    struct irb_answer answer = irb_ask(&analysis, &q);
    assert_int_equal(answer.trial, trial("apart", "b:slow"));
    assert_true(answer.untold[trial("apart", "a")] && answer.untold[trial("apart", "b")]);
    assert_false(answer.untold[answer.trial] || answer.as_good[trial("apart", "a")]);
    irb_answer_free(&answer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fronts),   cmocka_unit_test(test_questions),
        cmocka_unit_test(test_brackets), cmocka_unit_test(test_ties_and_misses),
        cmocka_unit_test(test_budgets),  cmocka_unit_test(test_noise),
        cmocka_unit_test(test_untold),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
