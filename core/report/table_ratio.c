/* SPDX-License-Identifier: MIT */
#include "core/report/table_ratio.h"
#include "core/report/grid.h"
#include "core/report/measure_text.h"
#include "core/report/table_cells.h"
#include "core/report/table_latex.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    int metric;
    const char *title;
} columns[] = {
    {IRB_METRIC_indirect_relmse, "relMSE"}, {IRB_METRIC_indirect_rmse, "RMSE"},
    {IRB_METRIC_indirect_flip, "FLIP"},     {IRB_METRIC_indirect_flicker, "flicker"},
    {IRB_METRIC_frame_ms, "frame time"},    {IRB_METRIC_gl_bytes, "memory"},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

/* A trial of a scene and the one that it is held against. */
struct pair {
    const struct irb_analysis *analysis;
    int scene, trial, against;
};

static const struct irb_analysis_trial *trial_of(const struct pair *p, int trial)
{
    return &p->analysis->scenes[p->scene].trials[trial];
}

static struct irb_measure ratio_of(const struct pair *p, int column)
{
    return irb_analysis_ratio(p->analysis, p->scene, p->trial, p->against, columns[column].metric);
}

/* Calls fn for every other trial of every scene that has the trial. */
static void for_each_pair(const struct irb_analysis *analysis, const char *against,
                          void (*fn)(const struct pair *pair, void *user), void *user)
{
    for (int s = 0; s < analysis->scene_count; s++) {
        struct pair p = {analysis, s, 0, irb_analysis_trial_find(&analysis->scenes[s], against)};
        for (; p.against >= 0 && p.trial < analysis->scenes[s].trial_count; p.trial++)
            if (p.trial != p.against)
                fn(&p, user);
    }
}

/* ---- csv, json ---- */

static void csv_titles(struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,against");
    for (int c = 0; c < COLUMNS; c++) {
        const char *name = irb_metrics[columns[c].metric].name;
        irb_str_printf(out, ",%s_ratio,%s_low,%s_high,%s_unit,%s_distinguishable", name, name, name,
                       name, name);
    }
    irb_str_printf(out, "\n");
}

static void csv_pair(const struct pair *p, void *user)
{
    struct irb_str *out = user;
    const char *const texts[] = {p->analysis->scenes[p->scene].name, trial_of(p, p->trial)->method,
                                 trial_of(p, p->trial)->trial, trial_of(p, p->against)->trial};
    for (int i = 0; i < 4; i++) {
        irb_str_printf(out, "%s", i ? "," : "");
        irb_csv_text(out, texts[i]);
    }
    for (int c = 0; c < COLUMNS; c++) {
        struct irb_measure m = ratio_of(p, c);
        irb_csv_measure(out, &m);
        irb_str_printf(out, ",%s", irb_unit_names[m.unit]);
        irb_csv_number(out, isnan(m.interval.low) ? NAN : !irb_interval_contains(&m.interval, 1));
    }
    irb_str_printf(out, "\n");
}

static void json_pair(const struct pair *p, void *user)
{
    struct irb_str *out = user;
    const char *const texts[][2] = {{"scene", p->analysis->scenes[p->scene].name},
                                    {"method", trial_of(p, p->trial)->method},
                                    {"trial", trial_of(p, p->trial)->trial},
                                    {"against", trial_of(p, p->against)->trial}};
    irb_str_printf(out, "%s\n {", out->length > 1 ? "," : "");
    for (int i = 0; i < 4; i++) {
        irb_str_printf(out, "%s\"%s\": ", i ? ", " : "", texts[i][0]);
        irb_str_json_string(out, texts[i][1]);
    }
    for (int c = 0; c < COLUMNS; c++) {
        const char *name = irb_metrics[columns[c].metric].name;
        struct irb_measure m = ratio_of(p, c);
        irb_json_member(out, "", name, "_ratio", m.interval.value);
        irb_json_member(out, "", name, "_low", m.interval.low);
        irb_json_member(out, "", name, "_high", m.interval.high);
        irb_str_printf(out, ", \"%s_unit\": \"%s\"", name, irb_unit_names[m.unit]);
        irb_json_member(out, "", name, "_distinguishable",
                        isnan(m.interval.low) ? NAN : !irb_interval_contains(&m.interval, 1));
    }
    irb_str_printf(out, "}");
}

/* ---- for people ---- */

static bool any_value(const struct irb_analysis *analysis, int column)
{
    for (int s = 0; s < analysis->scene_count; s++)
        for (int t = 0; t < analysis->scenes[s].trial_count; t++)
            if (!isnan(
                    analysis->scenes[s].trials[t].measures[columns[column].metric].interval.value))
                return true;
    return false;
}

static void add_ratio(struct irb_grid *grid, const struct pair *p, int column)
{
    struct irb_str cell = {0};
    struct irb_measure m = ratio_of(p, column);
    int metric = columns[column].metric;
    bool at_noise =
        trial_of(p, p->trial)->at_noise[metric] || trial_of(p, p->against)->at_noise[metric];
    irb_str_printf(&cell, "%s", at_noise ? "(" : "");
    irb_ratio_text(&cell, &m);
    irb_str_printf(&cell, "%s", at_noise ? ")" : "");
    irb_grid_take(grid, &cell);
}

static void write_scene(const struct pair *of, const struct irb_table_options *options,
                        struct irb_str *out)
{
    struct irb_grid grid = {.columns = 1, .left = 1};
    struct pair p = *of;
    bool shown[COLUMNS];
    irb_grid_add(&grid, "trial");
    for (int c = 0; c < COLUMNS; c++) {
        shown[c] = any_value(p.analysis, c);
        grid.columns += shown[c];
        if (shown[c])
            irb_grid_add(&grid, columns[c].title);
    }
    for (p.trial = 0; p.trial < p.analysis->scenes[p.scene].trial_count; p.trial++) {
        if (p.trial == p.against)
            continue;
        irb_grid_add(&grid, trial_of(&p, p.trial)->trial);
        for (int c = 0; c < COLUMNS; c++)
            if (shown[c])
                add_ratio(&grid, &p, c);
    }
    char *caption =
        irb_asprintf("%s: ratios to %s", p.analysis->scenes[p.scene].name, options->against);
    irb_grid_write(&grid, options->format, options->colour, caption, out);
    free(caption);
    irb_grid_free(&grid);
}

static const char foot[] =
    "Value of the trial over that of the other, with the 95 % interval from paired units: seeds, "
    "else rounds (times),\nelse blocks of frames; ~ not distinguishable: the interval contains 1. "
    "Exact: all units have the same\nratio. Without an interval: too few units, or all are alike. "
    "In brackets: one of both is not above the reference's own noise.\nThe noise in both draws "
    "ratios of errors towards 1. Of trials with fewer frames than others there is none.\n";

static void write_people(const struct irb_analysis *analysis,
                         const struct irb_table_options *options, struct irb_str *out)
{
    if (options->format == IRB_TABLE_LATEX)
        irb_str_printf(out, "%% needs \\usepackage{booktabs} and \\usepackage[T1]{fontenc}\n");
    for (int s = 0; s < analysis->scene_count; s++) {
        struct pair p = {analysis, s, 0,
                         irb_analysis_trial_find(&analysis->scenes[s], options->against)};
        if (p.against >= 0)
            write_scene(&p, options, out);
    }
    if (options->format == IRB_TABLE_LATEX)
        irb_latex_comment(out, foot);
    else
        irb_str_printf(out, "%s", foot);
}

/* ---- which ---- */

/* IRB_E_USAGE with the name of the nearest trial. */
static bool refuse_unknown(const struct irb_analysis *analysis, const char *against,
                           struct irb_error *err)
{
    size_t count = 0, most = 1;
    for (int s = 0; s < analysis->scene_count; s++)
        most += (size_t)analysis->scenes[s].trial_count;
    const char **names = calloc(most, sizeof *names);
    if (!names)
        abort();
    for (int s = 0; s < analysis->scene_count; s++)
        for (int t = 0; t < analysis->scenes[s].trial_count; t++)
            names[count++] = analysis->scenes[s].trials[t].trial;
    const char *near = irb_nearest(against, names, count);
    irb_fail(err, IRB_E_USAGE, "--ratio: the run has no trial '%.200s'%s%s%s", against,
             near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    free(names);
    return false;
}

static bool has_trial(const struct irb_analysis *analysis, const char *trial)
{
    for (int s = 0; s < analysis->scene_count; s++)
        if (irb_analysis_trial_find(&analysis->scenes[s], trial) >= 0)
            return true;
    return false;
}

static void write_table(const struct irb_analysis *analysis,
                        const struct irb_table_options *options, struct irb_str *out)
{
    switch (options->format) {
    case IRB_TABLE_CSV:
        csv_titles(out);
        for_each_pair(analysis, options->against, csv_pair, out);
        break;
    case IRB_TABLE_JSON:
        irb_str_printf(out, "[");
        for_each_pair(analysis, options->against, json_pair, out);
        irb_str_printf(out, "%s]\n", out->length > 1 ? "\n" : "");
        break;
    default:
        write_people(analysis, options, out);
    }
}

bool irb_table_ratio(struct irb_store *store, const struct irb_table_options *options,
                     struct irb_str *out, struct irb_error *err)
{
    struct irb_analysis analysis;
    if (!irb_analysis_read(&analysis, store, IRB_CONFIDENCE, err))
        return false;
    bool ok =
        analysis.scene_count || irb_fail(err, IRB_E_INPUT, "--ratio: the run has no trials yet");
    ok = ok && (has_trial(&analysis, options->against) ||
                refuse_unknown(&analysis, options->against, err));
    if (ok)
        write_table(&analysis, options, out);
    irb_analysis_destroy(&analysis);
    return ok;
}
