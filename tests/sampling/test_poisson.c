/* SPDX-License-Identifier: MIT
 *
 * Poisson-disk points: on the disc, apart, and the same for the same seed.
 */
#include "tests/support/compare.h"
#include "core/sampling/poisson.h"

#include <string.h>

/* Least distance of two of n points. */
static double least_distance(const float (*points)[2], int n)
{
    double least = 2;
    for (int i = 1; i < n; i++)
        least = fmin(least, sqrt((double)irb_poisson_nearest(points, i, points[i])));
    return least;
}

/* The densest packing of n discs of diameter d round points of the unit disc covers at most
 * pi/sqrt(12) of a disc of radius 1 + d/2, so d is bounded by n. Random points come to 0.1 of that
 * or less. */
static void test_least_distance(void **state)
{
    (void)state;
    const int counts[] = {1, 2, 8, 16, 32, 64};
    double worst[6] = {1, 1, 1, 1, 1, 1};
    for (int k = 0; k < 6; k++)
        for (uint32_t seed = 0; seed < 20; seed++) {
            float points[64][2];
            const int n = counts[k];
            irb_poisson_disc(seed, n, points);
            for (int i = 0; i < n; i++)
                REQUIRE_CMP(hypot(points[i][0], points[i][1]), <=, 1 + 1e-6);
            /* (n d^2/4) <= 0.9069 (1 + d/2)^2 */
            double s = sqrt(0.9069 / n), most = fmin(2, s / (0.5 - 0.5 * s));
            if (n > 1) {
                worst[k] = fmin(worst[k], least_distance((const float(*)[2])points, n) / most);
                REQUIRE_CMP(least_distance((const float(*)[2])points, n), >, 0.6 * most);
                REQUIRE_CMP(least_distance((const float(*)[2])points, n), <=, most + 1e-6);
            }
        }
    print_message("least distance of 8, 16, 32, 64 points over the bound: %.2f %.2f %.2f %.2f\n",
                  worst[2], worst[3], worst[4], worst[5]);
}

/* Two seeds differ, one repeats itself; the first points of a set are spread out too. */
static void test_seeds(void **state)
{
    (void)state;
    float a[16][2], b[16][2], c[16][2];
    irb_poisson_disc(3, 16, a);
    irb_poisson_disc(4, 16, b);
    irb_poisson_disc(3, 16, c);
    assert_memory_not_equal(a, b, sizeof a);
    assert_memory_equal(a, c, sizeof a);
    REQUIRE_CMP(least_distance((const float(*)[2])a, 4), >, 0.6);
}

/* The set is centred: the mean of many points of the disc is near 0, and r^2 is uniform. */
static void test_uniform(void **state)
{
    (void)state;
    double mean[2] = {0}, square = 0;
    for (uint32_t seed = 0; seed < 200; seed++) {
        float points[16][2];
        irb_poisson_disc(seed, 16, points);
        for (int i = 0; i < 16; i++) {
            mean[0] += points[i][0] / 3200.0;
            mean[1] += points[i][1] / 3200.0;
            square += (points[i][0] * points[i][0] + points[i][1] * points[i][1]) / 3200.0;
        }
    }
    REQUIRE_NEAR(mean[0], 0, 0.02);
    REQUIRE_NEAR(mean[1], 0, 0.02);
    /* points that keep apart crowd the rim, where they have no neighbours outside */
    REQUIRE_NEAR(square, 0.5, 0.15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_least_distance),
        cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_uniform),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
