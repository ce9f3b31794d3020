/* SPDX-License-Identifier: MIT
 *
 * Lights against definitions and numeric integrals.
 */
#include "core/scene/light.h"

#include "tests/support/compare.h"

#include <string.h>

static const double degree = M_PI / 180;

static struct irb_light spot(enum irb_falloff falloff, double outer_deg, double inner_deg)
{
    struct irb_light light = {.type = IRB_LIGHT_SPOT,
                              .position = {0.5f, 2, -1},
                              .direction = {0, -1, 0},
                              .intensity = {3, 2, 1},
                              .outer = (float)(outer_deg * degree),
                              .inner = (float)(inner_deg * degree),
                              .falloff = falloff};

    return light;
}

/* 2 pi int f(cos t) sin t dt, by the midpoint rule up to 90 degrees. */
static double integrated_power(const struct irb_light *light)
{
    const int steps = 400000;
    double sum = 0, step = M_PI / 2 / steps;

    for (int i = 0; i < steps; i++) {
        double theta = (i + 0.5) * step;

        sum += irb_light_falloff(light, cos(theta)) * sin(theta);
    }
    return 2 * M_PI * sum * step;
}

static void power_is_the_integral_of_the_intensity(void **state)
{
    static const double outer[] = {1, 10, 30, 60, 89}, inner_share[] = {0, 0.5, 0.99, 0.9999};
    (void)state;

    for (int falloff = 0; falloff < 3; falloff++)
        for (size_t o = 0; o < 5; o++)
            for (size_t i = 0; i < 4; i++) {
                struct irb_light light =
                    spot((enum irb_falloff)falloff, outer[o], outer[o] * inner_share[i]);
                double watts[3];

                irb_light_power(&light, watts);
                REQUIRE_REL(watts[0], 3 * integrated_power(&light), 1e-3);
                REQUIRE_REL(watts[1], watts[0] * 2 / 3, 1e-12);
            }
}

static void power_of_a_constant_hemisphere_is_2_pi(void **state)
{
    struct irb_light light = spot(IRB_FALLOFF_CONSTANT, 90, 0);
    double watts[3];
    (void)state;

    irb_light_power(&light, watts);
    REQUIRE_REL(watts[2], 2 * M_PI, 1e-6);
}

/* What arrives on a plane 1 m away is what leaves: checks 1/r^2, the cosine and the falloff. */
static void flux_through_a_plane_is_the_power(void **state)
{
    (void)state;
    for (int falloff = 0; falloff < 3; falloff++) {
        struct irb_light light = spot((enum irb_falloff)falloff, 50, 20);
        const int steps = 20000;
        double watts[3], flux = 0, step = tan(50 * degree) * 1.01 / steps;

        irb_light_power(&light, watts);
        for (int i = 0; i < steps; i++) {
            double radius = (i + 0.5) * step;
            float point[3] = {0.5f, 1, (float)(-1 + radius)}, e[3], to_light[3], distance;

            irb_light_incident(&light, point, e, to_light, &distance);
            REQUIRE_REL(distance, sqrt(1 + radius * radius), 1e-6);
            flux += e[0] * to_light[1] * 2 * M_PI * radius * step;
        }
        REQUIRE_REL(flux, watts[0], 1e-3);
    }
}

/* KHR_lights_punctual: ((cos t - cos outer)/(cos inner - cos outer))^2, clamped. */
static void falloffs_have_their_defined_values(void **state)
{
    struct irb_light light = spot(IRB_FALLOFF_SMOOTH, 60, 0);
    (void)state;

    REQUIRE_NEAR(irb_light_falloff(&light, 1), 1, 1e-6);
    REQUIRE_NEAR(irb_light_falloff(&light, 0.75), 0.25, 1e-6); /* halfway: 0.5^2 */
    REQUIRE_NEAR(irb_light_falloff(&light, 0.51), 0.0004, 1e-6);
    REQUIRE_NEAR(irb_light_falloff(&light, 0.49), 0, 0);
    light = spot(IRB_FALLOFF_SMOOTH, 60, 30);
    REQUIRE_NEAR(irb_light_falloff(&light, cos(20 * degree)), 1, 0);
    light = spot(IRB_FALLOFF_COSINE, 60, 0);
    REQUIRE_NEAR(irb_light_falloff(&light, 1), 2, 1e-6);                    /* 1/cos 60 */
    REQUIRE_NEAR(irb_light_falloff(&light, cos(59.999 * degree)), 1, 1e-4); /* the rim */
    REQUIRE_NEAR(irb_light_falloff(&light, 0.499), 0, 0);
    light = spot(IRB_FALLOFF_CONSTANT, 60, 0);
    REQUIRE_NEAR(irb_light_falloff(&light, 0.6), 1, 0);
    REQUIRE_NEAR(irb_light_falloff(&light, -1), 0, 0);
    REQUIRE_NEAR(irb_light_falloff(&light, NAN), 0, 0);
}

