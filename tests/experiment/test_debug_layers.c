/* SPDX-License-Identifier: MIT
 *
 * Debug layers from a method's textures through the files of a run to PNGs.
 */
#include "core/experiment/debug_layers.h"
#include "core/experiment/frame_file.h"
#include "core/gl/objects.h"
#include "core/image/imageio.h"
#include "tests/support/compare.h"

#include "tests/gl/fixture.h"

#include <GL/glcorearb.h>
#include <stdint.h>

enum { WIDTH = 6, HEIGHT = 4, ATLAS = 8 };

static enum irb_backend backend;

static struct irb_texture *make_texture(struct irb_gl *gl, unsigned format, int width, int height)
{
    struct irb_error err = {0};
    struct irb_texture *texture =
        irb_texture_create(gl,
                           &(struct irb_texture_desc){
                               .name = "test", .format = format, .width = width, .height = height},
                           &err);
    REQUIRE_OK(texture);
    return texture;
}

/* Texel (x, y), y upwards, holds value(x, y, channel). */
typedef float (*value_fn)(int x, int y, int c);

static struct irb_texture *float_texture(struct irb_gl *gl, unsigned format, int width, int height,
                                         value_fn value)
{
    struct irb_error err = {0};
    struct irb_image image;
    int channels = format == GL_R32F ? 1 : 4;
    struct irb_texture *texture = make_texture(gl, format, width, height);
    REQUIRE_OK(irb_image_create(&image, width, height, channels, &err));
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < channels; c++)
                irb_image_at(&image, x, height - 1 - y)[c] = value(x, y, c);
    REQUIRE_OK(irb_texture_write(texture, &image, &err));
    irb_image_destroy(&image);
    return texture;
}

static struct irb_texture *uint_texture(struct irb_gl *gl, const uint32_t *texels)
{
    struct irb_texture *texture = make_texture(gl, GL_R32UI, ATLAS, ATLAS);
    gl->api.TextureSubImage2D(texture->id, 0, 0, 0, ATLAS, ATLAS, GL_RED_INTEGER, GL_UNSIGNED_INT,
                              texels);
    return texture;
}

static float map_value(int x, int y, int c)
{
    return c == 0 ? (float)x / (WIDTH - 1) : c == 1 ? (float)y / (HEIGHT - 1) : 1.5f;
}

static float light_value(int x, int y, int c)
{
    return (float)(x + 10 * y + 100 * c);
}

static float scalar_value(int x, int y, int c)
{
    (void)c;
    return x == 0 && y == 0 ? NAN : x == 1 && y == 0 ? -7 : (float)(x + y) / 4;
}

/* +Inf in the lowest row, else distances that rise with x and y. */
static float distance_value(int x, int y)
{
    return y == 0 ? INFINITY : 0.25f * (float)x + (float)y;
}

/* The textures of a method, and what it returns. */
struct output {
    struct irb_texture *irradiance, *map, *light, *scalar, *atlas, *counts;
    struct irb_frame_output frame;
};

static struct output make_output(struct irb_gl *gl)
{
    uint32_t bits[ATLAS * ATLAS], counts[ATLAS * ATLAS];
    for (int i = 0; i < ATLAS * ATLAS; i++) {
        float distance = distance_value(i % ATLAS, i / ATLAS);
        memcpy(&bits[i], &distance, sizeof distance);
        counts[i] = (uint32_t)i * 1000;
    }
    struct output o = {
        .irradiance = float_texture(gl, GL_RGBA32F, WIDTH, HEIGHT, light_value),
        .map = float_texture(gl, GL_RGBA32F, WIDTH, HEIGHT, map_value),
        .light = float_texture(gl, GL_RGBA32F, WIDTH / 2, HEIGHT / 2, light_value),
        .scalar = float_texture(gl, GL_R32F, WIDTH, HEIGHT, scalar_value),
        .atlas = uint_texture(gl, bits),
        .counts = uint_texture(gl, counts),
    };
    o.frame = (struct irb_frame_output){
        .irradiance = o.irradiance,
        .debug = {{"cluster-map", o.map, IRB_DEBUG_COLOUR},
                  {"split", o.light, IRB_DEBUG_RADIANCE},
                  {"shadow", o.scalar, IRB_DEBUG_SCALAR},
                  {"ism_atlas", o.atlas, IRB_DEBUG_DISTANCE},
                  {"counts", o.counts, IRB_DEBUG_SCALAR}},
        .debug_count = 5,
    };
    return o;
}

