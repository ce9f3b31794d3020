/* SPDX-License-Identifier: MIT
 *
 * Error and flicker metrics against closed forms.
 */
#include "core/score/flicker.h"

#include "core/base/hash.h"
#include "core/score/metric_list.h"
#include "core/score/quantile.h"
#include "tests/support/compare.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static struct irb_error err;

enum { W = 40, H = 25, N = W * H };

static struct irb_image constant(int width, int height, float value)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, width, height, 3, &err));
    for (size_t i = 0; i < 3 * irb_image_pixels(&image); i++)
        image.data[i] = value;
    return image;
}

/* Uniform in [0,1). */
static double uniform(uint64_t seed, size_t i)
{
    return (double)(irb_hash_mix(seed, i) >> 11) / 9007199254740992.0;
}

static struct irb_image noise(uint64_t seed)
{
    struct irb_image image = constant(W, H, 0);
    for (size_t i = 0; i < 3 * N; i++)
        image.data[i] = 0.5f + (float)uniform(seed, i);
    return image;
}

static void constant_offset(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 2), t = constant(W, H, 2.25f);
    struct irb_pair pair = {&t, &r, NULL};
    double eps = irb_relmse_eps(2);
    struct irb_error_scores s = irb_score_errors(&pair, eps);
    REQUIRE_NEAR(eps, 0.0004, 1e-18);
    REQUIRE_NEAR(s.rmse, 0.25, 1e-15);
    REQUIRE_NEAR(s.bias, 0.25, 1e-15);
    REQUIRE_NEAR(s.relmse, 0.0625 / 4.0004, 1e-15);
    REQUIRE_NEAR(s.energy_ratio, 1.125, 1e-15);
    /* sqrt(eps) = 0.01 * 2; no binary fraction: each of 3000 additions rounds */
    REQUIRE_NEAR(s.smape, 0.25 / (4.25 + 0.02), 1e-13);
    assert_int_equal(s.pixels, N);
    assert_int_equal(s.non_finite + s.negative, 0);
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

