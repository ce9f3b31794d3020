/* SPDX-License-Identifier: MIT
 *
 * The kernels for this processor give the bits of those for any processor, and the light kernel
 * those of the function for one point.
 */
#include "core/reference/kernels.h"
#include "tests/support/compare.h"

#include <string.h>

static struct irb_light light_of(int kind)
{
    struct irb_light light = {.type = kind == 3 ? IRB_LIGHT_DIRECTIONAL : IRB_LIGHT_SPOT,
                              .position = {0.1f, 1.5f, 0.2f},
                              .direction = {0.6f, -0.8f, 0},
                              .intensity = {1, 2, 3},
                              .outer = 0.9f,
                              .inner = 0.4f,
                              .half_width = 0.8f};
    light.falloff = kind < 3 ? (enum irb_falloff)kind : IRB_FALLOFF_CONSTANT;
    return light;
}

static void fill(struct lanes3 *lanes, uint32_t set, bool unit)
{
    struct irb_sobol_set a = irb_sobol_seed(set, 1), b = irb_sobol_seed(set, 2);
    for (uint32_t i = 0; i < LANES; i++) {
        float x, y, z, unused;
        irb_sobol_2d(&a, i, &x, &y);
        irb_sobol_2d(&b, i, &z, &unused);
        struct vec3 v = v3(2 * x - 1, 2 * y - 1, 2 * z - 1);
        lanes3_set(lanes, (int)i, unit ? v3_normalize_safe(v) : v);
    }
}

static void fill_surface(struct surface_lanes *surface, uint32_t set)
{
    fill(&surface->position, set, false);
    fill(&surface->geometric, set + 1, true);
    fill(&surface->shading, set + 2, true);
    fill(&surface->diffuse, set + 3, false);
    surface->origin = surface->position;
}

#define REQUIRE_SAME(a, b) assert_memory_equal(&(a), &(b), sizeof(a))

static void test_points(void **state)
{
    (void)state;
    const struct kernels *any = kernels_portable(), *here = kernels_choose();
    struct irb_sobol_set set = irb_sobol_seed(5, 3);
    for (uint32_t first = 0; first < 1024; first += LANES) {
        struct lanes3 a = {{0}}, b = {{0}};
        any->square(&set, first, &a);
        here->square(&set, first, &b);
        REQUIRE_SAME(a, b);
        any->disc(&set, first, &a);
        here->disc(&set, first, &b);
        REQUIRE_SAME(a, b);
        any->cosine(&set, first, &a);
        here->cosine(&set, first, &b);
        REQUIRE_SAME(a, b);
    }
}

static void test_surfaces(void **state)
{
    (void)state;
    const struct kernels *any = kernels_portable(), *here = kernels_choose();
    for (uint32_t k = 0; k < 64; k++) {
        struct surface_lanes x, y;
        struct lanes3 local, a, b;
        int above_a[LANES], above_b[LANES];
        fill_surface(&x, 10 * k);
        fill(&local, 10 * k + 5, true);
        any->orient(&x, &local, &a, above_a);
        here->orient(&x, &local, &b, above_b);
        REQUIRE_SAME(a, b);
        REQUIRE_SAME(above_a, above_b);
        y = x;
        any->face(1e-5f, &local, &x);
        here->face(1e-5f, &local, &y);
        REQUIRE_SAME(x, y);
    }
}

static void test_light_and_gather(void **state)
{
    (void)state;
    const struct kernels *any = kernels_portable(), *here = kernels_choose();
    int lit = 0;
    for (uint32_t k = 0; k < 256; k++) {
        struct irb_light light = light_of((int)k % 4);
        struct light_source source;
        struct surface_lanes y;
        struct incident_lanes a, b;
        struct lanes3 direction, throughput, value_a, value_b;
        float t[LANES];
        light_source_prepare(&source, &light, 1e-5f);
        fill_surface(&y, 10 * k);
        fill(&direction, 10 * k + 5, true);
        fill(&throughput, 10 * k + 6, false);
        for (int i = 0; i < LANES; i++)
            t[i] = 1 + throughput.x[i];
        any->light(&source, &y, &a);
        here->light(&source, &y, &b);
        REQUIRE_SAME(a, b);
        any->gather(&source, &y, &a, &direction, direction.x, t, k & 4, &throughput, &value_a);
        here->gather(&source, &y, &b, &direction, direction.x, t, k & 4, &throughput, &value_b);
        REQUIRE_SAME(value_a, value_b);
        for (int i = 0; i < LANES; i++) {
            struct light_incident at;
            int expected = light_source_incident(
                &source, source.type, source.falloff, lanes3_at(&y.position, i),
                lanes3_at(&y.geometric, i), lanes3_at(&y.shading, i), &at);
            assert_int_equal(a.lit[i], expected);
            lit += expected;
            if (expected)
                REQUIRE_NEAR(a.irradiance[i], at.factor * at.cos_shading, 0);
        }
    }
    REQUIRE_CMP(lit, >, 100);
}

static void test_connections(void **state)
{
    (void)state;
    const struct kernels *any = kernels_portable(), *here = kernels_choose();
    struct irb_light light = light_of(0);
    struct light_source source;
    int facing = 0;
    light_source_prepare(&source, &light, 1e-5f);
    for (uint32_t k = 0; k < 64; k++) {
        struct surface_lanes x;
        struct light_lanes y;
        struct lanes3 throughput;
        struct connection_lanes a, b;
        fill_surface(&x, 10 * k);
        fill_surface(&y.surface, 10 * k + 5);
        fill(&y.radiance, 10 * k + 9, false);
        fill(&throughput, 10 * k + 4, false);
        any->light(&source, &y.surface, &y.incident);
        any->connect(&x, &y, &throughput, &a);
        here->connect(&x, &y, &throughput, &b);
        REQUIRE_SAME(a, b);
        for (int i = 0; i < LANES; i++)
            facing += a.facing[i];
    }
    REQUIRE_CMP(facing, >, 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points),
        cmocka_unit_test(test_surfaces),
        cmocka_unit_test(test_light_and_gather),
        cmocka_unit_test(test_connections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
