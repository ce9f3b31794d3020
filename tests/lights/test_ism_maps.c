/* SPDX-License-Identifier: MIT
 *
 * What imperfect shadow maps hold in the end: pull-push and coverage against plain loops, distances
 * in a closed box against closed forms.
 *
 *     test_ism_maps BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "tests/lights/ism_world.h"

static struct irb_gl *gl;

static const float grey[3] = {0.5f, 0.5f, 0.5f};

/* ---- Pull-push and coverage ---- */

static int compare_floats(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static float plain_pull(float v[4], int pull)
{
    int valid = 0;
    double sum = 0, count = 0;
    qsort(v, 4, sizeof *v, compare_floats); /* INFINITY comes last */
    while (valid < 4 && isfinite(v[valid]))
        valid++;
    if (!valid)
        return INFINITY;
    if (pull == IRB_ISM_MEDIAN)
        return v[(valid - 1) / 2];
    for (int i = 0; i < valid; i++)
        if ((double)v[i] <= 1.1 * (double)v[0]) {
            sum += (double)v[i];
            count++;
        }
    return (float)(sum / count);
}

/* Bilinear between the centres of the parent's level, within the map. */
static float plain_push(const float *coarse, int size, int x, int y, int pull)
{
    const float own = coarse[y / 2 * size + x / 2];
    double sum = 0, total = 0;
    if (pull == IRB_ISM_MEDIAN || !isfinite(own))
        return own;
    for (int k = 0; k < 4; k++) {
        double u = (x + 0.5) / 2 - 0.5, v = (y + 0.5) / 2 - 0.5;
        int column = (int)floor(u) + k % 2, row = (int)floor(v) + k / 2;
        double weight = (1 - fabs(u - column)) * (1 - fabs(v - row));
        column = column < 0 ? 0 : column >= size ? size - 1 : column;
        row = row < 0 ? 0 : row >= size ? size - 1 : row;
        float value = coarse[row * size + column];
        if (!isfinite(value) || fabs((double)value - (double)own) > 0.1 * (double)own)
            continue;
        sum += weight * (double)value;
        total += weight;
    }
    return (float)(sum / total);
}

static void plain_pull_push(float *map, int size, int levels, int pull)
{
    if (!levels)
        return;
    const int half = size / 2;
    float *coarse = malloc((size_t)(half * half) * sizeof *coarse);
    for (int y = 0; y < half; y++)
        for (int x = 0; x < half; x++) {
            const float *child = map + 2 * y * size + 2 * x;
            coarse[y * half + x] =
                plain_pull((float[]){child[0], child[1], child[size], child[size + 1]}, pull);
        }
    plain_pull_push(coarse, half, levels - 1, pull);
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            if (!isfinite(map[y * size + x]))
                map[y * size + x] = plain_push(coarse, half, x, y, pull);
    free(coarse);
}

static void test_pull_push(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    create_cornell(&w, gl, 27);
    settings.splat_factor = 0.3f; /* sparse */
    const int levels[] = {0, 1, 2, 6};
    for (int pull = 0; pull < 2; pull++)
        for (int k = 0; k < 4; k++) {
            settings.pull = pull;
            settings.pull_push = levels[k];
            struct fixture_maps expected = splat(&w, &settings);
            REQUIRE_OK(irb_ism_pull_push(w.ism, &settings, &err));
            struct fixture_maps found = fixture_maps_read(w.ism);
            for (int map = 0; map < w.view.count; map++)
                plain_pull_push(expected.distance + fixture_map_texel(&expected, map, 0, 0), SIZE,
                                levels[k], pull);
            if (pull == IRB_ISM_MEDIAN)
                require_equal(&found, &expected);
            else /* rounding may tip a distance over the 10 %: none does here */
                fixture_require_maps(&found, &expected, 0, 0);
            fixture_maps_destroy(&found);
            fixture_maps_destroy(&expected);
        }
    destroy_world(&w);
}

static void test_coverage(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    struct irb_ism_settings settings = default_settings();
    create_cornell(&w, gl, 27);
    for (int l = 0; l < 27; l += 5)
        memset(w.lights[l].flux, 0, sizeof w.lights[l].flux);
    replace_lights(&w, 27);
    for (int levels = 0; levels < 4; levels++) {
        double share;
        long inside = 0, filled = 0;
        settings.pull_push = levels;
        REQUIRE_OK(irb_ism_build(w.ism, w.scene_gl, w.points, &w.view, &settings, &err));
        REQUIRE_OK(irb_ism_coverage(w.ism, &share, &err));
        struct fixture_maps found = fixture_maps_read(w.ism);
        for (int map = 0; map < 27; map++)
            for (int i = 0; i < SIZE * SIZE; i++) {
                double x = (i % SIZE + 0.5) / (SIZE / 2.0) - 1,
                       y = (i / SIZE + 0.5) / (SIZE / 2.0) - 1;
                if (map % 5 == 0 || x * x + y * y > 1)
                    continue;
                inside++;
                filled +=
                    isfinite(found.distance[fixture_map_texel(&found, map, 0, 0) + (size_t)i]);
            }
        REQUIRE_NEAR(share, (double)filled / (double)inside, 1e-15);
        assert_true(filled > 0 && filled < inside);
        fixture_maps_destroy(&found);
    }
    destroy_world(&w);
}

/* ---- A closed box ---- */

static struct irb_scene *make_box(void)
{
    struct irb_error err = {0};
    struct irb_builder builder;
    irb_builder_begin(&builder, "box");
    irb_builder_object(&builder, "box", irb_builder_material(&builder, "grey", grey));
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double corners[4][3];
            for (int i = 0; i < 4; i++) {
                corners[i][axis] = side;
                corners[i][(axis + 1) % 3] = i == 1 || i == 2;
                corners[i][(axis + 2) % 3] = i >= 2;
            }
            irb_builder_quad(&builder, (const double(*)[3])corners);
        }
    struct irb_scene *scene = irb_builder_finish(&builder, &err);
    REQUIRE_OK(scene);
    return scene;
}

