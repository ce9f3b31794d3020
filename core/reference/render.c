/* SPDX-License-Identifier: MIT
 *
 * The job: passes over the image that double the samples, tiles within a pass, noise, and what
 * comes out.
 */
#include "core/base/clock.h"
#include "core/base/parallel.h"
#include "core/reference/checkpoint.h"
#include "core/reference/estimator.h"
#include "core/reference/result.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { TILE = 16, TILE_PIXELS = TILE * TILE };

struct tile_state {
    struct point_layers pixels[TILE_PIXELS]; /* sums over the samples so far */
    double luminance[MAX_BOUNCES];           /* of each bounce, likewise, over the pixels */
};

struct render {
    const struct irb_reference_job *job;
    struct irb_reference_image *out;
    struct light_source light;
    struct checkpoint checkpoint;
    int width, height, columns, tiles, threads;
    uint32_t min_samples, max_samples;
    uint32_t pass;                    /* the one that runs; tiles are brought to pass + 1 */
    uint32_t first_pass;              /* of this run */
    struct tile_state *states;        /* one a tile */
    struct checkpoint_tile *progress; /* one a tile */
    uint32_t expected_samples;        /* a guess at where it will end, for the time left */
    double start_s, start_fraction;
    atomic_int finished; /* tiles of this pass */
    atomic_bool checkpoint_failed;
    _Atomic uint64_t direct_rays;
};

static uint32_t power_of_two_above(uint32_t n)
{
    uint32_t power = 1;
    while (power < n)
        power *= 2;
    return power;
}

/* Samples a pixel after so many passes. */
static uint32_t samples_after(const struct render *r, uint32_t passes)
{
    return passes ? r->min_samples << (passes - 1) : 0;
}

static struct surface_point gbuffer_point(const struct render *r, size_t pixel)
{
    const struct irb_gbuffer_image *g = r->job->gbuffer;
    struct surface_point point = {
        .position = v3_load(g->position.data + 4 * pixel),
        .shading = v3_normalize_safe(v3_load(g->normal.data + 4 * pixel)),
        .geometric = v3_normalize_safe(v3_load(g->geometric.data + 3 * pixel)),
        .diffuse = v3_load(g->diffuse.data + 3 * pixel),
    };
    point.origin =
        surface_offset(irb_tracer_surfaces(r->job->tracer), point.position, point.geometric);
    return point;
}

/* Calls fn for every covered pixel of a tile. */
typedef void (*pixel_fn)(struct render *r, struct estimator *estimator, int tile, int in_tile,
                         size_t pixel);

static void each_pixel(struct render *r, struct estimator *estimator, int tile, pixel_fn fn)
{
    int x0 = tile % r->columns * TILE, y0 = tile / r->columns * TILE;
    for (int i = 0; i < TILE_PIXELS; i++) {
        int x = x0 + i % TILE, y = y0 + i / TILE;
        if (x >= r->width || y >= r->height)
            continue;
        size_t pixel = (size_t)y * (size_t)r->width + (size_t)x;
        if (irb_gbuffer_image_covered(r->job->gbuffer, pixel))
            fn(r, estimator, tile, i, pixel);
    }
}

static struct estimator make_estimator(const struct render *r)
{
    return (struct estimator){
        .trace = {.tracer = r->job->tracer, .surfaces = irb_tracer_surfaces(r->job->tracer)},
        .light = &r->light,
        .bounces = r->job->settings->bounces,
        .unoccluded = r->job->settings->unoccluded,
        .kernels = kernels_choose(),
    };
}

static void shade_pixel(struct render *r, struct estimator *estimator, int tile, int in_tile,
                        size_t pixel)
{
    uint32_t passes = r->progress[tile].passes;
    uint32_t first = samples_after(r, passes) / IRB_REFERENCE_BATCHES;
    uint32_t last = samples_after(r, passes + 1) / IRB_REFERENCE_BATCHES;
    struct surface_point point = gbuffer_point(r, pixel);
    uint64_t seed = irb_hash_mix((uint64_t)r->job->settings->seed, pixel);
    estimator_add(estimator, &point, seed, first, last, &r->states[tile].pixels[in_tile]);
}

static bool stopped(const struct render *r)
{
    return r->job->stop && *r->job->stop;
}

