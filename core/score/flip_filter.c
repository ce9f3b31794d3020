/* SPDX-License-Identifier: MIT */
#include "core/score/flip_filter.h"

#include "core/score/flip_math.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Contrast sensitivity (2020 paper, section 4.1): a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees. */
struct csf_term {
    double a, b;
};
static const struct csf_term csf_achromatic = {1, 0.0047};
static const struct csf_term csf_red_green = {1, 0.0053};
static const struct csf_term csf_blue_yellow[2] = {{34.1, 0.04}, {13.5, 0.025}};
static const double csf_widest_b = 0.04; /* sets one radius for all, 3 standard deviations */

static const double feature_width =
    0.082; /* w of section 4.2, degrees: the detectors' full width */

/* Taps that add less than this, relative to the centre, are below a float's resolution. */
static const double negligible = 1e-10;

static void normalise(double *w, int radius, enum irb_flip_kind kind)
{
    if (kind == IRB_FLIP_EVEN) {
        double sum = w[0];
        for (int k = 1; k <= radius; k++)
            sum += 2 * w[k];
        for (int k = 0; k <= radius; k++)
            w[k] /= sum;
        return;
    }
    /* Positive weights sum to 1 and negative ones to -1; an odd kernel has one sign a side. */
    double positive = 0, negative = 0;
    for (int k = 0; k <= radius; k++) {
        double copies = kind == IRB_FLIP_SECOND && k > 0 ? 2 : 1;
        *(w[k] > 0 ? &positive : &negative) += copies * fabs(w[k]);
    }
    for (int k = 0; k <= radius; k++)
        w[k] /= w[k] > 0 ? positive : negative > 0 ? negative : 1;
}

static void store(struct irb_flip_kernel *kernel, enum irb_flip_kind kind, double *w, int radius)
{
    normalise(w, radius, kind);
    while (radius > 0 && fabs(w[radius]) <= negligible * fabs(w[0]) && kind == IRB_FLIP_EVEN)
        radius--;
    kernel->kind = kind;
    kernel->radius = radius;
    for (int k = 0; k <= radius; k++)
        kernel->weight[k] = (float)w[k];
}

/* One Gaussian of a CSF; returns the sum of its two-dimensional weights before normalisation. */
static double csf_kernel(struct irb_flip_kernel *kernel, struct csf_term term, int radius,
                         double ppd)
{
    double w[IRB_FLIP_MAX_RADIUS + 1], sum = 0;
    for (int k = 0; k <= radius; k++) {
        double x = k / ppd;
        w[k] = exp(-pi * pi * x * x / term.b);
        sum += k ? 2 * w[k] : w[k];
    }
    store(kernel, IRB_FLIP_EVEN, w, radius);
    return term.a * sqrt(pi / term.b) * sum * sum;
}

static void feature_kernels(struct irb_flip_filters *f, double ppd)
{
    double sigma = 0.5 * feature_width * ppd;
    int radius = (int)ceil(3 * sigma);
    double gauss[IRB_FLIP_MAX_RADIUS + 1], edge[IRB_FLIP_MAX_RADIUS + 1];
    double point[IRB_FLIP_MAX_RADIUS + 1];
    for (int k = 0; k <= radius; k++) {
        double t = k / sigma;
        gauss[k] = exp(-0.5 * t * t);
        edge[k] = k * gauss[k]; /* the sign cancels in the gradient's length */
        point[k] = (t * t - 1) * gauss[k];
    }
    store(&f->gauss, IRB_FLIP_EVEN, gauss, radius);
    store(&f->edge, IRB_FLIP_ODD, edge, radius);
    store(&f->point, IRB_FLIP_SECOND, point, radius);
}

static int widest(const struct irb_flip_filters *f)
{
    const struct irb_flip_kernel *all[] = {&f->achromatic,     &f->red_green, &f->blue_yellow[0],
                                           &f->blue_yellow[1], &f->gauss,     &f->edge,
                                           &f->point};
    int radius = 0;
    for (int i = 0; i < 7; i++)
        radius = all[i]->radius > radius ? all[i]->radius : radius;
    return radius;
}

