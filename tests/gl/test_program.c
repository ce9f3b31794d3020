/* SPDX-License-Identifier: MIT
 *
 * Programs: uniforms, defines, errors with file and line, shaders from a folder.
 */
#include "tests/support/compare.h"
#include "tests/gl/fixture.h"

#include "core/gl/objects.h"
#include "core/gl/program.h"

static struct irb_gl *gl;
static char *folder;
static struct irb_error err;

static struct irb_program *fragment_program(const char *path, const char *const *defines)
{
    return irb_program_create(gl,
                              &(struct irb_program_desc){.name = "test program",
                                                         .vertex = "gl/fullscreen.vert",
                                                         .fragment = path,
                                                         .defines = defines},
                              &err);
}

/* Draws into one pixel and reads it. */
static void draw_pixel(const struct irb_program *program, float out[4])
{
    struct irb_texture *t = irb_texture_create(
        gl, &(struct irb_texture_desc){.format = GL_RGBA32F, .width = 1, .height = 1}, &err);
    REQUIRE_OK(t);
    struct irb_framebuffer *f = irb_framebuffer_create(gl, "pixel", &t, 1, NULL, &err);
    REQUIRE_OK(f);
    irb_framebuffer_bind(f);
    irb_program_use(program);
    irb_gl_draw_fullscreen(gl);
    REQUIRE_OK(irb_gl_check(gl, "test: draw", &err));
    struct irb_image image = {0};
    REQUIRE_OK(irb_texture_read(t, 4, &image, &err));
    memcpy(out, image.data, 4 * sizeof *out);
    irb_image_destroy(&image);
    irb_framebuffer_destroy(f);
    irb_texture_destroy(t);
}

