/* SPDX-License-Identifier: MIT
 *
 * Irradiance of the split G-buffer from virtual lights, with soft shadows from one convolution
 * shadow map a VAL (Dong et al. 2009; thesis 3.2.5): E(x) = sum over VALs of V sum over their
 * lights of Phi F. Where not all maps fit, they are made and lit with in batches.
 */
#ifndef IRB_LIGHTS_VAL_LIGHTING_H
#define IRB_LIGHTS_VAL_LIGHTING_H

#include "core/frame/interleave.h"
#include "core/gl/timer.h"
#include "core/lights/csm.h"
#include "core/lights/lost_light.h"
#include "core/lights/vals.h"

/* What methods set by default, and where they have no option. Source: ours, for the reasons that
 * clustered-visibility gives with its options; Annen et al. 2007 for the scale. */
#define IRB_VALS_DEFAULT_COUNT 16
#define IRB_VALS_DEFAULT_W_X 1   /* of distances in diagonals of the scene */
#define IRB_VALS_DEFAULT_W_A 0.5 /* 1/rad */
#define IRB_VALS_DEFAULT_ITERATIONS 64
#define IRB_VALS_DEFAULT_START IRB_VALS_RESTART
#define IRB_VALS_DEFAULT_AREA IRB_VALS_AREA_MOMENT
#define IRB_VALS_DEFAULT_CENTRE IRB_VALS_CENTRE_LIFTED
#define IRB_VALS_DEFAULT_PROJECTION IRB_RASTER_PARABOLOID
#define IRB_VALS_DEFAULT_MAP_SIZE IRB_VALS_MAP_256
#define IRB_VALS_DEFAULT_NEAR 1e-3 /* diagonals of the scene */
#define IRB_CSM_DEFAULT_ORDER 4
#define IRB_CSM_DEFAULT_PREFILTER IRB_CSM_MIP
#define IRB_CSM_DEFAULT_OFFSET 0
#define IRB_CSM_DEFAULT_SCALE 2
#define IRB_CSM_DEFAULT_SEARCH_OFFSET 0.613
#define IRB_CSM_DEFAULT_SEARCH_SCALE 1
#define IRB_CSM_DEFAULT_PENUMBRA_SCALE 1
#define IRB_CSM_DEFAULT_DAMPING 0

/* What an option chooses, and texels a side of a map's face. */
enum irb_vals_map_size { IRB_VALS_MAP_64, IRB_VALS_MAP_128, IRB_VALS_MAP_256, IRB_VALS_MAP_512 };
extern const char *const irb_vals_map_size_names[]; /* "64", "128", "256", "512", NULL */
int irb_vals_map_side(int map_size);

struct irb_val_lighting_settings {
    bool visibility; /* false: V = 1, without maps */
    bool discs; /* F of the lights' areas (thesis eq. 5.5); else they are points, whatever their
                   area */
    enum irb_raster_projection projection;
    int size;   /* texels a side of a map's face: a power of two */
    float near; /* m */
    int order;  /* M */
    enum irb_csm_prefilter prefilter;
    struct irb_csm_settings csm;
    float bound; /* largest geometry term cos cos/r^2, 1/m2; 0: none */
};

struct irb_val_lighting {
    struct irb_gl *gl; /* borrowed */
    struct irb_raster_maps *maps;
    struct irb_csm *csm;
    struct irb_lost_light lost;
    struct irb_program *programs[2][2][2]; /* visibility, discs, bounded; of this csm */
};

/* All else may be zero. */
void irb_val_lighting_init(struct irb_val_lighting *lighting, struct irb_gl *gl);
void irb_val_lighting_destroy(struct irb_val_lighting *lighting);

/* Makes what the settings ask for; before the steps below. */
bool irb_val_lighting_prepare(struct irb_val_lighting *lighting,
                              const struct irb_interleave *interleave,
                              const struct irb_val_lighting_settings *settings, int vals,
                              struct irb_error *err);

/* Stages of a timer (core/gl/timer.h). */
struct irb_val_stages {
    int maps, basis, prefilter, light;
};
/* All light of `vals` VALs into interleave->split, batch by batch: maps, basis images, their
 * prefilter, light. A NULL timer times nothing. */
bool irb_val_lighting_shade(struct irb_val_lighting *lighting, const struct irb_scene_gl *scene,
                            const struct irb_interleave *interleave, const struct irb_vals *lights,
                            int vals, const struct irb_val_lighting_settings *settings,
                            struct irb_timer *timer, const struct irb_val_stages *stages,
                            struct irb_error *err);

/* ---- its steps ---- */

/* VALs first..first+count-1, those of one batch. */
struct irb_val_batch {
    int first, count;
};
/* The next batch, the first one where batch->count is negative; false when there is none left. All
 * VALs are one batch where visibility is off; no VAL at all is one empty batch. */
bool irb_val_lighting_next(const struct irb_val_lighting *lighting,
                           const struct irb_val_lighting_settings *settings, int vals,
                           struct irb_val_batch *batch);

bool irb_val_lighting_maps(struct irb_val_lighting *lighting, const struct irb_scene_gl *scene,
                           const struct irb_vals *vals,
                           const struct irb_val_lighting_settings *settings,
                           const struct irb_val_batch *batch, struct irb_error *err);
/* Adds the light of the lights of the batch's VALs to interleave->split; the first batch replaces
 * what is there.
 */
bool irb_val_lighting_run(struct irb_val_lighting *lighting,
                          const struct irb_interleave *interleave, const struct irb_vals *vals,
                          const struct irb_val_lighting_settings *settings,
                          const struct irb_val_batch *batch, struct irb_error *err);

/* Share of the irradiance that the bound took, [0,1]. Waits for the GPU. */
bool irb_val_lighting_lost(struct irb_val_lighting *lighting,
                           const struct irb_interleave *interleave, double *share,
                           struct irb_error *err);

#endif
