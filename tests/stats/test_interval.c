/* SPDX-License-Identifier: MIT
 *
 * What intervals must be exactly: equal units, too few of them, scale, order, sign, zeros.
 */
#include "core/stats/interval.h"

#include "tests/support/compare.h"

#include <string.h>

static const double UNITS[5] = {1.31, 0.94, 1.02, 1.2, 0.77};
static const double OTHERS[5] = {2.1, 1.7, 2.02, 1.9, 1.65};

static void require_equal(struct irb_interval interval, double value)
{
    REQUIRE_NEAR(interval.value - value, 0, 0);
    REQUIRE_NEAR(interval.low - value, 0, 0);
    REQUIRE_NEAR(interval.high - value, 0, 0);
}

static void require_none(struct irb_interval interval, double value)
{
    REQUIRE_NEAR(interval.value, value, 1e-15);
    assert_true(isnan(interval.low) && isnan(interval.high));
    assert_false(irb_interval_contains(&interval, value));
}

static void few_units(void **state)
{
    (void)state;
    const double same[2] = {3, 3};
    for (int count = 1; count < IRB_INTERVAL_LEAST_UNITS; count++) {
        require_none(irb_mean_interval(UNITS, count, 0.95), count == 1 ? 1.31 : 1.125);
        require_none(irb_ratio_interval(UNITS, UNITS, count, 0.95), 1);
        assert_int_equal(irb_mean_interval(UNITS, count, 0.95).units, count);
    }
    require_none(irb_mean_interval(same, 2, 0.95), 3);
    assert_true(isnan(irb_mean_interval(UNITS, 0, 0.95).value));
    assert_true(isnan(irb_ratio_interval(UNITS, UNITS, 0, 0.95).value));
}

static void equal_units(void **state)
{
    (void)state;
    double same[7], twice[5];
    for (int count = 3; count <= 7; count++) {
        for (int i = 0; i < 7; i++)
            same[i] = 0.1 * count; /* sums of which are rounded */
        require_equal(irb_mean_interval(same, count, 0.95), 0.1 * count);
        require_equal(irb_ratio_interval(same, same, count, 0.95), 1);
    }
    for (int i = 0; i < 5; i++)
        twice[i] = 2 * UNITS[i];
    require_equal(irb_ratio_interval(UNITS, UNITS, 5, 0.95), 1);
    require_equal(irb_ratio_interval(twice, UNITS, 5, 0.95), 2);
}

/* Three units -1, 0, 1: the interval is symmetric up to the chance of the resamples; its half-width
 * lies near that of Student's t, 4.30 standard errors of 1/sqrt(3), and above. */
static void symmetric_units(void **state)
{
    (void)state;
    const double units[3] = {-1, 0, 1};
    struct irb_interval interval = irb_mean_interval(units, 3, 0.95);
    REQUIRE_NEAR(interval.value, 0, 0);
    REQUIRE_REL(-interval.low, interval.high, 0.05);
    REQUIRE_CMP(interval.high, >, 4.30 / sqrt(3));
    REQUIRE_CMP(interval.high, <, 1.3 * 4.30 / sqrt(3));
}

/* A resample of many units is nearly normal: 1.96 standard errors to either side, and 2.58. */
static void many_units(void **state)
{
    (void)state;
    enum { COUNT = 400 };
    double units[COUNT];
    for (int i = 0; i < COUNT; i++)
        units[i] = (i + 0.5) / COUNT;
    const double error = sqrt(1.0 / 12 / COUNT);
    struct irb_interval interval = irb_mean_interval(units, COUNT, 0.95);
    REQUIRE_NEAR(interval.value, 0.5, 1e-12);
    REQUIRE_REL(interval.high - 0.5, 1.96 * error, 0.04);
    REQUIRE_REL(0.5 - interval.low, 1.96 * error, 0.04);
    interval = irb_mean_interval(units, COUNT, 0.99);
    REQUIRE_REL(interval.high - interval.low, 2 * 2.576 * error, 0.06);
}

