/* SPDX-License-Identifier: MIT
 *
 * Convolution soft shadow maps: the series against its closed-form bounds, blockers against a
 * search over the map, soft shadows against the area of the light that is seen.
 *
 *     test_csm BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "tests/lights/csm_fixture.h"
#include "tests/support/lens.h"

static struct irb_gl *gl;

static const int orders[] = {1, 2, 3, 4, 8, 16};
enum { ORDERS = sizeof orders / sizeof *orders, SIZE = 16 };

/* 0 to 2 m, 256 different ones, in no order. */
static double scattered(const void *user, int map, int face, int x, int y, const double d[3])
{
    (void)user, (void)map, (void)face, (void)d;
    return 2.0 * ((SIZE * y + x) * 37 % (SIZE * SIZE)) / (SIZE * SIZE - 1);
}

/* The direction of a paraboloid's texel, the corners' too. */
static void texel_direction(int size, int x, int y, float out[3])
{
    double u = (2 * x + 1.0) / size - 1, v = (2 * y + 1.0) / size - 1, r2 = u * u + v * v;
    out[0] = (float)(2 * u / (1 + r2));
    out[1] = (float)(2 * v / (1 + r2));
    out[2] = (float)((1 - r2) / (1 + r2));
}

/* Texels well inside the unit disc, against receivers at 32 depths. |f - H(z - d)| is at most
 * 2/(pi (2M + 1) sin(pi |z - d|)) by Abel summation of the series's rest, and never more than 1/2;
 * f(z, z) = 1/2. Printed: the largest error where the depths are a tenth of the range apart. */
static void test_step(void **state)
{
    (void)state;
    struct csm_fixture f;
    enum { DEPTHS = 32 };
    struct csm_query queries[SIZE * SIZE * DEPTHS];
    csm_create(&f, gl, IRB_RASTER_PARABOLOID, SIZE, 1, scattered, NULL);
    for (int m = 0; m < ORDERS; m++)
        for (int prefilter = 0; prefilter < 2; prefilter++) {
            csm_make(&f, orders[m], (enum irb_csm_prefilter)prefilter);
            const double span = f.csm->span;
            double z_of[SIZE * SIZE * DEPTHS], largest = 0;
            int count = 0;
            for (int y = 3; y < SIZE - 3; y++)
                for (int x = 3; x < SIZE - 3; x++)
                    for (int i = 0; i < DEPTHS; i++) {
                        struct csm_query *q = &queries[count];
                        *q = (struct csm_query){.kind = CSM_LIT, .side = 1};
                        texel_direction(SIZE, x, y, q->q);
                        z_of[count] = scattered(NULL, 0, 0, x, y, NULL) / 2 * span;
                        q->z = (float)(i ? span * i / (DEPTHS - 1) : z_of[count]);
                        count++;
                    }
            float *found = csm_ask(&f, queries, count);
            for (int i = 0; i < count; i++) {
                const double t = z_of[i] - queries[i].z, error = fabs(found[i] - (t > 0 ? 1 : 0));
                /* tables: sums of up to 256 values of at most 1 in float32 */
                const double rounding = prefilter == IRB_CSM_SAT ? 1e-4 : 1e-5;
                if (fabs(t) < 1e-6) {
                    REQUIRE_NEAR(found[i], 0.5, 4 * orders[m] * fabs(t) + rounding);
                    continue;
                }
                double bound = 2 / (M_PI * (2 * orders[m] + 1) * sin(M_PI * fabs(t)));
                REQUIRE_CMP(error, <=, fmin(bound, 0.5) + rounding);
                if (fabs(t) >= 0.1)
                    largest = fmax(largest, error);
            }
            free(found);
            print_message("M = %2d, %s: |f - H| <= %.3f from 0.1 on\n", orders[m],
                          irb_csm_prefilter_names[prefilter], largest);
        }
    csm_destroy(&f);
}

/* Mean square over a period of what the damped series leaves of the step, by Parseval's theorem:
 * its orders k have the amplitudes 2/c_k exp(-damping (k/M)^2), the step's own 2/c_k. */
