/* SPDX-License-Identifier: MIT
 *
 * The method ism: against plain RSM where there are no shadows, and closed forms where there are.
 */
#include "tests/support/compare.h"
#include "methods/method.h"
#include "tests/frame/fixture.h"

extern const struct irb_method irb_method_ism, irb_method_rsm;
static const struct irb_method *const ism = &irb_method_ism;

static struct irb_gl *gl;

/* Parameters from "name", "value", ..., NULL; the caller frees them. */
static void *make_params(const struct irb_method *method, const char *const *settings)
{
    struct irb_error err = {0};
    void *params = calloc(1, method->params_size);
    irb_options_default(method->params, params);
    for (; settings && *settings; settings += 2)
        REQUIRE_OK(irb_option_set(method->params, params, settings[0], settings[1], &err));
    return params;
}

static struct irb_frame_inputs inputs_of(const struct fixture_frame *f, const void *params,
                                         uint64_t seed, int frame)
{
    return (struct irb_frame_inputs){.scene = f->scene_gl,
                                     .light = &f->light,
                                     .camera = &f->camera,
                                     .gbuffer = f->gbuffer,
                                     .rsm = f->rsm,
                                     .frame = frame,
                                     .seed = seed,
                                     .params = params};
}

/* Irradiance (4 channels) of frame `frame` with fresh state. */
static struct irb_image render_with(const struct irb_method *method, const struct fixture_frame *f,
                                    const char *const *settings, uint64_t seed, int frame,
                                    struct irb_frame_output *out)
{
    struct irb_error err = {0};
    void *params = make_params(method, settings);
    void *state =
        method->create(gl, f->scene_gl, f->gbuffer->width, f->gbuffer->height, params, &err);
    REQUIRE_OK(state);
    REQUIRE_OK(method->begin_sequence(state, params, seed, &err));
    const struct irb_frame_inputs inputs = inputs_of(f, params, seed, frame);
    REQUIRE_OK(method->render_frame(state, &inputs, out, &err));
    struct irb_image image = fixture_read(out->irradiance, 4);
    method->destroy(state);
    free(params);
    return image;
}

static struct irb_image render(const struct fixture_frame *f, const char *const *settings,
                               struct irb_frame_output *out)
{
    return render_with(ism, f, settings, 0, 0, out);
}

static double statistic(const struct irb_frame_output *out, const char *name)
{
    for (int i = 0; i < out->statistic_count; i++)
        if (!strcmp(out->statistics[i].name, name))
            return out->statistics[i].value;
    fail_msg("no statistic '%s'", name);
    return 0;
}

static void make_frame(struct fixture_frame *f, const char *scene, int width, int height,
                       int resolution)
{
    fixture_frame_create(f, gl, fixture_scene(scene), width, height, resolution);
    fixture_view(f->scene, &f->light, &f->camera);
    fixture_frame_render(f);
}

/* Without shadows and tiles it is plain RSM with the same lights, and loses what that loses by a
 * clamp. */
static void test_unoccluded(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_frame(&f, "cornell", 67, 30, 64);
    const char *const clamps[] = {"0", "3"};
    for (int k = 0; k < 2; k++) {
        const char *const settings[] = {
            "visibility", "none",  "vpls",    "300", "interleave_n", "1", "interleave_m",
            "1",          "clamp", clamps[k], NULL};
        const char *const plain[] = {"mode",  "importance", "samples", "300",
                                     "clamp", clamps[k],    NULL};
        struct irb_frame_output out, expected_out;
        struct irb_image found = render(&f, settings, &out);
        struct irb_image expected = render_with(&irb_method_rsm, &f, plain, 0, 0, &expected_out);
        for (size_t i = 0; i < irb_image_pixels(&found); i++)
            for (size_t c = 0; c < 3; c++)
                REQUIRE_NEAR(found.data[4 * i + c], expected.data[4 * i + c],
                             1e-4 * (double)expected.data[4 * i + c]);
        REQUIRE_NEAR(out.clamped_light, expected_out.clamped_light, 1e-4);
        REQUIRE_NEAR(statistic(&out, "vpls"), 300, 0);
        irb_image_destroy(&found);
        irb_image_destroy(&expected);
    }
    fixture_frame_destroy(&f);
}

