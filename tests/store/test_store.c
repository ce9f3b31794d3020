/* SPDX-License-Identifier: MIT */
#include "core/store/store.h"
#include "tests/support/compare.h"

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

struct fixture {
    char dir[64], run[128], file[160];
};

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    strcpy(f->dir, "/tmp/irb_store_XXXXXX");
    if (!mkdtemp(f->dir))
        return -1;
    snprintf(f->run, sizeof f->run, "%s/a/run", f->dir);
    snprintf(f->file, sizeof f->file, "%s/results.sqlite", f->run);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", f->dir);
    int status = system(command);
    free(f);
    return status;
}

static struct irb_store *open_or_fail(const struct fixture *f, bool create)
{
    struct irb_error err = {0};
    struct irb_store *store = irb_store_open(f->run, create, &err);
    if (!store)
        fail_msg("%s", err.message);
    return store;
}

static void expect_refusal(const char *run, bool create, enum irb_error_code code, const char *path,
                           const char *words)
{
    struct irb_error err = {0};
    struct irb_store *store = irb_store_open(run, create, &err);
    if (store)
        fail_msg("%s was opened", run);
    if (err.code != code || strncmp(err.message, path, strlen(path)) ||
        !strstr(err.message, words) || strchr(err.message, '\n'))
        fail_msg("%s '%s' is not one line of %s that begins with '%s' and says '%s'",
                 irb_error_name(err.code), err.message, irb_error_name(code), path, words);
}

struct values {
    int count, frames[32];
    char names[32][32];
    double values[32];
};

static void collect(void *user, int frame, const char *name, double value)
{
    struct values *v = user;
    assert_true(v->count < 32);
    v->frames[v->count] = frame;
    snprintf(v->names[v->count], sizeof v->names[0], "%s", name);
    v->values[v->count++] = value;
}

/* Of times: the repeat and the stage as one name, "0/gather". */
static void collect_time(void *user, int repeat, int frame, const char *name, double value)
{
    char both[32];
    snprintf(both, sizeof both, "%d/%s", repeat, name);
    collect(user, frame, both, value);
}

static void require_value(const struct values *v, int index, int frame, const char *name,
                          double value)
{
    assert_true(index < v->count);
    assert_int_equal(v->frames[index], frame);
    assert_string_equal(v->names[index], name);
    /* bit for bit; an absent value comes back as NaN */
    if (isnan(value) ? !isnan(v->values[index]) : v->values[index] != value)
        fail_msg("%s = %.17g, expected %.17g", name, v->values[index], value);
}

static void fill(struct irb_store *store, int64_t *trial)
{
    struct irb_error err = {0};
    *trial = irb_store_trial(store, "cornell", "rsm", "rsm:samples=9", "{\"samples\": 9}", 1, &err);
    if (*trial < 1)
        fail_msg("%s", err.message);
    const struct irb_store_value stages[] = {{"gather", 4.25}, {"filter", 1e-3}};
    const struct irb_store_value statistics[] = {{"vpls", 9}, {"uncovered_flux", NAN}};
    for (int frame = 0; frame < 2; frame++)
        REQUIRE_OK(
            irb_store_frame(store, *trial, frame, "finish+clock", stages, 2, statistics, 2, &err));
    const struct irb_store_value metrics[] = {{"rmse", 0.1}, {"bias", -3e-8}};
    REQUIRE_OK(irb_store_scores(store, *trial, 0, metrics, 2, &err));
    const struct irb_store_value whole[] = {{"flicker", 0.5}, {"rmse", INFINITY}};
    REQUIRE_OK(irb_store_scores(store, *trial, -1, whole, 2, &err));
}

