/* SPDX-License-Identifier: MIT
 *
 * Triangles' need of points against closed forms and sums over small pieces; points drawn by
 * weights against these.
 *
 *     test_point_need BACKEND
 */
#include "tests/support/compare.h"
#include "core/lights/point_need.h"
#include "core/lights/tessellation.h"
#include "tests/frame/fixture.h"
#include "tests/lights/points_fixture.h"
#include "tests/lights/raster_fixture.h"

static struct irb_gl *gl;

static const float grey[3] = {0.5f, 0.5f, 0.5f};

/* Uniform in [-1,1). */
static double either(uint64_t *random)
{
    return 2 * fixture_random(random) - 1;
}

static struct irb_need_light make_light(const double position[3], const double normal[3],
                                        double flux)
{
    struct irb_need_light light = {.flux = {(float)flux, (float)flux, (float)flux}};
    const double length =
        sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (int k = 0; k < 3; k++) {
        light.position[k] = (float)position[k];
        light.normal[k] = (float)(normal[k] / length);
    }
    return light;
}

static struct irb_scene *make_triangles(const double (*corners)[3][3], int count)
{
    struct irb_error err = {0};
    struct irb_builder builder;
    const double up[3] = {0, 1, 0};
    irb_builder_begin(&builder, "triangles");
    irb_builder_object(&builder, "all", irb_builder_material(&builder, "grey", grey));
    for (int t = 0; t < count; t++) {
        uint32_t v[3];
        for (int i = 0; i < 3; i++)
            v[i] = irb_builder_vertex(&builder, corners[t][i], up, NULL);
        irb_builder_triangle(&builder, v[0], v[1], v[2]);
    }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    return scene;
}

/* Sum of the first `count` triangles' needs. */
static double need_sum(const struct irb_scene *scene, const struct irb_need_light *lights,
                       int count)
{
    double *need = calloc(scene->triangle_count, sizeof *need), sum = 0;
    irb_point_need(scene, lights, count, need);
    for (uint32_t t = 0; t < scene->triangle_count; t++) {
        assert_true(isfinite(need[t]) && need[t] >= 0 && need[t] <= 1);
        sum += need[t];
    }
    free(need);
    return sum;
}

/* ---- Need ---- */

/* A small triangle: cos_l cos_T A/(pi d^2), either side of it; nothing behind the light; lights
 * without flux count for nothing; and it goes where its object goes. */
static void test_small(void **state)
{
    (void)state;
    const double a = 0.01, corners[1][3][3] = {{{0, 2, 0}, {a, 2, 0}, {0, 2, a}}};
    struct irb_scene *scene = make_triangles(corners, 1);
    const double up[3] = {0, 1, 0}, aside[3] = {3, 4, 0}, down[3] = {0, -1, 0};
    const double below[3] = {0, 0, 0}, above[3] = {0, 5, 0}, oblique[3] = {-2, 0, 0};
    struct irb_need_light lights[3] = {make_light(below, up, 7), make_light(above, down, 0)};
    REQUIRE_REL(need_sum(scene, lights, 1), 0.5 * a * a / (M_PI * 4), 2e-3);
    REQUIRE_REL(need_sum(scene, lights, 2), 0.5 * a * a / (M_PI * 4), 2e-3);
    lights[1] = make_light(above, down, 1);
    REQUIRE_REL(need_sum(scene, lights, 2), 0.5 * a * a / M_PI * (0.25 + 1 / 9.0) / 2, 2e-3);
    lights[0] = make_light(below, down, 7);
    REQUIRE_NEAR(need_sum(scene, lights, 1), 0, 0);
    lights[0] = make_light(below, aside, 7);
    REQUIRE_REL(need_sum(scene, lights, 1), 0.5 * a * a * 0.8 / (M_PI * 4), 5e-3);
    lights[0] = make_light(oblique, up, 7); /* both cosines 1/sqrt(2), d^2 = 8 */
    REQUIRE_REL(need_sum(scene, lights, 1), 0.5 * a * a * 0.5 / (M_PI * 8), 5e-3);
    scene->objects[0].transform[13] = -1;
    lights[0] = make_light(below, up, 7);
    REQUIRE_REL(need_sum(scene, lights, 1), 0.5 * a * a / M_PI, 2e-3);
    REQUIRE_NEAR(need_sum(scene, lights, 0), 0, 0);
    irb_scene_destroy(scene);
}

