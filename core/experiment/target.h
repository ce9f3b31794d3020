/* SPDX-License-Identifier: MIT
 *
 * What frames are scored against: the reference's layers composed with the G-buffer's albedo, and
 * the constants that hold for a whole sequence (means, FLIP exposures, preview exposure).
 */
#ifndef IRB_EXPERIMENT_TARGET_H
#define IRB_EXPERIMENT_TARGET_H

#include "core/experiment/stage.h"
#include "core/score/display.h"
#include "core/score/film_code.h"
#include "core/score/flip.h"
#include "core/score/lag.h"

#include <stdint.h>

/* An image as a display of the sequence's exposure shows it, for SSIM and LDR-FLIP. */
struct irb_target_view {
    struct irb_image luma;           /* 1 channel */
    struct irb_flip_reference *flip; /* owned */
};
bool irb_target_view_create(struct irb_target_view *view, const struct irb_image *radiance,
                            double exposure, int threads, struct irb_error *err);
void irb_target_view_destroy(struct irb_target_view *view);

/* One frame's reference images: radiance towards the eye, W/(m2 sr), 3 channels. */
struct irb_target {
    struct irb_gbuffer_image gbuffer;
    uint8_t *mask;           /* pixels that count: geometry, same surface in run and reference */
    struct irb_image direct; /* the core's own direct light (PCF shadows), shared by the trials */
    struct irb_image direct_reference; /* exact direct light */
    struct irb_image indirect; /* bounce 1 with exact visibility: the one target for rankings */
    struct irb_image full;     /* exact direct + bounce 1 */
    struct irb_image solution; /* exact direct + bounces 1..n */
    struct irb_image claim;    /* bounce 1 without visibility */
    double masked_share;       /* of the pixels with geometry */
    struct irb_flip_reference *flip_indirect, *flip_full; /* NULL until irb_target_prepare, or
                                                             where the sequence is black */
    struct irb_target_view view_indirect, view_full;      /* empty until irb_target_prepare */
    uint8_t *regions[IRB_MOST_REGIONS]; /* masks of the scene's regions; NULL until then */
    double noise_variance;              /* mean variance of `indirect` over counted pixels */
    struct irb_image deviation; /* of the irradiance's luminance by its own noise, over that; 1
                                   channel, 0 where it is black */
    struct irb_flip_reference *flip_noisy; /* of `indirect` with as much noise again; NULL until
                                              irb_target_prepare_noisy */
    double noise_relmse; /* the same relative to indirect^2 + eps: an error below it says nothing */
};

/* Constants of a sequence; each is stored with the run. */
struct irb_target_constants {
    double mean_indirect, mean_full, mean_solution, mean_claim;
    double eps_indirect, eps_full, eps_solution, eps_claim; /* of relMSE */
    struct irb_flip_exposures flip_indirect, flip_full;
    bool indirect_lit, full_lit;     /* false: a black reference, FLIP is not defined */
    double peak_indirect, peak_full; /* of PSNR: 99.9th percentile of the sequence's values */
    struct irb_film_scale film_indirect, film_full; /* of the run's films */
    double exposure;                                /* of previews, SSIM and LDR-FLIP */
    int profile_row;               /* of the sequence's pictures: see temporal_maps.h */
    bool view_rests;               /* neither camera nor objects move */
    struct irb_lag_reference *lag; /* the indirect images, NULL where no lag is scored; owned */
    double noise;                  /* reached, largest of the frames: see irb_reference_image */
};

/* constants may be NULL (noise_relmse is then 0). The direct light and the mask are read from the
 * run where they exist. */
bool irb_target_load(struct irb_target *target, const struct irb_run *run,
                     const struct irb_sequence *sequence, int frame,
                     const struct irb_target_constants *constants, struct irb_error *err);
void irb_target_destroy(struct irb_target *target);

/* What is made once for all trials: FLIP's and SSIM's views of the references (20 bytes a pixel and
 * exposure) and the regions' masks. */
bool irb_target_prepare(struct irb_target *target, const struct irb_scene_entry *entry,
                        const struct irb_target_constants *constants, int threads,
                        struct irb_error *err);
/* Makes flip_noisy; nothing where the sequence is black. The same noise in every call. */
bool irb_target_prepare_noisy(struct irb_target *target,
                              const struct irb_target_constants *constants, int threads,
                              struct irb_error *err);
void irb_target_unprepare(struct irb_target *target);

bool irb_target_constants_of(struct irb_target_constants *constants, const struct irb_run *run,
                             const struct irb_sequence *sequence, struct irb_error *err);
void irb_target_constants_destroy(struct irb_target_constants *constants);

#endif
