/* SPDX-License-Identifier: MIT
 *
 * Hierarchical warping against the map that it is to reproduce.
 *
 *     test_pyramid BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "core/lights/pyramid.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

enum { POINTS = 100000 };

struct warped {
    float at[2], given[2];        /* `levels` levels down; the Halton point itself */
    float texel[2], p, unused[1]; /* all the way down */
};

/* Row y of the map is row n-1-y of the image. */
static float *map_at(struct irb_image *map, int x, int y)
{
    return map->data + (size_t)(map->height - 1 - y) * (size_t)map->width + (size_t)x;
}

static double value_at(struct irb_image *map, int x, int y)
{
    double v = *map_at(map, x, y);
    return isfinite(v) && v > 0 ? v : 0;
}

static double total_of(struct irb_image *map)
{
    double total = 0;
    for (int y = 0; y < map->height; y++)
        for (int x = 0; x < map->width; x++)
            total += value_at(map, x, y);
    return total;
}

enum kind { FULL, ZERO_ROWS, ZERO_QUADRANTS, ONE_TEXEL, BLACK, BROKEN, KINDS };

static void make_map(struct irb_image *map, int n, enum kind kind)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_image_create(map, n, n, 1, &err));
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++) {
            double v = 0.02 + pow(0.5 + 0.5 * sin(0.37 * x) * cos(0.23 * y + 1), 3);
            if (kind == ZERO_ROWS && (y % 4 == 1 || y < n / 4))
                v = 0;
            if (kind == ZERO_QUADRANTS && (x < n / 2) == (y < n / 2))
                v = 0;
            if (kind == BLACK || (kind == ONE_TEXEL && (x != n - 1 || y != n - 1)))
                v = 0;
            *map_at(map, x, y) = (float)v;
        }
    if (kind == BROKEN) {
        *map_at(map, 0, 0) = NAN;
        *map_at(map, 1, 0) = INFINITY;
        *map_at(map, 0, 1) = -5;
    }
}

static struct warped *warp(struct irb_image *map, int levels)
{
    struct irb_error err = {0};
    struct warped *out = malloc(POINTS * sizeof *out);
    const struct irb_texture_desc desc = {
        .name = "map", .format = GL_R32F, .width = map->width, .height = map->height};
    struct irb_texture *texture = irb_texture_create(gl, &desc, &err);
    struct irb_pyramid *pyramid = irb_pyramid_create(gl, map->width, &err);
    struct irb_buffer *buffer =
        irb_buffer_create(gl, "warped", POINTS * (int64_t)sizeof *out, NULL, &err);
    struct irb_program *program = irb_program_create(
        gl, &(struct irb_program_desc){.name = "warp", .compute = "test_warp.comp"}, &err);
    REQUIRE_OK(texture && pyramid && buffer && program);
    REQUIRE_OK(irb_texture_write(texture, map, &err));
    REQUIRE_OK(irb_pyramid_build(pyramid, texture, &err));
    irb_program_use(program);
    irb_pyramid_bind(pyramid, program);
    irb_program_uint(program, "count", POINTS);
    irb_program_int(program, "levels", levels);
    gl->api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer->id);
    gl->api.DispatchCompute((POINTS + 63) / 64, 1, 1);
    REQUIRE_OK(irb_buffer_read(buffer, 0, POINTS * (int64_t)sizeof *out, out, &err));
    irb_program_destroy(program);
    irb_buffer_destroy(buffer);
    irb_pyramid_destroy(pyramid);
    irb_texture_destroy(texture);
    return out;
}

/* chi^2 of the counts against what is expected of a distribution on n x n cells. Nothing may fall
 * where nothing is expected. Halton points are more even than random ones, so the statistic must
 * not exceed its mean by 5 standard deviations. */
static void check_counts(const double *expected, const double *found, int n, const char *what)
{
    double chi2 = 0;
    int degrees = -1;
    for (int i = 0; i < n * n; i++) {
        if (expected[i] == 0)
            REQUIRE_NEAR(found[i], 0, 0);
        if (expected[i] < 5)
            continue;
        chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
        degrees++;
    }
    print_message("%s, %d: chi^2 %.1f at %d degrees of freedom\n", what, n, chi2, degrees);
    REQUIRE_CMP(chi2, <, degrees + 5 * sqrt(2.0 * (degrees > 0 ? degrees : 1)));
}

/* All the way down: texels are hit in proportion to the map, with the probability that is given. */
static void check_texels(struct irb_image *map, const struct warped *w, const char *what)
{
    const int n = map->width;
    const double total = total_of(map);
    double *expected = calloc((size_t)(n * n), sizeof *expected);
    double *found = calloc((size_t)(n * n), sizeof *found);
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++)
            expected[y * n + x] = POINTS * value_at(map, x, y) / total;
    for (int i = 0; i < POINTS; i++) {
        int x = (int)w[i].texel[0], y = (int)w[i].texel[1];
        assert_true(x >= 0 && x < n && y >= 0 && y < n);
        REQUIRE_REL(w[i].p, value_at(map, x, y) / total, 1e-5);
        found[y * n + x]++;
    }
    check_counts(expected, found, n, what);
    free(expected);
    free(found);
}