static void add_square(struct irb_builder *builder, double y, double half, bool up)
{
    const float white[3] = {0.5f, 0.5f, 0.5f};
    const double s = up ? half : -half;
    const double corners[4][3] = {{-half, y, s}, {half, y, s}, {half, y, -s}, {-half, y, -s}};
    irb_builder_object(builder, "square", irb_builder_material(builder, "m", white));
    irb_builder_quad(builder, corners);
}

/* A lamp just below a plate lights a spot of the floor; the plate, at half height, shades the
 * square of twice its size on the ceiling. */
enum { PLATE_SIDE = 80 };
static const double plate_half = 0.25, plate_height = 1, ceiling_height = 2;

static void make_plate(struct fixture_frame *f)
{
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "plate");
    add_square(&builder, 0, 2, true);
    add_square(&builder, plate_height, plate_half, true);
    add_square(&builder, ceiling_height, 2, false);
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    fixture_frame_create(f, gl, scene, PLATE_SIDE, PLATE_SIDE, 32);
    f->light = fixture_spot((const float[3]){0, 0.9f, 0}, (const float[3]){0, 0, 0}, 0.5);
    f->camera = fixture_camera((const float[3]){0, 1.01f, 0}, (const float[3]){0, 2, 0},
                               (const float[3]){0, 0, 1}, 100);
    fixture_frame_render(f);
}

/* The light is within 0.01 m of the origin: umbra, full light, and an edge that is blurred by less
 * than `edge`: a texel of the map is 0.03 rad, 0.07 m on the ceiling, and splats are a few texels.
 */
static void check_plate(const struct fixture_frame *f, const char *const *settings, double edge)
{
    struct irb_frame_output out;
    const char *one_light[20] = {"vpls", "1", "interleave_n", "1", "interleave_m", "1"};
    const char *const unoccluded[] = {"visibility", "none",         "vpls", "1", "interleave_n",
                                      "1",          "interleave_m", "1",    NULL};
    for (int k = 0; settings[k]; k++)
        one_light[6 + k] = settings[k];
    struct irb_image lit = render(f, unoccluded, &out), found = render(f, one_light, &out);
    struct irb_image position = fixture_read(f->gbuffer->position, 4);
    double flux = 0;
    struct irb_image reflected = fixture_read(f->rsm->flux, 4);
    flux = fixture_sum(&reflected, 1);
    int umbra = 0, full = 0, wrong = 0;
    for (size_t i = 0; i < irb_image_pixels(&found); i++) {
        const float *p = position.data + 4 * i;
        const double across = fmax(fabs((double)p[0]), fabs((double)p[2]));
        const double r2 = (double)p[0] * p[0] + (double)p[1] * p[1] + (double)p[2] * p[2];
        const double shade = plate_half * ceiling_height / plate_height;
        /* Phi/pi cos cos / r^2 with both cosines h/r */
        REQUIRE_REL(lit.data[4 * i + 1], flux / M_PI * ceiling_height * ceiling_height / (r2 * r2),
                    0.03);
        if (across < shade - edge) {
            umbra++;
            wrong += found.data[4 * i + 1] != 0;
        } else if (across > shade + edge) {
            full++;
            wrong +=
                fabsf(found.data[4 * i + 1] - lit.data[4 * i + 1]) > 1e-4f * lit.data[4 * i + 1];
        }
    }
    print_message("%s: %d pixels of umbra, %d in full light, %d wrong\n", settings[1], umbra, full,
                  wrong);
    REQUIRE_CMP(umbra, >, 100);
    REQUIRE_CMP(full, >, 1000);
    REQUIRE_NEAR(wrong, 0, 0);
    irb_image_destroy(&lit);
    irb_image_destroy(&found);
    irb_image_destroy(&position);
    irb_image_destroy(&reflected);
}

