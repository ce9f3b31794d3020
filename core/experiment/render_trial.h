/* SPDX-License-Identifier: MIT
 *
 * One trial while it is rendered: its state from round to round, what is left of it, and where its
 * images and times go.
 */
#ifndef IRB_EXPERIMENT_RENDER_TRIAL_H
#define IRB_EXPERIMENT_RENDER_TRIAL_H

#include "core/experiment/render_passes.h"

struct irb_trial_run {
    const struct irb_trial *trial; /* borrowed */
    int64_t id;                    /* in the store */
    unsigned needs;                /* enum irb_method_needs */

    /* Of the round: */
    int repeat;
    int last_frame; /* last frame that has to be rendered, -1 for none */
    void *state;    /* the method's; NULL when there is nothing to render */
    void *params;   /* of the frame that is being rendered; owned */
    struct irb_timer *timer;
    int64_t bytes;               /* of GL objects that the method holds */
    double create_ms, settle_ms; /* what it cost before frame 0 */
};

/* Adds the trial to the store, and its folder. Needs no OpenGL. */
bool irb_trial_run_open(struct irb_trial_run *trial, struct irb_run *run,
                        const struct irb_sequence *sequence, const struct irb_trial *of,
                        struct irb_error *err);

/* Says what is left to render in a repeat: sets repeat and last_frame. */
void irb_trial_run_look(struct irb_trial_run *trial, const struct irb_passes *passes, int repeat);

/* The method's state for a round, for passes in the pose of frame 0; and its end. */
bool irb_trial_run_begin(struct irb_trial_run *trial, struct irb_passes *passes,
                         struct irb_error *err);
void irb_trial_run_end(struct irb_trial_run *trial);

/* Whether this frame (negative while settling) has to be rendered in this round: because it is
 * missing, or because a missing one depends on it. */
bool irb_trial_run_needs_frame(const struct irb_trial_run *trial, const struct irb_passes *passes,
                               int frame);

/* Renders the frame and stores what is not there: image, statistics and times, or those times
 * alone in repeats >= 1. */
bool irb_trial_run_frame(struct irb_trial_run *trial, struct irb_passes *passes, int frame,
                         struct irb_error *err);

/* Whether all frames of a trial of the store are rendered, or scored already. */
bool irb_trial_is_rendered(const struct irb_run *run, const struct irb_sequence *sequence,
                           const struct irb_trial *trial);

#endif
