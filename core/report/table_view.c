/* SPDX-License-Identifier: MIT */
#include "core/report/table_view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define M(name) IRB_METRIC_##name

/* The indirect image is what is ranked; the full image and the whole solution come after it. The
 * reference's noise is known as a relMSE and as an RMSE of the indirect image; relMSE decides for
 * FLIP too. Of flicker no more is known than a bound that the noise stays below: it ranks nothing
 * lower. */
const struct irb_column irb_columns[IRB_COLUMNS] = {
    {M(indirect_relmse), "relMSE", 3, M(reference_noise), M(indirect_relmse), false, true},
    {M(indirect_rmse), "RMSE", 3, M(reference_noise_rmse), M(indirect_rmse), false, false},
    {M(indirect_flip), "FLIP", 3, M(reference_noise), M(indirect_relmse), false, true},
    {M(indirect_energy_ratio), "energy", 4, -1, -1, false, true},
    {M(indirect_flicker), "flicker", 3, -1, -1, false, true},
    {M(indirect_pop_share), "pops", 3, -1, -1, false, false},
    {M(full_flip), "full FLIP", 3, -1, -1, false, false},
    {M(solution_relmse), "solution relMSE", 3, -1, -1, false, false},
    {M(uncovered_flux), "uncovered", 3, -1, -1, true, false},
    {M(clamped_light), "clamped", 3, -1, -1, true, false},
    {M(non_finite), "non-finite", 3, -1, -1, true, false},
    {M(frame_ms), "frame", 3, -1, -1, false, true},
    {M(frame_ms_p95), "p95", 3, -1, -1, false, false},
    {M(frame_ms_worst), "worst", 3, -1, -1, false, false},
};
void irb_table_number(char out[32], double value, int digits)
{
    double size = fabs(value);
    if (isnan(value))
        snprintf(out, 32, "-");
    else if (value == 0)
        snprintf(out, 32, "0");
    else if (isinf(value) || size < 1e-4 || size >= 1e6)
        snprintf(out, 32, "%.*e", digits - 1, value);
    else {
        int decimals = digits - 1 - (int)floor(log10(size));
        snprintf(out, 32, "%.*f", decimals > 0 ? decimals : 0, value);
    }
}

void irb_table_spread(char out[32], const struct irb_column *column,
                      const struct irb_table_row *row)
{
    *out = 0;
    if (column->spread && !isnan(row->spread[column->metric]))
        irb_table_number(out, row->spread[column->metric], 2);
}

const char *irb_column_unit(const struct irb_column *column)
{
    return irb_metrics[column->metric].unit;
}

static bool below_floor(const struct irb_column *column, const struct irb_table_row *row)
{
    return column->floor >= 0 && row->metrics[column->compared] <= row->metrics[column->floor];
}

/* The smallest badness of the ranked values; NaN where there is nothing to choose between. */
static double best_of(const struct irb_table_group *group, const struct irb_column *column)
{
    double best = NAN;
    int ranked = 0;
    for (int i = 0; i < group->count; i++) {
        const struct irb_table_row *row = &group->rows[i];
        double badness = irb_metric_badness(column->metric, row->metrics[column->metric]);
        if (isnan(badness) || row->frames < group->frames)
            continue;
        ranked++;
        if (!below_floor(column, row) && !(badness >= best))
            best = badness;
    }
    return ranked > 1 ? best : NAN;
}

enum irb_mark irb_table_mark(const struct irb_table_group *group, const struct irb_column *column,
                             const struct irb_table_row *row)
{
    double value = row->metrics[column->metric];
    if (isnan(value) || row->frames < group->frames)
        return IRB_MARK_NONE;
    if (below_floor(column, row))
        return IRB_MARK_BELOW_FLOOR;
    if (irb_metric_badness(column->metric, value) == best_of(group, column))
        return IRB_MARK_BEST;
    return row->same[column->metric] ? IRB_MARK_SAME : IRB_MARK_NONE;
}

/* Whether the row has a value that could have been the best. */
static bool is_ranked(const struct irb_table_group *group, int row, const struct irb_column *column)
{
    return !isnan(group->rows[row].metrics[column->metric]) &&
           group->rows[row].frames == group->frames;
}

static void find_same(const struct irb_analysis *analysis, int scene, struct irb_table_row *rows,
                      const struct irb_table_group *group, const struct irb_column *column)
{
    const struct irb_table_row *best = NULL;
    const struct irb_analysis_trial *trials = analysis->scenes[scene].trials;
    for (int i = 0; i < group->count && !best; i++)
        if (irb_table_mark(group, column, &rows[i]) == IRB_MARK_BEST)
            best = &rows[i];
    for (int i = 0; best && i < group->count; i++)
        if (irb_table_mark(group, column, &rows[i]) == IRB_MARK_NONE &&
            is_ranked(group, i, column)) {
            enum irb_verdict verdict =
                irb_analysis_compare(analysis, scene, (int)(rows[i].measured - trials),
                                     (int)(best->measured - trials), column->metric);
            rows[i].same[column->metric] = verdict == IRB_VERDICT_SAME;
            rows[i].untold[column->metric] = verdict == IRB_VERDICT_UNKNOWN;
        }
}

