/* SPDX-License-Identifier: MIT */
#include "core/report/table_data.h"
#include "core/base/str.h"
#include "core/report/table_partial.h"
#include "core/score/metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A growing list of times. */
struct series {
    double *values; /* owned */
    int count, capacity;
};

static void append(struct series *series, double value)
{
    if (series->count == series->capacity) {
        series->capacity = series->capacity ? 2 * series->capacity : 64;
        series->values = realloc(series->values, (size_t)series->capacity * sizeof(double));
        if (!series->values)
            abort(); /* a table's worth of numbers: nothing that holds results is lost */
    }
    series->values[series->count++] = value;
}

/* The stage times of one trial as they are read, in order of repeats, then frames; all repeats
 * count alike. */
struct timing {
    struct irb_table_data *data;
    struct series *stages; /* one a stage of the data */
    int stage_capacity;
    struct series frames; /* sums over the stages of a frame */
    int repeat, frame;    /* that frames' last sum is for */
};

static void read_stage(void *user, int repeat, int frame, const char *name, double ms)
{
    struct timing *t = user;
    if (frame < 0 || isnan(ms))
        return;
    int stage = irb_names_index(&t->data->stages, name);
    if (stage >= t->stage_capacity) {
        t->stages = realloc(t->stages, (size_t)(stage + 1) * sizeof *t->stages);
        if (!t->stages)
            abort();
        while (t->stage_capacity <= stage)
            t->stages[t->stage_capacity++] = (struct series){0};
    }
    append(&t->stages[stage], ms);
    if (!t->frames.count || t->frame != frame || t->repeat != repeat)
        append(&t->frames, 0);
    t->frames.values[t->frames.count - 1] += ms;
    t->frame = frame;
    t->repeat = repeat;
}

/* Makes the list `count` long. */
static void pad(struct irb_values *values, int count)
{
    if (values->count >= count)
        return;
    values->list = realloc(values->list, (size_t)count * sizeof *values->list);
    if (!values->list)
        abort();
    while (values->count < count)
        values->list[values->count++] = NAN;
}

/* The row whose scores are read. */
struct scored_row {
    struct irb_table_data *data;
    struct irb_table_row *row;
};

static void read_score(void *user, int frame, const char *name, double value)
{
    struct scored_row *scored = user;
    if (frame != -1)
        return;
    int metric = irb_metric_find(name);
    if (metric >= 0) {
        scored->row->metrics[metric] = value;
    } else if (irb_region_metric_find(name) >= 0) {
        int index = irb_names_index(&scored->data->region_metrics, name);
        pad(&scored->row->regions, index + 1);
        scored->row->regions.list[index] = value;
    }
}

/* A trial's statistics as they are read: sums so far, in the row, and of how many. */
struct counted_row {
    struct irb_table_data *data;
    struct irb_table_row *row;
    struct irb_values counts;
};

static void read_statistic(void *user, int frame, const char *name, double value)
{
    struct counted_row *counted = user;
    if (frame < 0 || isnan(value))
        return;
    int index = irb_names_index(&counted->data->statistics, name);
    pad(&counted->row->statistics, index + 1);
    pad(&counted->counts, index + 1);
    double *sum = &counted->row->statistics.list[index], *count = &counted->counts.list[index];
    *sum = isnan(*count) ? value : *sum + value;
    *count = isnan(*count) ? 1 : *count + 1;
}

static bool read_statistics(struct irb_table_data *data, struct irb_table_row *row,
                            struct irb_store *store, struct irb_error *err)
{
    struct counted_row counted = {.data = data, .row = row};
    bool ok = irb_store_read_statistics(store, row->trial->id, read_statistic, &counted, err);
    for (int i = 0; i < counted.counts.count; i++)
        row->statistics.list[i] /= counted.counts.list[i];
    free(counted.counts.list);
    return ok;
}

/* Appends a meta value between two texts, where there is one. */
static void append_meta(struct irb_str *out, struct irb_store *store, const char *name,
                        const char *before, const char *after)
{
    char *value = irb_store_get_meta(store, name);
    if (value && *value)
        irb_str_printf(out, "%s%s%s", before, value, after);
    free(value);
}

