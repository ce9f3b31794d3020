/* SPDX-License-Identifier: MIT
 *
 * Comparing two images: against the single metrics, and what is refused.
 */
#include "core/score/compare.h"

#include "core/base/hash.h"
#include "core/score/metrics.h"
#include "tests/support/compare.h"

#include <string.h>

static struct irb_error err;

enum { W = 33, H = 21, VALUES = 3 * W * H };

static struct irb_image noise(uint64_t seed, float scale)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, W, H, 3, &err));
    for (size_t i = 0; i < VALUES; i++)
        image.data[i] = scale * (float)(irb_hash_mix(seed, i) >> 40) / 16777216.0f;
    return image;
}

static void agrees_with_single_metrics(void **state)
{
    (void)state;
    struct irb_image t = noise(1, 4), r = noise(2, 4);
    struct irb_pair pair = {&t, &r, NULL};
    struct irb_comparison c, d;
    t.data[7] = -1;
    REQUIRE_OK(irb_compare(&c, &t, &r, false, 1, &err));
    struct irb_error_scores scores = irb_score_errors(&pair, c.eps);
    REQUIRE_NEAR(c.values[IRB_COMPARE_rmse], scores.rmse, 0);
    REQUIRE_NEAR(c.values[IRB_COMPARE_negative], 1, 0);
    REQUIRE_NEAR(c.values[IRB_COMPARE_psnr], 20 * log10(c.peak / scores.rmse), 1e-12);
    REQUIRE_CMP(c.values[IRB_COMPARE_max_error], >=, 3);
    REQUIRE_NEAR(c.difference.data[7], -1 - r.data[7], 1e-6);
    REQUIRE_NEAR(irb_masked_mean(&c.flip, NULL), c.values[IRB_COMPARE_flip], 1e-7);
    REQUIRE_NEAR(irb_masked_mean(&c.ldr_flip, NULL), c.values[IRB_COMPARE_ldr_flip], 1e-7);
    REQUIRE_REL(irb_masked_mean(&c.relmse, NULL), c.values[IRB_COMPARE_relmse], 1e-6);
    REQUIRE_OK(irb_compare(&d, &t, &r, false, 3, &err));
    assert_memory_equal(c.values, d.values, sizeof c.values);
    irb_comparison_destroy(&c);
    irb_comparison_destroy(&d);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
}

/* What a fixed exposure shows does not depend on the unit of radiance. */
static void displayed_metrics_do_not_depend_on_the_scale(void **state)
{
    (void)state;
    struct irb_image t = noise(1, 1), r = noise(2, 1);
    struct irb_comparison c, d;
    REQUIRE_OK(irb_compare(&c, &t, &r, false, 0, &err));
    for (size_t i = 0; i < VALUES; i++) {
        t.data[i] *= 1024;
        r.data[i] *= 1024;
    }
    REQUIRE_OK(irb_compare(&d, &t, &r, false, 0, &err));
    REQUIRE_REL(d.exposure, c.exposure / 1024, 1e-9);
    static const int same[] = {IRB_COMPARE_relmse,       IRB_COMPARE_smape, IRB_COMPARE_psnr,
                               IRB_COMPARE_energy_ratio, IRB_COMPARE_ssim,  IRB_COMPARE_flip,
                               IRB_COMPARE_ldr_flip};
    for (size_t i = 0; i < sizeof same / sizeof *same; i++)
        REQUIRE_REL(d.values[same[i]], c.values[same[i]], 1e-5);
    irb_comparison_destroy(&c);
    irb_comparison_destroy(&d);
    irb_image_destroy(&t);
    irb_image_destroy(&r);
}

static void bad_input_is_refused(void **state)
{
    (void)state;
    struct irb_image a = noise(1, 1), b, grey;
    struct irb_comparison c;
    REQUIRE_OK(irb_image_create(&b, H, W, 3, &err));
    REQUIRE_OK(irb_image_create(&grey, W, H, 1, &err));
    assert_false(irb_compare(&c, &a, &b, false, 1, &err));
    assert_string_equal(err.message,
                        "the images differ in size: 33 x 21 and, for the reference, 21 x 33");
    assert_false(irb_compare(&c, &grey, &a, false, 1, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
    irb_image_destroy(&grey);
}

static void metrics_are_found(void **state)
{
    (void)state;
    for (int i = 0; i < IRB_COMPARE_COUNT; i++) {
        assert_int_equal(irb_compare_find(irb_compare_metrics[i].name, &err), i);
        assert_true(strlen(irb_compare_metrics[i].doc) > 5);
    }
    assert_int_equal(irb_compare_find("smap", &err), -1);
    assert_string_equal(err.message, "unknown metric 'smap'; did you mean smape?");
    assert_int_equal(irb_compare_find("", &err), -1);
    assert_int_equal(err.code, IRB_E_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_single_metrics),
        cmocka_unit_test(displayed_metrics_do_not_depend_on_the_scale),
        cmocka_unit_test(bad_input_is_refused),
        cmocka_unit_test(metrics_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
