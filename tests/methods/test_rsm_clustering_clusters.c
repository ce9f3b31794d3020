/* SPDX-License-Identifier: MIT
 *
 * RSM clustering of Prutkin et al. 2012 against eq. 1 and the means in double precision, from the
 * RSM that is read back.
 */
#include "tests/support/compare.h"
#include "core/lights/importance.h"
#include "methods/rsm_clustering/clusters.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

/* The RSM, the clusters as the assignment saw them, and what came of them. Rows from the bottom. */
struct frame {
    struct irb_image position, normal, flux; /* top row first */
    int n, k;
    int *map; /* n^2 */
    struct rsc_cluster *before, *after;
};

static const struct rsc_settings cornell_settings = {
    .clusters = 256, .weight_distance = 1, .weight_normal = 10, .reach = 2, .reduction = RSC_SORT};
static const struct rsc_settings colour_settings = {.clusters = 200,
                                                    .weight_distance = 1,
                                                    .weight_normal = 1,
                                                    .weight_colour = 10,
                                                    .reach = 2,
                                                    .reduction = RSC_SORT};

static void make_scene(struct fixture_frame *f, const char *name, int resolution)
{
    fixture_frame_create(f, gl, fixture_scene(name), 64, 48, resolution);
    fixture_view(f->scene, &f->light, &f->camera);
    f->light.position[0] += 0.05f; /* off the middle, so that nothing is symmetric */
    fixture_frame_render(f);
}

static int *read_map(const struct rsc_clusters *c)
{
    const int n = c->resolution;
    int *map = malloc(4 * (size_t)n * (size_t)n);
    gl->api.GetTextureImage(c->map->id, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, 4 * n * n, map);
    return map;
}

static struct rsc_cluster *read_clusters(const struct rsc_clusters *c)
{
    struct irb_error err = {0};
    const size_t bytes = (size_t)c->count * sizeof(struct rsc_cluster);
    struct rsc_cluster *clusters = malloc(bytes);
    REQUIRE_OK(irb_buffer_read(c->clusters, 0, (int64_t)bytes, clusters, &err));
    return clusters;
}

static struct irb_pyramid *make_pyramid(const struct fixture_frame *f)
{
    struct irb_error err = {0};
    const struct irb_importance_settings settings = {.diffuse_weight = 1,
                                                     .view_weight = 0.99f,
                                                     .view_samples = 256,
                                                     .view_form = IRB_IMPORTANCE_GEOMETRY,
                                                     .view_nearest = 0.1f};
    struct irb_importance *importance = irb_importance_create(gl, f->rsm->resolution, &err);
    struct irb_pyramid *pyramid = irb_pyramid_create(gl, f->rsm->resolution, &err);
    REQUIRE_OK(importance && pyramid);
    REQUIRE_OK(irb_importance_compute(importance, f->rsm, &f->light, f->gbuffer, &settings, &err));
    REQUIRE_OK(irb_pyramid_build(pyramid, importance->map, &err));
    irb_importance_destroy(importance);
    return pyramid;
}

static void seed(struct rsc_clusters *c, const struct fixture_frame *f,
                 const struct rsc_settings *settings)
{
    struct irb_error err = {0};
    struct irb_pyramid *pyramid = make_pyramid(f);
    REQUIRE_OK(rsc_clusters_prepare(c, settings, &err));
    REQUIRE_OK(rsc_clusters_seed(c, f->rsm, pyramid, settings, &err));
    REQUIRE_OK(rsc_clusters_grid(c, settings, &err));
    irb_pyramid_destroy(pyramid);
}

static void update(struct rsc_clusters *c, const struct irb_rsm *rsm,
                   const struct rsc_settings *settings)
{
    struct irb_error err = {0};
    REQUIRE_OK(rsc_clusters_sort(c, rsm, settings, &err));
    REQUIRE_OK(rsc_clusters_update(c, rsm, settings, &err));
}

/* One frame of clustering, everything read back. */
static struct frame cluster(struct rsc_clusters *c, const struct fixture_frame *f,
                            const struct rsc_settings *settings)
{
    struct irb_error err = {0};
    struct frame out = {.n = c->resolution, .k = settings->clusters};
    seed(c, f, settings);
    out.before = read_clusters(c);
    REQUIRE_OK(rsc_clusters_assign(c, f->rsm, settings, &err));
    update(c, f->rsm, settings);
    out.after = read_clusters(c);
    out.map = read_map(c);
    out.position = fixture_read(f->rsm->position, 4);
    out.normal = fixture_read(f->rsm->normal, 4);
    out.flux = fixture_read(f->rsm->flux, 4);
    return out;
}

