/* SPDX-License-Identifier: MIT
 *
 * The importance map of an RSM against eqs 4.1-4.3, 5.1 and 5.2 of the thesis in double precision,
 * from the materials and the light themselves, not from the RSM's flux.
 */
#include "tests/support/compare.h"
#include "core/lights/importance.h"
#include "core/sampling/halton.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

enum { N = 48, WIDTH = 40, HEIGHT = 30 };

/* By their positions: floor y = 0, wall z = -1, and two plates 0.2 m above the floor. */
static const struct {
    float diffuse[3], specular[3], exponent;
} materials[] = {
    {{0.7f, 0.4f, 0.1f}, {0.0f, 0.0f, 0.0f}, 1},  /* floor */
    {{0.2f, 0.2f, 0.9f}, {0.3f, 0.5f, 0.1f}, 40}, /* wall */
    {{0.0f, 0.0f, 0.0f}, {0.9f, 0.9f, 0.9f}, 99}, /* left plate: mirror-like, no flux */
    {{0.1f, 0.8f, 0.3f}, {0.1f, 0.0f, 0.2f}, 8},  /* right plate */
};

static struct irb_scene *make_scene(void)
{
    static const double quads[4][4][3] = {
        {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
        {{-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}},
        {{-0.7, 0.2, 0.3}, {-0.2, 0.2, 0.3}, {-0.2, 0.2, -0.3}, {-0.7, 0.2, -0.3}},
        {{0.2, 0.2, 0.3}, {0.7, 0.2, 0.3}, {0.7, 0.2, -0.3}, {0.2, 0.2, -0.3}}};
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "plates");
    for (int i = 0; i < 4; i++) {
        irb_builder_object(&builder, "quad",
                           irb_builder_material(&builder, "m", materials[i].diffuse));
        irb_builder_quad(&builder, quads[i]);
    }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    for (int i = 0; i < 4; i++) {
        memcpy(scene->materials[i].specular, materials[i].specular, 12);
        scene->materials[i].exponent = materials[i].exponent;
    }
    return scene;
}

static int material_at(const float p[3])
{
    return p[2] + 1 < fminf(p[1], 0.01f) ? 1 : p[1] < 0.1f ? 0 : p[0] < 0 ? 2 : 3;
}

/* kind: 0..2 a spot by its falloff, 3 a beam. */
static void make_frame(struct fixture_frame *f, int kind, enum irb_layout layout)
{
    struct irb_error err = {0};
    fixture_frame_create(f, gl, make_scene(), WIDTH, HEIGHT, N);
    irb_rsm_destroy(f->rsm);
    irb_gbuffer_destroy(f->gbuffer);
    REQUIRE_OK(f->rsm = irb_rsm_create_layout(gl, layout, N, &err));
    REQUIRE_OK(f->gbuffer = irb_gbuffer_create_layout(gl, layout, WIDTH, HEIGHT, &err));
    f->light =
        fixture_spot((const float[3]){0.3f, 1.8f, 0.9f}, (const float[3]){0, 0.3f, -0.4f}, 38);
    f->light.falloff = (enum irb_falloff)(kind % 3);
    if (kind == 3) {
        f->light.type = IRB_LIGHT_DIRECTIONAL;
        f->light.half_width = 0.8f;
    }
    /* the corners of the image see past the wall */
    f->camera = fixture_camera((const float[3]){0.2f, 1, 3}, (const float[3]){0, 0.8f, 0},
                               (const float[3]){0, 1, 0}, 60);
    fixture_frame_render(f);
}

static struct irb_image compute(const struct fixture_frame *f,
                                const struct irb_importance_settings *settings)
{
    struct irb_error err = {0};
    struct irb_importance *importance = irb_importance_create(gl, f->rsm->resolution, &err);
    REQUIRE_OK(importance);
    REQUIRE_OK(irb_importance_compute(importance, f->rsm, &f->light, f->gbuffer, settings, &err));
    struct irb_image map = fixture_read(importance->map, 1);
    irb_importance_destroy(importance);
    return map;
}

static double max_rgb(const float k[3], const float l[3])
{
    double most = 0;
    for (int c = 0; c < 3; c++)
        most = fmax(most, (double)k[c] * l[c]);
    return most;
}

/* Texel (x, y) of the image, whose first row is at the top. */
static double expected_brdf(const struct fixture_frame *f, int x, int y, const float position[3],
                            double diffuse_weight)
{
    const int m = material_at(position);
    const double side = 2 * tan((double)f->light.outer) / N;
    double u = (x + 0.5) * side - tan((double)f->light.outer);
    double v = (N - 1 - y + 0.5) * side - tan((double)f->light.outer);
    double falloff = f->light.type == IRB_LIGHT_DIRECTIONAL
                         ? 1
                         : irb_light_falloff(&f->light, 1 / sqrt(1 + u * u + v * v));
    return falloff * (diffuse_weight * max_rgb(materials[m].diffuse, f->light.intensity) +
                      (1 - diffuse_weight) * max_rgb(materials[m].specular, f->light.intensity) *
                          materials[m].exponent);
}

