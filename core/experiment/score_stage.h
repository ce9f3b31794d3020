/* SPDX-License-Identifier: MIT
 *
 * The stage score: metrics of the rendered frames against the reference, into the run's database.
 */
#ifndef IRB_EXPERIMENT_SCORE_STAGE_H
#define IRB_EXPERIMENT_SCORE_STAGE_H

#include "core/experiment/stage.h"

/* Scores the rendered frames that have no scores yet, then keeps or removes their images. */
bool irb_score_sequence(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err);

#endif
