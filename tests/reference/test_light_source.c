/* SPDX-License-Identifier: MIT
 *
 * The prepared light of the inner loop against core/scene/light.h, and its rays against the density
 * they claim.
 */
#include "core/reference/kernels.h"
#include "core/reference/sample_map.h"
#include "tests/support/compare.h"

#include <string.h>

static const struct irb_light lights[] = {
    {.type = IRB_LIGHT_SPOT,
     .position = {0.1f, 0.2f, 0.3f},
     .direction = {0.6f, 0, -0.8f},
     .intensity = {1, 2, 3},
     .outer = 0.7f},
    {.type = IRB_LIGHT_SPOT,
     .position = {-1, 5, 2},
     .direction = {0, -1, 0},
     .intensity = {1, 2, 3},
     .outer = 1.2f,
     .inner = 0.5f,
     .falloff = IRB_FALLOFF_SMOOTH},
    {.type = IRB_LIGHT_SPOT,
     .position = {0, 0, 0},
     .direction = {0, 0.8f, 0.6f},
     .intensity = {4, 5, 6},
     .outer = 1.0f,
     .falloff = IRB_FALLOFF_COSINE},
    {.type = IRB_LIGHT_DIRECTIONAL,
     .position = {0, 2, 0},
     .direction = {0.6f, -0.8f, 0},
     .intensity = {7, 8, 9},
     .half_width = 1.5f},
};
enum { LIGHTS = sizeof lights / sizeof *lights };

static void test_same_radiometry(void **state)
{
    (void)state;
    struct irb_sobol_set set = irb_sobol_seed(7, 0), depth = irb_sobol_seed(8, 0);
    int lit = 0;
    for (int k = 0; k < LIGHTS; k++) {
        struct light_source source;
        light_source_prepare(&source, &lights[k], 0);
        for (uint32_t i = 0; i < 2000; i++) {
            float x, y, z, unused, expected[3], to_light[3], distance;
            irb_sobol_2d(&set, i, &x, &y);
            irb_sobol_2d(&depth, i, &z, &unused);
            struct vec3 p = v3(6 * x - 3, 6 * y - 3, 6 * z - 3);
            irb_light_incident(&lights[k], (float[3]){p.x, p.y, p.z}, expected, to_light,
                               &distance);
            struct vec3 l = v3_load(to_light);
            struct light_incident incident;
            if (!light_source_incident(&source, source.type, source.falloff, p, l, l, &incident)) {
                REQUIRE_NEAR(expected[0], 0, 0);
                continue;
            }
            lit++;
            struct vec3 e = v3_scale(source.intensity, incident.factor);
            REQUIRE_REL(e.x, expected[0], 1e-4);
            REQUIRE_REL(e.z, expected[2], 1e-4);
            REQUIRE_REL(incident.distance, distance, 1e-5);
            REQUIRE_NEAR(incident.cos_geometric, 1, 1e-5);
        }
    }
    REQUIRE_CMP(lit, >, 400);
}

/* Rays are in the cone, and their mean falloff times the solid angle is the light's power. */
static void test_rays_carry_the_power(void **state)
{
    (void)state;
    enum { RAYS = 4096 };
    struct irb_sobol_set set = irb_sobol_seed(3, 0);
    const struct kernels *kernels = kernels_choose();
    for (int k = 0; k < LIGHTS; k++) {
        struct light_source source;
        double sum = 0, watts[3];
        bool spot = lights[k].type == IRB_LIGHT_SPOT;
        light_source_prepare(&source, &lights[k], 0);
        for (uint32_t i = 0; i < RAYS; i += LANES) {
            struct lanes3 block;
            (spot ? kernels->disc : kernels->square)(&set, i, &block);
            for (int s = 0; s < LANES; s++) {
                struct vec3 origin, direction;
                light_source_emit(&source, block.x[s], block.y[s], &origin, &direction);
                REQUIRE_NEAR(v3_dot(direction, direction), 1, 2e-6);
                float cosine = v3_dot(direction, source.direction);
                REQUIRE_CMP(cosine, >, source.cos_outer - 1e-6f);
                sum += spot ? (double)light_source_falloff(&source, source.falloff, cosine) : 1.0;
            }
        }
        irb_light_power(&lights[k], watts);
        double density = (double)source.density;
        REQUIRE_REL(sum / RAYS / density * (double)source.intensity.y, watts[1], 1e-3);
    }
}

static void test_lights_that_give_nothing(void **state)
{
    (void)state;
    struct light_source source;
    struct irb_light light = lights[0];
    light.outer = 0;
    light_source_prepare(&source, &light, 0);
    assert_true(source.dark);
    light = lights[3];
    light.half_width = 0;
    light_source_prepare(&source, &light, 0);
    assert_true(source.dark);
    light = lights[0];
    memset(light.intensity, 0, sizeof light.intensity);
    light_source_prepare(&source, &light, 0);
    assert_true(source.dark);
}

/* E[cos] = 2/3 and E[x^2] = 1/4 for the density cos/pi. */
static void test_cosine_directions(void **state)
{
    (void)state;
    enum { COUNT = 4096 };
    struct irb_sobol_set set = irb_sobol_seed(4, 1);
    const struct kernels *kernels = kernels_choose();
    double cosine = 0, x2 = 0, xy = 0;
    for (uint32_t i = 0; i < COUNT; i += LANES) {
        struct lanes3 b;
        kernels->cosine(&set, i, &b);
        for (int s = 0; s < LANES; s++) {
            float x, y;
            irb_sobol_2d(&set, i + (uint32_t)s, &x, &y);
            struct vec3 d = map_to_cosine(x, y); /* one at a time: the same bits */
            assert_memory_equal(&d.x, &b.x[s], sizeof(float));
            assert_memory_equal(&d.z, &b.z[s], sizeof(float));
            REQUIRE_NEAR(v3_dot(d, d), 1, 2e-6);
            cosine += (double)d.z / COUNT;
            x2 += (double)(d.x * d.x) / COUNT;
            xy += (double)(d.x * d.y) / COUNT;
        }
    }
    REQUIRE_NEAR(cosine, 2.0 / 3, 1e-4);
    REQUIRE_NEAR(x2, 0.25, 1e-3);
    REQUIRE_NEAR(xy, 0, 1e-3);
}

static void test_basis_is_orthonormal(void **state)
{
    (void)state;
    static const float normals[][3] = {{0, 0, 1},  {0, 0, -1},       {1, 0, 0},
                                       {0, -1, 0}, {0.6f, 0, -0.8f}, {1e-4f, 0, -1}};
    for (size_t i = 0; i < sizeof normals / sizeof *normals; i++) {
        struct vec3 n = v3_load(normals[i]), s, t;
        v3_basis(n, &s, &t);
        REQUIRE_NEAR(v3_dot(s, s), 1, 1e-6);
        REQUIRE_NEAR(v3_dot(t, t), 1, 1e-6);
        REQUIRE_NEAR(v3_dot(s, t), 0, 1e-6);
        REQUIRE_NEAR(v3_dot(s, n), 0, 1e-6);
        REQUIRE_NEAR(v3_dot(v3_cross(s, t), n), 1, 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_radiometry),
        cmocka_unit_test(test_rays_carry_the_power),
        cmocka_unit_test(test_lights_that_give_nothing),
        cmocka_unit_test(test_cosine_directions),
        cmocka_unit_test(test_basis_is_orthonormal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
