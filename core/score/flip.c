/* SPDX-License-Identifier: MIT
 *
 * FLIP compares the analyses of two images pixel by pixel. HDR-FLIP does so for each exposure and
 * keeps the largest value of a pixel.
 */
#include "core/score/flip.h"

#include "core/base/parallel.h"
#include "core/score/flip_analysis.h"
#include "core/score/flip_colour.h"
#include "core/score/flip_math.h"
#include "core/score/quantile.h"

#include <math.h>
#include <stdlib.h>

/* Constants of the 2020 paper, sections 4.1 to 4.3; the features' exponent of 0.5 is a root. */
static const float qc = 0.7f;  /* exponent of colour differences */
static const float pc = 0.4f;  /* share of the largest difference ... */
static const float pt = 0.95f; /* ... that is taken to this value */

/* One pass without an exposure. */
static const struct irb_flip_exposures as_it_is = {0, 0, 1};

enum { CHUNK = 4096 }; /* pixels that a thread compares at a time */

/* `layers` holds an analysis of the image for each exposure, or is room for one. */
struct irb_flip_reference {
    int width, height;
    struct irb_flip_exposures exposures;
    struct irb_flip_filters filters;
    float *layers;
};

struct flip {
    const struct irb_flip_reference *reference;
    struct irb_flip_analysis analysis;
    size_t pixels;
    float *test;           /* layers of the test image */
    const float *compared; /* layers of the reference */
    float largest_log;     /* log2 of the difference between display colours, HyAB(green, blue) */
    float *out;            /* keeps the maximum over passes */
    float *exposure;       /* NULL, or the pass that made it, as a fraction */
    float pass;            /* this one, as a fraction */
};

static size_t layers_size(const struct irb_flip_reference *reference)
{
    return IRB_FLIP_LAYERS * (size_t)reference->width * (size_t)reference->height;
}

/* Section 4.1: perceived colour difference, [0,1]; powers are taken as shares of the largest. */
static inline float colour_difference(float hyab, float largest_log)
{
    float exponent = qc * (irb_log2(hyab) - largest_log);
    float share = irb_exp2_negative(exponent < 0 ? exponent : 0);
    float low = share * (pt / pc), high = pt + (share - pc) * ((1 - pt) / (1 - pc));
    float d = share < pc ? low : high;
    return hyab > 0 ? d : 0;
}

/* Section 4.2: difference of edges and points, [0,1]. */
static inline float feature_difference(float edge, float point)
{
    float d = sqrtf(0.70710678f * (edge > point ? edge : point));
    return d < 1 ? d : 1;
}

static void compare(const struct flip *f, size_t start, int count, float *restrict out)
{
    const float *t[IRB_FLIP_LAYERS], *r[IRB_FLIP_LAYERS], largest_log = f->largest_log;
    for (size_t i = 0; i < IRB_FLIP_LAYERS; i++) {
        t[i] = f->test + i * f->pixels + start;
        r[i] = f->compared + i * f->pixels + start;
    }
    for (int x = 0; x < count; x++) {
        struct irb_lab p = {t[IRB_FLIP_L][x], t[IRB_FLIP_A][x], t[IRB_FLIP_B][x]};
        struct irb_lab q = {r[IRB_FLIP_L][x], r[IRB_FLIP_A][x], r[IRB_FLIP_B][x]};
        float features = feature_difference(fabsf(t[IRB_FLIP_EDGE][x] - r[IRB_FLIP_EDGE][x]),
                                            fabsf(t[IRB_FLIP_POINT][x] - r[IRB_FLIP_POINT][x]));
        /* Section 4.3. 0^0 is 1 and right only where features differ; there is a colour then. */
        out[x] = irb_unit_power(colour_difference(irb_hyab(p, q), largest_log), 1 - features);
    }
}

