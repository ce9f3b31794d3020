/* SPDX-License-Identifier: MIT
 *
 * Imperfect shadow maps have the same bits on OSMesa and EGL on llvmpipe, on one thread and two;
 * splatters of both kinds, pull-push of both kinds.
 */
#include "tests/support/compare.h"
#include "tests/lights/ism_fixture.h"

enum { LIGHTS = 20, SIZE = 64, BUILDS = 4 };

/* splatter, pull, and whether points are random */
static const int builds[BUILDS][3] = {
    {IRB_ISM_ATOMIC, IRB_ISM_MEDIAN, 1},
    {IRB_ISM_ATOMIC, IRB_ISM_MEAN, 0},
    {IRB_ISM_RASTER, IRB_ISM_MEAN, 0},
    {IRB_ISM_TESSELLATION, IRB_ISM_MEDIAN, 0},
};

static struct fixture_maps build(struct irb_gl *gl, const struct irb_scene_gl *scene,
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
    irb_ism_destroy(ism);
    irb_points_destroy(points);
    return maps;
}

static void render(enum irb_backend backend, const char *threads, struct fixture_maps maps[BUILDS])
{
    struct irb_error err = {0};
    struct fixture_light lights[LIGHTS] = {0};
    uint64_t random = 11;
    setenv("LP_NUM_THREADS", threads, 1); /* llvmpipe reads it for each context */
    struct irb_gl *gl = fixture_gl(backend, NULL);
    if (!gl->software) {
        printf("skipped: %s is no software rasteriser\n", gl->renderer);
        exit(TEST_SKIPPED);
    }
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
    assert_int_equal(gl->bytes, 0);
    irb_gl_destroy(gl);
}

static void test_same_bits(void **state)
{
    (void)state;
    static const struct {
        enum irb_backend backend;
        const char *threads;
    } others[] = {{IRB_BACKEND_OSMESA, "1"}, {IRB_BACKEND_EGL, "2"}};
    struct fixture_maps expected[BUILDS], found[BUILDS];
    const size_t bytes = sizeof(float) * LIGHTS * SIZE * SIZE;
    render(IRB_BACKEND_OSMESA, "2", expected);
    assert_memory_equal(expected[1].distance, expected[2].distance, bytes); /* atomic, raster */
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        render(others[i].backend, others[i].threads, found);
        for (int k = 0; k < BUILDS; k++) {
            assert_memory_equal(found[k].distance, expected[k].distance, bytes);
            fixture_maps_destroy(&found[k]);
        }
    }
    for (int k = 0; k < BUILDS; k++)
        fixture_maps_destroy(&expected[k]);
}

int main(void)
{
    irb_gl_destroy(fixture_gl(IRB_BACKEND_EGL, NULL)); /* skips where it is missing */
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