static void scale_and_sign(void **state)
{
    (void)state;
    for (int power = -40; power <= 40; power += 16) {
        double scaled[5];
        const double scale = ldexp(1, power);
        for (int i = 0; i < 5; i++)
            scaled[i] = scale * UNITS[i];
        struct irb_interval one = irb_mean_interval(UNITS, 5, 0.95);
        struct irb_interval many = irb_mean_interval(scaled, 5, 0.95);
        REQUIRE_CMP(many.low, ==, scale * one.low);
        REQUIRE_CMP(many.high, ==, scale * one.high);
        one = irb_ratio_interval(UNITS, OTHERS, 5, 0.95);
        many = irb_ratio_interval(scaled, OTHERS, 5, 0.95);
        REQUIRE_CMP(many.low, ==, scale * one.low);
        REQUIRE_CMP(many.high, ==, scale * one.high);
        for (int i = 0; i < 5; i++)
            scaled[i] = -UNITS[i];
        one = irb_mean_interval(UNITS, 5, 0.95);
        many = irb_mean_interval(scaled, 5, 0.95);
        REQUIRE_CMP(many.low, ==, -one.high);
        REQUIRE_CMP(many.high, ==, -one.low);
    }
}

static void order_and_confidence(void **state)
{
    (void)state;
    const double turned[5] = {UNITS[3], UNITS[0], UNITS[4], UNITS[2], UNITS[1]};
    struct irb_interval one = irb_mean_interval(UNITS, 5, 0.95);
    struct irb_interval other = irb_mean_interval(turned, 5, 0.95);
    REQUIRE_REL(other.low, one.low, 1e-12);
    REQUIRE_REL(other.high, one.high, 1e-12);
    other = irb_mean_interval(UNITS, 5, 0.95);
    /* same units, same bits; the padding behind the last member has none */
    assert_memory_equal(&one, &other, offsetof(struct irb_interval, units));
    assert_int_equal(one.units, other.units);
    struct irb_interval wide = irb_mean_interval(UNITS, 5, 0.99);
    struct irb_interval narrow = irb_mean_interval(UNITS, 5, 0.5);
    REQUIRE_CMP(wide.low, <, one.low);
    REQUIRE_CMP(one.low, <, narrow.low);
    REQUIRE_CMP(narrow.high, <, one.high);
    REQUIRE_CMP(one.high, <, wide.high);
    require_none(irb_mean_interval(UNITS, 5, 1), 1.048);
    require_none(irb_mean_interval(UNITS, 5, 0), 1.048);
    require_none(irb_mean_interval(UNITS, 5, NAN), 1.048);
}

static void inverse_ratio(void **state)
{
    (void)state;
    for (int count = 3; count <= 5; count++) {
        struct irb_interval ab = irb_ratio_interval(UNITS, OTHERS, count, 0.95);
        struct irb_interval ba = irb_ratio_interval(OTHERS, UNITS, count, 0.95);
        REQUIRE_REL(ab.value, 1 / ba.value, 1e-15);
        REQUIRE_REL(ab.low, 1 / ba.high, 1e-14);
        REQUIRE_REL(ab.high, 1 / ba.low, 1e-14);
        REQUIRE_CMP(ab.low, <, ab.value);
        REQUIRE_CMP(ab.value, <, ab.high);
    }
}

/* What all pairs have in common doesn't count: a ratio that is the same in every pair up to 1 % has
 * an interval of that size, though the units themselves vary tenfold. */
static void common_spread(void **state)
{
    (void)state;
    const double b[5] = {1, 4, 0.7, 7, 2};
    const double noise[5] = {0.01, -0.01, 0.005, 0, -0.005};
    double a[5];
    for (int i = 0; i < 5; i++)
        a[i] = 1.5 * b[i] * (1 + noise[i]);
    struct irb_interval interval = irb_ratio_interval(a, b, 5, 0.95);
    REQUIRE_CMP(interval.low, >, 1.5 * 0.97);
    REQUIRE_CMP(interval.high, <, 1.5 * 1.03);
}

