/* SPDX-License-Identifier: MIT
 *
 * The method rsm: closed forms, and a gather in double precision over the RSM that is read back.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_rsm;
static const struct irb_method *const rsm = &irb_method_rsm;

static struct irb_gl *gl;

/* Parameters from "name", "value", ..., NULL; the caller frees them. */
static void *make_params(const char *const *settings)
{
    struct irb_error err = {0};
    void *params = calloc(1, rsm->params_size);
    irb_options_default(rsm->params, params);
    for (; settings && *settings; settings += 2)
        REQUIRE_OK(irb_option_set(rsm->params, params, settings[0], settings[1], &err));
    return params;
}

/* Irradiance (4 channels) of one frame with fresh state. */
static struct irb_image render(const struct fixture_frame *f, const char *const *settings,
                               uint64_t seed, struct irb_frame_output *out)
{
    struct irb_error err = {0};
    void *params = make_params(settings);
    void *state = rsm->create(gl, f->scene_gl, f->gbuffer->width, f->gbuffer->height, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(rsm->begin_sequence(state, params, seed, &err));
    const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                            .light = &f->light,
                                            .camera = &f->camera,
                                            .gbuffer = f->gbuffer,
                                            .rsm = f->rsm,
                                            .seed = seed,
                                            .params = params};
    REQUIRE_OK(rsm->render_frame(state, &inputs, out, &err));
    struct irb_image image = fixture_read(out->irradiance, 4);
    rsm->destroy(state);
    free(params);
    return image;
}

static void make_frame(struct fixture_frame *f, const char *scene, int width, int height,
                       int resolution)
{
    fixture_frame_create(f, gl, fixture_scene(scene), width, height, resolution);
    fixture_view(f->scene, &f->light, &f->camera);
    fixture_frame_render(f);
}

static const char *const all[] = {"mode", "all", NULL};

/* Integrating sphere: E = albedo P / (4 pi R^2) everywhere. */
static void test_sphere(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    double power[3];
    make_frame(&f, "sphere", 32, 24, 64);
    irb_light_power(&f.light, power);
    struct irb_image e = render(&f, all, 0, &out);
    for (size_t i = 0; i < irb_image_pixels(&e); i++)
        for (size_t c = 0; c < 3; c++)
            REQUIRE_REL(e.data[4 * i + c], 0.5 * power[c] / (4 * M_PI), 0.01);
    REQUIRE_NEAR(out.lost_energy, 0, 0);
    assert_string_equal(out.statistics[0].name, "vpls");
    /* the texels of the square image that lie in the cone */
    REQUIRE_REL(out.statistics[0].value, 64 * 64 * M_PI / 4, 0.01);
    irb_image_destroy(&e);
    fixture_frame_destroy(&f);
}

/* Form factor from a point to the rectangle [0,a] x [0,b] at distance 1, parallel, the point below
 * its corner; odd in a and b. */
static double corner_factor(double a, double b)
{
    double ra = sqrt(1 + a * a), rb = sqrt(1 + b * b);
    return (a / ra * atan(b / ra) + b / rb * atan(a / rb)) / (2 * M_PI);
}

/* Two parallel unit squares, 1 m apart, the lower one lit by 10 W/m2: the exact factor of each
 * point of the upper one, and their mean 0.19982 (Hottel's closed form). */
static void test_squares(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "squares", 64, 64, 128);
    struct irb_image e = render(&f, all, 0, &out), position = fixture_read(f.gbuffer->position, 4);
    double sum = 0, covered = 0;
    for (size_t i = 0; i < irb_image_pixels(&e); i++) {
        const float *at = position.data + 4 * i;
        if (at[3] == 0)
            continue;
        double factor =
            corner_factor(0.5 - at[0], 0.5 - at[2]) + corner_factor(0.5 + at[0], 0.5 - at[2]) +
            corner_factor(0.5 - at[0], 0.5 + at[2]) + corner_factor(0.5 + at[0], 0.5 + at[2]);
        REQUIRE_REL(e.data[4 * i], 0.5 * 10 * factor, 1e-3);
        sum += e.data[4 * i];
        covered++;
    }
    REQUIRE_CMP(covered, >, 62 * 62);
    REQUIRE_REL(sum / covered, 0.5 * 10 * 0.19982, 2e-3);
    irb_image_destroy(&e);
    irb_image_destroy(&position);
    fixture_frame_destroy(&f);
}