/* Mean of max(0, n.l), or of the bounded geometry term, over the Halton points that fall on
 * geometry. */
static double expected_view(const struct irb_image *position, const struct irb_image *normal,
                            const float texel[3], const float texel_normal[3],
                            const struct irb_importance_settings *s)
{
    double sum = 0, valid = 0;
    for (int i = 0; i < s->view_samples; i++) {
        float point[2];
        irb_halton_2d(s->first + 1 + (uint32_t)i, point);
        int x = (int)(point[0] * WIDTH), y = HEIGHT - 1 - (int)(point[1] * HEIGHT);
        const float *p = irb_image_at(position, x, y), *n = irb_image_at(normal, x, y);
        if (p[3] == 0)
            continue;
        double d[3] = {(double)texel[0] - p[0], (double)texel[1] - p[1], (double)texel[2] - p[2]};
        double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        double cosine = fmax(0, (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / r), b = 1;
        if (s->view_form == IRB_IMPORTANCE_GEOMETRY) {
            b = fmin(1, (double)s->view_nearest / r);
            b *= b * fmax(0, -(texel_normal[0] * d[0] + texel_normal[1] * d[1] +
                               texel_normal[2] * d[2]) /
                                 r);
        }
        sum += cosine * b;
        valid++;
    }
    return valid > 0 ? sum / valid : 0;
}

static void check_map(const struct fixture_frame *f, const struct irb_importance_settings *s)
{
    struct irb_image found = compute(f, s), flux = fixture_read(f->rsm->flux, 4);
    struct irb_image texels = fixture_read(f->rsm->position, 4);
    struct irb_image normals = fixture_read(f->rsm->normal, 4);
    struct irb_image position = fixture_read(f->gbuffer->position, 4);
    struct irb_image normal = fixture_read(f->gbuffer->normal, 4);
    double most = 0, largest = 0;
    for (int pass = 0; pass < 2; pass++) /* the maximum, then the map */
        for (int y = 0; y < N; y++)
            for (int x = 0; x < N; x++) {
                const float *p = irb_image_at(&texels, x, y), *phi = irb_image_at(&flux, x, y);
                const bool lit = phi[0] + phi[1] + phi[2] > 0;
                double rho = lit ? expected_brdf(f, x, y, p, (double)s->diffuse_weight) : 0;
                most = fmax(most, rho);
                if (pass == 0)
                    continue;
                if (s->norm == IRB_IMPORTANCE_NORM_MAX)
                    rho = most > 0 ? rho / most : 0;
                if (lit && s->view_weight > 0)
                    rho = (1 - (double)s->view_weight) * rho +
                          (double)s->view_weight *
                              expected_view(&position, &normal, p, irb_image_at(&normals, x, y), s);
                REQUIRE_NEAR(*irb_image_at(&found, x, y), rho, 2e-5 * rho + 1e-7);
                largest = fmax(largest, rho);
            }
    REQUIRE_CMP(largest, >, 0.1);
    irb_image_destroy(&found);
    irb_image_destroy(&flux);
    irb_image_destroy(&texels);
    irb_image_destroy(&normals);
    irb_image_destroy(&position);
    irb_image_destroy(&normal);
}

static void test_equations(void **state)
{
    (void)state;
    static const struct irb_importance_settings settings[] = {
        {1, 0, 0, IRB_IMPORTANCE_NORM_MAX, 0},
        {0.3f, 0, 0, IRB_IMPORTANCE_NORM_MAX, 0},
        {0.9f, 0, 0, IRB_IMPORTANCE_NORM_NONE, 0},
        {0.5f, 0.4f, 37, IRB_IMPORTANCE_NORM_MAX, 5},
        {1, 1, 3, IRB_IMPORTANCE_NORM_MAX, 0},
        {1, 0.5f, 1024, IRB_IMPORTANCE_NORM_NONE, 0},
        {1, 1, 256, IRB_IMPORTANCE_NORM_MAX, 0, IRB_IMPORTANCE_GEOMETRY, 1},
        {1, 0.5f, 99, IRB_IMPORTANCE_NORM_MAX, 7, IRB_IMPORTANCE_GEOMETRY, 0.3f}};
    for (int kind = 0; kind < 4; kind++) {
        struct fixture_frame f;
        make_frame(&f, kind, IRB_LAYOUT_FULL);
        for (size_t k = 0; k < sizeof settings / sizeof *settings; k++)
            check_map(&f, &settings[k]);
        fixture_frame_destroy(&f);
    }
}

/* Texels without flux are 0, the black plate of the brightest highlight among them; so is all of
 * the map where the light is dark or no view sample shows geometry. */
static void test_dark(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f;
    make_frame(&f, 1, IRB_LAYOUT_FULL);
    const struct irb_importance_settings s = {0.5f, 0.5f, 64, IRB_IMPORTANCE_NORM_MAX, 0};
    struct irb_image lit = compute(&f, &s), flux = fixture_read(f.rsm->flux, 4);
    int dark = 0;
    for (size_t i = 0; i < irb_image_pixels(&lit); i++)
        if (flux.data[4 * i] + flux.data[4 * i + 1] + flux.data[4 * i + 2] == 0) {
            REQUIRE_NEAR(lit.data[i], 0, 0);
            dark += flux.data[4 * i + 3] > 0; /* flux in, none out */
        } else {
            REQUIRE_CMP(lit.data[i], >, 0);
            REQUIRE_CMP(lit.data[i], <=, 1);
        }
    REQUIRE_CMP(dark, >, 10);
    f.camera.target[2] = 9; /* turned away */
    REQUIRE_OK(irb_gbuffer_render(f.gbuffer, f.scene_gl, &f.camera, &err));
    const struct irb_importance_settings view = {1, 1, 64, IRB_IMPORTANCE_NORM_MAX, 0};
    struct irb_image unseen = compute(&f, &view);
    REQUIRE_NEAR(fixture_sum(&unseen, 0), 0, 0);
    memset(f.light.intensity, 0, sizeof f.light.intensity);
    REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &f.light, &err));
    struct irb_image black = compute(&f, &s);
    for (size_t i = 0; i < irb_image_pixels(&black); i++)
        REQUIRE_NEAR(black.data[i], 0, 0);
    irb_image_destroy(&lit);
    irb_image_destroy(&flux);
    irb_image_destroy(&unseen);
    irb_image_destroy(&black);
    fixture_frame_destroy(&f);
}

