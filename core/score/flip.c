/* SPDX-License-Identifier: MIT
 *
 * One pass of FLIP: rows are converted to opponent colours and filtered horizontally (both images),
 * then filtered vertically and compared. HDR-FLIP makes a pass for each exposure and keeps the
 * largest value of a pixel.
 */
#include "core/score/flip.h"

#include "core/base/parallel.h"
#include "core/score/flip_colour.h"
#include "core/score/flip_exposure.h"
#include "core/score/flip_filter.h"
#include "core/score/quantile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Constants of the 2020 paper, sections 4.1 to 4.3. */
static const float qc = 0.7f;  /* exponent of colour differences */
static const float pc = 0.4f;  /* share of the largest difference ... */
static const float pt = 0.95f; /* ... that is taken to this value */
static const float qf = 0.5f;  /* exponent of feature differences */

enum { TEST, REFERENCE, IMAGES };

/* What is filtered horizontally, and what comes out vertically. */
enum { H_Y, H_CX, H_CZ0, H_CZ1, H_GAUSS, H_EDGE, H_POINT, H_PLANES };
enum { V_Y, V_CX, V_CZ, V_EDGE_X, V_EDGE_Y, V_POINT_X, V_POINT_Y, V_ROWS };

enum { BAND = 8 }; /* rows that a thread takes at a time */

struct flip {
    const struct irb_image *image[IMAGES];
    bool hdr;
    float gain; /* 2^exposure */
    int width, height;
    struct irb_flip_filters filters;
    float largest_difference; /* between display colours: HyAB(green, blue)^qc */
    int threads;
    float *planes;     /* IMAGES x H_PLANES x height x width */
    float *scratch;    /* a block for each thread */
    size_t per_thread; /* floats */
    float *out;        /* height x width; keeps the maximum over passes */
    float *exposure;   /* NULL, or the pass that made it, as a fraction */
    float pass;        /* this one, as a fraction */
    bool first_pass;
};

static float *plane_row(const struct flip *f, int image, int plane, int y)
{
    size_t index = ((size_t)image * H_PLANES + (size_t)plane) * (size_t)f->height + (size_t)y;
    return f->planes + index * (size_t)f->width;
}

/* IEC 61966-2-1. */
static float srgb_decode(float v)
{
    return v <= 0.04045f ? v / 12.92f : powf((v + 0.055f) / 1.055f, 2.4f);
}

/* The displayed colour in [0,1], linear. */
static float displayed(const struct flip *f, float v)
{
    const float bound = 1e18f; /* its square is finite */
    if (!(v > 0))
        return 0; /* NaN too */
    if (!f->hdr)
        return srgb_decode(v > 1 ? 1 : v);
    v *= f->gain;
    return irb_aces(v < bound ? v : bound);
}

static void convert_row(const struct flip *f, int image, int y, float *row_y, float *row_cx,
                        float *row_cz)
{
    const float *in = irb_image_at(f->image[image], 0, y);
    for (int x = 0; x < f->width; x++) {
        float rgb[3];
        for (int c = 0; c < 3; c++)
            rgb[c] = displayed(f, in[3 * x + c]);
        struct irb_opponent colour = irb_rgb_to_opponent(rgb);
        row_y[x] = colour.y;
        row_cx[x] = colour.cx;
        row_cz[x] = colour.cz;
    }
}

/* Repeats the first and last value outside the row: the filters clamp to the edge. */
static void pad_row(float *row, int width, int radius)
{
    for (int k = 1; k <= radius; k++) {
        row[-k] = row[0];
        row[width - 1 + k] = row[width - 1];
    }
}

static void filter_horizontally(const struct flip *f, const struct irb_flip_kernel *kernel,
                                const float *row, float *out)
{
    const float *taps[2 * IRB_FLIP_MAX_RADIUS + 1];
    for (int k = -kernel->radius; k <= kernel->radius; k++)
        taps[kernel->radius + k] = row + k;
    irb_flip_apply(kernel, taps + kernel->radius, f->width, out);
}

static bool horizontal_band(void *user, int band, int thread)
{
    const struct flip *f = user;
    const struct irb_flip_filters *filters = &f->filters;
    int radius = filters->radius;
    size_t stride = (size_t)f->width + 2 * (size_t)radius;
    float *rows[3];
    for (int i = 0; i < 3; i++)
        rows[i] = f->scratch + (size_t)thread * f->per_thread + (size_t)i * stride + radius;
    int image = band % IMAGES, first = band / IMAGES * BAND;
    for (int y = first; y < first + BAND && y < f->height; y++) {
        convert_row(f, image, y, rows[0], rows[1], rows[2]);
        for (int i = 0; i < 3; i++)
            pad_row(rows[i], f->width, radius);
        const struct {
            const struct irb_flip_kernel *kernel;
            const float *row;
        } jobs[H_PLANES] = {
            [H_Y] = {&filters->achromatic, rows[0]},
            [H_CX] = {&filters->red_green, rows[1]},
            [H_CZ0] = {&filters->blue_yellow[0], rows[2]},
            [H_CZ1] = {&filters->blue_yellow[1], rows[2]},
            [H_GAUSS] = {&filters->gauss, rows[0]},
            [H_EDGE] = {&filters->edge, rows[0]},
            [H_POINT] = {&filters->point, rows[0]},
        };
        for (int i = 0; i < H_PLANES; i++)
            filter_horizontally(f, jobs[i].kernel, jobs[i].row, plane_row(f, image, i, y));
    }
    return true;
}

