/* SPDX-License-Identifier: MIT
 *
 * The evaluation of acrsm (eqs 4.6-4.8) and its lists against a transcription of the thesis (5.3.1)
 * that goes through the texels of the cluster map; seeding; a changing number of clusters.
 */
#include "tests/support/compare.h"
#include "tests/methods/acrsm_fixture.h"

static struct irb_gl *gl;

enum { VANISHED = 0, SPLIT = -2, PLACED = -3 }; /* instead of a count */

struct evaluation {
    struct acrsm_verification verifications[ACRSM_CLUSTERS_MOST];
    uint32_t order[ACRSM_CLUSTERS_MOST];
};

/* One evaluation: state before and after it, and what it left. */
struct step {
    struct acrsm_cluster before[ACRSM_CLUSTERS_MOST], after[ACRSM_CLUSTERS_MOST];
    struct evaluation evaluation;
    int32_t *map; /* of the last frame */
};

static void evaluate(struct acrsm_fixture *a, struct step *s)
{
    struct irb_error err = {0};
    s->map = acrsm_fixture_map(a);
    acrsm_fixture_state(a, s->before);
    REQUIRE_OK(acrsm_clusters_frame(a->clusters, a->f.rsm, &a->settings, &err));
    REQUIRE_OK(acrsm_evaluate(a->clusters, a->f.rsm, &a->settings, &err));
    acrsm_fixture_state(a, s->after);
    REQUIRE_OK(
        irb_buffer_read(a->clusters->evaluation, 0, sizeof s->evaluation, &s->evaluation, &err));
}

static double delta_of(const struct acrsm_fixture *a, const struct step *s, int i)
{
    double most = 0;
    for (int j = 0; j < a->settings.clusters; j++)
        if (s->before[j].count > 0)
            most = fmax(most, s->before[j].area);
    return most > 0 ? s->before[i].area / most * s->before[i].importance : 0;
}

/* Sums over the other centres that the map shows in the square of twice the side (table 5.2). */
static void verify(const struct acrsm_fixture *a, const struct step *s, int i, double *squares,
                   double *sum)
{
    const int n = a->resolution, side = 2 * a->settings.square;
    *squares = *sum = 0;
    for (int p = 0; p < n * n; p++) {
        int j = s->map[2 * p + 1];
        if (j == IRB_CLUSTER_NONE || j == i ||
            !acrsm_in_square(&s->before[i], p % n, p / n, side, n))
            continue;
        double delta = delta_of(a, s, j);
        *squares += delta * delta;
        *sum += delta;
    }
}

/* Eqs 4.7, 4.8 over the GPU's own sums, which are checked apart. */
static double imbalance(const struct step *s, uint32_t i)
{
    const struct acrsm_verification *v = &s->evaluation.verifications[i];
    return v->sum > 0 ? v->delta - v->sum_squares / v->sum : 0;
}

static void check_verification(const struct acrsm_fixture *a, const struct step *s)
{
    for (int i = 0; i < a->settings.clusters; i++) {
        const struct acrsm_verification *v = &s->evaluation.verifications[i];
        double squares, sum;
        if (s->before[i].count <= 0)
            continue;
        verify(a, s, i, &squares, &sum);
        REQUIRE_REL(v->delta, delta_of(a, s, i), 1e-5);
        REQUIRE_NEAR(v->sum_squares, squares, 1e-4 * squares + 1e-9);
        REQUIRE_NEAR(v->sum, sum, 1e-4 * sum + 1e-9);
    }
}

/* The random order is a permutation. */
static void check_order(const struct acrsm_fixture *a, const struct step *s)
{
    bool seen[ACRSM_CLUSTERS_MOST] = {0};
    for (int r = 0; r < a->settings.clusters; r++) {
        uint32_t i = s->evaluation.order[r];
        REQUIRE_CMP(i, <, a->settings.clusters);
        assert_false(seen[i]);
        seen[i] = true;
    }
}

/* The seed of a split lies on a texel of the cluster that is split, not on a centre. */
static bool lies_inside(const struct acrsm_fixture *a, const struct step *s, uint32_t seed,
                        uint32_t parent)
{
    const struct acrsm_cluster *c = &s->after[seed];
    const int p =
        acrsm_centre_y(c, a->resolution) * a->resolution + acrsm_centre_x(c, a->resolution);
    return s->map[2 * p] == (int)parent && s->map[2 * p + 1] == IRB_CLUSTER_NONE;
}

struct counts {
    int merged, split, refused;
};

