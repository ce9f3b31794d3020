/* SPDX-License-Identifier: MIT
 *
 * Convolution soft shadow maps against rays: the share of a disc light that points of a floor see
 * behind a disc, a slab with a hole, a torus knot, and two half planes at different heights, from a
 * rasterised map, for all orders and both prefilters.
 *
 *     test_csm_reference BACKEND SHADERS     SHADERS: tests/lights/shaders
 */
#include "tests/support/compare.h"
#include "tests/integration/disc_light.h"
#include "tests/lights/csm_fixture.h"
#include "tests/support/lens.h"

static struct irb_gl *gl;

/* A grid over the floor, and a row outward from its middle through the shadow's edge. */
enum { MAP_SIZE = 256, SIDE = 28, GRID = SIDE * SIDE, ROW = 101, POINTS = GRID + ROW };
static const double extent = 2; /* m: the grid's half side, the row's length */

/* The default: no offset, Annen et al.'s scale of 2. An offset, the same length for every order,
 * that exceeds what the floor's depths vary by within a footprint, and the scale by which lit floor
 * still reads 1. The same, damped. */
enum { SCALED, OFFSET, DAMPED, VARIANTS };
static const char *const variant_names[VARIANTS] = {"scaled", "offset", "damped"};
static const double offset_length = 1.0 / 16; /* of the range of depths */

/* The series at t = z - d. */
static double step_at(int order, double damping, double t)
{
    double sum = 0.5;
    for (int k = 1; k <= order; k++) {
        const double c = M_PI * (2 * k - 1);
        sum += 2 / c * exp(-damping * k * k / order / order) * sin(c * t);
    }
    return sum;
}

static struct irb_csm_settings settings_of(int order, int variant)
{
    struct irb_csm_settings s = {
        .scale = 2, .search_offset = 0.613f, .search_scale = 1, .penumbra_scale = 1};
    if (variant == SCALED)
        return s;
    s.damping = variant == DAMPED;
    s.offset = (float)(offset_length * 2 * order);
    s.search_offset = fmaxf(s.search_offset, s.offset);
    s.scale = (float)fmax(1 / step_at(order, (double)s.damping, offset_length), 1);
    return s;
}

static void point_of(int i, double *u, double *v)
{
    *u = i < GRID ? extent * (2 * (i % SIDE + 0.5) / SIDE - 1) : extent * (i - GRID) / (ROW - 1);
    *v = i < GRID ? extent * (2 * (i / SIDE + 0.5) / SIDE - 1) : 0;
}

struct stage {
    struct csm_fixture csm;
    struct irb_image map;
    double q[POINTS][3]; /* in the light's frame */
    double truth[POINTS];
    /* with an exact test; distance of blockers, 0: none; side of the search, texels */
    double model[POINTS], blocker[POINTS], side[POINTS];
};

static void trace_stage(struct stage *s, const struct irb_scene *scene)
{
    struct irb_error err = {0};
    struct irb_tracer *tracer = irb_tracer_create(scene, &err);
    REQUIRE_OK(tracer);
    struct trace_context context = {.tracer = tracer, .surfaces = irb_tracer_surfaces(tracer)};
    uint64_t random = 1;
    for (int i = 0; i < POINTS; i++) {
        double u, v;
        point_of(i, &u, &v);
        s->truth[i] = disc_seen(&context, u, v, &random);
    }
    irb_tracer_destroy(tracer);
}

