/* SPDX-License-Identifier: MIT
 *
 * Every image metric between two images that stand alone: all pixels count, and what a run takes
 * from its sequence (eps, peak, exposures) is taken from the reference image.
 */
#ifndef IRB_SCORE_COMPARE_H
#define IRB_SCORE_COMPARE_H

#include "core/score/flip.h"

/* X(name, unit, one line). v is the image, r the reference, eps = (0.01 mean r)^2. */
#define IRB_COMPARE_METRICS(X)                                                                     \
    X(rmse, "", "sqrt(mean (v-r)^2)")                                                              \
    X(relmse, "", "mean (v-r)^2/(r^2+eps)")                                                        \
    X(smape, "", "mean |v-r|/(|v|+|r|+sqrt(eps))")                                                 \
    X(psnr, "dB", "20 log10(peak/RMSE), peak = 99.9th percentile of the reference's values")       \
    X(bias, "", "mean (v-r)")                                                                      \
    X(energy_ratio, "", "sum v / sum r")                                                           \
    X(ssim, "", "mean SSIM (Wang et al. 2004) on the luma of the displayed images")                \
    X(flip, "", "mean HDR-FLIP (Andersson et al. 2021)")                                           \
    X(ldr_flip, "", "mean LDR-FLIP (Andersson et al. 2020) of the displayed images")               \
    X(max_error, "", "largest |v-r| of a channel")                                                 \
    X(non_finite, "pixels", "pixels with a NaN or an infinity, left out of the errors")            \
    X(negative, "pixels", "pixels of v with a negative channel")

enum irb_compare_metric {
#define X(name, unit, doc) IRB_COMPARE_##name,
    IRB_COMPARE_METRICS(X)
#undef X
        IRB_COMPARE_COUNT
};

struct irb_compare_info {
    const char *name, *unit, *doc;
};
extern const struct irb_compare_info irb_compare_metrics[IRB_COMPARE_COUNT];

/* Index into irb_compare_metrics; -1 and IRB_E_USAGE, which names the nearest, for no metric. */
int irb_compare_find(const char *name, struct irb_error *err);

struct irb_comparison {
    double values[IRB_COMPARE_COUNT]; /* NaN where a metric is not defined */
    double eps, peak;
    double exposure; /* of the displayed images; 0: they are display-referred, shown as they are */
    bool lit;        /* else the reference is black and `flip` not defined */
    struct irb_flip_exposures exposures;
    /* maps of the image's size; owned. Those of FLIP are in [0,1]; flip is 0 where not defined. */
    struct irb_image difference; /* v - r, 3 channels */
    struct irb_image relmse, flip, ldr_flip, ssim;
    struct irb_image displayed_difference; /* as irb_displayed_difference() */
};

/* 3-channel images; IRB_E_INPUT where their sizes differ. display_referred: linear values that a
 * display emits, in [0,1]; else radiance, which is tone-mapped (Reinhard) at the exposure that
 * takes the reference's log-average luminance to 0.18. threads 0 = all cores; the values do not
 * depend on it. On failure nothing has to be destroyed. */
bool irb_compare(struct irb_comparison *out, const struct irb_image *test,
                 const struct irb_image *reference, bool display_referred, int threads,
                 struct irb_error *err);
void irb_comparison_destroy(struct irb_comparison *comparison);

#endif
