/* SPDX-License-Identifier: MIT
 *
 * VALs: k-means against a plain one in double precision.
 */
#include "tests/support/compare.h"
#include "core/lights/vals.h"
#include "tests/lights/raster_fixture.h"

static struct irb_gl *gl;

enum { MOST = IRB_VALS_MOST_LIGHTS };

/* A case: lights, settings, and what comes out. */
struct run {
    struct fixture_light lights[MOST];
    int count;
    struct irb_vals_settings settings;
    struct irb_val vals[IRB_VALS_MOST];
    uint32_t assignment[MOST];
    struct irb_vals_statistics statistics;
};

static const struct irb_vals_settings usual = {
    .vals = 16, .weight_distance = 1, .weight_angle = 0.5f, .iterations = 100, .tiles = 1};

/* VPLs on the walls, floor and ceiling of a 2 m box, normals inwards and a little off; shifted by
 * `at` along x. */
static void fill_room(struct run *r, int count, uint64_t seed, double at)
{
    for (int l = 0; l < count; l++) {
        double x[3], n[3] = {0, 0, 0}, length = 0;
        const int axis = (int)(3 * fixture_random(&seed)), side = fixture_random(&seed) < 0.5;
        for (int i = 0; i < 3; i++) {
            x[i] = i == axis ? (side ? 1 : -1) : 2 * fixture_random(&seed) - 1;
            n[i] = (i == axis ? (side ? -1 : 1) : 0) + 0.1 * (fixture_random(&seed) - 0.5);
            length += n[i] * n[i];
        }
        for (int i = 0; i < 3; i++) {
            r->lights[l].position[i] = (float)(x[i] + (i == 0 ? at : 0));
            r->lights[l].normal[i] = (float)(n[i] / sqrt(length));
            r->lights[l].flux[i] = (float)(0.1 + fixture_random(&seed));
        }
    }
    r->count = count;
}

static void run(struct irb_vals *vals, struct run *r)
{
    struct irb_error err = {0};
    struct irb_virtual_lights view = fixture_lights(gl, r->lights, r->count);
    REQUIRE_OK(irb_vals_cluster(vals, &view, &r->settings, &err));
    REQUIRE_OK(irb_vals_statistics(vals, &r->statistics, &err));
    REQUIRE_OK(irb_buffer_read(vals->vals, 0, sizeof r->vals, r->vals, &err));
    REQUIRE_OK(irb_buffer_read(vals->assignment, 0, sizeof r->assignment, r->assignment, &err));
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    for (int v = 0; r->count && v < r->settings.vals; v++)
        for (int i = 0; i < 3; i++) {
            assert_true(isfinite(r->vals[v].position[i]) && isfinite(r->vals[v].normal[i]));
            assert_true(isfinite(r->vals[v].area) && isfinite(r->vals[v].flux[i]));
        }
}

static void run_fresh(struct run *r)
{
    struct irb_error err = {0};
    struct irb_vals *vals = irb_vals_create(gl, &err);
    REQUIRE_OK(vals);
    run(vals, r);
    irb_vals_destroy(vals);
}

/* --- the plain one --- */

struct plain {
    double centre[IRB_VALS_MOST][3], normal[IRB_VALS_MOST][3];
    int of[MOST], members[IRB_VALS_MOST], iterations;
};

static double mu(const struct run *r, int l, const double c[3], const double n[3])
{
    double d2 = 0, cosine = 0;
    for (int i = 0; i < 3; i++) {
        d2 += (r->lights[l].position[i] - c[i]) * (r->lights[l].position[i] - c[i]);
        cosine += r->lights[l].normal[i] * n[i];
    }
    return r->settings.weight_distance * sqrt(d2) +
           r->settings.weight_angle * acos(fmax(-1, fmin(1, cosine)));
}

static bool assign(const struct run *r, struct plain *p)
{
    bool changed = false;
    for (int l = 0; l < r->count; l++) {
        double least = INFINITY;
        int best = 0;
        for (int v = 0; v < r->settings.vals && v < r->count; v++) {
            double m = mu(r, l, p->centre[v], p->normal[v]);
            if (m < least) {
                least = m;
                best = v;
            }
        }
        changed = changed || p->of[l] != best;
        p->of[l] = best;
    }
    return changed;
}

