/* SPDX-License-Identifier: MIT
 *
 * The results of one run: an SQLite database RUN/results.sqlite. Tables, CSV, JSON and plots are
 * views of it. Every frame is one transaction, so that a killed run leaves whole frames only.
 * A second process may read while a run writes (WAL).
 */
#ifndef IRB_STORE_H
#define IRB_STORE_H

#include "core/base/error.h"

#include <stdint.h>

#define IRB_STORE_SCHEMA 2

struct irb_store;

/* Opens RUN/results.sqlite, creating folder and tables when `create`. IRB_E_INPUT for a missing or
 * damaged file, another schema version or a database of something else; IRB_E_IO for what the
 * system refuses.
 * A file of schema 1 (times without repeats, no costs) is converted, in one transaction, when it is
 * opened with `create`; else it is left alone and read as if it were: its times are repeat 0's,
 * and neither repeats nor costs can be stored. */
struct irb_store *irb_store_open(const char *run_dir, bool create, struct irb_error *err);
/* The same for reading alone, and what is read is of one moment (that of the call) however much a
 * run writes meanwhile, until the store is closed. A writer does not wait for it. */
struct irb_store *irb_store_open_snapshot(const char *run_dir, struct irb_error *err);
void irb_store_close(struct irb_store *store);

/* Provenance: one text value a name; set replaces. get returns malloc'ed text or NULL. */
bool irb_store_set_meta(struct irb_store *store, const char *name, const char *value,
                        struct irb_error *err);
char *irb_store_get_meta(struct irb_store *store, const char *name);
/* What is said of a scene, the value "scene/SCENE/name"; as a number NaN where there is none. */
char *irb_store_get_scene_meta(struct irb_store *store, const char *scene, const char *name);
double irb_store_scene_number(struct irb_store *store, const char *scene, const char *name);

/* Calls fn for every value, ordered by name. */
typedef void (*irb_store_meta_fn)(void *user, const char *name, const char *value);
bool irb_store_read_meta(struct irb_store *store, irb_store_meta_fn fn, void *user,
                         struct irb_error *err);

/* A trial of a scene; returns its id (>= 1), creating the row if needed; 0 on failure.
 * IRB_E_INPUT where the row is there with another method or other parameters. */
int64_t irb_store_trial(struct irb_store *store, const char *scene, const char *method,
                        const char *trial, const char *params_json, int seed,
                        struct irb_error *err);

/* The id of a trial that is there, or 0. */
int64_t irb_store_trial_find(struct irb_store *store, const char *scene, const char *trial,
                             int seed);

struct irb_store_value {
    const char *name;
    double value; /* NaN is stored as NULL */
};

/* One rendered frame: stage times in ms under "clock", as repeat 0's; statistics. Replaces an
 * earlier row (its scores and its repeats stay). */
bool irb_store_frame(struct irb_store *store, int64_t trial, int frame, const char *clock,
                     const struct irb_store_value *stage_ms, int stage_count,
                     const struct irb_store_value *statistics, int statistic_count,
                     struct irb_error *err);
/* Stage times of a frame rendered once more, repeat >= 1; the frame itself must be there. */
bool irb_store_repeat(struct irb_store *store, int64_t trial, int repeat, int frame,
                      const struct irb_store_value *stage_ms, int count, struct irb_error *err);
/* Whether there are times of that repeat; of repeat 0 as well. */
bool irb_store_has_repeat(struct irb_store *store, int64_t trial, int repeat, int frame);
/* What the trial pays once, before frame 0: "create_ms", "settle_ms". Replaces. */
bool irb_store_cost(struct irb_store *store, int64_t trial, const char *name, double value,
                    struct irb_error *err);
/* The clock of the trial's first frame that has one, malloc'ed; NULL where nothing is rendered. */
char *irb_store_clock(struct irb_store *store, int64_t trial);
/* Whether the frame has been rendered / scored. */
bool irb_store_has_frame(struct irb_store *store, int64_t trial, int frame);
bool irb_store_has_scores(struct irb_store *store, int64_t trial, int frame);

/* Metrics of one frame (frame >= 0) or of the sequence (frame = -1). */
bool irb_store_scores(struct irb_store *store, int64_t trial, int frame,
                      const struct irb_store_value *metrics, int count, struct irb_error *err);

/* ---- reading ---- */
struct irb_store_trial_row {
    int64_t id;
    char *scene, *method, *trial, *params_json; /* owned by the list */
    int seed;
};
struct irb_store_trial_list {
    struct irb_store_trial_row *rows;
    int count;
};
bool irb_store_trials(struct irb_store *store, struct irb_store_trial_list *out,
                      struct irb_error *err);
void irb_store_trial_list_destroy(struct irb_store_trial_list *list);

/* Calls fn for each (frame, name, value), ordered by frame then name; frame -1 first. */
typedef void (*irb_store_value_fn)(void *user, int frame, const char *name, double value);
bool irb_store_read_scores(struct irb_store *store, int64_t trial, irb_store_value_fn fn,
                           void *user, struct irb_error *err);
/* Likewise for a frame's statistics; and for costs, whose frame is -1. */
bool irb_store_read_statistics(struct irb_store *store, int64_t trial, irb_store_value_fn fn,
                               void *user, struct irb_error *err);
bool irb_store_read_costs(struct irb_store *store, int64_t trial, irb_store_value_fn fn, void *user,
                          struct irb_error *err);

/* Calls fn for each stage's time, ordered by repeat, frame, stage. */
typedef void (*irb_store_time_fn)(void *user, int repeat, int frame, const char *stage, double ms);
bool irb_store_read_times(struct irb_store *store, int64_t trial, irb_store_time_fn fn, void *user,
                          struct irb_error *err);

#endif
