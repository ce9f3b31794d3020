/* SPDX-License-Identifier: MIT
 *
 * The trials of a run: those of the config, or what --only names, each once for every seed.
 */
#ifndef IRB_EXPERIMENT_RUN_TRIALS_H
#define IRB_EXPERIMENT_RUN_TRIALS_H

#include "core/experiment/stage.h"

/* Sets trials and trial_count of *selected, a copy of *config; the seeds of a trial follow one
 * another. Parameters and names are borrowed from *config. IRB_E_USAGE for a name in --only that
 * the config lacks. */
bool irb_run_trials(struct irb_config *selected, const struct irb_config *config,
                    const struct irb_run_options *options, struct irb_error *err);
/* Likewise of a run's config, those of a scene that are rendered to their end: what can be scored.
 * A warning says how many are not. All where none is. The list is owned, what is in it borrowed. */
bool irb_run_rendered_trials(struct irb_config *rendered, const struct irb_run *run,
                             const struct irb_sequence *sequence, struct irb_error *err);
/* Whether all of the run's config is there: of every scene, trial and seed all repeats, and the
 * scores of the sequence. */
bool irb_run_is_whole(const struct irb_run *run);
void irb_run_trials_free(struct irb_config *selected);

#endif
