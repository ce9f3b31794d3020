/* SPDX-License-Identifier: MIT
 *
 * The displayed image against the previews' tone mapping, in double precision.
 */
#include "core/score/display.h"

#include "core/frame/composite.h"
#include "tests/support/compare.h"

static struct irb_error err;

static double encode(double v)
{
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

/* Colours over nine decades, with every value that is no radiance among them. */
static struct irb_image colours(void)
{
    static const float odd[] = {0, -1, NAN, INFINITY, -INFINITY, 1e38f, 1e-38f, -0.0f};
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, 64, 50, 3, &err));
    for (size_t i = 0; i < 3 * irb_image_pixels(&image); i++)
        image.data[i] = powf(10, (float)((i * 37) % 901) / 100 - 5);
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++)
        image.data[3 * (i * 11) + i % 3] = odd[i];
    return image;
}

static void agrees_with_previews(void **state)
{
    (void)state;
    struct irb_image image = colours(), srgb;
    for (double exposure = 1e-3; exposure < 1e5; exposure *= 10) {
        struct irb_displayed shown;
        REQUIRE_OK(irb_display(&image, exposure, &shown, &err));
        REQUIRE_OK(irb_tonemap(&image, exposure, &srgb, &err));
        for (size_t i = 0; i < irb_image_pixels(&image); i++) {
            const float *p = shown.linear.data + 3 * i, *q = srgb.data + 3 * i;
            for (int c = 0; c < 3; c++)
                REQUIRE_NEAR(encode(p[c]), q[c], 2e-6);
            REQUIRE_NEAR(shown.luma.data[i], 0.2126 * q[0] + 0.7152 * q[1] + 0.0722 * q[2], 2e-6);
        }
        irb_image_destroy(&srgb);
        irb_displayed_destroy(&shown);
    }
    irb_image_destroy(&image);
}

static void display_referred_images_are_clamped(void **state)
{
    (void)state;
    struct irb_image image;
    struct irb_displayed shown;
    REQUIRE_OK(irb_image_create(&image, 2, 1, 3, &err));
    const float values[] = {0.25f, -1, 3, NAN, INFINITY, 0.002f};
    const float expected[] = {0.25f, 0, 1, 0, 1, 0.002f};
    for (int i = 0; i < 6; i++)
        image.data[i] = values[i];
    REQUIRE_OK(irb_display(&image, 0, &shown, &err));
    for (int i = 0; i < 6; i++)
        REQUIRE_NEAR(shown.linear.data[i], expected[i], 0);
    REQUIRE_NEAR(shown.luma.data[0], 0.2126 * encode(0.25) + 0.0722, 2e-6);
    REQUIRE_NEAR(shown.luma.data[1], 0.7152 + 0.0722 * 12.92 * 0.002, 2e-6);
    irb_displayed_destroy(&shown);
    irb_image_destroy(&image);
}

static void differences_are_of_encoded_values(void **state)
{
    (void)state;
    struct irb_image a, b, difference;
    struct irb_displayed shown[2];
    REQUIRE_OK(irb_image_create(&a, 1, 1, 3, &err));
    REQUIRE_OK(irb_image_create(&b, 1, 1, 3, &err));
    const float values[2][3] = {{0.25f, 0.002f, 0.7f}, {0.5f, 0.3f, 0.7f}};
    for (int c = 0; c < 3; c++) {
        a.data[c] = values[0][c];
        b.data[c] = values[1][c];
    }
    REQUIRE_OK(irb_display(&a, 0, &shown[0], &err));
    REQUIRE_OK(irb_display(&b, 0, &shown[1], &err));
    REQUIRE_OK(irb_displayed_difference(&shown[0], &shown[1], &difference, &err));
    for (int c = 0; c < 3; c++)
        REQUIRE_NEAR(difference.data[c], fabs(encode(values[0][c]) - encode(values[1][c])), 2e-6);
    irb_image_destroy(&difference);
    for (int i = 0; i < 2; i++)
        irb_displayed_destroy(&shown[i]);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

static void bad_input_is_refused(void **state)
{
    (void)state;
    struct irb_image grey;
    struct irb_displayed shown;
    REQUIRE_OK(irb_image_create(&grey, 2, 2, 1, &err));
    assert_false(irb_display(&grey, 1, &shown, &err));
    assert_string_equal(err.message, "display: expected 3 channels, found 1");
    assert_null(shown.linear.data);
    irb_image_destroy(&grey);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_previews),
        cmocka_unit_test(display_referred_images_are_clamped),
        cmocka_unit_test(differences_are_of_encoded_values),
        cmocka_unit_test(bad_input_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
