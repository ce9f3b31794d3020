/* SPDX-License-Identifier: MIT
 *
 * EXR files: what is written comes back bit for bit, other readers see it, damage is reported.
 */
#include "core/image/exr.h"

#include "core/base/clock.h"
#include "core/base/fs.h"
#include "core/base/hash.h"
#include "core/base/str.h"
#include "tests/support/compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct irb_error err;

struct folder {
    char path[64];
};

static int make_folder(void **state)
{
    struct folder *folder = calloc(1, sizeof *folder);
    snprintf(folder->path, sizeof folder->path, "/tmp/irb-exr-XXXXXX");
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

/* Noise over many magnitudes: nothing that a lossy step would keep. */
static struct irb_image noise(int width, int height, int channels, uint64_t seed)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, width, height, channels, &err));
    for (size_t i = 0; i < irb_image_pixels(&image) * (size_t)channels; i++) {
        uint64_t bits = irb_hash_mix(seed, i);
        image.data[i] = ldexpf((float)(bits & 0xffffff) - 8388608.0f, (int)(bits >> 58) - 40);
    }
    return image;
}

static void require_equal(const struct irb_image *a, const struct irb_image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channels, b->channels);
    assert_memory_equal(a->data, b->data,
                        irb_image_pixels(a) * (size_t)a->channels * sizeof *a->data);
}

/* Layers in an order that is not the alphabetical one of the file. */
static void write_layers(const char *path, const struct irb_image image[4],
                         enum irb_exr_compression compression)
{
    const struct irb_exr_layer layers[] = {
        {"zeta", "RGB", &image[0]},
        {"", "RGB", &image[1]},
        {"a_layer_with_a_name_of_more_than_31_characters", "XYZ", &image[2]},
        {"depth", "Z", &image[3]},
    };
    const struct irb_exr_attribute attributes[] = {
        {"irbench:commit", "0123456789abcdef"},
        {"empty", ""},
        {"none", NULL},
        {"an_attribute_whose_name_is_longer_than_31", "value with spaces, \"quotes\""},
    };
    REQUIRE_OK(irb_exr_write(path, layers, 4, attributes, 4, compression, &err));
}

static void round_trip(void **state, int width, int height, enum irb_exr_compression compression)
{
    char path[128];
    in_folder(state, "layers.exr", path);
    const int channels[4] = {3, 3, 3, 1};
    struct irb_image image[4], back[4];
    for (int i = 0; i < 4; i++)
        image[i] = noise(width, height, channels[i], 17u + (unsigned)i);
    write_layers(path, image, compression);
    const struct irb_exr_layer wanted[] = {
        {"depth", "Z", NULL},
        {"zeta", "RGB", NULL},
        {"a_layer_with_a_name_of_more_than_31_characters", "XYZ", NULL},
        {"", "RGB", NULL}};
    const int source[4] = {3, 0, 2, 1};
    REQUIRE_OK(irb_exr_read_layers(path, wanted, back, 4, &err));
    for (int i = 0; i < 4; i++) {
        require_equal(&back[i], &image[source[i]]);
        irb_image_destroy(&back[i]);
    }
    /* One channel of a layer alone. */
    REQUIRE_OK(irb_exr_read(path, "zeta", "G", &back[0], &err));
    for (size_t i = 0; i < irb_image_pixels(&back[0]); i++)
        assert_memory_equal(&back[0].data[i], &image[0].data[3 * i + 1], sizeof(float));
    irb_image_destroy(&back[0]);
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&image[i]);
}

static void values_come_back_bit_for_bit(void **state)
{
    /* Sizes around ZIP's 16 lines a chunk. */
    const int sizes[][2] = {{1, 1}, {37, 1}, {1, 33}, {64, 16}, {61, 47}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        round_trip(state, sizes[i][0], sizes[i][1], IRB_EXR_NONE);
        round_trip(state, sizes[i][0], sizes[i][1], IRB_EXR_ZIP);
    }
}