static void test_plate(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_plate(&f);
    static const char *const settings[][13] = {
        {"points", "area", "point_count", "500000"},
        {"points", "area", "point_count", "100000", "adaptive_points", "0.9"},
        {"points", "area", "point_count", "500000", "splatter", "raster"},
        {"points", "tessellation", "f_min", "64", "f_max", "64"},
        {"points", "dynamic", "f_min", "64", "f_max", "64"},
        {"visibility", "exact-raster"}};
    for (int k = 0; k < 6; k++)
        check_plate(&f, settings[k], k < 5 ? 0.2 : 0.05);
    fixture_frame_destroy(&f);
}

/* The same frame twice, bit by bit, whatever makes points and splats; the sequence `fixed` is the
 * same in all frames, `random` is not, and nor are redrawn points. */
static void test_same_bits(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell-objects", 50, 38, 64);
    static const char *const settings[][13] = {
        {"vpls", "64", "point_count", "20000"},
        {"vpls", "64", "point_count", "20000", "splatter", "raster", "pull", "median"},
        {"vpls", "64", "f_min", "1", "f_max", "8", "points", "tessellation"},
        {"vpls", "64", "f_min", "1", "f_max", "8", "points", "dynamic"},
        {"vpls", "64", "point_count", "20000", "importance", "bidirectional"},
        {"vpls", "64", "point_count", "20000", "adaptive_points", "0.9"},
        {"vpls", "64", "point_count", "20000", "sequence", "random"},
        {"vpls", "64", "point_count", "20000", "redraw_points", "true"},
        {"vpls", "64", "point_count", "20000", "redraw_points", "true", "adaptive_points", "0.5"},
        {"vpls", "64", "visibility", "exact-raster", "sequence", "random"}};
    for (int k = 0; k < 10; k++) {
        struct irb_image one = render_with(ism, &f, settings[k], 5, 3, &out);
        struct irb_image two = render_with(ism, &f, settings[k], 5, 3, &out);
        struct irb_image next = render_with(ism, &f, settings[k], 5, 4, &out);
        struct irb_image other = render_with(ism, &f, settings[k], 6, 3, &out);
        size_t bytes = irb_image_pixels(&one) * 16;
        assert_memory_equal(one.data, two.data, bytes);
        assert_int_equal(memcmp(one.data, next.data, bytes) != 0, k >= 6);
        assert_memory_not_equal(one.data, other.data, bytes);
        irb_image_destroy(&one);
        irb_image_destroy(&two);
        irb_image_destroy(&next);
        irb_image_destroy(&other);
    }
    fixture_frame_destroy(&f);
}

/* One state through frames whose parameters, light and image size change gives what a fresh one
 * would; a dark light gives zeros. */
static void test_changing_frames(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "cornell", 20, 15, 32);
    void *params = make_params(ism, NULL);
    void *method = ism->create(gl, f.scene_gl, 7, 5, params, &err);
    REQUIRE_OK(method);
    REQUIRE_OK(ism->resize(method, 20, 15, &err));
    static const char *const frames[][12] = {
        {"vpls", "16", "point_count", "5000"},
        {"vpls", "1024", "interleave_n", "4"},
        {"vpls", "100", "importance", "bidirectional", "map_size", "64"},
        {"vpls", "30", "visibility", "none"},
        {"visibility", "ism", "points", "dynamic", "f_min", "2", "f_max", "4"},
        {"points", "tessellation", "pull_push", "5"},
        {"points", "area", "adaptive_points", "0.9", "vpls", "40"},
        {"adaptive_points", "0"},
        {"adaptive_points", "0.9", "points", "tessellation"},
        {"visibility", "exact-raster", "vpls", "20"},
        {"visibility", "ism", "points", "area", "importance", "flux", "clamp", "3"}};
    const char *all[64] = {0};
    int count = 0;
    for (int i = 0; i < 22; i++) {
        const bool dark = i % 2 == 1;
        for (int k = 0; i % 2 == 0 && frames[i / 2][k]; k += 2) {
            all[count++] = frames[i / 2][k];
            all[count++] = frames[i / 2][k + 1];
            REQUIRE_OK(
                irb_option_set(ism->params, params, frames[i / 2][k], frames[i / 2][k + 1], &err));
        }
        struct irb_light light = f.light;
        if (dark)
            memset(light.intensity, 0, sizeof light.intensity);
        REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &light, &err));
        const struct irb_frame_inputs inputs = inputs_of(&f, params, 0, 0);
        REQUIRE_OK(ism->render_frame(method, &inputs, &out, &err));
        struct irb_image found = fixture_read(out.irradiance, 4);
        if (dark) {
            REQUIRE_NEAR(statistic(&out, "vpls"), 0, 0);
            for (int c = 0; c < 4; c++)
                REQUIRE_NEAR(fixture_sum(&found, c), 0, 0);
        } else {
            REQUIRE_CMP(fixture_sum(&found, 1), >, 0);
        }
        struct irb_image fresh = render(&f, all, &out);
        assert_memory_equal(found.data, fresh.data, irb_image_pixels(&found) * 16);
        irb_image_destroy(&found);
        irb_image_destroy(&fresh);
    }
    ism->destroy(method);
    free(params);
    fixture_frame_destroy(&f);
}

