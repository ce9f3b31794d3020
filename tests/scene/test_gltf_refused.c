/* SPDX-License-Identifier: MIT
 *
 * Malformed glTF files: each is refused with one line that names the file and the cause.
 */
#include "tests/support/compare.h"

#include "core/image/imageio.h"
#include "tests/scene/gltf_files.h"

/* Loads `path`, which is freed, and requires a refusal whose one line contains both strings. */
static void require_refused(char *path, const char *expected)
{
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(path, NULL, &err);

    if (scene)
        fail_msg("%s loaded, expected a message with \"%s\"", path, expected);
    REQUIRE_CMP(err.code, ==, IRB_E_INPUT);
    if (!strstr(err.message, path) || !strstr(err.message, expected) || strchr(err.message, '\n'))
        fail_msg("message \"%s\", expected one line with \"%s\" and \"%s\"", err.message, path,
                 expected);
    free(path);
}

static void missing_file(void **state)
{
    require_refused(irb_asprintf("%s/none.glb", (char *)*state), "No such file");
    require_refused(irb_asprintf("%s/none.gltf", (char *)*state), "No such file");
}

static char *write_text(const char *folder, const char *name, const char *text)
{
    char *path = irb_asprintf("%s/%s", folder, name);

    write_file(path, text, strlen(text));
    return path;
}

static void broken_json(void **state)
{
    require_refused(write_text(*state, "a.gltf", "{\"asset\": {\n\"version\": }"), "line 2");
    require_refused(write_text(*state, "a.gltf", "[1, 2]"), "not a JSON object");
    require_refused(write_text(*state, "a.gltf", "{}   "), "asset");
    require_refused(write_text(*state, "a.gltf", ""), "empty");
    require_refused(write_text(*state, "a.glb", "not glTF at all"), "parse error");
    require_refused(write_text(*state, "a.gltf", "{\"asset\":{\"version\":\"1.0\"}}"), "'1.0'");
}

static void deeply_nested_json(void **state)
{
    enum { DEPTH = 200000 };
    char *text = malloc(DEPTH + 1), *path = irb_asprintf("%s/deep.gltf", (char *)*state);

    memset(text, '[', DEPTH);
    write_file(path, text, DEPTH);
    free(text);
    require_refused(path, "nested");
}

/* At every length. */
static void truncated_glb(void **state)
{
    char *path = write_glb(*state, &(struct test_gltf){0}, 0), *data;
    struct irb_error err = {0};
    size_t size;

    REQUIRE_OK(irb_fs_read(path, 100000, &data, &size, &err));
    free(data);
    free(path);
    for (size_t keep = 4; keep < size; keep += 7)
        require_refused(write_glb(*state, &(struct test_gltf){0}, keep), "truncated");
}

static void non_finite_vertex(void **state)
{
    float positions[9];
    const struct test_gltf gltf = {.positions = positions, .vertices = 3};

    memcpy(positions, one_triangle, sizeof positions);
    positions[7] = NAN;
    require_refused(write_gltf(*state, &gltf), "mesh 0 'shape' primitive 0: vertex 2 (0, nan, 0)");
    positions[7] = INFINITY;
    require_refused(write_glb(*state, &gltf, 0), "vertex 2");
    positions[7] = 3e30f;
    require_refused(write_gltf(*state, &gltf), "vertex 2 lies at 3e+30 m");
}

static void non_finite_transform(void **state)
{
    const struct test_gltf gltf = {.nodes = "{\"mesh\":0,\"name\":\"n\",\"scale\":[1e200,1,1],"
                                            "\"children\":[1]},{\"mesh\":0,\"scale\":[1e200,1,1]}"};

    require_refused(write_gltf(*state, &gltf), "at most 1e+09 m");
}

static void index_out_of_range(void **state)
{
    static const uint16_t indices[] = {0, 1, 3};
    const struct test_gltf gltf = {.indices = indices, .index_count = 3, .index_component = 5123};

    require_refused(write_gltf(*state, &gltf),
                    "primitive 0: index 3 at place 2 is out of range (3 vertices)");
}

static void wrong_index_type_and_count(void **state)
{
    static const float numbers[] = {0, 1, 2};
    static const uint8_t four[] = {0, 1, 2, 0};
    struct test_gltf gltf = {.indices = numbers, .index_count = 3, .index_component = 5126};

    require_refused(write_gltf(*state, &gltf), "expected unsigned");
    gltf = (struct test_gltf){.indices = four, .index_count = 4, .index_component = 5121};
    require_refused(write_gltf(*state, &gltf), "multiple of 3");
}

static void accessors_that_leave_their_buffer(void **state)
{
    struct test_gltf gltf = {.claimed_vertices = 2000000000};

    require_refused(write_gltf(*state, &gltf), "POSITION: accessor 0");
    gltf = (struct test_gltf){.claimed_vertices = 4};
    require_refused(write_gltf(*state, &gltf), "lie outside buffer view 0");
    gltf = (struct test_gltf){.primitive = ",\"indices\":7"};
    require_refused(write_gltf(*state, &gltf), "accessor");
}