/* `levels` levels down: nodes are hit in proportion to their sums, and the points lie evenly in
 * each node's part of the map, here counted in its quarters. */
static void check_levels(struct irb_image *map, const struct warped *w, int levels,
                         const char *what)
{
    const int n = map->width;
    int side = 1;
    while (side < n)
        side *= 2;
    const int node = side >> levels, cells = 2 * (side / node);
    const double total = total_of(map);
    double *expected = calloc((size_t)(cells * cells), sizeof *expected);
    double *found = calloc((size_t)(cells * cells), sizeof *found);
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++)
            for (int q = 0; q < 4; q++)
                expected[(y / node * 2 + q / 2) * cells + x / node * 2 + q % 2] +=
                    POINTS / 4.0 * value_at(map, x, y) / total;
    for (int i = 0; i < POINTS; i++) {
        double place[2];
        int cell[2];
        for (int k = 0; k < 2; k++) {
            assert_true(w[i].at[k] >= 0 && w[i].at[k] < 1);
            double texel = (double)w[i].at[k] * n;
            int corner = (int)texel / node * node;
            int extent = corner + node < n ? node : n - corner;
            place[k] = (texel - corner) / extent;
            cell[k] = corner / node * 2 + (place[k] >= 0.5);
        }
        found[cell[1] * cells + cell[0]]++;
    }
    check_counts(expected, found, cells, what);
    free(expected);
    free(found);
}

static void test_distribution(void **state)
{
    (void)state;
    static const char *const names[] = {"full",      "zero rows", "zero quadrants",
                                        "one texel", "",          "broken"};
    const int sides[] = {64, 48};
    for (int k = 0; k < 2; k++)
        for (int kind = 0; kind < KINDS; kind++) {
            if (kind == BLACK)
                continue;
            struct irb_image map;
            make_map(&map, sides[k], (enum kind)kind);
            for (int levels = 1; levels < 6; levels += 2) {
                struct warped *w = warp(&map, levels);
                if (levels == 1)
                    check_texels(&map, w, names[kind]);
                check_levels(&map, w, levels, names[kind]);
                free(w);
            }
            irb_image_destroy(&map);
        }
}

/* A map of zeros: probability 0, and the points stay where they are. So they do without levels, but
 * for the margin at the border. */
static void test_black(void **state)
{
    (void)state;
    const int sides[] = {1, 7, 64};
    for (int k = 0; k < 6; k++) {
        struct irb_image map;
        make_map(&map, sides[k % 3], k < 3 ? BLACK : FULL);
        struct warped *w = warp(&map, k < 3 ? 3 : 0);
        for (int i = 0; i < POINTS; i++) {
            if (k < 3)
                REQUIRE_NEAR(w[i].p, 0, 0);
            for (int c = 0; c < 2; c++)
                REQUIRE_NEAR(w[i].at[c], w[i].given[c], k < 3 ? 0 : 1.0 / 512 / map.width + 1e-6);
        }
        free(w);
        irb_image_destroy(&map);
    }
}

/* Beyond the depth there is, the point lies in its texel; values near the largest float do not
 * overflow the sums. */
static void test_depth_and_range(void **state)
{
    (void)state;
    const float scales[] = {1, 3e38f, 1e-30f};
    for (int k = 0; k < 3; k++) {
        struct irb_image map;
        make_map(&map, 33, ZERO_QUADRANTS);
        for (size_t i = 0; i < irb_image_pixels(&map); i++)
            map.data[i] *= scales[k] / 1.1f;
        struct warped *w = warp(&map, 40);
        for (int i = 0; i < POINTS; i++) {
            REQUIRE_CMP(w[i].p, >, 0);
            for (int c = 0; c < 2; c++)
                REQUIRE_NEAR((int)(w[i].at[c] * 33), w[i].texel[c], 0);
        }
        free(w);
        irb_image_destroy(&map);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    assert_null(irb_pyramid_create(gl, 40000, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    REQUIRE_CONTAINS(err.message, "smaller RSM");
    struct irb_pyramid *pyramid = irb_pyramid_create(gl, 8, &err);
    struct irb_rsm *rsm = irb_rsm_create(gl, 9, &err);
    REQUIRE_OK(pyramid && rsm);
    assert_false(irb_pyramid_build_flux(pyramid, rsm, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    irb_rsm_destroy(rsm);
    irb_pyramid_destroy(pyramid);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distribution),
        cmocka_unit_test(test_black),
        cmocka_unit_test(test_depth_and_range),
        cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