/* A rectangle a x b at distance c, a corner above the light: facing it, and upright, half of it
 * below its plane (form factors of differential to finite areas, e.g. Howell's catalogue, B-4 and
 * B-3). */
static void test_rectangles(void **state)
{
    (void)state;
    const double a = 2, b = 3, c = 0.7, origin[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const double facing[2][3][3] = {{{0, c, 0}, {a, c, 0}, {a, c, b}},
                                    {{0, c, 0}, {a, c, b}, {0, c, b}}};
    const double upright[2][3][3] = {{{0, -a, c}, {b, -a, c}, {b, a, c}},
                                     {{0, -a, c}, {b, a, c}, {0, a, c}}};
    const struct irb_need_light light = make_light(origin, up, 1);
    const double A = a / c, B = b / c;
    const double f_facing = (A / sqrt(1 + A * A) * atan(B / sqrt(1 + A * A)) +
                             B / sqrt(1 + B * B) * atan(A / sqrt(1 + B * B))) /
                            (2 * M_PI);
    const double f_upright = (atan(B) - atan(B / sqrt(1 + A * A)) / sqrt(1 + A * A)) / (2 * M_PI);
    struct irb_scene *scene = make_triangles(facing, 2);
    REQUIRE_REL(need_sum(scene, &light, 1), f_facing, 1e-6);
    irb_scene_destroy(scene);
    scene = make_triangles(upright, 2);
    REQUIRE_REL(need_sum(scene, &light, 1), f_upright, 1e-5);
    irb_scene_destroy(scene);
}

/* All around a light the needs sum to 1, wherever it is: in the room, on a wall (whose own
 * triangles get nothing) and off it by rounding, and close to the corner of three. */
static void test_closed(void **state)
{
    (void)state;
    struct irb_scene *scene = fixture_scene("furnace");
    uint64_t random = 3;
    double middle[3], half[3], need[64];
    assert_in_range(scene->triangle_count, 12, 64);
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * ((double)scene->bounds_min[k] + scene->bounds_max[k]);
        half[k] = 0.5 * ((double)scene->bounds_max[k] - scene->bounds_min[k]);
    }
    for (int i = 0; i < 200; i++) {
        double at[3], normal[3];
        for (int k = 0; k < 3; k++) {
            at[k] = middle[k] + 0.98 * half[k] * either(&random);
            normal[k] = either(&random);
        }
        if (i % 4 == 0)
            at[0] = middle[0] - 0.999 * half[0];
        const struct irb_need_light light = make_light(at, normal, 1);
        REQUIRE_NEAR(need_sum(scene, &light, 1), 1, 1e-3);
    }
    for (int i = 0; i < 3; i++) {
        const double off[3] = {0, 1e-7, -1e-7};
        const struct irb_need_light light =
            make_light((const double[3]){middle[0] + 0.3 * half[0], middle[1] - half[1] + off[i],
                                         middle[2] - 0.2 * half[2]},
                       (const double[3]){0, 1, 0}, 1);
        REQUIRE_NEAR(need_sum(scene, &light, 1), 1, 1e-3);
        irb_point_need(scene, &light, 1, need);
        for (uint32_t t = 0; t < scene->triangle_count; t++) {
            bool floor = true;
            for (int c = 0; c < 3; c++)
                floor = floor && scene->positions[3 * scene->indices[3 * t + (uint32_t)c] + 1] ==
                                     scene->bounds_min[1];
            assert_true(floor ? need[t] == 0 : need[t] > 0);
        }
    }
    irb_scene_destroy(scene);
}

/* Sum over 128 x 128 pieces of the folded square. */
static double sum_pieces(const double corners[3][3], const struct irb_need_light *light)
{
    enum { SIDE = 128 };
    double area[3], sum = 0;
    fixture_area_vector(corners, area);
    for (int i = 0; i < SIDE * SIDE; i++) {
        double u = (i / SIDE + 0.5) / SIDE, v = (i % SIDE + 0.5) / SIDE, at[3];
        double d2 = 0, cos_l = 0, facing = 0;
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        fixture_point_on(corners, (const double[3]){1 - u - v, u, v}, at);
        for (int k = 0; k < 3; k++) {
            const double d = at[k] - light->position[k];
            d2 += d * d;
            cos_l += d * light->normal[k];
            facing += d * area[k];
        }
        sum += fmax(cos_l, 0) * fabs(facing) / (M_PI * d2 * d2) / (SIDE * SIDE);
    }
    return sum;
}

