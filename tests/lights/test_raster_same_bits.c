/* SPDX-License-Identifier: MIT
 *
 * Rasterised shadow maps have the same bits (tests/gl/same_bits.h), in whatever order the scene's
 * objects are drawn.
 */
#include "tests/support/compare.h"
#include "tests/gl/same_bits.h"
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

static void render_order(struct irb_gl *gl, bool reversed, struct irb_image images[PROJECTIONS])
{
    struct irb_error err = {0};
    struct fixture_light lights[LIGHTS];
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
}

/* The scene's order, then the reverse. */
static void render(struct irb_gl *gl, struct irb_image *images)
{
    render_order(gl, false, images);
    render_order(gl, true, images + PROJECTIONS);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image images[2 * PROJECTIONS];
    fixture_same_bits(render, images, 2 * PROJECTIONS);
    for (int p = 0; p < PROJECTIONS; p++) {
        const struct irb_image *reversed = &images[PROJECTIONS + p];
        assert_memory_equal(reversed->data, images[p].data,
                            irb_image_pixels(&images[p]) * sizeof(float));
    }
    for (int i = 0; i < 2 * PROJECTIONS; i++)
        irb_image_destroy(&images[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
