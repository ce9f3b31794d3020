/* SPDX-License-Identifier: MIT
 *
 * What goes into the tables and comes out of them.
 */
#include "core/base/str.h"
#include "core/store/store_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const statement_sql[IRB_STORE_STATEMENTS] = {
    [SET_META] = "INSERT OR REPLACE INTO meta(name, value) VALUES(?1, ?2)",
    [GET_META] = "SELECT value FROM meta WHERE name = ?1",
    [READ_META] = "SELECT name, value FROM meta ORDER BY name",
    [FIND_TRIAL] = "SELECT id, method, params FROM trial"
                   " WHERE scene = ?1 AND trial = ?2 AND seed = ?3",
    [ADD_TRIAL] = "INSERT INTO trial(scene, trial, seed, method, params) VALUES(?1,?2,?3,?4,?5)",
    [ADD_FRAME] = "INSERT INTO frame(trial, frame, clock) VALUES(?1, ?2, ?3)"
                  " ON CONFLICT(trial, frame) DO UPDATE SET clock = excluded.clock",
    [DROP_STAGES] = "DELETE FROM stage_time WHERE trial = ?1 AND frame = ?2 AND repeat = ?3",
    [ADD_STAGE] = "INSERT INTO stage_time(trial, frame, stage, ms, repeat)"
                  " VALUES(?1, ?2, ?3, ?4, ?5)",
    [DROP_STATISTICS] = "DELETE FROM statistic WHERE trial = ?1 AND frame = ?2",
    [ADD_STATISTIC] = "INSERT INTO statistic(trial, frame, name, value) VALUES(?1, ?2, ?3, ?4)",
    [DROP_SCORES] = "DELETE FROM score WHERE trial = ?1 AND frame = ?2",
    [ADD_SCORE] = "INSERT INTO score(trial, frame, metric, value) VALUES(?1, ?2, ?3, ?4)",
    [SET_COST] = "INSERT OR REPLACE INTO cost(trial, name, value) VALUES(?1, ?2, ?3)",
    [HAS_FRAME] = "SELECT 1 FROM frame WHERE trial = ?1 AND frame = ?2",
    [HAS_REPEAT] = "SELECT 1 FROM stage_time WHERE trial = ?1 AND frame = ?2 AND repeat = ?3"
                   " LIMIT 1",
    [HAS_SCORES] = "SELECT 1 FROM score WHERE trial = ?1 AND frame = ?2 LIMIT 1",
    [GET_CLOCK] = "SELECT clock FROM frame WHERE trial = ?1 ORDER BY frame LIMIT 1",
    [LIST_TRIALS] = "SELECT id, scene, method, trial, params, seed FROM trial ORDER BY id",
    [READ_SCORES] = "SELECT frame, metric, value FROM score WHERE trial = ?1"
                    " ORDER BY frame, metric",
    [READ_TIMES] = "SELECT repeat, frame, stage, ms FROM stage_time WHERE trial = ?1"
                   " ORDER BY repeat, frame, stage",
    [READ_STATISTICS] = "SELECT frame, name, value FROM statistic WHERE trial = ?1"
                        " ORDER BY frame, name",
    [READ_COSTS] = "SELECT -1, name, value FROM cost WHERE trial = ?1 ORDER BY name",
};

/* ---- SQLite, with our errors ---- */

bool irb_store_fail(struct irb_store *store, const char *doing, struct irb_error *err)
{
    int cause = sqlite3_errcode(store->db) & 0xff;
    bool damaged = cause == SQLITE_CORRUPT || cause == SQLITE_NOTADB;
    return irb_fail(err, damaged ? IRB_E_INPUT : IRB_E_IO, "%s: cannot %s: %s%s", store->path,
                    doing, sqlite3_errmsg(store->db),
                    damaged ? "; the file is damaged: remove it and run again" : "");
}

bool irb_store_exec(struct irb_store *store, const char *sql, const char *doing,
                    struct irb_error *err)
{
    return sqlite3_exec(store->db, sql, NULL, NULL, NULL) == SQLITE_OK ||
           irb_store_fail(store, doing, err);
}

