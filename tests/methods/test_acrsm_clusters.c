/* SPDX-License-Identifier: MIT
 *
 * Mapping and averaging of acrsm against brute force in double precision, and what must hold in
 * every frame of a moving light.
 */
#include "tests/support/compare.h"
#include "tests/methods/acrsm_fixture.h"

static struct irb_gl *gl;

enum { PLACED = -3 }; /* seeded, not yet averaged */

static double apart(const float a[3], const float b[3])
{
    double d2 = 0;
    for (int i = 0; i < 3; i++)
        d2 += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(d2);
}

/* Eq. 4.4. */
static double distance_of(const struct acrsm_settings *s, const struct acrsm_cluster *c,
                          const struct acrsm_texels *t, int p)
{
    double cosine = fixture_dot(c->normal, acrsm_texel(&t->normal, p));
    cosine = s->normals == ACRSM_NORMALS_SIGNED ? fmax(cosine, 0) : fabs(cosine);
    return s->w_position * apart(c->position, acrsm_texel(&t->position, p)) / s->extent +
           s->w_normal * (1 - cosine) +
           s->w_importance * fabs((double)c->importance - *acrsm_texel(&t->importance, p));
}

/* Eq. 4.5 over the clusters whose square covers the texel, or over all. */
static int nearest(const struct acrsm_fixture *a, const struct acrsm_cluster *state,
                   const struct acrsm_texels *t, int p, bool everywhere, double *least)
{
    int best = IRB_CLUSTER_NONE;
    *least = INFINITY;
    for (int i = 0; i < a->settings.clusters; i++) {
        if (!(state[i].count > 0 || state[i].count == PLACED) ||
            !(everywhere || acrsm_in_square(&state[i], p % t->resolution, p / t->resolution,
                                            a->settings.square, t->resolution)))
            continue;
        double mu = distance_of(&a->settings, &state[i], t, p);
        if (mu < *least) {
            *least = mu;
            best = i;
        }
    }
    return best;
}

/* The map against the brute force over the state that it was made from. A texel may go to another
 * cluster where that one is as near to 1e-5 of mu, which single precision cannot tell apart. */
static void check_mapping(const struct acrsm_fixture *a, const struct acrsm_cluster *state,
                          const int32_t *map, const struct acrsm_texels *t)
{
    const int n = t->resolution, texels = n * n;
    const bool nearest_cover = a->settings.cover == ACRSM_COVER_NEAREST;
    int lit = 0, others = 0, uncovered = 0;
    for (int p = 0; p < texels; p++) {
        double least;
        if (!acrsm_is_lit(t, p)) {
            REQUIRE_NEAR(map[2 * p], IRB_CLUSTER_UNLIT, 0);
            continue;
        }
        int expected = nearest(a, state, t, p, false, &least);
        if (expected == IRB_CLUSTER_NONE && nearest_cover)
            expected = nearest(a, state, t, p, true, &least);
        lit++;
        uncovered += map[2 * p] == IRB_CLUSTER_NONE;
        if (map[2 * p] == expected)
            continue;
        others++;
        if (map[2 * p] == IRB_CLUSTER_NONE || expected == IRB_CLUSTER_NONE)
            fail_msg("texel %d: cluster %d, expected %d", p, map[2 * p], expected);
        REQUIRE_REL(distance_of(&a->settings, &state[map[2 * p]], t, p), least, 1e-5);
    }
    REQUIRE_CMP(lit, >, texels / 2);
    REQUIRE_CMP(others, <=, 1e-4 * lit);
    if (nearest_cover)
        REQUIRE_NEAR(uncovered, 0, 0);
}

struct sums {
    double position[3], normal[3], flux[3], uv[2], importance, count, farthest, squares;
};

static void sum_cluster(const struct acrsm_texels *t, const int32_t *map, int i,
                        const struct acrsm_cluster *before, struct sums *s)
{
    const int n = t->resolution;
    *s = (struct sums){0};
    for (int p = 0; p < n * n; p++) {
        if (map[2 * p] != i)
            continue;
        const float *x = acrsm_texel(&t->position, p);
        for (int k = 0; k < 3; k++) {
            s->position[k] += x[k];
            s->normal[k] += acrsm_texel(&t->normal, p)[k];
            s->flux[k] += acrsm_texel(&t->flux, p)[k];
            s->squares +=
                ((double)x[k] - before->position[k]) * ((double)x[k] - before->position[k]);
        }
        s->uv[0] += (p % n + 0.5) / n;
        s->uv[1] += (p / n + 0.5) / n;
        s->importance += *acrsm_texel(&t->importance, p);
        s->farthest = fmax(s->farthest, apart(x, before->position));
        s->count++;
    }
}