static void frame_destroy(struct frame *f)
{
    irb_image_destroy(&f->position);
    irb_image_destroy(&f->normal);
    irb_image_destroy(&f->flux);
    free(f->map);
    free(f->before);
    free(f->after);
}

static struct rsc_clusters *create(const struct fixture_frame *f)
{
    struct irb_error err = {0};
    struct rsc_clusters *c = rsc_clusters_create(gl, f->rsm->resolution, &err);
    REQUIRE_OK(c);
    return c;
}

/* Texel i of the map, which starts at the bottom, in an image. */
static const float *texel(const struct frame *f, const struct irb_image *image, int i)
{
    return irb_image_at(image, i % f->n, f->n - 1 - i / f->n);
}

static bool is_lit(const float flux[3])
{
    return flux[0] > 0 || flux[1] > 0 || flux[2] > 0;
}

/* Eq. 1 */
static double difference(const struct frame *f, int i, const struct rsc_cluster *c,
                         const struct rsc_settings *s)
{
    const float *x = texel(f, &f->position, i), *n = texel(f, &f->normal, i);
    const float *phi = texel(f, &f->flux, i);
    double lengths[2] = {0}, distance2 = 0, cosine = 0, colour2 = 0;
    for (int m = 0; m < 3; m++) {
        distance2 += ((double)x[m] - c->centre[m]) * ((double)x[m] - c->centre[m]);
        cosine += (double)n[m] * c->normal[m];
        lengths[0] += (double)phi[m] * phi[m];
        lengths[1] += (double)c->flux[m] * c->flux[m];
    }
    for (int m = 0; m < 3; m++) {
        double d = phi[m] / sqrt(lengths[0]) - c->flux[m] / sqrt(lengths[1]);
        colour2 += d * d;
    }
    return (double)s->weight_distance * distance2 + (double)s->weight_normal * (1 - cosine) +
           (double)s->weight_colour * colour2;
}

/* Least difference to any cluster that takes part; -1 without one. */
static double least_difference(const struct frame *f, int i, const struct rsc_settings *s, int *id)
{
    double least = INFINITY;
    *id = -1;
    for (int c = 0; c < f->k; c++) {
        if (f->before[c].cell[0] < 0)
            continue;
        double mu = difference(f, i, &f->before[c], s);
        if (mu < least) {
            least = mu;
            *id = c;
        }
    }
    return least;
}

struct agreement {
    int lit, uncovered;
    int other; /* texels that have not the cluster of the arg min */
    int wrong; /* those of them that rounding does not explain */
};

/* What float32 makes of eq. 1, in units of 1 + mu. */
static const double rounding = 2e-6;

static struct agreement compare_brute(const struct frame *f, const struct rsc_settings *s)
{
    struct agreement a = {0};
    for (int i = 0; i < f->n * f->n; i++) {
        int best;
        if (!is_lit(texel(f, &f->flux, i))) {
            assert_int_equal(f->map[i], IRB_CLUSTER_UNLIT);
            continue;
        }
        a.lit++;
        a.uncovered += f->map[i] == IRB_CLUSTER_NONE;
        if (f->map[i] == IRB_CLUSTER_NONE)
            continue;
        REQUIRE_CMP(f->map[i], >=, 0);
        REQUIRE_CMP(f->map[i], <, f->k);
        double least = least_difference(f, i, s, &best);
        double mu = difference(f, i, &f->before[f->map[i]], s);
        a.other += f->map[i] != best;
        a.wrong += mu > least + rounding * (1 + least);
    }
    return a;
}

/* All clusters as candidates give the arg min, up to rounding. The grid gives it the more often the
 * further it reaches, and from r = 1 on leaves no texel without a candidate. */