static void non_finite_values_survive(void **state)
{
    char path[128];
    in_folder(state, "nan.exr", path);
    struct irb_image image = noise(3, 2, 1, 1), back;
    image.data[0] = NAN;
    image.data[1] = INFINITY;
    image.data[2] = -0.0f;
    image.data[3] = 1e-42f; /* subnormal */
    const struct irb_exr_layer layer = {"", "Y", &image};
    REQUIRE_OK(irb_exr_write(path, &layer, 1, NULL, 0, IRB_EXR_ZIP, &err));
    REQUIRE_OK(irb_exr_read(path, "", "Y", &back, &err));
    require_equal(&back, &image);
    irb_image_destroy(&back);
    irb_image_destroy(&image);
}

static void equal_images_give_equal_files(void **state)
{
    char a[128], b[128];
    struct irb_image image[4];
    for (int i = 0; i < 4; i++)
        image[i] = noise(20, 20, i == 3 ? 1 : 3, 5);
    write_layers(in_folder(state, "a.exr", a), image, IRB_EXR_ZIP);
    write_layers(in_folder(state, "b.exr", b), image, IRB_EXR_ZIP);
    char *bytes[2];
    size_t size[2];
    REQUIRE_OK(irb_fs_read(a, 1 << 20, &bytes[0], &size[0], &err));
    REQUIRE_OK(irb_fs_read(b, 1 << 20, &bytes[1], &size[1], &err));
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    for (int i = 0; i < 2; i++)
        free(bytes[i]);
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&image[i]);
}

/* The header's channel list, read by hand: the format wants it sorted (OpenEXR File Layout). */
static void channels_are_in_alphabetical_order(void **state)
{
    char path[128];
    struct irb_image image[4];
    for (int i = 0; i < 4; i++)
        image[i] = noise(4, 4, i == 3 ? 1 : 3, 5);
    write_layers(in_folder(state, "order.exr", path), image, IRB_EXR_NONE);
    char *bytes;
    size_t size;
    REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &size, &err));
    static const char key[] = "channels\0chlist";
    const char *list = memmem(bytes, size, key, sizeof key);
    assert_non_null(list);
    list += sizeof key + 4; /* the attribute's size */
    const char *previous = "";
    int count = 0;
    for (; *list; list += strlen(list) + 1 + 16, count++) { /* type, linear, sampling */
        if (strcmp(previous, list) >= 0)
            fail_msg("channel '%s' follows '%s'", list, previous);
        previous = list;
    }
    assert_int_equal(count, 10);
    free(bytes);
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&image[i]);
}

static char *output_of(const char *command)
{
    struct irb_str text = {0};
    FILE *pipe = popen(command, "r");
    char buffer[4096];
    size_t n;
    while (pipe && (n = fread(buffer, 1, sizeof buffer, pipe)) > 0)
        irb_str_append(&text, buffer, n);
    if (pipe)
        pclose(pipe);
    return text.text ? text.text : irb_strdup("");
}

static void require_text(const char *text, const char *expected)
{
    if (!strstr(text, expected))
        fail_msg("expected '%s' in:\n%s", expected, text);
}

static void another_reader_sees_layers_and_attributes(void **state)
{
    if (system("command -v oiiotool >/dev/null 2>&1"))
        skip();
    char path[128];
    struct irb_image image[4];
    for (int i = 0; i < 4; i++)
        image[i] = noise(12, 34, i == 3 ? 1 : 3, 5);
    write_layers(in_folder(state, "info.exr", path), image, IRB_EXR_ZIP);
    char *command = irb_asprintf("oiiotool --info -v --stats '%s' 2>&1", path);
    char *text = output_of(command);
    require_text(text, "12 x   34, 10 channel, float openexr");
    require_text(text, "zeta.R, zeta.G, zeta.B");
    require_text(text, "depth.Z");
    require_text(text, "irbench:commit: \"0123456789abcdef\"");
    require_text(text, "compression: \"zip\"");
    free(text);
    free(command);
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&image[i]);
}

static void half_channels_are_read(void **state)
{
    if (system("command -v oiiotool >/dev/null 2>&1"))
        skip();
    char path[128];
    in_folder(state, "half.exr", path);
    char *command = irb_asprintf("oiiotool --pattern constant:color=0.25,1.5,-3 8x6 3 -d half "
                                 "--compression piz -o '%s' >/dev/null 2>&1",
                                 path);
    assert_int_equal(system(command), 0);
    free(command);
    struct irb_image image;
    REQUIRE_OK(irb_exr_read(path, "", "RGB", &image, &err));
    assert_int_equal(image.width, 8);
    assert_int_equal(image.height, 6);
    for (size_t i = 0; i < irb_image_pixels(&image); i++) {
        REQUIRE_NEAR(image.data[3 * i], 0.25, 0);
        REQUIRE_NEAR(image.data[3 * i + 1], 1.5, 0);
        REQUIRE_NEAR(image.data[3 * i + 2], -3, 0);
    }
    irb_image_destroy(&image);
}

