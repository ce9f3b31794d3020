/* SPDX-License-Identifier: MIT
 *
 * Messages as lines for people and as JSON lines for programs.
 */
#include "core/base/log.h"
#include "tests/support/compare.h"

#include "tests/report/json.h"

#include <stdlib.h>
#include <string.h>

/* A log into memory. */
struct recorded {
    struct irb_log log;
    char *text;
    size_t size;
};

static void begin(struct recorded *r, bool json, enum irb_log_level level)
{
    *r = (struct recorded){0};
    r->log = (struct irb_log){.level = level, .json = json};
    r->log.out = open_memstream(&r->text, &r->size);
    assert_non_null(r->log.out);
}

static void expect_all(struct recorded *r, const char *text)
{
    fclose(r->log.out);
    if (strcmp(r->text, text))
        fail_msg("found    %s\nexpected %s", r->text, text);
    free(r->text);
}

static void everything(struct irb_log *log)
{
    static const struct irb_error err = {IRB_E_INPUT, "a.yaml:3:1: expected \"b\""};
    irb_debug(log, "detail %d", 1);
    irb_info(log, "two");
    irb_warn(log, "a \\ and a\ttab");
    irb_log_error(log, &err);
    irb_log_done(log, "runs/x");
    irb_log_done(log, NULL);
}

static void test_people(void **state)
{
    (void)state;
    struct recorded r;
    begin(&r, false, IRB_LOG_INFO);
    everything(&r.log);
    expect_all(&r, "two\nwarning: a \\ and a\ttab\nerror: a.yaml:3:1: expected \"b\"\n"
                   "results: runs/x\n");
}

static void test_programs(void **state)
{
    (void)state;
    struct recorded r;
    begin(&r, true, IRB_LOG_DEBUG);
    everything(&r.log);
    fflush(r.log.out);
    int lines = 0;
    char *copy = strdup(r.text);
    for (char *line = strtok(copy, "\n"); line; line = strtok(NULL, "\n"), lines++)
        if (!json_valid(line))
            fail_msg("not JSON: %s", line);
    free(copy);
    assert_int_equal(lines, 6);
    expect_all(&r, "{\"event\": \"debug\", \"message\": \"detail 1\"}\n"
                   "{\"event\": \"info\", \"message\": \"two\"}\n"
                   "{\"event\": \"warning\", \"message\": \"a \\\\ and a\\u0009tab\"}\n"
                   "{\"event\": \"error\", \"code\": \"INPUT\", \"message\": "
                   "\"a.yaml:3:1: expected \\\"b\\\"\"}\n"
                   "{\"event\": \"done\", \"run\": \"runs/x\"}\n"
                   "{\"event\": \"done\", \"run\": null}\n");
}

/* Quiet leaves what a program has to know: how it ended. */
static void test_quiet(void **state)
{
    (void)state;
    struct recorded r;
    begin(&r, true, IRB_LOG_ERROR);
    everything(&r.log);
    irb_log_progress(&r.log, "render", 1, 2);
    expect_all(&r, "{\"event\": \"error\", \"code\": \"INPUT\", \"message\": "
                   "\"a.yaml:3:1: expected \\\"b\\\"\"}\n"
                   "{\"event\": \"done\", \"run\": \"runs/x\"}\n"
                   "{\"event\": \"done\", \"run\": null}\n");
    irb_log_progress(NULL, "render", 1, 2);
    irb_log_done(NULL, "x");
    irb_log_error(NULL, &(struct irb_error){0});
}

static void test_progress(void **state)
{
    (void)state;
    struct recorded r;
    begin(&r, true, IRB_LOG_INFO);
    irb_log_progress(&r.log, "render", 0.25, 4);
    irb_log_progress(&r.log, "render", 0.5, 8); /* too soon for another line */
    irb_log_progress(&r.log, "render", 1, 16);  /* but the last one is always there */
    irb_log_progress(&r.log, "score", 1, 0);
    r.log.last_progress_s = 0;
    irb_log_progress(&r.log, "score", 0, 0); /* nobody knows how long it takes */
    irb_log_progress_done(&r.log);
    expect_all(
        &r,
        "{\"event\": \"progress\", \"what\": \"render\", \"fraction\": 0.2500, \"left_s\": 12}\n"
        "{\"event\": \"progress\", \"what\": \"render\", \"fraction\": 1.0000, \"left_s\": 0}\n"
        "{\"event\": \"progress\", \"what\": \"score\", \"fraction\": 1.0000, \"left_s\": 0}\n"
        "{\"event\": \"progress\", \"what\": \"score\", \"fraction\": 0.0000, \"left_s\": null}\n");
}

static void add_up(void *sum, double fraction)
{
    *(double *)sum += fraction;
}

/* Of a whole run, behind the part's; and somebody who is told all. */
static void test_run_progress(void **state)
{
    (void)state;
    struct recorded r;
    double sum = 0;
    begin(&r, true, IRB_LOG_INFO);
    r.log.run = (struct irb_log_run){.known = true, .fraction = 0.125, .left_s = 75};
    r.log.watch = add_up;
    r.log.watcher = &sum;
    irb_log_progress(&r.log, "score", 1, 0);
    irb_log_progress(&r.log, "score", 0.5, 1); /* too soon to be shown */
    expect_all(
        &r, "{\"event\": \"progress\", \"what\": \"score\", \"fraction\": 1.0000, \"left_s\": 0, "
            "\"run_fraction\": 0.1250, \"run_left_s\": 75}\n");
    begin(&r, false, IRB_LOG_INFO);
    r.log.run = (struct irb_log_run){.known = true, .fraction = 0.125, .left_s = 75};
    irb_log_progress(&r.log, "score", 0.5, 7);
    expect_all(&r, "score  50 %  0:07 left   run  12 %  1:15 left\n");
    begin(&r, false, IRB_LOG_ERROR);
    r.log.watch = add_up;
    r.log.watcher = &sum;
    irb_log_progress(&r.log, "score", 0.25, 7); /* is quiet */
    expect_all(&r, "");
    REQUIRE_NEAR(sum, 1.75, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_people),       cmocka_unit_test(test_programs),
        cmocka_unit_test(test_quiet),        cmocka_unit_test(test_progress),
        cmocka_unit_test(test_run_progress),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
