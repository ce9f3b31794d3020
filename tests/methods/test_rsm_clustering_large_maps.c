/* SPDX-License-Identifier: MIT
 *
 * Clusters of more texels than one dispatch may walk over (core/gl/context.h,
 * IRB_LOOP_ROUNDS_MOST): against sums in double precision, and the three ways to find a cluster's
 * texels against one another.
 */
#include "tests/support/compare.h"
#include "methods/rsm_clustering/area_lights.h"
#include "tests/frame/fixture.h"

static struct irb_gl *gl;

enum { N = 512, MOST_CLUSTERS = 16, CORNERS = 16 };

struct disc {
    float position[3], area, normal[3], unused, flux[3], unused_too;
};

/* What a frame comes to. Polygons are looked at as bits alone. */
struct outcome {
    struct rsc_cluster clusters[MOST_CLUSTERS];
    struct disc discs[RSC_AREA_MAX + 1][MOST_CLUSTERS];
    float polygons[MOST_CLUSTERS][4 * (3 + CORNERS / 2)];
};

/* Seeded by flux; the map goes to `map`. */
static struct outcome run(const struct fixture_frame *f, const struct rsc_settings *s, int *map)
{
    struct irb_error err = {0};
    struct outcome out = {0};
    const int64_t k = s->clusters;
    struct irb_pyramid *pyramid = irb_pyramid_create(gl, N, &err);
    struct rsc_clusters *c = rsc_clusters_create(gl, N, &err);
    struct rsc_area_lights *lights = rsc_area_lights_create(gl, &err);
    REQUIRE_OK(pyramid && c && lights);
    REQUIRE_OK(irb_pyramid_build_flux(pyramid, f->rsm, &err));
    REQUIRE_OK(rsc_clusters_prepare(c, s, &err));
    REQUIRE_OK(rsc_clusters_seed(c, f->rsm, pyramid, s, &err) && rsc_clusters_grid(c, s, &err) &&
               rsc_clusters_assign(c, f->rsm, s, &err) && rsc_clusters_sort(c, f->rsm, s, &err) &&
               rsc_clusters_update(c, f->rsm, s, &err));
    gl->api.GetTextureImage(c->map->id, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, 4 * N * N, map);
    REQUIRE_OK(
        irb_buffer_read(c->clusters, 0, k * (int64_t)sizeof *out.clusters, out.clusters, &err));
    REQUIRE_OK(rsc_area_lights_prepare(lights, s->clusters, CORNERS, &err));
    for (int area = 0; area <= RSC_AREA_MAX; area++) {
        REQUIRE_OK(rsc_area_lights_make(lights, c, f->rsm, s, (enum rsc_area)area,
                                        area ? 0 : CORNERS, &err));
        REQUIRE_OK(irb_buffer_read(lights->discs, 0, k * (int64_t)sizeof **out.discs,
                                   out.discs[area], &err));
    }
    REQUIRE_OK(irb_buffer_read(lights->polygons, 0, k * (int64_t)sizeof *out.polygons, out.polygons,
                               &err));
    rsc_area_lights_destroy(lights);
    rsc_clusters_destroy(c);
    irb_pyramid_destroy(pyramid);
    return out;
}

/* Count, weight, weighted position and normal, flux, then second moment about `centre` and largest
 * distance from it. */
struct sums {
    double count, weight, position[3], normal[3], flux[3], moment, farthest;
};

static struct sums sum_texels(const struct fixture_frame *f, const int *map, int id,
                              const float centre[3])
{
    struct irb_image x = fixture_read(f->rsm->position, 4), n = fixture_read(f->rsm->normal, 4);
    struct irb_image phi = fixture_read(f->rsm->flux, 4);
    struct sums s = {0};
    for (int i = 0; i < N * N; i++) {
        if (map[i] != id)
            continue;
        const size_t at = 4 * ((size_t)(N - 1 - i / N) * N + (size_t)(i % N)); /* top row first */
        const double w = (double)phi.data[at] + phi.data[at + 1] + phi.data[at + 2];
        double d2 = 0;
        for (size_t m = 0; m < 3; m++) {
            const double d = (double)x.data[at + m] - centre[m];
            s.position[m] += w * x.data[at + m];
            s.normal[m] += w * n.data[at + m];
            s.flux[m] += phi.data[at + m];
            d2 += d * d;
        }
        s.count++;
        s.weight += w;
        s.moment += w * d2;
        s.farthest = fmax(s.farthest, sqrt(d2));
    }
    irb_image_destroy(&x);
    irb_image_destroy(&n);
    irb_image_destroy(&phi);
    return s;
}