/* A number that scoring chose for a scene, under meta scene/SCENE/name. */
static void append_choice(struct irb_str *out, struct irb_store *store, const char *scene,
                          const char *name, const char *before)
{
    char *value = irb_store_get_scene_meta(store, scene, name);
    if (value)
        irb_str_printf(out, "%s%.3g", before, strtod(value, NULL));
    free(value);
}

static char *scene_choices(struct irb_store *store, const char *scene)
{
    struct irb_str out = {0};
    append_choice(&out, store, scene, "relmse_eps_indirect", "relMSE eps ");
    append_choice(&out, store, scene, "flip_indirect_start", ", FLIP exposures ");
    append_choice(&out, store, scene, "flip_indirect_stop", " to ");
    append_choice(&out, store, scene, "flip_indirect_exposures", ", ");
    append_choice(&out, store, scene, "psnr_peak_indirect", ", PSNR peak ");
    append_choice(&out, store, scene, "psnr_peak_full", " and ");
    append_choice(&out, store, scene, "preview_exposure", ", exposure of SSIM and LDR-FLIP ");
    return out.text ? out.text : irb_strdup("");
}

/* "times: finish+clock on llvmpipe (...), CPU, threads 2; irbench 0.1.0 (commit)" */
static char *read_provenance(const struct irb_table_data *data, struct irb_store *store)
{
    struct irb_str out = {0};
    char *clock = NULL;
    for (int i = 0; i < data->row_count && !clock; i++)
        clock = irb_store_clock(store, data->rows[i].trial->id);
    if (clock)
        irb_str_printf(&out, "times: %s", clock);
    free(clock);
    append_meta(&out, store, "gl_renderer", " on ", "");
    append_meta(&out, store, "cpu", ", ", "");
    append_meta(&out, store, "threads", ", threads ", "");
    append_meta(&out, store, "irbench_version", "; irbench ", "");
    append_meta(&out, store, "git_commit", " (", ")");
    return out.text ? out.text : irb_strdup("");
}

static void read_cost(void *user, int frame, const char *name, double value)
{
    struct irb_table_row *row = user;
    (void)frame;
    if (!strcmp(name, "create_ms"))
        row->metrics[IRB_METRIC_precompute_ms] = value;
}

static bool read_row(struct irb_table_data *data, struct irb_table_row *row,
                     struct irb_store *store, struct irb_error *err)
{
    struct timing timing = {.data = data};
    struct scored_row scored = {data, row};
    row->name = irb_strdup(row->trial->trial);
    row->seeds = 1;
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        row->metrics[i] = row->spread[i] = NAN;
    bool ok = irb_store_read_scores(store, row->trial->id, read_score, &scored, err) &&
              irb_store_read_costs(store, row->trial->id, read_cost, row, err) &&
              irb_store_read_times(store, row->trial->id, read_stage, &timing, err) &&
              read_statistics(data, row, store, err);
    struct irb_summary frames = irb_summarise(timing.frames.values, timing.frames.count);
    row->metrics[IRB_METRIC_frame_ms] = frames.median;
    row->metrics[IRB_METRIC_frame_ms_mean] = frames.mean;
    row->metrics[IRB_METRIC_frame_ms_p95] = frames.p95;
    row->metrics[IRB_METRIC_frame_ms_worst] = frames.worst;
    /* later trials may bring more stages: pad_rows() makes the rows equally long */
    pad(&row->stage_ms, timing.stage_capacity);
    for (int i = 0; i < timing.stage_capacity; i++) {
        row->stage_ms.list[i] =
            irb_summarise(timing.stages[i].values, timing.stages[i].count).median;
        free(timing.stages[i].values);
    }
    free(timing.stages);
    free(timing.frames.values);
    row->choices = scene_choices(store, row->trial->scene);
    return ok && irb_table_partial_read(row, store, err);
}

/* Gives every row an entry for every name. */
static void pad_rows(struct irb_table_data *data)
{
    for (int i = 0; i < data->row_count; i++) {
        pad(&data->rows[i].regions, data->region_metrics.count);
        pad(&data->rows[i].stage_ms, data->stages.count);
        pad(&data->rows[i].statistics, data->statistics.count);
    }
}

void irb_table_order_stages(struct irb_names *stages, struct irb_store *store,
                            const struct irb_store_trial_list *trials)
{
    for (int i = 0; i < trials->count; i++) {
        char *key = irb_asprintf("method/%s/stages", trials->rows[i].method);
        char *names = irb_store_get_meta(store, key), *rest = names, *name;
        while (rest && (name = strsep(&rest, "\n")))
            if (*name)
                irb_names_index(stages, name);
        free(names);
        free(key);
    }
}