static void test_assignment(void **state)
{
    (void)state;
    static const struct {
        const char *scene;
        const struct rsc_settings *settings;
    } kinds[] = {
        {"cornell", &cornell_settings}, {"cornell", &colour_settings}, {"hall", &colour_settings}};
    for (int kind = 0; kind < 3; kind++) {
        struct fixture_frame f;
        make_scene(&f, kinds[kind].scene, 96);
        struct rsc_clusters *c = create(&f);
        const double most[] = {0, 1, 0.05, 0.01, 0.005}; /* by r + 1 */
        for (int reach = -1; reach <= 3; reach++) {
            struct rsc_settings s = *kinds[kind].settings;
            s.reach = reach;
            rsc_clusters_forget(c);
            for (int frame = 0; frame < 2; frame++) {
                struct frame r = cluster(c, &f, &s);
                struct agreement a = compare_brute(&r, &s);
                print_message("%s, w_n %g, r %d, frame %d: of %d lit texels %.2f %% have another "
                              "cluster than by brute force, %.2f %% none\n",
                              kinds[kind].scene, (double)s.weight_normal, reach, frame, a.lit,
                              100.0 * a.wrong / a.lit, 100.0 * a.uncovered / a.lit);
                REQUIRE_CMP(a.lit, >, 3000);
                REQUIRE_CMP(a.wrong, <=, most[reach + 1] * a.lit);
                if (reach < 0) /* as good as ties: centimetres squared against w_n and w_phi */
                    REQUIRE_CMP(a.other, <, 0.01 * a.lit);
                if (reach)
                    REQUIRE_NEAR(a.uncovered, 0, 0);
                frame_destroy(&r);
            }
        }
        rsc_clusters_destroy(c);
        fixture_frame_destroy(&f);
    }
}

/* Means and sums of each cluster's texels in double precision. */
static void check_means(const struct frame *f, const struct fixture_frame *scene)
{
    double *sum = calloc((size_t)f->k * 8, sizeof *sum), flux[3] = {0}, uncovered[3] = {0};
    for (int i = 0; i < f->n * f->n; i++) {
        const float *x = texel(f, &f->position, i), *n = texel(f, &f->normal, i);
        const float *phi = texel(f, &f->flux, i);
        const double w = (double)phi[0] + phi[1] + phi[2];
        for (int m = 0; m < 3; m++) {
            flux[m] += phi[m];
            uncovered[m] += f->map[i] == IRB_CLUSTER_NONE ? phi[m] : 0;
            if (f->map[i] >= 0) {
                sum[8 * f->map[i] + m] += w * x[m];
                sum[8 * f->map[i] + 3 + m] += w * n[m];
            }
        }
        if (f->map[i] >= 0) {
            sum[8 * f->map[i] + 6] += w;
            sum[8 * f->map[i] + 7]++;
        }
    }
    double found[3] = {0}, size = (double)irb_scene_diagonal(scene->scene);
    for (int i = 0; i < f->k; i++) {
        const struct rsc_cluster *c = &f->after[i];
        const double *s = sum + 8 * i, length = sqrt(s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
        REQUIRE_NEAR(c->texels, s[7], 0);
        if (s[7] == 0) {
            REQUIRE_NEAR(c->flux[0] + c->flux[1] + c->flux[2], 0, 0);
            continue;
        }
        REQUIRE_REL((double)c->flux[0] + c->flux[1] + c->flux[2], s[6], 1e-5);
        for (int m = 0; m < 3; m++) {
            found[m] += c->flux[m];
            REQUIRE_NEAR(c->centre[m], s[m] / s[6], 1e-5 * size);
            if (length > 0.01 * s[6])
                REQUIRE_NEAR(c->normal[m], s[3 + m] / length, 1e-5);
        }
    }
    for (int m = 0; m < 3; m++) /* nothing is lost on the way */
        REQUIRE_NEAR(found[m] + uncovered[m], flux[m], 1e-5 * (flux[m] + 1e-12));
    free(sum);
}

/* The three ways to find a cluster's texels add up the same numbers in the same order. */
static void test_update(void **state)
{
    (void)state;
    const int counts[] = {1, 2, 30, 256, 1024, 5000};
    struct fixture_frame f;
    make_scene(&f, "cornell", 64);
    struct rsc_clusters *c = create(&f);
    for (int kind = 0; kind < 6; kind++) {
        struct frame frames[3];
        for (int reduction = RSC_SORT; reduction <= RSC_DIRECT; reduction++) {
            struct rsc_settings s = cornell_settings;
            rsc_clusters_forget(c);
            s.clusters = counts[kind];
            s.reduction = (enum rsc_reduction)reduction;
            s.reach = kind == 2 ? 0 : 2; /* some texels are uncovered */
            for (int i = 0; i < 2; i++) {
                frames[reduction] = cluster(c, &f, &s);
                check_means(&frames[reduction], &f);
                if (i == 0)
                    frame_destroy(&frames[reduction]);
            }
        }
        for (int i = 1; i < 3; i++) {
            assert_memory_equal(frames[i].map, frames[0].map, 4 * 64 * 64);
            assert_memory_equal(frames[i].after, frames[0].after,
                                (size_t)counts[kind] * sizeof(struct rsc_cluster));
        }
        for (int i = 0; i < 3; i++)
            frame_destroy(&frames[i]);
    }
    rsc_clusters_destroy(c);
    fixture_frame_destroy(&f);
}

static struct rsc_census census(struct rsc_clusters *c, const struct irb_rsm *rsm)
{
    struct irb_error err = {0};
    struct rsc_census out;
    REQUIRE_OK(rsc_clusters_count(c, rsm, &out, &err));
    return out;
}

/* All are seeded in the first frame; later those that were left empty, and they alone; the others
 * start where they were. More clusters: the new ones are seeded. After forgetting, all again. */
static void test_history(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_scene(&f, "cornell", 64);
    struct rsc_clusters *c = create(&f);
    struct rsc_settings s = cornell_settings;
    int empty = s.clusters;
    for (int i = 0; i < 5; i++) {
        struct frame r = cluster(c, &f, &s);
        struct rsc_census n = census(c, f.rsm);
        REQUIRE_NEAR(n.seeded, empty, 0);
        empty = 0;
        for (int k = 0; k < r.k; k++)
            empty += r.after[k].texels == 0;
        REQUIRE_NEAR(n.in_use, r.k - empty, 0);
        REQUIRE_REL(n.texels.flux,
                    (fixture_sum(&r.flux, 0) + fixture_sum(&r.flux, 1) + fixture_sum(&r.flux, 2)) /
                        3,
                    1e-5);
        frame_destroy(&r);
        if (i == 2) {
            s.clusters = 300;
            empty += 300 - r.k;
        }
    }
    rsc_clusters_forget(c);
    struct frame r = cluster(c, &f, &s);
    REQUIRE_NEAR(census(c, f.rsm).seeded, 300, 0);
    frame_destroy(&r);
    /* the light turns to where no centre was: as good as empty */
    struct irb_error err = {0};
    f.light.direction[0] = 1;
    f.light.direction[1] = f.light.direction[2] = 0;
    REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &f.light, &err));
    r = cluster(c, &f, &s);
    REQUIRE_CMP(census(c, f.rsm).seeded, >, 200);
    REQUIRE_CMP(census(c, f.rsm).in_use, >, 50);
    check_means(&r, &f);
    frame_destroy(&r);
    rsc_clusters_destroy(c);
    fixture_frame_destroy(&f);
}

