/* SPDX-License-Identifier: MIT
 *
 * acrsm against the ray-traced reference on the Cornell box: bounce 1 with exact visibility, and
 * without visibility for acrsm without shadows. Bounds on the energy and on the error, which
 * shadows must lower, more clusters too.
 */
#include "tests/support/compare.h"
#include "core/reference/reference.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_acrsm;
static const struct irb_method *const acrsm = &irb_method_acrsm;

enum { WIDTH = 64, HEIGHT = 48, RESOLUTION = 256, SAMPLES = 256, FRAMES = 8 };

static struct irb_gl *gl;

static struct irb_image render(const struct fixture_frame *f, const char *const *settings)
{
    struct irb_error err = {0};
    struct irb_frame_output out;
    void *params = calloc(1, acrsm->params_size);
    irb_options_default(acrsm->params, params);
    for (; *settings; settings += 2)
        REQUIRE_OK(irb_option_set(acrsm->params, params, settings[0], settings[1], &err));
    void *state = acrsm->create(gl, f->scene_gl, WIDTH, HEIGHT, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(acrsm->begin_sequence(state, params, 1, &err));
    const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                            .light = &f->light,
                                            .camera = &f->camera,
                                            .gbuffer = f->gbuffer,
                                            .rsm = f->rsm,
                                            .seed = 1,
                                            .params = params};
    for (int frame = 0; frame < FRAMES; frame++)
        REQUIRE_OK(acrsm->render_frame(state, &inputs, &out, &err));
    struct irb_image image = fixture_read(out.irradiance, 3);
    acrsm->destroy(state);
    free(params);
    return image;
}

static void render_reference(const struct fixture_frame *f, const struct irb_gbuffer_image *gbuffer,
                             struct irb_reference_image *out)
{
    struct irb_error err = {0};
    const struct irb_reference_settings settings = {
        .min_samples = SAMPLES, .max_samples = SAMPLES, .bounces = 1, .unoccluded = true};
    struct irb_tracer *tracer = irb_tracer_create(f->scene, &err);
    REQUIRE_OK(tracer);
    const struct irb_reference_job job = {.tracer = tracer,
                                          .light = &f->light,
                                          .camera = &f->camera,
                                          .gbuffer = gbuffer,
                                          .settings = &settings};
    REQUIRE_OK(irb_reference_render(&job, out, &err));
    irb_tracer_destroy(tracer);
}

struct agreement {
    double error;  /* mean absolute error over mean of the reference */
    double energy; /* ratio of the means */
};

static struct agreement compare(const struct irb_image *found, const struct irb_image *expected)
{
    double difference = 0, sum = 0, reference = 0;
    for (size_t i = 0; i < 3 * irb_image_pixels(found); i++) {
        difference += fabs((double)found->data[i] - expected->data[i]);
        sum += found->data[i];
        reference += expected->data[i];
    }
    return (struct agreement){difference / reference, sum / reference};
}

static void test_bounce_1(void **state)
{
    (void)state;
    enum { NONE, SHARP, SOFT, MANY, TRIALS };
    /* without tiles, whose filter has few pixels to choose from in so small an image */
    static const char *const settings[TRIALS][7] = {
        [NONE] = {"visibility", "none", "interleave_n", "1", "interleave_m", "1"},
        [SHARP] = {"visibility", "ism", "interleave_n", "1", "interleave_m", "1"},
        [SOFT] = {"visibility", "pcss", "interleave_n", "1", "interleave_m", "1"},
        [MANY] = {"clusters", "512", "interleave_n", "1", "interleave_m", "1"},
    };
    struct irb_error err = {0};
    struct fixture_frame f;
    struct irb_gbuffer_image gbuffer = {0};
    struct irb_reference_image reference = {0};
    struct agreement with[TRIALS], without = {0};
    fixture_frame_create(&f, gl, fixture_scene("cornell"), WIDTH, HEIGHT, RESOLUTION);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    REQUIRE_OK(irb_gbuffer_read(f.gbuffer, &gbuffer, &err));
    render_reference(&f, &gbuffer, &reference);
    for (int k = 0; k < TRIALS; k++) {
        struct irb_image e = render(&f, settings[k]);
        with[k] = compare(&e, &reference.bounce1);
        if (k == NONE)
            without = compare(&e, &reference.unoccluded);
        print_message("%s %s: error %.3f, energy %.3f\n", settings[k][0], settings[k][1],
                      with[k].error, with[k].energy);
        irb_image_destroy(&e);
    }
    print_message("without visibility on both sides: error %.3f, energy %.3f\n", without.error,
                  without.energy);
    /* discs that are too large take energy from receivers near them */
    REQUIRE_CMP(without.energy, >, 0.85);
    REQUIRE_CMP(without.energy, <, 1.02);
    REQUIRE_CMP(without.error, <, 0.15);
    REQUIRE_CMP(with[SOFT].energy, >, 0.75);
    REQUIRE_CMP(with[SOFT].energy, <, 1.05);
    REQUIRE_CMP(with[SOFT].error, <, with[NONE].error);
    REQUIRE_CMP(with[SHARP].error, <, with[NONE].error);
    REQUIRE_CMP(with[MANY].error, <, with[SOFT].error);
    irb_reference_image_destroy(&reference);
    irb_gbuffer_image_destroy(&gbuffer);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_bounce_1)};
    int failures = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failures;
}