/* Fig. 5.6, step by step. */
static struct counts check_lists(const struct acrsm_fixture *a, const struct step *s)
{
    const int selected = a->settings.clusters / 3;
    uint32_t free_list[ACRSM_CLUSTERS_MOST];
    int free_count = 0;
    bool touched[ACRSM_CLUSTERS_MOST] = {0};
    struct counts counts = {0};
    for (int r = 0; r < selected; r++) {
        uint32_t i = s->evaluation.order[r];
        if (s->before[i].count > 0 && imbalance(s, i) < -a->settings.merge)
            touched[free_list[free_count++] = i] = true;
    }
    counts.merged = free_count;
    for (int r = 0; r < selected && free_count > 0; r++) {
        uint32_t i = s->evaluation.order[r], j = free_list[free_count - 1];
        if (s->before[i].count <= 0 || !(imbalance(s, i) > a->settings.split))
            continue;
        if (s->after[j].count == SPLIT && lies_inside(a, s, j, i)) {
            free_count--;
            counts.split++;
        } else {
            counts.refused++; /* no texel of it is lit any more */
        }
    }
    for (int f = 0; f < free_count; f++)
        REQUIRE_NEAR(s->after[free_list[f]].count, VANISHED, 0);
    for (int i = 0; i < a->settings.clusters; i++)
        if (!touched[i])
            assert_memory_equal(&s->before[i], &s->after[i], sizeof s->before[i]);
    return counts;
}

/* Both ways to find the neighbours, thresholds at which much happens and the thesis's. */
static void test_decisions(void **state)
{
    (void)state;
    const struct {
        int neighbours;
        float merge, split;
        int least_merged, least_split;
    } cases[] = {{ACRSM_NEIGHBOURS_LIST, 0.1f, 0.02f, 20, 10},
                 {ACRSM_NEIGHBOURS_MAP, 0.1f, 0.02f, 20, 10},
                 {ACRSM_NEIGHBOURS_LIST, 0.4f, 0.15f, 1, 0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct acrsm_fixture a;
        struct counts all = {0};
        acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 96, 64);
        a.settings.neighbours = cases[k].neighbours;
        a.settings.merge = cases[k].merge;
        a.settings.split = cases[k].split;
        for (int frame = 0; frame < 16; frame++) {
            struct irb_light light = acrsm_fixture_light(0.05 * frame);
            acrsm_fixture_rsm(&a, &light);
            if (frame > 0) {
                struct step s;
                evaluate(&a, &s);
                check_verification(&a, &s);
                check_order(&a, &s);
                struct counts counts = check_lists(&a, &s);
                all.merged += counts.merged;
                all.split += counts.split;
                all.refused += counts.refused;
                free(s.map);
            }
            acrsm_fixture_frame(&a);
        }
        REQUIRE_CMP(all.merged, >=, cases[k].least_merged);
        REQUIRE_CMP(all.split, >=, cases[k].least_split);
        REQUIRE_CMP(all.refused, <=, 0.1 * all.split + 2);
        acrsm_fixture_destroy(&a);
    }
}

/* Neighbours from a square of so many texels that its sums take several dispatches
 * (core/gl/context.h, IRB_LOOP_ROUNDS_MOST). */
static void test_large_square(void **state)
{
    (void)state;
    struct acrsm_fixture a;
    struct step s;
    acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 2048, 16);
    a.settings.neighbours = ACRSM_NEIGHBOURS_MAP;
    a.settings.square = 2048;
    struct irb_light light = acrsm_fixture_light(0.3);
    acrsm_fixture_rsm(&a, &light);
    acrsm_fixture_frame(&a);
    evaluate(&a, &s);
    check_verification(&a, &s);
    check_order(&a, &s);
    free(s.map);
    acrsm_fixture_destroy(&a);
}

/* Without re-seeding nothing takes the clusters that no split took: they stay as they were, so that
 * evaluation changes no bit. */
static void test_no_reseed(void **state)
{
    (void)state;
    struct acrsm_cluster found[2][ACRSM_CLUSTERS_MOST];
    for (int adaptive = 0; adaptive < 2; adaptive++) {
        struct acrsm_fixture a;
        acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 96, 64);
        a.settings.adaptive = adaptive;
        a.settings.reseed = false;
        a.settings.merge = 0.02f;
        a.settings.split = 10; /* never */
        struct irb_light light = acrsm_fixture_light(0);
        for (int frame = 0; frame < 8; frame++) {
            acrsm_fixture_rsm(&a, &light);
            acrsm_fixture_frame(&a);
            struct acrsm_report report = acrsm_fixture_report(&a);
            REQUIRE_NEAR(report.merged + report.split + report.seeded, 0, 0);
        }
        acrsm_fixture_state(&a, found[adaptive]);
        acrsm_fixture_destroy(&a);
    }
    assert_memory_equal(found[0], found[1], sizeof found[0]);
}

