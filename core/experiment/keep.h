/* SPDX-License-Identifier: MIT
 *
 * Which images of a run stay: first, middle, worst and last frame of every trial (all with
 * --keep all), as a multi-layer EXR with the reference and the error maps, and as a PNG that shows
 * result, reference and error side by side.
 */
#ifndef IRB_EXPERIMENT_KEEP_H
#define IRB_EXPERIMENT_KEEP_H

#include "core/experiment/score_frame.h"

/* Writes the kept frames of a trial and removes the frame files that are not kept. */
bool irb_keep_trial(struct irb_run *run, const struct irb_sequence *sequence,
                    const struct irb_scored_trial *trial,
                    const struct irb_target_constants *constants, int worst,
                    struct irb_error *err);

/* Removes what the trials shared and nobody needs any more. */
bool irb_keep_shared(struct irb_run *run, const struct irb_sequence *sequence,
                     struct irb_error *err);

#endif
