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
    IRB_PROGRESS_PICTURES,  /* likewise, for the pictures of its sequence */
    IRB_PROGRESS_KEEP,      /* a frame of a trial that is kept */
    IRB_PROGRESS_KINDS
};

struct irb_progress {
    struct {
        double total, done;   /* units */
        double made, seconds; /* of those done in this process, and their time */
        double left_out;      /* of the total: for another process, for want of time */
        double of_trial;      /* units that each trial of a scene has after it has been rendered */
        double guess_s;       /* a unit's time before any has been made */
    } kinds[IRB_PROGRESS_KINDS];
    enum irb_progress_kind
        kind; /* what is being worked on since since_s, and its units that are not stepped yet */
    double since_s, part;
    double deadline_s; /* after it no round begins but scenes' first; by irb_clock_s() */
    double round, due; /* units of a round; that are rendered after the deadline as well */
    double shown;      /* the largest fraction that was told */
    double stored_s;   /* when it was stored last */
    char what[192];    /* "render hall, seed 2 of 5" */
};

/* All that `stages` (enum irb_stage) of the config have to do, each trial with each of its seeds
 * listed in config->trials, each frame. */
struct irb_progress irb_progress_plan(const struct irb_config *config, unsigned stages,
                                      bool keep_all);

/* Units of a trial in one round. */
int irb_progress_trial_units(const struct irb_config *config, const struct irb_trial *trial);

/* Times are of irb_clock_s(). Work begins; units are there already (references in the cache
 * are no work of the run's and leave the total); units have been made since it
 * began, or since the last step; so many of the next ones have, in parts as well. */
void irb_progress_begin(struct irb_progress *p, enum irb_progress_kind kind, double now_s);
void irb_progress_skip(struct irb_progress *p, enum irb_progress_kind kind, double units);
void irb_progress_skip_trials(struct irb_progress *p, enum irb_progress_kind kind, int trials);
void irb_progress_step(struct irb_progress *p, double units, double now_s);
void irb_progress_part(struct irb_progress *p, double units);

/* A round begins, and so many scenes after this one have a first. */
void irb_progress_round(struct irb_progress *p, int scenes_after);
/* Units stay undone, but take no time; all that follows rendering of so many trials. */
void irb_progress_leave_out(struct irb_progress *p, enum irb_progress_kind kind, double units);
void irb_progress_leave_out_trials(struct irb_progress *p, int trials);

/* In [0,1], and never less than before. */
double irb_progress_fraction(struct irb_progress *p);
/* Seconds, >= 0. Rounds for which there will be no time before the deadline are none of it. */
double irb_progress_left_s(const struct irb_progress *p, double now_s);

#endif
