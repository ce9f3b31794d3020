/* SPDX-License-Identifier: MIT
 *
 * The method acrsm as the harness calls it: closed forms, its switches, what a sequence may change,
 * and what it shows of itself.
 */
#include "tests/support/compare.h"
#include "methods/acrsm/params.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_acrsm;
static const struct irb_method *const acrsm = &irb_method_acrsm;

static struct irb_gl *gl;

static void set_params(void *params, const char *const *settings)
{
    struct irb_error err = {0};
    for (; settings && *settings; settings += 2)
        REQUIRE_OK(irb_option_set(acrsm->params, params, settings[0], settings[1], &err));
}

/* Parameters from "name", "value", ..., NULL; the caller frees them. */
static void *make_params(const char *const *settings)
{
    void *params = calloc(1, acrsm->params_size);
    irb_options_default(acrsm->params, params);
    set_params(params, settings);
    return params;
}

static void *make_state(const struct fixture_frame *f, const void *params)
{
    struct irb_error err = {0};
    void *state =
        acrsm->create(gl, f->scene_gl, f->gbuffer->width, f->gbuffer->height, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(acrsm->begin_sequence(state, params, 1, &err));
    return state;
}

static void draw(void *state, const struct fixture_frame *f, const void *params, bool debug,
                 struct irb_frame_output *out)
{
    struct irb_error err = {0};
    const struct irb_frame_inputs inputs = {.scene = f->scene_gl,
                                            .light = &f->light,
                                            .camera = &f->camera,
                                            .gbuffer = f->gbuffer,
                                            .rsm = f->rsm,
                                            .seed = 1,
                                            .params = params,
                                            .debug = debug};
    REQUIRE_OK(acrsm->render_frame(state, &inputs, out, &err));
}

/* Irradiance (4 channels) after some frames at rest. */
static struct irb_image render(const struct fixture_frame *f, const char *const *settings,
                               struct irb_frame_output *out)
{
    enum { FRAMES = 4 };
    void *params = make_params(settings), *state = make_state(f, params);
    for (int frame = 0; frame < FRAMES; frame++)
        draw(state, f, params, false, out);
    struct irb_image image = fixture_read(out->irradiance, 4);
    acrsm->destroy(state);
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

static void require_finite(const struct irb_image *image)
{
    for (size_t i = 0; i < irb_image_pixels(image) * (size_t)image->channels; i++)
        assert_true(isfinite(image->data[i]) && image->data[i] >= 0);
}

static double statistic(const struct irb_frame_output *out, const char *name)
{
    for (int i = 0; i < out->statistic_count; i++)
        if (!strcmp(out->statistics[i].name, name))
            return out->statistics[i].value;
    fail_msg("no statistic '%s'", name);
    return 0;
}

static double mean_of(const struct irb_image *image)
{
    return (fixture_sum(image, 0) + fixture_sum(image, 1) + fixture_sum(image, 2)) / 3 /
           (double)irb_image_pixels(image);
}

static struct acrsm_resolved resolve(const char *const *settings)
{
    struct acrsm_resolved resolved;
    void *params = make_params(settings);
    acrsm_params_resolve(params, 256, 2, 0, &resolved);
    free(params);
    return resolved;
}

/* What is not auto stands, whatever the preset and in whatever order they are set. */
static void test_presets(void **state)
{
    (void)state;
    const char *const thesis[] = {"preset", "thesis", NULL};
    const char *const mixed[] = {"flux", "sum", "preset", "thesis", "splatter", "atomic", NULL};
    const char *const ours[] = {"importance_norm", "none", "points", "dynamic", NULL};
    struct acrsm_resolved r = resolve(NULL);
    assert_int_equal(r.clustering.flux, ACRSM_FLUX_SUM);
    assert_int_equal(r.importance.norm, IRB_IMPORTANCE_NORM_MAX);
    assert_int_equal(r.clustering.neighbours, ACRSM_NEIGHBOURS_LIST);
    assert_int_equal(r.ism.splatter, IRB_ISM_ATOMIC);
    assert_int_equal(r.clustering.square, 64); /* 128 texels of 512 */
    REQUIRE_NEAR(r.clustering.extent, 2, 0);
    r = resolve(thesis);
    assert_int_equal(r.clustering.flux, ACRSM_FLUX_CENTER);
    assert_int_equal(r.importance.norm, IRB_IMPORTANCE_NORM_NONE);
    assert_int_equal(r.clustering.neighbours, ACRSM_NEIGHBOURS_MAP);
    assert_int_equal(r.ism.splatter, IRB_ISM_RASTER);
    r = resolve(mixed);
    assert_int_equal(r.clustering.flux, ACRSM_FLUX_SUM);
    assert_int_equal(r.importance.norm, IRB_IMPORTANCE_NORM_NONE);
    assert_int_equal(r.ism.splatter, IRB_ISM_ATOMIC);
    r = resolve(ours);
    assert_int_equal(r.importance.norm, IRB_IMPORTANCE_NORM_NONE);
    assert_int_equal(r.ism.splatter, IRB_ISM_TESSELLATION);
}

/* Integrating sphere: E = albedo P / (4 pi R^2) everywhere, but for what the area lights' bound
 * takes from receivers near them. */
static void test_sphere(void **state)
{
    (void)state;
    const char *const settings[] = {"visibility", "none",   "clusters", "512",
                                    "area",       "moment", NULL};
    struct fixture_frame f;
    struct irb_frame_output out;
    double power[3], sum = 0;
    make_frame(&f, "sphere", 32, 24, 128);
    irb_light_power(&f.light, power);
    struct irb_image e = render(&f, settings, &out);
    for (size_t i = 0; i < irb_image_pixels(&e); i++) {
        REQUIRE_REL(e.data[4 * i], 0.5 * power[0] / (4 * M_PI), 0.15);
        sum += e.data[4 * i];
    }
    REQUIRE_REL(sum / (double)irb_image_pixels(&e), 0.5 * power[0] / (4 * M_PI), 0.03);
    REQUIRE_NEAR(out.uncovered_flux, 0, 0);
    REQUIRE_NEAR(statistic(&out, "clusters_in_use"), 512, 8);
    irb_image_destroy(&e);
    fixture_frame_destroy(&f);
}

/* Two parallel squares: the mean irradiance of the upper one by the exact form factor 0.19982, and
 * the same from every tiling of the interleaved shading. */
static void test_squares(void **state)
{
    (void)state;
    const char *const tilings[] = {"1", "2", "3", "4"};
    double first = 0;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "squares", 61, 64, 128);
    for (int k = 0; k < 4; k++) {
        const char *const settings[] = {
            "visibility", "none", "interleave_n", tilings[k], "interleave_m", tilings[k], NULL};
        struct irb_image e = render(&f, settings, &out);
        struct irb_image position = fixture_read(f.gbuffer->position, 4);
        double sum = 0, covered = 0;
        for (size_t i = 0; i < irb_image_pixels(&e); i++)
            if (position.data[4 * i + 3] > 0) {
                sum += e.data[4 * i];
                covered++;
            }
        REQUIRE_CMP(covered, >, 50 * 62);
        REQUIRE_REL(sum / covered, 0.5 * 10 * 0.19982, 0.01);
        if (k == 0)
            first = sum / covered;
        REQUIRE_REL(sum / covered, first, 2e-3);
        irb_image_destroy(&e);
        irb_image_destroy(&position);
    }
    fixture_frame_destroy(&f);
}

/* Least and largest quotient of two images' pixels, of those that `below` lights. */
static void quotients(const struct irb_image *above, const struct irb_image *below, double range[2])
{
    range[0] = INFINITY;
    range[1] = 0;
    for (size_t i = 0; i < irb_image_pixels(above); i++)
        if (below->data[4 * i] > 0) {
            double quotient = above->data[4 * i] / below->data[4 * i];
            range[0] = fmin(range[0], quotient);
            range[1] = fmax(range[1], quotient);
        }
}

/* Thesis 6.1.1: point lights spark where they are near a surface, area lights stay bounded: 1/(pi
 * r^2) is above 1/(pi r^2 + A) at every pixel, and far above it near the lights. */
static void test_form_factors(void **state)
{
    (void)state;
    const char *const val[] = {"visibility", "none", "clusters", "16", NULL};
    const char *const vpl[] = {"visibility", "none", "clusters", "16", "form_factor", "vpl", NULL};
    static const float lamp[3] = {0.4f, 0.45f, 0.2f}, corner[3] = {0.55f, 0.54f, 0.25f};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 80, 60, 128);
    f.light = fixture_spot(lamp, corner, 35);
    fixture_frame_render(&f);
    struct irb_image area = render(&f, val, &out), point = render(&f, vpl, &out);
    double range[2];
    quotients(&point, &area, range);
    REQUIRE_CMP(range[0], >, 1 - 1e-5);
    REQUIRE_CMP(range[1], >, 1.5);
    REQUIRE_CMP(mean_of(&point), >, mean_of(&area));
    REQUIRE_CMP(mean_of(&point), <, 1.4 * mean_of(&area));
    irb_image_destroy(&area);
    irb_image_destroy(&point);
    fixture_frame_destroy(&f);
}