static void test_round_trip(void **state)
{
    struct irb_error err = {0};
    int64_t trial;
    struct irb_store *store = open_or_fail(*state, true);
    fill(store, &trial);
    REQUIRE_OK(irb_store_set_meta(store, "cpu", "one", &err));
    REQUIRE_OK(irb_store_set_meta(store, "cpu", "it's \"two\"", &err));
    irb_store_close(store);

    store = open_or_fail(*state, false);
    char *cpu = irb_store_get_meta(store, "cpu");
    assert_string_equal(cpu, "it's \"two\"");
    free(cpu);
    assert_null(irb_store_get_meta(store, "gpu"));

    char *clock = irb_store_clock(store, trial);
    assert_string_equal(clock, "finish+clock");
    free(clock);
    assert_null(irb_store_clock(store, trial + 1));

    struct irb_store_trial_list list;
    REQUIRE_OK(irb_store_trials(store, &list, &err));
    assert_int_equal(list.count, 1);
    assert_int_equal(list.rows[0].id, trial);
    assert_string_equal(list.rows[0].scene, "cornell");
    assert_string_equal(list.rows[0].method, "rsm");
    assert_string_equal(list.rows[0].trial, "rsm:samples=9");
    assert_string_equal(list.rows[0].params_json, "{\"samples\": 9}");
    assert_int_equal(list.rows[0].seed, 1);
    irb_store_trial_list_destroy(&list);

    struct values v = {0};
    REQUIRE_OK(irb_store_read_scores(store, trial, collect, &v, &err));
    assert_int_equal(v.count, 4);
    require_value(&v, 0, -1, "flicker", 0.5);
    require_value(&v, 1, -1, "rmse", INFINITY);
    require_value(&v, 2, 0, "bias", -3e-8);
    require_value(&v, 3, 0, "rmse", 0.1);
    v = (struct values){0};
    REQUIRE_OK(irb_store_read_times(store, trial, collect_time, &v, &err));
    assert_int_equal(v.count, 4);
    require_value(&v, 0, 0, "0/filter", 1e-3);
    require_value(&v, 1, 0, "0/gather", 4.25);
    require_value(&v, 3, 1, "0/gather", 4.25);
    v = (struct values){0};
    REQUIRE_OK(irb_store_read_statistics(store, trial, collect, &v, &err));
    require_value(&v, 0, 0, "uncovered_flux", NAN);
    require_value(&v, 1, 0, "vpls", 9);
    irb_store_close(store);
}

static void test_trials_are_found_again(void **state)
{
    struct irb_error err = {0};
    struct irb_store *store = open_or_fail(*state, true);
    int64_t a = irb_store_trial(store, "cornell", "rsm", "rsm", "{}", 1, &err);
    int64_t b = irb_store_trial(store, "sphere", "rsm", "rsm", "{}", 1, &err);
    int64_t c = irb_store_trial(store, "cornell", "rsm", "rsm", "{}", 2, &err);
    assert_true(a > 0 && b > 0 && c > 0 && a != b && a != c && b != c);
    assert_int_equal(irb_store_trial(store, "cornell", "rsm", "rsm", "{}", 1, &err), a);
    assert_int_equal(irb_store_trial_find(store, "sphere", "rsm", 1), b);
    assert_int_equal(irb_store_trial_find(store, "sphere", "rsm", 2), 0);
    /* a default that changed since */
    assert_int_equal(irb_store_trial(store, "cornell", "rsm", "rsm", "{\"k\":1}", 1, &err), 0);
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_non_null(strstr(err.message, "expected {\"k\":1}, found {}"));
    irb_store_close(store);
}

static void test_replacing(void **state)
{
    struct irb_error err = {0};
    int64_t trial;
    struct irb_store *store = open_or_fail(*state, true);
    fill(store, &trial);
    assert_true(irb_store_has_frame(store, trial, 1));
    assert_false(irb_store_has_frame(store, trial, 2));
    assert_true(irb_store_has_scores(store, trial, 0));
    assert_true(irb_store_has_scores(store, trial, -1));
    assert_false(irb_store_has_scores(store, trial, 1));

    const struct irb_store_value stage[] = {{"other", 2}};
    REQUIRE_OK(irb_store_frame(store, trial, 0, "gl-query", stage, 1, NULL, 0, &err));
    struct values v = {0};
    REQUIRE_OK(irb_store_read_times(store, trial, collect_time, &v, &err));
    assert_int_equal(v.count, 3);
    require_value(&v, 0, 0, "0/other", 2);
    v = (struct values){0};
    REQUIRE_OK(irb_store_read_statistics(store, trial, collect, &v, &err));
    assert_int_equal(v.count, 2); /* frame 1's */
    assert_true(irb_store_has_scores(store, trial, 0));
    irb_store_close(store);
}