/* Sum over the image of one channel without shadows, by settings. */
static double unoccluded_sum(const struct fixture_frame *f, const char *const *settings)
{
    struct irb_frame_output out;
    struct irb_image e = render(f, settings, &out);
    double sum = fixture_sum(&e, 1);
    for (size_t i = 0; i < irb_image_pixels(&e); i++)
        for (size_t c = 0; c < 4; c++)
            assert_true(isfinite(e.data[4 * i + c]) && e.data[4 * i + c] >= 0);
    irb_image_destroy(&e);
    return sum;
}

/* The fewest and the most lights, tiles or none, and either importance: all estimate the same
 * light. Receivers far from the lights, so that none is singular. */
static void test_energy(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_frame(&f, "squares", 48, 48, 64);
    static const struct {
        const char *vpls, *n, *importance;
        double allowed;
    } cases[] = {{"16", "1", "flux", 0.03},    {"1024", "1", "flux", 0.003},
                 {"1024", "3", "flux", 0.003}, {"1000", "4", "bidirectional", 0.01},
                 {"512", "8", "flux", 0.02},   {"1023", "1", "bidirectional", 0.01}};
    struct irb_frame_output out;
    const char *const all[] = {"mode", "all", NULL};
    struct irb_image exact = render_with(&irb_method_rsm, &f, all, 0, 0, &out);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const char *const settings[] = {
            "visibility", "none",         "vpls",     cases[k].vpls, "interleave_n",
            cases[k].n,   "interleave_m", cases[k].n, "importance",  cases[k].importance,
            NULL};
        REQUIRE_REL(unoccluded_sum(&f, settings), fixture_sum(&exact, 1), cases[k].allowed);
    }
    irb_image_destroy(&exact);
    fixture_frame_destroy(&f);
}

/* The scene a thousand times smaller or larger, and light a million times weaker or stronger: E
 * goes with I/s^2, and shadows and clamp take the same share. */
static void test_scales(void **state)
{
    (void)state;
    const float scales[] = {1, 1e-3f, 1e3f}, intensities[] = {1, 1e6f, 1e-6f};
    const char *const settings[] = {"vpls", "64", "point_count", "64000", "clamp", "5", NULL};
    double sum = 0, lost = 0;
    for (int k = 0; k < 3; k++) {
        struct fixture_frame f;
        struct irb_frame_output out;
        struct irb_scene *scene = fixture_scene("cornell-objects");
        const float s = scales[k];
        fixture_frame_create(&f, gl, scene, 24, 18, 64);
        fixture_view(scene, &f.light, &f.camera);
        irb_scene_gl_destroy(f.scene_gl);
        for (size_t i = 0; i < 3 * (size_t)scene->vertex_count; i++)
            scene->positions[i] *= s;
        for (int i = 0; i < 3; i++) {
            scene->bounds_min[i] *= s;
            scene->bounds_max[i] *= s;
            f.light.position[i] *= s;
            f.light.intensity[i] = intensities[k];
            f.camera.position[i] *= s;
            f.camera.target[i] *= s;
        }
        f.camera.z_near *= s;
        f.camera.z_far *= s;
        struct irb_error err = {0};
        REQUIRE_OK(f.scene_gl = irb_scene_gl_create(gl, scene, &err));
        fixture_frame_render(&f);
        struct irb_image e = render(&f, settings, &out);
        const double found = fixture_sum(&e, 1) * (double)s * (double)s / (double)intensities[k];
        sum = k ? sum : found;
        lost = k ? lost : out.clamped_light;
        REQUIRE_REL(found, sum, 5e-3);
        REQUIRE_REL(out.clamped_light, lost, 0.02);
        irb_image_destroy(&e);
        fixture_frame_destroy(&f);
    }
    REQUIRE_CMP(lost, >, 0.001);
}

