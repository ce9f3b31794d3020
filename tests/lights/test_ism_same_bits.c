/* SPDX-License-Identifier: MIT
 *
 * Imperfect shadow maps have the same bits (tests/gl/same_bits.h); splatters of all kinds,
 * pull-push of both kinds.
 */
#include "tests/support/compare.h"
#include "tests/gl/same_bits.h"
#include "tests/lights/ism_fixture.h"

enum { LIGHTS = 20, SIZE = 64, BUILDS = 4 };

/* splatter, pull, and whether points are random */
static const int builds[BUILDS][3] = {
    {IRB_ISM_ATOMIC, IRB_ISM_MEDIAN, 1},
    {IRB_ISM_ATOMIC, IRB_ISM_MEAN, 0},
    {IRB_ISM_RASTER, IRB_ISM_MEAN, 0},
    {IRB_ISM_TESSELLATION, IRB_ISM_MEDIAN, 0},
};

/* The maps below one another. */
static struct irb_image build(struct irb_gl *gl, const struct irb_scene_gl *scene,
                              const struct irb_virtual_lights *lights, const int how[3])
{
    struct irb_error err = {0};
    const struct irb_points_desc desc = {.kind = how[2] ? IRB_POINTS_AREA : IRB_POINTS_TESSELLATION,
                                         .count = 50000,
                                         .seed = 1,
                                         .f_min = 2,
                                         .f_max = 16,
                                         .smoothstep = 5,
                                         .chunk_bytes = 1 << 18};
    const struct irb_ism_settings settings = {.splatter = how[0],
                                              .splat_factor = 1.3f,
                                              .splat_scale = 1,
                                              .splat_size = IRB_ISM_SIZE_SURFACE,
                                              .splat_most = 7,
                                              .near = 0.001f,
                                              .pull_push = 2,
                                              .pull = how[1],
                                              .f_min = 2,
                                              .f_max = 16,
                                              .smoothstep = 5};
    struct irb_points *points = irb_points_create(gl, scene, &desc, &err);
    struct irb_ism *ism = irb_ism_create(gl, SIZE, LIGHTS, &err);
    REQUIRE_OK(points && ism);
    REQUIRE_OK(irb_ism_build(ism, scene, how[0] == IRB_ISM_TESSELLATION ? NULL : points, lights,
                             &settings, &err));
    struct fixture_maps maps = fixture_maps_read(ism);
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, SIZE, SIZE * LIGHTS, 1, &err));
    memcpy(image.data, maps.distance, irb_image_pixels(&image) * sizeof(float));
    fixture_maps_destroy(&maps);
    irb_ism_destroy(ism);
    irb_points_destroy(points);
    return image;
}

static void render(struct irb_gl *gl, struct irb_image *maps)
{
    struct irb_error err = {0};
    struct fixture_light lights[LIGHTS] = {0};
    uint64_t random = 11;
    struct irb_scene *scene = fixture_scene("cornell-objects");
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    for (int l = 0; l < LIGHTS; l++) {
        for (int i = 0; i < 3; i++)
            lights[l].position[i] = 0.05f + 0.45f * (float)fixture_random(&random);
        fixture_random_normal(&random, lights[l].normal);
        lights[l].flux[0] = 1;
    }
    struct irb_virtual_lights view = fixture_lights(gl, lights, LIGHTS);
    for (int i = 0; i < BUILDS; i++)
        maps[i] = build(gl, scene_gl, &view, builds[i]);
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_scene_gl_destroy(scene_gl);
    irb_scene_destroy(scene);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image maps[BUILDS];
    fixture_same_bits(render, maps, BUILDS);
    assert_memory_equal(maps[1].data, maps[2].data, /* atomic, raster */
                        irb_image_pixels(&maps[1]) * sizeof(float));
    for (int k = 0; k < BUILDS; k++)
        irb_image_destroy(&maps[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
