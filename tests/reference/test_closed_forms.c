/* SPDX-License-Identifier: MIT
 *
 * Scenes whose indirect irradiance is known: integrating sphere, two parallel squares, closed cube.
 */
#include "tests/reference/fixture.h"
#include "tests/support/compare.h"

/* Every bounce of an integrating sphere is uniform: E_n = albedo^n P/(4 pi R^2). */
static void test_integrating_sphere(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    double watts[3], expected = 0.5, rest = 0;
    fixture_builtin(&f, "sphere"); /* albedo 1/2, R = 1 */
    f.settings.bounces = 16;
    f.settings.min_samples = f.settings.max_samples = 256;
    fixture_look(&f, 8, 8);
    fixture_must_render(&f, &out);
    irb_light_power(&f.light, watts);
    expected = watts[0] / (4 * M_PI);
    for (int n = 3; n <= 16; n++)
        rest += expected * pow(0.5, n);
    REQUIRE_REL(fixture_mean(&out.bounce1), 0.5 * expected, 0.003);
    REQUIRE_REL(fixture_mean(&out.bounce2), 0.25 * expected, 0.005);
    REQUIRE_REL(fixture_mean(&out.rest), rest, 0.01);
    for (size_t i = 0; i < 64; i++)
        REQUIRE_REL(out.bounce1.data[3 * i], 0.5 * expected, 0.03);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

/* Form factor from a point to a parallel rectangle whose corner is on its normal (sides a, b in
 * units of the distance): Howell, Catalog of Radiation Heat Transfer Configuration Factors, B-3. */
static double corner_factor(double a, double b)
{
    double ra = sqrt(1 + a * a), rb = sqrt(1 + b * b);
    return (a / ra * atan(b / ra) + b / rb * atan(a / rb)) / (2 * M_PI);
}

/* From (x, z) to the unit square one metre away, centred at 0. */
static double square_factor(double x, double z)
{
    double left = 0.5 + x, right = 0.5 - x, low = 0.5 + z, high = 0.5 - z;
    return corner_factor(left, low) + corner_factor(left, high) + corner_factor(right, low) +
           corner_factor(right, high);
}

/* A grid of points on the upper square that averages smooth functions over it. */
static void squares_grid(struct fixture *f, int size)
{
    fixture_gbuffer(f, size, size);
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            fixture_point(f, x, y, (double[]){(x + 0.5) / size - 0.5, 1, (y + 0.5) / size - 0.5},
                          (double[]){0, -1, 0});
}

static void test_parallel_squares(void **state)
{
    (void)state;
    enum { SIZE = 16 };
    struct fixture f;
    struct irb_reference_image out;
    fixture_builtin(&f, "squares"); /* albedo 1/2, beam of E on the lower one */
    double e = (double)f.light.intensity[0];
    f.settings.min_samples = f.settings.max_samples = 1024;
    f.settings.unoccluded = true;
    squares_grid(&f, SIZE);
    fixture_must_render(&f, &out);
    REQUIRE_REL(fixture_mean(&out.bounce1), 0.5 * e * 0.19982, 0.002);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            double factor = square_factor((x + 0.5) / SIZE - 0.5, (y + 0.5) / SIZE - 0.5);
            REQUIRE_REL(irb_image_at(&out.bounce1, x, y)[0], 0.5 * e * factor, 0.02);
            /* nothing is in the way */
            REQUIRE_REL(irb_image_at(&out.unoccluded, x, y)[0], 0.5 * e * factor, 0.02);
        }
    }
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

/* Closed cube: the mean over its whole inner area of E_n is albedo^n P/A, whatever is lit. */
static void furnace_grid(struct fixture *f, int size)
{
    fixture_gbuffer(f, size, 6 * size);
    for (int face = 0; face < 6; face++) {
        int axis = face / 2, side = face % 2;
        for (int i = 0; i < size * size; i++) {
            double p[3], n[3] = {0, 0, 0};
            p[axis] = side;
            p[(axis + 1) % 3] = (i % size + 0.5) / size;
            p[(axis + 2) % 3] = (i / size + 0.5) / size;
            n[axis] = 1 - 2 * side;
            fixture_point(f, i % size, face * size + i / size, p, n);
        }
    }
}

static void test_closed_cube(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    double watts[3], rest = 0;
    fixture_builtin(&f, "furnace"); /* albedo 1/2, A = 6 m2 */
    f.settings.bounces = 6;
    f.settings.min_samples = f.settings.max_samples = 64;
    furnace_grid(&f, 24);
    fixture_must_render(&f, &out);
    irb_light_power(&f.light, watts);
    for (int n = 3; n <= 6; n++)
        rest += pow(0.5, n) * watts[0] / 6;
    /* the grid's own error for bounce 1, which is steep at the lit patch's rim, is below 1e-3 */
    REQUIRE_REL(fixture_mean(&out.bounce1), 0.5 * watts[0] / 6, 0.005);
    REQUIRE_REL(fixture_mean(&out.bounce2), 0.25 * watts[0] / 6, 0.005);
    REQUIRE_REL(fixture_mean(&out.rest), rest, 0.01);
    /* bounces 7.. over bounces 1..6 of the geometric series */
    REQUIRE_REL(out.rest_remainder, pow(0.5, 6) / (1 - pow(0.5, 6)), 0.05);
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

/* Albedo 1 in a closed scene: every bounce is as bright as the first, the series has no sum. */
static void test_white_furnace(void **state)
{
    (void)state;
    struct fixture f;
    struct irb_reference_image out;
    fixture_builtin(&f, "sphere");
    struct irb_scene *scene = f.scene;
    struct irb_light light = f.light;
    struct irb_camera camera = f.camera;
    double watts[3];
    for (int c = 0; c < 3; c++)
        scene->materials[0].diffuse[c] = 1;
    irb_tracer_destroy(f.tracer);
    fixture_create(&f, scene);
    f.light = light;
    f.camera = camera;
    f.settings.bounces = 16;
    f.settings.min_samples = f.settings.max_samples = 256;
    fixture_look(&f, 8, 8);
    fixture_must_render(&f, &out);
    irb_light_power(&f.light, watts);
    REQUIRE_REL(fixture_mean(&out.bounce1), watts[0] / (4 * M_PI), 0.005);
    REQUIRE_REL(fixture_mean(&out.rest), 14 * watts[0] / (4 * M_PI), 0.02);
    REQUIRE_CMP(out.rest_remainder, >, 2); /* infinite, or large by noise in the ratio */
    irb_reference_image_destroy(&out);
    fixture_destroy(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_integrating_sphere),
        cmocka_unit_test(test_parallel_squares),
        cmocka_unit_test(test_closed_cube),
        cmocka_unit_test(test_white_furnace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