/* What is seeded stands on a lit texel, with that texel's attributes; no two on the same one. */
static void test_seeds(void **state)
{
    (void)state;
    const int levels[] = {0, 3, 16};
    for (int k = 0; k < 3; k++) {
        struct acrsm_fixture a;
        struct acrsm_cluster seeded[ACRSM_CLUSTERS_MOST];
        acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 128, 128);
        a.settings.warp_levels = levels[k];
        struct irb_light light = acrsm_fixture_light(0.5);
        acrsm_fixture_rsm(&a, &light);
        acrsm_fixture_begin_frame(&a);
        acrsm_fixture_state(&a, seeded);
        struct acrsm_texels t = acrsm_fixture_texels(&a);
        int taken[128 * 128] = {0}, shared_texels = 0;
        for (int i = 0; i < 128; i++) {
            int p = acrsm_centre_y(&seeded[i], 128) * 128 + acrsm_centre_x(&seeded[i], 128);
            REQUIRE_NEAR(seeded[i].count, PLACED, 0);
            assert_true(acrsm_is_lit(&t, p));
            assert_memory_equal(seeded[i].position, acrsm_texel(&t.position, p), 12);
            assert_memory_equal(seeded[i].normal, acrsm_texel(&t.normal, p), 12);
            assert_memory_equal(&seeded[i].importance, acrsm_texel(&t.importance, p), 4);
            shared_texels += taken[p]++ > 0;
        }
        REQUIRE_CMP(shared_texels, <=, 1);
        acrsm_texels_destroy(&t);
        acrsm_fixture_destroy(&a);
    }
}

/* Light i goes to tile i mod 9 of the interleaved shading; each tile's clusters must be strewn over
 * all of the light's image. A Halton sequence in order would give each a ninth of its height. */
static void test_seeds_of_tiles(void **state)
{
    (void)state;
    enum { TILES = 9 };
    struct acrsm_fixture a;
    struct acrsm_cluster seeded[ACRSM_CLUSTERS_MOST];
    acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 128, 128);
    struct irb_light light = acrsm_fixture_light(0);
    acrsm_fixture_rsm(&a, &light);
    acrsm_fixture_begin_frame(&a);
    acrsm_fixture_state(&a, seeded);
    for (int tile = 0; tile < TILES; tile++)
        for (int axis = 0; axis < 2; axis++) {
            double low = 1, high = 0;
            for (int i = tile; i < 128; i += TILES) {
                low = fmin(low, seeded[i].uv[axis]);
                high = fmax(high, seeded[i].uv[axis]);
            }
            REQUIRE_CMP(high - low, >, 0.6);
        }
    acrsm_fixture_destroy(&a);
}

/* k from frame to frame: further clusters are seeded at once, the highest end, the others live on.
 */
static void test_changing_count(void **state)
{
    (void)state;
    const int counts[] = {64, 64, 200, 200, 16, 16, 512, 512, 100};
    struct acrsm_fixture a;
    struct acrsm_cluster before[ACRSM_CLUSTERS_MOST], after[ACRSM_CLUSTERS_MOST];
    acrsm_fixture_create(&a, gl, fixture_scene("cornell"), 128, 64);
    struct irb_light light = acrsm_fixture_light(0);
    acrsm_fixture_rsm(&a, &light);
    for (size_t frame = 0; frame < sizeof counts / sizeof *counts; frame++) {
        int last = a.clusters->active;
        a.settings.clusters = counts[frame];
        a.settings.adaptive = false;
        acrsm_fixture_state(&a, before);
        acrsm_fixture_begin_frame(&a);
        acrsm_fixture_state(&a, after);
        for (int i = 0; i < counts[frame]; i++)
            if (i < last && before[i].count > 0)
                assert_memory_equal(&before[i], &after[i], sizeof *before);
            else
                REQUIRE_NEAR(after[i].count, PLACED, 0);
        acrsm_fixture_end_frame(&a);
        struct acrsm_report report = acrsm_fixture_report(&a);
        REQUIRE_CMP(report.in_use, >=, 0.98 * counts[frame]);
        REQUIRE_NEAR(acrsm_clusters_lights(a.clusters).count, counts[frame], 0);
    }
    acrsm_fixture_destroy(&a);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_decisions),      cmocka_unit_test(test_no_reseed),
        cmocka_unit_test(test_large_square),   cmocka_unit_test(test_seeds),
        cmocka_unit_test(test_seeds_of_tiles), cmocka_unit_test(test_changing_count),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