/* A frame that cannot be stored whole leaves the one before it. */
static void test_all_or_nothing(void **state)
{
    struct irb_error err = {0};
    int64_t trial;
    struct irb_store *store = open_or_fail(*state, true);
    fill(store, &trial);
    const struct irb_store_value twice[] = {{"gather", 1}, {"gather", 2}};
    assert_false(irb_store_frame(store, trial, 0, "gl-query", twice, 2, NULL, 0, &err));
    assert_int_equal(err.code, IRB_E_IO);
    assert_false(irb_store_frame(store, 99, 0, "gl-query", twice, 1, NULL, 0, &err));
    assert_non_null(strstr(err.message, "FOREIGN KEY"));
    struct values v = {0};
    REQUIRE_OK(irb_store_read_times(store, trial, collect_time, &v, &err));
    assert_int_equal(v.count, 4);
    require_value(&v, 1, 0, "0/gather", 4.25);
    irb_store_close(store);
}

static void test_repeats_and_costs(void **state)
{
    struct irb_error err = {0};
    int64_t trial;
    struct irb_store *store = open_or_fail(*state, true);
    fill(store, &trial);
    const struct irb_store_value again[] = {{"gather", 5}, {"filter", NAN}};
    assert_true(irb_store_has_repeat(store, trial, 0, 1));
    assert_false(irb_store_has_repeat(store, trial, 2, 1));
    REQUIRE_OK(irb_store_repeat(store, trial, 2, 1, again, 2, &err));
    REQUIRE_OK(irb_store_repeat(store, trial, 1, 1, again, 1, &err));
    REQUIRE_OK(irb_store_repeat(store, trial, 1, 0, again, 1, &err));
    REQUIRE_OK(irb_store_repeat(store, trial, 1, 0, again, 1, &err)); /* replaces */
    assert_true(irb_store_has_repeat(store, trial, 2, 1));
    assert_false(irb_store_has_repeat(store, trial, 2, 0));
    /* of a frame that is not there */
    assert_false(irb_store_repeat(store, trial, 1, 2, again, 1, &err));
    assert_non_null(strstr(err.message, "FOREIGN KEY"));
    /* repeats outlive a frame that is rendered again */
    const struct irb_store_value stage[] = {{"other", 2}};
    REQUIRE_OK(irb_store_frame(store, trial, 0, "gl-query", stage, 1, NULL, 0, &err));
    struct values v = {0};
    REQUIRE_OK(irb_store_read_times(store, trial, collect_time, &v, &err));
    assert_int_equal(v.count, 7);
    require_value(&v, 0, 0, "0/other", 2);
    require_value(&v, 2, 1, "0/gather", 4.25);
    require_value(&v, 3, 0, "1/gather", 5);
    require_value(&v, 4, 1, "1/gather", 5);
    require_value(&v, 5, 1, "2/filter", NAN);
    require_value(&v, 6, 1, "2/gather", 5);

    REQUIRE_OK(irb_store_cost(store, trial, "settle_ms", 3, &err));
    REQUIRE_OK(irb_store_cost(store, trial, "create_ms", 8, &err));
    REQUIRE_OK(irb_store_cost(store, trial, "create_ms", 7.5, &err));
    v = (struct values){0};
    REQUIRE_OK(irb_store_read_costs(store, trial, collect, &v, &err));
    assert_int_equal(v.count, 2);
    require_value(&v, 0, -1, "create_ms", 7.5);
    require_value(&v, 1, -1, "settle_ms", 3);
    assert_false(irb_store_cost(store, 99, "create_ms", 1, &err));
    irb_store_close(store);
}

static void test_reader_beside_a_writer(void **state)
{
    struct irb_error err = {0};
    int64_t trial;
    struct irb_store *writer = open_or_fail(*state, true);
    fill(writer, &trial);
    struct irb_store *reader = open_or_fail(*state, false);
    const struct irb_store_value metric[] = {{"rmse", 7}};
    for (int frame = 1; frame < 4; frame++) {
        REQUIRE_OK(irb_store_scores(writer, trial, frame, metric, 1, &err));
        struct values v = {0};
        REQUIRE_OK(irb_store_read_scores(reader, trial, collect, &v, &err));
        assert_int_equal(v.count, 4 + frame);
        require_value(&v, 3 + frame, frame, "rmse", 7);
    }
    irb_store_close(reader);
    irb_store_close(writer);
}