/* pi r^2 of the farthest texel from the centre that it was mapped to, or 2 pi sigma^2 about the
 * mean. */
static double expected_area(const struct acrsm_fixture *a, const struct sums *s,
                            const struct acrsm_cluster *before)
{
    double moved2 = 0;
    for (int k = 0; k < 3; k++)
        moved2 += pow(s->position[k] / s->count - before->position[k], 2);
    return a->settings.area == ACRSM_AREA_MAX ? M_PI * s->farthest * s->farthest
                                              : 2 * M_PI * (s->squares / s->count - moved2);
}

static void check_average(const struct acrsm_fixture *a, const struct acrsm_cluster *before,
                          const struct acrsm_cluster *after, const struct sums *s)
{
    double length = 0, texel = a->f.rsm->half_extent * 2 / a->resolution * 3; /* m, at most */
    REQUIRE_NEAR(after->count, s->count, 0);
    for (int k = 0; k < 3; k++) {
        REQUIRE_NEAR(after->position[k], s->position[k] / s->count, 1e-4 * a->settings.extent);
        REQUIRE_REL(after->flux[k], s->flux[k], 1e-4);
        length += s->normal[k] * s->normal[k];
    }
    length = sqrt(length);
    REQUIRE_CMP(length, >, 0);
    for (int k = 0; k < 3; k++)
        REQUIRE_NEAR(after->normal[k], s->normal[k] / length, 1e-4);
    for (int k = 0; k < 2; k++)
        REQUIRE_NEAR(after->uv[k], s->uv[k] / s->count, 1e-4);
    REQUIRE_REL(after->importance, s->importance / s->count, 1e-4);
    REQUIRE_NEAR(after->area, expected_area(a, s, before),
                 1e-4 * expected_area(a, s, before) + texel * texel);
}

static void check_frame(struct acrsm_fixture *a)
{
    struct acrsm_cluster before[ACRSM_CLUSTERS_MOST], after[ACRSM_CLUSTERS_MOST];
    acrsm_fixture_begin_frame(a);
    acrsm_fixture_state(a, before);
    acrsm_fixture_end_frame(a);
    acrsm_fixture_state(a, after);
    int32_t *map = acrsm_fixture_map(a);
    struct acrsm_texels t = acrsm_fixture_texels(a);
    check_mapping(a, before, map, &t);
    int in_use = 0;
    for (int i = 0; i < a->settings.clusters; i++) {
        struct sums sums;
        sum_cluster(&t, map, i, &before[i], &sums);
        if (sums.count > 0) {
            check_average(a, &before[i], &after[i], &sums);
            in_use++;
        } else {
            REQUIRE_CMP(after[i].count, <=, 0);
        }
    }
    REQUIRE_CMP(in_use, >=, 0.9 * a->settings.clusters);
    acrsm_texels_destroy(&t);
    free(map);
}

/* Every switch of mapping and averaging, on the frames of a light that turns from wall to wall. */
static void test_brute_force(void **state)
{
    (void)state;
    const struct {
        int clusters, resolution, cover, normals, area;
    } cases[] = {
        {128, 112, ACRSM_COVER_SQUARE, ACRSM_NORMALS_ABS, ACRSM_AREA_MAX},
        {16, 64, ACRSM_COVER_SQUARE, ACRSM_NORMALS_SIGNED, ACRSM_AREA_MOMENT},
        {16, 64, ACRSM_COVER_NEAREST, ACRSM_NORMALS_ABS, ACRSM_AREA_MOMENT},
        {512, 100, ACRSM_COVER_NEAREST, ACRSM_NORMALS_SIGNED, ACRSM_AREA_MAX},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct acrsm_fixture a;
        acrsm_fixture_create(&a, gl, fixture_scene("cornell-objects"), cases[i].resolution,
                             cases[i].clusters);
        a.settings.cover = cases[i].cover;
        a.settings.normals = cases[i].normals;
        a.settings.area = cases[i].area;
        for (int frame = 0; frame < 3; frame++) {
            struct irb_light light = acrsm_fixture_light(0.3 + 0.02 * frame);
            acrsm_fixture_rsm(&a, &light);
            check_frame(&a);
        }
        acrsm_fixture_destroy(&a);
    }
}

/* One cluster over a map of so many tiles that its sums take several dispatches (core/gl/context.h,
 * IRB_LOOP_ROUNDS_MOST): a beam, since a cone leaves the map's corners dark. An invocation adds
 * 65536 texels in float32, equal ones, so that roundings of 2^-24 of the sum may all go one way:
 * half as many, 2e-3 of the last sum. */
