/* SPDX-License-Identifier: MIT
 *
 * rsm-clustering gives the same bits (tests/gl/same_bits.h).
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"
#include "tests/gl/same_bits.h"

extern const struct irb_method irb_method_rsm_clustering;
static const struct irb_method *const method = &irb_method_rsm_clustering;

enum { TRIALS = 4, FRAMES = 3, WIDTH = 31, HEIGHT = 23, RESOLUTION = 64, COLOURED = 6 };

static const char *const trials[TRIALS][8] = {
    {"clusters", "200", "area", "moment"},
    {"clusters", "100", "shape", "polygon", "reduction", "window"},
    {"clusters", "60", "visibility", "pcss", "point_count", "20000"},
    {"clusters", "90", "visibility", "clustered", "interleave_n", "2", "interleave_m", "2"},
};

static struct irb_image run(struct irb_gl *gl, const struct fixture_frame *f,
                            const char *const settings[8])
{
    struct irb_error err = {0};
    struct irb_frame_output out;
    void *params = calloc(1, method->params_size);
    irb_options_default(method->params, params);
    for (int i = 0; i < 8 && settings[i]; i += 2)
        REQUIRE_OK(irb_option_set(method->params, params, settings[i], settings[i + 1], &err));
    void *state = method->create(gl, f->scene_gl, WIDTH, HEIGHT, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(method->begin_sequence(state, params, 3, &err));
    const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                            .light = &f->light,
                                            .camera = &f->camera,
                                            .gbuffer = f->gbuffer,
                                            .rsm = f->rsm,
                                            .seed = 3,
                                            .params = params,
                                            .debug = true};
    for (int i = 0; i < FRAMES; i++)
        REQUIRE_OK(method->render_frame(state, &inputs, &out, &err));
    struct irb_image image = fixture_read(out.irradiance, 4);
    REQUIRE_CMP(fixture_sum(&image, 0), >, 0);
    REQUIRE_CMP(out.debug_count, >=, COLOURED);
    for (int i = 0; i < COLOURED; i++) { /* pictures show something */
        struct irb_image picture = fixture_read(out.debug[i].texture, 4);
        int coloured = 0;
        for (size_t p = 0; p < irb_image_pixels(&picture); p++)
            coloured += picture.data[4 * p] != picture.data[4 * p + 1];
        REQUIRE_CMP(coloured, >, 0.05 * (double)irb_image_pixels(&picture));
        irb_image_destroy(&picture);
    }
    method->destroy(state);
    free(params);
    return image;
}

static void render(struct irb_gl *gl, struct irb_image *images)
{
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_scene("cornell-objects"), WIDTH, HEIGHT, RESOLUTION);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    for (int i = 0; i < TRIALS; i++)
        images[i] = run(gl, &f, trials[i]);
    fixture_frame_destroy(&f);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image images[TRIALS];
    fixture_same_bits(render, images, TRIALS);
    for (int i = 0; i < TRIALS; i++)
        irb_image_destroy(&images[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