static void destroy_output(struct output *o)
{
    irb_texture_destroy(o->irradiance);
    irb_texture_destroy(o->map);
    irb_texture_destroy(o->light);
    irb_texture_destroy(o->scalar);
    irb_texture_destroy(o->atlas);
    irb_texture_destroy(o->counts);
}

static void expect_layers(const struct irb_debug_layers *debug)
{
    static const struct {
        const char *name;
        enum irb_debug_kind kind;
        bool apart;
        int width, height, channels;
    } expected[] = {
        {"cluster-map", IRB_DEBUG_COLOUR, false, WIDTH, HEIGHT, 3},
        {"split", IRB_DEBUG_RADIANCE, true, WIDTH / 2, HEIGHT / 2, 3},
        {"shadow", IRB_DEBUG_SCALAR, false, WIDTH, HEIGHT, 1},
        {"ism_atlas", IRB_DEBUG_DISTANCE, true, ATLAS, ATLAS, 1},
        {"counts", IRB_DEBUG_SCALAR, true, ATLAS, ATLAS, 1},
    };
    assert_int_equal(debug->count, 5);
    for (int i = 0; i < 5; i++) {
        const struct irb_debug_layer *layer = &debug->layers[i];
        assert_string_equal(layer->name, expected[i].name);
        assert_int_equal(layer->kind, expected[i].kind);
        assert_int_equal(layer->apart, expected[i].apart);
        assert_int_equal(layer->image.width, expected[i].width);
        assert_int_equal(layer->image.height, expected[i].height);
        assert_int_equal(layer->image.channels, expected[i].channels);
    }
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const float *map = irb_image_at(&debug->layers[0].image, x, HEIGHT - 1 - y);
            for (int c = 0; c < 3; c++)
                REQUIRE_NEAR(map[c], map_value(x, y, c), 0);
            float scalar = *irb_image_at(&debug->layers[2].image, x, HEIGHT - 1 - y);
            assert_true(x || y ? scalar == scalar_value(x, y, 0) : isnan(scalar));
        }
    }
    for (int y = 0; y < ATLAS; y++) {
        for (int x = 0; x < ATLAS; x++) {
            assert_true(*irb_image_at(&debug->layers[3].image, x, ATLAS - 1 - y) ==
                        distance_value(x, y));
            REQUIRE_NEAR(*irb_image_at(&debug->layers[4].image, x, ATLAS - 1 - y),
                         1000 * (y * ATLAS + x), 0);
        }
    }
}

static void expect_file(const struct irb_frame_place *place, const char *stem,
                        const char *extension, bool there)
{
    char *path = irb_frame_path(place, stem, extension);
    if (irb_fs_exists(path) != there)
        fail_msg("%s: %s", path, there ? "is missing" : "is there");
    free(path);
}

