/* SPDX-License-Identifier: MIT */
#include "core/report/pareto.h"
#include "core/report/analysis_units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- fronts ---- */

static bool dominates(const double *error, const double *cost, int i, int j)
{
    return error[i] <= error[j] && cost[i] <= cost[j] && (error[i] < error[j] || cost[i] < cost[j]);
}

void irb_pareto_front(const double *error, const double *cost, int count, bool *front)
{
    for (int j = 0; j < count; j++) {
        front[j] = !isnan(error[j]) && !isnan(cost[j]);
        for (int i = 0; front[j] && i < count; i++)
            front[j] = !dominates(error, cost, i, j);
    }
}

static void *allocate(int count, size_t size)
{
    void *list = calloc((size_t)count + 1, size);
    if (!list)
        abort(); /* a table's worth of numbers: nothing that holds results is lost */
    return list;
}

/* NaN of a trial that is not comparable. */
static double value_of(const struct irb_analysis_scene *scene, int trial, int metric)
{
    const struct irb_analysis_trial *of = &scene->trials[trial];
    return of->partial ? NAN : of->measures[metric].interval.value;
}

/* See the header; -infinity where there is none. */
static double noise_level(const struct irb_analysis_scene *scene, int metric)
{
    double level = -INFINITY;
    for (int t = 0; t < scene->trial_count; t++) {
        const struct irb_analysis_trial *trial = &scene->trials[t];
        if (trial->at_noise[metric] && !trial->partial) /* fmax leaves out what is NaN */
            level = fmax(level, fmax(value_of(scene, t, metric), irb_trial_noise(trial, metric)));
    }
    return level;
}

/* Values of all trials, for comparing: what is below the noise's level is lifted to it. Free it. */
static double *levelled(const struct irb_analysis_scene *scene, int metric)
{
    double *values = allocate(scene->trial_count, sizeof *values);
    double level = noise_level(scene, metric);
    for (int t = 0; t < scene->trial_count; t++) {
        double value = value_of(scene, t, metric);
        values[t] = value < level ? level : value;
    }
    return values;
}

static bool is_of(const struct irb_analysis_scene *scene, int trial, const char *method)
{
    return !method || !strcmp(scene->trials[trial].method, method);
}

void irb_scene_front(const struct irb_analysis_scene *scene, const char *method, int error,
                     int cost, bool *front)
{
    double *errors = levelled(scene, error), *costs = levelled(scene, cost);
    for (int t = 0; t < scene->trial_count; t++)
        errors[t] = is_of(scene, t, method) ? errors[t] : NAN;
    irb_pareto_front(errors, costs, scene->trial_count, front);
    free(errors);
    free(costs);
}

int irb_scene_front_sorted(const struct irb_analysis_scene *scene, int error, int cost, int *trials)
{
    bool *front = allocate(scene->trial_count, sizeof *front);
    int count = 0;
    irb_scene_front(scene, NULL, error, cost, front);
    for (int t = 0; t < scene->trial_count; t++) {
        if (!front[t])
            continue;
        int at = count++;
        for (; at > 0 && value_of(scene, t, cost) < value_of(scene, trials[at - 1], cost); at--)
            trials[at] = trials[at - 1];
        trials[at] = t;
    }
    free(front);
    return count;
}

struct irb_methods irb_scene_methods(const struct irb_analysis_scene *scene)
{
    struct irb_methods methods = {.list = allocate(scene->trial_count, sizeof *methods.list)};
    for (int t = 0; t < scene->trial_count; t++) {
        bool known = false;
        for (int m = 0; m < methods.count; m++)
            known = known || !strcmp(methods.list[m], scene->trials[t].method);
        if (!known)
            methods.list[methods.count++] = scene->trials[t].method;
    }
    return methods;
}

/* ---- questions ---- */

/* NaN where the trial does not take part. */
static double bounded_of(const struct irb_analysis_scene *scene, const struct irb_question *q,
                         int trial)
{
    bool takes_part = is_of(scene, trial, q->method) && !isnan(value_of(scene, trial, q->wanted));
    return takes_part ? value_of(scene, trial, q->bounded) : NAN;
}

/* Finds who is as good as the answer, and of whom that is not known. */
static void find_ties(const struct irb_analysis *analysis, const struct irb_question *q,
                      const double *wanted, struct irb_answer *answer)
{
    const struct irb_analysis_scene *scene = &analysis->scenes[q->scene];
    for (int t = 0; t < scene->trial_count; t++) {
        if (t == answer->trial || !(bounded_of(scene, q, t) <= q->bound))
            continue;
        enum irb_verdict verdict =
            irb_analysis_compare(analysis, q->scene, t, answer->trial, q->wanted);
        answer->as_good[t] = wanted[t] == wanted[answer->trial] || verdict == IRB_VERDICT_SAME;
        answer->untold[t] = !answer->as_good[t] && verdict == IRB_VERDICT_UNKNOWN;
    }
}

