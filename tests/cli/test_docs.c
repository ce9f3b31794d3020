/* SPDX-License-Identifier: MIT
 *
 * Nothing without documentation: every command and option of the command line, key and option of a
 * config, metric, scene, method, parameter of a method and exit status says in words what it is.
 */
#include "core/cli/docs.h"
#include "core/config/config.h"
#include "core/scene/builtin.h"
#include "core/score/metric_list.h"
#include "tests/support/compare.h"

#include <ctype.h>
#include <string.h>

/* At least a word of two letters, on one line. */
static void expect_words(const char *what, const char *name, const char *field, const char *text)
{
    size_t letters = 0;
    for (const char *c = text ? text : ""; *c; c++) {
        letters += isalpha((unsigned char)*c) != 0;
        if (*c == '\n')
            fail_msg("%s %s: its %s has more than one line", what, name, field);
    }
    if (letters < 2)
        fail_msg("%s %s has no %s", what, name, field);
}

static void expect_options(const char *what, const struct irb_option *options)
{
    for (const struct irb_option *o = options; o->name; o++) {
        expect_words(what, o->name, "doc", o->doc);
        expect_words(what, o->name, "source", o->source);
        assert_non_null(o->unit);
        if (o->type == IRB_TYPE_ENUM)
            assert_non_null(o->choices[0]);
        else if (!(o->default_value >= o->min && o->default_value <= o->max))
            fail_msg("%s %s: its default is out of range", what, o->name);
    }
}

static void test_options_are_documented(void **state)
{
    (void)state;
    expect_options("config key", irb_render_options);
    expect_options("config key", irb_output_options);
    expect_options("config key reference.", irb_reference_options);
    expect_options("parameter of every trial", irb_trial_options);
    for (const struct irb_documented_section *s = irb_documented_sections; s->title; s++)
        for (const struct irb_documented_key *key = s->keys; key->name; key++) {
            expect_words(s->title, key->name, "doc", key->doc);
            expect_words(s->title, key->name, "value", key->value);
        }
}

static void test_methods_are_documented(void **state)
{
    (void)state;
    struct irb_registry registry = {0};
    irb_registry_init(&registry);
    assert_true(registry.count > 0);
    for (int i = 0; i < registry.count; i++) {
        const struct irb_method *m = registry.methods[i];
        expect_words("method", m->name, "title", m->title);
        expect_words("method", m->name, "citation", m->citation);
        expect_words("method", m->name, "light path", m->path_classes);
        assert_non_null(m->stages[0]);
        expect_options(m->name, m->params);
    }
    irb_registry_close(&registry);
}

static void test_metrics_are_documented(void **state)
{
    (void)state;
    for (int i = 0; i < IRB_METRIC_COUNT; i++) {
        expect_words("metric", irb_metrics[i].name, "doc", irb_metrics[i].doc);
        assert_non_null(irb_metrics[i].unit);
    }
}

static void test_scenes_are_documented(void **state)
{
    (void)state;
    assert_non_null(irb_builtins[0].name);
    for (const struct irb_builtin *b = irb_builtins; b->name; b++) {
        expect_words("scene", b->name, "doc", b->doc);
        expect_words("scene", b->name, "source", b->source);
    }
}

static void test_command_line_is_documented(void **state)
{
    (void)state;
    for (const struct irb_command *c = irb_commands; c->name; c++) {
        expect_words("command", c->name, "doc", c->doc);
        if (!strstr(c->help, c->name))
            fail_msg("command %s has no example in its help", c->name);
    }
    for (const struct irb_cli_option *o = irb_cli_options; o->name; o++)
        expect_words("option", o->name, "doc", o->doc);
#define X(name, status, doc) expect_words("exit status", #name, "doc", doc);
    IRB_ERROR_CODES(X)
#undef X
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options_are_documented),
        cmocka_unit_test(test_methods_are_documented),
        cmocka_unit_test(test_metrics_are_documented),
        cmocka_unit_test(test_scenes_are_documented),
        cmocka_unit_test(test_command_line_is_documented),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
