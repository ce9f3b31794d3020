/* SPDX-License-Identifier: MIT
 *
 * How much of a run is done, over all of its scenes and stages, and how long the rest will take: by
 * what each kind of work has cost so far.
 */
#ifndef IRB_EXPERIMENT_PROGRESS_H
#define IRB_EXPERIMENT_PROGRESS_H

#include "core/config/config.h"

enum irb_progress_kind {
    IRB_PROGRESS_REFERENCE, /* a unit is a frame */
    IRB_PROGRESS_RENDER,    /* a frame of a trial in a round, settle and warm-up frames as well */
    IRB_PROGRESS_SCORE,     /* a frame of a trial */
    IRB_PROGRESS_KINDS
};

struct irb_progress {
    struct {
        double total, done;   /* units */
        double made, seconds; /* of those done in this process, and their time */
        double guess_s;       /* a unit's time before any has been made */
    } kinds[IRB_PROGRESS_KINDS];
    enum irb_progress_kind
        kind; /* what is being worked on since since_s, and its last unit's share */
    double since_s, part;
    double shown;    /* the largest fraction that was told */
    double stored_s; /* when it was stored last */
    char what[192];  /* "render hall, seed 2 of 5" */
};

/* All that `stages` (enum irb_stage) of the config have to do, each trial with each of its seeds
 * listed in config->trials, each frame. */
struct irb_progress irb_progress_plan(const struct irb_config *config, unsigned stages);

/* Units of a trial in one round. */
int irb_progress_trial_units(const struct irb_config *config, const struct irb_trial *trial);

/* Times are of irb_clock_s(). Work begins; units are there already (references in the cache
 * are no work of the run's and leave the total); units have been made since it
 * began, or since the last step; a share in [0,1] of the next unit has. */
void irb_progress_begin(struct irb_progress *p, enum irb_progress_kind kind, double now_s);
void irb_progress_skip(struct irb_progress *p, enum irb_progress_kind kind, double units);
void irb_progress_step(struct irb_progress *p, double units, double now_s);
void irb_progress_part(struct irb_progress *p, double share);

/* In [0,1], and never less than before. */
double irb_progress_fraction(struct irb_progress *p);
/* Seconds, >= 0. */
double irb_progress_left_s(const struct irb_progress *p);

#endif
