/* SPDX-License-Identifier: MIT */
#include "core/report/figures.h"
#include "core/report/analysis_units.h"
#include "core/report/figures_convergence.h"
#include "core/report/pareto.h"
#include "core/report/table_cells.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define M(name) IRB_METRIC_##name

const char *const irb_figure_names[] = {"pareto",      "stages",  "timeline",
                                        "convergence", "flicker", NULL};

/* The errors that figures show. */
static const int errors[] = {M(indirect_flip), M(indirect_rmse), M(indirect_relmse),
                             M(indirect_flicker)};
enum { ERRORS = sizeof errors / sizeof *errors };

static double value_of(const struct irb_analysis_trial *trial, int metric)
{
    return trial->measures[metric].interval.value;
}

/* scene,method,trial */
static void begin_line(struct irb_str *out, const struct irb_analysis_scene *scene,
                       const struct irb_analysis_trial *trial)
{
    irb_csv_text(out, scene->name);
    irb_str_printf(out, ",");
    irb_csv_text(out, trial->method);
    irb_str_printf(out, ",");
    irb_csv_text(out, trial->trial);
}

/* ---- pareto ---- */

struct fronts {
    bool *on[ERRORS][2]; /* by frame_ms and by gl_bytes; owned */
};

static struct fronts find_fronts(const struct irb_analysis_scene *scene)
{
    static const int costs[2] = {M(frame_ms), M(gl_bytes)};
    struct fronts fronts;
    for (int e = 0; e < ERRORS; e++)
        for (int c = 0; c < 2; c++) {
            fronts.on[e][c] = calloc((size_t)scene->trial_count + 1, sizeof(bool));
            if (!fronts.on[e][c])
                abort();
            irb_scene_front(scene, NULL, errors[e], costs[c], fronts.on[e][c]);
        }
    return fronts;
}

static void pareto(const struct irb_analysis *analysis, const struct irb_analysis_scene *scene,
                   struct irb_str *out)
{
    struct fronts fronts = find_fronts(scene);
    (void)analysis;
    for (int t = 0; t < scene->trial_count; t++) {
        const struct irb_analysis_trial *trial = &scene->trials[t];
        begin_line(out, scene, trial);
        irb_csv_measure(out, &trial->measures[M(frame_ms)]);
        irb_csv_number(out, value_of(trial, M(gl_bytes)));
        for (int e = 0; e < ERRORS; e++) {
            irb_csv_measure(out, &trial->measures[errors[e]]);
            irb_str_printf(out, ",%d,%d", fronts.on[e][0][t], fronts.on[e][1][t]);
        }
        irb_str_printf(out, "\n");
    }
    for (int e = 0; e < ERRORS; e++)
        for (int c = 0; c < 2; c++)
            free(fronts.on[e][c]);
}

static void pareto_titles(struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,frame_ms,frame_ms_low,frame_ms_high,gl_bytes");
    for (int e = 0; e < ERRORS; e++) {
        const char *name = irb_metrics[errors[e]].name;
        irb_str_printf(out, ",%s,%s_low,%s_high,%s_front_ms,%s_front_bytes", name, name, name, name,
                       name);
    }
}

/* ---- stages ---- */

static double mean_stage(const struct irb_analysis_trial *trial, int stage)
{
    double sum = 0;
    int count = 0;
    for (int i = 0; i < trial->seed_count; i++) {
        double ms = trial->seeds[i].stage_ms[stage];
        if (isnan(ms))
            continue;
        sum += ms;
        count++;
    }
    return count ? sum / count : NAN;
}

static void stages(const struct irb_analysis *analysis, const struct irb_analysis_scene *scene,
                   struct irb_str *out)
{
    for (int t = 0; t < scene->trial_count; t++)
        for (int s = 0; s < analysis->stages.count; s++) {
            double ms = mean_stage(&scene->trials[t], s);
            if (isnan(ms))
                continue;
            begin_line(out, scene, &scene->trials[t]);
            irb_str_printf(out, ",");
            irb_csv_text(out, analysis->stages.list[s]);
            irb_csv_number(out, ms);
            irb_str_printf(out, "\n");
        }
}

static void stages_titles(struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,stage,ms");
}

/* ---- timeline ---- */

static double mean_frame(const struct irb_analysis_trial *trial, int frame, int metric)
{
    double sum = 0;
    int count = 0;
    for (int i = 0; i < trial->seed_count; i++) {
        const struct irb_analysis_seed *seed = &trial->seeds[i];
        double v = frame < seed->frame_count
                       ? seed->frames[(size_t)frame * IRB_METRIC_COUNT + (size_t)metric]
                       : NAN;
        if (isnan(v))
            continue;
        sum += v;
        count++;
    }
    return count ? sum / count : NAN;
}

