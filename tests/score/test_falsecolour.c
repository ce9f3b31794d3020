/* SPDX-License-Identifier: MIT
 *
 * False colour: order, ends, evenness of lightness, values out of range.
 */
#include "core/score/falsecolour.h"

#include "tests/support/compare.h"

static struct irb_error err;

enum { STEPS = 101 };

/* CIE lightness L* of an sRGB colour (CIE 15:2004, IEC 61966-2-1). */
static double lightness(const float *srgb)
{
    const double weight[3] = {0.2126, 0.7152, 0.0722};
    double y = 0;
    for (int c = 0; c < 3; c++) {
        double v = srgb[c];
        y += weight[c] * (v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
    return y > 216.0 / 24389 ? 116 * cbrt(y) - 16 : y * 24389.0 / 27;
}

/* From lowest * maximum to maximum. */
static struct irb_image ramp(double lowest, double maximum)
{
    struct irb_image map;
    REQUIRE_OK(irb_image_create(&map, STEPS, 1, 1, &err));
    for (int i = 0; i < STEPS; i++)
        map.data[i] = (float)(maximum * (lowest + (1 - lowest) * i / (STEPS - 1.0)));
    return map;
}

static void magma_grows_evenly(void **state)
{
    (void)state;
    struct irb_image map = ramp(0, 20), rgb;
    REQUIRE_OK(irb_falsecolour(&map, 20, &rgb, &err));
    double last = lightness(rgb.data);
    REQUIRE_NEAR(last, 0, 1);
    for (int i = 1; i < STEPS; i++) {
        double now = lightness(rgb.data + 3 * i);
        REQUIRE_CMP(now, >, last);
        /* Even in CAM02-UCS, whose lightness leaves L* by a few units in the middle. */
        REQUIRE_NEAR(now, 98.0 * i / (STEPS - 1), 6);
        last = now;
    }
    irb_image_destroy(&map);
    irb_image_destroy(&rgb);
}

static void signs_weigh_the_same(void **state)
{
    (void)state;
    struct irb_image map = ramp(-1, 3), rgb;
    REQUIRE_OK(irb_falsecolour_signed(&map, 3, &rgb, &err));
    for (int i = 0; i < STEPS / 2; i++) {
        const float *minus = rgb.data + 3 * i, *plus = rgb.data + 3 * (STEPS - 1 - i);
        REQUIRE_NEAR(lightness(minus), lightness(plus), 0.3); /* no gamut clipping on either side */
        REQUIRE_CMP(minus[2], >, minus[0]);
        REQUIRE_CMP(plus[0], >, plus[2]);
    }
    const float *zero = rgb.data + 3 * (STEPS / 2);
    REQUIRE_NEAR(zero[0], zero[1], 1e-5);
    REQUIRE_NEAR(zero[1], zero[2], 1e-5);
    REQUIRE_NEAR(lightness(zero), 96, 0.1);
    irb_image_destroy(&map);
    irb_image_destroy(&rgb);
}

static void values_out_of_range(void **state)
{
    (void)state;
    struct irb_image map, rgb;
    REQUIRE_OK(irb_image_create(&map, 5, 1, 1, &err));
    const float values[5] = {-INFINITY, -1, INFINITY, 2, NAN};
    for (int i = 0; i < 5; i++)
        map.data[i] = values[i];
    for (int is_signed = 0; is_signed < 2; is_signed++) {
        if (is_signed)
            REQUIRE_OK(irb_falsecolour_signed(&map, 1, &rgb, &err));
        else
            REQUIRE_OK(irb_falsecolour(&map, 1, &rgb, &err));
        assert_memory_equal(rgb.data, rgb.data + 3, 3 * sizeof(float));
        assert_memory_equal(rgb.data + 6, rgb.data + 9, 3 * sizeof(float));
        REQUIRE_NEAR(rgb.data[12] + rgb.data[14], 0, 0);
        REQUIRE_NEAR(rgb.data[13], 1, 0);
        irb_image_destroy(&rgb);
    }
    irb_image_destroy(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(magma_grows_evenly),
        cmocka_unit_test(signs_weigh_the_same),
        cmocka_unit_test(values_out_of_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
