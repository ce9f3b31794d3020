/* SPDX-License-Identifier: MIT
 *
 * PNG files and decoding from memory.
 */
#include "core/image/exr.h"
#include "core/image/imageio.h"

#include "core/base/fs.h"
#include "core/base/str.h"
#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

static struct irb_error err;

struct folder {
    char path[64];
};

static int make_folder(void **state)
{
    struct folder *folder = calloc(1, sizeof *folder);
    snprintf(folder->path, sizeof folder->path, "/tmp/irb-png-XXXXXX");
    *state = folder;
    return mkdtemp(folder->path) ? 0 : -1;
}

static int remove_folder(void **state)
{
    char *command = irb_asprintf("rm -rf '%s'", ((struct folder *)*state)->path);
    int status = system(command);
    free(command);
    free(*state);
    return status;
}

static const char *in_folder(void **state, const char *name, char out[128])
{
    snprintf(out, 128, "%s/%s", ((struct folder *)*state)->path, name);
    return out;
}

/* Every 8-bit value; row 0 differs from the last. */
static struct irb_image ramp(int channels)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, 256, 3, channels, &err));
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 256; x++)
            for (int c = 0; c < channels; c++)
                irb_image_at(&image, x, y)[c] = (float)((x + 40 * y + 80 * c) & 255) / 255.0f;
    return image;
}

static void png_round_trip(void **state)
{
    char path[128];
    for (int channels = 1; channels <= 3; channels += 2) {
        struct irb_image image = ramp(channels);
        REQUIRE_OK(irb_png_write(in_folder(state, "ramp.png", path), &image, &err));
        char *bytes;
        size_t size;
        REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &size, &err));
        int width, height;
        unsigned char *rgba;
        REQUIRE_OK(irb_image_decode("ramp", bytes, size, &width, &height, &rgba, &err));
        assert_int_equal(width, 256);
        assert_int_equal(height, 3);
        for (int i = 0; i < 256 * 3; i++)
            for (int c = 0; c < 4; c++) {
                int source = channels == 1 ? 0 : c;
                int expected = c == 3 ? 255 : (i % 256 + 40 * (i / 256) + 80 * source) & 255;
                assert_int_equal(rgba[4 * i + c], expected);
            }
        free(rgba);
        free(bytes);
        irb_image_destroy(&image);
    }
}

static void values_are_clamped(void **state)
{
    char path[128];
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, 6, 1, 1, &err));
    const float values[6] = {-1, 2, NAN, INFINITY, -INFINITY, 0.5f};
    const int expected[6] = {0, 255, 0, 255, 0, 128};
    memcpy(image.data, values, sizeof values);
    REQUIRE_OK(irb_png_write(in_folder(state, "clamp.png", path), &image, &err));
    char *bytes;
    size_t size;
    int width, height;
    unsigned char *rgba;
    REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &size, &err));
    REQUIRE_OK(irb_image_decode(path, bytes, size, &width, &height, &rgba, &err));
    for (int i = 0; i < 6; i++)
        assert_int_equal(rgba[4 * i], expected[i]);
    free(rgba);
    free(bytes);
    irb_image_destroy(&image);
}

static void equal_images_give_equal_files(void **state)
{
    char path[2][128];
    char *bytes[2];
    size_t size[2];
    struct irb_image image = ramp(3);
    for (int i = 0; i < 2; i++) {
        if (i)
            sleep(1); /* a time of writing in the file would show */
        in_folder(state, i ? "b.png" : "a.png", path[i]);
        REQUIRE_OK(irb_png_write(path[i], &image, &err));
        REQUIRE_OK(irb_fs_read(path[i], 1 << 20, &bytes[i], &size[i], &err));
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    free(bytes[0]);
    free(bytes[1]);
    irb_image_destroy(&image);
}

/* Reads back linear: sRGB 128/255 is 0.21586 (IEC 61966-2-1). */
/* Smooth pictures come back within a few codes, colour edges too; the quality sets the size. */
static void jpeg_round_trip(void **state)
{
    char path[128], again[128];
    for (int channels = 1; channels <= 3; channels += 2) {
        struct irb_image image;
        size_t sizes[2];
        char *bytes, *same;
        REQUIRE_OK(irb_image_create(&image, 67, 41, channels, &err));
        for (int y = 0; y < 41; y++)
            for (int x = 0; x < 67; x++)
                for (int c = 0; c < channels; c++)
                    irb_image_at(&image, x, y)[c] =
                        c == 1 ? (x < 32 ? 0.2f : 0.8f) : (float)(x + y) / 106;
        image.data[0] = NAN;
        REQUIRE_OK(irb_jpeg_write(in_folder(state, "a.jpg", path), &image, 90, &err));
        REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &sizes[0], &err));
        REQUIRE_OK(irb_jpeg_write(in_folder(state, "b.jpg", again), &image, 90, &err));
        REQUIRE_OK(irb_fs_read(again, 1 << 20, &same, &sizes[1], &err));
        assert_int_equal(sizes[0], sizes[1]);
        assert_memory_equal(bytes, same, sizes[0]);
        int width, height;
        unsigned char *rgba;
        REQUIRE_OK(irb_image_decode("picture", bytes, sizes[0], &width, &height, &rgba, &err));
        assert_int_equal(width, 67);
        assert_int_equal(height, 41);
        for (int i = 1; i < 67 * 41; i++)
            for (int c = 0; c < 3; c++)
                REQUIRE_NEAR(rgba[4 * i + c], 255 * image.data[channels * i + c % channels], 14);
        free(rgba);
        free(same);
        free(bytes);
        REQUIRE_OK(irb_jpeg_write(again, &image, 20, &err));
        REQUIRE_OK(irb_fs_read(again, 1 << 20, &same, &sizes[1], &err));
        REQUIRE_CMP(sizes[1], <, sizes[0]);
        free(same);
        irb_image_destroy(&image);
    }
    struct irb_image two;
    REQUIRE_OK(irb_image_create(&two, 4, 4, 2, &err));
    assert_false(irb_jpeg_write(path, &two, 90, &err));
    assert_non_null(strstr(err.message, "1 or 3 channels"));
    irb_image_destroy(&two);
    REQUIRE_OK(irb_image_create(&two, 4, 4, 1, &err));
    assert_false(irb_jpeg_write("/nowhere/a.jpg", &two, 90, &err));
    assert_int_equal(err.code, IRB_E_IO);
    irb_image_destroy(&two);
}

