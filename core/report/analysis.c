/* SPDX-License-Identifier: MIT */
#include "core/report/analysis.h"
#include "core/base/str.h"
#include "core/report/analysis_units.h"
#include "core/report/table_data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const int irb_ranked_metrics[IRB_RANKED_METRICS] = {
    IRB_METRIC_indirect_relmse,
    IRB_METRIC_indirect_rmse,
    IRB_METRIC_indirect_flip,
    IRB_METRIC_indirect_energy_ratio,
    IRB_METRIC_indirect_temporal_flip,
    IRB_METRIC_indirect_flicker,
    IRB_METRIC_indirect_pop_share,
    IRB_METRIC_full_flip,
    IRB_METRIC_frame_ms,
    IRB_METRIC_frame_ms_mean,
    IRB_METRIC_frame_ms_p95,
    IRB_METRIC_gl_bytes,
};

/* One element more than there are, zeroed. A table's worth of numbers: where memory for it is out,
 * nothing that holds results is lost. */
static void *grow(void *list, int count, size_t size)
{
    char *grown = realloc(list, ((size_t)count + 1) * size);
    if (!grown)
        abort();
    memset(grown + (size_t)count * size, 0, size);
    return grown;
}

int irb_analysis_scene_find(const struct irb_analysis *analysis, const char *scene)
{
    for (int i = 0; i < analysis->scene_count; i++)
        if (!strcmp(analysis->scenes[i].name, scene))
            return i;
    return -1;
}

int irb_analysis_trial_find(const struct irb_analysis_scene *scene, const char *trial)
{
    for (int i = 0; i < scene->trial_count; i++)
        if (!strcmp(scene->trials[i].trial, trial))
            return i;
    return -1;
}

static struct irb_analysis_scene *scene_of(struct irb_analysis *analysis, const char *name)
{
    int found = irb_analysis_scene_find(analysis, name);
    if (found >= 0)
        return &analysis->scenes[found];
    analysis->scenes = grow(analysis->scenes, analysis->scene_count, sizeof *analysis->scenes);
    struct irb_analysis_scene *scene = &analysis->scenes[analysis->scene_count++];
    scene->name = irb_strdup(name);
    return scene;
}

static struct irb_analysis_trial *trial_of(struct irb_analysis_scene *scene,
                                           const struct irb_store_trial_row *row)
{
    int found = irb_analysis_trial_find(scene, row->trial);
    if (found >= 0)
        return &scene->trials[found];
    scene->trials = grow(scene->trials, scene->trial_count, sizeof *scene->trials);
    struct irb_analysis_trial *trial = &scene->trials[scene->trial_count++];
    trial->method = irb_strdup(row->method);
    trial->trial = irb_strdup(row->trial);
    trial->params_json = irb_strdup(row->params_json);
    return trial;
}

/* ---- frames ---- */

static double *frame_at(struct irb_analysis_seed *seed, int frame)
{
    size_t row = IRB_METRIC_COUNT;
    if (frame >= seed->frame_count) {
        seed->frames = realloc(seed->frames, ((size_t)frame + 1) * row * sizeof(double));
        if (!seed->frames)
            abort();
        for (size_t i = (size_t)seed->frame_count * row; i < ((size_t)frame + 1) * row; i++)
            seed->frames[i] = NAN;
        seed->frame_count = frame + 1;
    }
    return &seed->frames[(size_t)frame * row];
}

static void read_score(void *user, int frame, const char *name, double value)
{
    int metric = irb_metric_find(name);
    if (frame >= 0 && metric >= 0)
        frame_at(user, frame)[metric] = value;
}

/* ---- times: the database has them ordered by repeat, then frame ---- */

struct times {
    struct irb_analysis *analysis;
    struct irb_analysis_seed *seed;
    double *sums;               /* for each stage, over all frames and repeats */
    int stage_count;            /* that sums has */
    double *frames;             /* times of the frames of this repeat, as they come */
    int count, repeat, current; /* how many; which repeat; which frame the last one is of */
    int all;                    /* frames of all repeats */
    double *by_frame;           /* sums over the repeats, and of how many */
    int *counts, frame_count;
};