/* v = k r: RMSE = |k-1| rms r, energy ratio k, relMSE -> (k-1)^2 for small eps. */
static void scaled_reference(void **state)
{
    (void)state;
    struct irb_image r = noise(1), t = noise(1);
    double square = 0, sum = 0;
    for (size_t i = 0; i < 3 * N; i++) {
        square += (double)r.data[i] * r.data[i];
        sum += r.data[i];
        t.data[i] = 0.75f * r.data[i];
    }
    struct irb_pair pair = {&t, &r, NULL};
    struct irb_error_scores s = irb_score_errors(&pair, 1e-30);
    REQUIRE_REL(s.rmse, 0.25 * sqrt(square / (3 * N)), 1e-6);
    REQUIRE_REL(s.bias, -0.25 * sum / (3 * N), 1e-6);
    REQUIRE_REL(s.relmse, 0.0625, 1e-6);
    REQUIRE_REL(s.energy_ratio, 0.75, 1e-6);
    REQUIRE_REL(irb_masked_mean(&r, NULL), sum / (3 * N), 1e-14);
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

/* Uniform noise of half-width a: variance a^2/3. */
static void known_noise(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 1), t = constant(W, H, 1);
    for (size_t i = 0; i < 3 * N; i++)
        t.data[i] += (float)(0.2 * (uniform(7, i) - 0.5));
    struct irb_pair pair = {&t, &r, NULL};
    struct irb_error_scores s = irb_score_errors(&pair, irb_relmse_eps(1));
    REQUIRE_REL(s.rmse, 0.1 / sqrt(3), 0.03); /* 3000 samples: 0.8 % standard error */
    REQUIRE_NEAR(s.bias, 0, 4 * 0.1 / sqrt(3) / sqrt(3 * N));
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

static void single_wrong_value(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 1), t = constant(W, H, 1), map;
    t.data[3 * 123 + 1] = 4;
    struct irb_pair pair = {&t, &r, NULL};
    struct irb_error_scores s = irb_score_errors(&pair, 0.5);
    REQUIRE_NEAR(s.rmse, sqrt(9.0 / (3 * N)), 1e-15);
    REQUIRE_NEAR(s.bias, 3.0 / (3 * N), 1e-15);
    REQUIRE_NEAR(s.relmse, 9 / 1.5 / (3 * N), 1e-15);
    REQUIRE_NEAR(s.smape, 3 / (5 + sqrt(0.5)) / (3 * N), 1e-15);
    REQUIRE_OK(irb_relmse_map(&pair, 0.5, &map, &err));
    for (size_t i = 0; i < N; i++)
        REQUIRE_NEAR(map.data[i], i == 123 ? 2 : 0, 1e-7);
    irb_image_destroy(&map);
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

static void masks_leave_pixels_out(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 1), t = constant(W, H, 1), map;
    uint8_t mask[N];
    for (size_t i = 0; i < N; i++) {
        mask[i] = i % 4 == 0;
        for (int c = 0; c < 3 && !mask[i]; c++)
            t.data[3 * i + (size_t)c] = i % 4 == 1 ? NAN : -1e30f;
    }
    t.data[0] = 1.5f;
    struct irb_pair pair = {&t, &r, mask};
    struct irb_error_scores s = irb_score_errors(&pair, 1);
    assert_int_equal(s.pixels, N / 4);
    assert_int_equal(s.non_finite + s.negative, 0);
    REQUIRE_NEAR(s.bias, 0.5 / (3 * N / 4.0), 1e-15);
    REQUIRE_OK(irb_relmse_map(&pair, 1, &map, &err));
    REQUIRE_NEAR(map.data[1], 0, 0);
    REQUIRE_NEAR(map.data[0], 0.25 / 2 / 3, 1e-8);
    REQUIRE_NEAR(irb_masked_mean(&t, mask), 1 + 0.5 / (3 * N / 4.0), 1e-15);
    irb_image_destroy(&map);
    memset(mask, 0, sizeof mask);
    s = irb_score_errors(&pair, 1);
    assert_int_equal(s.pixels, 0);
    assert_true(isnan(s.rmse) && isnan(s.relmse) && isnan(s.bias) && isnan(s.energy_ratio));
    assert_true(isnan(irb_masked_mean(&t, mask)));
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

static void non_finite_and_negative_are_counted(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 1), t = constant(W, H, 1.5f), map;
    t.data[3 * 5] = NAN;
    t.data[3 * 6 + 2] = INFINITY;
    t.data[3 * 7 + 1] = -INFINITY;
    r.data[3 * 8] = NAN;
    t.data[3 * 9] = t.data[3 * 9 + 1] = -0.5f;
    t.data[3 * 10] = -0.0f; /* is not negative */
    struct irb_pair pair = {&t, &r, NULL};
    struct irb_error_scores s = irb_score_errors(&pair, 1);
    assert_int_equal(s.non_finite, 4);
    assert_int_equal(s.negative, 1);
    assert_int_equal(s.pixels, N - 4);
    double count = 3.0 * (N - 4);
    REQUIRE_NEAR(s.bias, ((count - 3) * 0.5 + 2 * -1.5 - 1) / count, 1e-13);
    REQUIRE_OK(irb_relmse_map(&pair, 1, &map, &err));
    assert_true(isnan(map.data[5]) && isnan(map.data[6]) && isnan(map.data[8]));
    REQUIRE_NEAR(map.data[4], 0.125, 1e-7);
    irb_image_destroy(&map);
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

static void black_reference(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 0), t = constant(W, H, 0.5f), b = constant(W, H, 0);
    struct irb_pair pair = {&t, &r, NULL}, same = {&b, &r, NULL};
    double eps = irb_relmse_eps(0);
    REQUIRE_CMP(eps, >, 0);
    struct irb_error_scores s = irb_score_errors(&pair, eps);
    REQUIRE_NEAR(s.rmse, 0.5, 1e-15);
    assert_true(isnan(s.energy_ratio));
    assert_true(isfinite(s.relmse));
    s = irb_score_errors(&same, eps);
    REQUIRE_NEAR(s.relmse, 0, 0);
    REQUIRE_NEAR(s.smape, 0, 0);
    struct irb_flicker_scores f = irb_score_flicker(&same, &same, 0);
    REQUIRE_NEAR(f.flicker, 0, 0);
    REQUIRE_NEAR(f.pop_share, 0, 0);
    assert_true(isinf(irb_score_flicker(&same, &pair, 0).flicker));
    irb_image_destroy(&r);
    irb_image_destroy(&t);
    irb_image_destroy(&b);
}

