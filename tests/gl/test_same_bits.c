/* SPDX-License-Identifier: MIT
 *
 * The two backends on llvmpipe give the same bits for the same shaders, and so does the same
 * backend twice, whatever the number of threads: one context after the other in one process.
 */
#include "tests/support/compare.h"
#include "tests/gl/fixture.h"

#include "core/gl/objects.h"
#include "core/gl/program.h"

enum { WIDTH = 96, HEIGHT = 64, GROUP = 64 };

/* Transcendental functions, divisions, derivatives and a data-dependent loop */
static const char fragment[] =
    "in vec2 uv; out vec4 color; uniform float scale;\n"
    "void main() {\n"
    "    vec3 p = vec3(uv * 7.0 - 3.0, scale);\n"
    "    float sum = 0.0;\n"
    "    for (int i = 0; i < 8 + int(uv.x * 16.0); i++) {\n"
    "        p = normalize(sin(p.zxy * 3.1) + 0.3 * p);\n"
    "        sum += exp(-dot(p, p.yzx)) / (float(i) + length(p.xy));\n"
    "    }\n"
    "    color = vec4(sum, pow(abs(p.x), 2.2), inversesqrt(abs(p.y)), dFdx(sum));\n"
    "}\n";

static const char compute[] = "layout(local_size_x = 64) in;\n"
                              "layout(std430, binding = 0) buffer Out { uint histogram[64]; };\n"
                              "shared float share[64];\n"
                              "void main() {\n"
                              "    uint i = gl_GlobalInvocationID.x, l = gl_LocalInvocationID.x;\n"
                              "    share[l] = log(float(i) + 1.0) * atan(float(i), 3.0);\n"
                              "    barrier();\n"
                              "    float v = share[63u - l] + share[l];\n"
                              "    atomicAdd(histogram[l], floatBitsToUint(v) >> 4);\n"
                              "}\n";

struct result {
    struct irb_image image;
    uint32_t histogram[GROUP];
};

static char *folder;

static void draw(struct irb_gl *gl, struct result *out)
{
    struct irb_error err = {0};
    struct irb_program *p = irb_program_create(
        gl, &(struct irb_program_desc){.vertex = "gl/fullscreen.vert", .fragment = "t/bits.frag"},
        &err);
    REQUIRE_OK(p);
    struct irb_texture *t = irb_texture_create(
        gl, &(struct irb_texture_desc){.format = GL_RGBA32F, .width = WIDTH, .height = HEIGHT},
        &err);
    REQUIRE_OK(t);
    struct irb_framebuffer *f = irb_framebuffer_create(gl, "bits", &t, 1, NULL, &err);
    REQUIRE_OK(f);
    irb_framebuffer_bind(f);
    irb_program_use(p);
    irb_program_float(p, "scale", 0.7f);
    irb_gl_draw_fullscreen(gl);
    REQUIRE_OK(irb_texture_read(t, 4, &out->image, &err));
    irb_framebuffer_destroy(f);
    irb_texture_destroy(t);
    irb_program_destroy(p);
}

static void dispatch(struct irb_gl *gl, struct result *out)
{
    struct irb_error err = {0};
    struct irb_program *p =
        irb_program_create(gl, &(struct irb_program_desc){.compute = "t/bits.comp"}, &err);
    REQUIRE_OK(p);
    const uint32_t zero[GROUP] = {0};
    struct irb_buffer *b = irb_buffer_create(gl, "histogram", sizeof zero, zero, &err);
    REQUIRE_OK(b);
    irb_program_use(p);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, b->id);
    gl->api.DispatchCompute(32, 1, 1);
    REQUIRE_OK(irb_buffer_read(b, 0, sizeof out->histogram, out->histogram, &err));
    irb_buffer_destroy(b);
    irb_program_destroy(p);
}

static void render(enum irb_backend backend, struct result *out, bool *software)
{
    struct irb_gl *gl = fixture_gl(backend, folder);
    *software = gl->software;
    draw(gl, out);
    dispatch(gl, out);
    assert_int_equal(gl->bytes, 0);
    irb_gl_destroy(gl);
}

static void compare(enum irb_backend first, const char *threads_first, enum irb_backend second,
                    const char *threads_second)
{
    struct result a = {0}, b = {0};
    bool software[2];
    setenv("LP_NUM_THREADS", threads_first, 1); /* llvmpipe reads it for each context */
    render(first, &a, &software[0]);
    setenv("LP_NUM_THREADS", threads_second, 1);
    render(second, &b, &software[1]);
    if (!software[0] || !software[1]) {
        print_message("not compared: a GPU's bits are its own\n");
    } else {
        size_t bytes = irb_image_pixels(&a.image) * 4 * sizeof(float);
        double sum = 0;
        for (size_t i = 0; i < bytes / sizeof(float); i++)
            sum += isfinite(a.image.data[i]) ? fabs(a.image.data[i]) : 0;
        REQUIRE_CMP(sum, >, WIDTH * HEIGHT); /* something was drawn */
        REQUIRE_CMP(a.histogram[0], !=, 0);
        assert_memory_equal(a.image.data, b.image.data, bytes);
        assert_memory_equal(a.histogram, b.histogram, sizeof a.histogram);
    }
    irb_image_destroy(&a.image);
    irb_image_destroy(&b.image);
}

static void test_backends_agree(void **data)
{
    (void)data;
    compare(IRB_BACKEND_OSMESA, "2", IRB_BACKEND_EGL, "2");
}

static void test_repeats_agree(void **data)
{
    (void)data;
    compare(IRB_BACKEND_EGL, "2", IRB_BACKEND_EGL, "2");
    compare(IRB_BACKEND_OSMESA, "2", IRB_BACKEND_OSMESA, "2");
}

static void test_thread_count_does_not_matter(void **data)
{
    (void)data;
    compare(IRB_BACKEND_OSMESA, "1", IRB_BACKEND_OSMESA, "2");
    compare(IRB_BACKEND_EGL, "2", IRB_BACKEND_EGL, "3");
}

int main(void)
{
    irb_gl_destroy(fixture_gl(IRB_BACKEND_OSMESA, NULL)); /* skips where one is missing */
    irb_gl_destroy(fixture_gl(IRB_BACKEND_EGL, NULL));
    folder = fixture_folder();
    fixture_write(folder, "t/bits.frag", fragment);
    fixture_write(folder, "t/bits.comp", compute);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_backends_agree),
        cmocka_unit_test(test_repeats_agree),
        cmocka_unit_test(test_thread_count_does_not_matter),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    fixture_remove(folder);
    return failed;
}