static double series_rest(int order, double damping)
{
    double rest = 0.25;
    for (int k = 1; k <= order; k++) {
        const double whole = 2 / (M_PI * (2 * k - 1));
        const double kept = whole * exp(-damping * k * k / order / order);
        rest += kept * kept / 2 - whole * kept;
    }
    return rest;
}

static double metre(const void *user, int map, int face, int x, int y, const double d[3])
{
    (void)user, (void)map, (void)face, (void)x, (void)y, (void)d;
    return 1;
}

/* What order M leaves of the step over one period of z - d: the root mean square as Parseval has
 * it; the overshoot, 0.1366 of M = 1 and the Wilbraham-Gibbs constant 0.0895 in the limit; the
 * width from 0.1 to 0.9, where Si(2 pi M t) = 0.4 pi: 0.443/M. Damping takes the overshoot away and
 * makes the step wider. */
static void test_series(void **state)
{
    (void)state;
    enum { STEPS = 2048 };
    static struct csm_query queries[STEPS];
    struct csm_fixture f;
    double over[17][2] = {{0}}, width[17][2] = {{0}};
    csm_create(&f, gl, IRB_RASTER_PARABOLOID, SIZE, 1, metre, NULL);
    for (int damped = 0; damped < 2; damped++)
        for (int m = 0; m < ORDERS; m++) {
            const int order = orders[m];
            double square = 0;
            f.settings.damping = (float)damped;
            csm_make(&f, order, IRB_CSM_MIP);
            for (int i = 0; i < STEPS; i++) {
                const double t = (i + 0.5) / STEPS - 0.5;
                queries[i] = (struct csm_query){
                    .q = {0, 0, 1}, .kind = CSM_LIT, .side = 1, .z = (float)(f.csm->span - t)};
            }
            float *found = csm_ask(&f, queries, STEPS);
            for (int i = 0; i < STEPS; i++) {
                const double error = found[i] - (i >= STEPS / 2);
                square += error * error / STEPS;
                over[order][damped] = fmax(over[order][damped], found[i] - 1);
                width[order][damped] += (found[i] > 0.1 && found[i] < 0.9) / (double)STEPS;
            }
            free(found);
            print_message("M = %2d, damping %d: rms %.3f (Parseval %.3f), overshoot %.4f, "
                          "10-90 %% %.4f\n",
                          order, damped, sqrt(square), sqrt(series_rest(order, damped)),
                          over[order][damped], width[order][damped]);
            REQUIRE_NEAR(sqrt(square), sqrt(series_rest(order, damped)), 1e-3);
        }
    REQUIRE_NEAR(over[1][0], 2 / M_PI - 0.5, 1e-3);
    REQUIRE_NEAR(over[16][0], 0.0895, 1e-3);
    for (int m = 0; m < ORDERS; m++) {
        const int order = orders[m];
        REQUIRE_CMP(over[order][1], <, over[order][0] / 4);
        REQUIRE_CMP(width[order][1], >, width[order][0]);
        if (order >= 4)
            REQUIRE_NEAR(width[order][0], 0.443 / order, 2.0 / STEPS + 0.005 / order);
    }
    csm_destroy(&f);
}

/* Offset and scale (Annen et al. 2007): a lit surface reads 1, not 1/2, by either. */
static void test_lit_surface(void **state)
{
    (void)state;
    struct csm_fixture f;
    struct csm_query queries[100];
    csm_create(&f, gl, IRB_RASTER_PARABOLOID, SIZE, 1, scattered, NULL);
    for (int by_scale = 0; by_scale < 2; by_scale++)
        for (int m = 0; m < ORDERS; m++) {
            f.settings = csm_plain;
            f.settings.scale = by_scale ? 2 : 1;
            f.settings.offset = by_scale ? 0 : 1;
            csm_make(&f, orders[m], IRB_CSM_MIP);
            int count = 0;
            for (int y = 3; y < SIZE - 3; y++)
                for (int x = 3; x < SIZE - 3; x++) {
                    struct csm_query *q = &queries[count++];
                    *q = (struct csm_query){.kind = CSM_VISIBILITY};
                    texel_direction(SIZE, x, y, q->q);
                    for (int i = 0; i < 3; i++)
                        q->q[i] *= (float)fmax(scattered(NULL, 0, 0, x, y, NULL), 1e-6);
                }
            float *found = csm_ask(&f, queries, count);
            for (int i = 0; i < count; i++)
                REQUIRE_NEAR(found[i], 1, 1e-4);
            free(found);
        }
    csm_destroy(&f);
}