static bool compare_chunk(void *user, int chunk, int thread)
{
    (void)thread;
    const struct flip *f = user;
    size_t start = (size_t)chunk * CHUNK, left = f->pixels - start;
    int count = left < CHUNK ? (int)left : CHUNK;
    float now[CHUNK], *out = f->out + start;
    compare(f, start, count, now);
    if (f->exposure)
        for (int x = 0; x < count; x++)
            if (now[x] > out[x])
                f->exposure[start + (size_t)x] = f->pass;
    for (int x = 0; x < count; x++)
        out[x] = now[x] > out[x] ? now[x] : out[x];
    return true;
}

static void compare_all(struct flip *f, int threads)
{
    int chunks = (int)((f->pixels + CHUNK - 1) / CHUNK);
    irb_parallel_for(chunks, threads, compare_chunk, f);
}

static void run_pass(struct flip *f, const struct irb_image *test, struct irb_flip_display display,
                     const float *compared)
{
    f->compared = compared;
    irb_flip_analyse(&f->analysis, test, display, f->test);
    compare_all(f, f->analysis.threads);
}

static float difference_of_primaries(void)
{
    const float green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    float xyz[2][3];
    irb_rgb_to_xyz(green, xyz[0]);
    irb_rgb_to_xyz(blue, xyz[1]);
    return irb_hyab(irb_xyz_to_hunt_lab(xyz[0]), irb_xyz_to_hunt_lab(xyz[1]));
}

/* Position of exposure i in the range, [0,1]. */
static double fraction(const struct irb_flip_exposures *e, int i)
{
    return e->count > 1 ? (double)i / (e->count - 1) : 0;
}

static struct irb_flip_display display_at(const struct irb_flip_exposures *e, int i)
{
    double exposure = e->start + fraction(e, i) * (e->stop - e->start);
    return (struct irb_flip_display){.encoding = IRB_FLIP_ACES, .gain = (float)exp2(exposure)};
}

/* Room for `count` analyses, not yet filled. On failure *out is destroyed all the same. */
static bool reference_start(struct irb_flip_reference *out, const struct irb_image *image,
                            const struct irb_flip_exposures *exposures, int count, double ppd,
                            struct irb_error *err)
{
    *out = (struct irb_flip_reference){
        .width = image->width, .height = image->height, .exposures = *exposures};
    if (image->channels != 3)
        return irb_fail(err, IRB_E_INTERNAL, "FLIP: reference: expected 3 channels, found %d",
                        image->channels);
    if (exposures->count < 1 || exposures->count > IRB_FLIP_MAX_EXPOSURES ||
        !isfinite(exposures->start) || !isfinite(exposures->stop))
        return irb_fail(err, IRB_E_INTERNAL, "FLIP: exposures %g to %g in %d steps",
                        exposures->start, exposures->stop, exposures->count);
    if (!irb_flip_filters_init(&out->filters, ppd))
        return irb_fail(err, IRB_E_INPUT,
                        "FLIP: pixels per degree: expected above 0, at most 1000, found %g", ppd);
    out->layers = malloc((size_t)count * layers_size(out) * sizeof *out->layers);
    return out->layers || irb_fail(err, IRB_E_MEMORY,
                                   "FLIP reference of %d x %d pixels, %d exposures: out of memory",
                                   image->width, image->height, count);
}

/* An analysis for each exposure, or the only one where a display is given. */
static struct irb_flip_reference *prepare(const struct irb_image *reference,
                                          const struct irb_flip_exposures *exposures,
                                          const struct irb_flip_display *display, double ppd,
                                          int threads, struct irb_error *err)
{
    struct irb_flip_reference *out = malloc(sizeof *out);
    if (!out) {
        irb_fail(err, IRB_E_MEMORY, "FLIP: out of memory");
        return NULL;
    }
    struct irb_flip_analysis analysis = {0};
    bool ok =
        reference_start(out, reference, exposures, exposures->count, ppd, err) &&
        irb_flip_analysis_create(&analysis, &out->filters, out->width, out->height, threads, err);
    for (int i = 0; ok && i < exposures->count; i++)
        irb_flip_analyse(&analysis, reference, display ? *display : display_at(exposures, i),
                         out->layers + (size_t)i * layers_size(out));
    irb_flip_analysis_destroy(&analysis);
    if (ok)
        return out;
    irb_flip_reference_destroy(out);
    return NULL;
}