/* Share of the expected work that is done. */
static double fraction_done(const struct render *r)
{
    double before = samples_after(r, r->pass), after = samples_after(r, r->pass + 1);
    double share = (double)atomic_load(&r->finished) / r->tiles;
    return fmin(1, (before + share * (after - before)) / r->expected_samples);
}

static void show_progress(struct render *r)
{
    double fraction = fraction_done(r);
    /* Time left goes by what this run has done; a resumed one began at start_fraction. */
    double done = fmax(fraction - r->start_fraction, 1e-9);
    irb_log_progress(r->job->log, "reference", fraction,
                     (irb_clock_s() - r->start_s) * fraction / done);
}

static bool run_tile(void *user, int tile, int thread)
{
    struct render *r = user;
    struct checkpoint_tile *progress = &r->progress[tile];
    while (progress->passes <= r->pass) {
        if (stopped(r))
            return false;
        double start_s = irb_clock_s();
        struct estimator estimator = make_estimator(r);
        each_pixel(r, &estimator, tile, shade_pixel);
        for (int i = 0; i < MAX_BOUNCES; i++)
            r->states[tile].luminance[i] += estimator.luminance[i];
        progress->passes++;
        progress->rays += estimator.trace.rays;
        progress->seconds += irb_clock_s() - start_s;
        if (!atomic_load(&r->checkpoint_failed) &&
            !checkpoint_write(&r->checkpoint, progress, &r->states[tile]))
            atomic_store(&r->checkpoint_failed, true);
    }
    atomic_fetch_add(&r->finished, 1);
    if (thread == 0) /* the caller's: the log is not shared */
        show_progress(r);
    return true;
}

/* Variance of the mean over all samples, from the batches' means. */
static double batch_variance(const float sums[IRB_REFERENCE_BATCHES], uint32_t samples)
{
    double scale = (double)IRB_REFERENCE_BATCHES / samples, mean = 0, square = 0;
    for (int i = 0; i < IRB_REFERENCE_BATCHES; i++)
        mean += (double)sums[i] * scale / IRB_REFERENCE_BATCHES;
    for (int i = 0; i < IRB_REFERENCE_BATCHES; i++)
        square += ((double)sums[i] * scale - mean) * ((double)sums[i] * scale - mean);
    return square / (IRB_REFERENCE_BATCHES * (IRB_REFERENCE_BATCHES - 1));
}

static double batch_mean(const float sums[IRB_REFERENCE_BATCHES], uint32_t samples)
{
    double sum = 0;
    for (int i = 0; i < IRB_REFERENCE_BATCHES; i++)
        sum += (double)sums[i];
    return sum / samples;
}

/* Irradiance beyond bounce n as a share of bounces 1..n, whose sums these are: a geometric series
 * through the last half of them. With L bounces of sum S and ratio q between successive ones, what
 * follows is S q^L/(1 - q^L). The last two alone would be a noisy ratio, as few paths get there. */
static double remainder_beyond(const double luminance[MAX_BOUNCES], int n)
{
    int first = n / 2; /* index of the first bounce of the fit but one; they start at 0 */
    double all = 0, sum = 0, before = 0;
    if (n == 1)
        return NAN;
    first = first < 1 ? 1 : first;
    for (int i = 0; i < n; i++) {
        all += luminance[i];
        sum += i >= first ? luminance[i] : 0;
        before += i >= first ? luminance[i - 1] : 0;
    }
    if (!(sum > 0 && before > 0))
        return 0;
    double q = pow(sum / before, n - first);
    return q < 1 ? sum * q / (1 - q) / all : INFINITY;
}

/* Relative noise as irb_reference_settings defines it, and the remainder. In order of tiles, so
 * that the sums do not depend on threads. */
static void measure(struct render *r, uint32_t samples)
{
    double mean = 0, variance = 0, luminance[MAX_BOUNCES] = {0};
    size_t pixels = 0;
    for (int t = 0; t < r->tiles; t++) {
        for (int i = 0; i < TILE_PIXELS; i++) {
            const struct point_layers *p = &r->states[t].pixels[i];
            mean += batch_mean(p->bounce1_batch, samples);
            variance += batch_variance(p->bounce1_batch, samples);
        }
        for (int i = 0; i < MAX_BOUNCES; i++)
            luminance[i] += r->states[t].luminance[i];
    }
    for (size_t i = 0; i < (size_t)r->width * (size_t)r->height; i++)
        pixels += irb_gbuffer_image_covered(r->job->gbuffer, i);
    r->out->samples = (int)samples;
    r->out->noise = mean > 0 ? sqrt(variance * (double)pixels) / mean : 0;
    r->out->rest_remainder = remainder_beyond(luminance, r->job->settings->bounces);
}