static void srgb_files_are_linearised(void **state)
{
    char path[128];
    struct irb_image image = ramp(3), back;
    REQUIRE_OK(irb_png_write(in_folder(state, "srgb.png", path), &image, &err));
    REQUIRE_OK(irb_image_read_rgb(path, &back, &err));
    REQUIRE_NEAR(irb_image_at(&back, 128, 0)[0], 0.215861, 1e-5);
    REQUIRE_NEAR(irb_image_at(&back, 255, 0)[0], 1, 1e-6);
    irb_image_destroy(&back);
    irb_image_destroy(&image);
}

/* Of a file with many layers the default layer is shown, unchanged. */
static void exr_default_layer_is_read(void **state)
{
    char path[128];
    struct irb_image a = ramp(3), b = ramp(3), back;
    for (int i = 0; i < 256 * 9; i++)
        b.data[i] *= -7;
    const struct irb_exr_layer layers[] = {{"a", "RGB", &a}, {"", "RGB", &b}, {"z", "RGB", &a}};
    REQUIRE_OK(
        irb_exr_write(in_folder(state, "l.exr", path), layers, 3, NULL, 0, IRB_EXR_ZIP, &err));
    REQUIRE_OK(irb_image_read_rgb(path, &back, &err));
    assert_memory_equal(back.data, b.data, 256 * 9 * sizeof(float));
    irb_image_destroy(&back);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

static void require_text(const char *text, const char *expected)
{
    if (!strstr(text, expected))
        fail_msg("expected '%s' in '%s'", expected, text);
    assert_null(strchr(text, '\n'));
}

static void bad_input_is_named(void **state)
{
    char path[128];
    struct irb_image image = ramp(3), back;
    int width, height;
    unsigned char *rgba = NULL;
    assert_false(irb_image_decode("a.glb: texture 3", "rubbish", 7, &width, &height, &rgba, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    require_text(err.message, "a.glb: texture 3");
    assert_false(irb_image_decode("nothing", "", 0, &width, &height, &rgba, &err));
    require_text(err.message, "nothing");
    assert_false(irb_image_read_rgb(in_folder(state, "absent.png", path), &back, &err));
    require_text(err.message, "no such file");
    assert_false(irb_png_write("/nonexistent/a.png", &image, &err));
    assert_int_equal(err.code, IRB_E_IO);
    require_text(err.message, "/nonexistent/a.png");
    irb_image_destroy(&image);
}

/* libpng leaves OpenImageIO by longjmp, past destructors: its leaks are not ours to find. */
static void library_may_leak(bool on)
{
#ifdef __SANITIZE_ADDRESS__
    if (on)
        __lsan_disable();
    else
        __lsan_enable();
#else
    (void)on;
#endif
}

/* Cut or changed anywhere: decoded or refused, never a crash. */
static void damaged_images_never_crash(void **state)
{
    char path[128];
    struct irb_image image = ramp(3);
    REQUIRE_OK(irb_png_write(in_folder(state, "good.png", path), &image, &err));
    char *bytes;
    size_t size;
    int width, height;
    unsigned char *rgba;
    REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &size, &err));
    library_may_leak(true);
    for (size_t length = 0; length < size; length += 1 + length / 16)
        if (irb_image_decode("cut", bytes, length, &width, &height, &rgba, &err))
            free(rgba);
    for (size_t at = 0; at < size; at += 1 + at / 16) {
        bytes[at] = (char)~bytes[at];
        if (irb_image_decode("bad", bytes, size, &width, &height, &rgba, &err))
            free(rgba);
        bytes[at] = (char)~bytes[at];
    }
    library_may_leak(false);
    free(bytes);
    irb_image_destroy(&image);
}

int main(void)
{
#if !IRB_HAVE_IMAGES
    fprintf(stderr, "skipped: this build has no OpenImageIO\n");
    return TEST_SKIPPED;
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_round_trip),
        cmocka_unit_test(values_are_clamped),
        cmocka_unit_test(equal_images_give_equal_files),
        cmocka_unit_test(jpeg_round_trip),
        cmocka_unit_test(srgb_files_are_linearised),
        cmocka_unit_test(exr_default_layer_is_read),
        cmocka_unit_test(bad_input_is_named),
        cmocka_unit_test(damaged_images_never_crash),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