static void render_map(struct stage *s, const struct irb_scene *scene)
{
    struct irb_error err = {0};
    struct fixture_light light = {.normal = {0, -1, 0}};
    double frame[3][3], world[3];
    for (int k = 0; k < 3; k++)
        light.position[k] = (float)disc_at[k];
    struct irb_scene_gl *scene_gl = irb_scene_gl_create(gl, scene, &err);
    REQUIRE_OK(scene_gl);
    struct irb_virtual_lights view = fixture_lights(gl, &light, 1);
    s->csm = (struct csm_fixture){.settings = csm_plain};
    s->csm.maps = irb_raster_maps_create(gl, IRB_RASTER_PARABOLOID, MAP_SIZE, 1, &err);
    REQUIRE_OK(s->csm.maps);
    REQUIRE_OK(irb_raster_maps_render(s->csm.maps, scene_gl, &view, 0, 1, 0.01f, &err));
    s->map = fixture_read(s->csm.maps->distance, 1);
    for (size_t i = 0; i < irb_image_pixels(&s->map); i++)
        if (isfinite(s->map.data[i]))
            s->csm.range[0] = fmaxf(s->csm.range[0], s->map.data[i]);
    fixture_light_frame(light.normal, frame);
    for (int i = 0; i < POINTS; i++) {
        double u, v;
        point_of(i, &u, &v);
        disc_point(u, v, disc_floor, world);
        for (int k = 0; k < 3; k++)
            s->q[i][k] = frame[k][0] * (world[0] - disc_at[0]) +
                         frame[k][1] * (world[1] - disc_at[1]) +
                         frame[k][2] * (world[2] - disc_at[2]);
    }
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    irb_scene_gl_destroy(scene_gl);
}

static struct stage *create_stage(enum disc_blocker blocker)
{
    struct stage *s = calloc(1, sizeof *s);
    struct irb_scene *scene = disc_scene(blocker);
    assert_non_null(s);
    trace_stage(s, scene);
    render_map(s, scene);
    irb_scene_destroy(scene);
    const struct disc_map map = {&s->map, MAP_SIZE};
    for (int i = 0; i < POINTS; i++)
        s->model[i] = disc_model(&map, s->q[i], 1, &s->blocker[i], &s->side[i]);
    return s;
}

static void destroy_stage(struct stage *s)
{
    irb_image_destroy(&s->map);
    csm_destroy(&s->csm);
    free(s);
}

/* ---- What is measured ---- */

struct quality {
    double rms, worst;
    double leak, leak_worst; /* mean and most of what is seen where no ray arrives */
    double dark;             /* mean of what is missing where all arrive */
    double under, over;      /* of the sum before it is cut: below 0, above 1 */
    double fall;             /* most that a row falls which should not: after its darkest point */
    double width;            /* m, of the row's last rise from 0.1 to 0.9; NaN: never so dark */
    double to_model;         /* rms difference to the exact test */
    double blocker;          /* m, rms difference of z_avg to a search */
};

/* Where the last rise to `level` of a row ends, in steps, interpolated; NaN without one. */
static double last_rise(const double *row, double level)
{
    for (int i = ROW - 1; i > 0; i--)
        if (row[i - 1] < level && row[i] >= level)
            return i - 1 + (level - row[i - 1]) / (row[i] - row[i - 1]);
    return NAN;
}

static double width_of(const double *row)
{
    return (last_rise(row, 0.9) - last_rise(row, 0.1)) * extent / (ROW - 1);
}

/* Rays see no fall after the last point of their least. */
static double fall_of(const double *truth, const double *row)
{
    int darkest = 0;
    double most = 0, fall = 0;
    for (int i = 0; i < ROW; i++)
        darkest = truth[i] <= truth[darkest] ? i : darkest;
    for (int i = darkest; i < ROW; i++) {
        most = fmax(most, row[i]);
        fall = fmax(fall, most - row[i]);
    }
    return fall;
}

static struct quality compare_stage(const struct stage *s, const double *found)
{
    struct quality e = {.width = width_of(found + GRID),
                        .fall = fall_of(s->truth + GRID, found + GRID)};
    int dark = 0, lit = 0;
    for (int i = 0; i < GRID; i++) {
        const double error = found[i] - s->truth[i], apart = found[i] - s->model[i];
        e.rms += error * error / GRID;
        e.to_model += apart * apart / GRID;
        e.worst = fmax(e.worst, fabs(error));
        if (s->truth[i] == 0) {
            e.leak += error;
            e.leak_worst = fmax(e.leak_worst, error);
            dark++;
        }
        if (s->truth[i] == 1) {
            e.dark -= error;
            lit++;
        }
    }
    e.rms = sqrt(e.rms);
    e.to_model = sqrt(e.to_model);
    e.leak /= dark > 0 ? dark : 1;
    e.dark /= lit > 0 ? lit : 1;
    return e;
}

