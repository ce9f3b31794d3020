/* SPDX-License-Identifier: MIT
 *
 * Halton's first points as published; the Sobol sets against the definition of a (0,k,2)-net, which
 * any correct scrambling keeps.
 */
#include "core/base/hash.h"
#include "core/sampling/halton.h"
#include "core/sampling/sobol.h"
#include "tests/support/compare.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static void test_halton_first_values(void **state)
{
    (void)state;
    static const double base2[] = {0, 1. / 2, 1. / 4, 3. / 4, 1. / 8, 5. / 8, 3. / 8, 7. / 8};
    static const double base3[] = {0,      1. / 3, 2. / 3, 1. / 9, 4. / 9,
                                   7. / 9, 2. / 9, 5. / 9, 8. / 9, 1. / 27};
    for (uint32_t i = 0; i < 8; i++)
        REQUIRE_NEAR(irb_radical_inverse(2, i), base2[i], 1e-15);
    for (uint32_t i = 0; i < 10; i++)
        REQUIRE_NEAR(irb_radical_inverse(3, i), base3[i], 1e-15);
    float point[2];
    irb_halton_2d(5, point);
    REQUIRE_NEAR(point[0], 5. / 8, 1e-7);
    REQUIRE_NEAR(point[1], 7. / 9, 1e-7);
}

static void test_halton_stays_below_one(void **state)
{
    (void)state;
    static const uint32_t indices[] = {0xffffffffu, 0x7fffffffu, 3486784400u /* 3^20 - 1 */};
    for (int i = 0; i < 3; i++) {
        float point[2];
        irb_halton_2d(indices[i], point);
        REQUIRE_CMP(point[0], <, 1);
        REQUIRE_CMP(point[1], <, 1);
    }
}

/* Every elementary interval of area 2^-k holds exactly one of the 2^k points first..first+2^k-1. */
static void require_net(const struct irb_sobol_set *set, uint32_t first, int k)
{
    enum { MAX_K = 10 };
    for (int columns = 0; columns <= k; columns++) {
        unsigned char hits[1 << MAX_K] = {0};
        for (uint32_t i = first; i < first + (1u << k); i++) {
            float x, y;
            irb_sobol_2d(set, i, &x, &y);
            uint32_t column = (uint32_t)(x * (float)(1 << columns));
            uint32_t row = (uint32_t)(y * (float)(1 << (k - columns)));
            REQUIRE_CMP(column, <, 1 << columns);
            REQUIRE_CMP(row, <, 1 << (k - columns));
            hits[(row << columns) + column]++;
        }
        for (int i = 0; i < 1 << k; i++)
            REQUIRE_CMP(hits[i], ==, 1);
    }
}

/* Stretches begin at whole multiples of their length and end within the sequence, whatever the seed
 * and the frame; frame 0 has that of the seed's number. */
static void test_stretches(void **state)
{
    (void)state;
    const uint32_t lengths[] = {1, 7, 400, 1024, 16384, 1 << 20, 1 << 29, 1 << 30};
    const uint64_t seeds[] = {0, 1, 2, 1000000, UINT32_MAX, (uint64_t)1 << 63, UINT64_MAX};
    const uint32_t frames[] = {0, 1, 2, 999, UINT32_MAX};
    for (size_t l = 0; l < sizeof lengths / sizeof *lengths; l++)
        for (size_t s = 0; s < sizeof seeds / sizeof *seeds; s++)
            for (size_t f = 0; f < sizeof frames / sizeof *frames; f++) {
                uint32_t first = irb_halton_stretch(seeds[s], frames[f], lengths[l]);
                assert_int_equal(first % lengths[l], 0);
                REQUIRE_CMP((uint64_t)first + lengths[l], <=, IRB_HALTON_POINTS);
                if (seeds[s] * lengths[l] < IRB_HALTON_POINTS && seeds[s] < 3 && !frames[f])
                    assert_int_equal(first, seeds[s] * lengths[l]);
            }
}