/* Ends a repeat. */
static void end_round(struct times *t)
{
    struct irb_analysis_seed *seed = t->seed;
    if (!t->count)
        return;
    while (seed->round_count <= t->repeat) {
        seed->rounds = grow(seed->rounds, seed->round_count, sizeof *seed->rounds);
        seed->rounds[seed->round_count++] = (struct irb_summary){NAN, NAN, NAN, NAN};
    }
    /* a round that was cut off has other frames than the rest: the first has them all */
    if (t->repeat == 0 || t->count == t->frame_count)
        seed->rounds[t->repeat] = irb_summarise(t->frames, t->count);
    t->count = 0;
}

static void begin_frame(struct times *t, int repeat, int frame)
{
    t->frames = grow(t->frames, t->count++, sizeof *t->frames);
    t->repeat = repeat;
    t->current = frame;
    t->all++;
    while (t->frame_count <= frame) {
        t->by_frame = grow(t->by_frame, t->frame_count, sizeof *t->by_frame);
        t->counts = grow(t->counts, t->frame_count++, sizeof *t->counts);
    }
    t->counts[frame]++;
}

static void read_time(void *user, int repeat, int frame, const char *name, double ms)
{
    struct times *t = user;
    if (frame < 0 || isnan(ms))
        return;
    if (t->count && t->repeat != repeat)
        end_round(t);
    if (!t->count || t->current != frame)
        begin_frame(t, repeat, frame);
    int stage = irb_names_index(&t->analysis->stages, name);
    while (t->stage_count <= stage) {
        t->sums = grow(t->sums, t->stage_count, sizeof *t->sums);
        t->sums[t->stage_count++] = NAN;
    }
    t->sums[stage] = isnan(t->sums[stage]) ? ms : t->sums[stage] + ms;
    t->frames[t->count - 1] += ms;
    t->by_frame[frame] += ms;
}

static bool read_times(struct irb_analysis *analysis, struct irb_analysis_seed *seed,
                       struct irb_store *store, int64_t id, struct irb_error *err)
{
    struct times t = {.analysis = analysis, .seed = seed};
    bool ok = irb_store_read_times(store, id, read_time, &t, err);
    end_round(&t);
    for (int f = 0; f < t.frame_count; f++)
        if (t.counts[f])
            frame_at(seed, f)[IRB_METRIC_frame_ms] = t.by_frame[f] / t.counts[f];
    for (int s = 0; s < t.stage_count; s++)
        t.sums[s] /= t.all;
    /* later trials may bring more stages: pad_stages() makes the lists equally long */
    while (t.stage_count < analysis->stages.count) {
        t.sums = grow(t.sums, t.stage_count, sizeof *t.sums);
        t.sums[t.stage_count++] = NAN;
    }
    seed->stage_ms = t.sums;
    seed->stage_count = t.stage_count;
    free(t.frames);
    free(t.by_frame);
    free(t.counts);
    return ok;
}

/* ---- all of it ---- */

static bool read_seed(struct irb_analysis *analysis, const struct irb_table_row *row,
                      struct irb_store *store, struct irb_error *err)
{
    struct irb_analysis_trial *trial = trial_of(scene_of(analysis, row->trial->scene), row->trial);
    trial->seeds = grow(trial->seeds, trial->seed_count, sizeof *trial->seeds);
    struct irb_analysis_seed *seed = &trial->seeds[trial->seed_count++];
    seed->seed = row->trial->seed;
    memcpy(seed->values, row->metrics, sizeof seed->values);
    trial->frames = row->frames; /* of all its seeds: see is_comparable() */
    return irb_store_read_scores(store, row->trial->id, read_score, seed, err) &&
           read_times(analysis, seed, store, row->trial->id, err);
}

/* Calls fn for every trial. */
static void for_each_trial(struct irb_analysis *analysis,
                           void (*fn)(const struct irb_analysis *, struct irb_analysis_trial *))
{
    for (int s = 0; s < analysis->scene_count; s++)
        for (int t = 0; t < analysis->scenes[s].trial_count; t++)
            fn(analysis, &analysis->scenes[s].trials[t]);
}

