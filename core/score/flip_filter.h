/* SPDX-License-Identifier: MIT
 *
 * The filters of FLIP (Andersson et al. 2020, sections 4.1 and 4.2), all separable: the contrast
 * sensitivity functions are sums of at most two Gaussians, the feature detectors products of a
 * Gaussian and one of its derivatives. Private to core/score.
 */
#ifndef IRB_SCORE_FLIP_FILTER_H
#define IRB_SCORE_FLIP_FILTER_H

#include <stdbool.h>

enum { IRB_FLIP_MAX_RADIUS = 136 }; /* pixels: 1000 pixels per degree */

/* A one-dimensional kernel given by its weights at 0..radius; what the weight at -k is and how it
 * is applied depends on the kind. */
enum irb_flip_kind {
    IRB_FLIP_EVEN,  /* w(-k) = w(k) */
    IRB_FLIP_ODD,   /* w(-k) = -w(k), w(0) = 0 */
    IRB_FLIP_SECOND /* w(-k) = w(k), sum 0: applied to differences from the centre, so that a
                       constant gives exactly 0 */
};

struct irb_flip_kernel {
    enum irb_flip_kind kind;
    int radius;
    float weight[IRB_FLIP_MAX_RADIUS + 1];
};

struct irb_flip_filters {
    struct irb_flip_kernel achromatic, red_green; /* CSF: one Gaussian each; sum 1 */
    struct irb_flip_kernel blue_yellow[2];        /* CSF: two Gaussians; sum 1 each */
    float blue_yellow_share[2];                   /* of them in the filter; sum 1 */
    struct irb_flip_kernel gauss, edge, point;    /* Gaussian, first and second derivative */
    int radius;                                   /* the largest of all */
};

/* ppd in (0, 1000]; false outside. */
bool irb_flip_filters_init(struct irb_flip_filters *filters, double ppd);

/* out[x] = sum over k in -radius..radius of w(k) * tap[k][x], for x in 0..count-1. `tap` points at
 * the middle one. Taps are shifted rows for a vertical filter, one shifted pointer for a horizontal
 * one. `out` overlaps no tap. */
void irb_flip_apply(const struct irb_flip_kernel *kernel, const float *const *tap, int count,
                    float *out);

#endif
