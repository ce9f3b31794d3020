/* SPDX-License-Identifier: MIT */
#include "core/score/flip_filter.h"

#include <math.h>

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

/* Two pairs of taps a turn: half the traffic to `out`. */
static void add_even(float *restrict out, int count, const float *restrict a,
                     const float *restrict b, float w, const float *restrict c,
                     const float *restrict d, float v)
{
    for (int x = 0; x < count; x++)
        out[x] += w * (a[x] + b[x]) + v * (c[x] + d[x]);
}

static void add_odd(float *restrict out, int count, const float *restrict a,
                    const float *restrict b, float w, const float *restrict c,
                    const float *restrict d, float v)
{
    for (int x = 0; x < count; x++)
        out[x] += w * (a[x] - b[x]) + v * (c[x] - d[x]);
}

static void add_second(float *restrict out, int count, const float *restrict a,
                       const float *restrict b, float w, const float *restrict c,
                       const float *restrict d, float v, const float *restrict centre)
{
    for (int x = 0; x < count; x++)
        out[x] += w * ((a[x] - centre[x]) + (b[x] - centre[x])) +
                  v * ((c[x] - centre[x]) + (d[x] - centre[x]));
}

void irb_flip_apply(const struct irb_flip_kernel *kernel, const float *const *tap, int count,
                    float *out)
{
    float middle = kernel->kind == IRB_FLIP_EVEN ? kernel->weight[0] : 0;
    for (int x = 0; x < count; x++)
        out[x] = middle * tap[0][x];
    for (int k = 1; k <= kernel->radius; k += 2) {
        /* An odd radius leaves the second pair of the last turn: weight 0. */
        bool both = k < kernel->radius;
        int l = both ? k + 1 : k;
        float w = kernel->weight[k], v = both ? kernel->weight[l] : 0;
        if (kernel->kind == IRB_FLIP_EVEN)
            add_even(out, count, tap[k], tap[-k], w, tap[l], tap[-l], v);
        else if (kernel->kind == IRB_FLIP_ODD)
            add_odd(out, count, tap[k], tap[-k], w, tap[l], tap[-l], v);
        else
            add_second(out, count, tap[k], tap[-k], w, tap[l], tap[-l], v, tap[0]);
    }
}
