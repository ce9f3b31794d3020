/* SPDX-License-Identifier: MIT */
#ifndef IRB_EXPERIMENT_SCORE_STAGE_H
#define IRB_EXPERIMENT_SCORE_STAGE_H

#include "core/experiment/stage.h"

/* Scores the rendered frames that have no scores yet, then keeps or removes their images. */
bool irb_score_sequence(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err);

#endif
