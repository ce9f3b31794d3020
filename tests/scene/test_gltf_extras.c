/* SPDX-License-Identifier: MIT
 *
 * What glTF files hold besides triangles and colours: lights, cameras, highlights, alpha masks and
 * animations, against closed forms.
 */
#include "core/scene/builtin.h"
#include "core/scene/gltf/write.h"

#include "tests/support/compare.h"
#include "tests/scene/gltf_files.h"

static struct irb_scene *load(const char *path, char **warnings)
{
    size_t size;
    FILE *text = open_memstream(warnings, &size);
    struct irb_log log = {.out = text, .level = IRB_LOG_WARNING};
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(path, &log, &err);

    fclose(text);
    if (!scene)
        fail_msg("%s: %s", path, err.message);
    return scene;
}

/* ---- Views ---- */

static void require_same_view(const char *name, const char *path)
{
    struct irb_error err = {0};
    struct irb_scene *scene = irb_scene_load(name, NULL, &err), *again;
    struct irb_animation animation;
    struct irb_camera camera;
    struct irb_light light;
    const struct irb_light *l;
    const struct irb_camera *c;
    char *warnings;
    double ahead[3], length;

    irb_builtin_find(name)->view(&animation);
    irb_animation_camera(&animation, scene, 0, &camera);
    irb_animation_light(&animation, scene, 0, &light);
    REQUIRE_OK(irb_scene_export(scene, &camera, &light, path, &err));
    again = load(path, &warnings);
    l = irb_scene_light_find(again, NULL);
    c = irb_scene_camera_find(again, "camera");
    assert_non_null(l);
    assert_non_null(c);
    assert_string_equal(warnings, "");
    assert_int_equal(l->type, light.type);
    assert_int_equal(light.type == IRB_LIGHT_SPOT ? l->falloff : light.falloff, light.falloff);
    for (int i = 0; i < 3; i++)
        ahead[i] = (double)camera.target[i] - camera.position[i];
    length = sqrt(ahead[0] * ahead[0] + ahead[1] * ahead[1] + ahead[2] * ahead[2]);
    for (int i = 0; i < 3; i++) {
        REQUIRE_NEAR(l->position[i], light.position[i], 0);
        REQUIRE_NEAR(l->direction[i], light.direction[i], 1e-6);
        REQUIRE_NEAR(l->intensity[i], light.intensity[i], 1e-6 * light.intensity[i]);
        REQUIRE_NEAR(c->position[i], camera.position[i], 0);
        REQUIRE_NEAR((double)c->target[i] - c->position[i], ahead[i] / length, 1e-5);
    }
    REQUIRE_NEAR(c->vertical_fov, camera.vertical_fov, 0);
    REQUIRE_NEAR(c->z_far, camera.z_far, 0);
    if (light.type == IRB_LIGHT_SPOT)
        REQUIRE_NEAR(l->outer, light.outer, 0);
    else
        REQUIRE_NEAR(l->half_width, light.half_width, 0);
    irb_animation_destroy(&animation);
    irb_scene_destroy(scene);
    irb_scene_destroy(again);
    free(warnings);
}

static void views_come_back_the_same(void **state)
{
    char *path = irb_asprintf("%s/x.glb", (char *)*state);

    require_same_view("cornell", path);
    require_same_view("squares", path); /* a beam */
    require_same_view("doorway", path);
    free(path);
}

/* A lamp straight down from (0,3,0): the node turns -z to -y. */
static void lights_are_found_by_name(void **state)
{
    const struct test_gltf gltf = {
        .nodes = "{\"mesh\":0},{\"translation\":[0,3,0],\"rotation\":"
                 "[-0.7071067811865476,0,0,0.7071067811865476],"
                 "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
                 "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":1}}},"
                 "{\"extensions\":{\"KHR_lights_punctual\":{\"light\":2}}}",
        .roots = "0,1,2,3",
        .top = ",\"extensionsUsed\":[\"KHR_lights_punctual\"]"
               ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
               "{\"name\":\"Lamp\",\"type\":\"spot\",\"intensity\":7,\"color\":[1,0.5,0.25],"
               "\"spot\":{\"innerConeAngle\":0.25,\"outerConeAngle\":0.5}},"
               "{\"name\":\"Sun\",\"type\":\"directional\",\"intensity\":3},"
               "{\"name\":\"Bulb\",\"type\":\"point\"}]}}"};
    char *warnings;
    char *path = write_gltf(*state, &gltf);
    struct irb_scene *scene = load(path, &warnings);
    const struct irb_light *lamp = irb_scene_light_find(scene, NULL),
                           *sun = irb_scene_light_find(scene, "Sun");

    REQUIRE_CMP(scene->light_count, ==, 2);
    assert_non_null(strstr(warnings, "'Sun' (directional) is left out"));
    assert_non_null(strstr(warnings, "'Bulb' (point) is dropped"));
    REQUIRE_NEAR(lamp->position[1], 3, 0);
    REQUIRE_NEAR(lamp->direction[1], -1, 1e-7);
    REQUIRE_NEAR(lamp->intensity[0], 7, 0);
    REQUIRE_NEAR(lamp->intensity[2], 1.75, 0);
    REQUIRE_NEAR(lamp->inner, 0.25, 0);
    assert_int_equal(lamp->falloff, IRB_FALLOFF_SMOOTH);
    assert_int_equal(sun->type, IRB_LIGHT_DIRECTIONAL);
    REQUIRE_NEAR(sun->direction[2], -1, 0);
    REQUIRE_NEAR(sun->intensity[1], 3, 0);
    assert_null(irb_scene_light_find(scene, "Moon"));
    free(path);
    free(warnings);
    irb_scene_destroy(scene);
}