static void zeros(void **state)
{
    (void)state;
    const double none[5] = {0}, one[5] = {0, 0, 0, 0, 1}, negative[5] = {-1, -1, -1, -2, -1};
    require_equal(irb_mean_interval(none, 5, 0.95), 0);
    require_equal(irb_ratio_interval(none, none, 5, 0.95), 1);
    require_equal(irb_ratio_interval(none, UNITS, 5, 0.95), 0);
    struct irb_interval interval = irb_ratio_interval(UNITS, none, 5, 0.95);
    assert_true(isinf(interval.value) && isinf(interval.low) && isinf(interval.high));
    assert_true(interval.low > 0);
    interval = irb_ratio_interval(UNITS, none, 2, 0.95);
    assert_true(isinf(interval.value) && isnan(interval.low) && isnan(interval.high));
    /* a third of all resamples consists of zeros */
    interval = irb_mean_interval(one, 5, 0.95);
    REQUIRE_CMP(interval.low, >, -2);
    REQUIRE_CMP(interval.low, <, 0.2);
    REQUIRE_CMP(interval.high, <, 4);
    interval = irb_ratio_interval(one, UNITS, 5, 0.95);
    REQUIRE_CMP(interval.low, >, 0);
    REQUIRE_CMP(interval.high, <, INFINITY);
    require_none(irb_ratio_interval(negative, UNITS, 5, 0.95), -1.2 / 1.048);
    require_none(irb_ratio_interval(UNITS, negative, 5, 0.95), -1.048 / 1.2);
}

static void strange_units(void **state)
{
    (void)state;
    double units[5];
    memcpy(units, UNITS, sizeof units);
    units[2] = NAN;
    struct irb_interval interval = irb_mean_interval(units, 5, 0.95);
    assert_true(isnan(interval.value) && isnan(interval.low) && isnan(interval.high));
    interval = irb_ratio_interval(units, UNITS, 5, 0.95);
    assert_true(isnan(interval.value) && isnan(interval.low) && isnan(interval.high));
    units[2] = INFINITY;
    interval = irb_mean_interval(units, 5, 0.95);
    assert_true(isnan(interval.low) && isnan(interval.high));
    interval = irb_ratio_interval(UNITS, units, 5, 0.95);
    assert_true(isnan(interval.low) && isnan(interval.high));
    for (int i = 0; i < 5; i++) /* squares that no double holds */
        units[i] = 1e-200 * UNITS[i];
    struct irb_interval plain = irb_mean_interval(UNITS, 5, 0.95);
    interval = irb_mean_interval(units, 5, 0.95);
    REQUIRE_REL(interval.low, 1e-200 * plain.low, 1e-12);
    for (int i = 0; i < 5; i++)
        units[i] = 1e200 * UNITS[i];
    interval = irb_mean_interval(units, 5, 0.95);
    REQUIRE_REL(interval.high, 1e200 * plain.high, 1e-12);
}

static void less_noise(void **state)
{
    (void)state;
    const struct irb_interval square = {0.25, 0.16, 0.36, 5}, root = {0.5, 0.4, 0.6, 5};
    struct irb_interval less = irb_interval_less_noise(square, 0.07, false);
    REQUIRE_NEAR(less.low, 0.09, 1e-15);
    REQUIRE_NEAR(less.value, 0.25, 0);
    REQUIRE_NEAR(less.high, 0.36, 0);
    less = irb_interval_less_noise(root, 0.07, true); /* the root of the same */
    REQUIRE_NEAR(less.low, 0.3, 1e-15);
    REQUIRE_NEAR(less.high, 0.6, 0);
    REQUIRE_NEAR(irb_interval_less_noise(square, 1, false).low, 0, 0);
    REQUIRE_NEAR(irb_interval_less_noise(root, 1, true).low, 0, 0);
    REQUIRE_NEAR(irb_interval_less_noise(root, 0, true).low, 0.4, 1e-15);
    REQUIRE_NEAR(irb_interval_less_noise(square, NAN, false).low, 0.16, 0);
    const struct irb_interval below = {0.5, -0.4, 0.6, 3}, none = {0.5, NAN, NAN, 1};
    REQUIRE_NEAR(irb_interval_less_noise(below, 0.01, true).low, 0, 0);
    assert_true(isnan(irb_interval_less_noise(none, 0.01, false).low));
}

static void unit_names(void **state)
{
    (void)state;
    assert_string_equal(irb_unit_names[IRB_UNIT_NONE], "none");
    assert_string_equal(irb_unit_names[IRB_UNIT_BLOCK], "block");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_units),       cmocka_unit_test(equal_units),
        cmocka_unit_test(symmetric_units), cmocka_unit_test(many_units),
        cmocka_unit_test(scale_and_sign),  cmocka_unit_test(order_and_confidence),
        cmocka_unit_test(inverse_ratio),   cmocka_unit_test(common_spread),
        cmocka_unit_test(zeros),           cmocka_unit_test(strange_units),
        cmocka_unit_test(less_noise),      cmocka_unit_test(unit_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
