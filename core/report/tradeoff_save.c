/* SPDX-License-Identifier: MIT */
#include "core/base/fs.h"
#include "core/report/figures.h"
#include "core/report/table_cells.h"
#include "core/report/tradeoff.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a line of CSV is made from. */
struct line {
    const struct irb_analysis *analysis;
    const struct irb_tradeoff_options *options;
    struct irb_question question;
    int best; /* the trial that answers for all methods, or -1 */
};

static const struct irb_analysis_trial *trial_of(const struct line *l, int trial)
{
    return trial < 0 ? NULL : &l->analysis->scenes[l->question.scene].trials[trial];
}

static void csv_cell(struct irb_str *out, const char *text)
{
    irb_str_printf(out, ",");
    irb_csv_text(out, text);
}

static void csv_trial(struct irb_str *out, const struct irb_analysis_trial *trial)
{
    csv_cell(out, trial ? trial->trial : "");
}

static void csv_wanted(struct irb_str *out, const struct irb_analysis_trial *trial, int metric)
{
    static const struct irb_measure none = {{NAN, NAN, NAN, 0}, IRB_UNIT_NONE};
    const struct irb_measure *m = trial ? &trial->measures[metric] : &none;
    irb_csv_measure(out, m);
    irb_str_printf(out, ",%s", irb_unit_names[m->unit]);
}

static double value_of(const struct irb_analysis_trial *trial, int metric)
{
    return trial ? trial->measures[metric].interval.value : NAN;
}

/* scene,wanted,bounded,bound */
static void begin_line(const struct line *l, struct irb_str *out)
{
    const struct irb_question *q = &l->question;
    irb_csv_text(out, l->analysis->scenes[q->scene].name);
    csv_cell(out, irb_metrics[q->wanted].name);
    csv_cell(out, irb_metrics[q->bounded].name);
    irb_csv_number(out, q->bound);
}

static const char titles_begin[] = "scene,wanted,bounded,bound";

/* ---- answers.csv ---- */

static void csv_trials(struct irb_str *out, const struct irb_analysis_scene *scene,
                       const bool *chosen)
{
    struct irb_str names = {0};
    for (int t = 0; t < scene->trial_count; t++)
        if (chosen[t])
            irb_str_printf(&names, "%s%s", names.length ? ";" : "", scene->trials[t].trial);
    csv_cell(out, irb_str_text(&names));
    irb_str_free(&names);
}

static void answer_line(const struct line *l, struct irb_str *out)
{
    const struct irb_analysis_scene *scene = &l->analysis->scenes[l->question.scene];
    struct irb_answer answer = irb_ask(l->analysis, &l->question);
    const struct irb_analysis_trial *trial = trial_of(l, answer.trial);
    const struct irb_analysis_trial *nearest = trial ? NULL : trial_of(l, answer.nearest);
    begin_line(l, out);
    csv_cell(out, trial ? trial->method : "");
    csv_trial(out, trial);
    csv_wanted(out, trial, l->question.wanted);
    irb_csv_number(out, value_of(trial, l->question.bounded));
    csv_trials(out, scene, answer.as_good);
    csv_trial(out, nearest);
    irb_csv_number(out, value_of(nearest, l->question.bounded));
    csv_trials(out, scene, answer.untold);
    irb_str_printf(out, "\n");
    irb_answer_free(&answer);
}

/* Calls fn with the question for each budget. */
static void for_each_budget(const struct irb_analysis *analysis,
                            const struct irb_tradeoff_options *options, bool by_time,
                            void (*fn)(const struct line *line, struct irb_str *out),
                            struct irb_str *out)
{
    for (int s = 0; s < analysis->scene_count; s++) {
        double budgets[IRB_MOST_BUDGETS];
        int count = irb_tradeoff_budgets(&analysis->scenes[s], options, by_time, budgets);
        for (int i = 0; i < count; i++) {
            struct line line = {analysis, options,
                                irb_tradeoff_question(options, s, by_time, budgets[i], NULL), -1};
            fn(&line, out);
        }
    }
}