/* A statement ready for its arguments; NULL on failure. */
static sqlite3_stmt *statement(struct irb_store *store, enum irb_store_statement which)
{
    sqlite3_stmt **kept = &store->statements[which];
    if (!*kept && sqlite3_prepare_v3(store->db, statement_sql[which], -1, SQLITE_PREPARE_PERSISTENT,
                                     kept, NULL) != SQLITE_OK)
        return NULL;
    return *kept;
}

static void bind_text(sqlite3_stmt *stmt, int index, const char *text)
{
    sqlite3_bind_text(stmt, index, text, -1, SQLITE_STATIC);
}

/* A copy of a text column; NULL stays NULL. */
static char *column_text(sqlite3_stmt *stmt, int column)
{
    const char *text = (const char *)sqlite3_column_text(stmt, column);
    return text ? irb_strdup(text) : NULL;
}

/* Steps once and resets: SQLITE_ROW, SQLITE_DONE or an error, which the reset keeps in the
 * connection. Bound texts are borrowed, so they are let go of. */
static int run_once(sqlite3_stmt *stmt)
{
    int result = sqlite3_step(stmt);
    int reset = sqlite3_reset(stmt);
    sqlite3_clear_bindings(stmt);
    return reset != SQLITE_OK ? reset : result;
}

bool irb_store_finish(struct irb_store *store, bool ok, struct irb_error *err)
{
    ok = ok && irb_store_exec(store, "COMMIT", "write", err);
    if (!ok)
        sqlite3_exec(store->db, "ROLLBACK", NULL, NULL, NULL);
    return ok;
}

/* ---- provenance ---- */

bool irb_store_set_meta(struct irb_store *store, const char *name, const char *value,
                        struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, SET_META);
    if (!stmt)
        return irb_store_fail(store, "write", err);
    bind_text(stmt, 1, name);
    bind_text(stmt, 2, value);
    return run_once(stmt) == SQLITE_DONE || irb_store_fail(store, "write", err);
}

char *irb_store_get_meta(struct irb_store *store, const char *name)
{
    sqlite3_stmt *stmt = statement(store, GET_META);
    if (!stmt)
        return NULL;
    bind_text(stmt, 1, name);
    char *value = sqlite3_step(stmt) == SQLITE_ROW ? column_text(stmt, 0) : NULL;
    sqlite3_reset(stmt);
    sqlite3_clear_bindings(stmt);
    return value;
}

char *irb_store_get_scene_meta(struct irb_store *store, const char *scene, const char *name)
{
    char *key = irb_asprintf("scene/%s/%s", scene, name);
    char *value = irb_store_get_meta(store, key);
    free(key);
    return value;
}

double irb_store_scene_number(struct irb_store *store, const char *scene, const char *name)
{
    char *text = irb_store_get_scene_meta(store, scene, name), *end = text;
    double number = text ? strtod(text, &end) : NAN;
    if (end == text)
        number = NAN;
    free(text);
    return number;
}

bool irb_store_read_meta(struct irb_store *store, irb_store_meta_fn fn, void *user,
                         struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, READ_META);
    if (!stmt)
        return irb_store_fail(store, "read", err);
    int result;
    while ((result = sqlite3_step(stmt)) == SQLITE_ROW) {
        const char *value = (const char *)sqlite3_column_text(stmt, 1);
        fn(user, (const char *)sqlite3_column_text(stmt, 0), value ? value : "");
    }
    bool ok = result == SQLITE_DONE || irb_store_fail(store, "read", err);
    sqlite3_reset(stmt);
    return ok;
}

/* ---- trials ---- */

