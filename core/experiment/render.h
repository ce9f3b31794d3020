/* SPDX-License-Identifier: MIT
 *
 * The stage render: every trial's frames, their times and statistics, into the run's folder.
 */
#ifndef IRB_EXPERIMENT_RENDER_H
#define IRB_EXPERIMENT_RENDER_H

#include "core/experiment/stage.h"

/* Renders the frames of every trial that the run lacks. */
bool irb_render_sequence(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err);

#endif