static void store_rgb(struct irb_image *image, size_t pixel, const float sums[3], float scale)
{
    for (int c = 0; c < 3; c++)
        image->data[3 * pixel + (size_t)c] = sums[c] * scale;
}

/* A pixel's layers from its sums, and direct light. */
static void store_pixel(struct render *r, struct estimator *estimator, int tile, int in_tile,
                        size_t pixel)
{
    const struct point_layers *p = &r->states[tile].pixels[in_tile];
    struct irb_reference_image *out = r->out;
    uint32_t samples = (uint32_t)out->samples;
    float scale = 1 / (float)samples;
    store_rgb(&out->bounce1, pixel, p->bounce1, scale);
    store_rgb(&out->bounce2, pixel, p->bounce2, scale);
    store_rgb(&out->rest, pixel, p->rest, scale);
    store_rgb(&out->unoccluded, pixel, p->unoccluded, scale);
    out->variance.data[pixel] = (float)batch_variance(p->bounce1_batch, samples);
    out->unoccluded_variance.data[pixel] = (float)batch_variance(p->unoccluded_batch, samples);
    struct surface_point point = gbuffer_point(r, pixel);
    const float *specular = r->job->gbuffer->specular.data + 4 * pixel;
    struct vec3 direct = estimator_direct(estimator, &point, v3_load(specular), specular[3],
                                          v3_load(r->job->camera->position));
    store_rgb(&out->direct, pixel, (float[3]){direct.x, direct.y, direct.z}, 1);
}

static bool store_tile(void *user, int tile, int thread)
{
    (void)thread;
    struct render *r = user;
    struct estimator estimator = make_estimator(r);
    each_pixel(r, &estimator, tile, store_pixel);
    atomic_fetch_add(&r->direct_rays, estimator.trace.rays);
    return true;
}

/* What must agree for the tiles of a checkpoint to be this job's. */
static struct irb_key job_key(const struct irb_reference_job *job)
{
    struct irb_key gbuffer = irb_gbuffer_image_key(job->gbuffer);
    return irb_reference_key(&irb_tracer_surfaces(job->tracer)->key, job->light, job->camera,
                             &gbuffer, job->settings);
}

static bool check_job(const struct irb_reference_job *job, struct irb_error *err)
{
    const struct irb_reference_settings *s = job->settings;
    const struct irb_gbuffer_image *g = job->gbuffer;
    if (s->bounces < 1 || s->bounces > MAX_BOUNCES)
        return irb_fail(err, IRB_E_INPUT, "reference.bounces: expected 1..%d, found %d",
                        MAX_BOUNCES, s->bounces);
    if (s->min_samples < 1 || s->max_samples < 1 || s->min_samples > 1 << 20 ||
        s->max_samples > 1 << 20 || !(s->noise >= 0))
        return irb_fail(
            err, IRB_E_INPUT,
            "reference: expected samples in 1..%d and noise >= 0, found min_samples %d, "
            "max_samples %d, noise %g",
            1 << 20, s->min_samples, s->max_samples, (double)s->noise);
    const struct irb_image *layers[] = {&g->position, &g->normal, &g->geometric, &g->diffuse,
                                        &g->specular};
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        if (!layers[i]->data || layers[i]->width != g->width || layers[i]->height != g->height)
            return irb_fail(err, IRB_E_INPUT, "reference: G-buffer layer %zu is not %d x %d", i,
                            g->width, g->height);
    return true;
}

/* Finished tiles of an earlier run; returns the pass to go on with. A pass that any tile has begun
 * was found necessary then, so earlier ones need no second look at the noise. */
static uint32_t resume(struct render *r)
{
    uint32_t pass = 0;
    for (int t = 0; t < r->tiles; t++) {
        r->progress[t].tile = (uint32_t)t;
        checkpoint_read(&r->checkpoint, &r->progress[t], &r->states[t]);
        if (r->progress[t].passes > pass + 1)
            pass = r->progress[t].passes - 1;
    }
    int done = 0;
    for (int t = 0; t < r->tiles; t++)
        done += r->progress[t].passes > pass;
    if (pass || done)
        irb_info(r->job->log, "reference: goes on, %d of %d tiles have %u samples a pixel", done,
                 r->tiles, samples_after(r, pass + 1));
    return pass;
}

