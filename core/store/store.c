/* SPDX-License-Identifier: MIT */
#include "core/store/store.h"
#include "core/base/fs.h"
#include "core/base/str.h"

#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

/* Readers never wait in WAL mode; two writers of one run wait for each other this long. */
static const int busy_timeout_ms = 10000;
/* "irbb" in PRAGMA application_id: tells our databases from other SQLite files. */
static const int application_id = 0x69726262;

/* What schema 2 has and 1 had not: times of each repeat, and costs. */
#define STAGE_TIME_SQL                                                                             \
    "CREATE TABLE stage_time(trial INTEGER NOT NULL, frame INTEGER NOT NULL,"                      \
    " repeat INTEGER NOT NULL, stage TEXT NOT NULL, ms REAL,"                                      \
    " PRIMARY KEY(trial, frame, repeat, stage),"                                                   \
    " FOREIGN KEY(trial, frame) REFERENCES frame(trial, frame) ON DELETE CASCADE) WITHOUT ROWID;"
#define COST_SQL                                                                                   \
    "CREATE TABLE cost(trial INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,"             \
    " name TEXT NOT NULL, value REAL, PRIMARY KEY(trial, name)) WITHOUT ROWID;"

static const char schema_sql[] =
    "CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
    "CREATE TABLE trial(id INTEGER PRIMARY KEY, scene TEXT NOT NULL, method TEXT NOT NULL,"
    " trial TEXT NOT NULL, params TEXT NOT NULL, seed INTEGER NOT NULL,"
    " UNIQUE(scene, trial, seed));"
    "CREATE TABLE frame(trial INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,"
    " frame INTEGER NOT NULL, clock TEXT NOT NULL, PRIMARY KEY(trial, frame)) WITHOUT "
    "ROWID;" STAGE_TIME_SQL "CREATE TABLE statistic(trial INTEGER NOT NULL, frame INTEGER NOT NULL,"
    " name TEXT NOT NULL, value REAL, PRIMARY KEY(trial, frame, name),"
    " FOREIGN KEY(trial, frame) REFERENCES frame(trial, frame) ON DELETE CASCADE) WITHOUT ROWID;"
    /* frame -1 is the sequence */
    "CREATE TABLE score(trial INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,"
    " frame INTEGER NOT NULL, metric TEXT NOT NULL, value REAL,"
    " PRIMARY KEY(trial, frame, metric)) WITHOUT ROWID;" COST_SQL
    /* for people who open the file with sqlite3 */
    "CREATE VIEW result AS SELECT t.scene, t.trial, t.seed, s.frame, s.metric, s.value"
    " FROM score s JOIN trial t ON t.id = s.trial;";

/* Schema 1 becomes 2: all of its times are repeat 0's. */
static const char migrate_sql[] =
    "ALTER TABLE stage_time RENAME TO stage_time_1;" STAGE_TIME_SQL
    "INSERT INTO stage_time SELECT trial, frame, 0, stage, ms FROM stage_time_1;"
    "DROP TABLE stage_time_1;" COST_SQL "PRAGMA user_version = 2;";

/* Schema 1 as 2 for one reader, who changes no file: temporary names win over the file's. */
static const char view_sql[] = "PRAGMA temp_store = MEMORY;"
                               "CREATE TEMP VIEW stage_time AS"
                               " SELECT trial, frame, 0 AS repeat, stage, ms FROM main.stage_time;"
                               "CREATE TEMP TABLE cost(trial INTEGER, name TEXT, value REAL);";

/* Every statement, prepared when it is first used and kept. */
enum statement {
    SET_META,
    GET_META,
    READ_META,
    FIND_TRIAL,
    ADD_TRIAL,
    ADD_FRAME,
    DROP_STAGES,
    ADD_STAGE,
    DROP_STATISTICS,
    ADD_STATISTIC,
    DROP_SCORES,
    ADD_SCORE,
    SET_COST,
    HAS_FRAME,
    HAS_REPEAT,
    HAS_SCORES,
    GET_CLOCK,
    LIST_TRIALS,
    READ_SCORES,
    READ_TIMES,
    READ_STATISTICS,
    READ_COSTS,
    STATEMENTS
};

