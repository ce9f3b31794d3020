/* SPDX-License-Identifier: MIT
 *
 * The numbers behind the figures, line by line, from runs that the test writes.
 */
#include "core/report/figures.h"
#include "tests/report/trials.h"

static char folder[] = "/tmp/irb_figures_XXXXXX";

static void add(struct irb_store *store, const char *trial, const char *params, double flip,
                double ms, double bytes)
{
    int64_t id = trials_add(store, "box", "rsm", trial, params, 1);
    const struct irb_store_value values[] = {{"indirect_flip", flip},
                                             {"indirect_rmse", 2 * flip},
                                             {"indirect_flicker", 0.25},
                                             {"indirect_pop_share", 0.5},
                                             {"lag", -1},
                                             {"reference_flicker", 0.125},
                                             {"gl_bytes", bytes}};
    trials_scores(store, id, -1, values, 7);
    trials_time(store, id, 0, ms);
}

static int set_up(void **state)
{
    struct irb_store *store = trials_open(folder);
    struct irb_error err = {0};
    *state = store;
    add(store, "rsm:samples=400", "{\"mode\": \"all\", \"samples\": 400, \"clamp\": 0.5}", 0.25, 8,
        7);
    add(store, "rsm", "{\"mode\": \"all\", \"samples\": 100, \"clamp\": 0.5}", 0.5, 2, 9);
    add(store, "rsm:mode=one", "{\"mode\": \"one\", \"samples\": 100, \"clamp\": 0.5}", 0.5, 4, 5);
    add(store, "rsm:samples=900", "{\"mode\": \"all\", \"samples\": 900, \"clamp\": 0.5}", 0.375,
        16, 5);
    add(store, "rsm:samples=400:clamp=2", "{\"mode\": \"all\", \"samples\": 400, \"clamp\": 2}", 1,
        8, 8);
    /* two seeds; a stage that runs in every second frame */
    for (int seed = 0; seed < 2; seed++) {
        int64_t id = trials_add(store, "a,hall", "ism", "ism", "{}", seed);
        for (int f = 0; f < 4; f++) {
            const struct irb_store_value stages[] = {{"splat", 10 + seed}, {"points", 6}};
            REQUIRE_OK(
                irb_store_frame(store, id, f, "clock", stages, f % 2 ? 1 : 2, NULL, 0, &err));
            trials_score(store, id, f, "indirect_flip", f + seed);
        }
        trials_repeat(store, id, 1, 0, 30);
    }
    REQUIRE_OK(irb_store_set_meta(store, "method/ism/stages", "points\nsplat\ngather\n", &err));
    return 0;
}

static int tear_down(void **state)
{
    return trials_close(*state, folder);
}

static void expect(struct irb_store *store, enum irb_figure figure, const char *scene,
                   const char *expected)
{
    struct irb_error err = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    REQUIRE_OK(irb_figure_csv(out, store, figure, scene, &err));
    fclose(out);
    assert_string_equal(text, expected);
    free(text);
}

static void test_pareto(void **state)
{
    expect(*state, IRB_FIGURE_PARETO, "box",
           "scene,method,trial,frame_ms,frame_ms_low,frame_ms_high,gl_bytes,"
           "indirect_flip,indirect_flip_low,indirect_flip_high,indirect_flip_front_ms,"
           "indirect_flip_front_bytes,indirect_rmse,indirect_rmse_low,indirect_rmse_high,"
           "indirect_rmse_front_ms,indirect_rmse_front_bytes,indirect_relmse,"
           "indirect_relmse_low,indirect_relmse_high,indirect_relmse_front_ms,"
           "indirect_relmse_front_bytes,indirect_flicker,indirect_flicker_low,"
           "indirect_flicker_high,indirect_flicker_front_ms,indirect_flicker_front_bytes\n"
           "box,rsm,rsm:samples=400,8,,,7,0.25,,,1,1,0.5,,,1,1,,,,0,0,0.25,,,0,0\n"
           "box,rsm,rsm,2,,,9,0.5,,,1,0,1,,,1,0,,,,0,0,0.25,,,1,0\n"
           "box,rsm,rsm:mode=one,4,,,5,0.5,,,0,0,1,,,0,0,,,,0,0,0.25,,,0,1\n"
           "box,rsm,rsm:samples=900,16,,,5,0.375,,,0,1,0.75,,,0,1,,,,0,0,0.25,,,0,1\n"
           "box,rsm,rsm:samples=400:clamp=2,8,,,8,1,,,0,0,2,,,0,0,,,,0,0,0.25,,,0,0\n");
}