/* The left half of the map at 0.6 m, the right one at 1.6 m, one texel at 2 m, which sets the
 * range.
 */
static double halves(const void *user, int map, int face, int x, int y, const double d[3])
{
    (void)user, (void)map, (void)face, (void)d;
    return x + y == 0 ? 2 : x < SIZE / 2 ? 0.6 : 1.6;
}

/* Mean depth of what is nearer than 1.6 m over footprints that hold a share c of it. The receiver's
 * own surface weighs -g at most, g the overshoot of the series, and the blocker w, 1 - g at least
 * (1/2 within the step): z_avg is off by (1 - c) g (1.6 - 0.6) / (c w - (1 - c) g) at most. Where
 * all is blocker it is exact, whatever f is there, which takes the prefiltered z. */
static void test_blocker(void **state)
{
    (void)state;
    struct csm_fixture f;
    csm_create(&f, gl, IRB_RASTER_PARABOLOID, SIZE, 1, halves, NULL);
    f.settings.search_offset = 0.613f;
    for (int m = 1; m < ORDERS; m++) {
        /* tables take any box; mipmaps have this one: the four texels round the centre */
        csm_make(&f, orders[m], IRB_CSM_SAT);
        const double unit = f.csm->span / 2, gibbs = 0.1366; /* of M = 1; less for others */
        /* M = 2: the depths are less than the whole step apart */
        const double weight = (1.6 - 0.6) * unit < 1.0 / orders[m] ? 0.5 : 1 - gibbs;
        struct csm_query queries[8];
        for (int i = 0; i < 8; i++) {
            queries[i] =
                (struct csm_query){.kind = CSM_BLOCKER, .side = 8, .z = (float)(1.6 * unit)};
            texel_direction(2 * SIZE, SIZE + i - 4, SIZE, queries[i].q); /* half texels */
        }
        float *found = csm_ask(&f, queries, 8);
        for (int i = 0; i < 8; i++) {
            /* half texel SIZE + i - 4 has its centre at (SIZE + i - 3.5)/2 texels */
            double c = (SIZE / 2 - (SIZE + i - 3.5) / 2 + 4) / 8, depth = found[i] / unit;
            double bound = (1 - c) * gibbs / (c * weight - (1 - c) * gibbs);
            if (i == 0 || i == 7)
                print_message("M = %2d, %2.0f %% blocker: z_avg %.4f m, search 0.6 m\n", orders[m],
                              100 * c, depth);
            REQUIRE_NEAR(depth, 0.6, fmin(bound + 2e-3, 0.02));
        }
        free(found);
        struct csm_query all = {.kind = CSM_BLOCKER, .side = 4, .z = (float)(1.6 * unit)};
        texel_direction(SIZE, 4, SIZE / 2, all.q);
        for (int prefilter = 0; prefilter < 2; prefilter++) {
            csm_make(&f, orders[m], (enum irb_csm_prefilter)prefilter);
            found = csm_ask(&f, &all, 1);
            REQUIRE_NEAR(found[0] / unit, 0.6, 2e-3);
            free(found);
        }
    }
    csm_destroy(&f);
}

/* Half of the texels anywhere from 0.3 to 0.9 m, the others at 1.8 m. */
static double speckled(const void *user, int map, int face, int x, int y, const double d[3])
{
    (void)user, (void)map, (void)face, (void)d;
    const int scattered_number = (SIZE * y + x) * 37 % (SIZE * SIZE);
    return scattered_number % 2 ? 1.8 : 0.3 + 0.6 * scattered_number / (SIZE * SIZE);
}

