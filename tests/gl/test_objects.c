/* SPDX-License-Identifier: MIT
 *
 * Textures, buffers and framebuffers: contents, sizes, errors.
 */
#include "tests/support/compare.h"
#include "tests/gl/fixture.h"

#include "core/gl/objects.h"

static struct irb_gl *gl;
static struct irb_error err;

static struct irb_texture *texture(unsigned format, int width, int height, int layers)
{
    struct irb_texture *t = irb_texture_create(
        gl,
        &(struct irb_texture_desc){
            .name = "test", .format = format, .width = width, .height = height, .layers = layers},
        &err);
    if (!t)
        fail_msg("%s", err.message);
    return t;
}

/* Every value differs, and so does its place. */
static void fill(struct irb_image *image)
{
    for (size_t i = 0; i < irb_image_pixels(image) * (size_t)image->channels; i++)
        image->data[i] = (float)i * 0.25f - 3;
}

static void round_trip(unsigned format, int layers, int channels)
{
    const int width = 5, height = 3;
    struct irb_texture *t = texture(format, width, height, layers);
    struct irb_image in = {0}, out = {0};
    REQUIRE_OK(irb_image_create(&in, width, height * (layers ? layers : 1), channels, &err));
    fill(&in);
    REQUIRE_OK(irb_texture_write(t, &in, &err));
    REQUIRE_OK(irb_texture_read(t, channels, &out, &err));
    assert_int_equal(out.width, in.width);
    assert_int_equal(out.height, in.height);
    assert_int_equal(out.channels, channels);
    size_t bytes = irb_image_pixels(&in) * (size_t)channels * sizeof(float);
    assert_memory_equal(in.data, out.data, bytes);
    irb_image_destroy(&in);
    irb_image_destroy(&out);
    irb_texture_destroy(t);
}

static void test_round_trip(void **data)
{
    (void)data;
    round_trip(GL_R32F, 0, 1);
    round_trip(GL_RG32F, 0, 2);
    round_trip(GL_RGB32F, 0, 3);
    round_trip(GL_RGBA32F, 0, 4);
    round_trip(GL_RGBA32F, 2, 4);
}

/* OpenGL's row 0 (lowest) is the image's last row. */
static void test_rows_are_flipped(void **data)
{
    (void)data;
    struct irb_texture *t = texture(GL_R32F, 2, 3, 0);
    const float rows[6] = {0, 1, 10, 11, 20, 21};
    gl->api.TextureSubImage2D(t->id, 0, 0, 0, 2, 3, GL_RED, GL_FLOAT, rows);
    struct irb_image image = {0};
    REQUIRE_OK(irb_texture_read(t, 1, &image, &err));
    static const float expected[6] = {20, 21, 10, 11, 0, 1};
    for (int i = 0; i < 6; i++)
        REQUIRE_NEAR(image.data[i], expected[i], 0);
    irb_image_destroy(&image);
    irb_texture_destroy(t);
}

static void test_depth(void **data)
{
    (void)data;
    struct irb_texture *t = texture(GL_DEPTH_COMPONENT32F, 4, 4, 0);
    struct irb_framebuffer *f = irb_framebuffer_create(gl, "depth only", NULL, 0, t, &err);
    REQUIRE_OK(f);
    irb_framebuffer_bind(f);
    gl->api.DepthMask(GL_TRUE);
    gl->api.ClearBufferfv(GL_DEPTH, 0, (const float[]){0.25f});
    struct irb_image image = {0};
    REQUIRE_OK(irb_texture_read(t, 1, &image, &err));
    for (int i = 0; i < 16; i++)
        REQUIRE_NEAR(image.data[i], 0.25, 0);
    irb_image_destroy(&image);
    assert_false(irb_texture_read(t, 4, &image, &err));
    REQUIRE_CONTAINS(err.message, "GL_DEPTH_COMPONENT32F");
    irb_framebuffer_destroy(f);
    irb_texture_destroy(t);
}