/* ---- Materials ---- */

static struct irb_material material_of(const char *folder, const char *text)
{
    char *top = irb_asprintf(",\"materials\":[{\"name\":\"m\",%s}]", text), *warnings;
    const struct test_gltf gltf = {.primitive = ",\"material\":0", .top = top};
    char *path = write_gltf(folder, &gltf);
    struct irb_scene *scene = load(path, &warnings);
    struct irb_material material = scene->materials[0];

    free(path);
    irb_scene_destroy(scene);
    free(warnings);
    free(top);
    return material;
}

/* Reflectance of the lobe k_s (n.h)^alpha/pi for light along the normal, by the midpoint rule. */
static double lobe_reflectance(double k_s, double alpha)
{
    double sum = 0;
    enum { STEPS = 20000 };

    for (int i = 0; i < STEPS; i++) {
        double theta = (i + 0.5) * M_PI / 2 / STEPS;

        sum += pow(cos(theta / 2), alpha) * sin(theta) * M_PI / 2 / STEPS;
    }
    return 2 * k_s * sum;
}

static void metal_and_gloss_become_a_highlight(void **state)
{
    const char *folder = *state;
    struct irb_material silent = material_of(folder, "\"pbrMetallicRoughness\":{}");
    struct irb_material matte = material_of(
        folder, "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":1}");
    struct irb_material gold =
        material_of(folder, "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.75,0.5,0.25,1],"
                            "\"metallicFactor\":1,\"roughnessFactor\":0.5}");
    struct irb_material gloss = material_of(
        folder, "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.1}");
    struct irb_material rough =
        material_of(folder, "\"pbrMetallicRoughness\":{\"metallicFactor\":1}");
    struct irb_material mirror =
        material_of(folder, "\"pbrMetallicRoughness\":{\"roughnessFactor\":0}");

    REQUIRE_NEAR(silent.specular[0], 0, 0);
    REQUIRE_NEAR(silent.diffuse[0], 1, 0);
    REQUIRE_NEAR(matte.specular[0], 0, 0);
    REQUIRE_REL(gold.exponent, 30, 1e-6); /* 2/0.5^4 - 2 */
    REQUIRE_NEAR(gold.specular[1], 0.5, 1e-7);
    REQUIRE_NEAR(gold.diffuse[1], 0, 0);
    REQUIRE_NEAR(gloss.specular[2], 0.04, 1e-7);
    REQUIRE_NEAR(gloss.exponent, 1e4, 0);
    REQUIRE_NEAR(mirror.exponent, 1e4, 0);
    REQUIRE_NEAR(rough.exponent, 1, 0);
    /* a white base: exactly all of the light comes back, never more */
    REQUIRE_NEAR(lobe_reflectance(rough.specular[0], 1) + rough.diffuse[0], 1, 1e-6);
    REQUIRE_NEAR(lobe_reflectance(gloss.specular[0], 1e4) + gloss.diffuse[0], 1, 1e-4);
}

static void the_alpha_mask_is_kept(void **state)
{
    const char *folder = *state;

    REQUIRE_NEAR(material_of(folder, "\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25").alpha_cutoff,
                 0.25, 0);
    REQUIRE_NEAR(material_of(folder, "\"alphaMode\":\"MASK\"").alpha_cutoff, 0.5, 0);
    /* what the base colour's alpha leaves of it is the texture's part */
    REQUIRE_NEAR(material_of(folder, "\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25,"
                                     "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.5]}")
                     .alpha_cutoff,
                 0.5, 0);
    REQUIRE_NEAR(material_of(folder, "\"alphaMode\":\"OPAQUE\"").alpha_cutoff, 0, 0);
    REQUIRE_NEAR(material_of(folder, "\"doubleSided\":true").alpha_cutoff, 0, 0);
}

/* ---- Animation ---- */

/* A parent that goes from (0,0,0) to (4,0,0) in 2 s; its child, at (0,1,0), holds the triangle and
 * turns by 90 degrees about y in the same time. A second triangle stands still. */