/* z_avg over boxes of whole texels against a search through them. Blockers weigh 1 - g to 1 + g,
 * the receiver's surface -g to g, so that the mean is off by g (spread of the blockers + (1 - c)/c
 * (1.8 - mean)) / (1 - g - g (1 - c)/c) at most. The trilinear look-up has other weights: it is
 * printed. */
static void test_blocker_search(void **state)
{
    (void)state;
    enum { BOXES = 8, SIDE = 8 };
    struct csm_fixture f;
    csm_create(&f, gl, IRB_RASTER_PARABOLOID, SIZE, 1, speckled, NULL);
    f.settings.search_offset = 0.613f;
    for (int order = 4; order <= 16; order *= 2)
        for (int prefilter = 0; prefilter < 2; prefilter++) {
            struct csm_query queries[BOXES];
            double mean[BOXES], share[BOXES], worst = 0;
            csm_make(&f, order, (enum irb_csm_prefilter)prefilter);
            for (int i = 0; i < BOXES; i++) {
                int blockers = 0;
                mean[i] = 0;
                for (int y = 4; y < 4 + SIDE; y++)
                    for (int x = i; x < i + SIDE; x++) {
                        const double z = speckled(NULL, 0, 0, x, y, NULL);
                        mean[i] += z < 1.8 ? z : 0;
                        blockers += z < 1.8;
                    }
                mean[i] /= blockers;
                share[i] = (double)blockers / (SIDE * SIDE);
                queries[i] =
                    (struct csm_query){.kind = CSM_BLOCKER, .side = SIDE, .z = (float)f.csm->span};
                const double u = 2.0 * (i + SIDE / 2) / SIZE - 1;
                queries[i].q[0] = (float)(2 * u / (1 + u * u));
                queries[i].q[2] = (float)((1 - u * u) / (1 + u * u));
            }
            float *found = csm_ask(&f, queries, BOXES);
            for (int i = 0; i < BOXES; i++) {
                /* g: of M = 2 */
                const double depth = found[i] * f.range[0] / f.csm->span, g = 0.1002;
                const double rest = (1 - share[i]) / share[i];
                const double bound = g * (0.6 + rest * (1.8 - mean[i])) / (1 - g - g * rest);
                worst = fmax(worst, fabs(depth - mean[i]));
                if (prefilter == IRB_CSM_SAT)
                    REQUIRE_NEAR(depth, mean[i], bound);
            }
            free(found);
            print_message("M = %2d, %s: z_avg within %.3f m of the search's %.2f m\n", order,
                          irb_csm_prefilter_names[prefilter], worst, mean[0]);
            REQUIRE_CMP(worst, <, 0.02);
        }
    csm_destroy(&f);
}

/* A disc of radius `radius` at height `height` above the light, before a plane at 2 m. */
struct stage {
    double radius, height;
};
static const double plane = 2, light_radius = 0.4;

static double stage_distance(const void *user, int map, int face, int x, int y, const double d[3])
{
    const struct stage *s = user;
    (void)map, (void)face, (void)x, (void)y;
    if (!d || d[2] < 0.3) /* the plane ends */
        return INFINITY;
    double h = s->height, r = hypot(d[0], d[1]) / d[2] * h;
    return (r < s->radius ? h : plane) / d[2];
}

/* Share of the light seen from x on the plane: the disc, projected onto the light's plane through
 * the receiver, has the radius r H/(H - h) and its centre at x h/(H - h). */
static double seen(const struct stage *s, double x)
{
    double k = plane - s->height;
    double hidden = lens(light_radius, s->radius * plane / k, x * s->height / k);
    return 1 - hidden / (M_PI * light_radius * light_radius);
}

struct stage_error {
    double rms, worst, leak, ringing; /* leak: most of what should be 0; ringing: least of 1 */
};