/* Any triangles and lights; large and near ones as exact as the pieces, small and far ones within
 * what their being points allows. */
static void test_pieces(void **state)
{
    (void)state;
    uint64_t random = 11;
    for (int i = 0; i < 100; i++) {
        double corners[1][3][3], at[3] = {0, 0, 0}, normal[3];
        const double size = i % 2 ? 1 : 0.15;
        for (int k = 0; k < 9; k++)
            corners[0][k / 3][k % 3] = size * either(&random) + (k % 3 == 1 ? 1.5 : 0);
        for (int k = 0; k < 3; k++)
            normal[k] = either(&random) + (k == 1);
        struct irb_scene *scene = make_triangles((const double(*)[3][3])corners, 1);
        fixture_corners *stored = fixture_place_corners(scene, scene->positions);
        const struct irb_need_light light = make_light(at, normal, 1);
        const double expected = sum_pieces((const double(*)[3])stored[0], &light);
        REQUIRE_NEAR(need_sum(scene, &light, 1), expected, 0.02 * expected + 2e-5);
        free(stored);
        irb_scene_destroy(scene);
    }
}

/* ---- Weights ---- */

static struct irb_buffer *make_lights(const struct irb_need_light *lights, int count)
{
    struct irb_error err = {0};
    struct irb_buffer *buffer =
        irb_buffer_create(gl, "lights", (int64_t)count * (int64_t)sizeof *lights, lights, &err);
    REQUIRE_OK(buffer);
    return buffer;
}

/* A part by need, the rest by area; by area alone without light; every k-th of many lights. */
static void test_weights(void **state)
{
    (void)state;
    enum { LIGHTS = 200, MOST = 64 };
    struct irb_error err = {0};
    struct irb_scene *scene = fixture_scene("cornell");
    struct irb_need_light lights[LIGHTS], some[IRB_NEED_LIGHTS];
    uint64_t random = 5;
    float weights[MOST];
    double need[MOST], areas = 0, needs = 0, unused[3];
    const uint32_t count = scene->triangle_count;
    assert_in_range(count, 1, MOST);
    for (int l = 0; l < LIGHTS; l++) {
        double at[3], normal[3];
        for (int k = 0; k < 3; k++) {
            at[k] =
                0.5 * ((double)scene->bounds_min[k] + scene->bounds_max[k]) + 0.1 * either(&random);
            normal[k] = either(&random);
        }
        lights[l] = make_light(at, normal, l % 3);
    }
    for (int l = 0; l < IRB_NEED_LIGHTS; l++)
        some[l] = lights[l * LIGHTS / IRB_NEED_LIGHTS];
    struct irb_buffer *buffer = make_lights(lights, LIGHTS);
    struct irb_virtual_lights view = {.buffer = buffer, .count = LIGHTS};
    REQUIRE_OK(irb_point_weights(scene, &view, 0.75f, weights, &err));
    irb_point_need(scene, some, IRB_NEED_LIGHTS, need);
    for (uint32_t t = 0; t < count; t++) {
        areas += irb_triangle_size(scene, t, unused);
        needs += need[t];
    }
    for (uint32_t t = 0; t < count; t++)
        REQUIRE_REL(weights[t],
                    0.75 * need[t] / needs + 0.25 * irb_triangle_size(scene, t, unused) / areas,
                    1e-5);
    view.count = 0;
    REQUIRE_OK(irb_point_weights(scene, &view, 0.75f, weights, &err));
    for (uint32_t t = 0; t < count; t++)
        REQUIRE_REL(weights[t], irb_triangle_size(scene, t, unused) / areas, 1e-5);
    irb_buffer_destroy(buffer);
    irb_scene_destroy(scene);
}

/* ---- Points by weights ---- */

static struct irb_point_list generate(const struct irb_scene *scene, const float *weights,
                                      int count, uint64_t seed)
{
    struct irb_error err = {0};
    struct irb_point_list list;
    const struct irb_points_desc desc = {
        .kind = IRB_POINTS_AREA, .count = count, .seed = seed, .weights = weights};
    uint64_t expected;
    REQUIRE_OK(irb_points_count(scene, &desc, &expected, &err));
    REQUIRE_OK(irb_points_generate(scene, &desc, &list, &err));
    REQUIRE_NEAR((double)list.count, (double)expected, 0);
    return list;
}

