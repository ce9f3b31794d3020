/* SPDX-License-Identifier: MIT
 *
 * What a run says about error against cost, as answers: the fronts; the least error within a time
 * and the least time for an error; and each method at equal time and at equal error.
 *
 * Only measured points answer: the trial that is named is one that a user can run. Where a method's
 * front has a point on both sides of a budget, the value that a straight line in log-log between
 * these two would give stands beside it, with their names: it is a guess at a parameter that nobody
 * ran. Ratios to the best are paired (analysis.h).
 */
#ifndef IRB_REPORT_TRADEOFF_H
#define IRB_REPORT_TRADEOFF_H

#include "core/base/str.h"
#include "core/report/pareto.h"
#include "core/report/table.h"

struct irb_tradeoff_options {
    int metric;   /* the error: indirect_flip, _relmse, _rmse or _flicker */
    double ms;    /* the time budget; NaN: irb_common_budgets */
    double error; /* the error that is asked for; likewise */
};

/* "flip", "relmse", "rmse", "flicker" as the metric of the indirect image, or its whole name.
 * IRB_E_USAGE names them. */
bool irb_tradeoff_metric(const char *text, int *metric, struct irb_error *err);

/* For people: IRB_TABLE_TEXT or IRB_TABLE_MD. */
void irb_tradeoff_write(const struct irb_analysis *analysis,
                        const struct irb_tradeoff_options *options, enum irb_table_format format,
                        bool colour, struct irb_str *out);

/* The budgets of a scene that equal times (wanted: the error, bounded: frame_ms) or equal errors
 * are taken at. Returns how many. */
int irb_tradeoff_budgets(const struct irb_analysis_scene *scene,
                         const struct irb_tradeoff_options *options, bool by_time,
                         double budgets[IRB_MOST_BUDGETS]);

/* A method at a budget: the question that it answers. */
struct irb_question irb_tradeoff_question(const struct irb_tradeoff_options *options, int scene,
                                          bool by_time, double budget, const char *method);

/* Writes answers.md, answers.csv, equal-time.csv, equal-error.csv and pareto.csv to the folder,
 * which is made; images: text that ends answers.md, or NULL. IRB_E_INPUT where no trial has both an
 * error and a time. */
bool irb_tradeoff_save(const char *folder, const struct irb_analysis *analysis,
                       const struct irb_tradeoff_options *options, const char *images,
                       struct irb_error *err);

/* IRB_E_INPUT where no trial of any scene has both the error and a time. */
bool irb_tradeoff_check(const struct irb_analysis *analysis,
                        const struct irb_tradeoff_options *options, struct irb_error *err);

#endif