/* Shadow maps of every kind take some of the light, about the same, and say how much. */
static void test_shadows(void **state)
{
    (void)state;
    static const char *const kinds[][10] = {
        {"visibility", "none"},
        {"visibility", "ism"},
        {"visibility", "pcss"},
        {"visibility", "pcss", "splatter", "raster"},
        {"visibility", "pcss", "points", "dynamic"},
        {"visibility", "pcss", "pull_push", "1"},
        {"visibility", "pcss", "preset", "thesis"},
    };
    double means[7];
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 80, 60, 128);
    for (int k = 0; k < 7; k++) {
        struct irb_image e = render(&f, kinds[k], &out);
        double shadow = 0;
        for (size_t i = 0; i < irb_image_pixels(&e); i++)
            shadow += e.data[4 * i + 3] / (double)irb_image_pixels(&e);
        require_finite(&e);
        means[k] = mean_of(&e);
        if (k == 0) {
            REQUIRE_NEAR(shadow, 0, 0);
        } else {
            REQUIRE_CMP(shadow, >, 0.03);
            REQUIRE_CMP(shadow, <, 0.6);
            REQUIRE_CMP(means[k], <, 0.95 * means[0]);
            REQUIRE_CMP(statistic(&out, "coverage"), >, 0.1);
        }
        irb_image_destroy(&e);
    }
    for (int k = 1; k < 7; k++)
        REQUIRE_REL(means[k], means[2], 0.2);
    REQUIRE_NEAR(means[3], means[2], 0); /* the same maps */
    fixture_frame_destroy(&f);
}

