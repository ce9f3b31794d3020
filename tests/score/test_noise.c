/* SPDX-License-Identifier: MIT
 *
 * Noise of a known size, and what extrapolation over it makes of FLIP.
 */
#include "core/score/noise.h"

#include "core/score/flip.h"
#include "tests/support/compare.h"

#include <string.h>

static struct irb_error err;

enum { W = 96, H = 64, N = W * H };

static struct irb_image image_of(int channels)
{
    struct irb_image image;
    REQUIRE_OK(irb_image_create(&image, W, H, channels, &err));
    return image;
}

static struct irb_image constant(int channels, float value)
{
    struct irb_image image = image_of(channels);
    for (int i = 0; i < channels * N; i++)
        image.data[i] = value;
    return image;
}

/* Mean 0, variance 1, kurtosis 3, no correlation of neighbours; standard errors 1/sqrt(n) and so
 * on. */
static void moments_of_the_normal(void **state)
{
    (void)state;
    enum { COUNT = 200000 };
    double sums[5] = {0}, product = 0, before = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double z = irb_normal(7, i), power = 1;
        assert_true(isfinite(z));
        for (int k = 0; k < 5; k++, power *= z)
            sums[k] += power / COUNT;
        product += z * before / COUNT;
        before = z;
    }
    double error = 1 / sqrt(COUNT);
    REQUIRE_NEAR(sums[1], 0, 4 * error);
    REQUIRE_NEAR(sums[2], 1, 4 * sqrt(2) * error);
    REQUIRE_NEAR(sums[3], 0, 4 * sqrt(15) * error);
    REQUIRE_NEAR(sums[4], 3, 4 * sqrt(96) * error);
    REQUIRE_NEAR(product, 0, 4 * error);
    REQUIRE_NEAR(irb_normal(7, 3), irb_normal(7, 3), 0);
    assert_true(irb_normal(7, 3) != irb_normal(8, 3));
}

static void noise_keeps_colour_and_sign(void **state)
{
    (void)state;
    struct irb_image image = constant(3, 1), deviation = constant(1, 0.2f), noisy;
    double sum = 0, square = 0;
    for (int i = 0; i < N; i++) {
        image.data[3 * i + 1] = 0.5f;
        image.data[3 * i + 2] = 0;
    }
    deviation.data[0] = NAN;
    deviation.data[1] = INFINITY;
    deviation.data[2] = -1;
    deviation.data[3] = 0;
    deviation.data[4] = 1e6f; /* half of such pixels are black */
    REQUIRE_OK(irb_noisy_image(&image, &deviation, 1, &noisy, &err));
    for (int i = 0; i < N; i++) {
        const float *p = noisy.data + 3 * i;
        if (i < 4)
            REQUIRE_NEAR(p[0], 1, 0);
        REQUIRE_NEAR(p[1], 0.5 * p[0], 1e-7 * p[0]);
        REQUIRE_NEAR(p[2], 0, 0);
        REQUIRE_CMP(p[0], >=, 0);
        assert_true(isfinite(p[0]));
        if (i >= 5) {
            sum += p[0] - 1.0;
            square += (p[0] - 1.0) * (p[0] - 1.0);
        }
    }
    REQUIRE_NEAR(sum / N, 0, 4 * 0.2 / sqrt(N));
    REQUIRE_REL(sqrt(square / N), 0.2, 4 / sqrt(2 * N));
    irb_image_destroy(&noisy);
    irb_image_destroy(&deviation);
    irb_image_destroy(&image);
}

/* A smooth image without noise, and a result that is brighter in one place. */
static void make_scene(struct irb_image *truth, struct irb_image *result)
{
    *truth = image_of(3);
    *result = image_of(3);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            float light = 0.5f + 0.4f * sinf(0.1f * (float)x) * cosf(0.07f * (float)y);
            float away = hypotf((float)x - 50, (float)y - 30) / 20;
            for (int c = 0; c < 3; c++) {
                irb_image_at(truth, x, y)[c] = light * (c == 1 ? 0.8f : 1);
                irb_image_at(result, x, y)[c] =
                    irb_image_at(truth, x, y)[c] * (1 + 0.6f * expf(-away * away));
            }
        }
}

static double flip(const struct irb_image *test, const struct irb_image *reference,
                   const struct irb_flip_exposures *exposures)
{
    struct irb_flip_scores scores;
    REQUIRE_OK(
        irb_flip_hdr(test, reference, NULL, exposures, IRB_FLIP_PPD, 1, NULL, &scores, &err));
    return scores.mean;
}

/* FLIP against a noisy reference, less its growth with a second dose, is nearer to FLIP against the
 * reference without noise than what was measured. */
static void extrapolation_comes_nearer(void **state)
{
    (void)state;
    struct irb_image truth, result;
    struct irb_flip_exposures exposures;
    make_scene(&truth, &result);
    const struct irb_image *references[] = {&truth};
    assert_true(irb_flip_exposures_of(references, NULL, 1, &exposures));
    double without = flip(&result, &truth, &exposures);
    for (int step = 1; step <= 3; step++) {
        struct irb_image deviation = constant(1, 0.02f * (float)step), once, twice;
        REQUIRE_OK(irb_noisy_image(&truth, &deviation, 11, &once, &err));
        REQUIRE_OK(irb_noisy_image(&once, &deviation, 12, &twice, &err));
        double measured = flip(&result, &once, &exposures);
        double growth = flip(&result, &twice, &exposures) - measured;
        print_message("deviation %.2f: FLIP without noise %.5f, measured %.5f, extrapolated %.5f\n",
                      0.02 * step, without, measured, measured - growth);
        REQUIRE_CMP(measured, >, without);
        REQUIRE_CMP(growth, >, 0);
        REQUIRE_CMP(fabs(measured - growth - without), <, 0.7 * (measured - without));
        irb_image_destroy(&twice);
        irb_image_destroy(&once);
        irb_image_destroy(&deviation);
    }
    struct irb_image none = constant(1, 0), same;
    REQUIRE_OK(irb_noisy_image(&truth, &none, 12, &same, &err));
    REQUIRE_NEAR(flip(&result, &same, &exposures), without, 0);
    irb_image_destroy(&same);
    irb_image_destroy(&none);
    irb_image_destroy(&result);
    irb_image_destroy(&truth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moments_of_the_normal),
        cmocka_unit_test(noise_keeps_colour_and_sign),
        cmocka_unit_test(extrapolation_comes_nearer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