bool irb_flip_filters_init(struct irb_flip_filters *f, double ppd)
{
    if (!(ppd > 0 && ppd <= 1000))
        return false;
    int radius = (int)ceil(3 * sqrt(csf_widest_b / (2 * pi * pi)) * ppd);
    csf_kernel(&f->achromatic, csf_achromatic, radius, ppd);
    csf_kernel(&f->red_green, csf_red_green, radius, ppd);
    double sum[2];
    for (int i = 0; i < 2; i++)
        sum[i] = csf_kernel(&f->blue_yellow[i], csf_blue_yellow[i], radius, ppd);
    for (int i = 0; i < 2; i++)
        f->blue_yellow_share[i] = (float)(sum[i] / (sum[0] + sum[1]));
    feature_kernels(f, ppd);
    f->radius = widest(f);
    return true;
}

/* Pixels that are filtered together, their sums in registers. */
enum { LANES = 4, VECTORS = 4, BLOCK = LANES * VECTORS };
typedef float vec __attribute__((vector_size(LANES * sizeof(float))));

/* Rows are not aligned. */
static inline void load(vec *v, const float *p)
{
    memcpy(v, p, sizeof *v);
}

/* What a pair of taps adds; the same operations for one pixel and for several. */
#define PAIR(kind, w, a, b, c)                                                                     \
    ((kind) == IRB_FLIP_EVEN  ? (w) * ((a) + (b))                                                  \
     : (kind) == IRB_FLIP_ODD ? (w) * ((a) - (b))                                                  \
                              : (w) * (((a) - (c)) + ((b) - (c))))

static inline void apply_block(enum irb_flip_kind kind, const struct irb_flip_kernel *kernel,
                               const float *const *tap, int x, float *out)
{
    vec sum[VECTORS], centre[VECTORS];
    float middle = kind == IRB_FLIP_EVEN ? kernel->weight[0] : 0;
    for (int i = 0; i < VECTORS; i++) {
        load(&centre[i], tap[0] + x + i * LANES);
        sum[i] = middle * centre[i];
    }
    for (int k = 1; k <= kernel->radius; k++) {
        const float *a = tap[k] + x, *b = tap[-k] + x;
        float w = kernel->weight[k];
        for (int i = 0; i < VECTORS; i++) {
            vec right, left;
            load(&right, a + i * LANES);
            load(&left, b + i * LANES);
            sum[i] += PAIR(kind, w, right, left, centre[i]);
        }
    }
    for (int i = 0; i < VECTORS; i++)
        memcpy(out + x + i * LANES, &sum[i], sizeof sum[i]);
}

static inline void apply_pixel(enum irb_flip_kind kind, const struct irb_flip_kernel *kernel,
                               const float *const *tap, int x, float *out)
{
    float centre = tap[0][x], sum = kind == IRB_FLIP_EVEN ? kernel->weight[0] * centre : 0;
    for (int k = 1; k <= kernel->radius; k++)
        sum += PAIR(kind, kernel->weight[k], tap[k][x], tap[-k][x], centre);
    out[x] = sum;
}

static inline void apply(enum irb_flip_kind kind, const struct irb_flip_kernel *kernel,
                         const float *const *tap, int count, float *out)
{
    int x = 0;
    for (; x + BLOCK <= count; x += BLOCK)
        apply_block(kind, kernel, tap, x, out);
    for (; x < count; x++)
        apply_pixel(kind, kernel, tap, x, out);
}

/* One loop for each kind: the compiler sees which it is. */
IRB_FLIP_WIDE
void irb_flip_apply(const struct irb_flip_kernel *kernel, const float *const *tap, int count,
                    float *out)
{
    if (kernel->kind == IRB_FLIP_EVEN)
        apply(IRB_FLIP_EVEN, kernel, tap, count, out);
    else if (kernel->kind == IRB_FLIP_ODD)
        apply(IRB_FLIP_ODD, kernel, tap, count, out);
    else
        apply(IRB_FLIP_SECOND, kernel, tap, count, out);
}
