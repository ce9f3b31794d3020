/* SPDX-License-Identifier: MIT
 *
 * The metrics of one rendered frame, and how frames make up a sequence's figures. The names are
 * those of core/score/metric_list.h.
 */
#ifndef IRB_EXPERIMENT_SCORE_FRAME_H
#define IRB_EXPERIMENT_SCORE_FRAME_H

#include "core/experiment/target.h"
#include "core/score/metric_list.h"
#include "core/score/reproject.h"

struct irb_scored_trial {
    const struct irb_trial *trial;
    const char *scene;                   /* borrowed */
    const struct irb_scene_entry *entry; /* borrowed: the scene's regions */
    int64_t id;                          /* in the store */
};

/* What is compared: the method's result composed with albedo and direct light. */
struct irb_scored_frame {
    int frame; /* -1: empty */
    struct irb_image indirect, full;
};

/* NaN where a value is not defined. */
struct irb_frame_scores {
    bool present;
    double values[IRB_METRIC_COUNT];  /* as the list has them */
    double lag_errors[IRB_LAG_COUNT]; /* of the indirect image, see irb_lag_errors */
    double regions[IRB_MOST_REGIONS][IRB_REGION_METRIC_COUNT];
};

struct irb_score_context {
    const struct irb_target_constants *constants;
    const struct irb_target *target;
    const struct irb_target *previous_target; /* NULL in the first frame */
    const struct irb_reprojection *motion;    /* NULL while the view rests */
    const struct irb_config *settings;
};

bool irb_scored_trial_open(struct irb_scored_trial *scored, struct irb_run *run,
                           const struct irb_sequence *sequence, const struct irb_trial *trial,
                           struct irb_error *err);

bool irb_scored_frame_load(struct irb_scored_frame *out, const struct irb_run *run,
                           const struct irb_scored_trial *trial, int frame,
                           const struct irb_target *target, struct irb_error *err);
void irb_scored_frame_destroy(struct irb_scored_frame *frame);

/* Maps of the indirect image that scoring makes on its way; 1 channel, owned. */
struct irb_score_maps {
    struct irb_image flip;     /* HDR-FLIP; empty where the sequence is black */
    struct irb_image residual; /* |e_t - e_(t-1)| / mean reference; empty in the first frame */
};
void irb_score_maps_destroy(struct irb_score_maps *maps);

/* previous is NULL in the first frame. maps (NULL: not wanted) are to be destroyed after a failure
 * too. */
bool irb_score_frame(struct irb_frame_scores *scores, const struct irb_score_context *context,
                     const struct irb_scored_trial *trial, const struct irb_scored_frame *current,
                     const struct irb_scored_frame *previous, struct irb_score_maps *maps,
                     struct irb_error *err);

static inline bool irb_frame_scores_present(const struct irb_frame_scores *scores)
{
    return scores->present;
}

/* ---- score_sequence.c ---- */

/* All values are NaN, and `present` false. */
void irb_frame_scores_clear(struct irb_frame_scores *scores);

/* Stored under the metrics' names; those of a region as "indirect_rmse@REGION", lag errors as
 * "lag_error@TAU". */
bool irb_frame_scores_store(const struct irb_frame_scores *scores, struct irb_store *store,
                            const struct irb_scored_trial *trial, int frame, struct irb_error *err);
/* Fills what the store has, frames[0..count-1]. */
bool irb_frame_scores_read(struct irb_frame_scores *frames, int count, struct irb_store *store,
                           const struct irb_scored_trial *trial, struct irb_error *err);

/* The frame with the largest indirect relMSE. */
int irb_worst_frame(const struct irb_frame_scores *frames, int count);

/* Figures of the sequence under frame -1: RMSE and flicker as the root of the mean square over
 * frames, PSNR from that RMSE, energy ratios from the summed bias, counts as sums, all else as
 * means; and the lag. */
bool irb_sequence_scores_store(const struct irb_frame_scores *frames, int count,
                               const struct irb_target_constants *constants,
                               struct irb_store *store, const struct irb_scored_trial *trial,
                               struct irb_error *err);

/* Stores the constants as meta values "scene/NAME/...". */
bool irb_target_constants_store(const struct irb_target_constants *constants, struct irb_run *run,
                                const struct irb_sequence *sequence, struct irb_error *err);

#endif