static const char *const statement_sql[STATEMENTS] = {
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

struct irb_store {
    sqlite3 *db;
    char *path;
    sqlite3_stmt *statements[STATEMENTS];
};

/* ---- SQLite, with our errors ---- */

static bool fail(struct irb_store *store, const char *doing, struct irb_error *err)
{
    int cause = sqlite3_errcode(store->db) & 0xff;
    bool damaged = cause == SQLITE_CORRUPT || cause == SQLITE_NOTADB;
    return irb_fail(err, damaged ? IRB_E_INPUT : IRB_E_IO, "%s: cannot %s: %s%s", store->path,
                    doing, sqlite3_errmsg(store->db),
                    damaged ? "; the file is damaged: remove it and run again" : "");
}

static bool exec(struct irb_store *store, const char *sql, const char *doing, struct irb_error *err)
{
    return sqlite3_exec(store->db, sql, NULL, NULL, NULL) == SQLITE_OK || fail(store, doing, err);
}

/* A statement ready for its arguments; NULL on failure. */
static sqlite3_stmt *statement(struct irb_store *store, enum statement which)
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

/* Ends the transaction: all of it or nothing. */
static bool finish(struct irb_store *store, bool ok, struct irb_error *err)
{
    ok = ok && exec(store, "COMMIT", "write", err);
    if (!ok)
        sqlite3_exec(store->db, "ROLLBACK", NULL, NULL, NULL);
    return ok;
}

/* ---- opening ---- */

static int pragma_int(struct irb_store *store, const char *sql, int *value)
{
    sqlite3_stmt *stmt = NULL;
    int result = sqlite3_prepare_v2(store->db, sql, -1, &stmt, NULL);
    if (result == SQLITE_OK && (result = sqlite3_step(stmt)) == SQLITE_ROW)
        *value = sqlite3_column_int(stmt, 0);
    sqlite3_finalize(stmt);
    return result;
}

static bool create_schema(struct irb_store *store, struct irb_error *err)
{
    char *versions = irb_asprintf("PRAGMA application_id = %d; PRAGMA user_version = %d;",
                                  application_id, IRB_STORE_SCHEMA);
    bool ok = exec(store, schema_sql, "create the tables", err) &&
              exec(store, versions, "create the tables", err);
    free(versions);
    return ok;
}

/* What a file holds. */
enum content { REFUSED, NOTHING, THIS_SCHEMA, SCHEMA_1 };

/* Tells a new file, one of ours and anything else apart. */
static enum content look_at(struct irb_store *store, bool create, struct irb_error *err)
{
    int id = 0, version = 0, tables = 0;
    if (pragma_int(store, "PRAGMA application_id", &id) != SQLITE_ROW ||
        pragma_int(store, "PRAGMA user_version", &version) != SQLITE_ROW ||
        pragma_int(store, "SELECT count(*) FROM sqlite_master", &tables) != SQLITE_ROW) {
        fail(store, "read", err);
        return REFUSED;
    }
    if (!tables && create)
        return NOTHING;
    if (id == application_id && (version == IRB_STORE_SCHEMA || version == 1))
        return version == 1 ? SCHEMA_1 : THIS_SCHEMA;
    if (id != application_id)
        irb_fail(err, IRB_E_INPUT, "%s: expected results of irbench, found %s", store->path,
                 tables ? "a database of something else" : "an empty file");
    else
        irb_fail(err, IRB_E_INPUT,
                 "%s: expected results of schema version %d, found version %d; use another "
                 "folder, or the irbench that wrote it",
                 store->path, IRB_STORE_SCHEMA, version);
    return REFUSED;
}

/* Finds damage now, with one clear line, and not in the middle of a run. */
static bool check_integrity(struct irb_store *store, struct irb_error *err)
{
    sqlite3_stmt *stmt = NULL;
    bool ok =
        sqlite3_prepare_v2(store->db, "PRAGMA quick_check(1)", -1, &stmt, NULL) == SQLITE_OK &&
        sqlite3_step(stmt) == SQLITE_ROW;
    if (!ok) {
        fail(store, "read", err);
    } else {
        const char *verdict = (const char *)sqlite3_column_text(stmt, 0);
        ok = verdict && !strcmp(verdict, "ok");
        size_t line = verdict ? strcspn(verdict, "\n") : 0;
        if (!ok)
            irb_fail(err, IRB_E_INPUT,
                     "%s: the database is damaged (%.*s); remove it and run again", store->path,
                     (int)line, verdict ? verdict : "");
    }
    sqlite3_finalize(stmt);
    return ok;
}

static bool open_reading(struct irb_store *store, struct irb_error *err)
{
    enum content content = look_at(store, false, err); /* the first to read the file */
    return content != REFUSED && check_integrity(store, err) &&
           exec(store, "PRAGMA foreign_keys = ON", "open", err) &&
           (content != SCHEMA_1 || exec(store, view_sql, "read the tables of version 1", err));
}

/* In a write transaction, so that two processes cannot both see an empty file, or an old one. */
static bool prepare_tables(struct irb_store *store, struct irb_error *err)
{
    enum content content = look_at(store, true, err);
    if (content == NOTHING)
        return create_schema(store, err);
    return content != REFUSED && check_integrity(store, err) &&
           (content != SCHEMA_1 || exec(store, migrate_sql, "convert the tables", err));
}

static bool open_writing(struct irb_store *store, struct irb_error *err)
{
    /* NORMAL loses nothing when the process is killed, and keeps the file whole if power fails */
    if (!exec(store,
              "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
              "PRAGMA foreign_keys = ON; BEGIN IMMEDIATE",
              "open for writing", err))
        return false;
    return finish(store, prepare_tables(store, err), err);
}

struct irb_store *irb_store_open(const char *run_dir, bool create, struct irb_error *err)
{
    if (create && !irb_fs_make_dirs(run_dir, err))
        return NULL;
    struct irb_store *store = calloc(1, sizeof *store);
    if (!store) {
        irb_fail(err, IRB_E_MEMORY, "%s: out of memory", run_dir);
        return NULL;
    }
    store->path = irb_asprintf("%s/results.sqlite", run_dir);
    if (!create && !irb_fs_exists(store->path)) {
        irb_fail(err, IRB_E_INPUT, "%s: no results: there is no such file; expected a run folder",
                 store->path);
        irb_store_close(store);
        return NULL;
    }
    int flags = SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0);
    bool ok = sqlite3_open_v2(store->path, &store->db, flags, NULL) == SQLITE_OK ||
              fail(store, "open", err);
    if (ok)
        sqlite3_busy_timeout(store->db, busy_timeout_ms);
    if (!ok || !(create ? open_writing(store, err) : open_reading(store, err))) {
        irb_store_close(store);
        return NULL;
    }
    return store;
}

