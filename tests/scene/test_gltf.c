/* SPDX-License-Identifier: MIT
 *
 * glTF files that must load, written by the test; results by hand from glTF 2.0's definitions.
 */
#include "tests/support/compare.h"

#include "core/image/imageio.h"
#include "tests/scene/gltf_files.h"

/* Loads and removes the file; warnings go to *warnings (malloc'ed) when it is not NULL. */
static struct irb_scene *load(char *path, char **warnings)
{
    struct irb_log log = {.level = IRB_LOG_WARNING};
    struct irb_error err = {0};
    struct irb_scene *scene;
    char *text = NULL;
    size_t size;

    log.out = open_memstream(&text, &size);
    scene = irb_scene_load(path, &log, &err);
    fclose(log.out);
    if (!scene)
        fail_msg("%s", err.message);
    if (warnings)
        *warnings = text;
    else
        free(text);
    free(path);
    return scene;
}

static void require_vertex(const struct irb_scene *scene, uint32_t triangle, int corner,
                           const double position[3], const double normal[3])
{
    size_t v = scene->indices[3 * (size_t)triangle + corner];

    for (int i = 0; i < 3; i++) {
        REQUIRE_NEAR(scene->positions[3 * v + i], position[i], 1e-6);
        REQUIRE_NEAR(scene->normals[3 * v + i], normal[i], 1e-6);
    }
}

/* Twice the area of all triangles, along their normals. */
static void total_cross(const struct irb_scene *scene, double sum[3])
{
    memset(sum, 0, 3 * sizeof *sum);
    for (uint32_t t = 0; t < scene->triangle_count; t++) {
        const uint32_t *index = scene->indices + 3 * (size_t)t;
        const float *a = scene->positions + 3 * (size_t)index[0],
                    *b = scene->positions + 3 * (size_t)index[1],
                    *c = scene->positions + 3 * (size_t)index[2];

        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;

            sum[i] += ((double)b[j] - a[j]) * ((double)c[k] - a[k]) -
                      ((double)b[k] - a[k]) * ((double)c[j] - a[j]);
        }
    }
}

static void a_bare_triangle_gets_flat_normals_and_white(void **state)
{
    struct irb_scene *scene = load(write_gltf(*state, &(struct test_gltf){0}), NULL);
    const double up[3] = {0, 0, 1};

    REQUIRE_CMP(scene->triangle_count, ==, 1);
    require_vertex(scene, 0, 0, (const double[3]){0, 0, 0}, up);
    require_vertex(scene, 0, 1, (const double[3]){1, 0, 0}, up);
    require_vertex(scene, 0, 2, (const double[3]){0, 1, 0}, up);
    assert_string_equal(scene->name, "shape");
    assert_string_equal(scene->objects[0].name, "shape");
    REQUIRE_NEAR(scene->materials[0].diffuse[0], 1, 0);
    REQUIRE_NEAR(scene->materials[0].specular[0], 0, 0);
    REQUIRE_NEAR(scene->texcoords[0], 0, 0);
    REQUIRE_NEAR(scene->objects[0].transform[0], 1, 0);
    irb_scene_destroy(scene);
}

static void glb_and_gltf_give_the_same_scene(void **state)
{
    struct irb_scene *text = load(write_gltf(*state, &(struct test_gltf){0}), NULL);
    struct irb_scene *binary = load(write_glb(*state, &(struct test_gltf){0}, 0), NULL);

    assert_string_equal(irb_scene_key(text).hex, irb_scene_key(binary).hex);
    irb_scene_destroy(text);
    irb_scene_destroy(binary);
}