/* E at one pixel in double precision over all texels, the geometry term cut at `bound`. */
static void brute_force(const struct irb_image texels[3], const float x[3], const float n[3],
                        double bound, double e[3], double *lost)
{
    e[0] = e[1] = e[2] = *lost = 0;
    for (size_t p = 0; p < irb_image_pixels(&texels[0]); p++) {
        const float *y = texels[0].data + 4 * p, *n_y = texels[1].data + 4 * p;
        const float *flux = texels[2].data + 4 * p;
        double d[3], r2 = 0, cos_x = 0, cos_y = 0;
        for (int i = 0; i < 3; i++) {
            d[i] = (double)y[i] - x[i];
            r2 += d[i] * d[i];
            cos_x += n[i] * d[i];
            cos_y -= n_y[i] * d[i];
        }
        double g = r2 > 0 ? fmax(0, cos_x) * fmax(0, cos_y) / (r2 * r2) : 0;
        double kept = bound > 0 ? fmin(g, bound) : g;
        for (int c = 0; c < 3; c++) {
            e[c] += flux[c] / M_PI * kept;
            *lost += flux[c] / M_PI * (g - kept) / 3;
        }
    }
}

static void check_against_brute_force(int width, int height, int resolution, const char *clamp)
{
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", width, height, resolution);
    const char *const settings[] = {"mode", "all", "clamp", clamp, NULL};
    struct irb_image found = render(&f, settings, 0, &out);
    struct irb_image position = fixture_read(f.gbuffer->position, 4);
    struct irb_image normal = fixture_read(f.gbuffer->normal, 4);
    const struct irb_image texels[3] = {fixture_read(f.rsm->position, 4),
                                        fixture_read(f.rsm->normal, 4),
                                        fixture_read(f.rsm->flux, 4)};
    double diagonal = irb_scene_diagonal(f.scene), kept = 0, lost = 0;
    for (size_t i = 0; i < irb_image_pixels(&found); i++) {
        double e[3], gone;
        brute_force(texels, position.data + 4 * i, normal.data + 4 * i,
                    atof(clamp) / (diagonal * diagonal), e, &gone);
        if (position.data[4 * i + 3] == 0)
            e[0] = e[1] = e[2] = gone = 0;
        for (size_t c = 0; c < 3; c++)
            REQUIRE_NEAR(found.data[4 * i + c], e[c], 1e-4 * e[c]);
        kept += (e[0] + e[1] + e[2]) / 3;
        lost += gone;
    }
    REQUIRE_NEAR(out.lost_energy, lost / (lost + kept), 1e-4);
    if (atof(clamp) > 0)
        REQUIRE_CMP(out.lost_energy, >, 0.001);
    irb_image_destroy(&found);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
    for (int i = 0; i < 3; i++)
        irb_image_destroy((struct irb_image *)&texels[i]);
    fixture_frame_destroy(&f);
}

static void test_brute_force(void **state)
{
    (void)state;
    check_against_brute_force(1, 1, 16, "0");
    check_against_brute_force(13, 7, 33, "0");
    check_against_brute_force(67, 30, 48, "0"); /* two blocks of lights, a tile and a bit */
    check_against_brute_force(67, 30, 48, "3");
    check_against_brute_force(24, 20, 1, "0");
}

/* Mean absolute error of drawn lights, relative to the mean of `exact`, over four seeds. */
static double drawn_error(const struct fixture_frame *f, const struct irb_image *exact,
                          const char *mode, const char *samples)
{
    const char *const settings[] = {"mode", mode, "samples", samples, NULL};
    struct irb_frame_output out;
    double difference = 0, mean = 0;
    for (uint64_t seed = 0; seed < 4; seed++) {
        struct irb_image e = render(f, settings, seed, &out);
        for (size_t i = 0; i < irb_image_pixels(&e); i++) {
            difference += fabs((double)e.data[4 * i] - exact->data[4 * i]);
            mean += exact->data[4 * i];
        }
        irb_image_destroy(&e);
    }
    return difference / mean;
}

/* The drawn modes approach `all`, and no slower than random samples do: 64 times as many take the
 * error down by a factor of 8 at least. */
static void test_samples_converge(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 24, 18, 64);
    struct irb_image exact = render(&f, all, 0, &out);
    const char *const modes[] = {"uniform", "importance"};
    for (int m = 0; m < 2; m++) {
        double few = drawn_error(&f, &exact, modes[m], "64");
        double many = drawn_error(&f, &exact, modes[m], "4096");
        REQUIRE_CMP(many, <, 0.02);
        REQUIRE_CMP(many, <, few / 8);
    }
    irb_image_destroy(&exact);
    fixture_frame_destroy(&f);
}

/* The same frame twice, bit by bit; another seed is another image. */
static void test_same_bits_twice(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 33, 17, 64);
    const char *const modes[] = {"all", "uniform", "importance"};
    for (int m = 0; m < 3; m++) {
        const char *const settings[] = {"mode", modes[m], "clamp", "10", NULL};
        struct irb_image one = render(&f, settings, 5, &out), two = render(&f, settings, 5, &out);
        struct irb_image other = render(&f, settings, 6, &out);
        size_t bytes = irb_image_pixels(&one) * 16;
        assert_memory_equal(one.data, two.data, bytes);
        assert_int_equal(!memcmp(one.data, other.data, bytes), m == 0);
        irb_image_destroy(&one);
        irb_image_destroy(&two);
        irb_image_destroy(&other);
    }
    fixture_frame_destroy(&f);
}