void irb_store_close(struct irb_store *store)
{
    if (!store)
        return;
    for (int i = 0; i < STATEMENTS; i++)
        sqlite3_finalize(store->statements[i]);
    sqlite3_close(store->db);
    free(store->path);
    free(store);
}

/* ---- provenance ---- */

bool irb_store_set_meta(struct irb_store *store, const char *name, const char *value,
                        struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, SET_META);
    if (!stmt)
        return fail(store, "write", err);
    bind_text(stmt, 1, name);
    bind_text(stmt, 2, value);
    return run_once(stmt) == SQLITE_DONE || fail(store, "write", err);
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

bool irb_store_read_meta(struct irb_store *store, irb_store_meta_fn fn, void *user,
                         struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, READ_META);
    if (!stmt)
        return fail(store, "read", err);
    int result;
    while ((result = sqlite3_step(stmt)) == SQLITE_ROW) {
        const char *value = (const char *)sqlite3_column_text(stmt, 1);
        fn(user, (const char *)sqlite3_column_text(stmt, 0), value ? value : "");
    }
    bool ok = result == SQLITE_DONE || fail(store, "read", err);
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
        return fail(store, "read", err);
    sqlite3_stmt *stmt = statement(store, ADD_TRIAL);
    if (!stmt)
        return fail(store, "write", err);
    bind_text(stmt, 1, scene);
    bind_text(stmt, 2, trial);
    sqlite3_bind_int(stmt, 3, seed);
    bind_text(stmt, 4, method);
    bind_text(stmt, 5, params_json);
    if (run_once(stmt) != SQLITE_DONE)
        return fail(store, "write", err);
    return sqlite3_last_insert_rowid(store->db);
}

bool irb_store_trials(struct irb_store *store, struct irb_store_trial_list *out,
                      struct irb_error *err)
{
    *out = (struct irb_store_trial_list){0};
    sqlite3_stmt *stmt = statement(store, LIST_TRIALS);
    if (!stmt)
        return fail(store, "read", err);
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
                                    : fail(store, "read", err));
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
static bool drop(struct irb_store *store, enum statement which, int64_t trial, int frame,
                 int repeat, struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, which);
    if (!stmt)
        return fail(store, "write", err);
    sqlite3_bind_int64(stmt, 1, trial);
    sqlite3_bind_int(stmt, 2, frame);
    sqlite3_bind_int(stmt, 3, repeat);
    return run_once(stmt) == SQLITE_DONE || fail(store, "write", err);
}

static void bind_number(sqlite3_stmt *stmt, int index, double value)
{
    if (!isnan(value)) /* else unbound, which is NULL */
        sqlite3_bind_double(stmt, index, value);
}

