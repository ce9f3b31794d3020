/* SPDX-License-Identifier: MIT */
#include "core/report/tradeoff.h"
#include "core/report/grid.h"
#include "core/report/measure_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define M(name) IRB_METRIC_##name

/* ---- options ---- */

static const struct {
    const char *name;
    int metric;
} metrics[] = {{"flip", M(indirect_flip)},
               {"relmse", M(indirect_relmse)},
               {"rmse", M(indirect_rmse)},
               {"flicker", M(indirect_flicker)}};

bool irb_tradeoff_metric(const char *text, int *metric, struct irb_error *err)
{
    for (size_t i = 0; i < sizeof metrics / sizeof *metrics; i++) {
        if (!strcmp(text, metrics[i].name) || !strcmp(text, irb_metrics[metrics[i].metric].name)) {
            *metric = metrics[i].metric;
            return true;
        }
    }
    return irb_fail(err, IRB_E_USAGE,
                    "--metric: expected flip, relmse, rmse or flicker; found '%.64s'", text);
}

bool irb_tradeoff_check(const struct irb_analysis *analysis,
                        const struct irb_tradeoff_options *options, struct irb_error *err)
{
    double budgets[IRB_MOST_BUDGETS];
    for (int s = 0; s < analysis->scene_count; s++)
        if (irb_common_budgets(&analysis->scenes[s], options->metric, M(frame_ms), budgets))
            return true;
    return irb_fail(err, IRB_E_INPUT, "tradeoff: no trial has both %s and a time yet",
                    irb_metrics[options->metric].name);
}

int irb_tradeoff_budgets(const struct irb_analysis_scene *scene,
                         const struct irb_tradeoff_options *options, bool by_time,
                         double budgets[IRB_MOST_BUDGETS])
{
    double given = by_time ? options->ms : options->error;
    if (isnan(given))
        return by_time ? irb_common_budgets(scene, options->metric, M(frame_ms), budgets)
                       : irb_common_budgets(scene, M(frame_ms), options->metric, budgets);
    budgets[0] = given;
    return 1;
}

struct irb_question irb_tradeoff_question(const struct irb_tradeoff_options *options, int scene,
                                          bool by_time, double budget, const char *method)
{
    return (struct irb_question){scene, by_time ? options->metric : M(frame_ms),
                                 by_time ? M(frame_ms) : options->metric, budget, method};
}

/* ---- what is written for people ---- */

struct writing {
    const struct irb_analysis *analysis;
    const struct irb_tradeoff_options *options;
    enum irb_table_format format;
    bool colour;
    struct irb_str *out;
};

static const struct irb_analysis_scene *scene_of(const struct writing *w, int scene)
{
    return &w->analysis->scenes[scene];
}

static void add_name(struct irb_grid *grid, const struct irb_analysis_trial *trial)
{
    irb_grid_add(grid, trial->trial);
}

static void add_measure(struct irb_grid *grid, const struct irb_analysis_trial *trial, int metric)
{
    struct irb_str cell = {0};
    irb_measure_text(&cell, &trial->measures[metric], metric);
    irb_str_printf(&cell, "%s", trial->at_noise[metric] ? " (noise)" : "");
    irb_grid_take(grid, &cell);
}

static const char *name_of(int metric)
{
    switch (metric) {
    case M(indirect_flip):
        return "FLIP";
    case M(indirect_relmse):
        return "relMSE";
    case M(indirect_rmse):
        return "RMSE";
    case M(indirect_flicker):
        return "flicker";
    case M(gl_bytes):
        return "memory";
    default:
        return "frame time";
    }
}

/* "FLIP", "frame time [ms]" */
static void add_title(struct irb_grid *grid, int metric)
{
    const char *unit = metric == M(gl_bytes) ? "MiB" : irb_metrics[metric].unit;
    char *title = irb_asprintf(*unit ? "%s [%s]" : "%s", name_of(metric), unit);
    irb_grid_add(grid, title);
    free(title);
}

static void write_front(const struct writing *w, int s, int cost)
{
    const struct irb_analysis_scene *scene = scene_of(w, s);
    int error = w->options->metric;
    struct irb_grid grid = {.columns = 3, .left = 1};
    int *trials = calloc((size_t)scene->trial_count + 1, sizeof *trials);
    if (!trials)
        abort();
    int count = irb_scene_front_sorted(scene, error, cost, trials);
    irb_grid_add(&grid, "trial");
    add_title(&grid, cost);
    add_title(&grid, error);
    for (int i = 0; i < count; i++) {
        add_name(&grid, &scene->trials[trials[i]]);
        add_measure(&grid, &scene->trials[trials[i]], cost);
        add_measure(&grid, &scene->trials[trials[i]], error);
    }
    char *caption =
        irb_asprintf("%s, %s and %s: nothing measured beats these %d of %d in both", scene->name,
                     name_of(cost), name_of(error), count, scene->trial_count);
    if (count)
        irb_grid_write(&grid, w->format, w->colour, caption, w->out);
    free(caption);
    free(trials);
    irb_grid_free(&grid);
}