static void nothing_arrives_behind_outside_or_at_a_spot(void **state)
{
    struct irb_light light = spot(IRB_FALLOFF_CONSTANT, 45, 0);
    const float points[3][3] = {{0.5f, 3, -1}, {2.5f, 1, -1}, {0.5f, 2, -1}};
    float e[3], to_light[3], distance;
    (void)state;

    for (int i = 0; i < 3; i++) {
        irb_light_incident(&light, points[i], e, to_light, &distance);
        REQUIRE_NEAR(e[0], 0, 0);
        REQUIRE_NEAR(hypot(hypot(to_light[0], to_light[1]), to_light[2]), 1, 1e-6);
    }
}

static void a_beam_is_square_and_starts_at_its_plane(void **state)
{
    struct irb_light light = {.type = IRB_LIGHT_DIRECTIONAL,
                              .position = {0, 0.5f, 0},
                              .direction = {0, -1, 0},
                              .intensity = {4, 5, 6},
                              .half_width = 0.5f};
    const struct {
        float point[3];
        double e;
    } cases[] = {{{0, 0, 0}, 5},          {{0.499f, 0, -0.499f}, 5}, {{0.5f, 0, 0.5f}, 5},
                 {{0.501f, 0, 0}, 0},     {{0, 0, -0.501f}, 0},      {{0, 0.51f, 0}, 0},
                 {{-0.4f, -100, 0.1f}, 5}};
    double watts[3];
    (void)state;

    irb_light_power(&light, watts);
    REQUIRE_REL(watts[2], 6, 1e-12);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        float e[3], to_light[3], distance;

        irb_light_incident(&light, cases[i].point, e, to_light, &distance);
        REQUIRE_NEAR(e[1], cases[i].e, 0);
        REQUIRE_NEAR(to_light[1], 1, 0);
        REQUIRE_NEAR(distance, 0.5 - cases[i].point[1], 1e-5);
    }
}

static void basis_of(const double d[3], float right[3], float up[3], double frame[3][3])
{
    struct irb_light light = {.direction = {(float)d[0], (float)d[1], (float)d[2]}};

    irb_light_basis(&light, right, up);
    for (int i = 0; i < 3; i++) {
        frame[0][i] = right[i];
        frame[1][i] = up[i];
        frame[2][i] = -d[i];
    }
}

/* Orthonormal and right-handed everywhere, straight up and down included. */
static void basis_is_a_rotation(void **state)
{
    (void)state;
    for (int t = 0; t <= 180; t++)
        for (int p = 0; p < 360; p += 5) {
            double theta = t * degree, phi = p * degree, frame[3][3];
            double d[3] = {sin(theta) * cos(phi), -cos(theta), sin(theta) * sin(phi)};
            float right[3], up[3];

            basis_of(d, right, up, frame);
            for (int a = 0; a < 3; a++) {
                const double *u = frame[a], *v = frame[(a + 1) % 3], *w = frame[(a + 2) % 3];

                REQUIRE_NEAR(u[0] * u[0] + u[1] * u[1] + u[2] * u[2], 1, 1e-5);
                REQUIRE_NEAR(u[0] * v[0] + u[1] * v[1] + u[2] * v[2], 0, 1e-5);
                REQUIRE_NEAR(u[1] * v[2] - u[2] * v[1], w[0], 1e-5);
            }
        }
}

