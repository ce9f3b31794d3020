/* SPDX-License-Identifier: MIT */
#include "core/report/table_data.h"
#include "core/report/table_partial.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool same_trial(const struct irb_table_row *a, const struct irb_table_row *b)
{
    return !strcmp(a->trial->scene, b->trial->scene) && !strcmp(a->trial->trial, b->trial->trial);
}

/* A number of row i of the rows that become one. */
typedef double *(*value_fn)(struct irb_table_row *row, int index);

static double *metric_of(struct irb_table_row *row, int index)
{
    return &row->metrics[index];
}

static double *stage_of(struct irb_table_row *row, int index)
{
    return &row->stage_ms.list[index];
}

static double *region_of(struct irb_table_row *row, int index)
{
    return &row->regions.list[index];
}

static double *statistic_of(struct irb_table_row *row, int index)
{
    return &row->statistics.list[index];
}

double irb_mean_over_seeds(const double *values, int count)
{
    double sum = 0, largest = -INFINITY, smallest = INFINITY;
    int n = 0;
    for (int i = 0; i < count; i++) {
        if (isnan(values[i]))
            continue;
        sum += values[i];
        largest = values[i] > largest ? values[i] : largest;
        smallest = values[i] < smallest ? values[i] : smallest;
        n++;
    }
    return !n ? NAN : largest == smallest ? largest : sum / n;
}

/* Mean and sample standard deviation of what is there, NaN without enough of it. The mean is taken
 * first, so that equal values have a spread of exactly 0. */
static double mean_of(struct irb_table_row *rows, int count, value_fn value, int index,
                      double *spread)
{
    double *values = malloc((size_t)count * sizeof *values), squares = 0;
    int n = 0;
    if (!values)
        abort();
    for (int i = 0; i < count; i++)
        values[i] = *value(&rows[i], index);
    double mean = irb_mean_over_seeds(values, count);
    for (int i = 0; i < count; i++) {
        double d = values[i] - mean;
        squares += isnan(d) ? 0 : d * d;
        n += !isnan(values[i]);
    }
    if (spread)
        *spread = n > 1 && isfinite(mean) ? sqrt(squares / (n - 1)) : NAN;
    free(values);
    return mean;
}

double irb_table_largest(const struct irb_table_row *rows, int count, int metric)
{
    double most = NAN;
    for (int i = 0; i < count; i++)
        if (!isnan(rows[i].metrics[metric]) && !(rows[i].metrics[metric] <= most))
            most = rows[i].metrics[metric];
    return most;
}

/* Makes rows[0] the mean of `count` rows and frees the others. */
static void merge(struct irb_table_row *rows, int count)
{
    struct irb_table_row *row = &rows[0];
    double worst = irb_table_largest(rows, count, IRB_METRIC_frame_ms_worst);
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        row->metrics[i] = mean_of(rows, count, metric_of, i, &row->spread[i]);
    row->metrics[IRB_METRIC_frame_ms_worst] = worst;
    for (int i = 0; i < row->stage_ms.count; i++)
        row->stage_ms.list[i] = mean_of(rows, count, stage_of, i, NULL);
    for (int i = 0; i < row->regions.count; i++)
        row->regions.list[i] = mean_of(rows, count, region_of, i, NULL);
    for (int i = 0; i < row->statistics.count; i++)
        row->statistics.list[i] = mean_of(rows, count, statistic_of, i, NULL);
    row->seeds = count;
    for (int i = 1; i < count; i++)
        irb_table_row_free(&rows[i]);
}

/* Brings the rows of the trial of rows[first] together behind it; returns how many there are. */
static int gather(struct irb_table_data *data, int first)
{
    int count = 1;
    for (int i = first + 1; i < data->row_count; i++) {
        struct irb_table_row row = data->rows[i];
        if (!same_trial(&row, &data->rows[first]))
            continue;
        struct irb_table_row *to = &data->rows[first + count];
        memmove(to + 1, to, (size_t)(&data->rows[i] - to) * sizeof *to);
        *to = row;
        count++;
    }
    return count;
}

void irb_table_data_merge_seeds(struct irb_table_data *data)
{
    int kept = 0;
    for (int first = 0; first < data->row_count; kept++) {
        int count = gather(data, first);
        int comparable = irb_table_partial_keep(&data->rows[first], count);
        if (comparable > 1)
            merge(&data->rows[first], comparable);
        data->has_spread = data->has_spread || comparable > 1;
        data->rows[kept] = data->rows[first];
        first += count;
    }
    data->row_count = kept;
}
