/* SPDX-License-Identifier: MIT
 *
 * #include, defines and the mapping of compile logs; the embedded table. Needs no OpenGL.
 */
#include "tests/support/compare.h"
#include "tests/gl/fixture.h"

#include "core/gl/glsl.h"
#include "core/gl/shaders.h"

struct state {
    char *folder;
    struct irb_glsl glsl;
    struct irb_error err;
};

static int setup(void **data)
{
    struct state *s = calloc(1, sizeof *s);
    s->folder = fixture_folder();
    *data = s;
    return 0;
}

static int teardown(void **data)
{
    struct state *s = *data;
    irb_glsl_free(&s->glsl);
    fixture_remove(s->folder);
    free(s);
    return 0;
}

static const char *expand(struct state *s, const char *const *defines)
{
    if (!irb_glsl_expand(&s->glsl, s->folder, "t/main.frag", defines, &s->err))
        fail_msg("%s", s->err.message);
    return irb_str_text(&s->glsl.text);
}

static void expect_failure(struct state *s, const char *message)
{
    if (irb_glsl_expand(&s->glsl, s->folder, "t/main.frag", NULL, &s->err))
        fail_msg("expected an error, found the text: %s", irb_str_text(&s->glsl.text));
    assert_int_equal(s->err.code, IRB_E_INPUT);
    assert_string_equal(s->err.message, message);
}

static void test_include_once_and_defines(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag",
                  "#include \"t/a.glsl\"\n  # include \"t/b.glsl\" // again\nvoid main() {}\n");
    fixture_write(s->folder, "t/a.glsl", "#include \"t/b.glsl\"\nfloat a;\n");
    fixture_write(s->folder, "t/b.glsl", "float b;");
    const char *const defines[] = {"N 4", "FAST", NULL};
    assert_string_equal(expand(s, defines), "#version 450 core\n#define N 4\n#define FAST\n"
                                            "float b;\nfloat a;\nvoid main() {}\n");
}

static void test_comments_and_line_ends(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag",
                  "/* not\r\n#include \"t/none.glsl\"\r\n*/ int x;\r\n"
                  "// nor\n// #include \"t/none.glsl\"\n// /*\n#include \"t/b.glsl\" /* yes */\n");
    fixture_write(s->folder, "t/b.glsl", "float b;\n");
    assert_string_equal(expand(s, NULL),
                        "#version 450 core\n/* not\n#include \"t/none.glsl\"\n*/ int x;\n"
                        "// nor\n// #include \"t/none.glsl\"\n// /*\nfloat b;\n");
}

