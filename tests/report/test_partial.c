/* SPDX-License-Identifier: MIT
 *
 * Tables of runs that are not finished.
 */
#include "core/base/clock.h"
#include "core/report/analysis.h"
#include "core/report/table.h"
#include "tests/support/compare.h"

#include "tests/report/json.h"

#include <stdlib.h>
#include <string.h>

static char folder[] = "/tmp/irb_partial_XXXXXX";

/* Frames `first` to `last` of 4, in ms, and the RMSE of those that are scored. */
static bool add(struct irb_store *store, int64_t trial, int rendered, int scored, double ms,
                struct irb_error *err)
{
    bool ok = trial > 0;
    for (int f = 0; ok && f < rendered; f++)
        ok = irb_store_frame(store, trial, f, "clock", &(struct irb_store_value){"gather", ms}, 1,
                             NULL, 0, err);
    for (int f = 0; ok && f < scored; f++) {
        const struct irb_store_value scores[] = {{"indirect_rmse", f ? 4 : 3},
                                                 {"indirect_bias", f ? 1 : 3},
                                                 {"indirect_energy_ratio", 77},
                                                 {"indirect_psnr", 77},
                                                 {"non_finite", 2}};
        ok = irb_store_scores(store, trial, f, scores, 5, err);
    }
    return ok;
}

static bool whole(struct irb_store *store, int64_t trial, double rmse, struct irb_error *err)
{
    const struct irb_store_value scores[] = {{"indirect_rmse", rmse}};
    return irb_store_scores(store, trial, -1, scores, 1, err);
}

/*  a  seed 1: 2 of 4 frames scored
 *  b  seed 1 and 2: whole; 3: 3 frames rendered; 4: nothing
 *  c  seed 1: all frames rendered, none scored; 2: one frame rendered */
static int set_up(void **state)
{
    struct irb_error err = {0};
    struct irb_store *store = mkdtemp(folder) ? irb_store_open(folder, true, &err) : NULL;
    *state = store;
    if (!store)
        return -1;
    int64_t b[4], c[2], a = irb_store_trial(store, "box", "m", "a", "{}", 1, &err);
    for (int i = 0; i < 4; i++)
        b[i] = irb_store_trial(store, "box", "m", "b", "{}", i + 1, &err);
    for (int i = 0; i < 2; i++)
        c[i] = irb_store_trial(store, "box", "m", "c", "{}", i + 1, &err);
    bool ok = irb_store_set_meta(store, "scene/box/keys", "x y\nx y\nx y\nx y\n", &err) &&
              irb_store_set_meta(store, "scene/box/mean_indirect", "8", &err) &&
              irb_store_set_meta(store, "scene/box/psnr_peak_indirect", "10", &err) &&
              add(store, a, 4, 2, 5, &err) && add(store, b[0], 4, 4, 6, &err) &&
              add(store, b[1], 4, 4, 8, &err) && add(store, b[2], 3, 0, 100, &err) &&
              whole(store, b[0], 1, &err) && whole(store, b[1], 2, &err) &&
              add(store, c[0], 4, 0, 9, &err) && add(store, c[1], 1, 0, 50, &err);
    return ok ? 0 : -1;
}

