/* SPDX-License-Identifier: MIT
 *
 * Visibility, sides, direct light, scale, and inputs that must not end in NaN.
 */
#include "tests/reference/fixture.h"
#include "tests/support/compare.h"

#include <stdlib.h>

static const float grey[3] = {0.5f, 0.5f, 0.5f};

/* A square of the plane y = height, half side `half`. Two-sided, so its winding is of no account.
 */
static void level_square(struct irb_builder *builder, double x, double height, double half)
{
    const double corners[4][3] = {{x - half, height, half},
                                  {x + half, height, half},
                                  {x + half, height, -half},
                                  {x - half, height, -half}};
    irb_builder_quad(builder, corners);
}

static struct irb_scene *two_levels(bool blocker)
{
    struct irb_error err;
    struct irb_builder builder;
    irb_builder_begin(&builder, "levels");
    irb_builder_object(&builder, "all", irb_builder_material(&builder, "grey", grey));
    level_square(&builder, 0, 0, 0.5);
    level_square(&builder, 0, 1, 0.5);
    if (blocker)
        level_square(&builder, 0, 0.5, 5);
    return irb_builder_finish(&builder, &err);
}

/* A beam from just below the blocker lights the lower square; the upper one can't see it. */
static void test_blocker(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    fixture_create(&f, two_levels(true));
    fixture_beam(&f, (double[]){0, 0.4, 0}, (double[]){0, 0, 0}, 0.5, 10);
    f.settings.unoccluded = true;
    f.settings.bounces = 2;
    f.settings.min_samples = f.settings.max_samples = 1024;
    fixture_gbuffer(&f, 1, 1);
    fixture_point(&f, 0, 0, (double[]){0, 1, 0}, (double[]){0, -1, 0});
    fixture_must_render(&f, &out);
    REQUIRE_NEAR(out.bounce1.data[0], 0, 0);
    REQUIRE_CMP(out.variance.data[0], ==, 0);
    /* from the middle of one unit square to the other, 1 m away: F = 4 corner factors = 0.2395 */
    double r = sqrt(1.25), factor = 4 * (0.5 / r * atan(0.5 / r) * 2) / (2 * M_PI);
    REQUIRE_REL(out.unoccluded.data[0], 0.5 * 10 * factor, 0.01);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

/* A wall that is lit on one side gives nothing to what sees its other side. */
static void test_thin_wall_lit_from_behind(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    fixture_create(&f, two_levels(false));
    fixture_beam(&f, (double[]){0, -1, 0}, (double[]){0, 0, 0}, 0.5, 10);
    f.settings.unoccluded = true;
    f.settings.bounces = 4;
    fixture_gbuffer(&f, 2, 1);
    fixture_point(&f, 0, 0, (double[]){0.1, 1, 0}, (double[]){0, -1, 0});
    fixture_point(&f, 1, 0, (double[]){0.1, 0, 0}, (double[]){0, 1, 0});
    fixture_must_render(&f, &out);
    for (int i = 0; i < 2; i++) {
        REQUIRE_NEAR(out.direct.data[3 * i], 0, 0);
        REQUIRE_NEAR(out.bounce1.data[3 * i], 0, 0);
        REQUIRE_NEAR(out.bounce2.data[3 * i], 0, 0);
        REQUIRE_NEAR(out.rest.data[3 * i], 0, 0);
        REQUIRE_NEAR(out.unoccluded.data[3 * i], 0, 0);
    }
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

/* L = (k_d n.l + k_s (n.h)^alpha) I/(pi r^2), by hand. */
static void test_direct_light(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    fixture_create(&f, two_levels(false));
    fixture_spot(&f, (double[]){0.3, 0.9, 0}, (double[]){0.3, 0, 0}, 40, 7);
    f.camera.position[0] = -0.3f;
    f.camera.position[1] = 0.9f;
    fixture_gbuffer(&f, 3, 1);
    fixture_point(&f, 0, 0, (double[]){0, 0, 0}, (double[]){0, 1, 0});
    fixture_point(&f, 1, 0, (double[]){-0.49, 0, 0}, (double[]){0, 1, 0}); /* outside the cone */
    fixture_point(&f, 2, 0, (double[]){0.1, 1, 0}, (double[]){0, 1, 0});   /* behind the light */
    for (int c = 0; c < 3; c++)
        irb_image_at(&f.gbuffer.specular, 0, 0)[c] = 0.25f;
    irb_image_at(&f.gbuffer.specular, 0, 0)[3] = 20;
    fixture_must_render(&f, &out);
    /* light and eye are mirror images about the normal: n.h = 1 */
    double r2 = 0.3 * 0.3 + 0.9 * 0.9, cosine = 0.9 / sqrt(r2);
    REQUIRE_REL(out.direct.data[0], (0.5 * cosine + 0.25) * 7 / (M_PI * r2), 1e-5);
    REQUIRE_NEAR(out.direct.data[3], 0, 0);
    REQUIRE_NEAR(out.direct.data[6], 0, 0);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

static void require_finite(const struct irb_image *image)
{
    for (size_t i = 0; i < irb_image_pixels(image) * (size_t)image->channels; i++) {
        assert_true(isfinite(image->data[i]));
        REQUIRE_CMP(image->data[i], >=, 0);
    }
}

static void require_all_finite(const struct irb_reference_image *out)
{
    require_finite(&out->direct);
    require_finite(&out->bounce1);
    require_finite(&out->bounce2);
    require_finite(&out->rest);
    require_finite(&out->unoccluded);
    require_finite(&out->variance);
    require_finite(&out->unoccluded_variance);
    assert_true(isfinite(out->noise));
}

/* Lights on, in and behind geometry, at a shaded point, very bright and very dark, narrow and wide.
 */
static void test_nothing_ends_in_nan(void **state)
{
    (void)state;
    static const struct {
        double position[3], target[3], angle, intensity;
    } cases[] = {
        {{0.278, 0.5488, 0.2796}, {0.278, 0, 0.2796}, 50, 1}, /* in the ceiling */
        {{0.278, 0, 0.2796}, {0.278, 0.5, 0.2796}, 80, 1},    /* in the floor */
        {{0.278, -0.1, 0.2796}, {0.278, -1, 0.2796}, 50, 1},  /* nothing to light */
        {{0.278, 0.1, 0.3796}, {0.278, 0, 0.3796}, 89.9, 1},  /* close, wide */
        {{0.278, 0.5, 0.2796}, {0.278, 0, 0.2796}, 1e-3, 1},  /* a pencil */
        {{0.278, 0.5, 0.2796}, {0.278, 0, 0.2796}, 50, 1e6},
        {{0.278, 0.5, 0.2796}, {0.278, 0, 0.2796}, 50, 1e-6},
        {{0.278, 0.5, 0.2796}, {0.278, 0, 0.2796}, 50, 0},
    };
    struct fixture f;
    fixture_builtin(&f, "cornell");
    f.settings.bounces = 16;
    f.settings.unoccluded = true;
    f.settings.min_samples = f.settings.max_samples = 16;
    fixture_look(&f, 16, 12);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct irb_reference_image out;
        fixture_spot(&f, cases[i].position, cases[i].target, cases[i].angle, cases[i].intensity);
        fixture_must_render(&f, &out);
        require_all_finite(&out);
        irb_reference_image_destroy(&out);
    }
    /* the light at a shaded point itself */
    struct irb_reference_image out;
    for (int c = 0; c < 3; c++)
        f.light.position[c] = irb_image_at(&f.gbuffer.position, 8, 6)[c];
    f.light.intensity[0] = 1;
    fixture_must_render(&f, &out);
    require_all_finite(&out);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

static void test_black_scene(void **state)
{
    (void)state;
    static const float black[3] = {0, 0, 0};
    struct irb_error err;
    struct irb_builder builder;
    struct fixture f;
    struct irb_reference_image out;
    irb_builder_begin(&builder, "black");
    irb_builder_object(&builder, "all", irb_builder_material(&builder, "black", black));
    level_square(&builder, 0, 0, 0.5);
    level_square(&builder, 0, 1, 0.5);
    fixture_create(&f, irb_builder_finish(&builder, &err));
    fixture_beam(&f, (double[]){0, 0.5, 0}, (double[]){0, 0, 0}, 0.5, 10);
    f.settings.bounces = 4;
    fixture_gbuffer(&f, 1, 1);
    fixture_point(&f, 0, 0, (double[]){0, 1, 0}, (double[]){0, -1, 0});
    fixture_must_render(&f, &out);
    require_all_finite(&out);
    REQUIRE_NEAR(out.bounce1.data[0], 0, 0);
    REQUIRE_NEAR(out.noise, 0, 0);
    REQUIRE_NEAR(out.rest_remainder, 0, 0);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

/* The Cornell box `scale` times as large and moved by `shift`, its light's intensity times scale^2:
 * irradiance stays. */
static void render_scaled(double scale, double shift, struct irb_reference_image *out)
{
    struct fixture f, g;
    fixture_builtin(&f, "cornell");
    struct irb_scene *scene = f.scene;
    for (uint32_t i = 0; i < 3 * scene->vertex_count; i++)
        scene->positions[i] = (float)(scene->positions[i] * scale + shift);
    fixture_create(&g, scene);
    g.light = f.light;
    g.camera = f.camera;
    irb_tracer_destroy(f.tracer);
    for (int c = 0; c < 3; c++) {
        g.light.position[c] = (float)(g.light.position[c] * scale + shift);
        g.light.intensity[c] *= (float)(scale * scale);
        g.camera.position[c] = (float)(g.camera.position[c] * scale + shift);
        g.camera.target[c] = (float)(g.camera.target[c] * scale + shift);
    }
    g.settings.bounces = 4;
    g.settings.unoccluded = true;
    g.settings.min_samples = g.settings.max_samples = 256;
    fixture_look(&g, 12, 12);
    fixture_must_render(&g, out);
    fixture_destroy(&g);
}

static void require_same_light(const struct irb_reference_image *a,
                               const struct irb_reference_image *b, double tolerance)
{
    REQUIRE_REL(fixture_mean(&a->direct), fixture_mean(&b->direct), tolerance);
    REQUIRE_REL(fixture_mean(&a->bounce1), fixture_mean(&b->bounce1), tolerance);
    REQUIRE_REL(fixture_mean(&a->bounce2), fixture_mean(&b->bounce2), tolerance);
    REQUIRE_REL(fixture_mean(&a->rest), fixture_mean(&b->rest), tolerance);
    REQUIRE_REL(fixture_mean(&a->unoccluded), fixture_mean(&b->unoccluded), tolerance);
}

static void test_millimetres_and_kilometres(void **state)
{
    (void)state;
    /* Powers of two scale every rounding along, so only a length that does not scale (an absolute
     * epsilon) could make a difference. Others change roundings, and with them the tangent frame,
     * hence the samples, of the one wall whose normal is nearly in a coordinate plane. */
    static const struct {
        double scale, shift, tolerance;
    } cases[] = {{0x1p-10, 0, 1e-5},
                 {0x1p10, 0, 1e-5},
                 {1e-3, 0, 5e-3},
                 {1e3, 0, 5e-3},
                 {1, 100, 0.01} /* 200 times the box's size away */};
    struct irb_reference_image one, out;
    render_scaled(1, 0, &one);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        render_scaled(cases[i].scale, cases[i].shift, &out);
        require_same_light(&out, &one, cases[i].tolerance);
        irb_reference_image_destroy(&out);
    }
    irb_reference_image_destroy(&one);
}

/* A texture of one black and one white texel over the lit square: the white half reflects. */
static void test_texture(void **state)
{
    (void)state;
    static const float white[3] = {1, 1, 1};
    static const double corners[4][3] = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    /* columns of texel centres at u = 1/8, 3/8, 5/8, 7/8; 188 is 0.5029 when decoded */
    static const unsigned char row[4] = {188, 188, 0, 0};
    unsigned char *rgba = malloc(16);
    for (int i = 0; i < 16; i++)
        rgba[i] = row[i / 4];
    struct irb_error err;
    struct irb_builder builder;
    struct fixture f;
    struct irb_reference_image out;
    irb_builder_begin(&builder, "textured");
    int material = irb_builder_material(&builder, "paper", white);
    builder.scene->materials[material].diffuse_texture =
        irb_builder_texture(&builder, "stripes", 4, 1, rgba);
    irb_builder_object(&builder, "floor", material);
    for (int i = 0; i < 4; i++)
        irb_builder_vertex(&builder, corners[i], (double[]){0, 1, 0},
                           (double[]){corners[i][0] / 2 + 0.5, 0.5 - corners[i][2] / 2});
    irb_builder_triangle(&builder, 0, 1, 2);
    irb_builder_triangle(&builder, 0, 2, 3);
    fixture_create(&f, irb_builder_finish(&builder, &err));
    /* small beams well inside the two halves; E at a far point is albedo times E on the patch */
    fixture_gbuffer(&f, 1, 1);
    fixture_point(&f, 0, 0, (double[]){0, 1, 0}, (double[]){0, -1, 0});
    double mean[2];
    for (int half = 0; half < 2; half++) {
        double x = half ? 0.5 : -0.5, d2 = 1 + x * x;
        fixture_beam(&f, (double[]){x, 0.5, 0}, (double[]){x, 0, 0}, 0.1, 10);
        fixture_must_render(&f, &out);
        /* a patch of A = 0.04 m2, cosines 1/d: E = albedo/pi E0 A/d^4 but for the patch's size */
        mean[half] = (double)out.bounce1.data[0] / (10 / M_PI * 0.04 / (d2 * d2));
        irb_reference_image_destroy(&out);
    }
    REQUIRE_REL(mean[0], 0.5029, 0.02);
    REQUIRE_NEAR(mean[1], 0, 0);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_blocker),      cmocka_unit_test(test_thin_wall_lit_from_behind),
        cmocka_unit_test(test_direct_light), cmocka_unit_test(test_nothing_ends_in_nan),
        cmocka_unit_test(test_black_scene),  cmocka_unit_test(test_millimetres_and_kilometres),
        cmocka_unit_test(test_texture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