static void filter_vertically(const struct flip *f, const struct irb_flip_kernel *kernel, int image,
                              int plane, int y, float *out)
{
    const float *taps[2 * IRB_FLIP_MAX_RADIUS + 1];
    for (int k = -kernel->radius; k <= kernel->radius; k++) {
        int row = y + k < 0 ? 0 : y + k >= f->height ? f->height - 1 : y + k;
        taps[kernel->radius + k] = plane_row(f, image, plane, row);
    }
    irb_flip_apply(kernel, taps + kernel->radius, f->width, out);
}

/* Fills V_ROWS rows of `out`; `extra` is a row more. */
static void filter_row(const struct flip *f, int image, int y, float *const out[V_ROWS],
                       float *extra)
{
    const struct irb_flip_filters *k = &f->filters;
    filter_vertically(f, &k->achromatic, image, H_Y, y, out[V_Y]);
    filter_vertically(f, &k->red_green, image, H_CX, y, out[V_CX]);
    filter_vertically(f, &k->blue_yellow[0], image, H_CZ0, y, out[V_CZ]);
    filter_vertically(f, &k->blue_yellow[1], image, H_CZ1, y, extra);
    for (int x = 0; x < f->width; x++)
        out[V_CZ][x] = k->blue_yellow_share[0] * out[V_CZ][x] + k->blue_yellow_share[1] * extra[x];
    filter_vertically(f, &k->gauss, image, H_EDGE, y, out[V_EDGE_X]);
    filter_vertically(f, &k->edge, image, H_GAUSS, y, out[V_EDGE_Y]);
    filter_vertically(f, &k->gauss, image, H_POINT, y, out[V_POINT_X]);
    filter_vertically(f, &k->point, image, H_GAUSS, y, out[V_POINT_Y]);
}

/* Section 4.1: perceived colour difference, [0,1]. */
static float colour_difference(const struct flip *f, struct irb_opponent test,
                               struct irb_opponent reference)
{
    float d = irb_hyab(irb_opponent_to_hunt_lab(test), irb_opponent_to_hunt_lab(reference));
    d = powf(d, qc);
    float knee = pc * f->largest_difference;
    if (d < knee)
        return d * (pt / knee);
    return fminf(1, pt + (d - knee) / (f->largest_difference - knee) * (1 - pt));
}

static float length(float x, float y)
{
    return sqrtf(x * x + y * y);
}

/* Section 4.2: difference of edges and points, [0,1]. */
static float feature_difference(float *const test[V_ROWS], float *const reference[V_ROWS], int x)
{
    float edge = fabsf(length(test[V_EDGE_X][x], test[V_EDGE_Y][x]) -
                       length(reference[V_EDGE_X][x], reference[V_EDGE_Y][x]));
    float point = fabsf(length(test[V_POINT_X][x], test[V_POINT_Y][x]) -
                        length(reference[V_POINT_X][x], reference[V_POINT_Y][x]));
    return fminf(1, powf(0.70710678f * fmaxf(edge, point), qf));
}

static void compare_row(const struct flip *f, float *const test[V_ROWS],
                        float *const reference[V_ROWS], int y)
{
    size_t start = (size_t)y * (size_t)f->width;
    for (int x = 0; x < f->width; x++) {
        struct irb_opponent t = {test[V_Y][x], test[V_CX][x], test[V_CZ][x]};
        struct irb_opponent r = {reference[V_Y][x], reference[V_CX][x], reference[V_CZ][x]};
        float colour = colour_difference(f, t, r);
        /* Section 4.3. 0^0 is 1 and right only where features differ; there is a colour then. */
        float features = feature_difference(test, reference, x);
        float flip = powf(colour, 1 - features);
        if (!f->first_pass && !(flip > f->out[start + (size_t)x]))
            continue;
        f->out[start + (size_t)x] = flip;
        if (f->exposure)
            f->exposure[start + (size_t)x] = f->pass;
    }
}

static bool vertical_band(void *user, int band, int thread)
{
    const struct flip *f = user;
    float *scratch = f->scratch + (size_t)thread * f->per_thread, *rows[IMAGES][V_ROWS];
    for (int i = 0; i < IMAGES; i++)
        for (int r = 0; r < V_ROWS; r++)
            rows[i][r] = scratch + (size_t)(i * V_ROWS + r) * (size_t)f->width;
    float *extra = scratch + (size_t)(IMAGES * V_ROWS) * (size_t)f->width;
    for (int y = band * BAND; y < (band + 1) * BAND && y < f->height; y++) {
        for (int i = 0; i < IMAGES; i++)
            filter_row(f, i, y, rows[i], extra);
        compare_row(f, rows[TEST], rows[REFERENCE], y);
    }
    return true;
}

