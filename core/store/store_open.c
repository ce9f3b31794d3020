/* SPDX-License-Identifier: MIT
 *
 * Opening a run's database: its schema, and files of an older one.
 */
#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/store/store_parts.h"

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
    bool ok = irb_store_exec(store, schema_sql, "create the tables", err) &&
              irb_store_exec(store, versions, "create the tables", err);
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
        irb_store_fail(store, "read", err);
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
        irb_store_fail(store, "read", err);
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
           irb_store_exec(store, "PRAGMA foreign_keys = ON", "open", err) &&
           (content != SCHEMA_1 ||
            irb_store_exec(store, view_sql, "read the tables of version 1", err));
}

/* In a write transaction, so that two processes cannot both see an empty file, or an old one. */
static bool prepare_tables(struct irb_store *store, struct irb_error *err)
{
    enum content content = look_at(store, true, err);
    if (content == NOTHING)
        return create_schema(store, err);
    return content != REFUSED && check_integrity(store, err) &&
           (content != SCHEMA_1 || irb_store_exec(store, migrate_sql, "convert the tables", err));
}

static bool open_writing(struct irb_store *store, struct irb_error *err)
{
    /* NORMAL loses nothing when the process is killed, and keeps the file whole if power fails */
    if (!irb_store_exec(store,
                        "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
                        "PRAGMA foreign_keys = ON; BEGIN IMMEDIATE",
                        "open for writing", err))
        return false;
    return irb_store_finish(store, prepare_tables(store, err), err);
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
              irb_store_fail(store, "open", err);
    if (ok)
        sqlite3_busy_timeout(store->db, busy_timeout_ms);
    if (!ok || !(create ? open_writing(store, err) : open_reading(store, err))) {
        irb_store_close(store);
        return NULL;
    }
    return store;
}

struct irb_store *irb_store_open_snapshot(const char *run_dir, struct irb_error *err)
{
    /* the first to read is what fixes the moment; closing ends the transaction */
    static const char sql[] = "BEGIN DEFERRED; SELECT count(*) FROM main.meta";
    struct irb_store *store = irb_store_open(run_dir, false, err);
    if (store && !irb_store_exec(store, sql, "read", err)) {
        irb_store_close(store);
        return NULL;
    }
    return store;
}

void irb_store_close(struct irb_store *store)
{
    if (!store)
        return;
    for (int i = 0; i < IRB_STORE_STATEMENTS; i++)
        sqlite3_finalize(store->statements[i]);
    sqlite3_close(store->db);
    free(store->path);
    free(store);
}
