/* SPDX-License-Identifier: MIT
 *
 * The bitonic sort against the C library's.
 */
#include "core/gl/sort.h"
#include "tests/support/compare.h"
#include "tests/gl/fixture.h"

static struct irb_gl *gl;

static uint32_t next_random(uint32_t *x)
{
    *x ^= *x << 13;
    *x ^= *x >> 17;
    *x ^= *x << 5;
    return *x;
}

static int compare(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

enum kind { RANDOM, SORTED, REVERSED, ALIKE, EXTREMES, KINDS };

static uint32_t key_of(enum kind kind, uint32_t i, uint32_t count, uint32_t *random)
{
    switch (kind) {
    case SORTED:
        return i;
    case REVERSED:
        return count - i;
    case ALIKE:
        return 7;
    case EXTREMES:
        return i % 3 ? 0xffffffffu : 0;
    default:
        return next_random(random);
    }
}

/* Every length round the powers of two and the block of 4096, and orders that a network may get
 * wrong. What follows the keys is padding. */
static void test_against_qsort(void **state)
{
    (void)state;
    struct irb_error err = {0};
    const int counts[] = {0,    1,    2,    3,    5,    63,    64,    255,  256,
                          1000, 4095, 4096, 4097, 8192, 10000, 40000, 65536};
    struct irb_sort *sort = irb_sort_create(gl, &err);
    REQUIRE_OK(sort);
    uint32_t random = 1;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (int kind = 0; kind < KINDS; kind++) {
            const int count = counts[c];
            const size_t all = (size_t)irb_sort_bytes(count) / 4;
            uint32_t *keys = malloc(4 * all), *found = malloc(4 * all);
            for (size_t i = 0; i < all; i++)
                keys[i] = key_of((enum kind)kind, (uint32_t)i, (uint32_t)count, &random);
            struct irb_buffer *buffer = irb_buffer_create(gl, "keys", 4 * (int64_t)all, keys, &err);
            REQUIRE_OK(buffer);
            REQUIRE_OK(irb_sort_run(sort, buffer, count, &err));
            REQUIRE_OK(irb_buffer_read(buffer, 0, 4 * (int64_t)all, found, &err));
            qsort(keys, (size_t)count, 4, compare);
            for (size_t i = 0; i < all; i++)
                if (found[i] != (i < (size_t)count ? keys[i] : 0xffffffffu))
                    fail_msg("%d keys, kind %d: key %zu is %u", count, kind, i, found[i]);
            irb_buffer_destroy(buffer);
            free(keys);
            free(found);
        }
    irb_sort_destroy(sort);
}

static void test_refusal(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_sort *sort = irb_sort_create(gl, &err);
    struct irb_buffer *buffer = irb_buffer_create(gl, "keys", 32, NULL, &err);
    REQUIRE_OK(sort && buffer);
    REQUIRE_OK(irb_sort_run(sort, buffer, 8, &err));
    assert_false(irb_sort_run(sort, buffer, 9, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_buffer_destroy(buffer);
    irb_sort_destroy(sort);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_qsort),
        cmocka_unit_test(test_refusal),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