static void fill(const struct irb_texture *texture, const struct irb_image *image)
{
    struct irb_error err = {0};
    REQUIRE_OK(irb_texture_write((struct irb_texture *)texture, image, &err));
}

/* Keeps the flux of the texels for which `keep`; the importance of the others is 0 too. */
static void darken(struct fixture_frame *f, bool (*keep)(int x, int y))
{
    struct irb_image flux = fixture_read(f->rsm->flux, 4);
    for (int y = 0; y < flux.height; y++)
        for (int x = 0; x < flux.width; x++)
            if (!keep(x, y))
                memset(irb_image_at(&flux, x, y), 0, 12);
    fill(f->rsm->flux, &flux);
    irb_image_destroy(&flux);
}

static bool keep_none(int x, int y)
{
    (void)x, (void)y;
    return false;
}

static bool keep_one(int x, int y)
{
    return x == 30 && y == 32;
}

static bool keep_few(int x, int y)
{
    return x % 20 == 12 && y % 20 == 10;
}

/* No lit texel, one, a few; one cluster, many more clusters than texels. Nothing is NaN, no flux is
 * lost, and with no lit texel no cluster takes part. */
static void test_few_texels(void **state)
{
    (void)state;
    bool (*const kinds[])(int, int) = {keep_none, keep_one, keep_few};
    const int counts[] = {1, 7, 1024};
    for (int kind = 0; kind < 3; kind++) {
        struct fixture_frame f;
        make_scene(&f, "cornell", 64);
        darken(&f, kinds[kind]);
        struct rsc_clusters *c = create(&f);
        for (int count = 0; count < 3; count++)
            for (int reduction = RSC_SORT; reduction <= RSC_DIRECT; reduction++) {
                struct rsc_settings s = colour_settings;
                rsc_clusters_forget(c);
                s.clusters = counts[count];
                s.reduction = (enum rsc_reduction)reduction;
                for (int i = 0; i < 3; i++) {
                    struct frame r = cluster(c, &f, &s);
                    struct rsc_census n = census(c, f.rsm);
                    const float *values = r.after[0].centre;
                    for (size_t v = 0; v < (size_t)r.k * sizeof *r.after / 4; v++)
                        assert_true(isfinite(values[v]));
                    check_means(&r, &f);
                    REQUIRE_NEAR(n.texels.lit > 0, kind > 0, 0);
                    REQUIRE_NEAR(n.in_use > 0, kind > 0, 0);
                    REQUIRE_CMP(n.in_use, <=, n.texels.lit);
                    if (kind == 1)
                        REQUIRE_NEAR(n.texels.uncovered, 0, 0);
                    frame_destroy(&r);
                }
            }
        rsc_clusters_destroy(c);
        fixture_frame_destroy(&f);
    }
}

