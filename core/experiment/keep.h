/* SPDX-License-Identifier: MIT
 *
 * Which images of a run stay: first, middle, worst and last frame of every trial (all with
 * --keep all), as a multi-layer EXR with the reference and the error maps, and as a PNG that shows
 * result, reference and error side by side. With the frame stay its debug layers, where it has any.
 */
#ifndef IRB_EXPERIMENT_KEEP_H
#define IRB_EXPERIMENT_KEEP_H

#include "core/experiment/score_frame.h"

struct irb_keep {
    struct irb_run *run;
    struct irb_sequence *sequence; /* changes its pose */
    const struct irb_target_constants *constants;
    const struct irb_scored_trial *trials; /* trial_count of them */
    const int *worst;                      /* each trial's worst frame */
    int trial_count;
};

/* Writes the pictures of the sequence (temporal_maps.h) and the kept frames of all trials, and
 * then removes the frame files and direct light that nobody needs any more. What an earlier run has
 * kept or removed stays as it is. */
bool irb_keep_images(const struct irb_keep *keep, struct irb_error *err);

#endif
