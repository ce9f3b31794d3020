/* SPDX-License-Identifier: MIT
 *
 * acrsm gives the same bits (tests/gl/same_bits.h) over a sequence with a moving light, in which
 * clusters are merged, split and seeded anew.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"
#include "tests/gl/same_bits.h"

extern const struct irb_method irb_method_acrsm;
static const struct irb_method *const acrsm = &irb_method_acrsm;

enum { TRIALS = 2, WIDTH = 61, HEIGHT = 35, RESOLUTION = 64, FRAMES = 4 };

static void render_trial(struct irb_gl *gl, struct fixture_frame *f, const char *preset,
                         struct irb_image *image)
{
    struct irb_error err = {0};
    struct irb_frame_output out;
    void *params = calloc(1, acrsm->params_size);
    irb_options_default(acrsm->params, params);
    REQUIRE_OK(irb_option_set(acrsm->params, params, "preset", preset, &err));
    REQUIRE_OK(irb_option_set(acrsm->params, params, "epsilon_merge", "0.1", &err));
    REQUIRE_OK(irb_option_set(acrsm->params, params, "epsilon_split", "0.02", &err));
    void *state = acrsm->create(gl, f->scene_gl, WIDTH, HEIGHT, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(acrsm->begin_sequence(state, params, 3, &err));
    fixture_view(f->scene, &f->light, &f->camera);
    for (int frame = 0; frame < FRAMES; frame++) {
        const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                                .light = &f->light,
                                                .camera = &f->camera,
                                                .gbuffer = f->gbuffer,
                                                .rsm = f->rsm,
                                                .frame = frame,
                                                .seed = 3,
                                                .params = params};
        f->light.position[0] += 0.03f;
        fixture_frame_render(f);
        REQUIRE_OK(acrsm->render_frame(state, &inputs, &out, &err));
    }
    *image = fixture_read(out.irradiance, 4);
    acrsm->destroy(state);
    free(params);
}

static void render(struct irb_gl *gl, struct irb_image *images)
{
    static const char *const presets[TRIALS] = {"ours", "thesis"};
    struct fixture_frame f;
    fixture_frame_create(&f, gl, fixture_scene("cornell"), WIDTH, HEIGHT, RESOLUTION);
    for (int i = 0; i < TRIALS; i++)
        render_trial(gl, &f, presets[i], &images[i]);
    fixture_frame_destroy(&f);
}

static void test_same_bits(void **state)
{
    (void)state;
    struct irb_image images[TRIALS];
    fixture_same_bits(render, images, TRIALS);
    for (int i = 0; i < TRIALS; i++) {
        REQUIRE_CMP(fixture_sum(&images[i], 0), >, 0);
        irb_image_destroy(&images[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