static void test_stages(void **state)
{
    /* points: 4 times 6 ms in 10 frames of both seeds; splat: 40 + 44 ms over 10 */
    expect(*state, IRB_FIGURE_STAGES, "a,hall",
           "scene,method,trial,stage,ms\n"
           "\"a,hall\",ism,ism,points,2.4\n"
           "\"a,hall\",ism,ism,splat,8.4\n"
           "\"a,hall\",ism,ism,gather,6\n");
}

static void test_timeline(void **state)
{
    expect(*state, IRB_FIGURE_TIMELINE, "a,hall",
           "scene,method,trial,frame,indirect_flip,indirect_rmse,indirect_relmse,"
           "indirect_flicker,frame_ms\n"
           "\"a,hall\",ism,ism,0,0.5,,,,23.25\n"
           "\"a,hall\",ism,ism,1,1.5,,,,10.5\n"
           "\"a,hall\",ism,ism,2,2.5,,,,16.5\n"
           "\"a,hall\",ism,ism,3,3.5,,,,10.5\n");
}

static void test_convergence(void **state)
{
    expect(*state, IRB_FIGURE_CONVERGENCE, NULL,
           "scene,method,family,parameter,x,indirect_rmse,indirect_rmse_low,"
           "indirect_rmse_high,indirect_flip,indirect_flip_low,indirect_flip_high\n"
           "box,rsm,rsm,samples,100,1,,,0.5,,\n"
           "box,rsm,rsm,samples,400,0.5,,,0.25,,\n"
           "box,rsm,rsm,samples,900,0.75,,,0.375,,\n"
           "box,rsm,rsm:samples=400,clamp,0.5,0.5,,,0.25,,\n"
           "box,rsm,rsm:samples=400,clamp,2,2,,,1,,\n");
}

static void test_flicker(void **state)
{
    expect(*state, IRB_FIGURE_FLICKER, "a,hall",
           "scene,method,trial,flicker,low,high,pop_share,temporal_flip,lag,reference_flicker\n"
           "\"a,hall\",ism,ism,,,,,,,\n");
}

static void test_refused(void **state)
{
    struct irb_error err = {0};
    enum irb_figure figure;
    REQUIRE_OK(irb_figure_parse("timeline", &figure, &err));
    assert_int_equal(figure, IRB_FIGURE_TIMELINE);
    assert_false(irb_figure_parse("pie", &figure, &err));
    assert_int_equal(err.code, IRB_E_USAGE);
    assert_string_equal(err.message, "figure: expected pareto, stages, timeline, convergence or "
                                     "flicker, found 'pie'");
    assert_false(irb_figure_csv(stdout, *state, IRB_FIGURE_PARETO, "attic", &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_string_equal(err.message, "pareto: the run has no scene 'attic'");
    char empty[] = "/tmp/irb_figures_none_XXXXXX";
    struct irb_store *none = trials_open(empty);
    assert_false(irb_figure_csv(stdout, none, IRB_FIGURE_STAGES, NULL, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_string_equal(err.message, "stages: the run has no trials yet");
    assert_int_equal(trials_close(none, empty), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pareto),   cmocka_unit_test(test_stages),
        cmocka_unit_test(test_timeline), cmocka_unit_test(test_convergence),
        cmocka_unit_test(test_flicker),  cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
