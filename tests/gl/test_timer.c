/* SPDX-License-Identifier: MIT
 *
 * Stage times: what runs takes time, twice the work about twice of it, the rest is 0.
 */
#include "tests/support/compare.h"
#include "tests/gl/fixture.h"

#include "core/base/clock.h"
#include "core/gl/objects.h"
#include "core/gl/program.h"
#include "core/gl/timer.h"

static enum irb_backend backend;

static const char work[] = "in vec2 uv; out vec4 c; uniform int n;\n"
                           "void main() { float s = uv.x;\n"
                           "    for (int i = 0; i < n; i++) s = sin(s * 3.0) + uv.y;\n"
                           "    c = vec4(s); }\n";

static void test_null_timer(void **data)
{
    (void)data;
    double ms[IRB_MAX_STAGES];
    irb_timer_begin(NULL, 0);
    irb_timer_end(NULL);
    irb_timer_collect(NULL, ms);
    REQUIRE_NEAR(ms[0], 0, 0);
    assert_string_equal(irb_timer_clock(NULL), "none");
    irb_timer_destroy(NULL);
}

/* The stages' times are those of the work inside them: together no more than the time that passed,
 * and most of it. */
static void test_stages(void **data)
{
    (void)data;
    struct irb_error err = {0};
    char *folder = fixture_folder();
    fixture_write(folder, "t/work.frag", work);
    struct irb_gl *gl = fixture_gl(backend, folder);
    struct irb_program *p = irb_program_create(
        gl, &(struct irb_program_desc){.vertex = "gl/fullscreen.vert", .fragment = "t/work.frag"},
        &err);
    REQUIRE_OK(p);
    struct irb_texture *t = irb_texture_create(
        gl, &(struct irb_texture_desc){.format = GL_RGBA32F, .width = 256, .height = 256}, &err);
    REQUIRE_OK(t);
    struct irb_framebuffer *f = irb_framebuffer_create(gl, "work", &t, 1, NULL, &err);
    struct irb_timer *timer = irb_timer_create(gl, &err);
    REQUIRE_OK(f && timer);
    assert_string_equal(irb_timer_clock(timer), gl->software ? "finish+clock" : "gl-query");
    irb_framebuffer_bind(f);
    irb_program_use(p);
    irb_program_int(p, "n", 1);
    irb_gl_draw_fullscreen(gl); /* compiles */
    gl->api.Finish();
    irb_program_int(p, "n", 100);
    double begin = irb_clock_s(), ms[IRB_MAX_STAGES];
    for (int i = 0; i < 3; i++) {
        irb_timer_begin(timer, i == 1 ? 31 : 2); /* stage 2 runs twice */
        irb_gl_draw_fullscreen(gl);
        irb_timer_end(timer);
    }
    irb_timer_collect(timer, ms);
    double passed = 1e3 * (irb_clock_s() - begin);
    REQUIRE_CMP(ms[2], >, 0);
    REQUIRE_CMP(ms[31], >, 0);
    REQUIRE_CMP(ms[2] + ms[31], <=, passed);
    if (gl->software)
        REQUIRE_CMP(ms[2] + ms[31], >=, 0.8 * passed);
    for (int i = 0; i < IRB_MAX_STAGES; i++)
        if (i != 2 && i != 31)
            REQUIRE_NEAR(ms[i], 0, 0);
    irb_timer_collect(timer, ms);
    REQUIRE_NEAR(ms[2], 0, 0);
    irb_timer_destroy(timer);
    irb_framebuffer_destroy(f);
    irb_texture_destroy(t);
    irb_program_destroy(p);
    irb_gl_destroy(gl);
    fixture_remove(folder);
}

int main(int argc, char **argv)
{
    backend = fixture_backend(argc, argv);
    irb_gl_destroy(fixture_gl(backend, NULL)); /* skips */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_null_timer),
        cmocka_unit_test(test_stages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