static void test_large_map(void **state)
{
    (void)state;
    enum { SIDE = 2048 };
    struct acrsm_fixture a;
    struct acrsm_cluster clusters[ACRSM_CLUSTERS_MOST];
    double flux[3] = {0}, lit = 0;
    acrsm_fixture_create(&a, gl, fixture_scene("cornell"), SIDE, 1);
    a.settings.cover = ACRSM_COVER_NEAREST;
    struct irb_light light = acrsm_fixture_light(0.3);
    light.type = IRB_LIGHT_DIRECTIONAL;
    light.half_width = 0.1f; /* m */
    acrsm_fixture_rsm(&a, &light);
    acrsm_fixture_frame(&a);
    acrsm_fixture_state(&a, clusters);
    struct irb_image texels = fixture_read(a.f.rsm->flux, 4);
    for (size_t p = 0; p < irb_image_pixels(&texels); p++) {
        const float *phi = texels.data + 4 * p;
        lit += phi[0] > 0 || phi[1] > 0 || phi[2] > 0;
        for (int k = 0; k < 3; k++)
            flux[k] += phi[k];
    }
    print_message("one cluster of %d of %g lit texels\n", clusters[0].count, lit);
    REQUIRE_NEAR(lit, SIDE * SIDE, 0);
    REQUIRE_NEAR(clusters[0].count, lit, 0);
    for (int k = 0; k < 3; k++)
        REQUIRE_REL(clusters[0].flux[k], flux[k], 2e-3);
    irb_image_destroy(&texels);
    acrsm_fixture_destroy(&a);
}

/* Uncovered texels are those in no square; the flux of the lights and theirs is that of the RSM. */
static void check_conservation(struct acrsm_fixture *a)
{
    struct acrsm_report report = acrsm_fixture_report(a);
    struct acrsm_texels t = acrsm_fixture_texels(a);
    int32_t *map = acrsm_fixture_map(a);
    float lights[ACRSM_CLUSTERS_MOST][12];
    struct irb_error err = {0};
    double total = 0, lost = 0;
    REQUIRE_OK(irb_buffer_read(a->clusters->lights, 0, sizeof lights, lights, &err));
    for (int c = 0; c < 3; c++) {
        double channel = 0, channel_lost = 0, emitted = 0;
        for (int p = 0; p < a->resolution * a->resolution; p++) {
            channel += acrsm_texel(&t.flux, p)[c];
            channel_lost += map[2 * p] == IRB_CLUSTER_NONE ? acrsm_texel(&t.flux, p)[c] : 0;
        }
        for (int i = 0; i < a->settings.clusters; i++)
            emitted += lights[i][8 + c];
        REQUIRE_REL(emitted + channel_lost, channel, 1e-3);
        total += channel;
        lost += channel_lost;
    }
    REQUIRE_NEAR(report.uncovered, lost / total, 1e-5);
    REQUIRE_NEAR(report.gain, 0, 1e-5);
    for (int i = a->settings.clusters; i < ACRSM_CLUSTERS_MOST; i++)
        for (int c = 8; c < 12; c++)
            REQUIRE_NEAR(lights[i][c], 0, 0);
    free(map);
    acrsm_texels_destroy(&t);
}

/* The light rests, turns to the other wall, and rests. At rest every cluster is in use; on the way
 * a few vanish in each frame and are seeded again in the next. */
static void test_moving_light(void **state)
{
    (void)state;
    enum { REST = 6, TURN = 30, FRAMES = REST + TURN + REST };
    struct acrsm_fixture a;
    acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 128, 128);
    double in_use = 0, uncovered = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        const double t = fmin(fmax(frame - REST, 0) / TURN, 1);
        struct irb_light light = acrsm_fixture_light(t);
        acrsm_fixture_rsm(&a, &light);
        acrsm_fixture_frame(&a);
        check_conservation(&a);
        struct acrsm_report report = acrsm_fixture_report(&a);
        REQUIRE_CMP(report.in_use, >=, 0.85 * 128);
        if (t == 0)
            REQUIRE_CMP(report.in_use, >=, 0.99 * 128);
        in_use += report.in_use / 128.0 / FRAMES;
        uncovered += report.uncovered / FRAMES;
    }
    REQUIRE_CMP(in_use, >=, 0.95);
    REQUIRE_CMP(uncovered, <, 0.005);
    acrsm_fixture_destroy(&a);
}

