/* SPDX-License-Identifier: MIT
 *
 * What FLIP compares, of one image as it is displayed: its filtered colours and the strength of its
 * features (Andersson et al. 2020, sections 4.1 and 4.2). Private to core/score.
 */
#ifndef IRB_SCORE_FLIP_ANALYSIS_H
#define IRB_SCORE_FLIP_ANALYSIS_H

#include "core/image/image.h"
#include "core/score/flip_filter.h"

/* Planes of height x width floats. */
enum irb_flip_layer {
    IRB_FLIP_L, /* CSF-filtered colour in CIELab, a and b scaled by the Hunt effect */
    IRB_FLIP_A,
    IRB_FLIP_B,
    IRB_FLIP_EDGE, /* lengths of the detectors' gradients */
    IRB_FLIP_POINT,
    IRB_FLIP_LAYERS
};

/* How values become displayed, linear ones in [0,1]. */
enum irb_flip_encoding {
    IRB_FLIP_SRGB,   /* an sRGB-encoded image */
    IRB_FLIP_LINEAR, /* a displayed image whose encoding is undone */
    IRB_FLIP_ACES,   /* radiance: ACES tone map */
};
struct irb_flip_display {
    enum irb_flip_encoding encoding;
    float gain; /* 2^exposure, of IRB_FLIP_ACES */
};

/* Memory for analyses of images of one size: 28 bytes a pixel, and rows for each thread. */
struct irb_flip_analysis {
    const struct irb_flip_filters *filters; /* borrowed */
    int width, height, threads;
    float *planes;
    float *scratch;
    size_t per_thread; /* floats */
};

/* threads 0 = all cores. Also after a failure to be destroyed; so is one that is all 0. */
bool irb_flip_analysis_create(struct irb_flip_analysis *analysis,
                              const struct irb_flip_filters *filters, int width, int height,
                              int threads, struct irb_error *err);
void irb_flip_analysis_destroy(struct irb_flip_analysis *analysis);

/* Fills IRB_FLIP_LAYERS planes. The image has 3 channels and the analysis's size. The values do not
 * depend on the number of threads. */
void irb_flip_analyse(const struct irb_flip_analysis *analysis, const struct irb_image *image,
                      struct irb_flip_display display, float *layers);

#endif