static int frames_of(const struct irb_analysis_trial *trial)
{
    int most = 0;
    for (int i = 0; i < trial->seed_count; i++)
        most = trial->seeds[i].frame_count > most ? trial->seeds[i].frame_count : most;
    return most;
}

static void timeline(const struct irb_analysis *analysis, const struct irb_analysis_scene *scene,
                     struct irb_str *out)
{
    (void)analysis;
    for (int t = 0; t < scene->trial_count; t++)
        for (int f = 0; f < frames_of(&scene->trials[t]); f++) {
            begin_line(out, scene, &scene->trials[t]);
            irb_str_printf(out, ",%d", f);
            for (int e = 0; e < ERRORS; e++)
                irb_csv_number(out, mean_frame(&scene->trials[t], f, errors[e]));
            irb_csv_number(out, mean_frame(&scene->trials[t], f, M(frame_ms)));
            irb_str_printf(out, "\n");
        }
}

static void timeline_titles(struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,frame");
    for (int e = 0; e < ERRORS; e++)
        irb_str_printf(out, ",%s", irb_metrics[errors[e]].name);
    irb_str_printf(out, ",frame_ms");
}

/* ---- flicker ---- */

static void flicker(const struct irb_analysis *analysis, const struct irb_analysis_scene *scene,
                    struct irb_str *out)
{
    static const int others[] = {M(indirect_pop_share), M(indirect_temporal_flip), M(lag),
                                 M(reference_flicker)};
    (void)analysis;
    for (int t = 0; t < scene->trial_count; t++) {
        const struct irb_analysis_trial *trial = &scene->trials[t];
        begin_line(out, scene, trial);
        irb_csv_measure(out, &trial->measures[M(indirect_flicker)]);
        for (size_t i = 0; i < sizeof others / sizeof *others; i++)
            irb_csv_number(out, value_of(trial, others[i]));
        irb_str_printf(out, "\n");
    }
}

static void flicker_titles(struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,flicker,low,high,pop_share,temporal_flip,lag,"
                        "reference_flicker");
}

/* ---- which ---- */

static const struct {
    void (*titles)(struct irb_str *out);
    void (*lines)(const struct irb_analysis *analysis, const struct irb_analysis_scene *scene,
                  struct irb_str *out);
} figures[] = {
    [IRB_FIGURE_PARETO] = {pareto_titles, pareto},
    [IRB_FIGURE_STAGES] = {stages_titles, stages},
    [IRB_FIGURE_TIMELINE] = {timeline_titles, timeline},
    [IRB_FIGURE_CONVERGENCE] = {irb_convergence_titles, irb_convergence_lines},
    [IRB_FIGURE_FLICKER] = {flicker_titles, flicker},
};

bool irb_figure_parse(const char *text, enum irb_figure *figure, struct irb_error *err)
{
    for (int i = 0; irb_figure_names[i]; i++) {
        if (!strcmp(text, irb_figure_names[i])) {
            *figure = (enum irb_figure)i;
            return true;
        }
    }
    return irb_fail(err, IRB_E_USAGE,
                    "figure: expected pareto, stages, timeline, convergence or flicker, found "
                    "'%.64s'",
                    text);
}

bool irb_figure_text(const struct irb_analysis *analysis, enum irb_figure figure, const char *scene,
                     struct irb_str *out, struct irb_error *err)
{
    int only = scene ? irb_analysis_scene_find(analysis, scene) : -1;
    if (!analysis->scene_count)
        return irb_fail(err, IRB_E_INPUT, "%s: the run has no trials yet",
                        irb_figure_names[figure]);
    if (scene && only < 0)
        return irb_fail(err, IRB_E_INPUT, "%s: the run has no scene '%.64s'",
                        irb_figure_names[figure], scene);
    figures[figure].titles(out);
    irb_str_printf(out, "\n");
    for (int s = 0; s < analysis->scene_count; s++)
        if (!scene || s == only)
            figures[figure].lines(analysis, &analysis->scenes[s], out);
    return true;
}

bool irb_figure_csv(FILE *out, struct irb_store *store, enum irb_figure figure, const char *scene,
                    struct irb_error *err)
{
    struct irb_analysis analysis;
    struct irb_str text = {0};
    if (!irb_analysis_read(&analysis, store, IRB_CONFIDENCE, err))
        return false;
    bool made = irb_figure_text(&analysis, figure, scene, &text, err);
    bool ok =
        made && fwrite(irb_str_text(&text), 1, text.length, out) == text.length && !fflush(out);
    irb_str_free(&text);
    irb_analysis_destroy(&analysis);
    return ok || (made && irb_fail(err, IRB_E_IO, "cannot write the figure's numbers: %s",
                                   strerror(errno)));
}
