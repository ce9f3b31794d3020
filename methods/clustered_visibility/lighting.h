/* SPDX-License-Identifier: MIT
 *
 * Irradiance of the split G-buffer from the VPLs, with soft shadows from one convolution shadow map
 * a VAL. Where not all maps fit, they are made and lit with in batches.
 */
#ifndef IRB_METHODS_CLUSTERED_VISIBILITY_LIGHTING_H
#define IRB_METHODS_CLUSTERED_VISIBILITY_LIGHTING_H

#include "core/frame/interleave.h"
#include "core/lights/csm.h"
#include "core/lights/lost_light.h"
#include "methods/clustered_visibility/vals.h"

struct cv_lighting_settings {
    bool visibility; /* false: V = 1, without maps */
    enum irb_raster_projection projection;
    int size;   /* texels a side of a map's face: a power of two */
    float near; /* m */
    int order;  /* M */
    enum irb_csm_prefilter prefilter;
    struct irb_csm_settings csm;
    float bound; /* largest geometry term cos cos/r^2, 1/m2; 0: none */
};

struct cv_lighting {
    struct irb_gl *gl; /* borrowed */
    struct irb_raster_maps *maps;
    struct irb_csm *csm;
    struct irb_lost_light lost;
    struct irb_program *programs[2][2]; /* visibility, bounded; of this csm */
};

/* All else may be zero. */
void cv_lighting_init(struct cv_lighting *lighting, struct irb_gl *gl);
void cv_lighting_destroy(struct cv_lighting *lighting);

/* Makes what the settings ask for; before the steps below. */
bool cv_lighting_prepare(struct cv_lighting *lighting, const struct irb_interleave *interleave,
                         const struct cv_lighting_settings *settings, int vals,
                         struct irb_error *err);

/* VALs first..first+count-1, those of one batch. */
struct cv_batch {
    int first, count;
};
/* The next batch, the first one where batch->count is negative; false when there is none left. All
 * VALs are one batch where visibility is off; no VAL at all is one empty batch. */
bool cv_lighting_next(const struct cv_lighting *lighting,
                      const struct cv_lighting_settings *settings, int vals,
                      struct cv_batch *batch);

bool cv_lighting_maps(struct cv_lighting *lighting, const struct irb_scene_gl *scene,
                      const struct cv_vals *vals, const struct cv_lighting_settings *settings,
                      const struct cv_batch *batch, struct irb_error *err);
/* Adds the light of the batch's VPLs to interleave->split; the first batch replaces what is there.
 */
bool cv_lighting_run(struct cv_lighting *lighting, const struct irb_interleave *interleave,
                     const struct cv_vals *vals, const struct cv_lighting_settings *settings,
                     const struct cv_batch *batch, struct irb_error *err);

/* Share of the irradiance that the bound took, [0,1]. Waits for the GPU. */
bool cv_lighting_lost(struct cv_lighting *lighting, const struct irb_interleave *interleave,
                      double *share, struct irb_error *err);

#endif