static void require_failure(const char *path, const char *layer, const char *suffixes,
                            const char *expected)
{
    struct irb_image image = {1, 1, 1, NULL};
    err = (struct irb_error){0};
    if (irb_exr_read(path, layer, suffixes, &image, &err))
        fail_msg("reading %s worked, expected '%s'", path, expected);
    assert_null(image.data);
    assert_int_equal(err.code, IRB_E_INPUT);
    require_text(err.message, path);
    require_text(err.message, expected);
    assert_null(strchr(err.message, '\n'));
}

static void bad_input_is_named(void **state)
{
    char path[128];
    require_failure(in_folder(state, "absent.exr", path), "", "RGB", "No such file");
    REQUIRE_OK(irb_fs_write(in_folder(state, "text.exr", path), "hello, world", 12, &err));
    require_failure(path, "", "RGB", "expected an OpenEXR file");
    REQUIRE_OK(irb_fs_write(in_folder(state, "empty.exr", path), "", 0, &err));
    require_failure(path, "", "RGB", "expected an OpenEXR file");
    struct irb_image image[4];
    for (int i = 0; i < 4; i++)
        image[i] = noise(4, 4, i == 3 ? 1 : 3, 5);
    write_layers(in_folder(state, "good.exr", path), image, IRB_EXR_NONE);
    require_failure(path, "zeta", "RGBA", "expected a channel 'zeta.A'");
    require_failure(path, "nonsense", "Y", "expected a channel 'nonsense.Y'");
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&image[i]);
}

static void wrong_use_is_refused(void **state)
{
    char path[128];
    in_folder(state, "wrong.exr", path);
    struct irb_image a = noise(4, 4, 3, 1), b = noise(5, 4, 3, 1);
    const struct irb_exr_layer sizes[] = {{"a", "RGB", &a}, {"b", "RGB", &b}};
    const struct irb_exr_layer twice[] = {{"a", "RGB", &a}, {"a", "RGB", &a}};
    const struct irb_exr_layer names = {"a", "RG", &a};
    assert_false(irb_exr_write(path, sizes, 2, NULL, 0, IRB_EXR_NONE, &err));
    assert_false(irb_exr_write(path, twice, 2, NULL, 0, IRB_EXR_NONE, &err));
    assert_false(irb_exr_write(path, &names, 1, NULL, 0, IRB_EXR_NONE, &err));
    assert_false(irb_fs_exists(path));
    assert_false(irb_exr_write("/nonexistent/folder/a.exr", sizes, 1, NULL, 0, IRB_EXR_NONE, &err));
    assert_int_equal(err.code, IRB_E_IO);
    require_text(err.message, "/nonexistent/folder/a.exr");
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

/* Cut anywhere: an error, never a crash or an image. */
static void truncated_files_are_refused(void **state)
{
    char path[128], cut[128];
    in_folder(state, "cut.exr", cut);
    struct irb_image image[4], back;
    for (int i = 0; i < 4; i++)
        image[i] = noise(9, 40, i == 3 ? 1 : 3, 5);
    for (int compression = IRB_EXR_NONE; compression <= IRB_EXR_ZIP; compression++) {
        write_layers(in_folder(state, "whole.exr", path), image,
                     (enum irb_exr_compression)compression);
        char *bytes;
        size_t size;
        REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &size, &err));
        for (size_t length = 0; length < size; length += length < 1500 ? 1 : 97) {
            REQUIRE_OK(irb_fs_write(cut, bytes, length, &err));
            err = (struct irb_error){0};
            if (irb_exr_read(cut, "zeta", "RGB", &back, &err))
                fail_msg("a file cut at %zu of %zu bytes was read", length, size);
            assert_null(back.data);
            assert_int_equal(err.code, IRB_E_INPUT);
            require_text(err.message, cut);
        }
        free(bytes);
    }
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&image[i]);
}