/* ---- The maps' answers ---- */

static void ask(struct stage *s, float scale, double out[POINTS])
{
    struct csm_query queries[POINTS];
    for (int i = 0; i < POINTS; i++)
        queries[i] =
            (struct csm_query){.q = {(float)s->q[i][0], (float)s->q[i][1], (float)s->q[i][2]},
                               .radius = (float)disc_radius,
                               .kind = CSM_VISIBILITY};
    s->csm.settings.scale = scale;
    float *found = csm_ask(&s->csm, queries, POINTS);
    for (int i = 0; i < POINTS; i++)
        out[i] = (double)found[i];
    free(found);
}

/* The sum before it is cut to [0,1]: scales so small that only its sign is cut. Where no blocker is
 * found there is no sum, and the answer is 1. */
static void measure_ringing(struct stage *s, struct quality *e)
{
    static const float small = 0x1p-4f;
    double above[POINTS], below[POINTS];
    ask(s, small, above);
    ask(s, -small, below);
    for (int i = 0; i < POINTS; i++) {
        if (above[i] == 1)
            continue;
        e->over = fmax(e->over, above[i] / (double)small - 1);
        e->under = fmax(e->under, below[i] / (double)small);
    }
}

/* rms difference of z_avg to the search through the map, m, where that finds a blocker and the
 * light is not seen whole. */
static double blocker_error(struct stage *s)
{
    struct csm_query queries[POINTS];
    const double unit = (double)s->csm.csm->span / (double)s->csm.range[0];
    double sum = 0;
    int count = 0;
    for (int i = 0; i < POINTS; i++) {
        const double *q = s->q[i];
        queries[i] =
            (struct csm_query){.q = {(float)q[0], (float)q[1], (float)q[2]},
                               .kind = CSM_BLOCKER,
                               .side = (float)s->side[i],
                               .z = (float)(sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]) * unit)};
    }
    float *found = csm_ask(&s->csm, queries, POINTS);
    for (int i = 0; i < POINTS; i++)
        if (s->blocker[i] > 0 && s->truth[i] < 1) {
            const double error = (double)found[i] / unit - s->blocker[i];
            sum += error * error;
            count++;
        }
    free(found);
    return sqrt(sum / count);
}

static void print_quality(const char *stage, const char *variant, const char *map,
                          const struct quality *e)
{
    print_message("%-5s %-6s %-6s  %.3f  %.2f  %.3f  %.2f  %.3f  %.3f  %.3f  %.3f  %5.2f  %.3f  "
                  "%.3f\n",
                  stage, variant, map, e->rms, e->worst, e->leak, e->leak_worst, e->dark, e->under,
                  e->over, e->fall, e->width, e->to_model, e->blocker);
}

static struct quality measure(struct stage *s, const char *name, int order,
                              enum irb_csm_prefilter prefilter, int variant)
{
    const struct irb_csm_settings settings = settings_of(order, variant);
    double found[POINTS];
    char map[16];
    s->csm.settings = settings;
    csm_update(&s->csm);
    ask(s, settings.scale, found);
    struct quality e = compare_stage(s, found);
    e.blocker = blocker_error(s);
    measure_ringing(s, &e);
    snprintf(map, sizeof map, "%s %d", irb_csm_prefilter_names[prefilter], order);
    print_quality(name, variant_names[variant], map, &e);
    return e;
}

/* By blocker, variant, order, prefilter; what rays and the exact test give. */
static struct quality results[DISC_BLOCKERS][VARIANTS][17][2], exact[DISC_BLOCKERS];
static double ray_width[DISC_BLOCKERS];
static double ray_error; /* most that rays are off the closed form over the disc's row and grid */