static void one_pixel(void **state)
{
    (void)state;
    struct irb_image r = constant(1, 1, 2), t = constant(1, 1, 1);
    struct irb_pair pair = {&t, &r, NULL};
    struct irb_error_scores s = irb_score_errors(&pair, 1);
    REQUIRE_NEAR(s.rmse, 1, 0);
    REQUIRE_NEAR(s.bias, -1, 0);
    REQUIRE_NEAR(s.relmse, 0.2, 1e-16);
    REQUIRE_NEAR(s.energy_ratio, 0.5, 0);
    REQUIRE_NEAR(irb_score_flicker(&pair, &pair, 2).flicker, 0, 0);
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

/* RMSE a tenth of the peak: 20 dB. */
static void psnr(void **state)
{
    (void)state;
    REQUIRE_NEAR(irb_psnr(0.1, 1), 20, 1e-12);
    REQUIRE_NEAR(irb_psnr(5, 500), 40, 1e-12);
    assert_true(isinf(irb_psnr(0, 1)) && irb_psnr(0, 1) > 0);
    assert_true(isnan(irb_psnr(0.1, 0)) && isnan(irb_psnr(0, 0)));
    assert_true(isnan(irb_psnr(NAN, 1)));
}

/* The k-th of the values over all images, channels and counted pixels. */
static void percentile_of_a_sequence(void **state)
{
    (void)state;
    struct irb_image a = constant(W, H, -1), b = constant(W, H, 1e9f);
    const struct irb_image *images[] = {&a, &b};
    uint8_t mask[N] = {0};
    for (size_t i = 0; i < 3 * N; i++)
        a.data[i] = (float)((i * 7) % (3 * N)) + 1; /* 1..3000, shuffled */
    const uint8_t *masks[] = {NULL, mask};
    REQUIRE_NEAR(irb_value_percentile(images, masks, 2, 0.999), 2997, 0);
    REQUIRE_NEAR(irb_value_percentile(images, NULL, 1, 0.5), 1500, 0);
    REQUIRE_NEAR(irb_value_percentile(images, NULL, 2, 0.999), 1e9, 0);
    a.data[0] = NAN, a.data[1] = INFINITY, a.data[2] = -3;
    REQUIRE_NEAR(irb_value_percentile(images, masks, 2, 1e-9), 0, 0);
    REQUIRE_CMP(irb_value_percentile(images, masks, 2, 1), <=, 3000);
    REQUIRE_NEAR(irb_value_percentile(&images[1], &masks[1], 1, 0.999), 0, 0);
    irb_image_destroy(&a);
    irb_image_destroy(&b);
}

/* Values whose squares exceed a float's range. */
static void extreme_values(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 1e30f), t = constant(W, H, 3e30f);
    struct irb_pair pair = {&t, &r, NULL};
    struct irb_error_scores s = irb_score_errors(&pair, irb_relmse_eps(1e30f));
    REQUIRE_REL(s.rmse, 2e30, 1e-6);
    REQUIRE_REL(s.relmse, 4 / 1.0001, 1e-6);
    irb_image_destroy(&r);
    irb_image_destroy(&t);
}

/* The reference moves and the error stays: no flicker, exactly, where the difference is exact. */
static void constant_error_does_not_flicker(void **state)
{
    (void)state;
    struct irb_image r0 = constant(W, H, 1), t0 = constant(W, H, 1.25f);
    struct irb_image r1 = constant(W, H, 2), t1 = constant(W, H, 2.25f);
    struct irb_pair before = {&t0, &r0, NULL}, now = {&t1, &r1, NULL};
    struct irb_flicker_scores s = irb_score_flicker(&before, &now, 1.5);
    REQUIRE_NEAR(s.flicker, 0, 0);
    REQUIRE_NEAR(s.pop_share, 0, 0);
    /* A method that lags one frame: e goes from 0.25 to -0.75. */
    struct irb_pair lag = {&t0, &r1, NULL};
    s = irb_score_flicker(&before, &lag, 1.5);
    REQUIRE_NEAR(s.flicker, 1 / 1.5, 1e-15);
    REQUIRE_NEAR(s.pop_share, 1, 0);
    irb_image_destroy(&r0);
    irb_image_destroy(&t0);
    irb_image_destroy(&r1);
    irb_image_destroy(&t1);
}