/* A light that swings through straight down, or from side to side, does not make its image jump. */
static void basis_is_continuous_below_the_zenith(void **state)
{
    (void)state;
    for (int p = 0; p < 360; p += 10) {
        float last[3] = {0}, right[3], up[3];

        for (int t = -150; t <= 150; t++) {
            double theta = t * degree, frame[3][3];
            double d[3] = {sin(theta) * cos(p * degree), -cos(theta), sin(theta) * sin(p * degree)};

            basis_of(d, right, up, frame);
            for (int i = 0; i < 3 && t > -150; i++)
                REQUIRE_NEAR(right[i], last[i], 0.08);
            memcpy(last, right, sizeof last);
        }
    }
}

static struct irb_key key_of(const struct irb_light *light)
{
    struct irb_hash *hash = irb_hash_create();

    irb_light_hash(light, hash);
    return irb_hash_finish(hash);
}

static void hash_follows_what_matters(void **state)
{
    struct irb_light a = spot(IRB_FALLOFF_CONSTANT, 30, 10), b = a;
    (void)state;

    b.inner = 0.1f; /* only SMOOTH looks at it */
    assert_string_equal(key_of(&a).hex, key_of(&b).hex);
    b.intensity[2] += 1e-3f;
    assert_string_not_equal(key_of(&a).hex, key_of(&b).hex);
    a.falloff = b.falloff = IRB_FALLOFF_SMOOTH;
    b.intensity[2] = a.intensity[2];
    assert_string_not_equal(key_of(&a).hex, key_of(&b).hex);
}

static void project(const struct irb_camera *camera, float aspect, const double p[3], double ndc[3])
{
    float view[16], projection[16];
    double eye[4], clip[4];

    irb_camera_matrices(camera, aspect, view, projection);
    for (int r = 0; r < 4; r++)
        eye[r] = view[r] * p[0] + view[4 + r] * p[1] + view[8 + r] * p[2] + view[12 + r];
    for (int r = 0; r < 4; r++)
        clip[r] = projection[r] * eye[0] + projection[4 + r] * eye[1] + projection[8 + r] * eye[2] +
                  projection[12 + r] * eye[3];
    for (int i = 0; i < 3; i++)
        ndc[i] = clip[i] / clip[3];
}

/* 90 degrees: a point at distance d and offset d is at the edge; near maps to -1, far to 1. */
static void camera_projects_known_points(void **state)
{
    struct irb_camera camera = {.position = {1, 2, 3},
                                .target = {1, 2, 13},
                                .up = {0, 1, 0},
                                .vertical_fov = (float)(M_PI / 2),
                                .z_near = 0.5f,
                                .z_far = 50};
    const double top[3] = {1, 2 + 7, 10}, right[3] = {1 - 14, 2, 10}, front[3] = {1, 2, 3.5},
                 back[3] = {1, 2, 53};
    double ndc[3];
    (void)state;

    project(&camera, 2, top, ndc);
    REQUIRE_NEAR(ndc[0], 0, 1e-6);
    REQUIRE_NEAR(ndc[1], 1, 1e-6);
    project(&camera, 2, right, ndc); /* looking along +z with y up, right is -x */
    REQUIRE_NEAR(ndc[0], 1, 1e-6);
    REQUIRE_NEAR(ndc[1], 0, 1e-6);
    project(&camera, 2, front, ndc);
    REQUIRE_NEAR(ndc[2], -1, 1e-5);
    project(&camera, 2, back, ndc);
    REQUIRE_NEAR(ndc[2], 1, 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power_is_the_integral_of_the_intensity),
        cmocka_unit_test(power_of_a_constant_hemisphere_is_2_pi),
        cmocka_unit_test(flux_through_a_plane_is_the_power),
        cmocka_unit_test(falloffs_have_their_defined_values),
        cmocka_unit_test(nothing_arrives_behind_outside_or_at_a_spot),
        cmocka_unit_test(a_beam_is_square_and_starts_at_its_plane),
        cmocka_unit_test(basis_is_a_rotation),
        cmocka_unit_test(basis_is_continuous_below_the_zenith),
        cmocka_unit_test(hash_follows_what_matters),
        cmocka_unit_test(camera_projects_known_points),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