static void check_cluster(const struct fixture_frame *f, const struct outcome *o, const int *map,
                          int id)
{
    const struct rsc_cluster *c = &o->clusters[id];
    const struct sums s = sum_texels(f, map, id, c->centre);
    const double length =
        sqrt(s.normal[0] * s.normal[0] + s.normal[1] * s.normal[1] + s.normal[2] * s.normal[2]);
    const double size = (double)irb_scene_diagonal(f->scene);
    REQUIRE_NEAR(c->texels, s.count, 0);
    if (s.count == 0)
        return;
    for (int m = 0; m < 3; m++) {
        REQUIRE_REL(c->flux[m], s.flux[m], 1e-5);
        REQUIRE_NEAR(c->centre[m], s.position[m] / s.weight, 1e-5 * size);
        if (length > 0.01 * s.weight)
            REQUIRE_NEAR(c->normal[m], s.normal[m] / length, 1e-5);
    }
    const float *areas[] = {&o->discs[0][id].area, &o->discs[1][id].area, &o->discs[2][id].area};
    REQUIRE_REL(*areas[RSC_AREA_TEXELS], c->area, 0);
    REQUIRE_REL(*areas[RSC_AREA_MOMENT], c->texel_area + 2 * M_PI * s.moment / s.weight, 1e-4);
    REQUIRE_CMP(*areas[RSC_AREA_MAX], >=, M_PI * s.farthest * s.farthest * (1 - 1e-5));
    REQUIRE_CMP(*areas[RSC_AREA_MAX], <, M_PI * pow(s.farthest + 0.02 * size, 2));
}

static void test_reductions(void **state)
{
    (void)state;
    const int counts[] = {1, 16};
    struct fixture_frame f;
    int *maps[2] = {malloc(4 * N * N), malloc(4 * N * N)};
    fixture_frame_create(&f, gl, fixture_scene("cornell"), 8, 8, N);
    fixture_view(f.scene, &f.light, &f.camera);
    fixture_frame_render(&f);
    for (int k = 0; k < 2; k++) {
        struct rsc_settings s = {
            .clusters = counts[k], .weight_distance = 1, .weight_normal = 10, .reach = 1};
        struct outcome sorted = run(&f, &s, maps[0]);
        double most = 0;
        for (int i = 0; i < s.clusters; i++) {
            check_cluster(&f, &sorted, maps[0], i);
            most = fmax(most, (double)sorted.clusters[i].texels);
        }
        print_message("k %d: up to %g texels in a cluster\n", s.clusters, most);
        REQUIRE_CMP(k > 0 || most > 2 * IRB_LOOP_ROUNDS_MOST, ==, 1);
        for (int reduction = RSC_WINDOW; reduction <= RSC_DIRECT; reduction++) {
            s.reduction = (enum rsc_reduction)reduction;
            struct outcome other = run(&f, &s, maps[1]);
            assert_memory_equal(maps[1], maps[0], 4 * N * N);
            assert_memory_equal(&other, &sorted, sizeof sorted);
        }
    }
    free(maps[0]);
    free(maps[1]);
    fixture_frame_destroy(&f);
}

/* One cluster over a floor of 2 x 2 m, of which every point is lit. */
static void test_floor(void **state)
{
    (void)state;
    struct irb_error err = {0};
    struct fixture_frame f;
    int *map = malloc(4 * N * N);
    fixture_frame_create(&f, gl, fixture_floor(1, (const float[3]){0.5f, 0.5f, 0.5f}), 8, 8, N);
    f.light = fixture_spot((const float[3]){0.1f, 6, 0.05f}, (const float[3]){0, 0, 0}, 15);
    f.light.falloff = IRB_FALLOFF_CONSTANT;
    REQUIRE_OK(irb_rsm_render(f.rsm, f.scene_gl, &f.light, &err));
    const struct rsc_settings s = {.clusters = 1, .weight_distance = 1, .reach = 2};
    struct outcome o = run(&f, &s, map);
    print_message("the floor: %g texels, %g of 4 m2\n", (double)o.clusters[0].texels,
                  (double)o.clusters[0].area);
    REQUIRE_CMP(o.clusters[0].texels, >, 65536);
    REQUIRE_REL(o.clusters[0].area, 4, 0.01);
    free(map);
    fixture_frame_destroy(&f);
}

int main(int argc, char **argv)
{
    gl = fixture_gl(fixture_backend(argc, argv), NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reductions),
        cmocka_unit_test(test_floor),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    irb_gl_destroy(gl);
    return failed;
}