/* From the textures to the files and back, every value as it was. */
static void test_files(void **state)
{
    (void)state;
    struct irb_gl *gl = fixture_gl(backend, NULL);
    struct irb_error err = {0};
    char *folder = fixture_folder();
    const struct irb_frame_place place = {".", folder, ".", 3};
    struct output output = make_output(gl);
    struct irb_debug_layers debug, loaded;
    REQUIRE_OK(irb_debug_layers_read(&debug, &output.frame, &err));
    expect_layers(&debug);

    char *path = irb_frame_path(&place, "frame", "exr");
    REQUIRE_OK(irb_debug_layers_save_apart(&debug, &place, NULL, 0, &err));
    REQUIRE_OK(irb_frame_file_save(path, &output.frame, &debug, &err));
    expect_file(&place, "debug-split", "exr", true);
    expect_file(&place, "debug-ism_atlas", "exr", true);
    expect_file(&place, "debug-cluster-map", "exr", false);
    REQUIRE_OK(irb_debug_layers_load(&loaded, &place, &err));
    expect_layers(&loaded);
    irb_debug_layers_destroy(&loaded);
    /* the frame itself is there as ever */
    struct irb_frame_file frame;
    REQUIRE_OK(irb_frame_file_load(path, &frame, &err));
    REQUIRE_NEAR(irb_image_at(&frame.irradiance, 2, 0)[1], light_value(2, HEIGHT - 1, 1), 0);
    irb_frame_file_destroy(&frame);

    irb_debug_layers_remove_apart(&place);
    expect_file(&place, "debug-split", "exr", false);
    expect_file(&place, "debug-counts", "exr", false);
    assert_false(irb_debug_layers_load(&loaded, &place, &err));
    assert_int_equal(loaded.count, 0);
    /* a frame without layers */
    struct irb_debug_layers none = {0};
    REQUIRE_OK(irb_frame_file_save(path, &output.frame, &none, &err));
    REQUIRE_OK(irb_debug_layers_load(&loaded, &place, &err));
    assert_int_equal(loaded.count, 0);
    free(path);
    irb_debug_layers_destroy(&debug);
    destroy_output(&output);
    fixture_remove(folder);
    irb_gl_destroy(gl);
}

static struct irb_image preview_of(const struct irb_debug_layer *layer)
{
    struct irb_error err = {0};
    struct irb_image out;
    REQUIRE_OK(irb_debug_preview(layer, 0.5, &out, &err));
    for (size_t i = 0; i < irb_image_pixels(&out) * (size_t)out.channels; i++)
        assert_true(out.data[i] >= 0 && out.data[i] <= 1);
    return out;
}

static void test_previews(void **state)
{
    (void)state;
    struct irb_gl *gl = fixture_gl(backend, NULL);
    struct irb_error err = {0};
    struct output output = make_output(gl);
    struct irb_debug_layers debug;
    REQUIRE_OK(irb_debug_layers_read(&debug, &output.frame, &err));

    /* as it is, above 1 clamped */
    struct irb_image map = preview_of(&debug.layers[0]);
    REQUIRE_NEAR(irb_image_at(&map, 2, 0)[0], 0.4f, 0);
    REQUIRE_NEAR(irb_image_at(&map, 2, 0)[1], 1, 0);
    REQUIRE_NEAR(irb_image_at(&map, 2, 0)[2], 1, 0);
    irb_image_destroy(&map);
    /* Reinhard at exposure 0.5 of the texel (2, 1): RGB 12, 112, 212 and Y = 0.2126 12 + 0.7152 112
     * + 0.0722 212 = 97.9600; red 12 * 0.5/(1 + 48.98) = 0.120048 in sRGB */
    struct irb_image light = preview_of(&debug.layers[1]);
    REQUIRE_NEAR(irb_image_at(&light, 2, 0)[0], 1.055 * pow(0.120048, 1 / 2.4) - 0.055, 1e-5);
    irb_image_destroy(&light);
    /* up to the largest, 8/4; what is no number or negative is black */
    struct irb_image scalar = preview_of(&debug.layers[2]);
    assert_int_equal(scalar.channels, 1);
    REQUIRE_NEAR(*irb_image_at(&scalar, 0, HEIGHT - 1), 0, 0);
    REQUIRE_NEAR(*irb_image_at(&scalar, 1, HEIGHT - 1), 0, 0);
    REQUIRE_NEAR(*irb_image_at(&scalar, 2, HEIGHT - 1), 0.25, 0);
    REQUIRE_NEAR(*irb_image_at(&scalar, WIDTH - 1, 0), 1, 0);
    irb_image_destroy(&scalar);
    /* 8.75 m is the farthest; +Inf is black and does not count */
    struct irb_image atlas = preview_of(&debug.layers[3]);
    REQUIRE_NEAR(*irb_image_at(&atlas, 3, ATLAS - 1), 0, 0);
    REQUIRE_NEAR(*irb_image_at(&atlas, 7, 0), 1, 0);
    REQUIRE_NEAR(*irb_image_at(&atlas, 0, 0), 7 / 8.75, 1e-6);
    irb_image_destroy(&atlas);
    irb_debug_layers_destroy(&debug);
    destroy_output(&output);
    irb_gl_destroy(gl);
}