/* A snapshot keeps to its moment, and keeps nobody from writing. */
static void test_snapshot_beside_a_writer(void **state)
{
    const struct fixture *f = *state;
    struct irb_error err = {0};
    int64_t trial;
    struct irb_store *writer = open_or_fail(f, true);
    fill(writer, &trial);
    struct irb_store *snapshot = irb_store_open_snapshot(f->run, &err);
    assert_non_null(snapshot);
    const struct irb_store_value metric[] = {{"rmse", 7}};
    REQUIRE_OK(irb_store_scores(writer, trial, 1, metric, 1, &err));
    REQUIRE_OK(irb_store_set_meta(writer, "later", "yes", &err));
    struct values v = {0};
    REQUIRE_OK(irb_store_read_scores(snapshot, trial, collect, &v, &err));
    assert_int_equal(v.count, 4);
    assert_null(irb_store_get_meta(snapshot, "later"));
    irb_store_close(snapshot);
    snapshot = irb_store_open_snapshot(f->run, &err);
    char *later = irb_store_get_meta(snapshot, "later");
    assert_string_equal(later, "yes");
    free(later);
    irb_store_close(snapshot);
    irb_store_close(writer);
}

/* What a killed process had stored is there for the next one. */
static void test_killed_writer(void **state)
{
    const struct fixture *f = *state;
    pid_t child = fork();
    if (child == 0) {
        struct irb_error err;
        struct irb_store *store = irb_store_open(f->run, true, &err);
        int64_t trial = irb_store_trial(store, "s", "m", "m", "{}", 1, &err);
        const struct irb_store_value metric[] = {{"rmse", 7}};
        irb_store_scores(store, trial, 0, metric, 1, &err);
        _exit(0); /* closes nothing */
    }
    int status = 0;
    waitpid(child, &status, 0);
    assert_int_equal(status, 0);
    struct irb_store *store = open_or_fail(f, true);
    struct irb_error err = {0};
    int64_t trial = irb_store_trial_find(store, "s", "m", 1);
    struct values v = {0};
    REQUIRE_OK(irb_store_read_scores(store, trial, collect, &v, &err));
    require_value(&v, 0, 0, "rmse", 7);
    irb_store_close(store);
}

