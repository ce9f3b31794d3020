/* SPDX-License-Identifier: MIT
 *
 * What a table shows, read from the store and summarised: one row a trial, grouped by scene.
 */
#ifndef IRB_REPORT_TABLE_DATA_H
#define IRB_REPORT_TABLE_DATA_H

#include "core/experiment/store.h"
#include "core/score/metric_list.h"

struct irb_table_row {
    const struct irb_store_trial_row *trial; /* borrowed from the data */
    double metrics[IRB_METRIC_COUNT];        /* of the sequence; NaN where there is none */
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
    char **stages; /* names of all trials' stages, in order of appearance */
    int stage_count;
    char **region_metrics; /* "METRIC@REGION" of all trials, in order of appearance; owned */
    int region_metric_count;
    char *provenance; /* what was measured with what, in one line; "" where unknown; owned */
};

bool irb_table_data_read(struct irb_table_data *data, struct irb_store *store,
                         struct irb_error *err);
void irb_table_data_destroy(struct irb_table_data *data);

#endif
