/* SPDX-License-Identifier: MIT
 *
 * Milliseconds of each step of acrsm's clustering, over k, with the light moving a little in every
 * frame: cornell-objects, an RSM of 512 x 512 texels.
 *
 *     bench_acrsm_clusters BACKEND [--check]    --check: 3 frames of a small map, that it runs
 */
#include "tests/support/compare.h"
#include "core/base/clock.h"
#include "methods/acrsm/clusters.h"
#include "tests/frame/fixture.h"

enum { STEPS = 6, MOST_FRAMES = 31 };
static const char *const steps[STEPS] = {"importance", "evaluate", "seed", "map", "average", "all"};

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double lap(struct irb_gl *gl, double *last)
{
    gl->api.Finish();
    double now = irb_clock_s(), ms = 1000 * (now - *last);
    *last = now;
    return ms;
}

struct bench {
    struct irb_gl *gl;
    struct fixture_frame f;
    struct irb_importance *importance;
    struct irb_pyramid *pyramid;
    struct acrsm_clusters *clusters;
};

static void run_frame(struct bench *b, const struct acrsm_settings *s, double ms[STEPS])
{
    struct irb_error err = {0};
    const struct irb_importance_settings weights = {.diffuse_weight = 1};
    struct fixture_frame *f = &b->f;
    REQUIRE_OK(irb_rsm_render(f->rsm, f->scene_gl, &f->light, &err));
    b->gl->api.Finish();
    double last = irb_clock_s(), start = last;
    REQUIRE_OK(
        irb_importance_compute(b->importance, f->rsm, &f->light, f->gbuffer, &weights, &err));
    REQUIRE_OK(irb_pyramid_build(b->pyramid, b->importance->map, &err));
    REQUIRE_OK(acrsm_clusters_frame(b->clusters, f->rsm, s, &err));
    ms[0] = lap(b->gl, &last);
    REQUIRE_OK(acrsm_evaluate(b->clusters, f->rsm, s, &err));
    ms[1] = lap(b->gl, &last);
    REQUIRE_OK(acrsm_carry(b->clusters, f->rsm, s, &err));
    REQUIRE_OK(acrsm_seed(b->clusters, f->rsm, b->importance->map, b->pyramid, s, &err));
    ms[2] = lap(b->gl, &last);
    REQUIRE_OK(acrsm_map(b->clusters, f->rsm, b->importance->map, s, &err));
    ms[3] = lap(b->gl, &last);
    REQUIRE_OK(acrsm_average(b->clusters, f->rsm, &f->light, b->importance->map, s, &err));
    ms[4] = lap(b->gl, &last);
    ms[5] = 1000 * (last - start);
}

static void bench(struct bench *b, int k, int square, int neighbours, int frames)
{
    struct irb_error err = {0};
    double ms[MOST_FRAMES][STEPS], column[MOST_FRAMES];
    struct acrsm_settings s = {.clusters = k,
                               .square = square,
                               .adaptive = true,
                               .reseed = true,
                               .merge = 0.4f,
                               .split = 0.15f,
                               .share = 1 / 3.0f,
                               .neighbourhood = 2,
                               .split_radius = 1,
                               .neighbours = neighbours,
                               .w_position = 0.9f,
                               .w_normal = 0.08f,
                               .w_importance = 0.02f,
                               .extent = irb_scene_diagonal(b->f.scene),
                               .warp_levels = 16,
                               .tiles = 9};
    fixture_view(b->f.scene, &b->f.light, &b->f.camera);
    REQUIRE_OK(acrsm_clusters_begin(b->clusters, 1, &err));
    for (int i = -1; i < frames; i++) {
        b->f.light.position[0] += 0.002f;
        run_frame(b, &s, ms[i < 0 ? 0 : i]);
    }
    printf("%4d %6d %5s", k, square, neighbours ? "map" : "list");
    for (int step = 0; step < STEPS; step++) {
        for (int i = 0; i < frames; i++)
            column[i] = ms[i][step];
        qsort(column, (size_t)frames, sizeof *column, compare_doubles);
        printf(" %10.2f", column[frames / 2]);
    }
    struct acrsm_report report;
    REQUIRE_OK(acrsm_clusters_report(b->clusters, b->f.rsm, &report, &err));
    printf("   %d in use, uncovered %.4f, spread %.3f, merged %d split %d seeded %d\n",
           report.in_use, report.uncovered, report.spread, report.merged, report.split,
           report.seeded);
}

int main(int argc, char **argv)
{
    struct irb_error err = {0};
    const bool check = argc > 2 && !strcmp(argv[2], "--check");
    const int resolution = check ? 64 : 512, frames = check ? 3 : 11;
    struct bench b = {.gl = fixture_gl(fixture_backend(argc, argv), NULL)};
    fixture_frame_create(&b.f, b.gl, fixture_scene("cornell-objects"), 1, 1, resolution);
    REQUIRE_OK(b.importance = irb_importance_create(b.gl, resolution, &err));
    REQUIRE_OK(b.pyramid = irb_pyramid_create(b.gl, resolution, &err));
    REQUIRE_OK(b.clusters = acrsm_clusters_create(b.gl, resolution, &err));
    printf("%4s %6s %5s", "k", "square", "found");
    for (int step = 0; step < STEPS; step++)
        printf(" %10s", steps[step]);
    printf("   (ms, medians)\n");
    for (int k = 32; k <= 512; k *= 2)
        bench(&b, k, resolution / 4, ACRSM_NEIGHBOURS_LIST, frames);
    for (int k = 32; k <= 256; k *= 2)
        for (int square = 96; square <= 192; square += 32)
            bench(&b, k, square * resolution / 512, ACRSM_NEIGHBOURS_MAP, frames);
    acrsm_clusters_destroy(b.clusters);
    irb_pyramid_destroy(b.pyramid);
    irb_importance_destroy(b.importance);
    fixture_frame_destroy(&b.f);
    irb_gl_destroy(b.gl);
    return 0;
}