static void run_pass(struct flip *f)
{
    int bands = (f->height + BAND - 1) / BAND;
    irb_parallel_for(IMAGES * bands, f->threads, horizontal_band, f);
    irb_parallel_for(bands, f->threads, vertical_band, f);
}

static float difference_of_primaries(void)
{
    const float green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    float xyz[2][3];
    irb_rgb_to_xyz(green, xyz[0]);
    irb_rgb_to_xyz(blue, xyz[1]);
    return powf(irb_hyab(irb_xyz_to_hunt_lab(xyz[0]), irb_xyz_to_hunt_lab(xyz[1])), qc);
}

static bool check_images(const struct irb_image *test, const struct irb_image *reference,
                         struct irb_error *err)
{
    if (test->channels != 3 || reference->channels != 3)
        return irb_fail(err, IRB_E_INTERNAL, "FLIP: expected 3 channels, found %d and %d",
                        test->channels, reference->channels);
    if (test->width != reference->width || test->height != reference->height)
        return irb_fail(err, IRB_E_INPUT, "FLIP: images differ in size: %d x %d and %d x %d",
                        test->width, test->height, reference->width, reference->height);
    return true;
}

/* On failure what was allocated is in *f all the same; flip_finish frees it. */
static bool flip_start(struct flip *f, const struct irb_image *test,
                       const struct irb_image *reference, double ppd, int threads,
                       struct irb_error *err)
{
    *f = (struct flip){.image = {test, reference}, .first_pass = true};
    if (!check_images(test, reference, err))
        return false;
    if (!irb_flip_filters_init(&f->filters, ppd))
        return irb_fail(err, IRB_E_INPUT,
                        "FLIP: pixels per degree: expected above 0, at most 1000, found %g", ppd);
    f->width = test->width;
    f->height = test->height;
    f->largest_difference = difference_of_primaries();
    f->threads = threads > 0 ? threads : irb_core_count();
    size_t width = (size_t)f->width, pixels = irb_image_pixels(test);
    size_t horizontal = 3 * (width + 2 * (size_t)f->filters.radius);
    size_t vertical = (IMAGES * V_ROWS + 1) * width;
    f->per_thread = horizontal > vertical ? horizontal : vertical;
    f->planes = malloc(IMAGES * H_PLANES * pixels * sizeof *f->planes);
    f->scratch = malloc((size_t)f->threads * f->per_thread * sizeof *f->scratch);
    f->out = malloc(pixels * sizeof *f->out);
    if (!f->planes || !f->scratch || !f->out)
        return irb_fail(err, IRB_E_MEMORY, "FLIP of %d x %d pixels: out of memory", f->width,
                        f->height);
    return true;
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
        for (size_t i = 0; i < irb_image_pixels(f->image[TEST]); i++) {
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
        *map = (struct irb_image){f->width, f->height, 1, f->out};
        f->out = NULL;
    }
    free(f->planes);
    free(f->scratch);
    free(f->out);
    return ok;
}

bool irb_flip_ldr(const struct irb_image *test, const struct irb_image *reference,
                  const uint8_t *mask, double ppd, int threads, struct irb_image *map,
                  struct irb_flip_scores *scores, struct irb_error *err)
{
    struct flip f;
    bool ok = flip_start(&f, test, reference, ppd, threads, err);
    if (ok)
        run_pass(&f);
    return flip_finish(&f, ok, mask, map, scores, err);
}

static void run_exposures(struct flip *f, const struct irb_flip_exposures *exposures)
{
    f->hdr = true;
    for (int i = 0; i < exposures->count; i++) {
        double t = exposures->count > 1 ? (double)i / (exposures->count - 1) : 0;
        f->gain = (float)exp2(exposures->start + t * (exposures->stop - exposures->start));
        f->pass = (float)t;
        f->first_pass = i == 0;
        run_pass(f);
    }
}

bool irb_flip_hdr_maps(const struct irb_image *test, const struct irb_image *reference,
                       const uint8_t *mask, const struct irb_flip_exposures *exposures, double ppd,
                       int threads, struct irb_image *map, struct irb_image *exposure_map,
                       struct irb_flip_scores *scores, struct irb_error *err)
{
    struct flip f;
    struct irb_image exposure = {0};
    bool ok = flip_start(&f, test, reference, ppd, threads, err);
    if (ok && (exposures->count < 1 || !isfinite(exposures->start) || !isfinite(exposures->stop)))
        ok = irb_fail(err, IRB_E_INTERNAL, "FLIP: exposures %g to %g in %d steps", exposures->start,
                      exposures->stop, exposures->count);
    if (ok && exposure_map) {
        ok = irb_image_create(&exposure, test->width, test->height, 1, err);
        f.exposure = exposure.data;
    }
    if (ok)
        run_exposures(&f, exposures);
    ok = flip_finish(&f, ok, mask, map, scores, err);
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