/* Rows in the order of the store, but with the trials of a scene together. */
static void order_rows(struct irb_table_data *data)
{
    const struct irb_store_trial_list *trials = &data->trials;
    for (int i = 0; i < trials->count; i++) {
        bool first = true;
        for (int j = 0; j < i; j++)
            first = first && strcmp(trials->rows[j].scene, trials->rows[i].scene);
        for (int j = i; first && j < trials->count; j++)
            if (!strcmp(trials->rows[j].scene, trials->rows[i].scene))
                data->rows[data->row_count++].trial = &trials->rows[j];
    }
}

/* Says the seed where the table has the trial with another one too. */
static void name_seeds(struct irb_table_data *data)
{
    for (int i = 0; i < data->row_count; i++) {
        const struct irb_store_trial_row *trial = data->rows[i].trial;
        bool several = false;
        for (int j = 0; j < data->row_count; j++)
            several = several || (j != i && !strcmp(data->rows[j].trial->scene, trial->scene) &&
                                  !strcmp(data->rows[j].trial->trial, trial->trial));
        if (!several)
            continue;
        free(data->rows[i].name);
        data->rows[i].name = irb_asprintf("%s seed %d", trial->trial, trial->seed);
    }
}

bool irb_table_data_read_seeds(struct irb_table_data *data, struct irb_store *store,
                               struct irb_error *err)
{
    *data = (struct irb_table_data){0};
    if (!irb_store_trials(store, &data->trials, err))
        return false;
    data->rows = calloc((size_t)data->trials.count + 1, sizeof *data->rows);
    if (!data->rows)
        abort();
    order_rows(data);
    irb_table_order_stages(&data->stages, store, &data->trials);
    bool ok = true;
    for (int i = 0; i < data->row_count && ok; i++)
        ok = read_row(data, &data->rows[i], store, err);
    if (!ok) {
        irb_table_data_destroy(data);
        return false;
    }
    pad_rows(data);
    data->provenance = read_provenance(data, store);
    return true;
}

/* Gives every row its intervals. */
static void connect_intervals(struct irb_table_data *data)
{
    const struct irb_analysis *analysis = &data->analysis;
    for (int i = 0; i < data->row_count; i++) {
        struct irb_table_row *row = &data->rows[i];
        int scene = irb_analysis_scene_find(analysis, row->trial->scene);
        int trial =
            scene < 0 ? -1 : irb_analysis_trial_find(&analysis->scenes[scene], row->trial->trial);
        row->measured = trial < 0 ? NULL : &analysis->scenes[scene].trials[trial];
        for (int m = 0; row->measured && m < IRB_METRIC_COUNT; m++)
            data->has_intervals =
                data->has_intervals || row->measured->measures[m].unit != IRB_UNIT_NONE;
    }
}

bool irb_table_data_read(struct irb_table_data *data, struct irb_store *store, bool per_seed,
                         struct irb_error *err)
{
    if (!irb_table_data_read_seeds(data, store, err))
        return false;
    if (per_seed) {
        name_seeds(data);
        irb_table_partial_name(data);
        return true;
    }
    if (!irb_analysis_of_rows(&data->analysis, data, store, IRB_CONFIDENCE, err)) {
        irb_table_data_destroy(data);
        return false;
    }
    irb_table_data_merge_seeds(data);
    irb_table_partial_name(data);
    connect_intervals(data);
    return true;
}

void irb_table_row_free(struct irb_table_row *row)
{
    free(row->name);
    free(row->stage_ms.list);
    free(row->regions.list);
    free(row->statistics.list);
    free(row->choices);
}

void irb_table_data_destroy(struct irb_table_data *data)
{
    for (int i = 0; i < data->row_count; i++)
        irb_table_row_free(&data->rows[i]);
    irb_analysis_destroy(&data->analysis);
    free(data->provenance);
    irb_names_destroy(&data->stages);
    irb_names_destroy(&data->region_metrics);
    irb_names_destroy(&data->statistics);
    free(data->rows);
    irb_store_trial_list_destroy(&data->trials);
    *data = (struct irb_table_data){0};
}