static void answers_csv(const struct irb_analysis *analysis,
                        const struct irb_tradeoff_options *options, struct irb_str *out)
{
    irb_str_printf(out,
                   "%s,method,trial,value,low,high,unit,bounded_value,not_distinguishable,nearest,"
                   "nearest_bounded_value,too_few_units\n",
                   titles_begin);
    for_each_budget(analysis, options, true, answer_line, out);
    for_each_budget(analysis, options, false, answer_line, out);
}

/* ---- equal-time.csv, equal-error.csv ---- */

static void method_line(const struct line *l, struct irb_str *out)
{
    const struct irb_question *q = &l->question;
    struct irb_answer answer = irb_ask(l->analysis, q);
    struct irb_bracket bracket = irb_bracket(l->analysis, q);
    const struct irb_analysis_trial *trial = trial_of(l, answer.trial);
    struct irb_measure ratio = {{NAN, NAN, NAN, 0}, IRB_UNIT_NONE};
    if (trial && l->best >= 0)
        ratio = irb_analysis_ratio(l->analysis, q->scene, answer.trial, l->best, q->wanted);
    begin_line(l, out);
    csv_cell(out, q->method);
    csv_trial(out, trial);
    csv_wanted(out, trial, q->wanted);
    irb_csv_number(out, value_of(trial, q->bounded));
    irb_csv_measure(out, &ratio);
    irb_csv_number(out, bracket.between);
    csv_trial(out, trial_of(l, bracket.below));
    csv_trial(out, trial_of(l, bracket.above));
    irb_str_printf(out, "\n");
    irb_answer_free(&answer);
}

static void method_lines(const struct line *l, struct irb_str *out)
{
    struct irb_methods methods = irb_scene_methods(&l->analysis->scenes[l->question.scene]);
    struct irb_answer best = irb_ask(l->analysis, &l->question);
    struct line line = *l;
    line.best = best.trial;
    for (int m = 0; m < methods.count; m++) {
        line.question.method = methods.list[m];
        method_line(&line, out);
    }
    irb_answer_free(&best);
    free(methods.list);
}

static void equal_csv(const struct irb_analysis *analysis,
                      const struct irb_tradeoff_options *options, bool by_time, struct irb_str *out)
{
    irb_str_printf(out,
                   "%s,method,trial,value,low,high,unit,bounded_value,ratio_to_best,ratio_low,"
                   "ratio_high,interpolated,below,above\n",
                   titles_begin);
    for_each_budget(analysis, options, by_time, method_lines, out);
}

/* ---- files ---- */

/* Writes FOLDER/name and empties the text. */
static bool save(const char *folder, const char *name, struct irb_str *text, struct irb_error *err)
{
    char *path = irb_asprintf("%s/%s", folder, name);
    bool ok = irb_fs_write(path, irb_str_text(text), text->length, err);
    irb_str_free(text);
    *text = (struct irb_str){0};
    free(path);
    return ok;
}

bool irb_tradeoff_save(const char *folder, const struct irb_analysis *analysis,
                       const struct irb_tradeoff_options *options, const char *images,
                       struct irb_error *err)
{
    struct irb_str text = {0};
    if (!irb_tradeoff_check(analysis, options, err) || !irb_fs_make_dirs(folder, err) ||
        !irb_figure_text(analysis, IRB_FIGURE_PARETO, NULL, &text, err) ||
        !save(folder, "pareto.csv", &text, err))
        return false;
    irb_str_printf(&text, "# Error against cost\n\n");
    irb_tradeoff_write(analysis, options, IRB_TABLE_MD, false, &text);
    irb_str_printf(&text, "%s%s", images ? "\n" : "", images ? images : "");
    if (!save(folder, "answers.md", &text, err))
        return false;
    answers_csv(analysis, options, &text);
    if (!save(folder, "answers.csv", &text, err))
        return false;
    equal_csv(analysis, options, true, &text);
    if (!save(folder, "equal-time.csv", &text, err))
        return false;
    equal_csv(analysis, options, false, &text);
    return save(folder, "equal-error.csv", &text, err);
}
