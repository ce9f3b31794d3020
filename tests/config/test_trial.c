/* SPDX-License-Identifier: MIT */
#include "core/config/config.h"
#include "tests/support/compare.h"

#include "tests/config/mock_methods.h"

#include <stdlib.h>
#include <string.h>

static void expect_name(const char *text, const char *name)
{
    struct irb_trial trial;
    struct irb_error err = {0};
    REQUIRE_OK(irb_trial_parse(&trial, text, &mock_registry, &err));
    assert_string_equal(trial.name, name);
    /* what is printed means the same trial */
    struct irb_trial again;
    REQUIRE_OK(irb_trial_parse(&again, trial.name, &mock_registry, &err));
    assert_string_equal(again.name, name);
    for (int frame = -1; frame < 12; frame++) {
        struct mock_params a, b;
        irb_trial_params(&trial, frame, &a);
        irb_trial_params(&again, frame, &b);
        assert_memory_equal(&a, &b, trial.method->params_size);
    }
    assert_memory_equal(again.params, trial.params, trial.method->params_size);
    irb_trial_destroy(&again);
    irb_trial_destroy(&trial);
}

static void test_names(void **state)
{
    (void)state;
    expect_name("rsm", "rsm");
    expect_name("rsm:samples=400:mode=uniform:clamp=0.1:shared=true", "rsm");
    expect_name("rsm:mode=all", "rsm:mode=all");
    expect_name("rsm:clamp=0.30:samples=9:mode=importance",
                "rsm:mode=importance:samples=9:clamp=0.3");
    expect_name("rsm:shared=no", "rsm:shared=false");
    expect_name("plain", "plain");
    /* the core's behind the method's own, and of methods without any */
    expect_name("rsm:rsm_resolution=256:mode=all", "rsm:mode=all:rsm_resolution=256");
    expect_name("plain:rsm_resolution=8192", "plain:rsm_resolution=8192");
    expect_name("plain:rsm_resolution=0", "plain");
}

/* The trial's own resolution, else the config's. */
static void test_rsm_resolution(void **state)
{
    (void)state;
    const struct irb_render_settings render = {.rsm_resolution = 512};
    struct irb_trial trial;
    struct irb_error err = {0};
    REQUIRE_OK(irb_trial_parse(&trial, "rsm:rsm_resolution=64", &mock_registry, &err));
    assert_int_equal(irb_trial_rsm_resolution(&trial, &render), 64);
    irb_trial_destroy(&trial);
    REQUIRE_OK(irb_trial_parse(&trial, "rsm", &mock_registry, &err));
    assert_int_equal(irb_trial_rsm_resolution(&trial, &render), 512);
    assert_int_equal(irb_trial_option_find(&mock_rsm, "shared"), 3);
    assert_int_equal(irb_trial_option_find(&mock_rsm, "rsm_resolution"), 4);
    assert_int_equal(irb_trial_option_find(&mock_rsm, "settle"), -1);
    assert_null(irb_trial_option(&mock_rsm, 5));
    assert_ptr_equal(irb_trial_option(&mock_plain, 0), irb_trial_options);
    assert_true(irb_trial_option_is_core(irb_trial_option(&mock_rsm, 4)));
    assert_false(irb_trial_option_is_core(irb_trial_option(&mock_rsm, 3)));
    irb_trial_destroy(&trial);
    /* a method's own parameter of the name is the method's */
    static const struct irb_option own[] = {
        IRB_OPTION_INT(struct mock_params, samples, 9, 1, 10, "", "", ""), IRB_OPTION_END};
    struct irb_option renamed[2] = {own[0], own[1]};
    renamed[0].name = "rsm_resolution";
    const struct irb_method method = {
        .name = "own", .params = renamed, .params_size = sizeof(struct mock_params)};
    const struct irb_registry registry = {.methods = {&method}, .count = 1};
    REQUIRE_OK(irb_trial_parse(&trial, "own:rsm_resolution=10", &registry, &err));
    assert_int_equal(((const struct mock_params *)trial.params)->samples, 10);
    assert_int_equal(irb_trial_rsm_resolution(&trial, &render), 512);
    assert_null(irb_trial_option(&method, 1));
    irb_trial_destroy(&trial);
}