/* FIND_TRIAL with its row, which the caller resets; NULL where there is none. */
static sqlite3_stmt *find_trial(struct irb_store *store, const char *scene, const char *trial,
                                int seed, int *result)
{
    sqlite3_stmt *stmt = statement(store, FIND_TRIAL);
    *result = SQLITE_ERROR;
    if (!stmt)
        return NULL;
    bind_text(stmt, 1, scene);
    bind_text(stmt, 2, trial);
    sqlite3_bind_int(stmt, 3, seed);
    *result = sqlite3_step(stmt);
    if (*result == SQLITE_ROW)
        return stmt;
    sqlite3_reset(stmt);
    sqlite3_clear_bindings(stmt);
    return NULL;
}

int64_t irb_store_trial_find(struct irb_store *store, const char *scene, const char *trial,
                             int seed)
{
    int result;
    sqlite3_stmt *stmt = find_trial(store, scene, trial, seed, &result);
    int64_t id = stmt ? sqlite3_column_int64(stmt, 0) : 0;
    sqlite3_reset(stmt);
    return id;
}

/* The row that is there must be the trial that is asked for. */
static int64_t same_trial(struct irb_store *store, sqlite3_stmt *row, const char *scene,
                          const char *trial, const char *method, const char *params,
                          struct irb_error *err)
{
    const char *old_method = (const char *)sqlite3_column_text(row, 1);
    const char *old_params = (const char *)sqlite3_column_text(row, 2);
    if (!strcmp(old_method, method) && !strcmp(old_params, params))
        return sqlite3_column_int64(row, 0);
    irb_fail(err, IRB_E_INPUT,
             "%s: %s, %s: stored with other parameters (has a default changed?): expected %s, "
             "found %s",
             store->path, scene, trial, params, old_params);
    return 0;
}

int64_t irb_store_trial(struct irb_store *store, const char *scene, const char *method,
                        const char *trial, const char *params_json, int seed, struct irb_error *err)
{
    int result;
    sqlite3_stmt *row = find_trial(store, scene, trial, seed, &result);
    if (row) {
        int64_t id = same_trial(store, row, scene, trial, method, params_json, err);
        sqlite3_reset(row);
        return id;
    }
    if (result != SQLITE_DONE)
        return irb_store_fail(store, "read", err);
    sqlite3_stmt *stmt = statement(store, ADD_TRIAL);
    if (!stmt)
        return irb_store_fail(store, "write", err);
    bind_text(stmt, 1, scene);
    bind_text(stmt, 2, trial);
    sqlite3_bind_int(stmt, 3, seed);
    bind_text(stmt, 4, method);
    bind_text(stmt, 5, params_json);
    if (run_once(stmt) != SQLITE_DONE)
        return irb_store_fail(store, "write", err);
    return sqlite3_last_insert_rowid(store->db);
}

bool irb_store_trials(struct irb_store *store, struct irb_store_trial_list *out,
                      struct irb_error *err)
{
    *out = (struct irb_store_trial_list){0};
    sqlite3_stmt *stmt = statement(store, LIST_TRIALS);
    if (!stmt)
        return irb_store_fail(store, "read", err);
    int result;
    while ((result = sqlite3_step(stmt)) == SQLITE_ROW) {
        void *grown = realloc(out->rows, (size_t)(out->count + 1) * sizeof *out->rows);
        if (!grown)
            break;
        out->rows = grown;
        out->rows[out->count++] = (struct irb_store_trial_row){
            .id = sqlite3_column_int64(stmt, 0),
            .scene = column_text(stmt, 1),
            .method = column_text(stmt, 2),
            .trial = column_text(stmt, 3),
            .params_json = column_text(stmt, 4),
            .seed = sqlite3_column_int(stmt, 5),
        };
    }
    bool ok = result == SQLITE_DONE ||
              (result == SQLITE_ROW ? irb_fail(err, IRB_E_MEMORY, "%s: out of memory", store->path)
                                    : irb_store_fail(store, "read", err));
    sqlite3_reset(stmt);
    if (!ok)
        irb_store_trial_list_destroy(out);
    return ok;
}

void irb_store_trial_list_destroy(struct irb_store_trial_list *list)
{
    for (int i = 0; i < list->count; i++) {
        free(list->rows[i].scene);
        free(list->rows[i].method);
        free(list->rows[i].trial);
        free(list->rows[i].params_json);
    }
    free(list->rows);
    *list = (struct irb_store_trial_list){0};
}

