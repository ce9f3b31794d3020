/* SPDX-License-Identifier: MIT
 *
 * The results of a run as a table, one row for each trial of each scene. Trials with several seeds
 * have one row of their means, or one row a seed.
 *
 * csv and json hold everything: scene, method, trial, params, seed (none for a mean), seeds (how
 * many the mean is of), then one column for each metric of core/score/metric_list.h,
 * METRIC@REGION for each region that any scene has, stage_<name>_ms for each stage that any trial
 * has, and METRIC_sd, the standard deviation over the seeds, where any row is a mean. text, md and
 * latex (for the package booktabs) show the metrics that matter most, grouped by scene, with the
 * best value of each column marked.
 *
 * Errors are those of the sequence; times are over the frames >= 0. A value that is not there is
 * null (json), empty (csv) or "-".
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

struct irb_table_options {
    enum irb_table_format format;
    bool colour;   /* text: the best values in bold type */
    bool per_seed; /* a row for each seed, no means */
};

/* IRB_E_USAGE names the formats there are. */
bool irb_table_format_parse(const char *text, enum irb_table_format *format, struct irb_error *err);

/* Writes the whole table. IRB_E_IO where `out` does not take it. */
bool irb_table_write(FILE *out, struct irb_store *store, const struct irb_table_options *options,
                     struct irb_error *err);

#endif
