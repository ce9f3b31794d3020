/* SPDX-License-Identifier: MIT
 *
 * Two programs of different kind agree: plain RSM with every texel a light, and the ray-traced
 * reference without visibility between bounce point and receiver, on the Cornell box.
 *
 * Where the geometry term cos cos/r^2 of a texel and a receiver is large, the sum over the texels
 * of any finite map differs from the integral (the singularity of virtual point lights,
 * thesis 3.2.1). Receivers for which any texel's term exceeds that of two facing points at
 * singular_distance are left out; how many may be is part of the test.
 */
#include "tests/support/compare.h"
#include "core/reference/reference.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_rsm;

enum { WIDTH = 64, HEIGHT = 48, RESOLUTION = 128, SAMPLES = 1024 };

static const float singular_distance = 0.03f; /* m: about 8 texels' widths on the lit surface */
static const double allowed = 0.03;           /* relative RMSE */

static struct irb_gl *gl;

static struct irb_image render_rsm(const struct fixture_frame *f)
{
    struct irb_error err = {0};
    struct irb_frame_output out;
    void *params = calloc(1, irb_method_rsm.params_size);
    irb_options_default(irb_method_rsm.params, params);
    REQUIRE_OK(irb_option_set(irb_method_rsm.params, params, "mode", "all", &err));
    void *state = irb_method_rsm.create(gl, f->scene_gl, WIDTH, HEIGHT, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(irb_method_rsm.begin_sequence(state, params, 1, &err));
    const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                            .light = &f->light,
                                            .camera = &f->camera,
                                            .gbuffer = f->gbuffer,
                                            .rsm = f->rsm,
                                            .seed = 1,
                                            .params = params};
    REQUIRE_OK(irb_method_rsm.render_frame(state, &inputs, &out, &err));
    struct irb_image image = fixture_read(out.irradiance, 3);
    irb_method_rsm.destroy(state);
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

/* Largest cos cos/r^2 of the receiver and a texel that carries flux, 1/m2. */
static float largest_term(const float x[3], const float n[3], const struct irb_image *position,
                          const struct irb_image *normal, const struct irb_image *flux)
{
    float largest = 0;
    for (size_t i = 0; i < irb_image_pixels(position); i++) {
        const float *y = position->data + 4 * i, *m = normal->data + 4 * i;
        if (flux->data[4 * i + 3] <= 0 || y[3] <= 0)
            continue;
        float d[3] = {y[0] - x[0], y[1] - x[1], y[2] - x[2]};
        float r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        float at_x = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
        float at_y = -(m[0] * d[0] + m[1] * d[1] + m[2] * d[2]);
        if (at_x > 0 && at_y > 0)
            largest = fmaxf(largest, at_x * at_y / (r2 * r2));
    }
    return largest;
}

static void test_all_against_unoccluded(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_error err = {0};
    struct irb_gbuffer_image gbuffer = {0};
    struct irb_reference_image reference = {0};
    fixture_frame_create(&f, gl, fixture_scene("cornell"), WIDTH, HEIGHT, RESOLUTION);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    REQUIRE_OK(irb_gbuffer_read(f.gbuffer, &gbuffer, &err));
    struct irb_image rsm = render_rsm(&f);
    struct irb_image position = fixture_read(f.rsm->position, 4);
    struct irb_image normal = fixture_read(f.rsm->normal, 4);
    struct irb_image flux = fixture_read(f.rsm->flux, 4);
    const float bound = 1 / (singular_distance * singular_distance);
    render_reference(&f, &gbuffer, &reference);

    double squared_error = 0, squared = 0, noise = 0;
    int compared = 0, covered = 0;
    for (size_t i = 0; i < irb_image_pixels(&rsm); i++) {
        const float *p = gbuffer.position.data + 4 * i;
        covered += p[3] > 0;
        if (p[3] <= 0 ||
            largest_term(p, gbuffer.normal.data + 4 * i, &position, &normal, &flux) > bound)
            continue;
        for (size_t c = 0; c < 3; c++) {
            double v = rsm.data[3 * i + c], r = reference.unoccluded.data[3 * i + c];
            squared_error += (v - r) * (v - r);
            squared += r * r;
        }
        noise += 3 * reference.unoccluded_variance.data[i];
        compared++;
    }
    double relative = sqrt(squared_error / squared);
    print_message("relative RMSE %.4f over %d of %d pixels, reference noise about %.4f\n", relative,
                  compared, covered, sqrt(noise / squared));
    REQUIRE_CMP(compared, >, 0.8 * covered);
    REQUIRE_CMP(relative, <=, allowed);
    irb_image_destroy(&rsm);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    irb_image_destroy(&flux);
    irb_reference_image_destroy(&reference);
    irb_gbuffer_image_destroy(&gbuffer);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_all_against_unoccluded)};
    int failures = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failures;
}