/* On the sides, at least 0.15 m from their edges: nearer, a texel may hold all distances from none
 * to the width of the box. */
static void place_wall_lights(struct world *w, int count)
{
    uint64_t random = 17;
    memset(w->lights, 0, sizeof w->lights);
    for (int l = 0; l < count; l++) {
        struct fixture_light *light = &w->lights[l];
        for (int k = 0; k < 3; k++) {
            light->position[k] = (float)(0.15 + 0.7 * fixture_random(&random));
            light->flux[k] = 1;
        }
        light->position[l % 3] = (float)(l / 3 % 2);
        light->normal[l % 3] = l / 3 % 2 ? -1 : 1;
    }
    replace_lights(w, count);
}

/* From the light, along the direction that a texel's centre stands for, to the box's side. */
static double box_distance(const struct fixture_light *light, double x, double y)
{
    double frame[3][3], nearest = INFINITY, r2 = x * x + y * y;
    const double local[3] = {2 * x / (1 + r2), 2 * y / (1 + r2), (1 - r2) / (1 + r2)};
    fixture_light_frame(light->normal, frame);
    for (int k = 0; k < 3; k++) {
        double d = frame[0][k] * local[0] + frame[1][k] * local[1] + frame[2][k] * local[2];
        double to = d > 0 ? 1 - light->position[k] : -light->position[k];
        if (fabs(d) > 1e-9 && to / d > 1e-6)
            nearest = fmin(nearest, to / d);
    }
    return nearest;
}

/* A splat of one texel holds the distance of a surface point that projects into the texel: between
 * the least and the greatest over it, and 2 % for what lies between the samples. */
static void require_in_texel(const struct fixture_light *light, double x, double y, double found)
{
    enum { STEPS = 8 };
    const double half = 1.0 / SIZE;
    double least = INFINITY, most = 0;
    for (int i = 0; i < (STEPS + 1) * (STEPS + 1); i++) {
        double u = x + half * (2.0 * (i % (STEPS + 1)) / STEPS - 1),
               v = y + half * (2.0 * (i / (STEPS + 1)) / STEPS - 1), r = hypot(u, v);
        if (r > 0.9995) { /* the horizon that is left out */
            u *= 0.9995 / r;
            v *= 0.9995 / r;
        }
        least = fmin(least, box_distance(light, u, v));
        most = fmax(most, box_distance(light, u, v));
    }
    REQUIRE_CMP(found, >=, 0.98 * least);
    REQUIRE_CMP(found, <=, 1.02 * most);
}

