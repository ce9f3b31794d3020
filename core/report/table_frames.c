/* SPDX-License-Identifier: MIT */
#include "core/report/table_frames.h"
#include "core/report/table_cells.h"
#include "core/score/metric_list.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What all trials' frames have values for. */
struct columns {
    bool metrics[IRB_METRIC_COUNT];
    struct irb_names regions, stages, statistics;
    struct irb_names titles; /* of what is shown, in order: stage_NAME_ms, statistic_NAME */
    int last_frame;
};

static const char stage_before[] = "stage_", stage_behind[] = "_ms";
static const char statistic_before[] = "statistic_";

static void see_score(void *user, int frame, const char *name, double value)
{
    struct columns *c = user;
    int metric = irb_metric_find(name);
    if (frame < 0 || isnan(value))
        return;
    if (metric >= 0)
        c->metrics[metric] = true;
    else if (irb_region_metric_find(name) >= 0)
        irb_names_index(&c->regions, name);
    else
        return;
    c->last_frame = frame > c->last_frame ? frame : c->last_frame;
}

static void see_stage(void *user, int repeat, int frame, const char *name, double value)
{
    struct columns *c = user;
    (void)repeat;
    if (frame < 0 || isnan(value))
        return;
    irb_names_index(&c->stages, name);
    c->metrics[IRB_METRIC_frame_ms] = true;
    c->last_frame = frame > c->last_frame ? frame : c->last_frame;
}

static void see_statistic(void *user, int frame, const char *name, double value)
{
    struct columns *c = user;
    if (frame < 0 || isnan(value))
        return;
    irb_names_index(&c->statistics, name);
    c->last_frame = frame > c->last_frame ? frame : c->last_frame;
}

static bool read_trial(struct irb_store *store, int64_t trial, irb_store_value_fn score,
                       irb_store_time_fn stage, irb_store_value_fn statistic, void *user,
                       struct irb_error *err)
{
    return irb_store_read_scores(store, trial, score, user, err) &&
           irb_store_read_times(store, trial, stage, user, err) &&
           irb_store_read_statistics(store, trial, statistic, user, err);
}

static void add_title(struct irb_names *titles, const char *before, const char *name,
                      const char *behind)
{
    char *title = irb_asprintf("%s%s%s", before, name, behind);
    irb_names_index(titles, title);
    free(title);
}

static bool find_columns(struct columns *c, struct irb_store *store,
                         const struct irb_store_trial_list *trials, struct irb_error *err)
{
    irb_table_order_stages(&c->stages, store, trials);
    for (int t = 0; t < trials->count; t++)
        if (!read_trial(store, trials->rows[t].id, see_score, see_stage, see_statistic, c, err))
            return false;
    for (int m = 0; m < IRB_METRIC_COUNT; m++)
        if (c->metrics[m])
            add_title(&c->titles, "", irb_metrics[m].name, "");
    for (int i = 0; i < c->regions.count; i++)
        add_title(&c->titles, "", c->regions.list[i], "");
    for (int i = 0; i < c->stages.count; i++)
        add_title(&c->titles, stage_before, c->stages.list[i], stage_behind);
    for (int i = 0; i < c->statistics.count; i++)
        add_title(&c->titles, statistic_before, c->statistics.list[i], "");
    return true;
}

static void destroy_columns(struct columns *c)
{
    irb_names_destroy(&c->regions);
    irb_names_destroy(&c->stages);
    irb_names_destroy(&c->statistics);
    irb_names_destroy(&c->titles);
}

/* The frames of one trial. */
struct series {
    const struct columns *columns;
    double *values; /* [frame][column], NaN where there is none; owned */
    int *repeats;   /* [frame][column], of stages: how many times the value is the sum of; owned */
};

static double *cell(const struct series *s, int frame, int column)
{
    return &s->values[(size_t)frame * (size_t)s->columns->titles.count + (size_t)column];
}

/* NULL for what is not shown, which a run that goes on may have added since the columns were
 * found. */
static double *find_cell(const struct series *s, int frame, const char *before, const char *name,
                         const char *behind)
{
    char *title = irb_asprintf("%s%s%s", before, name, behind);
    int column = irb_names_find(&s->columns->titles, title);
    free(title);
    return frame < 0 || frame > s->columns->last_frame || column < 0 ? NULL
                                                                     : cell(s, frame, column);
}

static void fill_score(void *user, int frame, const char *name, double value)
{
    double *to = find_cell(user, frame, "", name, "");
    if (to)
        *to = value;
}

static void fill_stage(void *user, int repeat, int frame, const char *name, double value)
{
    struct series *s = user;
    double *to = find_cell(s, frame, stage_before, name, stage_behind);
    (void)repeat;
    if (!to || isnan(value))
        return;
    *to = isnan(*to) ? value : *to + value;
    s->repeats[to - s->values]++;
}