/* Share of the light that is seen past the disc: projected onto the light's plane through a
 * receiver at x, it has twice its radius and its centre at -x, as it lies half way. */
static double past_disc(double x)
{
    return 1 - lens(disc_radius, 2 * 0.5, x) / (M_PI * disc_radius * disc_radius);
}

static void measure_all(enum disc_blocker b)
{
    struct stage *s = create_stage(b);
    ray_width[b] = width_of(s->truth + GRID);
    for (int i = 0; b == DISC_DISC && i < POINTS; i++)
        ray_error = fmax(ray_error, fabs(s->truth[i] - past_disc(hypot(s->q[i][0], s->q[i][1]))));
    exact[b] = compare_stage(s, s->model);
    print_quality(disc_names[b], "", "exact", &exact[b]);
    for (int order = 2; order <= 16; order *= 2)
        for (int prefilter = 0; prefilter < 2; prefilter++) {
            csm_make(&s->csm, order, (enum irb_csm_prefilter)prefilter);
            for (int v = 0; v < VARIANTS; v++)
                results[b][v][order][prefilter] =
                    measure(s, disc_names[b], order, (enum irb_csm_prefilter)prefilter, v);
        }
    destroy_stage(s);
}

static int setup(void **state)
{
    (void)state;
    print_message("blocker, settings, map; rms, worst; leak: mean, worst; dark; under, over; fall; "
                  "10-90 %%, m; to the exact test; z_avg, m\n");
    for (int b = 0; b < DISC_BLOCKERS; b++)
        measure_all((enum disc_blocker)b);
    print_message("rays: 10-90 %% over disc %.2f m, slab %.2f m, steps %.2f m\n",
                  ray_width[DISC_DISC], ray_width[DISC_SLAB], ray_width[DISC_STEPS]);
    return 0;
}

/* 1024 strata: an edge crosses 2 sqrt(1024) of them, each with a variance of 1/4 at most; five
 * standard deviations of that, and what the disc's corners leave out. */
static void test_rays(void **state)
{
    (void)state;
    print_message("rays within %.4f of the closed form\n", ray_error);
    REQUIRE_CMP(ray_error, <, 5 * sqrt(2 * 32 / 4.0) / 1024 + 5e-4);
}

/* Means of a series that overshoots by g lie in [-g, 1 + g]; g is largest at its first maximum.
 * Damping leaves less than a quarter. */
static void test_ringing(void **state)
{
    (void)state;
    for (int b = 0; b < DISC_BLOCKERS; b++)
        for (int order = 2; order <= 16; order *= 2)
            for (int prefilter = 0; prefilter < 2; prefilter++)
                for (int v = 0; v < VARIANTS; v++) {
                    const struct quality *e = &results[b][v][order][prefilter];
                    const double g = step_at(order, 0, 0.5 / order) - 1;
                    const double bound = (v == DAMPED ? g / 4 : g) + 1e-3;
                    REQUIRE_CMP(e->under, <=, bound);
                    REQUIRE_CMP(e->over, <=, bound);
                    /* what the light sees whole is lit, default or not */
                    REQUIRE_CMP(e->dark, <, 0.01);
                }
}

/* In the disc's umbra all that is looked up lies 1 m before the floor, the receiver, where the
 * series is off by 2/(pi (2M + 1) sin(pi t)) at most (Abel; test_csm.c), and never by more than
 * 1/2. */
static double umbra_bound(int order, int variant)
{
    const struct irb_csm_settings s = settings_of(order, variant);
    const double range = sqrt(3 * 3 + 3 * 3 + disc_floor * disc_floor), half = 0.5 / order;
    const double span = fmax(0.5, 1 - (1 + (double)fmaxf(s.offset, s.search_offset)) * half);
    const double t = span / range - (double)s.offset * half;
    return (double)s.scale * fmin(0.5, 2 / (M_PI * (2 * order + 1) * sin(M_PI * t)));
}

