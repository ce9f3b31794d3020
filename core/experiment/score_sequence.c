/* SPDX-License-Identifier: MIT
 *
 * The scores of frames in the store, and what they make up for a sequence.
 */
#include "core/experiment/score_frame.h"
#include "core/base/str.h"
#include "core/score/metrics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void irb_frame_scores_clear(struct irb_frame_scores *scores)
{
    scores->present = false;
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        scores->values[i] = NAN;
    for (int i = 0; i < IRB_LAG_COUNT; i++)
        scores->lag_errors[i] = NAN;
    for (int r = 0; r < IRB_MOST_REGIONS; r++)
        for (int i = 0; i < IRB_REGION_METRIC_COUNT; i++)
            scores->regions[r][i] = NAN;
}

/* ---- names ---- */

enum { NAME_SIZE = 128 }; /* a metric, '@' and a region's name of at most 64 */

/* Calls fn with the name of every value and where it is in *scores. */
typedef void (*named_value_fn)(void *user, const char *name, double *value);

static void for_each_value(struct irb_frame_scores *scores, const struct irb_scene_entry *entry,
                           named_value_fn fn, void *user)
{
    char name[NAME_SIZE];
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        fn(user, irb_metrics[i].name, &scores->values[i]);
    for (int i = 0; i < IRB_LAG_COUNT; i++) {
        snprintf(name, sizeof name, "lag_error@%d", IRB_LAG_FIRST + i);
        fn(user, name, &scores->lag_errors[i]);
    }
    for (int r = 0; r < entry->region_count; r++)
        for (int i = 0; i < IRB_REGION_METRIC_COUNT; i++) {
            snprintf(name, sizeof name, "%s@%s", irb_metrics[irb_region_metrics[i]].name,
                     entry->regions[r].name);
            fn(user, name, &scores->regions[r][i]);
        }
}

/* ---- store ---- */

/* Values on their way to the store, with copies of their names. */
struct written {
    struct irb_store_value *values;
    int count;
};

static void add_written(void *user, const char *name, double *value)
{
    struct written *written = user;
    if (!isnan(*value))
        written->values[written->count++] = (struct irb_store_value){irb_strdup(name), *value};
}

bool irb_frame_scores_store(const struct irb_frame_scores *scores, struct irb_store *store,
                            const struct irb_scored_trial *trial, int frame, struct irb_error *err)
{
    struct irb_frame_scores copy = *scores; /* for_each_value hands out places */
    struct written written = {.values =
                                  malloc(sizeof copy / sizeof(double) * sizeof *written.values)};
    if (!written.values)
        return irb_fail(err, IRB_E_MEMORY, "no memory for the scores of a frame");
    for_each_value(&copy, trial->entry, add_written, &written);
    bool ok = irb_store_scores(store, trial->id, frame, written.values, written.count, err);
    for (int i = 0; i < written.count; i++)
        free((char *)written.values[i].name);
    free(written.values);
    return ok;
}

struct frames_reader {
    struct irb_frame_scores *frames;
    const struct irb_scene_entry *entry;
    int count;
    const char *name; /* that is looked for, and its value */
    double value;
};

static void set_if_named(void *user, const char *name, double *value)
{
    struct frames_reader *reader = user;
    if (!strcmp(name, reader->name))
        *value = reader->value;
}

static void read_value(void *user, int frame, const char *name, double value)
{
    struct frames_reader *reader = user;
    if (frame < 0 || frame >= reader->count)
        return;
    struct irb_frame_scores *scores = &reader->frames[frame];
    if (!scores->present)
        irb_frame_scores_clear(scores);
    scores->present = true;
    int metric = irb_metric_find(name);
    if (metric >= 0) {
        scores->values[metric] = value;
        return;
    }
    reader->name = name;
    reader->value = value;
    for_each_value(scores, reader->entry, set_if_named, reader);
}

bool irb_frame_scores_read(struct irb_frame_scores *frames, int count, struct irb_store *store,
                           const struct irb_scored_trial *trial, struct irb_error *err)
{
    struct frames_reader reader = {.frames = frames, .entry = trial->entry, .count = count};
    return irb_store_read_scores(store, trial->id, read_value, &reader, err);
}

/* ---- sequence ---- */

int irb_worst_frame(const struct irb_frame_scores *frames, int count)
{
    int worst = 0;
    for (int i = 1; i < count; i++)
        if (frames[i].values[IRB_METRIC_indirect_relmse] >
            frames[worst].values[IRB_METRIC_indirect_relmse])
            worst = i;
    return worst;
}

/* Of the value that lies at `place` in frames[0]. */
static double aggregate(const struct irb_frame_scores *frames, int count, int metric,
                        const double *place)
{
    size_t offset = (size_t)((const char *)place - (const char *)frames);
    double sum = 0, squares = 0;
    int n = 0;
    for (int i = 0; i < count; i++) {
        double value = *(const double *)(const void *)((const char *)&frames[i] + offset);
        if (isnan(value))
            continue;
        sum += value;
        squares += value * value;
        n++;
    }
    return irb_metric_of_frames(metric, sum, squares, n);
}