static void execute(const struct fixture *f, const char *sql)
{
    sqlite3 *db;
    assert_int_equal(sqlite3_open(f->file, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

static void test_missing(void **state)
{
    const struct fixture *f = *state;
    expect_refusal(f->run, false, IRB_E_INPUT, f->file, "no results");
}

static void test_other_schema(void **state)
{
    const struct fixture *f = *state;
    irb_store_close(open_or_fail(f, true));
    execute(f, "PRAGMA user_version = 99");
    expect_refusal(f->run, false, IRB_E_INPUT, f->file, "schema version 2, found version 99");
    expect_refusal(f->run, true, IRB_E_INPUT, f->file, "schema version 2, found version 99");
}

/* A run as irbench 0.1 left it: the tables of schema 1, as they stood there. */
static const char schema_1[] =
    "PRAGMA journal_mode = WAL;"
    "CREATE TABLE meta(name TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
    "CREATE TABLE trial(id INTEGER PRIMARY KEY, scene TEXT NOT NULL, method TEXT NOT NULL,"
    " trial TEXT NOT NULL, params TEXT NOT NULL, seed INTEGER NOT NULL,"
    " UNIQUE(scene, trial, seed));"
    "CREATE TABLE frame(trial INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,"
    " frame INTEGER NOT NULL, clock TEXT NOT NULL, PRIMARY KEY(trial, frame)) WITHOUT ROWID;"
    "CREATE TABLE stage_time(trial INTEGER NOT NULL, frame INTEGER NOT NULL,"
    " stage TEXT NOT NULL, ms REAL, PRIMARY KEY(trial, frame, stage),"
    " FOREIGN KEY(trial, frame) REFERENCES frame(trial, frame) ON DELETE CASCADE) WITHOUT ROWID;"
    "CREATE TABLE statistic(trial INTEGER NOT NULL, frame INTEGER NOT NULL,"
    " name TEXT NOT NULL, value REAL, PRIMARY KEY(trial, frame, name),"
    " FOREIGN KEY(trial, frame) REFERENCES frame(trial, frame) ON DELETE CASCADE) WITHOUT ROWID;"
    "CREATE TABLE score(trial INTEGER NOT NULL REFERENCES trial(id) ON DELETE CASCADE,"
    " frame INTEGER NOT NULL, metric TEXT NOT NULL, value REAL,"
    " PRIMARY KEY(trial, frame, metric)) WITHOUT ROWID;"
    "CREATE VIEW result AS SELECT t.scene, t.trial, t.seed, s.frame, s.metric, s.value"
    " FROM score s JOIN trial t ON t.id = s.trial;"
    "PRAGMA application_id = 1769103970; PRAGMA user_version = 1;"
    "INSERT INTO meta VALUES('cpu', 'old');"
    "INSERT INTO trial VALUES(7, 'cornell', 'rsm', 'rsm', '{}', 1);"
    "INSERT INTO frame VALUES(7, 0, 'finish+clock'), (7, 1, 'finish+clock');"
    "INSERT INTO stage_time VALUES(7, 0, 'gather', 4.25), (7, 0, 'filter', NULL),"
    " (7, 1, 'gather', 5);"
    "INSERT INTO statistic VALUES(7, 1, 'vpls', 9);"
    "INSERT INTO score VALUES(7, -1, 'rmse', 0.5);";

static int user_version(const struct fixture *f)
{
    sqlite3 *db;
    sqlite3_stmt *stmt;
    assert_int_equal(sqlite3_open(f->file, &db), SQLITE_OK);
    assert_int_equal(sqlite3_prepare_v2(db, "PRAGMA user_version", -1, &stmt, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(stmt), SQLITE_ROW);
    int version = sqlite3_column_int(stmt, 0);
    sqlite3_finalize(stmt);
    sqlite3_close(db);
    return version;
}

static void require_old_contents(struct irb_store *store)
{
    struct irb_error err = {0};
    struct values v = {0};
    REQUIRE_OK(irb_store_read_times(store, 7, collect_time, &v, &err));
    assert_int_equal(v.count, 3);
    require_value(&v, 0, 0, "0/filter", NAN);
    require_value(&v, 1, 0, "0/gather", 4.25);
    require_value(&v, 2, 1, "0/gather", 5);
    v = (struct values){0};
    REQUIRE_OK(irb_store_read_statistics(store, 7, collect, &v, &err));
    require_value(&v, 0, 1, "vpls", 9);
    v = (struct values){0};
    REQUIRE_OK(irb_store_read_scores(store, 7, collect, &v, &err));
    require_value(&v, 0, -1, "rmse", 0.5);
    v = (struct values){0};
    REQUIRE_OK(irb_store_read_costs(store, 7, collect, &v, &err));
    assert_int_equal(v.count, 0);
    assert_true(irb_store_has_repeat(store, 7, 0, 1));
    assert_false(irb_store_has_repeat(store, 7, 1, 1));
}

static void make_schema_1(const struct fixture *f)
{
    irb_store_close(open_or_fail(f, true));
    unlink(f->file);
    execute(f, schema_1);
}

/* A reader sees it as it would be, and leaves it alone. */
static void test_schema_1_read(void **state)
{
    const struct fixture *f = *state;
    struct irb_error err = {0};
    make_schema_1(f);
    struct irb_store *store = open_or_fail(f, false);
    require_old_contents(store);
    const struct irb_store_value time[] = {{"gather", 6}};
    assert_false(irb_store_repeat(store, 7, 1, 0, time, 1, &err));
    irb_store_close(store);
    assert_int_equal(user_version(f), 1);
}

/* A writer converts it, once and for all. */
static void test_schema_1_converted(void **state)
{
    const struct fixture *f = *state;
    struct irb_error err = {0};
    make_schema_1(f);
    struct irb_store *store = open_or_fail(f, true);
    require_old_contents(store);
    const struct irb_store_value time[] = {{"gather", 6}};
    REQUIRE_OK(irb_store_repeat(store, 7, 1, 0, time, 1, &err));
    REQUIRE_OK(irb_store_cost(store, 7, "create_ms", 8, &err));
    assert_false(irb_store_repeat(store, 7, 1, 2, time, 1, &err)); /* the keys hold */
    irb_store_close(store);
    assert_int_equal(user_version(f), 2);

    store = open_or_fail(f, false);
    struct values v = {0};
    REQUIRE_OK(irb_store_read_times(store, 7, collect_time, &v, &err));
    assert_int_equal(v.count, 4);
    require_value(&v, 3, 0, "1/gather", 6);
    char *cpu = irb_store_get_meta(store, "cpu");
    assert_string_equal(cpu, "old");
    free(cpu);
    irb_store_close(store);
}

/* What cannot be converted stays what it was. */
static void test_schema_1_whole_or_not(void **state)
{
    const struct fixture *f = *state;
    make_schema_1(f);
    execute(f, "CREATE TABLE cost(of_something_else)");
    expect_refusal(f->run, true, IRB_E_IO, f->file, "cannot convert the tables");
    assert_int_equal(user_version(f), 1);
    struct irb_store *store = open_or_fail(f, false);
    require_old_contents(store);
    irb_store_close(store);
}

static void test_other_database(void **state)
{
    const struct fixture *f = *state;
    irb_store_close(open_or_fail(f, true));
    unlink(f->file);
    execute(f, "CREATE TABLE recipe(name)");
    expect_refusal(f->run, true, IRB_E_INPUT, f->file, "a database of something else");
    expect_refusal(f->run, false, IRB_E_INPUT, f->file, "a database of something else");
}

static void write_file(const char *path, const char *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static void test_no_database(void **state)
{
    const struct fixture *f = *state;
    irb_store_close(open_or_fail(f, true));
    static const char text[] = "This is no database but long enough to be looked at in earnest, "
                               "since shorter files than one header count as empty. 0123456789";
    write_file(f->file, text, sizeof text);
    expect_refusal(f->run, true, IRB_E_INPUT, f->file, "not a database");
    expect_refusal(f->run, false, IRB_E_INPUT, f->file, "not a database");
    write_file(f->file, "", 0);
    expect_refusal(f->run, false, IRB_E_INPUT, f->file, "an empty file");
}

static void test_truncated(void **state)
{
    const struct fixture *f = *state;
    int64_t trial;
    struct irb_store *store = open_or_fail(f, true);
    fill(store, &trial);
    irb_store_close(store);
    struct stat info;
    assert_int_equal(stat(f->file, &info), 0);
    for (off_t size = info.st_size - 4096; size > 0; size -= 4096) {
        assert_int_equal(truncate(f->file, size), 0);
        expect_refusal(f->run, false, IRB_E_INPUT, f->file, "damaged");
        expect_refusal(f->run, true, IRB_E_INPUT, f->file, "damaged");
    }
    assert_int_equal(truncate(f->file, 100), 0);
    expect_refusal(f->run, false, IRB_E_INPUT, f->file, "");
}

static void test_unwritable(void **state)
{
    const struct fixture *f = *state;
    char below[128], path[160];
    snprintf(below, sizeof below, "%s/file", f->dir);
    write_file(below, "x", 1);
    snprintf(path, sizeof path, "%s/run", below);
    expect_refusal(path, true, IRB_E_IO, below, "");
    /* a folder where the database should be */
    irb_store_close(open_or_fail(f, true));
    unlink(f->file);
    assert_int_equal(mkdir(f->file, 0777), 0);
    expect_refusal(f->run, true, IRB_E_IO, f->file, "cannot open");
    rmdir(f->file);
}

int main(void)
{
#define CASE(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        CASE(test_round_trip),
        CASE(test_trials_are_found_again),
        CASE(test_replacing),
        CASE(test_all_or_nothing),
        CASE(test_repeats_and_costs),
        CASE(test_reader_beside_a_writer),
        CASE(test_snapshot_beside_a_writer),
        CASE(test_killed_writer),
        CASE(test_missing),
        CASE(test_other_schema),
        CASE(test_schema_1_read),
        CASE(test_schema_1_converted),
        CASE(test_schema_1_whole_or_not),
        CASE(test_other_database),
        CASE(test_no_database),
        CASE(test_truncated),
        CASE(test_unwritable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