/* ---- frames and scores ---- */

/* `repeat` is bound where the statement has one. */
static bool drop(struct irb_store *store, enum irb_store_statement which, int64_t trial, int frame,
                 int repeat, struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, which);
    if (!stmt)
        return irb_store_fail(store, "write", err);
    sqlite3_bind_int64(stmt, 1, trial);
    sqlite3_bind_int(stmt, 2, frame);
    sqlite3_bind_int(stmt, 3, repeat);
    return run_once(stmt) == SQLITE_DONE || irb_store_fail(store, "write", err);
}

static void bind_number(sqlite3_stmt *stmt, int index, double value)
{
    if (!isnan(value)) /* else unbound, which is NULL */
        sqlite3_bind_double(stmt, index, value);
}

static bool add_values(struct irb_store *store, enum irb_store_statement which, int64_t trial,
                       int frame, int repeat, const struct irb_store_value *values, int count,
                       struct irb_error *err)
{
    for (int i = 0; i < count; i++) {
        sqlite3_stmt *stmt = statement(store, which);
        if (!stmt)
            return irb_store_fail(store, "write", err);
        sqlite3_bind_int64(stmt, 1, trial);
        sqlite3_bind_int(stmt, 2, frame);
        bind_text(stmt, 3, values[i].name);
        bind_number(stmt, 4, values[i].value);
        sqlite3_bind_int(stmt, 5, repeat);
        if (run_once(stmt) != SQLITE_DONE)
            return irb_store_fail(store, "write", err);
    }
    return true;
}

static bool add_frame(struct irb_store *store, int64_t trial, int frame, const char *clock,
                      struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, ADD_FRAME);
    if (!stmt)
        return irb_store_fail(store, "write", err);
    sqlite3_bind_int64(stmt, 1, trial);
    sqlite3_bind_int(stmt, 2, frame);
    bind_text(stmt, 3, clock);
    return run_once(stmt) == SQLITE_DONE || irb_store_fail(store, "write", err);
}

bool irb_store_frame(struct irb_store *store, int64_t trial, int frame, const char *clock,
                     const struct irb_store_value *stage_ms, int stage_count,
                     const struct irb_store_value *statistics, int statistic_count,
                     struct irb_error *err)
{
    if (!irb_store_exec(store, "BEGIN IMMEDIATE", "write", err))
        return false;
    bool ok = add_frame(store, trial, frame, clock, err) &&
              drop(store, DROP_STAGES, trial, frame, 0, err) &&
              drop(store, DROP_STATISTICS, trial, frame, 0, err) &&
              add_values(store, ADD_STAGE, trial, frame, 0, stage_ms, stage_count, err) &&
              add_values(store, ADD_STATISTIC, trial, frame, 0, statistics, statistic_count, err);
    return irb_store_finish(store, ok, err);
}

bool irb_store_repeat(struct irb_store *store, int64_t trial, int repeat, int frame,
                      const struct irb_store_value *stage_ms, int count, struct irb_error *err)
{
    if (!irb_store_exec(store, "BEGIN IMMEDIATE", "write", err))
        return false;
    bool ok = drop(store, DROP_STAGES, trial, frame, repeat, err) &&
              add_values(store, ADD_STAGE, trial, frame, repeat, stage_ms, count, err);
    return irb_store_finish(store, ok, err);
}

bool irb_store_cost(struct irb_store *store, int64_t trial, const char *name, double value,
                    struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, SET_COST);
    if (!stmt)
        return irb_store_fail(store, "write", err);
    sqlite3_bind_int64(stmt, 1, trial);
    bind_text(stmt, 2, name);
    bind_number(stmt, 3, value);
    return run_once(stmt) == SQLITE_DONE || irb_store_fail(store, "write", err);
}