static void empty_scene(void **state)
{
    static const float line[9] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    struct test_gltf gltf = {.nodes = "{\"name\":\"nothing\"}"};

    require_refused(write_gltf(*state, &gltf), "empty scene");
    gltf = (struct test_gltf){.positions = line, .vertices = 3}; /* only degenerate triangles */
    require_refused(write_gltf(*state, &gltf), "empty scene");
    gltf = (struct test_gltf){.mode = 1}; /* lines */
    require_refused(write_gltf(*state, &gltf), "empty scene");
}

static void nodes_that_form_no_tree(void **state)
{
    struct test_gltf gltf = {.nodes = "{\"children\":[1]},{\"mesh\":0,\"children\":[0]}"};

    require_refused(write_gltf(*state, &gltf), "reached twice");
    gltf = (struct test_gltf){.nodes = "{\"children\":[5]}"};
    require_refused(write_gltf(*state, &gltf), "node 5 does not exist");
    gltf = (struct test_gltf){.nodes = "{\"mesh\":4}"};
    require_refused(write_gltf(*state, &gltf), "mesh 4 does not exist");
    gltf = (struct test_gltf){.nodes = "{\"mesh\":0,\"scale\":[1,1]}"};
    require_refused(write_gltf(*state, &gltf), "node 0: 'scale' has 2 numbers, expected 3");
}

static void missing_pieces(void **state)
{
    char *bin = irb_asprintf("%s/shape.bin", (char *)*state), *path;
    struct test_gltf gltf = {.primitive = ",\"material\":3"};

    require_refused(write_gltf(*state, &gltf), "material 3 does not exist");
    path = write_gltf(*state, &(struct test_gltf){0});
    unlink(bin);
    require_refused(path, "shape.bin");
    gltf = (struct test_gltf){.top = ",\"extensionsRequired\":[\"EXT_meshopt_compression\"]"};
    require_refused(write_gltf(*state, &gltf), "EXT_meshopt_compression");
    free(bin);
}

static void bad_textures(void **state)
{
    static const char *const materials =
        ",\"materials\":[{\"name\":\"paint\",\"pbrMetallicRoughness\":"
        "{\"baseColorTexture\":{\"index\":%d}}}],\"textures\":[{\"source\":0}],"
        "\"images\":[%s]";
    const struct {
        int texture;
        const char *image, *expected;
    } cases[] = {
        {0, "{\"uri\":\"none.png\"}", "texture file 'none.png'"},
        {4, "{\"uri\":\"none.png\"}", "texture 4 does not exist"},
        {0, "{\"uri\":\"shape.bin\"}", "shape.bin"},
        {0, "{\"bufferView\":9,\"mimeType\":\"image/png\"}", "bufferView"},
        {0, "{\"bufferView\":0,\"mimeType\":\"image/png\"}", "image 0"},
        {0, "", "image 0 does not exist"},
    };

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char top[500];
        const struct test_gltf gltf = {.primitive = ",\"material\":0", .top = top};

        snprintf(top, sizeof top, materials, cases[i].texture, cases[i].image);
        require_refused(write_gltf(*state, &gltf), cases[i].expected);
    }
}

static void non_finite_texcoord(void **state)
{
    static const float texcoords[6] = {0, 0, 1, 0, NAN, 1};
    char *png = irb_asprintf("%s/dot.png", (char *)*state);
    const struct test_gltf gltf = {
        .texcoords = texcoords,
        .primitive = ",\"material\":0",
        .top = ",\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
               "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"dot.png\"}]"};
    struct irb_image image;
    struct irb_error err = {0};

    REQUIRE_OK(irb_image_create(&image, 1, 1, 3, &err));
    if (irb_png_write(png, &image, &err))
        require_refused(write_gltf(*state, &gltf), "texture coordinate of vertex 2");
    else
        print_message("skipped: %s\n", err.message);
    irb_image_destroy(&image);
    free(png);
}

/* A picture in the current folder is not the one beside the scene. */
static void files_are_only_looked_for_beside_the_scene(void **state)
{
    char *elsewhere = test_folder(), *stray = irb_asprintf("%s/shape.bin", elsewhere);
    char *bin = irb_asprintf("%s/shape.bin", (char *)*state), *kept = getcwd(NULL, 0);
    char *path = write_gltf(*state, &(struct test_gltf){0});

    write_file(stray, one_triangle, sizeof one_triangle);
    unlink(bin);
    assert_int_equal(chdir(elsewhere), 0);
    require_refused(path, "shape.bin");
    assert_int_equal(chdir(kept), 0);
    remove_folder(elsewhere);
    free(stray);
    free(bin);
    free(kept);
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
        cmocka_unit_test(missing_file),
        cmocka_unit_test(broken_json),
        cmocka_unit_test(deeply_nested_json),
        cmocka_unit_test(truncated_glb),
        cmocka_unit_test(non_finite_vertex),
        cmocka_unit_test(non_finite_transform),
        cmocka_unit_test(index_out_of_range),
        cmocka_unit_test(wrong_index_type_and_count),
        cmocka_unit_test(accessors_that_leave_their_buffer),
        cmocka_unit_test(empty_scene),
        cmocka_unit_test(nodes_that_form_no_tree),
        cmocka_unit_test(missing_pieces),
        cmocka_unit_test(bad_textures),
        cmocka_unit_test(non_finite_texcoord),
        cmocka_unit_test(files_are_only_looked_for_beside_the_scene),
    };

    return cmocka_run_group_tests(tests, make_folder, free_folder);
}
