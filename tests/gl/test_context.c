/* SPDX-License-Identifier: MIT
 *
 * Contexts on the backend that argv[1] names, debug errors, and what happens without a backend.
 */
#include "tests/support/compare.h"
#include "tests/gl/fixture.h"

static enum irb_backend backend;

static void test_context_is_4_5_core(void **data)
{
    (void)data;
    struct irb_gl *gl = fixture_gl(backend, NULL);
    GLint major = 0, minor = 0, profile = 0;
    gl->api.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->api.GetIntegerv(GL_MINOR_VERSION, &minor);
    gl->api.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    REQUIRE_CMP(10 * major + minor, >=, 45);
    REQUIRE_CMP(profile & GL_CONTEXT_CORE_PROFILE_BIT, !=, 0);
    assert_int_equal(gl->backend, backend);
    assert_true(*gl->vendor && *gl->renderer && *gl->version && *gl->platform);
    assert_int_equal(gl->bytes, 0);
    irb_gl_destroy(gl);
}

static void test_again_after_destroy(void **data)
{
    (void)data;
    for (int i = 0; i < 3; i++)
        irb_gl_destroy(fixture_gl(backend, NULL));
    irb_gl_destroy(NULL);
}

static void test_debug_error_names_the_site(void **data)
{
    (void)data;
    struct irb_error err = {0};
    struct irb_gl *gl = fixture_gl(backend, NULL);
    REQUIRE_OK(irb_gl_check(gl, "before", &err));
    gl->api.DrawArrays(GL_TRIANGLES, -1, 3);
    gl->api.Enable(0x1234);
    assert_false(irb_gl_check(gl, "gbuffer: draw", &err));
    assert_int_equal(err.code, IRB_E_BACKEND);
    REQUIRE_CONTAINS(err.message, "gbuffer: draw: ");
    REQUIRE_CONTAINS(err.message, "glDrawArrays"); /* the first of the two */
    REQUIRE_ONE_LINE(err.message);
    REQUIRE_OK(irb_gl_check(gl, "after", &err));
    irb_gl_destroy(gl);
}

/* Without debug output glGetError still says what went wrong. */
static void test_error_without_debug_output(void **data)
{
    (void)data;
    struct irb_error err = {0};
    struct irb_gl *gl = fixture_gl(backend, NULL);
    gl->api.Disable(GL_DEBUG_OUTPUT);
    gl->api.Enable(0x1234);
    assert_false(irb_gl_check(gl, "rsm: draw", &err));
    assert_string_equal(err.message, "rsm: draw: GL_INVALID_ENUM");
    irb_gl_destroy(gl);
}

static void test_null_backend_cannot_render(void **data)
{
    (void)data;
    struct irb_error err = {0};
    assert_null(irb_gl_create(&(struct irb_gl_desc){.backend = IRB_BACKEND_NULL}, &err));
    assert_int_equal(err.code, IRB_E_BACKEND);
    REQUIRE_CONTAINS(err.message, "null backend");
    REQUIRE_ONE_LINE(err.message);
}

static void test_shader_folder_must_exist(void **data)
{
    (void)data;
    struct irb_error err = {0};
    assert_null(irb_gl_create(&(struct irb_gl_desc){.shader_dir = "/nonexistent"}, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_string_equal(err.message, "/nonexistent: expected a folder of shaders, found none");
}

static char *doctor(bool *works)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    *works = irb_gl_doctor(out, &(struct irb_gl_desc){.backend = backend});
    fclose(out);
    return text;
}

static void test_doctor(void **data)
{
    (void)data;
    bool works;
    char *text = doctor(&works);
    assert_true(works);
    static const char *const parts[] = {"osmesa ",  "egl ",          "vendor ",
                                        "version ", "uniform block", "compute group size"};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        REQUIRE_CONTAINS(text, parts[i]);
    free(text);
}

/* Run with an environment in which EGL finds no driver. */
static void test_no_egl_device(void **data)
{
    (void)data;
    struct irb_error err = {0};
    assert_null(irb_gl_create(&(struct irb_gl_desc){.backend = IRB_BACKEND_EGL}, &err));
    assert_int_equal(err.code, IRB_E_BACKEND);
    REQUIRE_CONTAINS(err.message, "egl: ");
    REQUIRE_CONTAINS(err.message, "apt install");
    REQUIRE_ONE_LINE(err.message);
    bool works;
    backend = IRB_BACKEND_EGL;
    char *text = doctor(&works);
    assert_false(works);
    REQUIRE_CONTAINS(text, "egl     missing");
    free(text);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest no_egl[] = {cmocka_unit_test(test_no_egl_device)};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_context_is_4_5_core),
        cmocka_unit_test(test_again_after_destroy),
        cmocka_unit_test(test_debug_error_names_the_site),
        cmocka_unit_test(test_error_without_debug_output),
        cmocka_unit_test(test_null_backend_cannot_render),
        cmocka_unit_test(test_shader_folder_must_exist),
        cmocka_unit_test(test_doctor),
    };
    if (argc > 1 && strcmp(argv[1], "no-egl") == 0)
        return cmocka_run_group_tests(no_egl, NULL, NULL);
    backend = fixture_backend(argc, argv);
    irb_gl_destroy(fixture_gl(backend, NULL)); /* skips */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