static struct stage_error measure_stage(const struct csm_fixture *f, const struct stage *s)
{
    enum { POINTS = 60 };
    struct csm_query queries[POINTS];
    struct stage_error e = {.ringing = 1};
    for (int i = 0; i < POINTS; i++) {
        const double x = 0.05 * i, angle = 2.4 * i;
        queries[i] = (struct csm_query){
            .q = {(float)(x * cos(angle)), (float)(x * sin(angle)), (float)plane},
            .radius = (float)light_radius,
            .kind = CSM_VISIBILITY};
    }
    float *found = csm_ask(f, queries, POINTS);
    for (int i = 0; i < POINTS; i++) {
        double truth = seen(s, 0.05 * i), error = fabs(found[i] - truth);
        e.rms += error * error / POINTS;
        e.worst = fmax(e.worst, error);
        if (truth == 0)
            e.leak = fmax(e.leak, found[i]);
        if (truth == 1)
            e.ringing = fmin(e.ringing, found[i]);
    }
    free(found);
    e.rms = sqrt(e.rms);
    return e;
}

/* Annen et al.'s scale, for low orders; no scale, but an offset and a search that finds what is
 * near the light, for high ones; and those damped. */
enum { SCALED, OFFSET, DAMPED, VARIANTS, STAGES = 4 };
static const struct irb_csm_settings variants[VARIANTS] = {
    {.offset = 0, .scale = 2, .search_offset = 0.613f, .search_scale = 1, .penumbra_scale = 1},
    {.offset = 1, .scale = 1, .search_offset = 0.613f, .search_scale = 3, .penumbra_scale = 1},
    {.offset = 1,
     .scale = 1,
     .search_offset = 0.613f,
     .damping = 1,
     .search_scale = 3,
     .penumbra_scale = 1},
};
static const char *const variant_names[VARIANTS] = {"scaled", "offset", "damped"};
/* Near the light, in the middle, near the plane: a contact shadow; and one without umbra. */
static const struct stage stages[STAGES] = {{0.5, 0.5}, {0.5, 1}, {0.5, 1.6}, {0.15, 1}};

/* Errors of all stages as one line; the fixture has the order and the prefilter. */
static void measure(struct csm_fixture *f, int variant, struct stage_error e[STAGES])
{
    f->settings = variants[variant];
    for (int s = 0; s < STAGES; s++) {
        csm_fill(f, stage_distance, &stages[s]);
        csm_update(f);
        e[s] = measure_stage(f, &stages[s]);
    }
    print_message("%-10s %s %s M %2d: rms %.3f %.3f %.3f %.3f, worst %.3f, leak %.3f %.3f %.3f, "
                  "lit >= %.3f\n",
                  irb_raster_projection_names[f->csm->projection], variant_names[variant],
                  irb_csm_prefilter_names[f->csm->prefilter], f->csm->order, e[0].rms, e[1].rms,
                  e[2].rms, e[3].rms,
                  fmax(fmax(e[0].worst, e[1].worst), fmax(e[2].worst, e[3].worst)), e[0].leak,
                  e[1].leak, e[2].leak,
                  fmin(fmin(e[0].ringing, e[1].ringing), fmin(e[2].ringing, e[3].ringing)));
}

/* Against the exact area. The plane ends 6.7 m from the light, where its map's range does: of it,
 * the step takes 0.9 m to either side at M = 4, and the contact shadow's blocker is 0.4 m from the
 * plane. Bounds are what comes out, and a little more. */