static void test_values(void **state)
{
    (void)state;
    struct irb_trial trial;
    struct irb_error err = {0};
    REQUIRE_OK(irb_trial_parse(&trial, "rsm:mode=all:clamp=0.25", &mock_registry, &err));
    const struct mock_params *params = trial.params;
    assert_ptr_equal(trial.method, &mock_rsm);
    assert_int_equal(params->mode, 0);
    assert_int_equal(params->samples, 400);
    REQUIRE_NEAR(params->clamp, 0.25, 0);
    assert_true(params->shared);
    irb_trial_destroy(&trial);
}

static struct mock_params params_at(const struct irb_trial *trial, int frame)
{
    struct mock_params params;
    irb_trial_params(trial, frame, &params);
    return params;
}

static void test_track_names(void **state)
{
    (void)state;
    expect_name("rsm:samples=32@0+64@4", "rsm:samples=32@0+64@4");
    expect_name("rsm:clamp=0.50@2..1@7:samples=32@0+0064@4+400@5",
                "rsm:samples=32@0+64@4+400@5:clamp=0.5@2..1@7");
    expect_name("rsm:shared=on@1+off@2:mode=all@0+importance@9",
                "rsm:mode=all@0+importance@9:shared=true@1+false@2");
    /* also where frame 0 has the default */
    expect_name("rsm:samples=400@0+9@1", "rsm:samples=400@0+9@1");
    /* what does not change has no keys */
    expect_name("rsm:samples=32@0", "rsm:samples=32");
    expect_name("rsm:samples=32@3+32@5", "rsm:samples=32");
    expect_name("rsm:samples=400@3..400@5", "rsm");
}

static void test_track_values(void **state)
{
    (void)state;
    struct irb_trial trial;
    struct irb_error err = {0};
    REQUIRE_OK(irb_trial_parse(
        &trial,
        "rsm:samples=32@2+64@4:clamp=1@2..2@6..0@7:mode=all@0+importance@3:shared=no@0+on@1",
        &mock_registry, &err));
    static const int samples[] = {32, 32, 32, 32, 64, 64, 64, 64, 64};
    static const double clamp[] = {1, 1, 1, 1.25, 1.5, 1.75, 2, 0, 0};
    for (int frame = 0; frame < 9; frame++) {
        struct mock_params p = params_at(&trial, frame);
        assert_int_equal(p.samples, samples[frame]);
        REQUIRE_NEAR(p.clamp, clamp[frame], 0);
        assert_int_equal(p.mode, frame < 3 ? 0 : 2);
        assert_int_equal(p.shared, frame > 0);
    }
    /* settling */
    assert_int_equal(params_at(&trial, -16).samples, 32);
    assert_int_equal(((const struct mock_params *)trial.params)->samples, 32);
    irb_trial_destroy(&trial);
    /* whole numbers are rounded: 10, 10.75, 11.5, 12.25, 13 */
    REQUIRE_OK(irb_trial_parse(&trial, "rsm:samples=10@0..13@4", &mock_registry, &err));
    static const int rounded[] = {10, 11, 12, 12, 13};
    for (int frame = 0; frame < 5; frame++)
        assert_int_equal(params_at(&trial, frame).samples, rounded[frame]);
    irb_trial_destroy(&trial);
}

/* What follows from the parameters, as a frame has them: claims frame by frame, needs of all frames
 * that there are. */
static void test_what_follows(void **state)
{
    (void)state;
    struct irb_trial trial;
    struct irb_error err = {0};
    REQUIRE_OK(irb_trial_parse(&trial, "rsm:mode=importance", &mock_registry, &err));
    assert_true(irb_trial_claims_visibility(&trial, 0));
    assert_int_equal(irb_trial_needs(&trial, 8), IRB_NEEDS_NOTHING);
    irb_trial_destroy(&trial);
    REQUIRE_OK(irb_trial_parse(&trial,
                               "rsm:mode=all@0+importance@3+uniform@5:samples=900@0..1010@11:"
                               "shared=true@0+false@4+true@6",
                               &mock_registry, &err));
    for (int frame = -2; frame < 20; frame++)
        assert_int_equal(irb_trial_claims_visibility(&trial, frame), frame == 3 || frame == 4);
    assert_int_equal(irb_trial_needs(&trial, 4), IRB_NEEDS_NOTHING);
    assert_int_equal(irb_trial_needs(&trial, 5), IRB_NEEDS_STATIC_GEOMETRY);
    /* 1000 samples in frame 10 */
    assert_int_equal(irb_trial_needs(&trial, 11), IRB_NEEDS_STATIC_GEOMETRY);
    assert_int_equal(irb_trial_needs(&trial, 12), IRB_NEEDS_STATIC_GEOMETRY | IRB_NEEDS_HISTORY);
    irb_trial_destroy(&trial);
    REQUIRE_OK(irb_trial_parse(&trial, "plain", &mock_registry, &err));
    assert_false(irb_trial_claims_visibility(&trial, 0));
    assert_int_equal(irb_trial_needs(&trial, 100), IRB_NEEDS_NOTHING);
    irb_trial_destroy(&trial);
}

