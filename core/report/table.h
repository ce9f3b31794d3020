/* SPDX-License-Identifier: MIT
 *
 * The results of a run as a table, one row for each trial of each scene. Trials with several seeds
 * have one row of their means, or one row a seed.
 *
 * csv and json hold everything: scene, method, trial, params, seed (none for a mean), seeds (how
 * many the mean is of), then one column for each metric of core/score/metric_list.h,
 * METRIC@REGION for each region that any scene has, stage_<name>_ms for each stage that any trial
 * has, METRIC_sd, the standard deviation over the seeds, where any row is a mean, and METRIC_low,
 * _high and _unit, the 95 % interval and what it is over, of irb_ranked_metrics. text, md and
 * latex (for the package booktabs) show the metrics that matter most, grouped by scene, with the
 * best value of each column marked, and all that are not distinguishable from it (analysis.h).
 *
 * Errors are those of the sequence; times are over the frames >= 0 of all repeats. A value that is
 * not there is null (json), empty (csv) or "-".
 *
 * While a run is written, or after it was stopped, the first line of text, md and latex says how
 * far it is, and rows are of the frames that are there: "(3 of 8 frames)" behind the trial's name.
 * Of several seeds only those with the most frames make up the mean.
 *
 * Stages (in the order in which they run, the core's own first) and statistics have tables of the
 * same kinds. In text, md and latex there is one for each method of a scene, in csv and json one
 * with the columns stage_<name>_ms and frame_ms, or statistic_<name>. The table of frames has one
 * row for each frame of each trial and seed, csv and json alone: scene, method, trial, seed, frame,
 * then the columns of all the others that any frame has a value for.
 */
#ifndef IRB_REPORT_TABLE_H
#define IRB_REPORT_TABLE_H

#include "core/store/store.h"

#include <stdio.h>

enum irb_table_format {
    IRB_TABLE_TEXT,
    IRB_TABLE_CSV,
    IRB_TABLE_MD,
    IRB_TABLE_JSON,
    IRB_TABLE_LATEX
};
extern const char *const irb_table_format_names[]; /* "text", "csv", "md", "json", "latex", NULL */

/* What is shown: the sequences' scores; the median time of every stage; the mean of every statistic
 * that methods report; scores, times and statistics of every frame; or ratios to one trial
 * (table_ratio.h). */
enum irb_table_subject {
    IRB_TABLE_SCORES,
    IRB_TABLE_STAGES,
    IRB_TABLE_STATISTICS,
    IRB_TABLE_FRAMES,
    IRB_TABLE_RATIO
};

struct irb_table_options {
    enum irb_table_format format;
    enum irb_table_subject subject;
    bool colour;         /* text: the best values in bold type */
    bool per_seed;       /* a row for each seed, no means */
    const char *against; /* of IRB_TABLE_RATIO: the trial that all others are held against */
};

/* IRB_E_USAGE names the formats there are. */
bool irb_table_format_parse(const char *text, enum irb_table_format *format, struct irb_error *err);

/* Whether there is that table in that format; IRB_E_USAGE. */
bool irb_table_check(const struct irb_table_options *options, struct irb_error *err);

/* Writes the whole table. IRB_E_IO where `out` does not take it. */
bool irb_table_write(FILE *out, struct irb_store *store, const struct irb_table_options *options,
                     struct irb_error *err);

#endif