/* Parameters, sizes and the RSM may change from frame to frame. */
static void test_changes(void **state)
{
    (void)state;
    static const char *const changes[][8] = {
        {"clusters", "64"},
        {"clusters", "300", "interleave_n", "2", "interleave_m", "4"},
        {"clusters", "16", "visibility", "none"},
        {"visibility", "pcss", "points", "dynamic"},
        {"points", "static", "f_min", "3", "f_max", "8"},
        {"clusters", "512", "pull_push", "2", "flux", "center-area"},
        {"adaptive", "false", "reseed", "false", "cover", "nearest"},
        {"clusters", "128", "space", "world", "view_weight", "0.5"},
    };
    struct irb_error err = {0};
    struct fixture_frame f, fine;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 40, 30, 64);
    make_frame(&fine, "cornell", 50, 20, 96);
    void *params = make_params(NULL), *method = make_state(&f, params);
    for (int k = 0; k < 8; k++) {
        const struct fixture_frame *frame = k < 6 ? &f : &fine;
        if (k == 6)
            REQUIRE_OK(acrsm->resize(method, 50, 20, &err));
        set_params(params, changes[k]);
        f.light.position[0] += 0.01f;
        REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &f.light, &err));
        draw(method, frame, params, false, &out);
        struct irb_image e = fixture_read(out.irradiance, 4);
        require_finite(&e);
        assert_int_equal(e.width, frame->gbuffer->width);
        REQUIRE_CMP(mean_of(&e), >, 0);
        REQUIRE_CMP(statistic(&out, "clusters_in_use"), >=,
                    0.9 * ((struct acrsm_params *)params)->clusters);
        irb_image_destroy(&e);
    }
    acrsm->destroy(method);
    free(params);
    fixture_frame_destroy(&f);
    fixture_frame_destroy(&fine);
}