static void test_bytes(void **data)
{
    (void)data;
    int64_t start = gl->bytes;
    struct irb_texture *a = texture(GL_RGBA32F, 10, 6, 3);
    assert_int_equal(gl->bytes - start, 10 * 6 * 3 * 16);
    struct irb_texture_desc mips = {.format = GL_R32UI, .width = 8, .height = 4, .levels = 4};
    struct irb_texture *b = irb_texture_create(gl, &mips, &err);
    REQUIRE_OK(b);
    assert_int_equal(b->bytes, (8 * 4 + 4 * 2 + 2 * 1 + 1 * 1) * 4);
    struct irb_buffer *c = irb_buffer_create(gl, "c", 100, NULL, &err);
    REQUIRE_OK(c);
    int64_t all = 10 * 6 * 3 * 16 + 43 * 4 + 100;
    assert_int_equal(gl->bytes - start, all);
    REQUIRE_CMP(gl->peak_bytes, >=, all);
    irb_texture_destroy(a);
    irb_texture_destroy(b);
    irb_buffer_destroy(c);
    assert_int_equal(gl->bytes, start);
    irb_texture_destroy(NULL);
    irb_buffer_destroy(NULL);
    irb_framebuffer_destroy(NULL);
}

static void test_texture_errors(void **data)
{
    (void)data;
    int64_t start = gl->bytes, peak = gl->peak_bytes;
    static const struct {
        struct irb_texture_desc desc;
        const char *part;
    } cases[] = {
        {{.name = "a", .format = GL_RGBA32F, .width = 0, .height = 4}, "a: expected a size of 1.."},
        {{.name = "a", .format = GL_RGBA32F, .width = 4, .height = 1 << 30},
         "found 4 x 1073741824"},
        {{.name = "a", .format = 0x1234, .width = 4, .height = 4}, "a: texture format 0x1234"},
        {{.name = "a", .format = GL_R8, .width = 4, .height = 4, .levels = 4}, "0..3 levels"},
        {{.name = "a", .format = GL_R8, .width = 4, .height = 4, .layers = -1}, "layers, found -1"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_null(irb_texture_create(gl, &cases[i].desc, &err));
        REQUIRE_CONTAINS(err.message, cases[i].part);
        REQUIRE_ONE_LINE(err.message);
    }
    struct irb_texture *integer = texture(GL_R32UI, 2, 2, 0);
    struct irb_image image = {0};
    assert_false(irb_texture_read(integer, 1, &image, &err));
    REQUIRE_CONTAINS(err.message, "test: GL_R32UI cannot be exchanged as 1 float channels");
    REQUIRE_OK(irb_image_create(&image, 3, 2, 1, &err));
    struct irb_texture *t = texture(GL_R32F, 2, 2, 0);
    assert_false(irb_texture_write(t, &image, &err));
    assert_string_equal(err.message, "test: expected an image of 2 x 2, found 3 x 2");
    irb_image_destroy(&image);
    irb_texture_destroy(t);
    irb_texture_destroy(integer);
    assert_int_equal(gl->bytes, start);
    assert_int_equal(gl->peak_bytes, peak);
}

static void test_buffer(void **data)
{
    (void)data;
    uint32_t in[64], out[64];
    for (uint32_t i = 0; i < 64; i++)
        in[i] = i * 2654435761u;
    struct irb_buffer *b = irb_buffer_create(gl, "lights", sizeof in, in, &err);
    REQUIRE_OK(b);
    REQUIRE_OK(irb_buffer_read(b, 0, sizeof out, out, &err));
    assert_memory_equal(in, out, sizeof in);
    in[5] = 7;
    REQUIRE_OK(irb_buffer_write(b, 5 * 4, 4, &in[5], &err));
    REQUIRE_OK(irb_buffer_read(b, 4 * 4, 3 * 4, out, &err));
    assert_memory_equal(&in[4], out, 3 * 4);
    assert_false(irb_buffer_read(b, 4, sizeof out, out, &err));
    assert_string_equal(err.message, "lights: bytes 4 to 260 lie outside its 256");
    assert_false(irb_buffer_write(b, -4, 4, in, &err));
    irb_buffer_destroy(b);
}

static void test_buffer_too_large(void **data)
{
    (void)data;
    int64_t peak = gl->peak_bytes;
    assert_null(irb_buffer_create(gl, "huge", (int64_t)1 << 45, NULL, &err));
    assert_int_equal(err.code, IRB_E_MEMORY);
    REQUIRE_CONTAINS(err.message, "huge: ");
    assert_int_equal(gl->peak_bytes, peak);
    assert_null(irb_buffer_create(gl, "empty", 0, NULL, &err));
    REQUIRE_CONTAINS(err.message, "empty: expected at least 1 byte");
}

static void test_framebuffer_incomplete(void **data)
{
    (void)data;
    struct irb_texture *small = texture(GL_RGBA32F, 4, 4, 0), *wide = texture(GL_RGBA32F, 8, 4, 0);
    struct irb_texture *shared = texture(GL_RGB9_E5, 4, 4, 0); /* not renderable (4.5, 9.4) */
    struct irb_texture *depth = texture(GL_DEPTH_COMPONENT32F, 4, 4, 0);
    struct irb_texture *mixed[] = {small, wide};
    assert_null(irb_framebuffer_create(gl, "fb", mixed, 2, NULL, &err));
    assert_string_equal(err.message,
                        "fb: framebuffer incomplete: attachments of 4 x 4 x 0 and 8 x 4 x 0");
    assert_null(irb_framebuffer_create(gl, "fb", NULL, 0, NULL, &err));
    REQUIRE_CONTAINS(err.message, "fb: framebuffer incomplete");
    assert_null(irb_framebuffer_create(gl, "fb", &depth, 1, NULL, &err));
    REQUIRE_CONTAINS(err.message, "GL_DEPTH_COMPONENT32F as colour");
    assert_null(irb_framebuffer_create(gl, "fb", NULL, 0, small, &err));
    REQUIRE_CONTAINS(err.message, "GL_RGBA32F as depth");
    assert_null(irb_framebuffer_create(gl, "fb", &shared, 1, NULL, &err));
    REQUIRE_CONTAINS(err.message, "fb: framebuffer incomplete: ");
    REQUIRE_OK(irb_gl_check(gl, "after", &err));
    irb_texture_destroy(small);
    irb_texture_destroy(wide);
    irb_texture_destroy(shared);
    irb_texture_destroy(depth);
}

static void test_framebuffer_clears_each_attachment(void **data)
{
    (void)data;
    struct irb_texture *t[] = {texture(GL_RGBA32F, 6, 2, 0), texture(GL_R32F, 6, 2, 0)};
    struct irb_framebuffer *f = irb_framebuffer_create(gl, "fb", t, 2, NULL, &err);
    REQUIRE_OK(f);
    irb_framebuffer_bind(f);
    GLint viewport[4];
    gl->api.GetIntegerv(GL_VIEWPORT, viewport);
    assert_int_equal(viewport[2], 6);
    assert_int_equal(viewport[3], 2);
    gl->api.ClearBufferfv(GL_COLOR, 0, (const float[]){1, 2, 3, 4});
    gl->api.ClearBufferfv(GL_COLOR, 1, (const float[]){-5, 0, 0, 0});
    struct irb_image a = {0}, b = {0};
    REQUIRE_OK(irb_texture_read(t[0], 4, &a, &err));
    REQUIRE_OK(irb_texture_read(t[1], 1, &b, &err));
    for (int i = 0; i < 12; i++) {
        for (int c = 0; c < 4; c++)
            REQUIRE_NEAR(a.data[4 * i + c], c + 1, 0);
        REQUIRE_NEAR(b.data[i], -5, 0);
    }
    irb_image_destroy(&a);
    irb_image_destroy(&b);
    irb_framebuffer_destroy(f);
    irb_texture_destroy(t[0]);
    irb_texture_destroy(t[1]);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_rows_are_flipped),
        cmocka_unit_test(test_depth),
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_texture_errors),
        cmocka_unit_test(test_buffer),
        cmocka_unit_test(test_buffer_too_large),
        cmocka_unit_test(test_framebuffer_incomplete),
        cmocka_unit_test(test_framebuffer_clears_each_attachment),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
