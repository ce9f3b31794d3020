/* SPDX-License-Identifier: MIT
 *
 * The order of trials in a frame: fair to all of them.
 */
#include "core/experiment/render_round.h"
#include "tests/support/compare.h"

enum { MOST = 40 };

/* Every trial once in each turn, and first once over `count` turns. */
static void test_permutations(void **state)
{
    (void)state;
    for (int count = 1; count <= MOST; count++) {
        int first[MOST] = {0};
        for (int turn = 5; turn < 5 + count; turn++) {
            bool seen[MOST] = {0};
            for (int place = 0; place < count; place++) {
                int trial = irb_round_order(turn, place, count);
                assert_in_range(trial, 0, count - 1);
                assert_false(seen[trial]);
                seen[trial] = true;
                first[trial] += !place;
            }
        }
        for (int t = 0; t < count; t++)
            assert_int_equal(first[t], 1);
    }
}

/* Of three trials or more, none always follows the same other one: within eight frames. */
static void test_predecessors(void **state)
{
    (void)state;
    for (int count = 3; count <= MOST; count++) {
        int first[MOST];
        bool another[MOST] = {0};
        for (int t = 0; t < count; t++)
            first[t] = -1;
        for (int turn = 0; turn < 8; turn++)
            for (int place = 1; place < count; place++) {
                int trial = irb_round_order(turn, place, count);
                int before = irb_round_order(turn, place - 1, count);
                another[trial] = another[trial] || (first[trial] >= 0 && first[trial] != before);
                first[trial] = before;
            }
        for (int t = 0; t < count; t++)
            assert_true(another[t]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_permutations),
        cmocka_unit_test(test_predecessors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
