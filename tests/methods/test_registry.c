/* SPDX-License-Identifier: MIT */
#include "methods/registry.h"
#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Where the build puts the modules: module_NAME.so. */
static void module_path(char out[512], const char *name)
{
    const char *dir = getenv("IRB_TEST_MODULES");
    snprintf(out, 512, "%s/module_%s.so", dir ? dir : ".", name);
}

static void expect_refusal(const char *name, const char *words)
{
    struct irb_registry registry;
    irb_registry_init(&registry);
    int before = registry.count;
    char path[512];
    module_path(path, name);
    struct irb_error err = {0};
    assert_false(irb_registry_load(&registry, path, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_int_equal(registry.count, before);
    assert_int_equal(registry.module_count, 0);
    if (strncmp(err.message, path, strlen(path)) || !strstr(err.message, words))
        fail_msg("'%s' does not begin with the path and say '%s'", err.message, words);
    irb_registry_close(&registry);
}

static void test_good_module(void **state)
{
    (void)state;
    struct irb_registry registry;
    struct irb_error err = {0};
    irb_registry_init(&registry);
    char path[512];
    module_path(path, "good");
    REQUIRE_OK(irb_registry_load(&registry, path, &err));
    const struct irb_method *method = irb_registry_find(&registry, "test-module", &err);
    assert_non_null(method);
    assert_string_equal(method->title, "A method for tests");
    assert_string_equal(method->params[0].name, "samples");

    /* its name is taken now */
    assert_false(irb_registry_load(&registry, path, &err));
    assert_non_null(strstr(err.message, "there is a method 'test-module' already"));
    assert_int_equal(registry.module_count, 1);
    irb_registry_close(&registry);
    assert_int_equal(registry.count, 0);
}

static void test_bad_modules(void **state)
{
    (void)state;
    expect_refusal("other_abi", "expected method ABI 3, found 4");
    expect_refusal("no_method", "returned no method");
    expect_refusal("bad_name", "found 'Not a name'");
    expect_refusal("missing_function", "must define create, resize");
    expect_refusal("outside_struct", "'samples' ends at byte 4 of a struct of 2");
    expect_refusal("no_symbol", "doesn't export irb_method_module()");
    expect_refusal("that_is_not_there", "cannot load the module");
}

static void test_file_that_is_no_module(void **state)
{
    (void)state;
    char path[] = "/tmp/irb_module_XXXXXX";
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, "hello", 5), 5);
    close(fd);
    struct irb_registry registry;
    struct irb_error err = {0};
    irb_registry_init(&registry);
    assert_false(irb_registry_load(&registry, path, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_null(strchr(err.message, '\n'));
    irb_registry_close(&registry);
    unlink(path);
}

static void test_find(void **state)
{
    (void)state;
    static const struct irb_method one = {.name = "rsm"}, two = {.name = "imperfect"};
    struct irb_registry registry = {.methods = {&one, &two}, .count = 2};
    struct irb_error err = {0};
    assert_ptr_equal(irb_registry_find(&registry, "rsm", &err), &one);
    assert_null(irb_registry_find(&registry, "rms", &err));
    assert_string_equal(err.message, "unknown method 'rms'; did you mean 'rsm'?");
    assert_null(irb_registry_find(&registry, "photon-mapping", &err));
    assert_string_equal(err.message,
                        "unknown method 'photon-mapping'; expected one of: rsm, imperfect");
}

/* Every built-in method states what a module has to state. */
static void test_builtin_methods(void **state)
{
    (void)state;
    struct irb_registry registry;
    irb_registry_init(&registry);
    for (int i = 0; i < registry.count; i++) {
        const struct irb_method *m = registry.methods[i];
        assert_int_equal(m->abi, IRB_METHOD_ABI);
        assert_non_null(m->title);
        assert_non_null(m->citation);
        assert_non_null(m->path_classes);
        assert_non_null(m->stages);
        assert_non_null(m->params);
        for (const struct irb_option *o = m->params; o->name; o++) {
            assert_true(o->doc && *o->doc);
            assert_true(o->source && *o->source);
            assert_non_null(o->unit);
        }
        struct irb_error err;
        assert_ptr_equal(irb_registry_find(&registry, m->name, &err), m);
    }
    irb_registry_close(&registry);
}

/* The parameters of a trial's text. */
static void *parse(const struct irb_method *method, const char *name, const char *value)
{
    struct irb_error err = {0};
    void *params = calloc(1, method->params_size);
    assert_non_null(params);
    irb_options_default(method->params, params);
    assert_true(!name || irb_option_set(method->params, params, name, value, &err));
    return params;
}

/* Shadows and histories come and go with the parameters. */
static void test_what_follows_from_parameters(void **state)
{
    (void)state;
    static const struct {
        const char *method, *name, *value;
        bool visibility, history;
    } cases[] = {
        {"acrsm", NULL, NULL, true, true},
        {"acrsm", "visibility", "ism", true, true},
        {"acrsm", "visibility", "none", false, true},
        {"clustered-visibility", NULL, NULL, true, false},
        {"clustered-visibility", "start", "reuse", true, true},
        {"clustered-visibility", "visibility", "none", false, false},
        {"ism", NULL, NULL, true, false},
        {"ism", "visibility", "exact-raster", true, false},
        {"ism", "visibility", "none", false, false},
        {"rsm", NULL, NULL, false, false},
        {"rsm-clustering", NULL, NULL, false, true},
        {"rsm-clustering", "visibility", "ism", true, true},
        {"rsm-clustering", "visibility", "pcss", true, true},
    };
    struct irb_registry registry;
    struct irb_error err;
    irb_registry_init(&registry);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct irb_method *m = irb_registry_find(&registry, cases[i].method, &err);
        void *params = parse(m, cases[i].name, cases[i].value);
        assert_int_equal(m->claims_visibility && m->claims_visibility(params), cases[i].visibility);
        assert_int_equal(m->needs ? m->needs(params) : 0,
                         cases[i].history ? IRB_NEEDS_HISTORY : IRB_NEEDS_NOTHING);
        free(params);
    }
    irb_registry_close(&registry);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_good_module),
        cmocka_unit_test(test_bad_modules),
        cmocka_unit_test(test_file_that_is_no_module),
        cmocka_unit_test(test_find),
        cmocka_unit_test(test_builtin_methods),
        cmocka_unit_test(test_what_follows_from_parameters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