/* Lines of the final text: 1 #version, 2 define, 3-5 b.glsl, 6-7 the rest of main.frag. */
static void test_log_is_mapped_back(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag", "#include \"t/b.glsl\"\nvoid main() {\n}\n");
    fixture_write(s->folder, "t/b.glsl", "// one\n// two\nfloat b = oops;\n");
    const char *const defines[] = {"N 4", NULL};
    expand(s, defines);
    static const char *const cases[][2] = {
        {"0:5(11): error: `oops' undeclared\n", "t/b.glsl:3: `oops' undeclared"},
        {"0:3(1): warning: shadows\n0:6(1): error: bad\n0:7(1): error: worse\n",
         "t/main.frag:2: bad (and 1 more)"},
        {"0(7) : error C1503: undefined variable \"oops\"\n",
         "t/main.frag:3: error C1503: undefined variable \"oops\""},
        {"ERROR: 0:4: 'oops' : undeclared identifier\nERROR: 1 compilation errors.\n",
         "t/b.glsl:2: 'oops' : undeclared identifier"},
        {"0:2(9): error: in a define", "defines:1: in a define"},
        {"0:99(1): error: past the end", "defines:99: past the end"},
        {"something else\nentirely\n", "t/main.frag: something else"},
        {"", "t/main.frag: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char out[640];
        irb_glsl_describe_log(&s->glsl, cases[i][0], out, sizeof out);
        assert_string_equal(out, cases[i][1]);
    }
}

static void test_missing_include_names_file_and_line(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag", "\n#include \"t/light.glsl\"\n");
    fixture_write(s->folder, "t/light.glsl", "float l;\n\n#include \"t/ligth.glsl\"\n");
    expect_failure(s, "t/light.glsl:3: #include: t/ligth.glsl: no such shader; did you mean "
                      "\"t/light.glsl\"?");
}

static void test_cycle(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag", "#include \"t/a.glsl\"\n");
    fixture_write(s->folder, "t/a.glsl", "\n#include \"t/b.glsl\"\n");
    fixture_write(s->folder, "t/b.glsl", "\n\n#include \"t/a.glsl\"\n");
    expect_failure(s, "t/b.glsl:3: #include goes round in a circle: t/a.glsl -> t/b.glsl -> "
                      "t/a.glsl");
}

static void test_malformed_include(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag", "#include <t/a.glsl>\n");
    expect_failure(s, "t/main.frag:1: expected #include \"path\", found: #include <t/a.glsl>");
}

static void test_version_is_refused(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag", "\n#version 330\n");
    expect_failure(s, "t/main.frag:2: #version is put first by the loader; remove it here");
}

static void test_path_stays_inside(void **data)
{
    struct state *s = *data;
    fixture_write(s->folder, "t/main.frag", "#include \"../main.frag\"\n");
    assert_false(irb_glsl_expand(&s->glsl, s->folder, "t/main.frag", NULL, &s->err));
    REQUIRE_CONTAINS(s->err.message, "t/main.frag:1: #include: ../main.frag: no such shader");
}

static void test_zero_byte(void **data)
{
    struct state *s = *data;
    char *file = irb_asprintf("%s/main.frag", s->folder);
    REQUIRE_CMP(irb_fs_write(file, "a\0b", 3, &s->err), ==, true);
    free(file);
    assert_null(irb_shader_load(s->folder, "main.frag", &s->err));
    REQUIRE_CONTAINS(s->err.message, "main.frag: expected GLSL text, found a zero byte");
}

/* The table holds exactly what lies in shaders/. */
static void test_embedded_equals_files(void **data)
{
    (void)data;
    size_t embedded, both;
    char **names = irb_shader_list(NULL, &embedded);
    char **all = irb_shader_list(SHADER_DIR, &both);
    REQUIRE_CMP(embedded, ==, both);
    REQUIRE_CMP(embedded, >, 0);
    for (size_t i = 0; i < embedded; i++) {
        struct irb_error err = {0};
        char *table = irb_shader_load(NULL, names[i], &err), *text = NULL;
        char *file = irb_asprintf("%s/%s", SHADER_DIR, names[i]);
        REQUIRE_OK(irb_fs_read(file, 1 << 20, &text, NULL, &err));
        assert_string_equal(table, text);
        free(table);
        free(text);
        free(file);
    }
    irb_shader_list_free(names);
    irb_shader_list_free(all);
}

static void test_unknown_shader_gets_the_nearest_name(void **data)
{
    (void)data;
    struct irb_error err = {0};
    assert_null(irb_shader_load(NULL, "gl/fulscreen.vert", &err));
    assert_string_equal(err.message, "gl/fulscreen.vert: no such shader; did you mean "
                                     "\"gl/fullscreen.vert\"?");
    assert_int_equal(err.code, IRB_E_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_include_once_and_defines, setup, teardown),
        cmocka_unit_test_setup_teardown(test_comments_and_line_ends, setup, teardown),
        cmocka_unit_test_setup_teardown(test_log_is_mapped_back, setup, teardown),
        cmocka_unit_test_setup_teardown(test_missing_include_names_file_and_line, setup, teardown),
        cmocka_unit_test_setup_teardown(test_cycle, setup, teardown),
        cmocka_unit_test_setup_teardown(test_malformed_include, setup, teardown),
        cmocka_unit_test_setup_teardown(test_version_is_refused, setup, teardown),
        cmocka_unit_test_setup_teardown(test_path_stays_inside, setup, teardown),
        cmocka_unit_test_setup_teardown(test_zero_byte, setup, teardown),
        cmocka_unit_test(test_embedded_equals_files),
        cmocka_unit_test(test_unknown_shader_gets_the_nearest_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