static void test_soft_shadow(void **state)
{
    (void)state;
    for (int projection = 0; projection < 2; projection++) {
        struct csm_fixture f;
        struct stage_error e[VARIANTS][17][2][STAGES];
        /* the footprints of blockers near the light do not fit on a hemicube's face */
        const bool cut = projection == IRB_RASTER_HEMICUBE;
        csm_create(&f, gl, (enum irb_raster_projection)projection, 128, 1, stage_distance,
                   &stages[0]);
        for (int order = 2; order <= 16; order *= 2)
            for (int prefilter = 0; prefilter < 2; prefilter++) {
                csm_make(&f, order, (enum irb_csm_prefilter)prefilter);
                for (int v = 0; v < VARIANTS; v++)
                    measure(&f, v, e[v][order][prefilter]);
            }
        for (int prefilter = 0; prefilter < 2; prefilter++) {
            for (int s = 0; s < STAGES; s++) {
                REQUIRE_CMP(e[SCALED][4][prefilter][s].rms, <, cut ? 0.19 : 0.16);
                REQUIRE_CMP(e[DAMPED][16][prefilter][s].rms, <, cut ? 0.19 : 0.1);
            }
            /* leaks go as the order grows; what the light sees whole loses little to ringing */
            REQUIRE_CMP(e[OFFSET][2][prefilter][2].leak, >, 0.9);
            REQUIRE_CMP(e[SCALED][4][prefilter][2].leak, <, 0.4);
            REQUIRE_CMP(e[OFFSET][16][prefilter][2].leak, <, 0.02);
            REQUIRE_CMP(e[SCALED][4][prefilter][1].ringing, >, 0.99);
            REQUIRE_CMP(e[OFFSET][16][prefilter][1].ringing, >, 0.9);
        }
        csm_destroy(&f);
    }
}

/* Nothing in any map, and one texel in another: all that there is to see is lit or finite, whatever
 * the direction, below the horizon too, at the light itself, and for a light beyond all bounds. */
static double nearly_empty(const void *user, int map, int face, int x, int y, const double d[3])
{
    (void)user, (void)d;
    return map && !face && x == 7 && y == 9 ? 1e-20 : INFINITY;
}

static void test_degenerate(void **state)
{
    (void)state;
    enum { QUERIES = 200 };
    for (int projection = 0; projection < 2; projection++)
        for (int prefilter = 0; prefilter < 2; prefilter++) {
            struct csm_fixture f;
            struct csm_query queries[QUERIES];
            uint64_t random = 7;
            csm_create(&f, gl, (enum irb_raster_projection)projection, SIZE, 2, nearly_empty, NULL);
            f.settings = variants[OFFSET];
            csm_make(&f, 4, (enum irb_csm_prefilter)prefilter);
            for (int i = 0; i < QUERIES; i++) {
                static const float radii[] = {0, 1e-12f, 0.3f, 1e12f};
                static const double lengths[] = {0, 1e-12, 1, 1e12};
                double d[3];
                fixture_random_direction(&random, false, d);
                queries[i] = (struct csm_query){
                    .map = (float)(i % 2), .radius = radii[i / 2 % 4], .kind = CSM_VISIBILITY};
                for (int k = 0; k < 3; k++)
                    queries[i].q[k] = (float)(d[k] * lengths[i / 8 % 4]);
            }
            float *found = csm_ask(&f, queries, QUERIES);
            for (int i = 0; i < QUERIES; i++) {
                REQUIRE_CMP(found[i], >=, 0);
                REQUIRE_CMP(found[i], <=, 1);
                if (i % 2 == 0)
                    REQUIRE_CMP(found[i], >, 0.9); /* sums in float32 */
            }
            free(found);
            csm_destroy(&f);
        }
}

static void test_refusals(void **state)
{
    (void)state;
    static const int wrong[][3] = {{24, 1, 4}, {2, 1, 4},   {64, 0, 4},
                                   {64, 1, 0}, {64, 1, 17}, {64, 100000, 4}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct irb_error err = {0};
        assert_null(irb_csm_create(gl, IRB_RASTER_PARABOLOID, wrong[i][0], wrong[i][1], wrong[i][2],
                                   IRB_CSM_MIP, &err));
        assert_int_equal(err.code, IRB_E_INPUT);
        REQUIRE_ONE_LINE(err.message);
    }
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_step),           cmocka_unit_test(test_series),
        cmocka_unit_test(test_lit_surface),    cmocka_unit_test(test_blocker),
        cmocka_unit_test(test_blocker_search), cmocka_unit_test(test_soft_shadow),
        cmocka_unit_test(test_degenerate),     cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