/* The unit square from four vertices, by each mode and index width: total area and orientation. */
static void modes_and_index_widths_agree(void **state)
{
    static const float strip[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    static const float fan[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint8_t u8[] = {0, 1, 2, 2, 1, 3};
    static const uint16_t u16[] = {0, 1, 2, 2, 1, 3};
    static const uint32_t u32[] = {0, 1, 2, 2, 1, 3};
    static const uint16_t strip16[] = {0, 1, 2, 3};
    const struct test_gltf cases[] = {
        {.positions = strip,
         .vertices = 4,
         .indices = u8,
         .index_count = 6,
         .index_component = 5121},
        {.positions = strip,
         .vertices = 4,
         .indices = u16,
         .index_count = 6,
         .index_component = 5123},
        {.positions = strip,
         .vertices = 4,
         .indices = u32,
         .index_count = 6,
         .index_component = 5125},
        {.positions = strip, .vertices = 4, .mode = 5},
        {.positions = strip,
         .vertices = 4,
         .indices = strip16,
         .index_count = 4,
         .index_component = 5123,
         .mode = 5},
        {.positions = fan, .vertices = 4, .mode = 6},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct irb_scene *scene = load(write_gltf(*state, &cases[i]), NULL);
        double sum[3];

        total_cross(scene, sum);
        REQUIRE_CMP(scene->triangle_count, ==, 2);
        REQUIRE_NEAR(sum[2], 2, 1e-9);
        irb_scene_destroy(scene);
    }
}

/* Parent: 90 degrees about z, then +10 in x. Child: scale (2,3,1), then +1 in y, as a matrix. The
 * vertex (1,1,0) becomes (2,4,0), and that (10 - 4, 2, 0). */
static void the_node_hierarchy_is_baked_in(void **state)
{
    static const float normals[9] = {1, 1, 0, 1, 1, 0, 0, 0, 2};
    static const float positions[9] = {1, 1, 0, 0, 1, 0, 1, 0, 0};
    const struct test_gltf gltf = {
        .positions = positions,
        .vertices = 3,
        .normals = normals,
        .nodes = "{\"name\":\"parent\",\"children\":[1],\"translation\":[10,0,0],"
                 "\"rotation\":[0,0,0.70710678118654752,0.70710678118654752]},"
                 "{\"name\":\"child\",\"mesh\":0,\"matrix\":[2,0,0,0, 0,3,0,0, 0,0,1,0, 0,1,0,1]}"};
    struct irb_scene *scene = load(write_gltf(*state, &gltf), NULL);
    /* (1,1,0) through the inverse transpose of diag(2,3,1), turned by 90 degrees */
    const double length = hypot(1 / 2.0, 1 / 3.0);
    const double normal[3] = {-1 / 3.0 / length, 1 / 2.0 / length, 0};

    require_vertex(scene, 0, 0, (const double[3]){6, 2, 0}, normal);
    require_vertex(scene, 0, 1, (const double[3]){6, 0, 0}, normal);
    require_vertex(scene, 0, 2, (const double[3]){9, 2, 0}, (const double[3]){0, 0, 1});
    assert_string_equal(scene->objects[0].name, "child");
    irb_scene_destroy(scene);
}

/* glTF 2.0, 3.7.4: a negative determinant turns the winding round, so normals stay outside. */
static void mirrored_nodes_keep_winding_and_normals_together(void **state)
{
    static const float normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    const struct test_gltf cases[] = {
        {.nodes = "{\"mesh\":0,\"scale\":[-1,1,1]}"},
        {.nodes = "{\"mesh\":0,\"scale\":[-1,1,1]}", .normals = normals},
    };

    for (size_t i = 0; i < 2; i++) {
        struct irb_scene *scene = load(write_gltf(*state, &cases[i]), NULL);
        double sum[3];

        total_cross(scene, sum);
        REQUIRE_NEAR(sum[2], 1, 1e-9);
        REQUIRE_NEAR(scene->normals[2], 1, 1e-9);
        REQUIRE_NEAR(scene->bounds_min[0], -1, 0);
        irb_scene_destroy(scene);
    }
}

static void a_flattening_scale_keeps_the_normal(void **state)
{
    static const float normals[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
    const struct test_gltf gltf = {.nodes = "{\"mesh\":0,\"scale\":[2,2,0]}", .normals = normals};
    struct irb_scene *scene = load(write_gltf(*state, &gltf), NULL);

    REQUIRE_NEAR(scene->normals[2], 1, 0);
    irb_scene_destroy(scene);
}

static void two_nodes_may_share_a_mesh(void **state)
{
    const struct test_gltf gltf = {.nodes = "{\"mesh\":0},{\"mesh\":0,\"translation\":[5,0,0]}",
                                   .roots = "0,1"};
    struct irb_scene *scene = load(write_gltf(*state, &gltf), NULL);

    REQUIRE_CMP(scene->object_count, ==, 2);
    REQUIRE_CMP(scene->objects[1].first_triangle, ==, 1);
    REQUIRE_NEAR(scene->bounds_max[0], 6, 0);
    REQUIRE_CMP(scene->material_count, ==, 1);
    irb_scene_destroy(scene);
}

static void degenerates_and_bad_normals_are_counted(void **state)
{
    static const float positions[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 0, 0, 0};
    static const float normals[15] = {0, 0, -1, 0, 0, 0, NAN, 0, 1, 0, 0, 1, 0, 0, 1};
    static const uint8_t indices[] = {0, 1, 2, 0, 1, 1, 0, 1, 3, 0, 4, 2};
    const struct test_gltf gltf = {.positions = positions,
                                   .normals = normals,
                                   .vertices = 5,
                                   .indices = indices,
                                   .index_count = 12,
                                   .index_component = 5121};
    char *warnings;
    struct irb_scene *scene = load(write_gltf(*state, &gltf), &warnings);

    REQUIRE_CMP(scene->triangle_count, ==, 1);
    assert_non_null(strstr(warnings, "3 degenerate triangles"));
    assert_non_null(strstr(warnings, "2 normals"));
    require_vertex(scene, 0, 0, (const double[3]){0, 0, 0}, (const double[3]){0, 0, -1});
    require_vertex(scene, 0, 1, (const double[3]){1, 0, 0}, (const double[3]){0, 0, 1});
    require_vertex(scene, 0, 2, (const double[3]){0, 1, 0}, (const double[3]){0, 0, 1});
    free(warnings);
    irb_scene_destroy(scene);
}

static void what_is_dropped_is_said(void **state)
{
    const struct test_gltf gltf = {
        .top = ",\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}]"
               ",\"extensionsUsed\":[\"KHR_lights_punctual\"]"
               ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
               "{\"name\":\"Lamp\",\"type\":\"spot\",\"spot\":{}},"
               "{\"name\":\"Sun\",\"type\":\"directional\"}]}}"
               ",\"materials\":[{\"name\":\"glow\",\"emissiveFactor\":[1,0,0],"
               "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.25,0.5,0.75,1]}}]",
        .primitive = ",\"material\":0"};
    static const char *const expected[] = {"'Lamp' (spot)", "'Sun' (directional)",
                                           "stands in no node", "'glow' is emissive"};
    char *warnings;
    struct irb_scene *scene = load(write_gltf(*state, &gltf), &warnings);

    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!strstr(warnings, expected[i]))
            fail_msg("\"%s\" is not in: %s", expected[i], warnings);
    REQUIRE_NEAR(scene->materials[0].diffuse[2], 0.75, 0);
    free(warnings);
    irb_scene_destroy(scene);
}

/* ---- Texture ---- */

static const float corner_texcoords[6] = {0, 0, 1, 0, 0, 1};

static struct test_gltf textured(const char *images)
{
    static char top[1000];
    const struct test_gltf gltf = {
        .texcoords = corner_texcoords, .primitive = ",\"material\":0", .top = top};

    snprintf(top, sizeof top,
             ",\"materials\":[{\"name\":\"paint\",\"pbrMetallicRoughness\":"
             "{\"baseColorTexture\":{\"index\":0}}}],\"textures\":[{\"source\":0}],\"images\":[%s]",
             images);
    return gltf;
}

/* 2 x 2: red, green / blue, black. */
static void write_png(const char *path)
{
    static const float pixels[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    struct irb_image image;
    struct irb_error err = {0};

    REQUIRE_OK(irb_image_create(&image, 2, 2, 3, &err));
    memcpy(image.data, pixels, sizeof pixels);
    if (!irb_png_write(path, &image, &err)) {
        irb_image_destroy(&image);
        print_message("skipped: %s\n", err.message);
        skip();
    }
    irb_image_destroy(&image);
}

static void require_texture(const struct irb_scene *scene)
{
    static const unsigned char expected[16] = {255, 0, 0,   255, 0, 255, 0, 255,
                                               0,   0, 255, 255, 0, 0,   0, 255};

    REQUIRE_CMP(scene->texture_count, ==, 1);
    REQUIRE_CMP(scene->materials[0].diffuse_texture, ==, 0);
    REQUIRE_CMP(scene->textures[0].width, ==, 2);
    REQUIRE_CMP(scene->textures[0].height, ==, 2);
    assert_memory_equal(scene->textures[0].rgba, expected, sizeof expected);
    for (int i = 0; i < 6; i++)
        REQUIRE_NEAR(scene->texcoords[i], corner_texcoords[i], 0);
}

static void an_external_texture_is_decoded(void **state)
{
    char *png = irb_asprintf("%s/a b.png", (char *)*state);
    struct test_gltf gltf = textured("{\"uri\":\"a%20b.png\"}");
    struct irb_scene *scene;

    write_png(png);
    scene = load(write_gltf(*state, &gltf), NULL);
    require_texture(scene);
    irb_scene_destroy(scene);
    free(png);
}

static void an_embedded_texture_is_decoded(void **state)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *png = irb_asprintf("%s/embedded.png", (char *)*state), *data;
    struct irb_str image = {0};
    struct irb_error err = {0};
    struct irb_scene *scene;
    struct test_gltf gltf;
    size_t size;

    write_png(png);
    REQUIRE_OK(irb_fs_read(png, 10000, &data, &size, &err));
    irb_str_printf(&image, "{\"uri\":\"data:image/png;base64,");
    for (size_t i = 0; i < size; i += 3) {
        uint32_t bits = (uint32_t)(unsigned char)data[i] << 16;

        bits |= i + 1 < size ? (uint32_t)(unsigned char)data[i + 1] << 8 : 0;
        bits |= i + 2 < size ? (uint32_t)(unsigned char)data[i + 2] : 0;
        for (size_t c = 0; c < 4; c++)
            irb_str_printf(&image, "%c", i + c <= size ? digits[bits >> (18 - 6 * c) & 63] : '=');
    }
    irb_str_printf(&image, "\"}");
    gltf = textured(image.text);
    scene = load(write_gltf(*state, &gltf), NULL);
    require_texture(scene);
    irb_scene_destroy(scene);
    irb_str_free(&image);
    free(data);
    free(png);
}

static int make_folder(void **state)
{
    *state = test_folder();
    return 0;
}

static int free_folder(void **state)
{
    remove_folder(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_bare_triangle_gets_flat_normals_and_white),
        cmocka_unit_test(glb_and_gltf_give_the_same_scene),
        cmocka_unit_test(modes_and_index_widths_agree),
        cmocka_unit_test(the_node_hierarchy_is_baked_in),
        cmocka_unit_test(mirrored_nodes_keep_winding_and_normals_together),
        cmocka_unit_test(a_flattening_scale_keeps_the_normal),
        cmocka_unit_test(two_nodes_may_share_a_mesh),
        cmocka_unit_test(degenerates_and_bad_normals_are_counted),
        cmocka_unit_test(what_is_dropped_is_said),
        cmocka_unit_test(an_external_texture_is_decoded),
        cmocka_unit_test(an_embedded_texture_is_decoded),
    };

    return cmocka_run_group_tests(tests, make_folder, free_folder);
}
