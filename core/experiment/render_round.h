/* SPDX-License-Identifier: MIT
 *
 * A round: one pass over a scene's sequence in which every trial of one seed is rendered once. The
 * trials take turns frame by frame (A B A B ...), so that what the machine does meanwhile meets
 * them all.
 */
#ifndef IRB_EXPERIMENT_RENDER_ROUND_H
#define IRB_EXPERIMENT_RENDER_ROUND_H

#include "core/experiment/render_trial.h"

struct irb_round {
    int index; /* among the rounds of the scene */
    int seed, repeat;
    struct irb_trial_run **trials; /* borrowed; those of the seed */
    int trial_count;
    int number, count; /* this one of those that are left; since when; for progress */
    double since_s;
};

/* Whether a frame of it is missing; looks at each trial. */
bool irb_round_look(struct irb_round *round, const struct irb_passes *passes);

/* That nothing of it is missing, for progress. */
void irb_round_skip(const struct irb_round *round, struct irb_passes *passes);

/* That it is left for another process, for progress. */
void irb_round_leave_out(const struct irb_round *round, struct irb_passes *passes);

/* Renders what is missing. The states of the methods live no longer than the round. */
bool irb_round_render(struct irb_round *round, struct irb_passes *passes, struct irb_error *err);

/* Which of `count` trials comes at `place` of a frame. Over `count` turns each is first once. Steps
 * through the trials vary as well, as rotation alone would keep each behind the same one. */
int irb_round_order(int turn, int place, int count);

#endif