/* The light looks out of the open front of the box, and at black walls. */
static void test_dark(void **state)
{
    (void)state;
    static const float black[3] = {0}, above[3] = {0, 1, 0}, up[3] = {0, 2, 0}, origin[3] = {0};
    static const float away[3] = {0, 0, -1}, eye[3] = {0, 2, 2};
    const float *const targets[] = {up, origin};
    for (int k = 0; k < 2; k++) {
        struct fixture_frame f;
        struct irb_frame_output out;
        fixture_frame_create(&f, gl, fixture_floor(1, black), 16, 12, 32);
        f.light = fixture_spot(above, targets[k], 40);
        f.camera = fixture_camera(eye, origin, away, 50);
        fixture_frame_render(&f);
        struct irb_image e = render(&f, NULL, &out);
        for (size_t i = 0; i < 4 * irb_image_pixels(&e); i++)
            REQUIRE_NEAR(e.data[i], 0, 0);
        REQUIRE_NEAR(statistic(&out, "clusters_in_use"), 0, 0);
        REQUIRE_NEAR(out.uncovered_flux, 0, 0);
        irb_image_destroy(&e);
        fixture_frame_destroy(&f);
    }
}

/* Debug layers on request; the image is the same with them. */
static void test_debug_layers(void **state)
{
    (void)state;
    static const char *const names[] = {"cluster-map", "cluster-centres", "importance",
                                        "ism-atlas",   "shadow-term",     "split"};
    struct fixture_frame f;
    struct irb_frame_output out;
    struct irb_image images[2];
    make_frame(&f, "cornell", 40, 30, 64);
    for (int debug = 0; debug < 2; debug++) {
        void *params = make_params(NULL), *method = make_state(&f, params);
        for (int frame = 0; frame < 2; frame++)
            draw(method, &f, params, debug, &out);
        images[debug] = fixture_read(out.irradiance, 4);
        assert_int_equal(out.debug_count, debug ? 6 : 0);
        for (int i = 0; i < out.debug_count; i++)
            assert_string_equal(out.debug[i].name, names[i]);
        if (debug) {
            struct irb_image map = fixture_read(out.debug[0].texture, 4);
            REQUIRE_CMP(mean_of(&map), >, 0.1); /* not black */
            irb_image_destroy(&map);
        }
        acrsm->destroy(method);
        free(params);
    }
    assert_memory_equal(images[0].data, images[1].data, irb_image_pixels(&images[0]) * 16);
    irb_image_destroy(&images[0]);
    irb_image_destroy(&images[1]);
    fixture_frame_destroy(&f);
}

/* The thesis's slim layouts of G-buffer and RSM give nearly the same light. */
static void test_slim_layouts(void **state)
{
    (void)state;
    const char *const settings[] = {"visibility", "none", NULL};
    struct irb_error err = {0};
    struct fixture_frame f, slim;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 60, 45, 96);
    slim = f;
    REQUIRE_OK(slim.gbuffer = irb_gbuffer_create_layout(gl, IRB_LAYOUT_SLIM, 60, 45, &err));
    REQUIRE_OK(slim.rsm = irb_rsm_create_layout(gl, IRB_LAYOUT_SLIM, 96, &err));
    fixture_frame_render(&slim);
    struct irb_image full = render(&f, settings, &out), thin = render(&slim, settings, &out);
    require_finite(&thin);
    REQUIRE_REL(mean_of(&thin), mean_of(&full), 0.02);
    irb_image_destroy(&full);
    irb_image_destroy(&thin);
    irb_rsm_destroy(slim.rsm);
    irb_gbuffer_destroy(slim.gbuffer);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_presets),      cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_squares),      cmocka_unit_test(test_form_factors),
        cmocka_unit_test(test_shadows),      cmocka_unit_test(test_changes),
        cmocka_unit_test(test_dark),         cmocka_unit_test(test_debug_layers),
        cmocka_unit_test(test_slim_layouts),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
