/* SPDX-License-Identifier: MIT */
#include "core/report/table_data.h"
#include "core/base/str.h"
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

/* The stage times of one trial as they are read, in order of frames. */
struct timing {
    struct irb_table_data *data;
    struct series *stages; /* one a stage of the data */
    int stage_capacity;
    struct series frames; /* sums over the stages of a frame */
    int frame;            /* that frames' last sum is for */
};

static int stage_index(struct irb_table_data *data, const char *name)
{
    for (int i = 0; i < data->stage_count; i++)
        if (!strcmp(data->stages[i], name))
            return i;
    data->stages = realloc(data->stages, (size_t)(data->stage_count + 1) * sizeof *data->stages);
    if (!data->stages)
        abort();
    data->stages[data->stage_count] = irb_strdup(name);
    return data->stage_count++;
}

static void read_stage(void *user, int frame, const char *name, double ms)
{
    struct timing *t = user;
    if (frame < 0 || isnan(ms))
        return;
    int stage = stage_index(t->data, name);
    if (stage >= t->stage_capacity) {
        t->stages = realloc(t->stages, (size_t)(stage + 1) * sizeof *t->stages);
        if (!t->stages)
            abort();
        while (t->stage_capacity <= stage)
            t->stages[t->stage_capacity++] = (struct series){0};
    }
    append(&t->stages[stage], ms);
    if (!t->frames.count || t->frame != frame)
        append(&t->frames, 0);
    t->frames.values[t->frames.count - 1] += ms;
    t->frame = frame;
}

static int region_metric_index(struct irb_table_data *data, const char *name)
{
    for (int i = 0; i < data->region_metric_count; i++)
        if (!strcmp(data->region_metrics[i], name))
            return i;
    size_t count = (size_t)data->region_metric_count + 1;
    data->region_metrics = realloc(data->region_metrics, count * sizeof *data->region_metrics);
    if (!data->region_metrics)
        abort();
    data->region_metrics[data->region_metric_count] = irb_strdup(name);
    return data->region_metric_count++;
}

/* Makes the row's list of region metrics `count` long. */
static void pad_regions(struct irb_table_row *row, int count)
{
    row->regions = realloc(row->regions, ((size_t)count + 1) * sizeof *row->regions);
    if (!row->regions)
        abort();
    while (row->region_count < count)
        row->regions[row->region_count++] = NAN;
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
        int index = region_metric_index(scored->data, name);
        if (index >= scored->row->region_count)
            pad_regions(scored->row, index + 1);
        scored->row->regions[index] = value;
    }
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
    char *key = irb_asprintf("scene/%s/%s", scene, name);
    char *value = irb_store_get_meta(store, key);
    if (value)
        irb_str_printf(out, "%s%.3g", before, strtod(value, NULL));
    free(value);
    free(key);
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
              irb_store_read_stages(store, row->trial->id, read_stage, &timing, err);
    struct irb_summary frames = irb_summarise(timing.frames.values, timing.frames.count);
    row->metrics[IRB_METRIC_frame_ms] = frames.median;
    row->metrics[IRB_METRIC_frame_ms_p95] = frames.p95;
    row->metrics[IRB_METRIC_frame_ms_worst] = frames.worst;
    /* later trials may bring more stages: pad_rows() makes the rows equally long */
    row->stage_ms = calloc((size_t)timing.stage_capacity + 1, sizeof(double));
    if (!row->stage_ms)
        abort();
    row->stage_count = timing.stage_capacity;
    for (int i = 0; i < timing.stage_capacity; i++) {
        row->stage_ms[i] = irb_summarise(timing.stages[i].values, timing.stages[i].count).median;
        free(timing.stages[i].values);
    }
    free(timing.stages);
    free(timing.frames.values);
    row->choices = scene_choices(store, row->trial->scene);
    return ok;
}

/* Gives every row an entry for every stage and region metric. */
static void pad_rows(struct irb_table_data *data)
{
    for (int i = 0; i < data->row_count; i++) {
        struct irb_table_row *row = &data->rows[i];
        pad_regions(row, data->region_metric_count);
        row->stage_ms = realloc(row->stage_ms, ((size_t)data->stage_count + 1) * sizeof(double));
        if (!row->stage_ms)
            abort();
        while (row->stage_count < data->stage_count)
            row->stage_ms[row->stage_count++] = NAN;
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

bool irb_table_data_read(struct irb_table_data *data, struct irb_store *store, bool per_seed,
                         struct irb_error *err)
{
    *data = (struct irb_table_data){0};
    if (!irb_store_trials(store, &data->trials, err))
        return false;
    data->rows = calloc((size_t)data->trials.count + 1, sizeof *data->rows);
    if (!data->rows)
        abort();
    order_rows(data);
    bool ok = true;
    for (int i = 0; i < data->row_count && ok; i++)
        ok = read_row(data, &data->rows[i], store, err);
    if (!ok) {
        irb_table_data_destroy(data);
        return false;
    }
    pad_rows(data);
    if (per_seed)
        name_seeds(data);
    else
        irb_table_data_merge_seeds(data);
    data->provenance = read_provenance(data, store);
    return true;
}

void irb_table_row_free(struct irb_table_row *row)
{
    free(row->name);
    free(row->stage_ms);
    free(row->regions);
    free(row->choices);
}

void irb_table_data_destroy(struct irb_table_data *data)
{
    for (int i = 0; i < data->row_count; i++)
        irb_table_row_free(&data->rows[i]);
    free(data->provenance);
    for (int i = 0; i < data->stage_count; i++)
        free(data->stages[i]);
    free(data->stages);
    for (int i = 0; i < data->region_metric_count; i++)
        free(data->region_metrics[i]);
    free(data->region_metrics);
    free(data->rows);
    irb_store_trial_list_destroy(&data->trials);
    *data = (struct irb_table_data){0};
}
