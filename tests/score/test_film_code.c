/* SPDX-License-Identifier: MIT
 *
 * The films' logarithmic code: there and back, order, and values that are no radiance.
 */
#include "core/score/film_code.h"
#include "tests/support/compare.h"

#include <float.h>

static struct irb_error err;

static const struct irb_film_scale scale = {0.003, 17};

/* The definition, as its header has it. */
static double code_of(double v)
{
    return 255 * log(1 + v / scale.v0) / log(1 + scale.vmax / scale.v0);
}

static void codes_come_back(void **state)
{
    (void)state;
    for (int code = 0; code < 256; code++) {
        double v = irb_film_decode(&scale, (unsigned char)code);
        REQUIRE_NEAR(code_of(v), code, 1e-9);
        assert_int_equal(irb_film_encode(&scale, (float)v), code);
    }
    REQUIRE_NEAR(irb_film_decode(&scale, 0), 0, 0);
    REQUIRE_REL(irb_film_decode(&scale, 255), scale.vmax, 1e-12);
}

/* Half a step, from far below v0 to vmax, and the order stays. */
static void values_come_back_within_a_step(void **state)
{
    (void)state;
    int before = 0;
    for (double v = 1e-9; v <= scale.vmax; v *= 1.0007) {
        int code = irb_film_encode(&scale, (float)v);
        double back = irb_film_decode(&scale, (unsigned char)code);
        double step = exp2(log2(1 + scale.vmax / scale.v0) / 255) - 1;
        REQUIRE_CMP(code, >=, before);
        REQUIRE_CMP(code - before, <=, 1);
        REQUIRE_NEAR(back, v, 0.51 * step * (v + scale.v0));
        before = code;
    }
    REQUIRE_CMP(before, >=, 254);
}

static void what_is_no_radiance(void **state)
{
    (void)state;
    const float dark[] = {0, -0.0f, -1, -FLT_MAX, -INFINITY, NAN, FLT_TRUE_MIN};
    for (size_t i = 0; i < sizeof dark / sizeof *dark; i++)
        assert_int_equal(irb_film_encode(&scale, dark[i]), 0);
    const float bright[] = {17, 18, FLT_MAX, INFINITY};
    for (size_t i = 0; i < sizeof bright / sizeof *bright; i++)
        assert_int_equal(irb_film_encode(&scale, bright[i]), 255);
}

static void scales_of_a_sequence(void **state)
{
    (void)state;
    struct irb_film_scale s = irb_film_scale_of(0.5, 6);
    REQUIRE_NEAR(s.v0, 0.005, 1e-15);
    REQUIRE_NEAR(s.vmax, 24, 1e-12);
    /* all but a few pixels are black: the mean is above the percentile */
    REQUIRE_NEAR(irb_film_scale_of(0.5, 0).vmax, 2, 1e-12);
    const double none[] = {0, -1, NAN};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        s = irb_film_scale_of(none[i], 1);
        assert_int_equal(irb_film_encode(&s, 1), 0);
        REQUIRE_NEAR(irb_film_decode(&s, 255), 0, 0);
    }
    s = irb_film_scale_of(1, INFINITY);
    assert_int_equal(irb_film_encode(&s, 1), 0);
}

static void images_are_coded_by_channel(void **state)
{
    (void)state;
    struct irb_image image, coded;
    REQUIRE_OK(irb_image_create(&image, 5, 3, 3, &err));
    for (int i = 0; i < 45; i++)
        image.data[i] = i == 7 ? NAN : 0.1f * (float)i * (float)i;
    REQUIRE_OK(irb_film_encode_image(&scale, &image, &coded, &err));
    for (int i = 0; i < 45; i++)
        assert_int_equal(lrintf(255 * coded.data[i]), irb_film_encode(&scale, image.data[i]));
    irb_image_destroy(&coded);
    const struct irb_film_scale black = {0, 0};
    REQUIRE_OK(irb_film_encode_image(&black, &image, &coded, &err));
    for (int i = 0; i < 45; i++)
        REQUIRE_NEAR(coded.data[i], 0, 0);
    irb_image_destroy(&coded);
    irb_image_destroy(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_come_back),
        cmocka_unit_test(values_come_back_within_a_step),
        cmocka_unit_test(what_is_no_radiance),
        cmocka_unit_test(scales_of_a_sequence),
        cmocka_unit_test(images_are_coded_by_channel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