/* As many on each triangle as its weight (chi^2 within 4.5 standard deviations), none where that is
 * 0, in each of its quarters a fourth; density as expected; the same points again. */
static void test_distribution(void **state)
{
    (void)state;
    enum { COUNT = 200000, MOST = 64 };
    struct irb_scene *scene = fixture_scene("cornell");
    const uint32_t triangles = scene->triangle_count;
    float weights[MOST];
    double found[MOST] = {0}, quarters[4] = {0}, sum = 0, chi2 = 0, chi2_quarters = 0;
    uint64_t random = 9;
    assert_in_range(triangles, 1, MOST);
    for (uint32_t t = 0; t < triangles; t++) {
        weights[t] = t % 5 == 2 ? 0 : (float)(0.05 + fixture_random(&random)) * (t % 3 ? 1 : 20);
        sum += (double)weights[t];
    }
    struct irb_point_list list = generate(scene, weights, COUNT, 5),
                          again = generate(scene, weights, COUNT, 5);
    REQUIRE_NEAR((double)list.count, COUNT, 0);
    assert_memory_equal(list.points, again.points, COUNT * sizeof *list.points);
    for (uint64_t i = 0; i < list.count; i++) {
        const struct irb_point *p = &list.points[i];
        found[p->triangle]++;
        quarters[p->u >= 32768 ? 1 : p->v >= 32768 ? 2 : p->u + p->v < 32768 ? 0 : 3]++;
    }
    int drawn = 0;
    for (uint32_t t = 0; t < triangles; t++) {
        const double expected = COUNT * (double)weights[t] / sum;
        REQUIRE_NEAR(list.density[t], expected, 1e-6 * expected);
        if (!(expected > 0)) {
            REQUIRE_NEAR(found[t], 0, 0);
            continue;
        }
        REQUIRE_CMP(expected, >=, 5);
        chi2 += (found[t] - expected) * (found[t] - expected) / expected;
        drawn++;
    }
    for (int q = 0; q < 4; q++)
        chi2_quarters += pow(quarters[q] - COUNT / 4.0, 2) / (COUNT / 4.0);
    REQUIRE_CMP(fabs(chi2 - (drawn - 1)), <, 4.5 * sqrt(2.0 * (drawn - 1)));
    REQUIRE_CMP(chi2_quarters, <, 3 + 4.5 * sqrt(6.0));
    irb_point_list_destroy(&list);
    irb_point_list_destroy(&again);
    irb_scene_destroy(scene);
}

/* A little more weight on one triangle: its points are those that it had, and some; others lose
 * their last. Without any weight there are no points. */
static void test_coherence(void **state)
{
    (void)state;
    enum { COUNT = 50000, MOST = 64 };
    struct irb_scene *scene = fixture_scene("cornell");
    const uint32_t triangles = scene->triangle_count;
    float weights[MOST] = {0};
    assert_in_range(triangles, 1, MOST);
    struct irb_point_list none = generate(scene, weights, COUNT, 1);
    REQUIRE_NEAR((double)none.count, 0, 0);
    irb_point_list_destroy(&none);
    for (uint32_t t = 0; t < triangles; t++)
        weights[t] = 1;
    struct irb_point_list one = generate(scene, weights, COUNT, 1);
    weights[triangles / 2] = 1.2f;
    struct irb_point_list two = generate(scene, weights, COUNT, 1);
    uint64_t a = 0, b = 0, moved = 0;
    for (uint32_t t = 0; t < triangles; t++) {
        for (; a < one.count && b < two.count && one.points[a].triangle == t &&
               two.points[b].triangle == t;
             a++, b++)
            moved += one.points[a].u != two.points[b].u || one.points[a].v != two.points[b].v;
        while (a < one.count && one.points[a].triangle == t)
            a++;
        while (b < two.count && two.points[b].triangle == t)
            b++;
    }
    REQUIRE_NEAR((double)moved, 0, 0);
    REQUIRE_REL(two.density[triangles / 2], 1.2 * COUNT / (triangles + 0.2), 1e-5);
    irb_point_list_destroy(&one);
    irb_point_list_destroy(&two);
    irb_scene_destroy(scene);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small),     cmocka_unit_test(test_rectangles),
        cmocka_unit_test(test_closed),    cmocka_unit_test(test_pieces),
        cmocka_unit_test(test_weights),   cmocka_unit_test(test_distribution),
        cmocka_unit_test(test_coherence),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