void irb_table_find_same(struct irb_table_data *data)
{
    for (int first = 0; first < data->row_count;) {
        struct irb_table_row *rows = &data->rows[first];
        struct irb_table_group group = irb_table_group_at(data, first);
        int scene = irb_analysis_scene_find(&data->analysis, rows->trial->scene);
        for (int c = 0; scene >= 0 && c < IRB_COLUMNS; c++)
            if (group.shown[c])
                find_same(&data->analysis, scene, rows, &group, &irb_columns[c]);
        first += group.count;
    }
}

static bool column_shown(const struct irb_table_group *group, const struct irb_column *column)
{
    for (int i = 0; i < group->count; i++) {
        double value = group->rows[i].metrics[column->metric];
        if (!isnan(value) && (!column->only_if_any || value != 0))
            return true;
    }
    return false;
}

static bool has_spread(const struct irb_table_group *group, const struct irb_column *column)
{
    char text[32];
    for (int i = 0; i < group->count; i++) {
        irb_table_spread(text, column, &group->rows[i]);
        if (*text)
            return true;
    }
    return false;
}

struct irb_table_group irb_table_group_at(const struct irb_table_data *data, int first)
{
    struct irb_table_group group = {.rows = &data->rows[first]};
    const char *scene = group.rows->trial->scene;
    while (first + group.count < data->row_count &&
           !strcmp(data->rows[first + group.count].trial->scene, scene))
        group.count++;
    for (int i = 0; i < group.count; i++)
        group.frames = group.rows[i].frames > group.frames ? group.rows[i].frames : group.frames;
    for (int c = 0; c < IRB_COLUMNS; c++) {
        group.shown[c] = column_shown(&group, &irb_columns[c]);
        group.spread[c] = group.shown[c] && has_spread(&group, &irb_columns[c]);
        for (int i = 0; group.shown[c] && i < group.count; i++)
            if (irb_table_mark(&group, &irb_columns[c], &group.rows[i]) == IRB_MARK_BELOW_FLOOR)
                group.any_below = true;
    }
    return group;
}

void irb_table_reference(const struct irb_table_group *group, struct irb_str *out)
{
    char noise[32], flicker[32];
    irb_table_number(noise, irb_table_largest(group->rows, group->count, M(reference_noise)), 3);
    irb_table_number(flicker, irb_table_largest(group->rows, group->count, M(reference_flicker)),
                     3);
    const char *choices = group->rows->choices;
    irb_str_printf(out, "reference: noise %s (relMSE), flicker floor %s%s%s%s", noise,
                   strcmp(flicker, "-") ? "<= " : "", flicker, *choices ? "; " : "", choices);
}

void irb_table_foot_seeds(const struct irb_table_data *data, bool spread, struct irb_str *out)
{
    int most = 1;
    for (int i = 0; i < data->row_count; i++)
        if (data->rows[i].seeds > most)
            most = data->rows[i].seeds;
    if (most > 1)
        irb_str_printf(out, "Means over %d seeds%s.\n", most,
                       spread ? "; +- is the standard deviation from seed to seed" : "");
    irb_str_printf(out, "%s%s", data->provenance, *data->provenance ? "\n" : "");
}

static bool has_interval(int metric)
{
    for (int i = 0; i < IRB_RANKED_METRICS; i++)
        if (irb_ranked_metrics[i] == metric)
            return true;
    return false;
}

/* Where nothing can be told from the best, having no mark says nothing. */
static void foot_untold(const struct irb_table_data *data, struct irb_str *out)
{
    for (int first = 0; first < data->row_count;) {
        struct irb_table_group group = irb_table_group_at(data, first);
        int count = 0;
        for (int c = 0; c < IRB_COLUMNS; c++) {
            bool untold = false;
            for (int i = 0; has_interval(irb_columns[c].metric) && i < group.count; i++)
                untold = untold || group.rows[i].untold[irb_columns[c].metric];
            if (untold && !count)
                irb_str_printf(out,
                               "%s: too few seeds or frames, or all alike, to tell every trial "
                               "from the best in ",
                               group.rows->trial->scene);
            if (untold)
                irb_str_printf(out, "%s%s", count++ ? ", " : "", irb_columns[c].title);
        }
        irb_str_printf(out, "%s", count ? ".\n" : "");
        first += group.count;
    }
}

void irb_table_foot(const char *best, const struct irb_table_data *data, struct irb_str *out)
{
    irb_str_printf(out,
                   "%sbest of its column and scene; %s~ not above the reference's own noise, "
                   "not ranked.\nErrors are of the indirect image unless said otherwise, "
                   "against bounce 1 with exact visibility.\n",
                   best,
                   data->has_intervals
                       ? "= not distinguishable from it (the 95 % interval of their "
                         "paired ratio contains 1); "
                       : "");
    foot_untold(data, out);
    irb_table_foot_seeds(data, data->has_spread, out);
}
