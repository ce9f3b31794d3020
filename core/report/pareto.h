/* SPDX-License-Identifier: MIT
 *
 * What is worth its cost: fronts of a scene's trials, and what a budget buys. Only measured points
 * answer: between two of them is a parameter that nobody ran. Partial trials take no part.
 *
 * Errors up to the noise's level count as one: which of them is less says nothing about methods,
 * and the cheaper is as good. The level is the reference's noise, where it is known in the error's
 * unit, or the largest error of the scene's trials that are not above it; there is none where all
 * are above.
 */
#ifndef IRB_REPORT_PARETO_H
#define IRB_REPORT_PARETO_H

#include "core/report/analysis.h"

/* front[i]: no other point is at most as large in both and less in one. Points without one of the
 * two are not on it; equal points are on it together. Smaller is better in both. */
void irb_pareto_front(const double *error, const double *cost, int count, bool *front);

/* The front of a scene's trials by two metrics that are the better the lower. method: of its
 * trials alone; NULL for all. front: trial_count. */
void irb_scene_front(const struct irb_analysis_scene *scene, const char *method, int error,
                     int cost, bool *front);
/* The trials on the front of all methods in order of their cost, as indices; room for all trials.
 * Returns how many. */
int irb_scene_front_sorted(const struct irb_analysis_scene *scene, int error, int cost,
                           int *trials);

/* "The least `wanted` where `bounded` is at most `bound`": the least error within a time, or the
 * least time for an error. */
struct irb_question {
    int scene;
    int wanted, bounded;
    double bound;
    const char *method; /* of its trials alone; NULL for all */
};
struct irb_answer {
    int trial;     /* -1 where none meets the bound */
    bool *as_good; /* trials within the bound that are as much of `wanted`, or not distinguishable
                      from it by the paired ratio, itself not among them; owned */
    bool *untold;  /* trials within the bound of which it is not known: no interval; owned */
    int nearest;   /* the trial with the least `bounded` of all, which says by how much the bound is
                      missed; -1 where no trial has both values */
};
struct irb_answer irb_ask(const struct irb_analysis *analysis, const struct irb_question *question);
void irb_answer_free(struct irb_answer *answer);

/* Where a method's front passes a bound: the measured points on both sides, and what a straight
 * line between them in log `wanted` over log `bounded` would give. */
struct irb_bracket {
    int below, above; /* trials; -1 where the front ends */
    double between;   /* NaN without both */
};
struct irb_bracket irb_bracket(const struct irb_analysis *analysis,
                               const struct irb_question *question);

/* Up to three bounds, spread evenly in log from where the front (wanted, bounded) of the last
 * method begins, so that all methods have a point within each, to where the first one ends; where
 * that is before, to where the last one ends. One where all of it is one value, none where no
 * method has a point. Returns how many. */
enum { IRB_MOST_BUDGETS = 3 };
int irb_common_budgets(const struct irb_analysis_scene *scene, int wanted, int bounded,
                       double budgets[IRB_MOST_BUDGETS]);

/* The methods of a scene in order of appearance, borrowed from it. */
struct irb_methods {
    const char **list; /* owned */
    int count;
};
struct irb_methods irb_scene_methods(const struct irb_analysis_scene *scene);

#endif
