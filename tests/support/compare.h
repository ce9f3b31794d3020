/* SPDX-License-Identifier: MIT
 *
 * Assertions that print both values and what was compared. Include after cmocka.h.
 */
#ifndef IRB_TESTS_SUPPORT_COMPARE_H
#define IRB_TESTS_SUPPORT_COMPARE_H

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

/* Fails unless |found - expected| <= tolerance (absolute). */
#define REQUIRE_NEAR(found, expected, tolerance)                                                   \
    do {                                                                                           \
        double found_ = (found), expected_ = (expected), tolerance_ = (tolerance);                 \
        if (!(fabs(found_ - expected_) <= tolerance_))                                             \
            fail_msg("%s = %.9g, expected %s = %.9g +- %.3g", #found, found_, #expected,           \
                     expected_, tolerance_);                                                       \
    } while (0)

/* Fails unless |found/expected - 1| <= relative. */
#define REQUIRE_REL(found, expected, relative)                                                     \
    do {                                                                                           \
        double found_ = (found), expected_ = (expected), relative_ = (relative);                   \
        if (!(fabs(found_ - expected_) <= relative_ * fabs(expected_)))                            \
            fail_msg("%s = %.9g, expected %s = %.9g (%.3g %% off, %.3g %% allowed)", #found,       \
                     found_, #expected, expected_, 100 * fabs(found_ / expected_ - 1),             \
                     100 * relative_);                                                             \
    } while (0)

/* Comparison with an operator, both sides printed: REQUIRE_CMP(a, <=, b). */
#define REQUIRE_CMP(a, op, b)                                                                      \
    do {                                                                                           \
        double a_ = (a), b_ = (b);                                                                 \
        if (!(a_ op b_))                                                                           \
            fail_msg("%s %s %s does not hold: %.9g against %.9g", #a, #op, #b, a_, b_);            \
    } while (0)

/* A call that returns bool and fills `err` must succeed. */
#define REQUIRE_OK(call)                                                                           \
    do {                                                                                           \
        if (!(call))                                                                               \
            fail_msg("%s failed: %s", #call, err.message);                                         \
    } while (0)

/* The exit status by which Meson knows a skipped test. */
enum { TEST_SKIPPED = 77 };

#endif