/* Any byte changed: read or refused, never a crash; the sanitizer build looks for the rest. */
static void damaged_files_never_crash(void **state)
{
    char path[128], bad[128];
    in_folder(state, "bad.exr", bad);
    struct irb_image image[4], back;
    for (int i = 0; i < 4; i++)
        image[i] = noise(9, 40, i == 3 ? 1 : 3, 5);
    write_layers(in_folder(state, "whole.exr", path), image, IRB_EXR_ZIP);
    char *bytes;
    size_t size;
    REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &size, &err));
    int refused = 0;
    for (size_t at = 0; at < size; at += at < 1200 ? 1 : 61)
        for (int pattern = 0; pattern < 3; pattern++) {
            char kept = bytes[at];
            bytes[at] = (char)(pattern == 0 ? kept ^ 0x80 : pattern == 1 ? 0xff : kept + 1);
            REQUIRE_OK(irb_fs_write(bad, bytes, size, &err));
            bytes[at] = kept;
            err = (struct irb_error){0};
            if (irb_exr_read(bad, "zeta", "RGB", &back, &err))
                irb_image_destroy(&back);
            else
                refused++;
        }
    REQUIRE_CMP(refused, >, 500);
    free(bytes);
    for (int i = 0; i < 4; i++)
        irb_image_destroy(&image[i]);
}

/* A header that promises more pixels than the file can hold must not cost memory. */
static void absurd_sizes_are_refused(void **state)
{
    char path[128];
    struct irb_image image = noise(8, 8, 3, 1);
    const struct irb_exr_layer layer = {"", "RGB", &image};
    for (int compression = IRB_EXR_NONE; compression <= IRB_EXR_ZIP; compression++) {
        REQUIRE_OK(irb_exr_write(in_folder(state, "huge.exr", path), &layer, 1, NULL, 0,
                                 (enum irb_exr_compression)compression, &err));
        char *bytes;
        size_t size;
        REQUIRE_OK(irb_fs_read(path, 1 << 20, &bytes, &size, &err));
        static const char key[] = "dataWindow\0box2i";
        char *window = memmem(bytes, size, key, sizeof key);
        assert_non_null(window);
        const int32_t sides[] = {16383, 99999, INT32_MAX};
        for (int i = 0; i < 3; i++) {
            memcpy(window + sizeof key + 4 + 8, &sides[i], 4);
            memcpy(window + sizeof key + 4 + 12, &sides[i], 4);
            REQUIRE_OK(irb_fs_write(path, bytes, size, &err));
            require_failure(path, "", "RGB", path);
        }
        free(bytes);
    }
    irb_image_destroy(&image);
}

/* A frame's layers must cost little beside rendering it (2 ms on an idle machine; the bound here
 * leaves room for busy ones). */
static void writing_is_quick(void **state)
{
    char path[128];
    in_folder(state, "quick.exr", path);
    struct irb_image a = noise(256, 192, 3, 1), b = noise(256, 192, 3, 2);
    const struct irb_exr_layer layers[] = {{"indirect", "RGB", &a}, {"", "RGB", &b}};
    double best = INFINITY;
    for (int i = 0; i < 15; i++) {
        double start = irb_clock_s();
        REQUIRE_OK(irb_exr_write(path, layers, 2, NULL, 0, IRB_EXR_NONE, &err));
        double seconds = irb_clock_s() - start;
        best = seconds < best ? seconds : best;
    }
    print_message("256 x 192 x 6 channels, uncompressed: %.2f ms\n", 1e3 * best);
    REQUIRE_CMP(best, <, 0.02);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_come_back_bit_for_bit),
        cmocka_unit_test(non_finite_values_survive),
        cmocka_unit_test(equal_images_give_equal_files),
        cmocka_unit_test(channels_are_in_alphabetical_order),
        cmocka_unit_test(another_reader_sees_layers_and_attributes),
        cmocka_unit_test(half_channels_are_read),
        cmocka_unit_test(bad_input_is_named),
        cmocka_unit_test(wrong_use_is_refused),
        cmocka_unit_test(truncated_files_are_refused),
        cmocka_unit_test(damaged_files_never_crash),
        cmocka_unit_test(absurd_sizes_are_refused),
        cmocka_unit_test(writing_is_quick),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