static void test_uniforms_and_defines(void **data)
{
    (void)data;
    fixture_write(folder, "t/uniforms.frag",
                  "#include \"t/scale.glsl\"\n"
                  "uniform int i; uniform uint u; uniform float f; uniform vec2 v2;\n"
                  "uniform vec3 v3; uniform vec4 v4; uniform ivec2 iv2; uniform mat4 m;\n"
                  "out vec4 color;\n"
                  "void main() {\n"
                  "    color = SCALE * (m * vec4(v2, float(i), float(u)))\n"
                  "          + scale(v4) + vec4(v3 * f, float(iv2.x * iv2.y));\n"
                  "}\n");
    fixture_write(folder, "t/scale.glsl", "vec4 scale(vec4 v) { return SCALE * v; }\n");
    const char *const defines[] = {"SCALE 2.0", NULL};
    struct irb_program *p = fragment_program("t/uniforms.frag", defines);
    REQUIRE_OK(p);
    /* column-major: (x, y, z, w) -> (x, y, z, w) + x * (0, 0, 0, 100) */
    const float m[16] = {1, 0, 0, 100, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    irb_program_int(p, "i", -3);
    irb_program_uint(p, "u", 4000000000u);
    irb_program_float(p, "f", 0.5f);
    irb_program_vec2(p, "v2", (const float[]){1, 2});
    irb_program_vec3(p, "v3", (const float[]){2, 4, 6});
    irb_program_vec4(p, "v4", (const float[]){10, 20, 30, 0});
    irb_program_ivec2(p, "iv2", (const int[]){3, -5});
    irb_program_mat4(p, "m", m);
    irb_program_float(p, "removed_by_the_compiler", 1);
    float out[4];
    draw_pixel(p, out);
    REQUIRE_NEAR(out[0], 2 * 1 + 20 + 1, 0);
    REQUIRE_NEAR(out[1], 2 * 2 + 40 + 2, 0);
    REQUIRE_NEAR(out[2], 2 * -3 + 60 + 3, 0);
    REQUIRE_REL(out[3], 2 * (4e9 + 100) - 15, 1e-6);
    irb_program_destroy(p);
    irb_program_destroy(NULL);
}

static void test_compile_error_names_file_and_line(void **data)
{
    (void)data;
    fixture_write(folder, "t/bad.frag",
                  "#include \"t/good.glsl\"\nout vec4 c;\nvoid main() { c = good() + oops; }\n");
    fixture_write(folder, "t/good.glsl", "// fine\nvec4 good() { return vec4(1); }\n");
    assert_null(fragment_program("t/bad.frag", NULL));
    assert_int_equal(err.code, IRB_E_INPUT);
    REQUIRE_CONTAINS(err.message, "t/bad.frag:3: ");
    REQUIRE_CONTAINS(err.message, "oops");
    REQUIRE_ONE_LINE(err.message);

    fixture_write(folder, "t/good.glsl", "// worse\n\nvec4 good() { return zzz; }\n");
    assert_null(fragment_program("t/bad.frag", NULL));
    REQUIRE_CONTAINS(err.message, "t/good.glsl:3: ");
    REQUIRE_CONTAINS(err.message, "zzz");

    fixture_write(folder, "t/good.glsl", "vec4 good( { return vec4(1); }\n"); /* syntax */
    assert_null(fragment_program("t/bad.frag", NULL));
    REQUIRE_CONTAINS(err.message, "t/good.glsl:1: ");
    REQUIRE_OK(irb_gl_check(gl, "after the errors", &err));
}

static void test_link_error_names_the_program(void **data)
{
    (void)data;
    fixture_write(folder, "t/link.frag",
                  "in vec3 absent; out vec4 c;\n"
                  "void main() { c = vec4(absent, 1.0); }\n");
    assert_null(fragment_program("t/link.frag", NULL));
    REQUIRE_CONTAINS(err.message, "test program: the stages do not link: ");
    REQUIRE_CONTAINS(err.message, "absent");
    REQUIRE_ONE_LINE(err.message);
    REQUIRE_OK(irb_gl_check(gl, "after the error", &err));
}

static void test_missing_shader(void **data)
{
    (void)data;
    fixture_write(folder, "t/present.frag", "void main() {}\n");
    assert_null(fragment_program("t/presnt.frag", NULL));
    assert_string_equal(err.message,
                        "t/presnt.frag: no such shader; did you mean \"t/present.frag\"?");
}

/* A file in the folder wins over the embedded one, and what is not there stays embedded. */
static void test_folder_is_laid_over(void **data)
{
    (void)data;
    float out[4];
    fixture_write(folder, "t/uv.frag", "in vec2 uv; out vec4 c; void main() { c = uv.xyxy; }\n");
    struct irb_program *p = fragment_program("t/uv.frag", NULL);
    REQUIRE_OK(p);
    draw_pixel(p, out);
    REQUIRE_NEAR(out[0], 0.5, 0);
    irb_program_destroy(p);
    char before[33], after[33];
    irb_shader_hash(gl, before);
    fixture_write(
        folder, "gl/fullscreen.vert",
        "out vec2 uv; void main() { uv = vec2(7.0);\n"
        "gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }\n");
    irb_shader_hash(gl, after);
    assert_string_not_equal(before, after);
    assert_int_equal(strlen(after), 32);
    p = fragment_program("t/uv.frag", NULL);
    REQUIRE_OK(p);
    draw_pixel(p, out);
    REQUIRE_NEAR(out[0], 7, 1e-5);
    irb_program_destroy(p);
    char *file = irb_asprintf("%s/gl/fullscreen.vert", folder);
    remove(file);
    free(file);
    irb_shader_hash(gl, after);
    assert_string_equal(before, after);
}

int main(int argc, char **argv)
{
    enum irb_backend backend = fixture_backend(argc, argv);
    irb_gl_destroy(fixture_gl(backend, NULL)); /* skips before anything is written */
    folder = fixture_folder();
    gl = fixture_gl(backend, folder);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_uniforms_and_defines),
        cmocka_unit_test(test_compile_error_names_file_and_line),
        cmocka_unit_test(test_link_error_names_the_program),
        cmocka_unit_test(test_missing_shader),
        cmocka_unit_test(test_folder_is_laid_over),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    fixture_remove(folder);
    return failed;
}