/* Either layout of G-buffer and RSM; what the slim ones cost. */
static void test_slim_layouts(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame full, slim;
    struct irb_frame_output out;
    const char *const importances[] = {"flux", "bidirectional"};
    make_frame(&full, "cornell", 48, 36, 64);
    slim = full;
    REQUIRE_OK(slim.gbuffer = irb_gbuffer_create_layout(gl, IRB_LAYOUT_SLIM, 48, 36, &err));
    REQUIRE_OK(slim.rsm = irb_rsm_create_layout(gl, IRB_LAYOUT_SLIM, 64, &err));
    fixture_frame_render(&slim);
    for (int k = 0; k < 2; k++) {
        const char *const settings[] = {"vpls", "256",        "point_count",  "64000", "clamp",
                                        "30",   "importance", importances[k], NULL};
        struct irb_image a = render(&full, settings, &out), b = render(&slim, settings, &out);
        double difference = 0;
        for (size_t i = 0; i < irb_image_pixels(&a); i++)
            difference += fabs((double)a.data[4 * i + 1] - b.data[4 * i + 1]);
        print_message("%s: slim against full, mean %.3f\n", importances[k],
                      difference / fixture_sum(&a, 1));
        REQUIRE_CMP(difference, <, 0.1 * fixture_sum(&a, 1)); /* other texels are drawn */
        REQUIRE_CMP(difference, >, 0);
        irb_image_destroy(&a);
        irb_image_destroy(&b);
    }
    irb_gbuffer_destroy(slim.gbuffer);
    irb_rsm_destroy(slim.rsm);
    fixture_frame_destroy(&full);
}

/* Coverage grows with points and by pull-push, in a closed room to nearly all of the maps; shadows
 * only take light away. */
static void test_coverage(void **state)
{
    (void)state;
    struct fixture_frame f;
    struct irb_frame_output out;
    make_frame(&f, "furnace", 40, 30, 64);
    static const char *const counts[] = {"2000", "20000", "200000"};
    double before = 0, after = 0;
    const char *const unoccluded[] = {"visibility", "none", "vpls", "64", NULL};
    struct irb_image lit = render(&f, unoccluded, &out);
    for (int k = 0; k < 3; k++) {
        const char *const settings[] = {"vpls", "64", "point_count", counts[k], NULL};
        struct irb_image e = render(&f, settings, &out);
        print_message("%s points: coverage %.3f, %.3f after pull-push\n", counts[k],
                      statistic(&out, "coverage_splatted"), statistic(&out, "coverage"));
        REQUIRE_CMP(statistic(&out, "coverage_splatted"), >, before);
        REQUIRE_CMP(statistic(&out, "coverage"), >=, statistic(&out, "coverage_splatted"));
        REQUIRE_CMP(statistic(&out, "coverage"), >, after);
        before = statistic(&out, "coverage_splatted");
        after = statistic(&out, "coverage");
        for (size_t i = 0; i < 4 * irb_image_pixels(&e); i++)
            if (i % 4 != 3)
                REQUIRE_CMP(e.data[i], <=, lit.data[i] * 1.0001f);
        irb_image_destroy(&e);
    }
    REQUIRE_CMP(after, >, 0.95);
    REQUIRE_CMP(after, <=, 1);
    irb_image_destroy(&lit);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unoccluded), cmocka_unit_test(test_plate),
        cmocka_unit_test(test_same_bits),  cmocka_unit_test(test_changing_frames),
        cmocka_unit_test(test_energy),     cmocka_unit_test(test_coverage),
        cmocka_unit_test(test_scales),     cmocka_unit_test(test_slim_layouts),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
