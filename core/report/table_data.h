/* SPDX-License-Identifier: MIT
 *
 * What a table shows, read from the store and summarised: one row a trial, grouped by scene. A
 * trial that ran with several seeds is one row of their means, or one row a seed.
 */
#ifndef IRB_REPORT_TABLE_DATA_H
#define IRB_REPORT_TABLE_DATA_H

#include "core/report/analysis.h"
#include "core/store/store.h"
#include "core/score/metric_list.h"

/* One for each of the data's names; NaN where there is none. */
struct irb_values {
    double *list; /* owned */
    int count;
};

struct irb_table_row {
    const struct irb_store_trial_row
        *trial; /* borrowed from the data; of several seeds the first */
    char *name; /* the trial's, with the seed behind it where rows differ by it alone; owned */
    int seeds;  /* whose mean the row is */
    int frames, frames_of; /* that the row is of, and of the sequence; 0 where that is unknown */
    double metrics[IRB_METRIC_COUNT]; /* of the sequence; NaN where there is none */
    double spread[IRB_METRIC_COUNT];  /* standard deviation over the seeds; NaN below two of them */
    struct irb_values stage_ms;       /* medians */
    struct irb_values regions;
    struct irb_values statistics;              /* means */
    bool same[IRB_METRIC_COUNT];               /* not distinguishable from the best of its scene */
    bool untold[IRB_METRIC_COUNT];             /* no interval that would say so, or not */
    const struct irb_analysis_trial *measured; /* its intervals, borrowed; NULL for a row a seed */
    char *choices; /* how the scene was scored: eps, exposures; "" where unknown; owned */
};

struct irb_table_data {
    struct irb_store_trial_list trials;
    struct irb_table_row *rows; /* scenes in order of appearance, their trials together */
    int row_count;
    bool has_spread;                 /* some row is of several seeds */
    bool has_intervals;              /* some row has one */
    struct irb_analysis analysis;    /* empty for rows a seed */
    struct irb_names stages;         /* of all trials, in the order in which they run */
    struct irb_names region_metrics; /* "METRIC@REGION" of all trials, in order of appearance */
    struct irb_names statistics;     /* likewise */
    char *provenance; /* what was measured with what, in one line; "" where unknown; owned */
};

/* Intervals come with rows of means alone. */
bool irb_table_data_read(struct irb_table_data *data, struct irb_store *store, bool per_seed,
                         struct irb_error *err);
/* A row for each seed, under the trial's name alone: what all the others are made from. */
bool irb_table_data_read_seeds(struct irb_table_data *data, struct irb_store *store,
                               struct irb_error *err);
/* Puts the names of all stages in the order in which a frame runs them, as the render stage has
 * stored it: the core's own first, then those of each method. */
void irb_table_order_stages(struct irb_names *stages, struct irb_store *store,
                            const struct irb_store_trial_list *trials);
/* For irb_table_data_read(): rows of the same trial become one, the mean of every number (of
 * frame_ms_worst the largest); values that are not there do not count (table_seeds.c). */
void irb_table_data_merge_seeds(struct irb_table_data *data);
/* That mean: of the values that are not NaN, exact where they are equal; NaN without any. */
double irb_mean_over_seeds(const double *values, int count);
/* The largest value of a metric; NaN where no row has one (table_seeds.c). */
double irb_table_largest(const struct irb_table_row *rows, int count, int metric);
void irb_table_row_free(struct irb_table_row *row);
void irb_table_data_destroy(struct irb_table_data *data);

#endif