/* Nothing but +Inf, nothing but 0, and a single value: no 0/0. */
static void test_nothing_to_scale(void **state)
{
    (void)state;
    struct irb_error err = {0};
    static const float values[] = {INFINITY, 0, -1, NAN, 1e-42f, 3e38f};
    for (int i = 0; i < 6; i++) {
        struct irb_debug_layer layer = {.kind = IRB_DEBUG_DISTANCE};
        REQUIRE_OK(irb_image_create(&layer.image, 2, 1, 1, &err));
        layer.image.data[0] = layer.image.data[1] = values[i];
        struct irb_image out = preview_of(&layer);
        REQUIRE_NEAR(out.data[0], i < 4 ? 0 : 1, 0);
        irb_image_destroy(&out);
        irb_image_destroy(&layer.image);
    }
}

static void test_pngs(void **state)
{
    (void)state;
    if (!IRB_HAVE_IMAGES)
        skip();
    struct irb_error err = {0};
    char *folder = fixture_folder(), *data = NULL;
    const struct irb_frame_place place = {".", folder, ".", 12};
    struct irb_debug_layers debug = {.count = 1};
    struct irb_debug_layer *layer = &debug.layers[0];
    *layer = (struct irb_debug_layer){.name = "coverage", .kind = IRB_DEBUG_SCALAR};
    REQUIRE_OK(irb_image_create(&layer->image, 3, 1, 1, &err));
    memcpy(layer->image.data, (const float[]){INFINITY, 5, 2.5f}, 3 * sizeof(float));
    REQUIRE_OK(irb_debug_layers_show(&debug, &place, 1, &err));
    char *path = irb_frame_path(&place, "debug-coverage", "png");
    REQUIRE_CONTAINS(path, "/debug-coverage-0012.png");
    size_t size;
    int width, height;
    unsigned char *rgba;
    REQUIRE_OK(irb_fs_read(path, 1 << 20, &data, &size, &err));
    REQUIRE_OK(irb_image_decode(path, data, size, &width, &height, &rgba, &err));
    assert_int_equal(width, 3);
    static const unsigned char grey[] = {0, 255, 128};
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++)
            assert_in_range(rgba[4 * i + c], grey[i] ? grey[i] - 1 : 0, grey[i]);
    free(rgba);
    free(data);
    free(path);
    irb_debug_layers_destroy(&debug);
    fixture_remove(folder);
}

/* Files take 16384 texels a side: of an array of two layers every second texel, across and down, of
 * three every third. */
static void test_long_layers(void **state)
{
    (void)state;
    enum { SIDE = 16384, ACROSS = 5 };
    struct irb_gl *gl = fixture_gl(backend, NULL);
    struct irb_error err = {0};
    struct irb_texture *irradiance = float_texture(gl, GL_RGBA32F, WIDTH, HEIGHT, light_value);
    for (int layers = 1; layers <= 3; layers++) {
        const struct irb_texture_desc desc = {
            .name = "test", .format = GL_R32F, .width = ACROSS, .height = SIDE, .layers = layers};
        struct irb_texture *texture = irb_texture_create(gl, &desc, &err);
        struct irb_image image;
        REQUIRE_OK(texture);
        REQUIRE_OK(irb_image_create(&image, ACROSS, SIDE * layers, 1, &err));
        for (int y = 0; y < SIDE * layers; y++)
            for (int x = 0; x < ACROSS; x++)
                *irb_image_at(&image, x, y) = (float)(y * ACROSS + x);
        REQUIRE_OK(irb_texture_write(texture, &image, &err));
        struct irb_frame_output frame = {.irradiance = irradiance};
        struct irb_debug_layers debug;
        irb_output_layer(&frame, "maps", texture, IRB_DEBUG_DISTANCE);
        REQUIRE_OK(irb_debug_layers_read(&debug, &frame, &err));
        const struct irb_image *kept = &debug.layers[0].image;
        assert_int_equal(kept->width, (ACROSS + layers - 1) / layers);
        assert_int_equal(kept->height, SIDE);
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < kept->width; x++)
                REQUIRE_NEAR(*irb_image_at(kept, x, y), (y * ACROSS + x) * layers, 0);
        irb_debug_layers_destroy(&debug);
        irb_image_destroy(&image);
        irb_texture_destroy(texture);
    }
    irb_texture_destroy(irradiance);
    irb_gl_destroy(gl);
}