static int tear_down(void **state)
{
    irb_store_close(*state);
    char command[64];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

static char *write_table(struct irb_store *store, enum irb_table_format format, bool per_seed)
{
    struct irb_error err = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    const struct irb_table_options options = {.format = format, .per_seed = per_seed};
    REQUIRE_OK(irb_table_write(out, store, &options, &err));
    fclose(out);
    return text;
}

static void expect_member(const char *row, const char *name, double expected)
{
    char value[64];
    assert_true(json_member(row, name, value, sizeof value));
    if (isnan(expected))
        assert_string_equal(value, "null");
    else
        REQUIRE_NEAR(strtod(value, NULL), expected, 1e-5 * fabs(expected));
}

static void test_rows(void **state)
{
    char *text = write_table(*state, IRB_TABLE_JSON, false), row[8192];
    /* of two frames: sqrt((9 + 16) / 2); 1 + 2 / 8; 20 log10(10 / that) */
    assert_true(json_item(text, 0, row, sizeof row));
    expect_member(row, "indirect_rmse", sqrt(12.5));
    expect_member(row, "indirect_energy_ratio", 1.25);
    expect_member(row, "indirect_psnr", 20 * log10(10 / sqrt(12.5)));
    expect_member(row, "non_finite", 4);
    expect_member(row, "frame_ms", 5);
    /* of the whole seeds alone */
    assert_true(json_item(text, 1, row, sizeof row));
    expect_member(row, "seeds", 2);
    expect_member(row, "indirect_rmse", 1.5);
    expect_member(row, "frame_ms", 7);
    assert_true(json_item(text, 2, row, sizeof row));
    expect_member(row, "seeds", 1);
    expect_member(row, "indirect_rmse", NAN);
    expect_member(row, "frame_ms", 9);
    assert_false(json_item(text, 3, row, sizeof row));
    free(text);
}

/* Of a black scene there is no ratio to the reference. */
static void test_black(void **state)
{
    struct irb_error err = {0};
    char *text, row[8192];
    REQUIRE_OK(irb_store_set_meta(*state, "scene/box/mean_indirect", "0", &err));
    REQUIRE_OK(irb_store_set_meta(*state, "scene/box/psnr_peak_indirect", "0", &err));
    text = write_table(*state, IRB_TABLE_JSON, false);
    assert_true(json_item(text, 0, row, sizeof row));
    expect_member(row, "indirect_rmse", sqrt(12.5));
    expect_member(row, "indirect_energy_ratio", NAN);
    expect_member(row, "indirect_psnr", NAN);
    free(text);
    REQUIRE_OK(irb_store_set_meta(*state, "scene/box/mean_indirect", "8", &err));
    REQUIRE_OK(irb_store_set_meta(*state, "scene/box/psnr_peak_indirect", "10", &err));
}

static void test_names(void **state)
{
    char *text = write_table(*state, IRB_TABLE_TEXT, false);
    assert_non_null(strstr(text, "\n  a (2 of 4 frames) "));
    assert_non_null(strstr(text, "\n  b  "));
    assert_non_null(strstr(text, "\n  c  "));
    free(text);
    text = write_table(*state, IRB_TABLE_MD, true);
    assert_non_null(strstr(text, "| b seed 2  "));
    assert_non_null(strstr(text, "| b seed 3 (3 of 4 frames) |"));
    assert_non_null(strstr(text, "| b seed 4 (0 of 4 frames) |"));
    assert_non_null(strstr(text, "| c seed 2 (1 of 4 frames) |"));
    free(text);
}

/* a, the fastest so far, has half of the frames that b and c have: it is shown, and no more. */
static void test_not_ranked(void **state)
{
    struct irb_error err = {0};
    struct irb_analysis analysis;
    char *text = write_table(*state, IRB_TABLE_TEXT, false);
    assert_non_null(strstr(text, " 5.00  "));
    assert_non_null(strstr(text, " 7.00*"));
    free(text);
    REQUIRE_OK(irb_analysis_read(&analysis, *state, IRB_CONFIDENCE, &err));
    const struct irb_analysis_scene *box = &analysis.scenes[0];
    int a = irb_analysis_trial_find(box, "a"), b = irb_analysis_trial_find(box, "b"),
        c = irb_analysis_trial_find(box, "c");
    assert_true(box->trials[a].partial && !box->trials[b].partial && !box->trials[c].partial);
    assert_int_equal(box->trials[a].frames, 2);
    REQUIRE_NEAR(box->trials[a].measures[IRB_METRIC_frame_ms].interval.value, 5, 0);
    assert_true(isnan(irb_analysis_ratio(&analysis, 0, a, b, IRB_METRIC_frame_ms).interval.value));
    assert_int_equal(irb_analysis_compare(&analysis, 0, b, a, IRB_METRIC_indirect_rmse),
                     IRB_VERDICT_UNKNOWN);
    /* of the seed that both have */
    REQUIRE_REL(irb_analysis_ratio(&analysis, 0, b, c, IRB_METRIC_frame_ms).interval.value, 6. / 9,
                1e-12);
    irb_analysis_destroy(&analysis);
}

static void expect_first(struct irb_store *store, const char *progress, const char *line)
{
    struct irb_error err = {0};
    static const char *const before[] = {"", "", "", "", "% "};
    char now[32];
    irb_clock_utc(now);
    char *json = NULL;
    assert_true(asprintf(&json, progress, now) > 0);
    REQUIRE_OK(irb_store_set_meta(store, "progress", json, &err));
    for (int format = IRB_TABLE_TEXT; format <= IRB_TABLE_LATEX; format++) {
        char *text = write_table(store, (enum irb_table_format)format, false), *expected = NULL;
        bool people = format != IRB_TABLE_CSV && format != IRB_TABLE_JSON;
        assert_true(asprintf(&expected, "%s%s", before[format], line) >= 0);
        size_t length = strlen(expected);
        bool there = *line && !strncmp(text, expected, length) && text[length] == '\n';
        if (there != (people && *line))
            fail_msg("format %d begins with\n%.120s\nnot with\n%s", format, text, expected);
        free(expected);
        free(text);
    }
    free(json);
}

static void test_first_line(void **state)
{
    expect_first(*state,
                 "{\"fraction\": 0.4387, \"left_s\": 730, \"what\": \"render hall, seed 2 of 5\", "
                 "\"at\": \"%s\", \"state\": \"running\"}",
                 "running: 43 %, about 12 min left (render hall, seed 2 of 5)");
    expect_first(*state,
                 "{\"fraction\": 0.9999, \"left_s\": 3, \"what\": \"score hall\", \"at\": \"%s\", "
                 "\"state\": \"running\"}",
                 "running: 99 %, less than a minute left (score hall)");
    expect_first(*state,
                 "{\"fraction\": 0.5000, \"left_s\": 9000, \"what\": \"score hall\", \"at\": "
                 "\"%s\", \"state\": \"stopped\"}",
                 "not finished: 50 % (score hall)");
    expect_first(*state,
                 "{\"fraction\": 0.5000, \"left_s\": 9000, \"what\": \"score hall\", \"at\": "
                 "\"2026-01-31T12:00:00Z\", \"state\": \"running\", \"now\": \"%s\"}",
                 "not finished: 50 % (score hall; last heard of at 2026-01-31T12:00:00Z)");
    expect_first(*state,
                 "{\"fraction\": 1.0000, \"left_s\": 0, \"what\": \"render hall\", \"at\": \"%s\", "
                 "\"state\": \"stopped\"}",
                 "not finished: stages or trials are left (render hall)");
    expect_first(*state, "done", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_black),
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_not_ranked),
        cmocka_unit_test(test_first_line),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