static void expect_refusal(const char *text, const char *words)
{
    struct irb_trial trial;
    struct irb_error err = {0};
    if (irb_trial_parse(&trial, text, &mock_registry, &err))
        fail_msg("'%s' was accepted", text);
    assert_null(trial.params);
    assert_null(trial.name);
    assert_int_equal(err.code, IRB_E_INPUT);
    char *expected = irb_asprintf("trial '%s': %s", text, words);
    if (strcmp(err.message, expected))
        fail_msg("'%s' is not '%s'", err.message, expected);
    free(expected);
}

static void test_refusals(void **state)
{
    (void)state;
    expect_refusal("", "unknown method ''; expected one of: rsm, plain");
    expect_refusal("rms", "unknown method 'rms'; did you mean 'rsm'?");
    expect_refusal("rsm:mod=all", "unknown key 'mod'; did you mean 'mode'?");
    expect_refusal("rsm:mode=al", "mode: expected one of all, uniform, importance; found 'al'");
    expect_refusal("rsm:samples=0", "samples: expected a whole number in [1, 4096]; found '0'");
    expect_refusal("rsm:rsm_resolution=-1",
                   "rsm_resolution: expected a whole number in [0, 8192] texels; found '-1'");
    expect_refusal("plain:rsm_resolution=8193",
                   "rsm_resolution: expected a whole number in [0, 8192] texels; found '8193'");
    expect_refusal(
        "rsm:rsm_resolution=32@0+64@4",
        "rsm_resolution: expected one value, found keys; it stays the same over the sequence");
    expect_refusal("plain:mode=all", "unknown key 'mode'; plain has no parameters");
    expect_refusal("rsm:clamp=-1", "clamp: expected a number in [0, 10] m; found '-1'");
    expect_refusal("rsm:", "expected option=value, found ''");
    expect_refusal("rsm::mode=all", "expected option=value, found ''");
    expect_refusal("rsm:mode", "expected option=value, found 'mode'");
    expect_refusal("rsm:=1", "expected option=value, found '=1'");
    expect_refusal("rsm:mode=all:mode=all", "'mode' is given twice");
    expect_refusal("rsm:samples=32@",
                   "samples: frame: expected a whole number in [0, 1e+06]; found ''");
    expect_refusal("rsm:samples=32@0+", "samples: expected VALUE@FRAME, found ''");
    expect_refusal("rsm:samples=32@0+64", "samples: expected VALUE@FRAME, found '64'");
    expect_refusal("rsm:samples=@0", "samples: expected a whole number in [1, 4096]; found ''");
    expect_refusal("rsm:samples=32@0+0@4",
                   "samples: expected a whole number in [1, 4096]; found '0'");
    expect_refusal("rsm:samples=32@4+64@4",
                   "samples: frame: expected above 4, the key before it, found 4");
    expect_refusal("rsm:samples=32@0,64@4",
                   "samples: frame: expected a whole number in [0, 1e+06]; found '0,64@4'");
    expect_refusal("rsm:samples=1@0+2@4..3@5",
                   "samples: expected '+' (steps) or '..' (linear) between all keys, found both");
    expect_refusal("rsm:mode=all@0..uniform@4",
                   "mode: expected steps between its values, found linear");
    expect_refusal("rsm:shared=on@0..off@4",
                   "shared: expected steps between its values, found linear");
    expect_refusal("rsm:mode=all@0+al@4",
                   "mode: expected one of all, uniform, importance; found 'al'");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rsm_resolution), cmocka_unit_test(test_names),
        cmocka_unit_test(test_values),         cmocka_unit_test(test_track_names),
        cmocka_unit_test(test_track_values),   cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_what_follows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