static void pad_stages(const struct irb_analysis *analysis, struct irb_analysis_trial *trial)
{
    for (int i = 0; i < trial->seed_count; i++) {
        struct irb_analysis_seed *seed = &trial->seeds[i];
        while (seed->stage_count < analysis->stages.count) {
            seed->stage_ms = grow(seed->stage_ms, seed->stage_count, sizeof *seed->stage_ms);
            seed->stage_ms[seed->stage_count++] = NAN;
        }
    }
}

static void measure_all(const struct irb_analysis *analysis, struct irb_analysis_trial *trial)
{
    for (int m = 0; m < IRB_METRIC_COUNT; m++) {
        trial->measures[m] =
            (struct irb_measure){{irb_trial_value(trial, m), NAN, NAN, 0}, IRB_UNIT_NONE};
        trial->at_noise[m] = irb_trial_at_noise(trial, m);
    }
    for (int i = 0; i < IRB_RANKED_METRICS; i++)
        trial->measures[irb_ranked_metrics[i]] =
            irb_trial_measure(trial, irb_ranked_metrics[i], analysis->confidence);
}

/* Of a run that goes on: trials with fewer frames than another one of their scene. */
static void find_partial(struct irb_analysis_scene *scene)
{
    int most = 0;
    for (int t = 0; t < scene->trial_count; t++)
        most = scene->trials[t].frames > most ? scene->trials[t].frames : most;
    for (int t = 0; t < scene->trial_count; t++)
        scene->trials[t].partial = scene->trials[t].frames < most;
}

/* Of a run that goes on: whether a seed has as many frames as the trial's most complete one. The
 * tables leave out the others too. */
static bool is_comparable(const struct irb_table_data *data, const struct irb_table_row *row)
{
    for (int i = 0; i < data->row_count; i++) {
        const struct irb_table_row *other = &data->rows[i];
        if (other->frames > row->frames && !strcmp(other->trial->scene, row->trial->scene) &&
            !strcmp(other->trial->trial, row->trial->trial))
            return false;
    }
    return true;
}

bool irb_analysis_of_rows(struct irb_analysis *analysis, const struct irb_table_data *data,
                          struct irb_store *store, double confidence, struct irb_error *err)
{
    *analysis = (struct irb_analysis){.confidence = confidence};
    irb_table_order_stages(&analysis->stages, store, &data->trials);
    bool ok = true;
    for (int i = 0; ok && i < data->row_count; i++)
        ok =
            !is_comparable(data, &data->rows[i]) || read_seed(analysis, &data->rows[i], store, err);
    if (!ok) {
        irb_analysis_destroy(analysis);
        return false;
    }
    for (int s = 0; s < analysis->scene_count; s++)
        find_partial(&analysis->scenes[s]);
    for_each_trial(analysis, pad_stages);
    for_each_trial(analysis, measure_all);
    return true;
}

bool irb_analysis_read(struct irb_analysis *analysis, struct irb_store *store, double confidence,
                       struct irb_error *err)
{
    struct irb_table_data data;
    *analysis = (struct irb_analysis){0};
    if (!irb_table_data_read_seeds(&data, store, err))
        return false;
    bool ok = irb_analysis_of_rows(analysis, &data, store, confidence, err);
    irb_table_data_destroy(&data);
    return ok;
}

static void free_trial(struct irb_analysis_trial *trial)
{
    for (int i = 0; i < trial->seed_count; i++) {
        free(trial->seeds[i].frames);
        free(trial->seeds[i].rounds);
        free(trial->seeds[i].stage_ms);
    }
    free(trial->seeds);
    free(trial->method);
    free(trial->trial);
    free(trial->params_json);
}

void irb_analysis_destroy(struct irb_analysis *analysis)
{
    for (int s = 0; s < analysis->scene_count; s++) {
        struct irb_analysis_scene *scene = &analysis->scenes[s];
        for (int t = 0; t < scene->trial_count; t++)
            free_trial(&scene->trials[t]);
        free(scene->trials);
        free(scene->name);
    }
    free(analysis->scenes);
    irb_names_destroy(&analysis->stages);
    *analysis = (struct irb_analysis){0};
}
