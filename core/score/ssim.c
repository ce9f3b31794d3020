/* SPDX-License-Identifier: MIT
 *
 * Rows are filtered horizontally into a ring of as many rows as the window is high; what is
 * filtered vertically from it stays in the cache.
 */
#include "core/score/ssim.h"

#include "core/score/flip_math.h"

#include <math.h>
#include <stdlib.h>

enum { WINDOW = 2 * IRB_SSIM_RADIUS + 1 };
enum { MEAN_T, MEAN_R, SQUARE_T, SQUARE_R, PRODUCT, PLANES };

/* Wang 2004, section III.C. */
static const double sigma = 1.5;
static const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03; /* (K L)^2 */

struct ssim {
    int width; /* of the image */
    int inner; /* pixels of a row whose window fits */
    double weight[WINDOW];
    double *raw;  /* PLANES rows of `width` */
    double *ring; /* WINDOW x PLANES rows of `inner` */
    double *sums; /* PLANES rows of `inner` */
};

static bool ssim_create(struct ssim *s, int width, struct irb_error *err)
{
    *s = (struct ssim){.width = width, .inner = width - 2 * IRB_SSIM_RADIUS};
    double sum = 0;
    for (int i = 0; i < WINDOW; i++) {
        double t = (i - IRB_SSIM_RADIUS) / sigma;
        s->weight[i] = exp(-0.5 * t * t);
        sum += s->weight[i];
    }
    for (int i = 0; i < WINDOW; i++)
        s->weight[i] /= sum;
    s->raw = malloc((size_t)PLANES * (size_t)width * sizeof(double));
    s->ring = malloc((size_t)(WINDOW * PLANES) * (size_t)s->inner * sizeof(double));
    s->sums = malloc((size_t)PLANES * (size_t)s->inner * sizeof(double));
    return (s->raw && s->ring && s->sums) || irb_fail(err, IRB_E_MEMORY, "SSIM: out of memory");
}

static void ssim_destroy(struct ssim *s)
{
    free(s->raw);
    free(s->ring);
    free(s->sums);
}

static double *ring_row(const struct ssim *s, int y, int plane)
{
    return s->ring + (size_t)(y % WINDOW * PLANES + plane) * (size_t)s->inner;
}

IRB_FLIP_WIDE
static void products(const float *restrict test, const float *restrict reference, int width,
                     double *restrict out)
{
    double *restrict mean_t = out, *restrict mean_r = out + width;
    double *restrict square_t = out + 2 * width, *restrict square_r = out + 3 * width;
    double *restrict product = out + 4 * width;
    for (int x = 0; x < width; x++) {
        double t = test[x], r = reference[x];
        mean_t[x] = t;
        mean_r[x] = r;
        square_t[x] = t * t;
        square_r[x] = r * r;
        product[x] = t * r;
    }
}

/* out[x] = sum of weight[k] * row[k][x]. */
IRB_FLIP_WIDE
static void weigh(const double weight[WINDOW], const double *const row[WINDOW], int count,
                  double *restrict out)
{
    for (int x = 0; x < count; x++) {
        double sum = 0;
        for (int k = 0; k < WINDOW; k++)
            sum += weight[k] * row[k][x];
        out[x] = sum;
    }
}

static void filter_row(const struct ssim *s, const float *test, const float *reference, int y)
{
    products(test, reference, s->width, s->raw);
    for (int p = 0; p < PLANES; p++) {
        const double *shifted[WINDOW];
        for (int k = 0; k < WINDOW; k++)
            shifted[k] = s->raw + (size_t)p * (size_t)s->width + k;
        weigh(s->weight, shifted, s->inner, ring_row(s, y, p));
    }
}

/* Eq. 13 of the row whose window ends at row `last`. */
IRB_FLIP_WIDE
static void similarity(const double *restrict sums, int count, float *restrict out)
{
    for (int x = 0; x < count; x++) {
        double t = sums[MEAN_T * count + x], r = sums[MEAN_R * count + x];
        double variance_t = sums[SQUARE_T * count + x] - t * t;
        double variance_r = sums[SQUARE_R * count + x] - r * r;
        double covariance = sums[PRODUCT * count + x] - t * r;
        double numerator = (2 * t * r + c1) * (2 * covariance + c2);
        double denominator = (t * t + r * r + c1) * (variance_t + variance_r + c2);
        out[x] = (float)(numerator / denominator);
    }
}

static void similarity_row(const struct ssim *s, int last, float *out)
{
    for (int p = 0; p < PLANES; p++) {
        const double *rows[WINDOW];
        for (int k = 0; k < WINDOW; k++)
            rows[k] = ring_row(s, last - WINDOW + 1 + k, p);
        weigh(s->weight, rows, s->inner, s->sums + (size_t)p * (size_t)s->inner);
    }
    similarity(s->sums, s->inner, out);
}

static bool check_inputs(const struct irb_image *test, const struct irb_image *reference,
                         struct irb_error *err)
{
    if (test->channels != 1 || reference->channels != 1)
        return irb_fail(err, IRB_E_INTERNAL, "SSIM: expected 1 channel, found %d and %d",
                        test->channels, reference->channels);
    if (test->width != reference->width || test->height != reference->height)
        return irb_fail(err, IRB_E_INPUT, "SSIM: images differ in size: %d x %d and %d x %d",
                        test->width, test->height, reference->width, reference->height);
    return true;
}

static bool fill_map(struct irb_image *map, const struct irb_image *test,
                     const struct irb_image *reference, struct irb_error *err)
{
    struct ssim s;
    bool ok = ssim_create(&s, test->width, err);
    for (int y = 0; ok && y < test->height; y++) {
        filter_row(&s, irb_image_at(test, 0, y), irb_image_at(reference, 0, y), y);
        if (y >= WINDOW - 1)
            similarity_row(&s, y, irb_image_at(map, IRB_SSIM_RADIUS, y - IRB_SSIM_RADIUS));
    }
    ssim_destroy(&s);
    return ok;
}

/* Over the pixels whose window fits. */
static double masked_mean(const struct irb_image *map, const uint8_t *mask)
{
    double sum = 0;
    long count = 0;
    for (int y = IRB_SSIM_RADIUS; y < map->height - IRB_SSIM_RADIUS; y++)
        for (int x = IRB_SSIM_RADIUS; x < map->width - IRB_SSIM_RADIUS; x++) {
            if (mask && !mask[(size_t)y * (size_t)map->width + (size_t)x])
                continue;
            sum += *irb_image_at(map, x, y);
            count++;
        }
    return sum / (double)count;
}

bool irb_ssim(const struct irb_image *test, const struct irb_image *reference, const uint8_t *mask,
              struct irb_image *map, double *mean, struct irb_error *err)
{
    struct irb_image similarities = {0};
    if (map)
        *map = (struct irb_image){0};
    if (!check_inputs(test, reference, err) ||
        !irb_image_create(&similarities, test->width, test->height, 1, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(test); i++)
        similarities.data[i] = 1;
    bool ok = test->width < WINDOW || test->height < WINDOW ||
              fill_map(&similarities, test, reference, err);
    if (ok)
        *mean = masked_mean(&similarities, mask);
    if (ok && map)
        *map = similarities;
    else
        irb_image_destroy(&similarities);
    return ok;
}
