/* SPDX-License-Identifier: MIT
 *
 * What is exported comes back the same through the loader (another library's parser); the file's
 * frame against glTF 2.0's words.
 */
#include "core/scene/builtin.h"
#include "core/scene/gltf/write.h"

#include "tests/support/compare.h"
#include "tests/scene/gltf_files.h"

static struct irb_scene *load(const char *name)
{
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(name, NULL, &err);

    if (!scene)
        fail_msg("%s: %s", name, err.message);
    return scene;
}

/* The scene written with its default view and read again. */
static struct irb_scene *there_and_back(const char *name, const char *path)
{
    struct irb_scene *scene = load(name), *again;
    struct irb_animation animation;
    struct irb_camera camera;
    struct irb_light light;
    struct irb_error err = {0};

    irb_builtin_find(name)->view(&animation);
    irb_animation_camera(&animation, scene, 0, &camera);
    irb_animation_light(&animation, scene, 0, &light);
    REQUIRE_OK(irb_scene_export(scene, &camera, &light, path, &err));
    irb_animation_destroy(&animation);
    irb_scene_destroy(scene);
    again = load(path);
    return again;
}

static void require_same_corners(const struct irb_scene *a, const struct irb_scene *b)
{
    REQUIRE_CMP(a->triangle_count, ==, b->triangle_count);
    for (size_t i = 0; i < 3 * (size_t)a->triangle_count; i++) {
        size_t v = a->indices[i], w = b->indices[i];

        for (int axis = 0; axis < 3; axis++) {
            REQUIRE_NEAR(a->positions[3 * v + axis], b->positions[3 * w + axis], 0);
            REQUIRE_NEAR(a->normals[3 * v + axis], b->normals[3 * w + axis], 2e-7);
        }
    }
}

static void require_same_materials(const struct irb_scene *a, const struct irb_scene *b)
{
    REQUIRE_CMP(a->object_count, ==, b->object_count);
    for (int i = 0; i < a->object_count; i++) {
        const struct irb_object *x = &a->objects[i], *y = &b->objects[i];
        const struct irb_material *p = &a->materials[x->material], *q = &b->materials[y->material];

        assert_string_equal(x->name, y->name);
        REQUIRE_CMP(x->first_triangle, ==, y->first_triangle);
        assert_string_equal(p->name, q->name);
        for (int c = 0; c < 3; c++) {
            REQUIRE_NEAR(p->diffuse[c], q->diffuse[c], 0);
            REQUIRE_NEAR(q->specular[c], 0, 0);
        }
        assert_int_equal(p->diffuse_texture >= 0, q->diffuse_texture >= 0);
        if (p->diffuse_texture >= 0) {
            const struct irb_scene_texture *s = &a->textures[p->diffuse_texture],
                                           *t = &b->textures[q->diffuse_texture];

            assert_string_equal(s->name, t->name);
            REQUIRE_CMP(s->width, ==, t->width);
            assert_memory_equal(s->rgba, t->rgba, 4 * (size_t)s->width * (size_t)s->height);
        }
    }
}

static void scenes_come_back_the_same(void **state)
{
    static const char *const names[] = {"cornell", "cornell-objects", "hall", "atrium"};
    char *folder = test_folder(), *path = irb_asprintf("%s/x.glb", folder);
    (void)state;

    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct irb_scene *scene = load(names[i]), *again = there_and_back(names[i], path);

        require_same_corners(scene, again);
        require_same_materials(scene, again);
        for (int axis = 0; axis < 3; axis++) {
            REQUIRE_NEAR(scene->bounds_min[axis], again->bounds_min[axis], 0);
            REQUIRE_NEAR(scene->bounds_max[axis], again->bounds_max[axis], 0);
        }
        irb_scene_destroy(scene);
        irb_scene_destroy(again);
    }
    free(path);
    remove_folder(folder);
}

static void a_moved_object_comes_back_where_it_is(void **state)
{
    char *folder = test_folder(), *path = irb_asprintf("%s/x.glb", folder);
    struct irb_scene *scene = load("squares"), *again;
    struct irb_error err = {0};
    float min[3], max[3];
    (void)state;

    scene->objects[1].transform[13] = 2;
    scene->objects[1].transform[0] = 3;
    irb_scene_current_bounds(scene, min, max);
    REQUIRE_OK(irb_scene_export(scene, NULL, NULL, path, &err));
    again = load(path);
    for (int axis = 0; axis < 3; axis++) {
        REQUIRE_NEAR(again->bounds_min[axis], min[axis], 0);
        REQUIRE_NEAR(again->bounds_max[axis], max[axis], 0);
    }
    irb_scene_destroy(scene);
    irb_scene_destroy(again);
    free(path);
    remove_folder(folder);
}

static uint32_t u32(const char *data, size_t offset)
{
    uint32_t value;

    memcpy(&value, data + offset, 4);
    return value;
}

/* glTF 2.0, 4.4: header, JSON chunk padded with spaces, BIN chunk; both a multiple of 4 long. */
static void the_container_is_as_specified(void **state)
{
    char *folder = test_folder(), *path = irb_asprintf("%s/x.glb", folder), *data;
    struct irb_error err = {0};
    size_t size, json;
    (void)state;

    irb_scene_destroy(there_and_back("cornell", path));
    REQUIRE_OK(irb_fs_read(path, 1 << 24, &data, &size, &err));
    assert_memory_equal(data, "glTF", 4);
    REQUIRE_CMP(u32(data, 4), ==, 2);
    REQUIRE_CMP(u32(data, 8), ==, size);
    json = u32(data, 12);
    REQUIRE_CMP(json % 4, ==, 0);
    assert_memory_equal(data + 16, "JSON", 4);
    REQUIRE_CMP(u32(data, 20 + json) % 4, ==, 0);
    assert_memory_equal(data + 24 + json, "BIN\0", 4);
    REQUIRE_CMP(28 + json + u32(data, 20 + json), ==, size);
    /* 1 W/sr white, 50 degrees; one to one */
    assert_non_null(strstr(data + 20, "\"intensity\":1,"));
    assert_non_null(strstr(data + 20, "\"outerConeAngle\":0.872664"));
    assert_non_null(strstr(data + 20, "\"falloff\":\"cosine\""));
    free(data);
    free(path);
    remove_folder(folder);
}

static void a_place_that_cannot_be_written_is_named(void **state)
{
    struct irb_scene *scene = load("squares");
    struct irb_error err = {0};
    (void)state;

    assert_false(irb_scene_export(scene, NULL, NULL, "/nowhere/x.glb", &err));
    REQUIRE_CMP(err.code, ==, IRB_E_IO);
    assert_non_null(strstr(err.message, "/nowhere/x.glb"));
    irb_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_come_back_the_same),
        cmocka_unit_test(a_moved_object_comes_back_where_it_is),
        cmocka_unit_test(the_container_is_as_specified),
        cmocka_unit_test(a_place_that_cannot_be_written_is_named),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
