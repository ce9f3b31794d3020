/* SPDX-License-Identifier: MIT */
#include "core/base/option.h"
#include "tests/support/compare.h"

#include <string.h>

struct settings {
    int samples, mode;
    float clamp;
    bool on;
};

static const char *const modes[] = {"all", "uniform", NULL};
static const struct irb_option options[] = {
    IRB_OPTION_INT(struct settings, samples, 400, 1, 1000, "", "samples", "test"),
    IRB_OPTION_ENUM(struct settings, mode, 1, modes, "mode", "test"),
    IRB_OPTION_FLOAT(struct settings, clamp, 0.1, 0, 10, "m", "clamp", "test"),
    IRB_OPTION_BOOL(struct settings, on, 1, "switch", "test"),
    IRB_OPTION_END,
};

static struct settings defaults(void)
{
    struct settings s;
    irb_options_default(options, &s);
    return s;
}

/* As text, as a number and back. */
static void expect_printed(const struct settings *s, const char *name, const char *expected)
{
    const struct irb_option *option = irb_option_find(options, name);
    struct irb_str text = {0};
    irb_option_print(option, s, &text);
    assert_string_equal(irb_str_text(&text), expected);
    struct settings other = defaults();
    irb_option_store(option, &other, irb_option_value(option, s));
    text.length = 0;
    irb_option_print(option, &other, &text);
    assert_string_equal(irb_str_text(&text), expected);
    irb_str_free(&text);
}

static void test_defaults_and_printing(void **state)
{
    (void)state;
    struct settings s = defaults();
    assert_int_equal(s.samples, 400);
    assert_int_equal(s.mode, 1);
    assert_true(s.on);
    for (const struct irb_option *o = options; o->name; o++)
        assert_true(irb_option_is_default(o, &s));
    struct irb_error err;
    REQUIRE_OK(irb_option_set(options, &s, "mode", "all", &err));
    REQUIRE_OK(irb_option_set(options, &s, "clamp", "0.3", &err));
    expect_printed(&s, "mode", "all");
    expect_printed(&s, "clamp", "0.3");
    expect_printed(&s, "samples", "400");
}

static void expect_refusal(const char *name, const char *value, const char *words)
{
    struct settings s = defaults();
    struct irb_error err = {0};
    assert_false(irb_option_set(options, &s, name, value, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    if (!strstr(err.message, words))
        fail_msg("'%s' does not say '%s'", err.message, words);
}

static void test_refusals(void **state)
{
    (void)state;
    expect_refusal("sampels", "3", "did you mean 'samples'");
    expect_refusal("samples", "0", "[1, 1000]");
    expect_refusal("samples", "1.5", "whole number");
    expect_refusal("samples", "12x", "found '12x'");
    expect_refusal("samples", "", "found ''");
    expect_refusal("clamp", "nan", "[0, 10] m");
    expect_refusal("clamp", "inf", "[0, 10] m");
    expect_refusal("mode", "al", "all, uniform");
    expect_refusal("on", "maybe", "true or false");
    expect_refusal("completely-different", "1", "expected one of");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults_and_printing),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