/* Opposite normals whose mean vanishes: the last normal stays. One cluster over both. */
static void test_thin_wall(void **state)
{
    (void)state;
    struct fixture_frame f;
    make_scene(&f, "cornell", 16);
    struct irb_image normal = fixture_read(f.rsm->normal, 4), flux = fixture_read(f.rsm->flux, 4);
    for (int i = 0; i < 16 * 16; i++) {
        for (int m = 0; m < 3; m++) {
            flux.data[4 * i + m] = 1;
            normal.data[4 * i + m] = m == 1 ? (i % 2 ? 1 : -1) : 0;
        }
    }
    fill(f.rsm->normal, &normal);
    fill(f.rsm->flux, &flux);
    struct rsc_settings s = cornell_settings;
    s.clusters = 1;
    struct rsc_clusters *c = create(&f);
    for (int i = 0; i < 3; i++) {
        struct frame r = cluster(c, &f, &s);
        REQUIRE_NEAR(r.after[0].texels, 256, 0);
        for (int m = 0; m < 3; m++)
            REQUIRE_NEAR(r.after[0].normal[m], r.before[0].normal[m], 0);
        frame_destroy(&r);
    }
    irb_image_destroy(&normal);
    irb_image_destroy(&flux);
    rsc_clusters_destroy(c);
    fixture_frame_destroy(&f);
}

/* A light of another intensity is clustered alike: bit by bit for powers of two, else but for
 * texels that two clusters are equally near to. Twice the same: the same bits. */
static void test_intensity(void **state)
{
    (void)state;
    const float scales[] = {1, 1, 0x1p-20f, 0x1p20f, 1e-3f, 1e3f, 1e-6f, 1e6f};
    struct frame first = {0};
    for (int i = 0; i < 8; i++) {
        struct fixture_frame f;
        struct irb_error err = {0};
        make_scene(&f, "cornell", 96);
        for (int m = 0; m < 3; m++)
            f.light.intensity[m] *= scales[i];
        REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &f.light, &err));
        struct rsc_clusters *c = create(&f);
        struct frame r = {0};
        for (int k = 0; k < 3; k++) {
            frame_destroy(&r);
            r = cluster(c, &f, &colour_settings);
        }
        int differ = 0;
        for (int k = 0; i > 0 && k < 96 * 96; k++)
            differ += r.map[k] != first.map[k];
        REQUIRE_CMP(differ, <=, i < 4 ? 0 : 0.005 * 96 * 96);
        if (i == 0)
            first = r;
        else
            frame_destroy(&r);
        rsc_clusters_destroy(c);
        fixture_frame_destroy(&f);
    }
    frame_destroy(&first);
}

static void test_refusals(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct rsc_clusters *c = rsc_clusters_create(gl, 1024, &err);
    struct rsc_settings s = cornell_settings;
    REQUIRE_OK(c);
    s.clusters = 4095;
    REQUIRE_OK(rsc_clusters_prepare(c, &s, &err));
    s.clusters = 4096;
    assert_false(rsc_clusters_prepare(c, &s, &err));
    assert_int_equal(err.code, IRB_E_INTERNAL);
    s.reduction = RSC_WINDOW;
    REQUIRE_OK(rsc_clusters_prepare(c, &s, &err));
    rsc_clusters_destroy(c);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_assignment), cmocka_unit_test(test_update),
        cmocka_unit_test(test_history),    cmocka_unit_test(test_few_texels),
        cmocka_unit_test(test_thin_wall),  cmocka_unit_test(test_intensity),
        cmocka_unit_test(test_refusals),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