/* Where it will probably end: noise falls at least with the root of the samples. */
static void guess_end(struct render *r)
{
    double target = (double)r->job->settings->noise, samples = r->min_samples;
    if (!(target > 0))
        samples = r->max_samples;
    else if (r->out->samples)
        samples = r->out->samples * pow(r->out->noise / target, 2);
    r->expected_samples = power_of_two_above((uint32_t)fmax(fmin(samples, r->max_samples), 1));
    uint32_t least = samples_after(r, r->pass + 1);
    if (r->expected_samples < least)
        r->expected_samples = least;
}

static bool run_passes(struct render *r, struct irb_error *err)
{
    bool reported = false;
    r->first_pass = resume(r);
    for (r->pass = r->first_pass;; r->pass++) {
        atomic_store(&r->finished, 0);
        guess_end(r);
        if (r->pass == r->first_pass)
            r->start_fraction = fraction_done(r);
        if (!irb_parallel_for(r->tiles, r->threads, run_tile, r)) {
            irb_log_progress_done(r->job->log);
            return irb_fail(err, IRB_E_INTERRUPTED, "the reference was interrupted%s",
                            r->checkpoint.file >= 0 && !atomic_load(&r->checkpoint_failed)
                                ? "; finished tiles are kept"
                                : "");
        }
        if (atomic_load(&r->checkpoint_failed) && !reported) {
            irb_warn(r->job->log,
                     "%s: can't be written; the reference goes on without a checkpoint",
                     r->job->checkpoint);
            reported = true;
        }
        uint32_t samples = samples_after(r, r->pass + 1);
        measure(r, samples);
        double target = (double)r->job->settings->noise;
        if (samples >= r->max_samples || (target > 0 && r->out->noise <= target))
            break;
    }
    irb_log_progress_done(r->job->log);
    return true;
}

static void finish(struct render *r)
{
    irb_parallel_for(r->tiles, r->threads, store_tile, r);
    double seconds = 0;
    r->out->rays = atomic_load(&r->direct_rays);
    for (int t = 0; t < r->tiles; t++) {
        r->out->rays += r->progress[t].rays;
        seconds += r->progress[t].seconds;
    }
    r->out->seconds = seconds / r->threads;
}

static void choose_samples(struct render *r)
{
    const struct irb_reference_settings *s = r->job->settings;
    r->min_samples = power_of_two_above((uint32_t)s->min_samples);
    if (r->min_samples < IRB_REFERENCE_BATCHES)
        r->min_samples = IRB_REFERENCE_BATCHES;
    uint32_t above = power_of_two_above((uint32_t)s->max_samples);
    r->max_samples = above > (uint32_t)s->max_samples ? above / 2 : above;
    if (r->max_samples < r->min_samples)
        r->max_samples = r->min_samples;
}

bool irb_reference_render(const struct irb_reference_job *job, struct irb_reference_image *out,
                          struct irb_error *err)
{
    *out = (struct irb_reference_image){0};
    if (!check_job(job, err))
        return false;
    struct render r = {.job = job,
                       .out = out,
                       .checkpoint = {.file = -1},
                       .width = job->gbuffer->width,
                       .height = job->gbuffer->height};
    r.columns = (r.width + TILE - 1) / TILE;
    r.tiles = r.columns * ((r.height + TILE - 1) / TILE);
    r.threads = job->threads > 0 ? job->threads : irb_core_count();
    r.start_s = irb_clock_s();
    choose_samples(&r);
    light_source_prepare(&r.light, job->light, irb_tracer_surfaces(job->tracer)->offset);
    r.states = calloc((size_t)r.tiles, sizeof *r.states);
    r.progress = calloc((size_t)r.tiles, sizeof *r.progress);
    struct irb_key key = job_key(job);
    bool ok = r.states && r.progress;
    if (!ok)
        irb_fail(err, IRB_E_MEMORY, "no memory for a reference of %d x %d", r.width, r.height);
    ok = ok && irb_reference_image_create(out, r.width, r.height, err) &&
         checkpoint_open(&r.checkpoint, job->checkpoint, &key, sizeof *r.states, err) &&
         run_passes(&r, err);
    if (ok)
        finish(&r);
    else
        irb_reference_image_destroy(out);
    checkpoint_close(&r.checkpoint);
    free(r.progress);
    free(r.states);
    return ok;
}
