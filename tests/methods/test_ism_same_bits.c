/* SPDX-License-Identifier: MIT
 *
 * ism gives the same bits (tests/gl/same_bits.h) for every kind of point, splat and map.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"
#include "tests/gl/same_bits.h"

extern const struct irb_method irb_method_ism;
static const struct irb_method *const ism = &irb_method_ism;

enum { VARIANTS = 6, WIDTH = 61, HEIGHT = 35, RESOLUTION = 48 };

static const char *const variants[VARIANTS][3][2] = {
    {{"points", "area"}, {"splatter", "atomic"}, {"pull", "mean"}},
    {{"points", "area"}, {"splatter", "raster"}, {"pull", "median"}},
    {{"points", "area"}, {"adaptive_points", "0.9"}, {"importance", "bidirectional"}},
    {{"points", "tessellation"}, {"splatter", "atomic"}, {"importance", "bidirectional"}},
    {{"points", "dynamic"}, {"interleave_n", "4"}, {"clamp", "30"}},
    {{"visibility", "exact-raster"}, {"interleave_n", "2"}, {"map_size", "32"}},
};

static struct irb_image render_variant(struct irb_gl *gl, const struct fixture_frame *f,
                                       int variant)
{
    static const char *const common[][2] = {
        {"vpls", "50"}, {"point_count", "20000"}, {"f_min", "1"}, {"f_max", "6"}};
    struct irb_error err = {0};
    struct irb_frame_output out;
    void *params = calloc(1, ism->params_size);
    irb_options_default(ism->params, params);
    for (int i = 0; i < 4; i++)
        REQUIRE_OK(irb_option_set(ism->params, params, common[i][0], common[i][1], &err));
    for (int i = 0; i < 3; i++)
        REQUIRE_OK(irb_option_set(ism->params, params, variants[variant][i][0],
                                  variants[variant][i][1], &err));
    void *state = ism->create(gl, f->scene_gl, WIDTH, HEIGHT, params, &err);
    REQUIRE_OK(state);
    const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                            .light = &f->light,
                                            .camera = &f->camera,
                                            .gbuffer = f->gbuffer,
                                            .rsm = f->rsm,
                                            .params = params};
    REQUIRE_OK(ism->render_frame(state, &inputs, &out, &err));
    struct irb_image image = fixture_read(out.irradiance, 4);
    ism->destroy(state);
    free(params);
    return image;
}

static void render(struct irb_gl *gl, struct irb_image *images)
{
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_scene("cornell-objects"), WIDTH, HEIGHT, RESOLUTION);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    for (int i = 0; i < VARIANTS; i++)
        images[i] = render_variant(gl, &f, i);
    fixture_frame_destroy(&f);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image images[VARIANTS];
    fixture_same_bits(render, images, VARIANTS);
    for (int i = 0; i < VARIANTS; i++) {
        REQUIRE_CMP(fixture_sum(&images[i], 0), >, 0);
        irb_image_destroy(&images[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