/* Parameters that change from frame to frame, a resize, and a light that lights nothing: the
 * state gives what a fresh one would. */
static void test_changing_frames(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 20, 15, 32);
    void *params = make_params(NULL);
    void *method = rsm->create(gl, f.scene_gl, 7, 5, params, &err);
    REQUIRE_OK(method);
    REQUIRE_OK(rsm->resize(method, 20, 15, &err));
    struct irb_frame_inputs inputs = {.scene = f.scene_gl,
                                      .light = &f.light,
                                      .camera = &f.camera,
                                      .gbuffer = f.gbuffer,
                                      .rsm = f.rsm,
                                      .params = params};
    const char *const frames[][4] = {{"uniform", "100", "0", "0"},
                                     {"uniform", "3000", "0", "0"},
                                     {"importance", "30", "5", "0"},
                                     {"all", "1", "0", "1"},
                                     {"uniform", "100", "5", "0"}};
    for (int i = 0; i < 5; i++) {
        const char *const settings[] = {"mode",  frames[i][0], "samples", frames[i][1],
                                        "clamp", frames[i][2], NULL};
        for (int k = 0; settings[k]; k += 2)
            REQUIRE_OK(irb_option_set(rsm->params, params, settings[k], settings[k + 1], &err));
        struct irb_light light = f.light;
        if (frames[i][3][0] == '1')
            memset(light.intensity, 0, sizeof light.intensity);
        REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &light, &err));
        REQUIRE_OK(rsm->render_frame(method, &inputs, &out, &err));
        struct irb_image found = fixture_read(out.irradiance, 4);
        if (frames[i][3][0] == '1') {
            REQUIRE_NEAR(out.statistics[0].value, 0, 0);
            for (int c = 0; c < 4; c++)
                REQUIRE_NEAR(fixture_sum(&found, c), 0, 0);
        }
        struct irb_image fresh = render(&f, settings, 0, &out);
        assert_memory_equal(found.data, fresh.data, irb_image_pixels(&found) * 16);
        irb_image_destroy(&found);
        irb_image_destroy(&fresh);
    }
    rsm->destroy(method);
    free(params);
    fixture_frame_destroy(&f);
}

/* The same scene a thousand times smaller or larger, and far weaker or stronger light: E goes with
 * I/s^2, and a clamp takes the same share. */
static void test_scales(void **state)
{
    (void)state;
    const double scales[] = {1, 1e-3, 1e3}, intensities[] = {1, 1e6, 1e-6};
    struct irb_image first = {0};
    double first_lost = 0;
    const char *const settings[] = {"mode", "importance", "clamp", "5", NULL};
    for (int k = 0; k < 3; k++) {
        struct fixture_frame f;
        struct irb_frame_output out;
        struct irb_scene *scene = fixture_scene("cornell");
        float s = (float)scales[k];
        struct irb_light light;
        struct irb_camera camera;
        fixture_view(scene, &light, &camera);
        for (size_t i = 0; i < 3 * (size_t)scene->vertex_count; i++)
            scene->positions[i] *= s;
        for (int i = 0; i < 3; i++) {
            scene->bounds_min[i] *= s;
            scene->bounds_max[i] *= s;
            light.position[i] *= s;
            light.intensity[i] = (float)intensities[k];
            camera.position[i] *= s;
            camera.target[i] *= s;
        }
        camera.z_near *= s;
        camera.z_far *= s;
        fixture_frame_create(&f, gl, scene, 24, 18, 64);
        f.light = light;
        f.camera = camera;
        fixture_frame_render(&f);
        struct irb_image e = render(&f, settings, 0, &out);
        double unit = intensities[k] / (scales[k] * scales[k]), sum = fixture_sum(&e, 1);
        if (k == 0) {
            first = e;
            first_lost = out.lost_energy;
        } else {
            REQUIRE_REL(sum / unit, fixture_sum(&first, 1), 2e-3);
            REQUIRE_REL(out.lost_energy, first_lost, 0.02);
            irb_image_destroy(&e);
        }
        fixture_frame_destroy(&f);
    }
    irb_image_destroy(&first);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),          cmocka_unit_test(test_squares),
        cmocka_unit_test(test_brute_force),     cmocka_unit_test(test_samples_converge),
        cmocka_unit_test(test_same_bits_twice), cmocka_unit_test(test_changing_frames),
        cmocka_unit_test(test_scales),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
