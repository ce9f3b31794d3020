/* SPDX-License-Identifier: MIT
 *
 * SSIM against its definition, evaluated in two dimensions window by window, against closed forms,
 * and against values of tests/score/oracle.py.
 */
#include "core/score/ssim.h"

#include "core/base/clock.h"
#include "core/base/hash.h"
#include "tests/support/compare.h"

#include <stdlib.h>
#include <string.h>

static struct irb_error err;

/* oracle.py --print, of the patterns below. */
static const double script_ssim = 0.970665583207;

/* Uniform in [0,1). */
static float uniform(uint64_t seed, size_t i)
{
    return (float)(irb_hash_mix(seed, i) >> 40) / 16777216.0f;
}

static struct irb_image constant(int width, int height, float value)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, width, height, 1, &err));
    for (size_t i = 0; i < irb_image_pixels(&image); i++)
        image.data[i] = value;
    return image;
}

static struct irb_image noise(int width, int height, uint64_t seed)
{
    struct irb_image image = constant(width, height, 0);
    for (size_t i = 0; i < irb_image_pixels(&image); i++)
        image.data[i] = uniform(seed, i);
    return image;
}

/* The formulas of oracle.py: values are exact in single precision. */
static struct irb_image pattern(int width, int height, bool changed)
{
    struct irb_image image = constant(width, height, 0);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int v = (x * 7 + y * 13 + ((x ^ y) & 31) * 3) % 256;
            if (changed && (((x >> 3) + (y >> 3)) & 1))
                v = (v * 3 + 128) / 4;
            *irb_image_at(&image, x, y) = (float)v / 256;
        }
    return image;
}

/* Equation 13 by the letter, at one pixel. */
static double brute(const struct irb_image *t, const struct irb_image *r, int x, int y)
{
    double total = 0, mt = 0, mr = 0, vt = 0, vr = 0, cov = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int j = -5; j <= 5; j++)
            for (int i = -5; i <= 5; i++) {
                double w = exp(-(i * i + j * j) / (2 * 1.5 * 1.5));
                double a = *irb_image_at(t, x + i, y + j), b = *irb_image_at(r, x + i, y + j);
                if (pass == 0) {
                    total += w;
                    mt += w * a;
                    mr += w * b;
                    continue;
                }
                vt += w / total * (a - mt / total) * (a - mt / total);
                vr += w / total * (b - mr / total) * (b - mr / total);
                cov += w / total * (a - mt / total) * (b - mr / total);
            }
    mt /= total;
    mr /= total;
    return (2 * mt * mr + 1e-4) * (2 * cov + 9e-4) /
           ((mt * mt + mr * mr + 1e-4) * (vt + vr + 9e-4));
}

static void agrees_with_the_definition(void **state)
{
    (void)state;
    struct irb_image t = noise(37, 23, 1), r = noise(37, 23, 2), map;
    double mean, sum = 0;
    for (size_t i = 0; i < irb_image_pixels(&t); i++)
        t.data[i] = 0.6f * r.data[i] + 0.4f * t.data[i];
    REQUIRE_OK(irb_ssim(&t, &r, NULL, &map, &mean, &err));
    for (int y = 0; y < 23; y++)
        for (int x = 0; x < 37; x++) {
            bool fits = x >= 5 && x < 32 && y >= 5 && y < 18;
            double expected = fits ? brute(&t, &r, x, y) : 1;
            REQUIRE_NEAR(*irb_image_at(&map, x, y), expected, 1e-7);
            sum += fits ? expected : 0;
        }
    REQUIRE_NEAR(mean, sum / (27 * 13), 1e-8);
    irb_image_destroy(&map);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
}

static void agrees_with_the_script(void **state)
{
    (void)state;
    struct irb_image t = pattern(96, 64, true), r = pattern(96, 64, false);
    double mean;
    REQUIRE_OK(irb_ssim(&t, &r, NULL, NULL, &mean, &err));
    REQUIRE_NEAR(mean, script_ssim, 1e-8);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
}

/* Of constants only the luminance term is left: (2ab + c1)/(a^2 + b^2 + c1). Equal images: 1. */
static void closed_forms(void **state)
{
    (void)state;
    struct irb_image a = constant(20, 15, 0.25f), b = constant(20, 15, 0.75f), n = noise(20, 15, 3);
    struct irb_image negative = constant(20, 15, 0);
    double mean;
    REQUIRE_OK(irb_ssim(&a, &b, NULL, NULL, &mean, &err));
    REQUIRE_NEAR(mean, (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-7);
    REQUIRE_OK(irb_ssim(&n, &n, NULL, NULL, &mean, &err));
    REQUIRE_NEAR(mean, 1, 0);
    for (size_t i = 0; i < irb_image_pixels(&n); i++)
        negative.data[i] = 1 - n.data[i];
    REQUIRE_OK(irb_ssim(&n, &negative, NULL, NULL, &mean, &err));
    REQUIRE_CMP(mean, <, -0.5);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
    irb_image_destroy(&n);
    irb_image_destroy(&negative);
}

static void masks_and_small_images(void **state)
{
    (void)state;
    struct irb_image t = noise(30, 20, 4), r = noise(30, 20, 5), small = noise(10, 40, 6), map;
    uint8_t mask[600] = {0};
    double mean;
    mask[0] = 1; /* its window does not fit */
    REQUIRE_OK(irb_ssim(&t, &r, mask, NULL, &mean, &err));
    assert_true(isnan(mean));
    mask[30 * 9 + 11] = mask[30 * 7 + 24] = 1;
    REQUIRE_OK(irb_ssim(&t, &r, mask, NULL, &mean, &err));
    REQUIRE_NEAR(mean, (brute(&t, &r, 11, 9) + brute(&t, &r, 24, 7)) / 2, 1e-7);
    REQUIRE_OK(irb_ssim(&small, &small, NULL, &map, &mean, &err));
    assert_true(isnan(mean));
    REQUIRE_NEAR(map.data[200], 1, 0);
    irb_image_destroy(&map);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
    irb_image_destroy(&small);
}

static void bad_input_is_refused(void **state)
{
    (void)state;
    struct irb_image a = constant(20, 15, 0), b = constant(15, 20, 0), rgb, map;
    double mean;
    REQUIRE_OK(irb_image_create(&rgb, 20, 15, 3, &err));
    assert_false(irb_ssim(&a, &b, NULL, &map, &mean, &err));
    assert_string_equal(err.message, "SSIM: images differ in size: 20 x 15 and 15 x 20");
    assert_null(map.data);
    assert_false(irb_ssim(&rgb, &a, NULL, NULL, &mean, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
    irb_image_destroy(&rgb);
}

static void is_fast(void **state)
{
    (void)state;
    struct irb_image t = noise(800, 600, 7), r = noise(800, 600, 8);
    double mean, best = INFINITY;
    for (int i = 0; i < 3; i++) {
        double start = irb_clock_s();
        REQUIRE_OK(irb_ssim(&t, &r, NULL, NULL, &mean, &err));
        best = fmin(best, irb_clock_s() - start);
    }
    print_message("800 x 600: %.0f ms\n", 1e3 * best);
#ifndef __SANITIZE_ADDRESS__ /* many times slower there */
    REQUIRE_CMP(best, <, 0.3);
#endif
    irb_image_destroy(&t);
    irb_image_destroy(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_the_definition),
        cmocka_unit_test(agrees_with_the_script),
        cmocka_unit_test(closed_forms),
        cmocka_unit_test(masks_and_small_images),
        cmocka_unit_test(bad_input_is_refused),
        cmocka_unit_test(is_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