/* One of N pixels changes by d in one channel: flicker = d / sqrt(3 N) / mean R. */
static void one_pixel_pops(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 1), t0 = constant(W, H, 1), t1 = constant(W, H, 1);
    struct irb_pair before = {&t0, &r, NULL}, now = {&t1, &r, NULL};
    t1.data[3 * 77] = 1.5f;
    struct irb_flicker_scores s = irb_score_flicker(&before, &now, 2);
    REQUIRE_NEAR(s.flicker, 0.5 / sqrt(3 * N) / 2, 1e-15);
    REQUIRE_NEAR(s.pop_share, 1.0 / N, 1e-15);
    /* |e| = d/sqrt 3 against 0.1 max(1, 0.1 * 2): the threshold is d = 0.1732. */
    t1.data[3 * 77] = 1.17f;
    REQUIRE_NEAR(irb_score_flicker(&before, &now, 2).pop_share, 0, 0);
    t1.data[3 * 77] = 1.18f;
    REQUIRE_NEAR(irb_score_flicker(&before, &now, 2).pop_share, 1.0 / N, 1e-15);
    /* In a dark pixel the mean sets the threshold: 0.1 * 0.1 * 2 = 0.02. */
    for (int c = 0; c < 3; c++)
        r.data[3 * 77 + c] = 0.001f;
    t1.data[3 * 77] = 1.03f;
    REQUIRE_NEAR(irb_score_flicker(&before, &now, 2).pop_share, 0, 0);
    t1.data[3 * 77] = 1.04f;
    REQUIRE_NEAR(irb_score_flicker(&before, &now, 2).pop_share, 1.0 / N, 1e-15);
    irb_image_destroy(&r);
    irb_image_destroy(&t0);
    irb_image_destroy(&t1);
}

/* Only pixels with geometry in both frames, finite in all four images. */
static void flicker_leaves_pixels_out(void **state)
{
    (void)state;
    struct irb_image r = constant(W, H, 1), t0 = constant(W, H, 1), t1 = constant(W, H, 1);
    uint8_t mask0[N], mask1[N];
    for (size_t i = 0; i < N; i++) {
        mask0[i] = i % 2 == 0;
        mask1[i] = i % 3 == 0;
        if (!mask0[i] || !mask1[i])
            t1.data[3 * i] = 100;
    }
    t0.data[0] = NAN;
    t1.data[3 * 6] = 4;
    struct irb_pair before = {&t0, &r, mask0}, now = {&t1, &r, mask1};
    struct irb_flicker_scores s = irb_score_flicker(&before, &now, 1);
    double count = (N + 5) / 6 - 1; /* multiples of 6 but for 0 */
    REQUIRE_NEAR(s.flicker, sqrt(9 / 3.0 / count), 1e-14);
    REQUIRE_NEAR(s.pop_share, 1 / count, 1e-15);
    irb_image_destroy(&r);
    irb_image_destroy(&t0);
    irb_image_destroy(&t1);
}

static void summaries(void **state)
{
    (void)state;
    double values[100];
    for (int i = 0; i < 100; i++)
        values[i] = (i * 37) % 100 + 1; /* 1..100, shuffled */
    struct irb_summary s = irb_summarise(values, 100);
    REQUIRE_NEAR(s.mean, 50.5, 1e-12);
    REQUIRE_NEAR(s.median, 50.5, 0);
    REQUIRE_NEAR(s.p95, 95, 0);
    REQUIRE_NEAR(s.worst, 100, 0);
    const double few[] = {3, NAN, 1, 2};
    s = irb_summarise(few, 4);
    REQUIRE_NEAR(s.median, 2, 0);
    REQUIRE_NEAR(s.p95, 3, 0);
    s = irb_summarise(few, 1);
    REQUIRE_NEAR(s.p95 + s.worst + s.median + s.mean, 12, 0);
    assert_true(isnan(irb_summarise(few, 0).median));
    assert_true(isnan(irb_summarise(few + 1, 1).p95));
}