/* A mean over the frames that have a value. */
struct mean {
    double sum;
    int count;
};

static void mean_add(struct mean *mean, double value)
{
    mean->sum += value;
    mean->count++;
}

static double mean_of(const struct mean *mean)
{
    return mean->count ? mean->sum / mean->count : NAN;
}

struct statistics {
    struct mean uncovered, clamped;
    double bytes; /* the most */
};

static void read_statistic(void *user, int frame, const char *name, double value)
{
    struct statistics *s = user;
    if (frame < 0 || isnan(value))
        return;
    if (!strcmp(name, "uncovered_flux")) {
        mean_add(&s->uncovered, value);
    } else if (!strcmp(name, "clamped_light")) {
        mean_add(&s->clamped, value);
    } else if (!strcmp(name, "gl_bytes") && !(value <= s->bytes)) {
        s->bytes = value;
    }
}

/* The lag needs a frame's errors at each shift, of all frames. */
static double sequence_lag(const struct irb_frame_scores *frames, int count, double mean_reference)
{
    double(*errors)[IRB_LAG_COUNT] = malloc((size_t)count * sizeof *errors);
    for (int i = 0; errors && i < count; i++)
        memcpy(errors[i], frames[i].lag_errors, sizeof *errors);
    double lag =
        errors ? irb_lag((const double(*)[IRB_LAG_COUNT])errors, count, mean_reference) : NAN;
    free(errors);
    return lag;
}

static void aggregate_all(struct irb_frame_scores *whole, const struct irb_frame_scores *frames,
                          int count, const struct irb_target_constants *constants)
{
    double *v = whole->values;
    irb_frame_scores_clear(whole);
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        v[i] = aggregate(frames, count, i, &frames->values[i]);
    for (int r = 0; r < IRB_MOST_REGIONS; r++)
        for (int i = 0; i < IRB_REGION_METRIC_COUNT; i++)
            whole->regions[r][i] =
                aggregate(frames, count, irb_region_metrics[i], &frames->regions[r][i]);
    irb_metrics_derive(
        v, &(struct irb_sequence_scale){constants->mean_indirect, constants->mean_full,
                                        constants->peak_indirect, constants->peak_full});
    v[IRB_METRIC_lag] = sequence_lag(frames, count, constants->mean_indirect);
}

bool irb_sequence_scores_store(const struct irb_frame_scores *frames, int count,
                               const struct irb_target_constants *constants,
                               struct irb_store *store, const struct irb_scored_trial *trial,
                               struct irb_error *err)
{
    struct irb_frame_scores whole;
    struct statistics statistics = {.bytes = NAN};
    if (!irb_store_read_statistics(store, trial->id, read_statistic, &statistics, err))
        return false;
    aggregate_all(&whole, frames, count, constants);
    whole.values[IRB_METRIC_uncovered_flux] = mean_of(&statistics.uncovered);
    whole.values[IRB_METRIC_clamped_light] = mean_of(&statistics.clamped);
    whole.values[IRB_METRIC_gl_bytes] = statistics.bytes;
    return irb_frame_scores_store(&whole, store, trial, -1, err);
}

bool irb_target_constants_store(const struct irb_target_constants *constants, struct irb_run *run,
                                const struct irb_sequence *sequence, struct irb_error *err)
{
    const struct irb_store_value values[] = {
        {"mean_indirect", constants->mean_indirect},
        {"mean_full", constants->mean_full},
        {"relmse_eps_indirect", constants->eps_indirect},
        {"relmse_eps_full", constants->eps_full},
        {"flip_indirect_start", constants->flip_indirect.start},
        {"flip_indirect_stop", constants->flip_indirect.stop},
        {"flip_indirect_exposures", constants->flip_indirect.count},
        {"flip_full_start", constants->flip_full.start},
        {"flip_full_stop", constants->flip_full.stop},
        {"flip_full_exposures", constants->flip_full.count},
        {"psnr_peak_indirect", constants->peak_indirect},
        {"psnr_peak_full", constants->peak_full},
        {"preview_exposure", constants->exposure},
        {"profile_row", constants->profile_row},
        {"film_v0_indirect", constants->film_indirect.v0},
        {"film_vmax_indirect", constants->film_indirect.vmax},
        {"film_v0_direct", constants->film_full.v0},
        {"film_vmax_direct", constants->film_full.vmax},
    };
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char *name = irb_asprintf("scene/%s/%s", sequence->entry->name, values[i].name);
        char *text = irb_asprintf("%.9g", values[i].value);
        bool ok = irb_store_set_meta(run->store, name, text, err);
        free(text);
        free(name);
        if (!ok)
            return false;
    }
    return true;
}