/* What the lights of each kind of flux carry, from the state. */
static void test_lights(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct acrsm_fixture a;
    struct acrsm_cluster clusters[ACRSM_CLUSTERS_MOST];
    float lights[ACRSM_CLUSTERS_MOST][12];
    acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 96, 100);
    struct irb_light light = acrsm_fixture_light(0.2);
    acrsm_fixture_rsm(&a, &light);
    for (int flux = ACRSM_FLUX_SUM; flux <= ACRSM_FLUX_CENTER_AREA; flux++) {
        double area = 0, texels = 0;
        a.settings.flux = flux;
        acrsm_fixture_frame(&a);
        acrsm_fixture_state(&a, clusters);
        struct irb_image rsm_flux = fixture_read(a.f.rsm->flux, 4);
        REQUIRE_OK(irb_buffer_read(a.clusters->lights, 0, sizeof lights, lights, &err));
        for (int i = 0; i < 100; i++) {
            area += clusters[i].count > 0 ? clusters[i].area : 0;
            texels += clusters[i].count > 0 ? clusters[i].count : 0;
        }
        for (int i = 0; i < 100; i++) {
            if (clusters[i].count <= 0)
                continue;
            const float *centre = acrsm_texel(&rsm_flux, acrsm_centre_y(&clusters[i], 96) * 96 +
                                                             acrsm_centre_x(&clusters[i], 96));
            assert_memory_equal(lights[i], clusters[i].position, 12);
            assert_memory_equal(lights[i] + 4, clusters[i].normal, 12);
            REQUIRE_NEAR(lights[i][3], clusters[i].area, 0);
            for (int c = 0; c < 3; c++) {
                const double expected[] = {clusters[i].flux[c],
                                           (double)centre[c] * clusters[i].count,
                                           centre[c] * texels * clusters[i].area / area};
                REQUIRE_REL(lights[i][8 + c], expected[flux], 1e-4);
            }
        }
        irb_image_destroy(&rsm_flux);
    }
    acrsm_fixture_destroy(&a);
}

static void require_places(const struct acrsm_fixture *a, const struct acrsm_cluster *before,
                           const struct acrsm_cluster *after)
{
    const float *from = a->f.light.position;
    for (int i = 0; i < a->settings.clusters; i++) {
        if (before[i].count <= 0)
            continue;
        REQUIRE_NEAR(apart(after[i].position, from), apart(before[i].position, from), 1e-5);
        REQUIRE_NEAR(fixture_dot(after[i].normal, after[i].normal), 1, 1e-5);
    }
}

/* Clusters that rest in the light's view keep uv and distance while it turns; those that rest in
 * the world keep their position and get the uv where it is now seen: that texel's point is near. */
static void test_carry(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct acrsm_cluster before[ACRSM_CLUSTERS_MOST], after[ACRSM_CLUSTERS_MOST];
    for (int space = ACRSM_SPACE_LIGHT; space <= ACRSM_SPACE_WORLD; space++) {
        struct acrsm_fixture a;
        acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 128, 64);
        a.settings.space = space;
        for (int frame = 0; frame < 8; frame++) {
            struct irb_light light = acrsm_fixture_light(0);
            acrsm_fixture_rsm(&a, &light);
            acrsm_fixture_frame(&a);
        }
        acrsm_fixture_state(&a, before);
        struct irb_light turned = acrsm_fixture_light(0.1);
        acrsm_fixture_rsm(&a, &turned);
        REQUIRE_OK(acrsm_clusters_frame(a.clusters, a.f.rsm, &a.settings, &err));
        REQUIRE_OK(acrsm_carry(a.clusters, a.f.rsm, &a.settings, &err));
        acrsm_fixture_state(&a, after);
        require_places(&a, before, after);
        struct irb_image position = fixture_read(a.f.rsm->position, 4);
        int seen = 0;
        for (int i = 0; i < 64; i++) {
            if (space == ACRSM_SPACE_LIGHT) {
                assert_memory_equal(before[i].uv, after[i].uv, sizeof before[i].uv);
                continue;
            }
            assert_memory_equal(before[i].position, after[i].position, 12);
            if (after[i].count <= 0)
                continue;
            int p = acrsm_centre_y(&after[i], 128) * 128 + acrsm_centre_x(&after[i], 128);
            seen += apart(acrsm_texel(&position, p), after[i].position) < 0.02;
        }
        if (space == ACRSM_SPACE_WORLD)
            REQUIRE_CMP(seen, >, 40); /* some were on what is hidden or outside now */
        irb_image_destroy(&position);
        acrsm_fixture_destroy(&a);
    }
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_brute_force),  cmocka_unit_test(test_large_map),
        cmocka_unit_test(test_moving_light), cmocka_unit_test(test_lights),
        cmocka_unit_test(test_carry),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