static void average(const struct run *r, struct plain *p)
{
    for (int v = 0; v < r->settings.vals; v++) {
        double x[3] = {0}, n[3] = {0}, length = 0;
        p->members[v] = 0;
        for (int l = 0; l < r->count; l++)
            for (int i = 0; p->of[l] == v && i < 3; i++) {
                x[i] += r->lights[l].position[i];
                n[i] += r->lights[l].normal[i];
                p->members[v] += i == 0;
            }
        for (int i = 0; i < 3; i++)
            length += n[i] * n[i];
        for (int i = 0; p->members[v] && i < 3; i++) {
            p->centre[v][i] = x[i] / p->members[v];
            p->normal[v][i] = n[i] / sqrt(length);
        }
    }
}

/* From the first k VPLs, which are those of one tile's sequence. */
static void plain_k_means(const struct run *r, struct plain *p)
{
    *p = (struct plain){0};
    for (int l = 0; l < r->count; l++)
        p->of[l] = -1;
    for (int v = 0; v < r->settings.vals && v < r->count; v++)
        for (int i = 0; i < 3; i++) {
            p->centre[v][i] = r->lights[v].position[i];
            p->normal[v][i] = r->lights[v].normal[i];
        }
    while (p->iterations < r->settings.iterations) {
        p->iterations++;
        if (!assign(r, p))
            break;
        average(r, p);
    }
}

static void check_records(const struct run *r, const struct plain *p)
{
    for (int v = 0; v < r->settings.vals; v++) {
        double moment = 0, farthest = 0, flux[3] = {0};
        REQUIRE_NEAR(r->vals[v].vpls, p->members[v], 0);
        for (int l = 0; l < r->count; l++) {
            double d2 = 0;
            for (int i = 0; p->of[l] == v && i < 3; i++) {
                d2 += pow(r->lights[l].position[i] - p->centre[v][i], 2);
                flux[i] += r->lights[l].flux[i];
            }
            moment += d2;
            farthest = fmax(farthest, d2);
        }
        if (!p->members[v])
            continue;
        double radius2 =
            r->settings.area == IRB_VALS_AREA_MAX ? farthest : 2 * moment / p->members[v];
        REQUIRE_NEAR(r->vals[v].area, M_PI * radius2, 1e-5 * radius2 + 1e-9);
        for (int i = 0; i < 3; i++) {
            REQUIRE_NEAR(r->vals[v].position[i], p->centre[v][i], 1e-5);
            REQUIRE_NEAR(r->vals[v].normal[i], p->normal[v][i], 1e-5);
            REQUIRE_REL(r->vals[v].flux[i], flux[i], 1e-5);
        }
    }
}