static bool add_values(struct irb_store *store, enum statement which, int64_t trial, int frame,
                       int repeat, const struct irb_store_value *values, int count,
                       struct irb_error *err)
{
    for (int i = 0; i < count; i++) {
        sqlite3_stmt *stmt = statement(store, which);
        if (!stmt)
            return fail(store, "write", err);
        sqlite3_bind_int64(stmt, 1, trial);
        sqlite3_bind_int(stmt, 2, frame);
        bind_text(stmt, 3, values[i].name);
        bind_number(stmt, 4, values[i].value);
        sqlite3_bind_int(stmt, 5, repeat);
        if (run_once(stmt) != SQLITE_DONE)
            return fail(store, "write", err);
    }
    return true;
}

static bool add_frame(struct irb_store *store, int64_t trial, int frame, const char *clock,
                      struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, ADD_FRAME);
    if (!stmt)
        return fail(store, "write", err);
    sqlite3_bind_int64(stmt, 1, trial);
    sqlite3_bind_int(stmt, 2, frame);
    bind_text(stmt, 3, clock);
    return run_once(stmt) == SQLITE_DONE || fail(store, "write", err);
}

bool irb_store_frame(struct irb_store *store, int64_t trial, int frame, const char *clock,
                     const struct irb_store_value *stage_ms, int stage_count,
                     const struct irb_store_value *statistics, int statistic_count,
                     struct irb_error *err)
{
    if (!exec(store, "BEGIN IMMEDIATE", "write", err))
        return false;
    bool ok = add_frame(store, trial, frame, clock, err) &&
              drop(store, DROP_STAGES, trial, frame, 0, err) &&
              drop(store, DROP_STATISTICS, trial, frame, 0, err) &&
              add_values(store, ADD_STAGE, trial, frame, 0, stage_ms, stage_count, err) &&
              add_values(store, ADD_STATISTIC, trial, frame, 0, statistics, statistic_count, err);
    return finish(store, ok, err);
}

bool irb_store_repeat(struct irb_store *store, int64_t trial, int repeat, int frame,
                      const struct irb_store_value *stage_ms, int count, struct irb_error *err)
{
    if (!exec(store, "BEGIN IMMEDIATE", "write", err))
        return false;
    bool ok = drop(store, DROP_STAGES, trial, frame, repeat, err) &&
              add_values(store, ADD_STAGE, trial, frame, repeat, stage_ms, count, err);
    return finish(store, ok, err);
}

bool irb_store_cost(struct irb_store *store, int64_t trial, const char *name, double value,
                    struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, SET_COST);
    if (!stmt)
        return fail(store, "write", err);
    sqlite3_bind_int64(stmt, 1, trial);
    bind_text(stmt, 2, name);
    bind_number(stmt, 3, value);
    return run_once(stmt) == SQLITE_DONE || fail(store, "write", err);
}

bool irb_store_scores(struct irb_store *store, int64_t trial, int frame,
                      const struct irb_store_value *metrics, int count, struct irb_error *err)
{
    if (!exec(store, "BEGIN IMMEDIATE", "write", err))
        return false;
    bool ok = drop(store, DROP_SCORES, trial, frame, 0, err) &&
              add_values(store, ADD_SCORE, trial, frame, 0, metrics, count, err);
    return finish(store, ok, err);
}

static bool has(struct irb_store *store, enum statement which, int64_t trial, int frame, int repeat)
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

static bool read_values(struct irb_store *store, enum statement which, int64_t trial,
                        irb_store_value_fn fn, void *user, struct irb_error *err)
{
    sqlite3_stmt *stmt = statement(store, which);
    if (!stmt)
        return fail(store, "read", err);
    sqlite3_bind_int64(stmt, 1, trial);
    int result;
    while ((result = sqlite3_step(stmt)) == SQLITE_ROW)
        fn(user, sqlite3_column_int(stmt, 0), (const char *)sqlite3_column_text(stmt, 1),
           column_number(stmt, 2));
    bool ok = result == SQLITE_DONE || fail(store, "read", err);
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
        return fail(store, "read", err);
    sqlite3_bind_int64(stmt, 1, trial);
    int result;
    while ((result = sqlite3_step(stmt)) == SQLITE_ROW)
        fn(user, sqlite3_column_int(stmt, 0), sqlite3_column_int(stmt, 1),
           (const char *)sqlite3_column_text(stmt, 2), column_number(stmt, 3));
    bool ok = result == SQLITE_DONE || fail(store, "read", err);
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
