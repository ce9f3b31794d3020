/* SPDX-License-Identifier: MIT
 *
 * Rasterised shadow maps have the same bits on OSMesa and EGL on llvmpipe, on one thread and two,
 * and in whatever order the scene's objects are drawn.
 */
#include "tests/support/compare.h"
#include "tests/lights/raster_fixture.h"

enum { LIGHTS = 8, SIZE = 64, PROJECTIONS = 2 };

static void make_lights(struct fixture_light *lights)
{
    uint64_t random = 11;
    memset(lights, 0, LIGHTS * sizeof *lights);
    for (int l = 0; l < LIGHTS; l++) {
        for (int i = 0; i < 3; i++)
            lights[l].position[i] = 0.05f + 0.45f * (float)fixture_random(&random);
        fixture_random_normal(&random, lights[l].normal);
    }
}

static void reverse_objects(struct irb_scene *scene)
{
    for (int i = 0; i < scene->object_count / 2; i++) {
        struct irb_object *a = &scene->objects[i];
        struct irb_object *b = &scene->objects[scene->object_count - 1 - i];
        struct irb_object held = *a;
        *a = *b;
        *b = held;
    }
}

static void render(enum irb_backend backend, const char *threads, bool reversed,
                   struct irb_image images[PROJECTIONS])
{
    struct irb_error err = {0};
    struct fixture_light lights[LIGHTS];
    setenv("LP_NUM_THREADS", threads, 1); /* llvmpipe reads it for each context */
    struct irb_gl *gl = fixture_gl(backend, NULL);
    if (!gl->software) {
        printf("skipped: %s is no software rasteriser\n", gl->renderer);
        exit(TEST_SKIPPED);
    }
    struct irb_scene *scene = fixture_scene("cornell-objects");
    if (reversed)
        reverse_objects(scene);
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    make_lights(lights);
    struct irb_virtual_lights view = fixture_lights(gl, lights, LIGHTS);
    for (int p = 0; p < PROJECTIONS; p++) {
        struct irb_raster_maps *maps =
            irb_raster_maps_create(gl, (enum irb_raster_projection)p, SIZE, LIGHTS, &err);
        REQUIRE_OK(maps);
        REQUIRE_OK(irb_raster_maps_render(maps, scene_gl, &view, 0, LIGHTS, 1e-3f, &err));
        images[p] = fixture_read(maps->distance, 1);
        irb_raster_maps_destroy(maps);
    }
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
    assert_int_equal(gl->bytes, 0);
    irb_gl_destroy(gl);
}

static void test_same_bits(void **state)
{
    (void)state;
    static const struct {
        enum irb_backend backend;
        const char *threads;
        bool reversed;
    } others[] = {{IRB_BACKEND_OSMESA, "1", false},
                  {IRB_BACKEND_OSMESA, "2", true},
                  {IRB_BACKEND_EGL, "2", false}};
    struct irb_image expected[PROJECTIONS], found[PROJECTIONS];
    render(IRB_BACKEND_OSMESA, "2", false, expected);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        render(others[i].backend, others[i].threads, others[i].reversed, found);
        for (int p = 0; p < PROJECTIONS; p++) {
            assert_memory_equal(found[p].data, expected[p].data,
                                irb_image_pixels(&expected[p]) * sizeof(float));
            irb_image_destroy(&found[p]);
        }
    }
    for (int p = 0; p < PROJECTIONS; p++)
        irb_image_destroy(&expected[p]);
}

int main(void)
{
    irb_gl_destroy(fixture_gl(IRB_BACKEND_EGL, NULL)); /* skips where it is missing */
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