/* Ten seeds, as many frames as are promised: every one has points of its own. */
static void test_stretches_are_apart(void **state)
{
    (void)state;
    const uint32_t lengths[] = {256, 400, 1024, 5000, 16384, 1 << 20};
    for (size_t l = 0; l < sizeof lengths / sizeof *lengths; l++) {
        const uint32_t stretches = (uint32_t)IRB_HALTON_POINTS / lengths[l];
        const uint32_t promised = (uint32_t)(0.44 / 10 * stretches);
        bool *taken = calloc(stretches, sizeof *taken);
        assert_non_null(taken);
        for (uint64_t seed = 1; seed <= 10; seed++)
            for (uint32_t frame = 0; frame < promised; frame++) {
                bool *t = &taken[irb_halton_stretch(seed, frame, lengths[l]) / lengths[l]];
                if (*t)
                    fail_msg("seed %d, frame %u, %u points: taken", (int)seed, frame, lengths[l]);
                *t = true;
            }
        free(taken);
    }
}

static void test_sobol_is_a_net(void **state)
{
    (void)state;
    for (uint32_t n = 0; n < 8; n++) {
        struct irb_sobol_set set = irb_sobol_seed(irb_hash_mix(11, n), n);
        for (int k = 0; k <= 10; k++) {
            require_net(&set, 0, k);
            require_net(&set, 1u << k, k); /* samples that are added later */
            require_net(&set, 0x5a5u << k, k);
        }
    }
}

static void test_unscrambled_points(void **state)
{
    (void)state;
    /* The first eight of Sobol's points in two dimensions (Bratley and Fox 1988, without the Gray
     * code's order): the second generator matrix, against published numbers. */
    static const double y[] = {0, 1. / 2, 3. / 4, 1. / 4, 5. / 8, 1. / 8, 3. / 8, 7. / 8};
    for (uint32_t i = 0; i < 8; i++)
        REQUIRE_NEAR(irb_unit_float(irb_reverse_bits(irb_sobol_pascal(i))), y[i], 1e-7);
}

/* The same point of many seeds is uniform: the mean of f over seeds is its integral. */
static void test_seeds_are_uniform(void **state)
{
    (void)state;
    enum { SEEDS = 20000, CELLS = 8 };
    for (uint32_t index = 0; index < 4; index++) {
        int cells[CELLS][CELLS] = {0};
        for (uint64_t s = 0; s < SEEDS; s++) {
            struct irb_sobol_set set = irb_sobol_seed(irb_hash_mix(s, 5), 3);
            float x, y;
            irb_sobol_2d(&set, index, &x, &y);
            cells[(int)(y * CELLS)][(int)(x * CELLS)]++;
        }
        double chi2 = 0, expected = (double)SEEDS / (CELLS * CELLS);
        for (int i = 0; i < CELLS * CELLS; i++)
            chi2 += pow(cells[i / CELLS][i % CELLS] - expected, 2) / expected;
        REQUIRE_CMP(chi2, <, 116.5); /* 63 degrees of freedom: exceeded with probability 5e-5 */
    }
}

/* Two sets of one pixel have no correlation that a product would see. */
static void test_sets_are_independent(void **state)
{
    (void)state;
    enum { SEEDS = 4000, POINTS = 16 };
    double sum = 0, square = 0;
    for (uint64_t s = 0; s < SEEDS; s++) {
        uint64_t seed = irb_hash_mix(s, 9);
        struct irb_sobol_set a = irb_sobol_seed(seed, 1), b = irb_sobol_seed(seed, 2);
        double mean = 0;
        for (uint32_t i = 0; i < POINTS; i++) {
            float ax, ay, bx, by;
            irb_sobol_2d(&a, i, &ax, &ay);
            irb_sobol_2d(&b, i, &bx, &by);
            mean += (ax - 0.5) * (bx - 0.5) + (ay - 0.5) * (by - 0.5);
        }
        sum += mean / POINTS;
        square += mean * mean / POINTS / POINTS;
    }
    double error = sqrt(square) / SEEDS;
    REQUIRE_NEAR(sum / SEEDS, 0, 4 * error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_halton_first_values), cmocka_unit_test(test_halton_stays_below_one),
        cmocka_unit_test(test_stretches),           cmocka_unit_test(test_stretches_are_apart),
        cmocka_unit_test(test_sobol_is_a_net),      cmocka_unit_test(test_unscrambled_points),
        cmocka_unit_test(test_seeds_are_uniform),   cmocka_unit_test(test_sets_are_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