struct irb_flip_reference *irb_flip_reference_create(const struct irb_image *reference,
                                                     const struct irb_flip_exposures *exposures,
                                                     double ppd, int threads, struct irb_error *err)
{
    return prepare(reference, exposures, NULL, ppd, threads, err);
}

struct irb_flip_reference *irb_flip_view_create(const struct irb_image *linear, double ppd,
                                                int threads, struct irb_error *err)
{
    const struct irb_flip_display display = {.encoding = IRB_FLIP_LINEAR};
    return prepare(linear, &as_it_is, &display, ppd, threads, err);
}

void irb_flip_reference_destroy(struct irb_flip_reference *reference)
{
    if (!reference)
        return;
    free(reference->layers);
    free(reference);
}

/* What the comparison needs, but no analysis. *f may hold memory after a failure too. */
static bool start_comparison(struct flip *f, int width, int height,
                             const struct irb_flip_reference *reference, struct irb_error *err)
{
    if (width != reference->width || height != reference->height)
        return irb_fail(err, IRB_E_INPUT, "FLIP: images differ in size: %d x %d and %d x %d", width,
                        height, reference->width, reference->height);
    f->reference = reference;
    f->pixels = (size_t)width * (size_t)height;
    f->largest_log = log2f(difference_of_primaries());
    f->out = malloc(f->pixels * sizeof *f->out);
    if (!f->out)
        return irb_fail(err, IRB_E_MEMORY, "FLIP of %d x %d pixels: out of memory", width, height);
    for (size_t i = 0; i < f->pixels; i++)
        f->out[i] = -1; /* below every value */
    return true;
}

/* On failure what was allocated is in *f all the same; flip_finish frees it. */
static bool flip_start(struct flip *f, const struct irb_image *test,
                       const struct irb_flip_reference *reference, int threads,
                       struct irb_error *err)
{
    if (test->channels != 3)
        return irb_fail(err, IRB_E_INTERNAL, "FLIP: expected 3 channels, found %d", test->channels);
    if (!start_comparison(f, test->width, test->height, reference, err))
        return false;
    f->test = malloc(layers_size(reference) * sizeof *f->test);
    if (!f->test)
        return irb_fail(err, IRB_E_MEMORY, "FLIP of %d x %d pixels: out of memory", test->width,
                        test->height);
    return irb_flip_analysis_create(&f->analysis, &reference->filters, test->width, test->height,
                                    threads, err);
}

/* The weighted median: value and weight are one. */
static bool score_map(const struct flip *f, const uint8_t *mask, struct irb_flip_scores *scores,
                      struct irb_error *err)
{
    struct irb_quantile *median = irb_quantile_create(0.5);
    if (!median)
        return irb_fail(err, IRB_E_MEMORY, "FLIP: out of memory");
    double sum = 0, least = INFINITY, largest = -INFINITY;
    size_t count = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < f->pixels; i++) {
            if (mask && !mask[i])
                continue;
            irb_quantile_add(median, f->out[i], f->out[i]);
            if (pass)
                continue;
            sum += f->out[i];
            least = fmin(least, f->out[i]);
            largest = fmax(largest, f->out[i]);
            count++;
        }
        irb_quantile_pass_done(median);
    }
    *scores =
        (struct irb_flip_scores){sum / (double)count, least, largest, irb_quantile_finish(median)};
    if (!count)
        *scores = (struct irb_flip_scores){NAN, NAN, NAN, NAN};
    return true;
}

/* Hands the values over to `map`, where one is wanted, and frees the rest. */
static bool flip_finish(struct flip *f, bool ok, const uint8_t *mask, struct irb_image *map,
                        struct irb_flip_scores *scores, struct irb_error *err)
{
    ok = ok && score_map(f, mask, scores, err);
    if (map)
        *map = (struct irb_image){0};
    if (ok && map) {
        *map = (struct irb_image){f->reference->width, f->reference->height, 1, f->out};
        f->out = NULL;
    }
    irb_flip_analysis_destroy(&f->analysis);
    free(f->test);
    free(f->out);
    return ok;
}