/* The frame's times: means over its repeats, and their sum. */
static void finish_times(const struct series *s, int frame)
{
    double *whole = find_cell(s, frame, "", "frame_ms", "");
    for (int c = 0; whole && c < s->columns->titles.count; c++) {
        double *value = cell(s, frame, c);
        int repeats = s->repeats[value - s->values];
        if (!repeats)
            continue;
        *value /= repeats;
        *whole = isnan(*whole) ? *value : *whole + *value;
    }
}

static void fill_statistic(void *user, int frame, const char *name, double value)
{
    double *to = find_cell(user, frame, statistic_before, name, "");
    if (to)
        *to = value;
}

static bool has_values(const struct series *s, int frame)
{
    for (int c = 0; c < s->columns->titles.count; c++)
        if (!isnan(*cell(s, frame, c)))
            return true;
    return false;
}

static void csv_frame(const struct series *s, const struct irb_store_trial_row *trial, int frame,
                      struct irb_str *out)
{
    const char *const texts[] = {trial->scene, trial->method, trial->trial};
    for (int i = 0; i < 3; i++) {
        irb_str_printf(out, "%s", i ? "," : "");
        irb_csv_text(out, texts[i]);
    }
    irb_str_printf(out, ",%d,%d", trial->seed, frame);
    for (int c = 0; c < s->columns->titles.count; c++)
        irb_csv_number(out, *cell(s, frame, c));
    irb_str_printf(out, "\n");
}

static void json_frame(const struct series *s, const struct irb_store_trial_row *trial, int frame,
                       bool first, struct irb_str *out)
{
    const char *const texts[][2] = {
        {"scene", trial->scene}, {"method", trial->method}, {"trial", trial->trial}};
    irb_str_printf(out, "%s\n {", first ? "" : ",");
    for (int i = 0; i < 3; i++) {
        irb_str_printf(out, "%s\"%s\": ", i ? ", " : "", texts[i][0]);
        irb_str_json_string(out, texts[i][1]);
    }
    irb_str_printf(out, ", \"seed\": %d, \"frame\": %d", trial->seed, frame);
    for (int c = 0; c < s->columns->titles.count; c++)
        irb_json_member(out, "", s->columns->titles.list[c], "", *cell(s, frame, c));
    irb_str_printf(out, "}");
}

static bool write_trial(const struct columns *columns, struct irb_store *store,
                        const struct irb_store_trial_row *trial, enum irb_table_format format,
                        struct irb_str *out, struct irb_error *err)
{
    size_t count = (size_t)(columns->last_frame + 1) * (size_t)columns->titles.count;
    struct series s = {.columns = columns,
                       .values = malloc((count + 1) * sizeof *s.values),
                       .repeats = calloc(count + 1, sizeof *s.repeats)};
    bool ok = (s.values && s.repeats) ||
              irb_fail(err, IRB_E_MEMORY, "no memory for %zu values of frames", count);
    for (size_t i = 0; ok && i < count; i++)
        s.values[i] = NAN;
    ok = ok && read_trial(store, trial->id, fill_score, fill_stage, fill_statistic, &s, err);
    for (int frame = 0; ok && frame <= columns->last_frame; frame++) {
        finish_times(&s, frame);
        if (!has_values(&s, frame))
            continue;
        if (format == IRB_TABLE_CSV)
            csv_frame(&s, trial, frame, out);
        else
            json_frame(&s, trial, frame, out->length == 1, out);
    }
    free(s.repeats);
    free(s.values);
    return ok;
}

static void csv_titles(const struct columns *columns, struct irb_str *out)
{
    irb_str_printf(out, "scene,method,trial,seed,frame");
    for (int c = 0; c < columns->titles.count; c++)
        irb_csv_title(out, "", columns->titles.list[c], "");
    irb_str_printf(out, "\n");
}

bool irb_table_frames(struct irb_store *store, enum irb_table_format format, struct irb_str *out,
                      struct irb_error *err)
{
    struct irb_store_trial_list trials;
    struct columns columns = {.last_frame = -1};
    if (!irb_store_trials(store, &trials, err))
        return false;
    bool ok = find_columns(&columns, store, &trials, err);
    if (ok && format == IRB_TABLE_CSV)
        csv_titles(&columns, out);
    else if (ok)
        irb_str_printf(out, "[");
    for (int t = 0; ok && t < trials.count; t++)
        ok = write_trial(&columns, store, &trials.rows[t], format, out, err);
    if (ok && format == IRB_TABLE_JSON)
        irb_str_printf(out, "%s]\n", out->length > 1 ? "\n" : "");
    destroy_columns(&columns);
    irb_store_trial_list_destroy(&trials);
    return ok;
}