/* 16,000 random points a map of 64 x 64 texels, or 1200 of the tessellator, f[64,64]. Coverage, and
 * mean relative
 * error of the distance in the direction of the texel's centre: as measured, 2 % down and 10 % up.
 * Over a texel of this size the distance changes by a few percent, and a splat has only one. */
static const struct {
    const char *what;
    int splatter, most, pull_push, pull;
    double coverage, error;
} box_runs[] = {
    {"1 texel", IRB_ISM_ATOMIC, 1, 0, 0, 0.71, 0.0172},
    {"5 texels", IRB_ISM_ATOMIC, 5, 0, 0, 0.79, 0.0169},
    {"5 texels, 2 levels, median", IRB_ISM_ATOMIC, 5, 2, IRB_ISM_MEDIAN, 0.985, 0.0187},
    {"5 texels, 2 levels, mean", IRB_ISM_ATOMIC, 5, 2, IRB_ISM_MEAN, 0.985, 0.0165},
    {"tessellation, 1 texel", IRB_ISM_TESSELLATION, 1, 0, 0, 0.235, 0.0172},
    {"tessellation, 5 texels", IRB_ISM_TESSELLATION, 5, 0, 0, 0.66, 0.0264},
    {"tessellation, 5 texels, 2 levels", IRB_ISM_TESSELLATION, 5, 2, IRB_ISM_MEDIAN, 0.93, 0.0347},
};

static double mean_box_error(const struct world *w, bool one_texel)
{
    struct fixture_maps found = fixture_maps_read(w->ism);
    double sum = 0;
    long count = 0;
    for (size_t i = 0; i < fixture_map_texel(&found, w->view.count, 0, 0); i++) {
        const struct fixture_light *light = &w->lights[i / SIZE / SIZE];
        double x = ((double)(i % SIZE) + 0.5) / (SIZE / 2.0) - 1,
               y = ((double)(i / SIZE % SIZE) + 0.5) / (SIZE / 2.0) - 1;
        if (x * x + y * y > 1 || !isfinite(found.distance[i]))
            continue;
        if (one_texel)
            require_in_texel(light, x, y, found.distance[i]);
        sum += fabs(found.distance[i] / box_distance(light, x, y) - 1);
        count++;
    }
    fixture_maps_destroy(&found);
    return sum / (double)count;
}

static void test_box(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct world w = {0};
    create_world(&w, gl, make_box(),
                 (struct irb_points_desc){.kind = IRB_POINTS_AREA, .count = 500000, .seed = 1}, 32);
    place_wall_lights(&w, 32);
    for (size_t k = 0; k < sizeof box_runs / sizeof *box_runs; k++) {
        const bool dynamic = box_runs[k].splatter == IRB_ISM_TESSELLATION;
        struct irb_ism_settings settings = default_settings();
        settings.splatter = box_runs[k].splatter;
        settings.splat_most = box_runs[k].most;
        settings.pull_push = box_runs[k].pull_push;
        settings.pull = box_runs[k].pull;
        settings.f_min = settings.f_max = 64;
        settings.near = 0;
        double share;
        REQUIRE_OK(
            irb_ism_build(w.ism, w.scene_gl, dynamic ? NULL : w.points, &w.view, &settings, &err));
        REQUIRE_OK(irb_ism_coverage(w.ism, &share, &err));
        const double error = mean_box_error(&w, settings.splat_most == 1);
        print_message("%s: covered %.3f, mean error %.4f\n", box_runs[k].what, share, error);
        REQUIRE_CMP(share, >=, box_runs[k].coverage);
        REQUIRE_CMP(error, <=, box_runs[k].error);
    }
    destroy_world(&w);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pull_push),
        cmocka_unit_test(test_coverage),
        cmocka_unit_test(test_box),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
