/* SPDX-License-Identifier: MIT
 *
 * Rays per second of the reference against a bare loop of rtcIntersect1 and rtcOccluded1 over the
 * same rays with the same number of threads, by processor time, interleaved, median of the repeats.
 * The result is the ratio; the exit status tells whether it is at least 0.7.
 *
 *     bench_tracer [SCENE [WIDTH HEIGHT SAMPLES BOUNCES]]
 */
#include "core/base/parallel.h"
#include "core/reference/estimator.h"
#include "tests/reference/fixture.h"
#include "tests/support/compare.h"

#include <embree3/rtcore.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { REPEATS = 9, MAX_RECORDS = 1 << 21 };
static const double required_ratio = 0.7;

struct bare {
    const struct trace_recording *recordings; /* one a thread */
    RTCScene scene;
    atomic_ulong hits; /* keeps the loop from being left out */
};

static bool bare_loop(void *user, int index, int thread)
{
    (void)thread;
    struct bare *bare = user;
    const struct trace_recording *recording = &bare->recordings[index];
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    unsigned long hits = 0;
    for (size_t i = 0; i < recording->count; i++) {
        const struct trace_ray *r = &recording->rays[i];
        struct RTCRayHit query = {.ray = {.org_x = r->origin.x,
                                          .org_y = r->origin.y,
                                          .org_z = r->origin.z,
                                          .tnear = r->near,
                                          .dir_x = r->direction.x,
                                          .dir_y = r->direction.y,
                                          .dir_z = r->direction.z,
                                          .tfar = r->far,
                                          .mask = ~0u}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        if (recording->occlusion[i]) {
            rtcOccluded1(bare->scene, &context, &query.ray);
            hits += query.ray.tfar < 0;
        } else {
            rtcIntersect1(bare->scene, &context, &query);
            hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
    }
    atomic_fetch_add(&bare->hits, hits);
    return true;
}

/* The integrator over every `threads`-th pixel, starting at `index`: both loops then split the work
 * in the same way. */
struct shading {
    struct fixture *fixture;
    struct light_source light;
    struct trace_recording *recordings; /* NULL: only traced */
    int samples, threads;
    atomic_ulong rays;
};

static struct surface_point point_of(const struct fixture *fixture, size_t i)
{
    const struct irb_gbuffer_image *g = &fixture->gbuffer;
    struct surface_point p = {.position = v3_load(g->position.data + 4 * i),
                              .geometric = v3_load(g->geometric.data + 3 * i),
                              .shading = v3_load(g->normal.data + 4 * i)};
    p.origin = surface_offset(irb_tracer_surfaces(fixture->tracer), p.position, p.geometric);
    return p;
}

static bool shade(void *user, int index, int thread)
{
    (void)thread;
    struct shading *s = user;
    struct estimator estimator = {
        .trace = {.tracer = s->fixture->tracer,
                  .surfaces = irb_tracer_surfaces(s->fixture->tracer),
                  .recording = s->recordings ? &s->recordings[index] : NULL},
        .light = &s->light,
        .bounces = s->fixture->settings.bounces,
        .kernels = kernels_choose(),
    };
    size_t pixels = irb_image_pixels(&s->fixture->gbuffer.position);
    for (size_t i = (size_t)index; i < pixels; i += (size_t)s->threads) {
        struct point_layers sums = {0};
        struct surface_point point = point_of(s->fixture, i);
        if (irb_gbuffer_image_covered(&s->fixture->gbuffer, i))
            estimator_add(&estimator, &point, i, 0, (uint32_t)s->samples / IRB_REFERENCE_BATCHES,
                          &sums);
    }
    atomic_fetch_add(&s->rays, estimator.trace.rays);
    return true;
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, compare_doubles);
    return values[count / 2];
}

/* Of all threads: what else runs on the machine counts less than with the time of day. */
static double cpu_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double time_of(irb_parallel_fn fn, void *user, int threads)
{
    double start_s = cpu_seconds();
    irb_parallel_for(threads, threads, fn, user);
    return (cpu_seconds() - start_s) / threads;
}

static bool measure(struct fixture *fixture, int samples)
{
    int threads = irb_core_count();
    struct shading shading = {.fixture = fixture, .samples = samples, .threads = threads};
    light_source_prepare(&shading.light, &fixture->light,
                         irb_tracer_surfaces(fixture->tracer)->offset);
    struct trace_recording *recordings = calloc((size_t)threads, sizeof *recordings);
    for (int i = 0; i < threads; i++) {
        recordings[i].capacity = MAX_RECORDS;
        recordings[i].rays = malloc(MAX_RECORDS * sizeof *recordings[i].rays);
        recordings[i].occlusion = malloc(MAX_RECORDS * sizeof *recordings[i].occlusion);
    }
    shading.recordings = recordings;
    irb_parallel_for(threads, threads, shade, &shading);
    unsigned long rays = atomic_exchange(&shading.rays, 0);
    shading.recordings = NULL;
    struct bare bare = {.recordings = recordings,
                        .scene = irb_tracer_embree_scene(fixture->tracer)};
    bool complete = true;
    for (int i = 0; i < threads; i++)
        complete &= recordings[i].count < recordings[i].capacity;
    double shaded[REPEATS], looped[REPEATS], ratio[REPEATS];
    for (int i = 0; i < REPEATS; i++) {
        shaded[i] = time_of(shade, &shading, threads);
        looped[i] = time_of(bare_loop, &bare, threads);
        ratio[i] = looped[i] / shaded[i];
    }
    double result = median(ratio, REPEATS);
    printf("%s: %lu rays, %d threads: reference %.2f M rays/s, bare loop %.2f M rays/s, "
           "ratio %.3f (%.3f .. %.3f)%s\n",
           fixture->scene->name, rays, threads, (double)rays / median(shaded, REPEATS) * 1e-6,
           (double)rays / median(looped, REPEATS) * 1e-6, result, ratio[0], ratio[REPEATS - 1],
           complete ? "" : " INVALID: too many rays to record");
    for (int i = 0; i < threads; i++) {
        free(recordings[i].rays);
        free(recordings[i].occlusion);
    }
    free(recordings);
    return complete && result >= required_ratio;
}

int main(int argc, char **argv)
{
    struct fixture fixture;
    int width = argc > 3 ? atoi(argv[2]) : 64, height = argc > 3 ? atoi(argv[3]) : 48;
    fixture_builtin(&fixture, argc > 1 ? argv[1] : "cornell");
    fixture.settings.bounces = argc > 5 ? atoi(argv[5]) : 16;
    fixture_look(&fixture, width, height);
    bool ok = measure(&fixture, argc > 4 ? atoi(argv[4]) : 64);
    fixture_destroy(&fixture);
    return ok ? 0 : 1;
}