bool irb_store_scores(struct irb_store *store, int64_t trial, int frame,
                      const struct irb_store_value *metrics, int count, struct irb_error *err)
{
    if (!irb_store_exec(store, "BEGIN IMMEDIATE", "write", err))
        return false;
    bool ok = drop(store, DROP_SCORES, trial, frame, 0, err) &&
              add_values(store, ADD_SCORE, trial, frame, 0, metrics, count, err);
    return irb_store_finish(store, ok, err);
}

static bool has(struct irb_store *store, enum irb_store_statement which, int64_t trial, int frame,
                int repeat)
{
    sqlite3_stmt *stmt = statement(store, which);
    if (!stmt)
        return false;
    sqlite3_bind_int64(stmt, 1, trial);
    sqlite3_bind_int(stmt, 2, frame);
    sqlite3_bind_int(stmt, 3, repeat);
    return run_once(stmt) == SQLITE_ROW;
}

char *irb_store_clock(struct irb_store *store, int64_t trial)
{
    sqlite3_stmt *stmt = statement(store, GET_CLOCK);
    if (!stmt)
        return NULL;
    sqlite3_bind_int64(stmt, 1, trial);
    char *clock = sqlite3_step(stmt) == SQLITE_ROW ? column_text(stmt, 0) : NULL;
    sqlite3_reset(stmt);
    return clock;
}

bool irb_store_has_frame(struct irb_store *store, int64_t trial, int frame)
{
    return has(store, HAS_FRAME, trial, frame, 0);
}

bool irb_store_has_repeat(struct irb_store *store, int64_t trial, int repeat, int frame)
{
    return has(store, HAS_REPEAT, trial, frame, repeat);
}

bool irb_store_has_scores(struct irb_store *store, int64_t trial, int frame)
{
    return has(store, HAS_SCORES, trial, frame, 0);
}

static double column_number(sqlite3_stmt *stmt, int column)
{
    return sqlite3_column_type(stmt, column) == SQLITE_NULL ? NAN
                                                            : sqlite3_column_double(stmt, column);
}

static bool read_values(struct irb_store *store, enum irb_store_statement which, int64_t trial,
                        irb_store_value_fn fn, void *user, struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, which);
    if (!stmt)
        return irb_store_fail(store, "read", err);
    sqlite3_bind_int64(stmt, 1, trial);
    int result;
    while ((result = sqlite3_step(stmt)) == SQLITE_ROW)
        fn(user, sqlite3_column_int(stmt, 0), (const char *)sqlite3_column_text(stmt, 1),
           column_number(stmt, 2));
    bool ok = result == SQLITE_DONE || irb_store_fail(store, "read", err);
    sqlite3_reset(stmt);
    return ok;
}

bool irb_store_read_scores(struct irb_store *store, int64_t trial, irb_store_value_fn fn,
                           void *user, struct irb_error *err)
{
    return read_values(store, READ_SCORES, trial, fn, user, err);
}

bool irb_store_read_times(struct irb_store *store, int64_t trial, irb_store_time_fn fn, void *user,
                          struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, READ_TIMES);
    if (!stmt)
        return irb_store_fail(store, "read", err);
    sqlite3_bind_int64(stmt, 1, trial);
    int result;
    while ((result = sqlite3_step(stmt)) == SQLITE_ROW)
        fn(user, sqlite3_column_int(stmt, 0), sqlite3_column_int(stmt, 1),
           (const char *)sqlite3_column_text(stmt, 2), column_number(stmt, 3));
    bool ok = result == SQLITE_DONE || irb_store_fail(store, "read", err);
    sqlite3_reset(stmt);
    return ok;
}

bool irb_store_read_statistics(struct irb_store *store, int64_t trial, irb_store_value_fn fn,
                               void *user, struct irb_error *err)
{
    return read_values(store, READ_STATISTICS, trial, fn, user, err);
}

bool irb_store_read_costs(struct irb_store *store, int64_t trial, irb_store_value_fn fn, void *user,
                          struct irb_error *err)
{
    return read_values(store, READ_COSTS, trial, fn, user, err);
}