/* Trap 11: the normalised map does not know the light's unit. A power of two changes no bit. */
static void test_intensity(void **state)
{
    (void)state;
    const float factors[] = {0x1p-10f, 0x1p12f, 1e-3f, 1e3f};
    const struct irb_importance_settings s = {0.6f, 0.3f, 32, IRB_IMPORTANCE_NORM_MAX, 0};
    struct irb_error err = {0};
    struct fixture_frame f;
    make_frame(&f, 2, IRB_LAYOUT_FULL);
    struct irb_image first = compute(&f, &s);
    const struct irb_light light = f.light;
    for (int k = 0; k < 4; k++) {
        for (int c = 0; c < 3; c++)
            f.light.intensity[c] = light.intensity[c] * factors[k];
        REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &f.light, &err));
        struct irb_image map = compute(&f, &s);
        for (size_t i = 0; i < irb_image_pixels(&map); i++)
            REQUIRE_NEAR(map.data[i], first.data[i], k < 2 ? 0 : 1e-6);
        irb_image_destroy(&map);
    }
    irb_image_destroy(&first);
    fixture_frame_destroy(&f);
}

/* The slim layouts change the map by what they round: flux and k_s to 1/255, which is 2 % of a k_s
 * of 0.1, and the exponent to 2.3 %. */
static void test_slim(void **state)
{
    (void)state;
    const struct irb_importance_settings s = {0.6f, 0.3f, 64, IRB_IMPORTANCE_NORM_MAX, 0};
    struct fixture_frame full, slim;
    make_frame(&full, 1, IRB_LAYOUT_FULL);
    make_frame(&slim, 1, IRB_LAYOUT_SLIM);
    struct irb_image a = compute(&full, &s), b = compute(&slim, &s);
    double difference = 0;
    for (size_t i = 0; i < irb_image_pixels(&a); i++)
        difference += fabs((double)a.data[i] - b.data[i]);
    REQUIRE_CMP(difference, <, 0.05 * fixture_sum(&a, 0));
    REQUIRE_CMP(difference, >, 0);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
    fixture_frame_destroy(&full);
    fixture_frame_destroy(&slim);
}

/* The same twice, and settings and layouts that change between calls of one object. */
static void test_one_object(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame frames[2];
    make_frame(&frames[0], 1, IRB_LAYOUT_FULL);
    make_frame(&frames[1], 3, IRB_LAYOUT_SLIM);
    struct irb_importance *importance = irb_importance_create(gl, N, &err);
    REQUIRE_OK(importance);
    for (int k = 0; k < 6; k++) {
        const struct fixture_frame *f = &frames[k % 2];
        const struct irb_importance_settings s = {0.5f, k < 3 ? 0.5f : 0, 16, k % 2, 7};
        REQUIRE_OK(irb_importance_compute(importance, f->rsm, &f->light, f->gbuffer, &s, &err));
        struct irb_image map = fixture_read(importance->map, 1), fresh = compute(f, &s);
        assert_memory_equal(map.data, fresh.data, N * N * sizeof(float));
        irb_image_destroy(&map);
        irb_image_destroy(&fresh);
    }
    const struct irb_importance_settings many = {0.5f, 0.5f, 1025, 0, 0};
    assert_false(irb_importance_compute(importance, frames[0].rsm, &frames[0].light,
                                        frames[0].gbuffer, &many, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_importance_destroy(importance);
    fixture_frame_destroy(&frames[0]);
    fixture_frame_destroy(&frames[1]);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equations),  cmocka_unit_test(test_dark),
        cmocka_unit_test(test_intensity),  cmocka_unit_test(test_slim),
        cmocka_unit_test(test_one_object),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
