/* SPDX-License-Identifier: MIT
 *
 * Imperfect shadow maps against rays: visibility of each light for itself, the error of the image
 * as points and lights grow, and the whole method against the reference.
 */
#include "tests/support/compare.h"
#include "core/lights/ism.h"
#include "core/lights/shade.h"
#include "methods/method.h"
#include "tests/integration/exact_lights.h"

extern const struct irb_method irb_method_ism;
static const struct irb_method *const ism = &irb_method_ism;

enum { WIDTH = 64, HEIGHT = 48, RESOLUTION = 128 };

static struct irb_gl *gl;

static struct irb_image render(const struct fixture_frame *f, const char *const *settings)
{
    struct irb_error err = {0};
    struct irb_frame_output out;
    void *params = calloc(1, ism->params_size);
    irb_options_default(ism->params, params);
    for (; *settings; settings += 2)
        REQUIRE_OK(irb_option_set(ism->params, params, settings[0], settings[1], &err));
    void *state = ism->create(gl, f->scene_gl, WIDTH, HEIGHT, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(ism->begin_sequence(state, params, 0, &err));
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

static void make_frame(struct fixture_frame *f, struct irb_gbuffer_image *gbuffer)
{
    struct irb_error err = {0};
    fixture_frame_create(f, gl, fixture_scene("cornell-objects"), WIDTH, HEIGHT, RESOLUTION);
    fixture_view(f->scene, &f->light, &f->camera);
    fixture_frame_render(f);
    REQUIRE_OK(irb_gbuffer_read(f->gbuffer, gbuffer, &err));
}

/* Mean of |a - b| over that of b, of a's green channel and b's first. */
static double difference(const struct irb_image *a, const struct irb_image *b)
{
    double sum = 0;
    for (size_t i = 0; i < irb_image_pixels(a); i++)
        sum += fabs((double)a->data[4 * i + 1] - b->data[(size_t)b->channels * i]);
    return sum / fixture_sum(b, 0);
}

/* The same 64 lights with exact visibility and with maps of more and more points: the error falls,
 * and is a fraction of what no shadows at all would leave. The term is bounded, so that no single
 * light's singularity decides. */
static void test_points_converge(void **state)
{
    (void)state;
    enum { LIGHTS = 64 };
    struct fixture_frame f;
    struct irb_gbuffer_image gbuffer;
    struct irb_image exact;
    int count;
    make_frame(&f, &gbuffer);
    struct exact_light *lights = exact_lights(gl, f.rsm, LIGHTS, &count);
    const double diagonal = irb_scene_diagonal(f.scene);
    exact_image(f.scene, &gbuffer, lights, count, 30 / (diagonal * diagonal), &exact);
    static const char *const points[] = {"8000", "64000", "512000"};
    const char *settings[] = {"vpls",  "64", "interleave_n", "1",    "interleave_m", "1",
                              "clamp", "30", "visibility",   "none", "point_count",  "1",
                              NULL};
    struct irb_image lit = render(&f, settings);
    double unoccluded = difference(&lit, &exact), error[3];
    settings[9] = "ism";
    for (int k = 0; k < 3; k++) {
        settings[11] = points[k];
        struct irb_image e = render(&f, settings);
        error[k] = difference(&e, &exact);
        irb_image_destroy(&e);
    }
    print_message("error: without shadows %.3f; 8 k points %.3f, 64 k %.3f, 512 k %.3f\n",
                  unoccluded, error[0], error[1], error[2]);
    REQUIRE_CMP(error[0], <, unoccluded);
    REQUIRE_CMP(error[1], <, error[0]);
    REQUIRE_CMP(error[2], <, error[1]);
    REQUIRE_CMP(error[2], <, 0.35 * unoccluded);
    free(lights);
    irb_image_destroy(&lit);
    irb_image_destroy(&exact);
    irb_gbuffer_image_destroy(&gbuffer);
    fixture_frame_destroy(&f);
}

/* Everything that the maps of `count` lights are read with, for all pixels at once. */
struct lighting {
    struct irb_vpl_set *set;
    struct irb_points *points;
    struct irb_ism *maps;
    struct irb_interleave *pixels;
    struct irb_shade *shade;
};

static void make_maps(struct lighting *l, const struct fixture_frame *f, int count, int points)
{
    struct irb_error err = {0};
    const struct irb_points_desc desc = {.kind = IRB_POINTS_AREA, .count = points};
    const struct irb_ism_settings settings = {.splatter = IRB_ISM_ATOMIC,
                                              .splat_factor = 1,
                                              .splat_scale = 1,
                                              .splat_size = IRB_ISM_SIZE_SURFACE,
                                              .splat_most = 9,
                                              .pull_push = 4,
                                              .pull = IRB_ISM_MEAN};
    REQUIRE_OK(l->set = irb_vpl_set_create(gl, IRB_VPL_IMPORTANCE, RESOLUTION, count, &err));
    REQUIRE_OK(irb_vpl_set_sample(l->set, f->rsm, count, 0, &err));
    REQUIRE_OK(l->points = irb_points_create(gl, f->scene_gl, &desc, &err));
    REQUIRE_OK(l->maps = irb_ism_create(gl, 128, count, &err));
    const struct irb_virtual_lights lights = irb_vpl_set_view(l->set);
    REQUIRE_OK(irb_ism_build(l->maps, f->scene_gl, l->points, &lights, &settings, &err));
    REQUIRE_OK(l->pixels = irb_interleave_create(gl, WIDTH, HEIGHT, 1, 1, &err));
    REQUIRE_OK(irb_interleave_split(l->pixels, f->gbuffer, &err));
    REQUIRE_OK(l->shade = irb_shade_create(gl, &err));
}

static void destroy_maps(struct lighting *l)
{
    irb_shade_destroy(l->shade);
    irb_interleave_destroy(l->pixels);
    irb_ism_destroy(l->maps);
    irb_points_destroy(l->points);
    irb_vpl_set_destroy(l->set);
}

/* Light that one light's map lets through where rays do not, and keeps where they do, as shares of
 * what it would give without shadows. */
static void light_errors(struct lighting *l, int light, const struct irb_image *exact,
                         double errors[2])
{
    struct irb_error err = {0};
    const struct irb_virtual_lights lights = irb_vpl_set_view(l->set);
    const struct irb_shade_settings settings = {.visibility = IRB_SHADE_BINARY,
                                                .bias = 0.05f,
                                                .offset = 0.01f,
                                                .taps = 1,
                                                .blocker_taps = 1};
    const struct irb_shade_batch batch = {.first = light, .count = 1};
    REQUIRE_OK(irb_shade_run_batch(l->shade, l->pixels, &lights, l->maps, &settings, &batch, &err));
    struct irb_image e = fixture_read(l->pixels->split, 4);
    errors[0] = errors[1] = 0;
    for (size_t i = 0; i < irb_image_pixels(&e); i++) {
        double d = ((double)e.data[4 * i + 1] - exact->data[2 * i]) / fixture_sum(exact, 1);
        errors[d < 0] += fabs(d);
    }
    irb_image_destroy(&e);
}

/* Visibility of each light for itself against rays. */
static void test_each_light(void **state)
{
    (void)state;
    enum { LIGHTS = 24 };
    struct fixture_frame f;
    struct irb_gbuffer_image gbuffer;
    struct lighting l;
    int count;
    make_frame(&f, &gbuffer);
    struct exact_light *lights = exact_lights(gl, f.rsm, LIGHTS, &count);
    make_maps(&l, &f, count, LIGHTS * 8000);
    double mean[2] = {0}, worst = 0;
    for (int i = 0; i < count; i++) {
        struct irb_image exact;
        double errors[2];
        exact_image(f.scene, &gbuffer, &lights[i], 1, 0, &exact);
        light_errors(&l, i, &exact, errors);
        for (int k = 0; k < 2; k++)
            mean[k] += errors[k] / count;
        worst = fmax(worst, errors[0] + errors[1]);
        irb_image_destroy(&exact);
    }
    print_message("visibility of a light: %.4f leaks, %.4f false shadow, worst light %.4f\n",
                  mean[0], mean[1], worst);
    REQUIRE_CMP(mean[0], <, 0.05);
    REQUIRE_CMP(mean[1], <, 0.05);
    destroy_maps(&l);
    free(lights);
    irb_gbuffer_image_destroy(&gbuffer);
    fixture_frame_destroy(&f);
}

static struct irb_image reference_of(const struct fixture_frame *f,
                                     const struct irb_gbuffer_image *gbuffer)
{
    struct irb_error err = {0};
    struct irb_reference_image out;
    const struct irb_reference_settings settings = {
        .min_samples = 512, .max_samples = 512, .bounces = 1};
    struct irb_tracer *tracer = irb_tracer_create(f->scene, &err);
    REQUIRE_OK(tracer);
    const struct irb_reference_job job = {.tracer = tracer,
                                          .light = &f->light,
                                          .camera = &f->camera,
                                          .gbuffer = gbuffer,
                                          .settings = &settings};
    REQUIRE_OK(irb_reference_render(&job, &out, &err));
    struct irb_image bounce = {0};
    REQUIRE_OK(irb_image_create(&bounce, WIDTH, HEIGHT, 1, &err));
    for (size_t i = 0; i < irb_image_pixels(&bounce); i++)
        bounce.data[i] = out.bounce1.data[3 * i + 1];
    irb_reference_image_destroy(&out);
    irb_tracer_destroy(tracer);
    return bounce;
}

/* The method as it is, tiles and filter included, nears the reference as lights grow, each with as
 * many points. */
static void test_lights_converge(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_gbuffer_image gbuffer;
    make_frame(&f, &gbuffer);
    struct irb_image exact = reference_of(&f, &gbuffer);
    static const char *const vpls[] = {"16", "128", "1024"};
    static const char *const points[] = {"32768", "262144", "2097152"};
    double error[3];
    for (int k = 0; k < 3; k++) {
        const char *const settings[] = {"vpls", vpls[k], "point_count", points[k], NULL};
        struct irb_image e = render(&f, settings);
        error[k] = difference(&e, &exact);
        irb_image_destroy(&e);
    }
    print_message("error: 16 lights %.3f, 128 %.3f, 1024 %.3f\n", error[0], error[1], error[2]);
    REQUIRE_CMP(error[1], <, error[0]);
    REQUIRE_CMP(error[2], <, error[1]);
    REQUIRE_CMP(error[2], <, 0.2);
    irb_image_destroy(&exact);
    irb_gbuffer_image_destroy(&gbuffer);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_light),
        cmocka_unit_test(test_points_converge),
        cmocka_unit_test(test_lights_converge),
    };
    int failures = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failures;
}
