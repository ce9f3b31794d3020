/* SPDX-License-Identifier: MIT */
#include "core/config/config.h"
#include "tests/support/compare.h"

#include "tests/experiment/mock_methods.h"

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
    expect_refusal("rsm:clamp=-1", "clamp: expected a number in [0, 10] m; found '-1'");
    expect_refusal("rsm:", "expected option=value, found ''");
    expect_refusal("rsm::mode=all", "expected option=value, found ''");
    expect_refusal("rsm:mode", "expected option=value, found 'mode'");
    expect_refusal("rsm:=1", "expected option=value, found '=1'");
    expect_refusal("rsm:mode=all:mode=all", "'mode' is given twice");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_values),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
