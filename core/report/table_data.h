/* SPDX-License-Identifier: MIT
 *
 * What a table shows, read from the store and summarised: one row a trial, grouped by scene. A
 * trial that ran with several seeds is one row of their means, or one row a seed.
 */
#ifndef IRB_REPORT_TABLE_DATA_H
#define IRB_REPORT_TABLE_DATA_H

#include "core/store/store.h"
#include "core/score/metric_list.h"

struct irb_table_row {
    const struct irb_store_trial_row
        *trial; /* borrowed from the data; of several seeds the first */
    char *name; /* the trial's, with the seed behind it where rows differ by it alone; owned */
    int seeds;  /* whose mean the row is */
    double metrics[IRB_METRIC_COUNT]; /* of the sequence; NaN where there is none */
    double spread[IRB_METRIC_COUNT];  /* standard deviation over the seeds; NaN below two of them */
    double *stage_ms; /* medians, one for each stage of the data, NaN where it has none; owned */
    int stage_count;
    double *regions; /* as the data's region metrics; NaN where there is none; owned */
    int region_count;
    char *choices; /* how the scene was scored: eps, exposures; "" where unknown; owned */
};

struct irb_table_data {
    struct irb_store_trial_list trials;
    struct irb_table_row *rows; /* scenes in order of appearance, their trials together */
    int row_count;
    bool has_spread; /* some row is of several seeds */
    char **stages;   /* names of all trials' stages, in order of appearance */
    int stage_count;
    char **region_metrics; /* "METRIC@REGION" of all trials, in order of appearance; owned */
    int region_metric_count;
    char *provenance; /* what was measured with what, in one line; "" where unknown; owned */
};

bool irb_table_data_read(struct irb_table_data *data, struct irb_store *store, bool per_seed,
                         struct irb_error *err);
/* For irb_table_data_read(): rows of the same trial become one, the mean of every number (of
 * frame_ms_worst the largest); values that are not there do not count (table_seeds.c). */
void irb_table_data_merge_seeds(struct irb_table_data *data);
void irb_table_row_free(struct irb_table_row *row);
void irb_table_data_destroy(struct irb_table_data *data);

#endif
