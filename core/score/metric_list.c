/* SPDX-License-Identifier: MIT */
#include "core/score/metric_list.h"
#include "core/score/metrics.h"

#include <math.h>
#include <string.h>

const struct irb_metric_info irb_metrics[IRB_METRIC_COUNT] = {
#define X(name, unit, better, doc) {#name, unit, IRB_BETTER_##better, doc},
    IRB_METRICS(X)
#undef X
};

const int irb_region_metrics[IRB_REGION_METRIC_COUNT] = {
#define X(name) IRB_METRIC_##name,
    IRB_REGION_METRICS(X)
#undef X
};

int irb_region_metric_find(const char *name)
{
    const char *at = strchr(name, '@');
    size_t length = at ? (size_t)(at - name) : 0;
    for (int i = 0; at && at[1] && i < IRB_REGION_METRIC_COUNT; i++) {
        const char *metric = irb_metrics[irb_region_metrics[i]].name;
        if (strlen(metric) == length && !strncmp(metric, name, length))
            return irb_region_metrics[i];
    }
    return -1;
}

int irb_metric_find(const char *name)
{
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        if (!strcmp(irb_metrics[i].name, name))
            return i;
    return -1;
}

const char *irb_better_name(enum irb_better better)
{
    static const char *const names[] = {"lower", "higher", "one", "zero", "none"};
    return names[better];
}

double irb_metric_badness(int metric, double value)
{
    switch (irb_metrics[metric].better) {
    case IRB_BETTER_LOWER:
        return value;
    case IRB_BETTER_HIGHER:
        return -value;
    case IRB_BETTER_ONE:
        return fabs(value - 1);
    case IRB_BETTER_ZERO:
        return fabs(value);
    case IRB_BETTER_NONE:
        break;
    }
    return 0;
}

enum irb_aggregate irb_metric_aggregate(int metric)
{
    switch (metric) {
    case IRB_METRIC_indirect_rmse:
    case IRB_METRIC_full_rmse:
    case IRB_METRIC_solution_rmse:
    case IRB_METRIC_claim_rmse:
    case IRB_METRIC_indirect_flicker:
    case IRB_METRIC_full_flicker:
    case IRB_METRIC_reference_noise_rmse:
    case IRB_METRIC_reference_flicker:
        return IRB_AGGREGATE_ROOT_MEAN_SQUARE;
    case IRB_METRIC_non_finite:
    case IRB_METRIC_negative:
        return IRB_AGGREGATE_SUM;
    default:
        return IRB_AGGREGATE_MEAN;
    }
}

double irb_metric_of_frames(int metric, double sum, double squares, int n)
{
    if (!n)
        return NAN;
    switch (irb_metric_aggregate(metric)) {
    case IRB_AGGREGATE_ROOT_MEAN_SQUARE:
        return sqrt(squares / n);
    case IRB_AGGREGATE_SUM:
        return sum;
    default:
        return sum / n;
    }
}

/* sum v / sum r = 1 + sum (v - r) / sum r */
static double energy_ratio(double bias, double mean_reference)
{
    return mean_reference > 0 ? 1 + bias / mean_reference : NAN;
}

void irb_metrics_derive(double values[IRB_METRIC_COUNT], const struct irb_sequence_scale *scale)
{
    values[IRB_METRIC_indirect_energy_ratio] =
        energy_ratio(values[IRB_METRIC_indirect_bias], scale->mean_indirect);
    values[IRB_METRIC_full_energy_ratio] =
        energy_ratio(values[IRB_METRIC_full_bias], scale->mean_full);
    values[IRB_METRIC_indirect_psnr] =
        irb_psnr(values[IRB_METRIC_indirect_rmse], scale->peak_indirect);
    values[IRB_METRIC_full_psnr] = irb_psnr(values[IRB_METRIC_full_rmse], scale->peak_full);
}