struct irb_answer irb_ask(const struct irb_analysis *analysis, const struct irb_question *q)
{
    const struct irb_analysis_scene *scene = &analysis->scenes[q->scene];
    struct irb_answer answer = {-1, allocate(scene->trial_count, sizeof(bool)),
                                allocate(scene->trial_count, sizeof(bool)), -1};
    double *wanted = levelled(scene, q->wanted), least = INFINITY, of_answer = INFINITY;
    for (int t = 0; t < scene->trial_count; t++) {
        double bounded = bounded_of(scene, q, t);
        if (bounded < least) {
            least = bounded;
            answer.nearest = t;
        }
        if (!(bounded <= q->bound))
            continue;
        /* less wanted, or as much of it and less of what is bounded */
        if (answer.trial < 0 || wanted[t] < wanted[answer.trial] ||
            (wanted[t] == wanted[answer.trial] && bounded < of_answer)) {
            answer.trial = t;
            of_answer = bounded;
        }
    }
    if (answer.trial >= 0)
        find_ties(analysis, q, wanted, &answer);
    free(wanted);
    return answer;
}

void irb_answer_free(struct irb_answer *answer)
{
    free(answer->as_good);
    free(answer->untold);
    answer->as_good = answer->untold = NULL;
}

struct irb_bracket irb_bracket(const struct irb_analysis *analysis, const struct irb_question *q)
{
    const struct irb_analysis_scene *scene = &analysis->scenes[q->scene];
    struct irb_bracket bracket = {-1, -1, NAN};
    bool *front = allocate(scene->trial_count, sizeof *front);
    irb_scene_front(scene, q->method, q->wanted, q->bounded, front);
    for (int t = 0; t < scene->trial_count; t++) {
        double bounded = bounded_of(scene, q, t);
        if (!front[t])
            continue;
        if (bounded <= q->bound &&
            (bracket.below < 0 || bounded > bounded_of(scene, q, bracket.below)))
            bracket.below = t;
        if (bounded > q->bound &&
            (bracket.above < 0 || bounded < bounded_of(scene, q, bracket.above)))
            bracket.above = t;
    }
    free(front);
    if (bracket.below < 0 || bracket.above < 0)
        return bracket;
    double x0 = bounded_of(scene, q, bracket.below), x1 = bounded_of(scene, q, bracket.above);
    double y0 = value_of(scene, bracket.below, q->wanted);
    double y1 = value_of(scene, bracket.above, q->wanted);
    if (x0 > 0 && y0 > 0 && y1 > 0)
        bracket.between = y0 * pow(y1 / y0, log(q->bound / x0) / log(x1 / x0));
    return bracket;
}

/* ---- budgets ---- */

/* The least and the largest `bounded` on a method's front; false where it has none. */
static bool front_range(const struct irb_analysis_scene *scene, const char *method, int wanted,
                        int bounded, double *least, double *most)
{
    bool *front = allocate(scene->trial_count, sizeof *front);
    double *values = levelled(scene, bounded);
    irb_scene_front(scene, method, wanted, bounded, front);
    *least = INFINITY;
    *most = -INFINITY;
    for (int t = 0; t < scene->trial_count; t++) {
        if (!front[t])
            continue;
        *least = fmin(*least, values[t]);
        *most = fmax(*most, values[t]);
    }
    free(front);
    free(values);
    return *least <= *most;
}

int irb_common_budgets(const struct irb_analysis_scene *scene, int wanted, int bounded,
                       double budgets[IRB_MOST_BUDGETS])
{
    struct irb_methods methods = irb_scene_methods(scene);
    double low = -INFINITY, high = INFINITY, end = -INFINITY, least, most;
    for (int m = 0; m < methods.count; m++) {
        if (!front_range(scene, methods.list[m], wanted, bounded, &least, &most))
            continue;
        low = fmax(low, least);
        high = fmin(high, most);
        end = fmax(end, most);
    }
    free(methods.list);
    if (low == -INFINITY)
        return 0;
    high = high > low ? high : end;
    budgets[0] = low;
    if (!(high > low) || !(low > 0) || isinf(high))
        return 1;
    for (int i = 1; i < IRB_MOST_BUDGETS - 1; i++)
        budgets[i] = low * pow(high / low, i / (IRB_MOST_BUDGETS - 1.0));
    budgets[IRB_MOST_BUDGETS - 1] = high;
    return IRB_MOST_BUDGETS;
}
