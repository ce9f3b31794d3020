/* SPDX-License-Identifier: MIT
 *
 * A build without Embree says so, and what to install.
 */
#include "core/reference/reference.h"
#include "tests/support/compare.h"

#include <string.h>

static void test_tracing_is_refused(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct irb_scene scene = {0};
    struct irb_reference_job job = {0};
    struct irb_reference_image out;
    assert_null(irb_tracer_create(&scene, &err));
    assert_int_equal(err.code, IRB_E_USAGE);
    assert_non_null(strstr(err.message, "libembree-dev"));
    assert_false(irb_reference_render(&job, &out, &err));
    assert_int_equal(err.code, IRB_E_USAGE);
    irb_tracer_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_tracing_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