/* What there is no room for is counted and written nowhere. */
static void test_no_room(void **state)
{
    (void)state;
    struct irb_frame_output frame = {0}, before;
    for (int i = 0; i < IRB_MAX_STATISTICS; i++)
        irb_output_statistic(&frame, "statistic", i);
    for (int i = 0; i < IRB_MAX_DEBUG_LAYERS; i++)
        irb_output_layer(&frame, "layer", NULL, IRB_DEBUG_SCALAR);
    before = frame;
    for (int i = 0; i < 100; i++) {
        irb_output_statistic(&frame, "too much", 7);
        irb_output_layer(&frame, "too much", NULL, IRB_DEBUG_COLOUR);
    }
    assert_int_equal(frame.statistic_count, IRB_MAX_STATISTICS + 100);
    assert_int_equal(frame.debug_count, IRB_MAX_DEBUG_LAYERS + 100);
    before.statistic_count = frame.statistic_count;
    before.debug_count = frame.debug_count;
    assert_memory_equal(&frame, &before, sizeof frame);
}

static void expect_refusal(struct irb_frame_output *frame, const char *words)
{
    struct irb_error err = {0};
    struct irb_debug_layers debug;
    assert_false(irb_debug_layers_read(&debug, frame, &err));
    assert_int_equal(debug.count, 0);
    REQUIRE_ONE_LINE(err.message);
    REQUIRE_CONTAINS(err.message, words);
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_gl *gl = fixture_gl(backend, NULL);
    struct output output = make_output(gl);
    static const char *const names[] = {NULL,  "",    "a/b",
                                        "a.b", "a b", "a-name-of-32-bytes-in-its-length"};
    for (int i = 0; i < 6; i++) {
        struct irb_frame_output frame = output.frame;
        frame.debug[1].name = names[i];
        expect_refusal(&frame, "a name of at most 31 letters, digits, '-' and '_'");
    }
    struct irb_frame_output twice = output.frame, texture = output.frame, kind = output.frame,
                            many = output.frame, uint = output.frame, depth = output.frame;
    twice.debug[4].name = "split";
    expect_refusal(&twice, "there are two debug layers called 'split'");
    texture.debug[0].texture = NULL;
    expect_refusal(&texture, "with a texture");
    kind.debug[2].kind = (enum irb_debug_kind)9;
    expect_refusal(&kind, "debug layer 'shadow' is of no kind");
    many.debug_count = IRB_MAX_DEBUG_LAYERS + 1;
    expect_refusal(&many, "at most 16 debug layers, found 17");
    uint.debug[3].kind = IRB_DEBUG_COLOUR;
    expect_refusal(&uint, "'ism_atlas': GL_R32UI holds scalars or distances, not colour");
    struct irb_texture *integer = make_texture(gl, GL_RGBA32UI, 2, 2);
    depth.debug[0].texture = integer;
    expect_refusal(&depth, "'cluster-map'");
    irb_texture_destroy(integer);
    destroy_output(&output);
    irb_gl_destroy(gl);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files),
        cmocka_unit_test(test_previews),
        cmocka_unit_test(test_nothing_to_scale),
        cmocka_unit_test(test_pngs),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_long_layers),
        cmocka_unit_test(test_no_room),
    };
    backend = fixture_backend(argc, argv);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