static void test_leaks(void **state)
{
    (void)state;
    for (int v = 0; v < VARIANTS; v++) {
        for (int order = 2; order <= 16; order *= 2) {
            /* 0.02: floor within footprints that reach out of the umbra */
            if (v != DAMPED)
                REQUIRE_CMP(results[DISC_DISC][v][order][IRB_CSM_SAT].leak_worst, <=,
                            umbra_bound(order, v) + 0.02);
            /* blockers 0.5 m before the receiver, a tenth of the range */
            if (order > 2)
                REQUIRE_CMP(results[DISC_STEPS][v][order][IRB_CSM_SAT].leak, <,
                            results[DISC_STEPS][v][order / 2][IRB_CSM_SAT].leak);
        }
        for (int b = 0; b < DISC_BLOCKERS; b++)
            REQUIRE_CMP(results[b][v][16][IRB_CSM_SAT].leak, <, 0.02);
    }
}

/* Tables. With an offset of fixed length the error of the test falls as the order grows, until what
 * is left is that of eq. 3.2, one depth for all blockers, which an exact test has too. From M = 8
 * on it is less than what the series leaves of the step over the whole range of depths (Parseval,
 * the root mean square of test_csm.c: 0.090 and 0.062, damped); below, where the blockers lie
 * within the step, it is more: what comes out, and a tenth. */
static void test_converges(void **state)
{
    (void)state;
    static const double series[17] = {[2] = 0.38, [4] = 0.17, [8] = 0.090, [16] = 0.062};
    for (int b = 0; b < DISC_BLOCKERS; b++)
        for (int order = 2; order <= 16; order *= 2) {
            const struct quality *e = &results[b][DAMPED][order][IRB_CSM_SAT];
            REQUIRE_CMP(e->to_model, <, series[order]);
            REQUIRE_CMP(results[b][OFFSET][order][IRB_CSM_SAT].to_model, <, series[order]);
            if (order > 2) /* 0.005: what is left of two errors that cancel in part */
                REQUIRE_CMP(e->rms, <, results[b][DAMPED][order / 2][IRB_CSM_SAT].rms + 0.005);
            if (order == 16)
                REQUIRE_CMP(e->rms, <, exact[b].rms + 0.005);
        }
    for (int b = 0; b < DISC_BLOCKERS; b++)
        if (b != DISC_KNOT) /* never so dark */
            REQUIRE_REL(results[b][DAMPED][16][IRB_CSM_SAT].width, ray_width[b], 0.2);
}

/* The default: its step is its only offset, and at high orders narrower than what the floor's
 * depths vary by. The floor then blocks itself in the search, penumbrae get too narrow, and twice
 * its lit half is too light. Bounds: what comes out, and a tenth. Mipmaps bring up to 0.05 of their
 * own. */
static void test_default(void **state)
{
    (void)state;
    static const double most[17] = {[2] = 0.18, [4] = 0.175, [8] = 0.21, [16] = 0.235};
    for (int b = 0; b < DISC_BLOCKERS; b++)
        for (int prefilter = 0; prefilter < 2; prefilter++) {
            for (int order = 2; order <= 16; order *= 2)
                REQUIRE_CMP(results[b][SCALED][order][prefilter].rms, <, most[order]);
            REQUIRE_CMP(results[b][DAMPED][16][prefilter].rms, <,
                        results[b][SCALED][16][prefilter].rms);
            REQUIRE_CMP(results[b][DAMPED][16][prefilter].blocker, <,
                        results[b][SCALED][16][prefilter].blocker);
            REQUIRE_CMP(results[b][DAMPED][16][prefilter].rms, <, exact[b].rms + 0.05);
        }
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), argc > 2 ? argv[2] : NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays),    cmocka_unit_test(test_ringing),
        cmocka_unit_test(test_leaks),   cmocka_unit_test(test_converges),
        cmocka_unit_test(test_default),
    };
    int failed = cmocka_run_group_tests(tests, setup, NULL);
    irb_gl_destroy(gl);
    return failed;
}