/* ---- the two questions ---- */

static void write_ties(const struct writing *w, const struct irb_question *q, const bool *ties,
                       const char *before)
{
    const struct irb_analysis_scene *scene = scene_of(w, q->scene);
    int count = 0;
    for (int t = 0; t < scene->trial_count; t++)
        if (ties[t])
            irb_str_printf(w->out, "%s%s", count++ ? ", " : before, scene->trials[t].trial);
}

/* "- least FLIP within 100 ms: acrsm, 0.207 [0.204, 0.211], in 98.1 ms; not distinguishable: ..."
 */
static void write_answer(const struct writing *w, const struct irb_question *q)
{
    const struct irb_analysis_scene *scene = scene_of(w, q->scene);
    struct irb_answer answer = irb_ask(w->analysis, q);
    bool by_time = q->bounded == M(frame_ms);
    irb_str_printf(w->out, by_time ? "- least %s within " : "- least time for %s at most ",
                   name_of(w->options->metric));
    irb_metric_text(w->out, q->bounded, q->bound);
    irb_str_printf(w->out, ": ");
    if (answer.trial >= 0) {
        const struct irb_analysis_trial *trial = &scene->trials[answer.trial];
        irb_str_printf(w->out, "%s, ", trial->trial);
        irb_measure_text(w->out, &trial->measures[q->wanted], q->wanted);
        irb_str_printf(w->out, "%s", by_time ? " in " : " ms with ");
        irb_measure_text(w->out, &trial->measures[q->bounded], q->bounded);
        irb_str_printf(
            w->out, "%s%s", by_time ? " ms" : "",
            trial->at_noise[w->options->metric] ? " (not above the reference's own noise)" : "");
        write_ties(w, q, answer.as_good, "; not distinguishable: ");
        write_ties(w, q, answer.untold, "; too few seeds or frames to tell: ");
    } else if (answer.nearest >= 0) {
        const struct irb_analysis_trial *trial = &scene->trials[answer.nearest];
        irb_str_printf(w->out, "no measured trial; the nearest is %s at ", trial->trial);
        irb_metric_text(w->out, q->bounded, trial->measures[q->bounded].interval.value);
    } else {
        irb_str_printf(w->out, "no trial has both values yet");
    }
    irb_str_printf(w->out, "\n");
    irb_answer_free(&answer);
}

static void write_answers(const struct writing *w, int s)
{
    for (int by_time = 1; by_time >= 0; by_time--) {
        double budgets[IRB_MOST_BUDGETS];
        int count = irb_tradeoff_budgets(scene_of(w, s), w->options, by_time, budgets);
        for (int i = 0; i < count; i++) {
            struct irb_question q = irb_tradeoff_question(w->options, s, by_time, budgets[i], NULL);
            write_answer(w, &q);
        }
    }
    irb_str_printf(w->out, "\n");
}

/* ---- methods at one budget ---- */

static void add_bracket(const struct writing *w, struct irb_grid *grid,
                        const struct irb_question *q)
{
    const struct irb_analysis_scene *scene = scene_of(w, q->scene);
    struct irb_bracket bracket = irb_bracket(w->analysis, q);
    struct irb_str cell = {0};
    if (!isnan(bracket.between)) {
        irb_metric_text(&cell, q->wanted, bracket.between);
        irb_str_printf(&cell, " (%s .. %s)", scene->trials[bracket.below].trial,
                       scene->trials[bracket.above].trial);
    }
    irb_grid_take(grid, &cell);
}

static void add_to_best(const struct writing *w, struct irb_grid *grid,
                        const struct irb_question *q, int trial, int best)
{
    struct irb_str cell = {0};
    if (trial == best) {
        irb_str_printf(&cell, "best");
    } else {
        struct irb_measure ratio =
            irb_analysis_ratio(w->analysis, q->scene, trial, best, q->wanted);
        irb_ratio_text(&cell, &ratio);
    }
    irb_grid_take(grid, &cell);
}