static void test_against_double(void **state)
{
    (void)state;
    static const struct {
        int vpls, vals;
    } cases[] = {{1, 1}, {100, 1}, {100, 7}, {512, 16}, {3, 16}, {2048, 32}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (int area = 0; area < 2; area++) {
            static struct run r;
            static struct plain p;
            fill_room(&r, cases[k].vpls, 10 + k, 0);
            r.settings = usual;
            r.settings.vals = cases[k].vals;
            r.settings.area = (enum irb_vals_area)area;
            run_fresh(&r);
            plain_k_means(&r, &p);
            int differ = 0, in_use = 0;
            for (int l = 0; l < r.count; l++)
                differ += (int)r.assignment[l] != p.of[l];
            for (int v = 0; v < r.settings.vals; v++)
                in_use += p.members[v] > 0;
            if (!area)
                print_message("%4d VPLs, %2d VALs: %d in use, %d iterations, %d differ\n", r.count,
                              r.settings.vals, r.statistics.in_use, r.statistics.iterations,
                              differ);
            REQUIRE_NEAR(differ, 0, 0);
            REQUIRE_NEAR(r.statistics.iterations, p.iterations, 0);
            REQUIRE_NEAR(r.statistics.in_use, in_use, 0);
            assert_true(r.statistics.converged);
            check_records(&r, &p);
        }
}

/* Most VPLs and many iterations: more rounds of loops than llvmpipe lets one dispatch
 * have. What it ends with is a fixed point. And a bound on the iterations holds. */
static void test_converges(void **state)
{
    (void)state;
    enum { VALS = 64 };
    static struct run r;
    fill_room(&r, IRB_VALS_MOST_LIGHTS, 5, 0);
    for (int l = 0; l < r.count; l++) /* on a disc, densest in the middle */
        for (int i = 0; i < 3; i++) {
            r.lights[l].position[i] *= i == 1 ? 0 : fabsf(r.lights[l].position[i]);
            r.lights[l].normal[i] = i == 1;
        }
    r.settings = usual;
    r.settings.vals = VALS;
    r.settings.iterations = 500;
    run_fresh(&r);
    print_message("%d VPLs, %d VALs: %d iterations\n", r.count, VALS, r.statistics.iterations);
    assert_true(r.statistics.converged);
    REQUIRE_CMP(r.statistics.iterations, >, 25); /* 22 fit */
    for (int l = 0; l < r.count; l++) {
        double least = INFINITY, own = 0;
        for (int v = 0; v < VALS; v++) {
            double c[3], n[3];
            for (int i = 0; i < 3; i++) {
                c[i] = r.vals[v].position[i];
                n[i] = r.vals[v].normal[i];
            }
            double m = r.vals[v].vpls > 0 ? mu(&r, l, c, n) : INFINITY;
            least = fmin(least, m);
            own = (int)r.assignment[l] == v ? m : own;
        }
        REQUIRE_NEAR(own, least, 2e-3); /* acos of nearly 1 in float32 records */
    }
    r.settings.iterations = 3;
    run_fresh(&r);
    REQUIRE_NEAR(r.statistics.iterations, 3, 0);
    assert_false(r.statistics.converged);
}

/* A spot that wanders from one wall to another and back (figure 3.9): reuse keeps losing VALs and
 * never gets one back, restart has them all, and what it makes of a frame does not depend on those
 * before. */
static void test_reuse(void **state)
{
    (void)state;
    struct irb_error err = {0};
    enum { FRAMES = 9, VPLS = 256 };
    static struct run r, fresh;
    struct irb_vals *vals[2];
    int in_use[2][FRAMES];
    for (int start = 0; start < 2; start++) {
        REQUIRE_OK(vals[start] = irb_vals_create(gl, &err));
        for (int frame = 0; frame < FRAMES; frame++) {
            uint64_t seed = 3; /* the same points each frame */
            const double at = 0.5 * (frame < 5 ? frame : 8 - frame);
            for (int l = 0; l < VPLS; l++) {
                double y = at + fixture_random(&seed), z = fixture_random(&seed);
                const bool wall = y < 1.5; /* y up to 1.5, then on along the ceiling */
                r.lights[l] = (struct fixture_light){
                    .position = {(float)(wall ? 0 : y - 1.5), (float)(wall ? y : 1.5), (float)z},
                    .normal = {wall ? 1 : 0, wall ? 0 : -1, 0},
                    .flux = {1, 1, 1}};
            }
            r.count = VPLS;
            r.settings = usual;
            r.settings.start = (enum irb_vals_start)start;
            run(vals[start], &r);
            in_use[start][frame] = r.statistics.in_use;
            if (start == IRB_VALS_RESTART) {
                fresh = r;
                run_fresh(&fresh);
                assert_memory_equal(fresh.vals, r.vals, sizeof(struct irb_val) * 16);
                REQUIRE_CMP(r.statistics.in_use, >=, 15);
            } else if (frame) {
                REQUIRE_CMP(in_use[1][frame], <=, in_use[1][frame - 1]);
            }
        }
    }
    for (int frame = 0; frame < FRAMES; frame++)
        print_message("frame %d: %d VALs by restart, %d by reuse\n", frame, in_use[0][frame],
                      in_use[1][frame]);
    REQUIRE_CMP(in_use[1][FRAMES - 1], <, 16);
    /* a dark frame is forgotten; a new sequence has them all */
    const int kept = in_use[1][FRAMES - 1];
    r.count = 0;
    run(vals[1], &r);
    REQUIRE_NEAR(r.statistics.in_use, 0, 0);
    r.count = VPLS;
    run(vals[1], &r);
    REQUIRE_NEAR(r.statistics.in_use, kept, 0);
    irb_vals_forget(vals[1]);
    run(vals[1], &r);
    REQUIRE_NEAR(r.statistics.in_use, in_use[0][FRAMES - 1], 0);
    irb_vals_destroy(vals[0]);
    irb_vals_destroy(vals[1]);
}

/* All VPLs in one place; both sides of a thin wall, whose normals cancel; zero normals; far from
 * the origin; a mean that lies on no VPL. */
static void test_degenerate(void **state)
{
    (void)state;
    static struct run r;
    fill_room(&r, 100, 1, 0);
    for (int l = 1; l < 100; l++)
        r.lights[l] = r.lights[0];
    r.settings = usual;
    run_fresh(&r);
    REQUIRE_NEAR(r.statistics.in_use, 1, 0);
    REQUIRE_NEAR(r.vals[0].area, 0, 1e-12);
    for (int l = 0; l < 100; l++) {
        r.lights[l].position[0] = l % 2 ? 1e-4f : 0;
        for (int i = 0; i < 3; i++)
            r.lights[l].normal[i] = i == 0 ? (l % 2 ? 1.0f : -1.0f) : 0;
    }
    r.settings.vals = 1; /* one for both sides */
    run_fresh(&r);
    REQUIRE_NEAR(r.vals[0].normal[0], -1, 0); /* of the first */
    r.settings.vals = 2;
    run_fresh(&r);
    for (int l = 0; l < 100; l++) /* apart by their normals */
        REQUIRE_NEAR(r.assignment[l], r.assignment[l % 2], 0);
    REQUIRE_NEAR(r.statistics.in_use, 2, 0);
    for (int l = 0; l < 100; l++)
        memset(r.lights[l].normal, 0, sizeof r.lights[l].normal);
    run_fresh(&r);
    static struct run far;
    fill_room(&r, 200, 8, 0);
    fill_room(&far, 200, 8, 4096);
    r.settings = far.settings = usual;
    r.settings.centre = IRB_VALS_CENTRE_MEMBER;
    run_fresh(&r);
    run_fresh(&far);
    REQUIRE_NEAR(far.statistics.in_use, r.statistics.in_use, 1);
    for (int v = 0; v < 16; v++) { /* a member's own position */
        bool found = r.vals[v].vpls == 0;
        for (int l = 0; l < r.count; l++)
            found = found || ((int)r.assignment[l] == v &&
                              !memcmp(r.vals[v].position, r.lights[l].position, 12));
        assert_true(found);
    }
}

/* The outside of a sphere: the mean lies inside, lifted it has all of its VPLs below it, and one of
 * them at its height. On a flat floor it is the mean. */
static void test_lifted(void **state)
{
    (void)state;
    static struct run r, mean;
    uint64_t seed = 4;
    for (int l = 0; l < 300; l++) {
        double d[3];
        fixture_random_direction(&seed, false, d);
        for (int i = 0; i < 3; i++)
            r.lights[l].position[i] = r.lights[l].normal[i] = (float)d[i];
        r.lights[l].flux[0] = 1;
    }
    r.count = 300;
    r.settings = usual;
    r.settings.vals = 6;
    r.settings.centre = IRB_VALS_CENTRE_LIFTED;
    mean = r;
    mean.settings.centre = IRB_VALS_CENTRE_MEAN;
    run_fresh(&r);
    run_fresh(&mean);
    for (int v = 0; v < 6; v++) {
        double highest = -INFINITY;
        for (int l = 0; l < r.count; l++)
            if ((int)r.assignment[l] == v)
                highest = fmax(highest, fixture_dot(r.vals[v].normal, r.lights[l].position));
        REQUIRE_NEAR(fixture_dot(r.vals[v].normal, r.vals[v].position), highest, 1e-5);
        REQUIRE_CMP(sqrt(fixture_dot(mean.vals[v].position, mean.vals[v].position)), <, 0.95);
        REQUIRE_REL(r.vals[v].area, mean.vals[v].area, 1e-6);
    }
    for (int l = 0; l < 300; l++) {
        r.lights[l].position[1] = 0.3f;
        for (int i = 0; i < 3; i++)
            r.lights[l].normal[i] = i == 1;
    }
    memcpy(mean.lights, r.lights, sizeof r.lights);
    run_fresh(&r);
    run_fresh(&mean);
    for (int v = 0; v < 6; v++)
        for (int i = 0; i < 3; i++)
            REQUIRE_NEAR(r.vals[v].position[i], mean.vals[v].position[i], 1e-6);
}

/* Tile by tile, VAL by VAL, in order, every VPL once and as it was; also where tiles start k-means
 * from points of the sequence, not of the buffer. */
static void test_order(void **state)
{
    (void)state;
    struct irb_error err = {0};
    static const int counts[] = {1, 8, 100, 512, 2048}, tiles[] = {1, 4, 9, 64};
    static struct run r;
    static struct fixture_light ordered[MOST];
    for (int c = 0; c < 5; c++)
        for (int t = 0; t < 4; t++) {
            fill_room(&r, counts[c], 77, 0);
            r.settings = usual;
            r.settings.tiles = tiles[t];
            struct irb_vals *vals = irb_vals_create(gl, &err);
            REQUIRE_OK(vals);
            run(vals, &r);
            struct irb_virtual_lights view = fixture_lights(gl, r.lights, r.count);
            REQUIRE_OK(irb_vals_order(vals, &view, tiles[t], &err));
            REQUIRE_OK(irb_buffer_read(vals->ordered, 0, sizeof ordered, ordered, &err));
            int place = 0;
            for (int tile = 0; tile < tiles[t]; tile++)
                for (int v = 0; v < r.settings.vals; v++)
                    for (int l = tile; l < r.count; l += tiles[t])
                        if ((int)r.assignment[l] == v) {
                            REQUIRE_NEAR(ordered[place].normal[3], v, 0);
                            ordered[place].normal[3] = 0;
                            assert_memory_equal(&ordered[place++], &r.lights[l], sizeof *ordered);
                        }
            REQUIRE_NEAR(place, r.count, 0);
            irb_buffer_destroy((struct irb_buffer *)view.buffer);
            irb_vals_destroy(vals);
        }
}

/* Dark ones between change nothing for the others, have no VAL and come last in the order. */
static void test_dark(void **state)
{
    (void)state;
    static struct run lit, mixed;
    static struct fixture_light ordered[MOST];
    struct irb_error err = {0};
    fill_room(&lit, 300, 7, 0);
    lit.settings = usual;
    run_fresh(&lit);
    mixed.settings = usual;
    mixed.count = 450;
    for (int l = 0; l < mixed.count; l++) {
        mixed.lights[l] = lit.lights[l / 3 * 2 + (l % 3 == 2)];
        if (l % 3 == 1)
            memset(mixed.lights[l].flux, 0, sizeof mixed.lights[l].flux);
    }
    struct irb_vals *vals = irb_vals_create(gl, &err);
    REQUIRE_OK(vals);
    run(vals, &mixed);
    assert_memory_equal(mixed.vals, lit.vals, sizeof(struct irb_val) * 16);
    REQUIRE_NEAR(mixed.statistics.iterations, lit.statistics.iterations, 0);
    for (int l = 0; l < mixed.count; l++)
        REQUIRE_NEAR(mixed.assignment[l],
                     l % 3 == 1 ? UINT32_MAX : lit.assignment[l / 3 * 2 + (l % 3 == 2)], 0);
    struct irb_virtual_lights view = fixture_lights(gl, mixed.lights, mixed.count);
    REQUIRE_OK(irb_vals_order(vals, &view, 1, &err));
    REQUIRE_OK(irb_buffer_read(vals->ordered, 0, sizeof ordered, ordered, &err));
    for (int l = 0; l < mixed.count; l++)
        REQUIRE_NEAR(ordered[l].normal[3] < 0, l >= 300, 0);
    irb_buffer_destroy((struct irb_buffer *)view.buffer);
    for (int l = 0; l < mixed.count; l++)
        memset(mixed.lights[l].flux, 0, sizeof mixed.lights[l].flux);
    run(vals, &mixed); /* all of them */
    REQUIRE_NEAR(mixed.statistics.in_use, 0, 0);
    irb_vals_destroy(vals);
}

/* Lights with areas: one keeps its own; of two discs of area A, 2 a apart, the second moment is
 * that of a disc of 2 pi a^2 + A, and the rim is a + sqrt(A/pi) away. */
static void test_areas(void **state)
{
    (void)state;
    static struct run r;
    const double a = 0.75, area = 0.3;
    r.settings = usual;
    r.settings.vals = 1;
    for (int l = 0; l < 2; l++)
        r.lights[l] = (struct fixture_light){.position = {(float)(l ? a : -a), 0, 0, (float)area},
                                             .normal = {0, 1, 0},
                                             .flux = {1, 1, 1}};
    r.count = 1;
    run_fresh(&r);
    REQUIRE_REL(r.vals[0].area, area, 1e-6);
    r.count = 2;
    run_fresh(&r);
    REQUIRE_REL(r.vals[0].area, 2 * M_PI * a * a + area, 1e-5);
    r.settings.area = IRB_VALS_AREA_MAX;
    run_fresh(&r);
    REQUIRE_REL(r.vals[0].area, M_PI * pow(a + sqrt(area / M_PI), 2), 1e-5);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_double), cmocka_unit_test(test_converges),
        cmocka_unit_test(test_reuse),          cmocka_unit_test(test_degenerate),
        cmocka_unit_test(test_lifted),         cmocka_unit_test(test_order),
        cmocka_unit_test(test_dark),           cmocka_unit_test(test_areas),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
