/* SPDX-License-Identifier: MIT */
#include "core/report/table_partial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- rows ---- */

/* What frames have. */
struct frames_read {
    int last_scored, scored;
    int last_timed, timed;
    double sum[IRB_METRIC_COUNT], squares[IRB_METRIC_COUNT];
    int count[IRB_METRIC_COUNT];
};

static void read_score(void *user, int frame, const char *name, double value)
{
    struct frames_read *read = user;
    int metric = irb_metric_find(name);
    if (frame < 0)
        return;
    read->scored += frame != read->last_scored; /* they come frame by frame */
    read->last_scored = frame;
    if (metric < 0 || isnan(value))
        return;
    read->sum[metric] += value;
    read->squares[metric] += value * value;
    read->count[metric]++;
}

static void read_time(void *user, int repeat, int frame, const char *stage, double ms)
{
    struct frames_read *read = user;
    (void)stage, (void)ms;
    if (repeat || frame < 0)
        return;
    read->timed += frame != read->last_timed;
    read->last_timed = frame;
}

/* Frames of the scene's sequence: lines of its keys; 0 where they are unknown. */
static int frames_of(struct irb_store *store, const char *scene)
{
    char *lines = irb_store_get_scene_meta(store, scene, "keys");
    int count = 0;
    for (const char *c = lines ? lines : ""; *c; c++)
        count += *c == '\n';
    free(lines);
    return count;
}

/* As irb_sequence_scores_store() does. */
static void aggregate(struct irb_table_row *row, const struct frames_read *read,
                      struct irb_store *store)
{
    const char *scene = row->trial->scene;
    const struct irb_sequence_scale scale = {
        irb_store_scene_number(store, scene, "mean_indirect"),
        irb_store_scene_number(store, scene, "mean_full"),
        irb_store_scene_number(store, scene, "psnr_peak_indirect"),
        irb_store_scene_number(store, scene, "psnr_peak_full")};
    double *m = row->metrics;
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        if (read->count[i])
            m[i] = irb_metric_of_frames(i, read->sum[i], read->squares[i], read->count[i]);
    irb_metrics_derive(m, &scale);
}

bool irb_table_partial_read(struct irb_table_row *row, struct irb_store *store,
                            struct irb_error *err)
{
    struct frames_read read = {.last_scored = -1, .last_timed = -1};
    row->frames_of = row->frames = frames_of(store, row->trial->scene);
    if (irb_store_has_scores(store, row->trial->id, -1)) /* of the sequence: it is whole */
        return true;
    if (!irb_store_read_scores(store, row->trial->id, read_score, &read, err) ||
        !irb_store_read_times(store, row->trial->id, read_time, &read, err))
        return false;
    if (row->frames_of)
        row->frames = read.scored ? read.scored : read.timed;
    if (read.scored)
        aggregate(row, &read, store);
    return true;
}

bool irb_table_partial(const struct irb_table_row *row)
{
    return row->frames < row->frames_of;
}

void irb_table_partial_name(struct irb_table_data *data)
{
    for (int i = 0; i < data->row_count; i++) {
        struct irb_table_row *row = &data->rows[i];
        if (!irb_table_partial(row))
            continue;
        char *name = irb_asprintf("%s (%d of %d frames)", row->name, row->frames, row->frames_of);
        free(row->name);
        row->name = name;
    }
}

int irb_table_partial_keep(struct irb_table_row *rows, int count)
{
    int most = 0, kept = 0;
    for (int i = 0; i < count; i++)
        most = rows[i].frames > most ? rows[i].frames : most;
    for (int i = 0; i < count; i++) {
        if (rows[i].frames == most)
            rows[kept++] = rows[i];
        else
            irb_table_row_free(&rows[i]);
    }
    return kept;
}

/* ---- the run ---- */

/* Of the one object that the run stores: the text behind "name": , "" where there is none. */
static const char *member(const char *json, const char *name)
{
    char *key = irb_asprintf("\"%s\": ", name);
    const char *at = strstr(json, key);
    at = at ? at + strlen(key) : "";
    free(key);
    return at + (*at == '"');
}

/* Seconds since a time of irb_clock_utc(); a long time where it is none. */
static double age_s(const char *at)
{
    struct tm utc = {0};
    const char *end = strptime(at, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return end ? difftime(time(NULL), timegm(&utc)) : INFINITY;
}

static void print_left(double s, struct irb_str *out)
{
    if (s < 60)
        irb_str_printf(out, ", less than a minute left");
    else if (s < 2 * 3600)
        irb_str_printf(out, ", about %.0f min left", s / 60);
    else
        irb_str_printf(out, ", about %.1f h left", s / 3600);
}

void irb_table_progress(struct irb_store *store, struct irb_str *out)
{
    static const double silence_s = 120; /* longer than most frames take */
    char *json = irb_store_get_meta(store, "progress");
    if (json && *json == '{') {
        const char *at = member(json, "at"), *what = member(json, "what");
        bool running = !strncmp(member(json, "state"), "running", 7);
        bool silent = running && age_s(at) > silence_s;
        double percent = floor(100 * strtod(member(json, "fraction"), NULL));
        irb_str_printf(out, running && !silent ? "running: " : "not finished: ");
        if (!running && percent >= 100) /* the command was, the run is not */
            irb_str_printf(out, "stages or trials are left");
        else
            irb_str_printf(out, "%.0f %%", percent);
        if (running && !silent)
            print_left(strtod(member(json, "left_s"), NULL), out);
        irb_str_printf(out, " (%.*s%s%.*s)\n", (int)strcspn(what, "\""), what,
                       silent ? "; last heard of at " : "", silent ? (int)strcspn(at, "\"") : 0,
                       at);
    }
    free(json);
}