static char *write_animated(const char *folder, const char *interpolation)
{
    static const float data[] = {0, 0, 0, 1, 0, 0,           0, 1,          0, /* positions */
                                 0, 2,                                         /* times */
                                 0, 0, 0, 4, 0, 0,                             /* translations */
                                 0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f};
    char *path = irb_asprintf("%s/a.gltf", folder), *bin = irb_asprintf("%s/a.bin", folder);
    char *json =
        irb_asprintf("{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,2]}],\"nodes\":["
                     "{\"children\":[1]},{\"mesh\":0,\"translation\":[0,1,0]},{\"mesh\":0}],"
                     "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                     "\"buffers\":[{\"uri\":\"a.bin\",\"byteLength\":100}],\"bufferViews\":["
                     "{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36},"
                     "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":8},"
                     "{\"buffer\":0,\"byteOffset\":44,\"byteLength\":24},"
                     "{\"buffer\":0,\"byteOffset\":68,\"byteLength\":32}],\"accessors\":["
                     "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
                     "{\"bufferView\":1,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},"
                     "{\"bufferView\":2,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},"
                     "{\"bufferView\":3,\"componentType\":5126,\"count\":2,\"type\":\"VEC4\"}],"
                     "\"animations\":[{\"channels\":["
                     "{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}},"
                     "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"rotation\"}}],\"samplers\":["
                     "{\"input\":1,\"output\":2,\"interpolation\":\"%s\"},"
                     "{\"input\":1,\"output\":3,\"interpolation\":\"%s\"}]}]}",
                     interpolation, interpolation);
    struct irb_error err = {0};

    REQUIRE_OK(irb_fs_write(path, json, strlen(json), &err));
    REQUIRE_OK(irb_fs_write(bin, data, sizeof data, &err));
    free(json);
    free(bin);
    return path;
}

/* The first object's triangle corner 1, (1,1,0) at rest: it turns about (0,1,0) and moves along. */
static void require_corner(struct irb_scene *scene, double seconds, double x, double y, double z)
{
    const float *m = scene->objects[0].transform;
    const float *p = scene->positions + 3 * (size_t)scene->indices[1];
    const double expected[3] = {x, y, z};
    struct irb_error err = {0};

    REQUIRE_OK(irb_scene_animate(scene, seconds, &err));
    for (int i = 0; i < 3; i++)
        REQUIRE_NEAR(m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i], expected[i],
                     1e-6);
}

static void animations_move_objects(void **state)
{
    char *path = write_animated(*state, "LINEAR"), *warnings;
    struct irb_scene *scene = load(path, &warnings);
    double first, last, half = sqrt(0.5);

    assert_true(irb_scene_duration(scene, &first, &last));
    REQUIRE_NEAR(first, 0, 0);
    REQUIRE_NEAR(last, 2, 0);
    require_corner(scene, 0, 1, 1, 0);
    require_corner(scene, 1, 2 + half, 1, -half); /* 45 degrees */
    require_corner(scene, 2, 4, 1, -1);
    require_corner(scene, 9, 4, 1, -1);
    require_corner(scene, -1, 1, 1, 0);
    for (int i = 0; i < 16; i++) /* the other one stands still */
        REQUIRE_NEAR(scene->objects[1].transform[i], i % 5 == 0, 0);
    irb_scene_destroy(scene);
    free(warnings);
    free(path);
    path = write_animated(*state, "STEP");
    scene = load(path, &warnings);
    require_corner(scene, 1.99, 1, 1, 0);
    require_corner(scene, 2, 4, 1, -1);
    irb_scene_destroy(scene);
    free(warnings);
    free(path);
}

/* Three values a key are expected of a cubic spline: the file has one. */
static void a_channel_with_too_few_values_is_refused(void **state)
{
    char *path = write_animated(*state, "CUBICSPLINE");
    struct irb_error err = {0};

    assert_null(irb_scene_load(path, NULL, &err));
    REQUIRE_CMP(err.code, ==, IRB_E_INPUT);
    assert_non_null(strstr(err.message, "animation channel 0: has 2 times and 2 values"));
    free(path);
}

static int make_folder(void **state)
{
    *state = test_folder();
    return 0;
}

static int drop_folder(void **state)
{
    remove_folder(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(views_come_back_the_same, make_folder, drop_folder),
        cmocka_unit_test_setup_teardown(lights_are_found_by_name, make_folder, drop_folder),
        cmocka_unit_test_setup_teardown(metal_and_gloss_become_a_highlight, make_folder,
                                        drop_folder),
        cmocka_unit_test_setup_teardown(the_alpha_mask_is_kept, make_folder, drop_folder),
        cmocka_unit_test_setup_teardown(animations_move_objects, make_folder, drop_folder),
        cmocka_unit_test_setup_teardown(a_channel_with_too_few_values_is_refused, make_folder,
                                        drop_folder),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
