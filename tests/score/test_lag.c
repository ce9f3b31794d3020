/* SPDX-License-Identifier: MIT
 *
 * Lag of sequences that are late by construction.
 */
#include "core/score/lag.h"

#include "tests/support/compare.h"

#include <stdlib.h>
#include <string.h>

static struct irb_error err;

enum { W = 300, H = 200 }; /* more pixels than the grid has */

/* A light that wanders with changing speed: position in frames. */
static void paint(struct irb_image *image, double t)
{
    double centre = 20 + 5 * t + 10 * sin(0.3 * t);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int c = 0; c < 3; c++)
                irb_image_at(image, x, y)[c] =
                    (float)((c + 1) * exp(-(x - centre) * (x - centre) / 900.0 - y / 100.0));
}

/* The lag of a method that shows the reference of `late` frames before, or `blend` of the way from
 * what it showed before. */
static double lag_of(int frames, double late, double speed, double blend)
{
    struct irb_image image, shown;
    double(*errors)[IRB_LAG_COUNT] = calloc((size_t)frames, sizeof *errors);
    REQUIRE_OK(irb_image_create(&image, W, H, 3, &err));
    REQUIRE_OK(irb_image_create(&shown, W, H, 3, &err));
    struct irb_lag_reference *reference = irb_lag_reference_create(W, H, frames, &err);
    REQUIRE_OK(reference != NULL);
    for (int t = 0; t < frames; t++) {
        paint(&image, speed * t);
        irb_lag_reference_set(reference, t, &image);
    }
    for (int t = 0; t < frames; t++) {
        paint(&image, speed * (t - late));
        for (size_t i = 0; i < 3 * irb_image_pixels(&image); i++)
            shown.data[i] += (float)(t ? blend : 1) * (image.data[i] - shown.data[i]);
        irb_lag_errors(reference, t, &shown, NULL, errors[t]);
    }
    double lag = irb_lag((const double(*)[IRB_LAG_COUNT])errors, frames, 0.1);
    irb_lag_reference_destroy(reference);
    irb_image_destroy(&image);
    irb_image_destroy(&shown);
    free(errors);
    return lag;
}

static void late_sequences(void **state)
{
    (void)state;
    for (int late = IRB_LAG_FIRST; late <= IRB_LAG_LAST; late++)
        REQUIRE_NEAR(lag_of(24, late, 1, 1), late, 0);
    REQUIRE_NEAR(lag_of(6, 0, 1, 1), 0, 0);
    REQUIRE_NEAR(lag_of(6, 2, 1, 1), 2, 0);
    REQUIRE_NEAR(lag_of(8, 1, 1, 1), 1, 0);
    REQUIRE_NEAR(lag_of(8, 6, 1, 1), 2, 0); /* the largest that 8 frames can show */
    REQUIRE_NEAR(lag_of(24, 2.3, 1, 1), 2, 0);
}

/* Exponential averages follow a steady motion (1 - a)/a frames behind. */
static void averages_lag(void **state)
{
    (void)state;
    REQUIRE_NEAR(lag_of(30, 0, 0.2, 0.5), 1, 0);
    REQUIRE_NEAR(lag_of(36, 0, 0.2, 0.25), 3, 0);
}

static void no_lag_without_change(void **state)
{
    (void)state;
    assert_true(isnan(lag_of(24, 0, 0, 1)));
    assert_true(isnan(lag_of(24, 3, 0, 1)));
    assert_true(isnan(lag_of(5, 1, 1, 1))); /* too short */
    assert_true(isnan(lag_of(1, 0, 1, 1)));
}

static void ranges(void **state)
{
    (void)state;
    for (int frames = 0; frames < 100; frames++) {
        struct irb_lag_range range = irb_lag_range(frames);
        if (frames < 6) {
            REQUIRE_CMP(range.first, >, range.last);
            continue;
        }
        REQUIRE_CMP(range.first, >=, IRB_LAG_FIRST);
        REQUIRE_CMP(range.last, <=, IRB_LAG_LAST);
        REQUIRE_CMP(2 * (frames + range.first - range.last), >=, frames);
    }
    assert_int_equal(irb_lag_range(24).first, IRB_LAG_FIRST);
    assert_int_equal(irb_lag_range(24).last, IRB_LAG_LAST);
}

/* A mean over the pixels that count; NaN outside the sequence, and for a missing frame. */
static void errors_and_masks(void **state)
{
    (void)state;
    struct irb_image image;
    uint8_t mask[12] = {0};
    double errors[8][IRB_LAG_COUNT];
    REQUIRE_OK(irb_image_create(&image, 4, 3, 3, &err));
    struct irb_lag_reference *reference = irb_lag_reference_create(4, 3, 8, &err);
    for (int t = 0; t < 8; t++) {
        for (int i = 0; i < 36; i++)
            image.data[i] = (float)t;
        irb_lag_reference_set(reference, t, &image);
    }
    mask[3] = mask[7] = mask[8] = 1;
    image.data[3 * 8] = NAN;
    for (int i = 0; i < 36; i++)
        image.data[i] += 0.5f * (i % 3 == 0); /* 7.5, 7, 7 */
    for (int t = 0; t < 8; t++)
        irb_lag_errors(reference, t, &image, mask, errors[t]);
    REQUIRE_NEAR(errors[7][0 - IRB_LAG_FIRST], 0.5 / 3, 1e-15);
    REQUIRE_NEAR(errors[7][2 - IRB_LAG_FIRST], 2 + 0.5 / 3, 1e-15);
    assert_true(isnan(errors[7][-1 - IRB_LAG_FIRST]) && isnan(errors[7][8 - IRB_LAG_FIRST]));
    memset(mask, 0, sizeof mask);
    irb_lag_errors(reference, 7, &image, mask, errors[4]);
    assert_true(isnan(errors[4][0 - IRB_LAG_FIRST]));
    assert_true(isnan(irb_lag((const double(*)[IRB_LAG_COUNT])errors, 8, 1)));
    irb_lag_reference_destroy(reference);
    irb_image_destroy(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(late_sequences),        cmocka_unit_test(averages_lag),
        cmocka_unit_test(no_lag_without_change), cmocka_unit_test(ranges),
        cmocka_unit_test(errors_and_masks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