/* With `image`, the reference's analyses are made here, one after the other in `window`: what is
 * used once need not be kept for all exposures. */
static void run_exposures(struct flip *f, const struct irb_image *test,
                          const struct irb_image *image, float *window)
{
    const struct irb_flip_exposures *exposures = &f->reference->exposures;
    for (int i = 0; i < exposures->count; i++) {
        struct irb_flip_display display = display_at(exposures, i);
        f->pass = (float)fraction(exposures, i);
        if (image)
            irb_flip_analyse(&f->analysis, image, display, window);
        run_pass(f, test, display,
                 image ? window : f->reference->layers + (size_t)i * layers_size(f->reference));
    }
}

bool irb_flip_hdr_prepared(const struct irb_image *test, const struct irb_flip_reference *reference,
                           const uint8_t *mask, int threads, struct irb_image *map,
                           struct irb_flip_scores *scores, struct irb_error *err)
{
    struct flip f = {0};
    bool ok = flip_start(&f, test, reference, threads, err);
    if (ok)
        run_exposures(&f, test, NULL, NULL);
    return flip_finish(&f, ok, mask, map, scores, err);
}

bool irb_flip_views(const struct irb_flip_reference *test,
                    const struct irb_flip_reference *reference, const uint8_t *mask, int threads,
                    struct irb_image *map, struct irb_flip_scores *scores, struct irb_error *err)
{
    struct flip f = {0};
    bool ok = start_comparison(&f, test->width, test->height, reference, err);
    if (ok) {
        f.test = test->layers;
        f.compared = reference->layers;
        compare_all(&f, threads);
        f.test = NULL; /* borrowed */
    }
    return flip_finish(&f, ok, mask, map, scores, err);
}

bool irb_flip_hdr_maps(const struct irb_image *test, const struct irb_image *reference,
                       const uint8_t *mask, const struct irb_flip_exposures *exposures, double ppd,
                       int threads, struct irb_image *map, struct irb_image *exposure_map,
                       struct irb_flip_scores *scores, struct irb_error *err)
{
    struct flip f = {0};
    struct irb_flip_reference own;
    struct irb_image exposure = {0};
    bool ok = reference_start(&own, reference, exposures, 1, ppd, err) &&
              flip_start(&f, test, &own, threads, err);
    if (ok && exposure_map) {
        ok = irb_image_create(&exposure, test->width, test->height, 1, err);
        f.exposure = exposure.data;
    }
    if (ok)
        run_exposures(&f, test, reference, own.layers);
    ok = flip_finish(&f, ok, mask, map, scores, err);
    free(own.layers);
    if (!ok)
        irb_image_destroy(&exposure);
    if (exposure_map)
        *exposure_map = exposure;
    return ok;
}

bool irb_flip_hdr(const struct irb_image *test, const struct irb_image *reference,
                  const uint8_t *mask, const struct irb_flip_exposures *exposures, double ppd,
                  int threads, struct irb_image *map, struct irb_flip_scores *scores,
                  struct irb_error *err)
{
    return irb_flip_hdr_maps(test, reference, mask, exposures, ppd, threads, map, NULL, scores,
                             err);
}

bool irb_flip_ldr(const struct irb_image *test, const struct irb_image *reference,
                  const uint8_t *mask, double ppd, int threads, struct irb_image *map,
                  struct irb_flip_scores *scores, struct irb_error *err)
{
    const struct irb_flip_display display = {.encoding = IRB_FLIP_SRGB};
    struct flip f = {0};
    struct irb_flip_reference own;
    bool ok = reference_start(&own, reference, &as_it_is, 1, ppd, err) &&
              flip_start(&f, test, &own, threads, err);
    if (ok) {
        irb_flip_analyse(&f.analysis, reference, display, own.layers);
        run_pass(&f, test, display, own.layers);
    }
    ok = flip_finish(&f, ok, mask, map, scores, err);
    free(own.layers);
    return ok;
}