static void add_method(const struct writing *w, struct irb_grid *grid, const struct irb_question *q,
                       int best)
{
    const struct irb_analysis_scene *scene = scene_of(w, q->scene);
    struct irb_answer answer = irb_ask(w->analysis, q);
    irb_grid_add(grid, q->method);
    if (answer.trial >= 0) {
        const struct irb_analysis_trial *trial = &scene->trials[answer.trial];
        add_name(grid, trial);
        add_measure(grid, trial, q->bounded);
        add_measure(grid, trial, q->wanted);
        add_to_best(w, grid, q, answer.trial, best);
        add_bracket(w, grid, q);
    } else {
        struct irb_str cell = {0};
        irb_str_printf(&cell, "none");
        if (answer.nearest >= 0) {
            const struct irb_analysis_trial *trial = &scene->trials[answer.nearest];
            irb_str_printf(&cell, " (nearest: %s at ", trial->trial);
            irb_metric_text(&cell, q->bounded, trial->measures[q->bounded].interval.value);
            irb_str_printf(&cell, ")");
        }
        irb_grid_take(grid, &cell);
        for (int c = 0; c < 4; c++)
            irb_grid_add(grid, "");
    }
    irb_answer_free(&answer);
}

static void write_budget(const struct writing *w, int s, bool by_time, double budget)
{
    const struct irb_analysis_scene *scene = scene_of(w, s);
    struct irb_methods methods = irb_scene_methods(scene);
    struct irb_question q = irb_tradeoff_question(w->options, s, by_time, budget, NULL);
    struct irb_answer best = irb_ask(w->analysis, &q);
    struct irb_grid grid = {.columns = 6, .left = 2};
    struct irb_str caption = {0};
    irb_grid_add(&grid, "method");
    irb_grid_add(&grid, "measured trial");
    add_title(&grid, q.bounded);
    add_title(&grid, q.wanted);
    irb_grid_add(&grid, "to the best");
    irb_grid_add(&grid, "interpolated at the budget");
    for (int m = 0; m < methods.count; m++) {
        q.method = methods.list[m];
        add_method(w, &grid, &q, best.trial);
    }
    irb_str_printf(&caption, "%s: equal %s, at most ", scene->name, by_time ? "time" : "error");
    irb_metric_text(&caption, q.bounded, budget);
    irb_grid_write(&grid, w->format, w->colour, irb_str_text(&caption), w->out);
    irb_str_free(&caption);
    irb_grid_free(&grid);
    irb_answer_free(&best);
    free(methods.list);
}

static void write_equal(const struct writing *w, int s, bool by_time)
{
    double budgets[IRB_MOST_BUDGETS];
    int count = irb_tradeoff_budgets(scene_of(w, s), w->options, by_time, budgets);
    for (int i = 0; i < count; i++)
        write_budget(w, s, by_time, budgets[i]);
}

/* ---- all ---- */

static void heading(const struct writing *w, const char *text)
{
    if (w->format == IRB_TABLE_MD)
        irb_str_printf(w->out, "## %s\n\n", text);
    else
        irb_str_printf(w->out, "%s%s%s\n\n", w->colour ? "\033[1m" : "", text,
                       w->colour ? "\033[0m" : "");
}

static const char foot[] =
    "The trial named is a measured one within the budget: what a user can run. \"Interpolated\" is "
    "read off a straight line in\nlog-log between two measured points of the method's front, a "
    "guess. Intervals are 95 %, from seeds, else rounds (times),\nelse blocks of frames; ratios to "
    "the best are paired, ~ not distinguishable: the interval contains 1. (noise): not above\nthe "
    "reference's own; such errors count as equal, and the cheaper trial comes first. Where no "
    "budget was given, all methods have a measured trial within each "
    "of\nthose shown.\n";

void irb_tradeoff_write(const struct irb_analysis *analysis,
                        const struct irb_tradeoff_options *options, enum irb_table_format format,
                        bool colour, struct irb_str *out)
{
    struct writing w = {analysis, options, format, colour, out};
    heading(&w, "Fronts of error and frame time, error and memory");
    for (int s = 0; s < analysis->scene_count; s++) {
        write_front(&w, s, M(frame_ms));
        write_front(&w, s, M(gl_bytes));
    }
    heading(&w, "What a budget buys");
    for (int s = 0; s < analysis->scene_count; s++) {
        irb_str_printf(out, "%s\n%s", analysis->scenes[s].name, format == IRB_TABLE_MD ? "\n" : "");
        write_answers(&w, s);
    }
    heading(&w, "Equal time");
    for (int s = 0; s < analysis->scene_count; s++)
        write_equal(&w, s, true);
    heading(&w, "Equal error");
    for (int s = 0; s < analysis->scene_count; s++)
        write_equal(&w, s, false);
    irb_str_printf(out, "%s", foot);
}