static float quantile_of(double fraction, const float *values, const double *weights, int count)
{
    struct irb_quantile *q = irb_quantile_create(fraction);
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < count; i++)
            irb_quantile_add(q, values[i], weights ? weights[i] : 1);
        irb_quantile_pass_done(q);
    }
    return irb_quantile_finish(q);
}

static int ascending(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void quantiles_agree_with_sorting(void **state)
{
    (void)state;
    float values[999], sorted[999];
    for (size_t i = 0; i < 999; i++)
        values[i] = sorted[i] = ldexpf((float)uniform(3, i), (int)(i % 80) - 60);
    qsort(sorted, 999, sizeof *sorted, ascending);
    for (int n = 1; n <= 999; n += 83)
        REQUIRE_NEAR(quantile_of(n / 999.0 - 1e-9, values, NULL, 999), sorted[n - 1], 0);
    const double weights[] = {1, 1, 5, 1};
    REQUIRE_NEAR(quantile_of(0.5, (const float[]){4, 1, 3, 2}, weights, 4), 3, 0);
    REQUIRE_NEAR(quantile_of(0.5, (const float[]){1, 2, 3, 4}, NULL, 4), 2, 0);
    REQUIRE_NEAR(quantile_of(0.5, values, NULL, 0), 0, 0);
    REQUIRE_NEAR(quantile_of(0.5, (const float[]){0, 0, -0.0f}, NULL, 3), 0, 0);
}

static void every_metric_is_documented(void **state)
{
    (void)state;
    for (int i = 0; i < IRB_METRIC_COUNT; i++) {
        const struct irb_metric_info *m = &irb_metrics[i];
        assert_int_equal(irb_metric_find(m->name), i); /* no name twice */
        assert_true(strlen(m->doc) > 10 && !strchr(m->doc, '\n'));
        assert_int_equal(strspn(m->name, "abcdefghijklmnopqrstuvwxyz0123456789_"), strlen(m->name));
        assert_non_null(m->unit);
        assert_non_null(irb_better_name(m->better));
    }
    assert_int_equal(irb_metric_find("nonsense"), -1);
    assert_int_equal(irb_region_metric_find("full_flip@door"), IRB_METRIC_full_flip);
    static const char *const none[] = {"full_flip", "full_flip@",      "full_fli@door",
                                       "lag@door",  "full_flipx@door", "@door"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        assert_int_equal(irb_region_metric_find(none[i]), -1);
    REQUIRE_NEAR(irb_metric_badness(IRB_METRIC_full_energy_ratio, 0.75), 0.25, 1e-15);
    REQUIRE_NEAR(irb_metric_badness(IRB_METRIC_full_bias, -2), 2, 0);
    REQUIRE_NEAR(irb_metric_badness(IRB_METRIC_frame_ms, 16), 16, 0);
    REQUIRE_NEAR(irb_metric_badness(IRB_METRIC_reference_noise, 16), 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_offset),
        cmocka_unit_test(scaled_reference),
        cmocka_unit_test(known_noise),
        cmocka_unit_test(single_wrong_value),
        cmocka_unit_test(masks_leave_pixels_out),
        cmocka_unit_test(non_finite_and_negative_are_counted),
        cmocka_unit_test(black_reference),
        cmocka_unit_test(one_pixel),
        cmocka_unit_test(psnr),
        cmocka_unit_test(percentile_of_a_sequence),
        cmocka_unit_test(extreme_values),
        cmocka_unit_test(constant_error_does_not_flicker),
        cmocka_unit_test(one_pixel_pops),
        cmocka_unit_test(flicker_leaves_pixels_out),
        cmocka_unit_test(summaries),
        cmocka_unit_test(quantiles_agree_with_sorting),
        cmocka_unit_test(every_metric_is_documented),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
