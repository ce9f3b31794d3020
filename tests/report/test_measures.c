/* SPDX-License-Identifier: MIT
 *
 * Tables of stages, statistics and frames: whole texts of a run that nobody rendered.
 */
#include "core/report/table.h"
#include "tests/support/compare.h"

#include "tests/report/json.h"

#include <stdlib.h>
#include <string.h>

static char folder[] = "/tmp/irb_measures_XXXXXX";

static bool add_frame(struct irb_store *store, int64_t trial, int frame, double warp, double light,
                      double clusters, struct irb_error *err)
{
    const struct irb_store_value stages[] = {
        {"gbuffer", 1}, {"warp", warp}, {"light", light}, {"average", 0}};
    const struct irb_store_value statistics[] = {{"clusters", clusters}, {"uncovered_flux", NAN}};
    return irb_store_frame(store, trial, frame, "clock", stages, 4, statistics, 2, err);
}

/* Trials of two methods in turn, one of them with two seeds; a settle frame that does not count.
 *
 *   trial    seed  warp of frames 0, 1, 2   light    clusters
 *   acrsm:k=1  1   2, 4, 9                  10       16, 32, 48
 *   acrsm:k=1  2   4, 6, 8                  20       16, 16, none
 *   acrsm      1   1 (only frame 1)         2        7
 *   rsm        1   gather 5 in frame 0 */
static bool fill(struct irb_store *store, struct irb_error *err)
{
    static const double warp[][3] = {{2, 4, 9}, {4, 6, 8}};
    static const double clusters[][3] = {{16, 32, 48}, {16, 16, NAN}};
    int64_t one[2], two, rsm;
    one[0] = irb_store_trial(store, "box", "acrsm", "acrsm:k=1", "{\"k\": \"1@0+2@1\"}", 1, err);
    rsm = irb_store_trial(store, "box", "rsm", "rsm", "{}", 1, err);
    one[1] = irb_store_trial(store, "box", "acrsm", "acrsm:k=1", "{\"k\": \"1@0+2@1\"}", 2, err);
    two = irb_store_trial(store, "box", "acrsm", "acrsm", "{\"k\": 4}", 1, err);
    bool ok =
        one[0] && one[1] && two && rsm &&
        irb_store_set_meta(store, "method/acrsm/stages",
                           "gbuffer\nrsm\ndirect\nwarp\naverage\nlight\n", err) &&
        irb_store_set_meta(store, "method/rsm/stages", "gbuffer\nrsm\ndirect\ngather\n", err) &&
        add_frame(store, one[0], -1, 500, 500, 500, err) && add_frame(store, two, 1, 1, 2, 7, err);
    for (int seed = 0; ok && seed < 2; seed++)
        for (int f = 0; ok && f < 3; f++)
            ok = add_frame(store, one[seed], f, warp[seed][f], 10 + 10 * seed, clusters[seed][f],
                           err);
    const struct irb_store_value gather = {"gather", 5};
    const struct irb_store_value scores[] = {
        {"indirect_rmse", 0.5}, {"full_flip@door", 0.25}, {"lag_error@3", 1}, {"claim_rmse", NAN}};
    return ok && irb_store_frame(store, rsm, 0, "clock", &gather, 1, NULL, 0, err) &&
           irb_store_scores(store, one[0], 2, scores, 4, err) &&
           irb_store_scores(store, one[0], -1, scores, 2, err);
}

static int set_up(void **state)
{
    struct irb_error err = {0};
    struct irb_store *store = mkdtemp(folder) ? irb_store_open(folder, true, &err) : NULL;
    *state = store;
    return store && fill(store, &err) ? 0 : -1;
}

static int tear_down(void **state)
{
    irb_store_close(*state);
    char command[64];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

static char *write_table(struct irb_store *store, enum irb_table_subject subject,
                         enum irb_table_format format, bool per_seed)
{
    struct irb_error err = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    const struct irb_table_options options = {
        .format = format, .subject = subject, .per_seed = per_seed};
    REQUIRE_OK(irb_table_write(out, store, &options, &err));
    fclose(out);
    return text;
}

static void expect_text(struct irb_store *store, enum irb_table_subject subject,
                        enum irb_table_format format, bool per_seed, const char *expected)
{
    char *text = write_table(store, subject, format, per_seed);
    if (strcmp(text, expected))
        fail_msg("found\n%s\nexpected\n%s", text, expected);
    free(text);
}

/* Frames of acrsm:k=1 take 1 + 2 + 10, 1 + 4 + 10 and 1 + 9 + 10 ms: median 15; 25, 27 and 29 with
 * the other seed: 27. Their mean is 21; of the medians of warp, 4 and 6, it is 5. */
static void test_stages(void **state)
{
    expect_text(*state, IRB_TABLE_STAGES, IRB_TABLE_TEXT, false,
                "box, acrsm   median times, ms\n"
                "  trial      gbuffer  warp  average  light  frame\n"
                "  acrsm:k=1     1.00  5.00        0   15.0   21.0\n"
                "  acrsm         1.00  1.00        0   2.00   4.00\n"
                "\n"
                "box, rsm   median times, ms\n"
                "  trial  gather  frame\n"
                "  rsm      5.00   5.00\n"
                "\n"
                "Medians over the frames; that of the whole frame is not their sum.\n"
                "Means over 2 seeds.\n"
                "times: clock\n");
    expect_text(
        *state, IRB_TABLE_STAGES, IRB_TABLE_CSV, false,
        "scene,method,trial,params,seed,seeds,stage_gbuffer_ms,stage_rsm_ms,stage_direct_ms,"
        "stage_warp_ms,stage_average_ms,stage_light_ms,stage_gather_ms,frame_ms\n"
        "box,acrsm,acrsm:k=1,k=1@0+2@1,,2,1,,,5,0,15,,21\n"
        "box,rsm,rsm,,1,1,,,,,,,5,5\n"
        "box,acrsm,acrsm,k=4,1,1,1,,,1,0,2,,4\n");
    expect_text(*state, IRB_TABLE_STAGES, IRB_TABLE_MD, true,
                "### box, acrsm\n\n"
                "| trial            | gbuffer | warp | average | light | frame |\n"
                "|:-----------------|--------:|-----:|--------:|------:|------:|\n"
                "| acrsm:k=1 seed 1 |    1.00 | 4.00 |       0 |  10.0 |  15.0 |\n"
                "| acrsm:k=1 seed 2 |    1.00 | 6.00 |       0 |  20.0 |  27.0 |\n"
                "| acrsm            |    1.00 | 1.00 |       0 |  2.00 |  4.00 |\n\n"
                "median times, ms\n\n"
                "### box, rsm\n\n"
                "| trial | gather | frame |\n"
                "|:------|-------:|------:|\n"
                "| rsm   |   5.00 |  5.00 |\n\n"
                "median times, ms\n\n"
                "Medians over the frames; that of the whole frame is not their sum.\n"
                "times: clock\n");
    expect_text(*state, IRB_TABLE_STAGES, IRB_TABLE_LATEX, false,
                "% needs \\usepackage{booktabs} and \\usepackage[T1]{fontenc}\n"
                "\\begin{table}\n"
                "  \\centering\n"
                "  \\caption{box, acrsm: median times, ms.}\n"
                "  \\begin{tabular}{lrrrrr}\n"
                "    \\toprule\n"
                "    trial & gbuffer & warp & average & light & frame \\\\\n"
                "    \\midrule\n"
                "    acrsm:k=1 & $1.00$ & $5.00$ & $0$ & $15.0$ & $21.0$ \\\\\n"
                "    acrsm & $1.00$ & $1.00$ & $0$ & $2.00$ & $4.00$ \\\\\n"
                "    \\bottomrule\n"
                "  \\end{tabular}\n"
                "\\end{table}\n"
                "\\begin{table}\n"
                "  \\centering\n"
                "  \\caption{box, rsm: median times, ms.}\n"
                "  \\begin{tabular}{lrr}\n"
                "    \\toprule\n"
                "    trial & gather & frame \\\\\n"
                "    \\midrule\n"
                "    rsm & $5.00$ & $5.00$ \\\\\n"
                "    \\bottomrule\n"
                "  \\end{tabular}\n"
                "\\end{table}\n"
                "% Medians over the frames; that of the whole frame is not their sum.\n"
                "% Means over 2 seeds.\n"
                "% times: clock\n");
}

/* Means of 16, 32, 48 and of 16, 16: 32 and 16, whose mean is 24. There is no table of
 * a method without any, and uncovered_flux is nowhere. */
static void test_statistics(void **state)
{
    expect_text(*state, IRB_TABLE_STATISTICS, IRB_TABLE_TEXT, false,
                "box, acrsm   means over the frames\n"
                "  trial      clusters\n"
                "  acrsm:k=1      24.0\n"
                "  acrsm          7.00\n"
                "\n"
                "Means over 2 seeds.\n"
                "times: clock\n");
    expect_text(*state, IRB_TABLE_STATISTICS, IRB_TABLE_CSV, true,
                "scene,method,trial,params,seed,seeds,statistic_clusters\n"
                "box,acrsm,acrsm:k=1,k=1@0+2@1,1,1,32\n"
                "box,rsm,rsm,,1,1,\n"
                "box,acrsm,acrsm:k=1,k=1@0+2@1,2,1,16\n"
                "box,acrsm,acrsm,k=4,1,1,7\n");
    char *text = write_table(*state, IRB_TABLE_STATISTICS, IRB_TABLE_JSON, false);
    assert_string_equal(
        text,
        "[\n {\"scene\": \"box\", \"method\": \"acrsm\", \"trial\": \"acrsm:k=1\", \"params\": "
        "{\"k\": \"1@0+2@1\"}, \"seed\": null, \"seeds\": 2, \"statistic_clusters\": 24},\n "
        "{\"scene\": \"box\", \"method\": \"rsm\", \"trial\": \"rsm\", \"params\": {}, \"seed\": "
        "1, "
        "\"seeds\": 1, \"statistic_clusters\": null},\n {\"scene\": \"box\", \"method\": "
        "\"acrsm\", \"trial\": \"acrsm\", \"params\": {\"k\": 4}, \"seed\": 1, \"seeds\": 1, "
        "\"statistic_clusters\": 7}\n]\n");
    free(text);
    static const enum irb_table_subject subjects[] = {IRB_TABLE_STAGES, IRB_TABLE_STATISTICS,
                                                      IRB_TABLE_FRAMES};
    for (int i = 0; i < 3; i++) {
        text = write_table(*state, subjects[i], IRB_TABLE_JSON, false);
        assert_true(json_valid(text));
        free(text);
    }
}

/* One row a frame and seed, columns that any frame has a value for. */
static void test_frames(void **state)
{
    expect_text(*state, IRB_TABLE_FRAMES, IRB_TABLE_CSV, false,
                "scene,method,trial,seed,frame,indirect_rmse,frame_ms,full_flip@door,"
                "stage_gbuffer_ms,stage_rsm_ms,stage_direct_ms,stage_warp_ms,stage_average_ms,"
                "stage_light_ms,stage_gather_ms,statistic_clusters\n"
                "box,acrsm,acrsm:k=1,1,0,,13,,1,,,2,0,10,,16\n"
                "box,acrsm,acrsm:k=1,1,1,,15,,1,,,4,0,10,,32\n"
                "box,acrsm,acrsm:k=1,1,2,0.5,20,0.25,1,,,9,0,10,,48\n"
                "box,rsm,rsm,1,0,,5,,,,,,,,5,\n"
                "box,acrsm,acrsm:k=1,2,0,,25,,1,,,4,0,20,,16\n"
                "box,acrsm,acrsm:k=1,2,1,,27,,1,,,6,0,20,,16\n"
                "box,acrsm,acrsm:k=1,2,2,,29,,1,,,8,0,20,,\n"
                "box,acrsm,acrsm,1,1,,4,,1,,,1,0,2,,7\n");
    char *text = write_table(*state, IRB_TABLE_FRAMES, IRB_TABLE_JSON, false), row[1024], value[64];
    assert_true(json_item(text, 2, row, sizeof row));
    assert_true(json_member(row, "full_flip@door", value, sizeof value));
    assert_string_equal(value, "0.25");
    assert_true(json_member(row, "stage_gather_ms", value, sizeof value));
    assert_string_equal(value, "null");
    assert_false(json_item(text, 8, row, sizeof row));
    free(text);
}

static void test_frames_for_people(void **state)
{
    static const enum irb_table_format formats[] = {IRB_TABLE_TEXT, IRB_TABLE_MD, IRB_TABLE_LATEX};
    for (int i = 0; i < 3; i++) {
        struct irb_error err = {0};
        const struct irb_table_options options = {.format = formats[i],
                                                  .subject = IRB_TABLE_FRAMES};
        assert_false(irb_table_write(stdout, *state, &options, &err));
        assert_int_equal(err.code, IRB_E_USAGE);
        char *expected = NULL;
        assert_true(asprintf(&expected, "format: frames are printed as csv or json, not as %s",
                             irb_table_format_names[formats[i]]) > 0);
        assert_string_equal(err.message, expected);
        free(expected);
    }
}

/* Two frames, rendered twice: 2 + 1 and 4 + 1, then 6 + 1 and 20 + 1 ms. All four times are the
 * trial's: median 6, mean 9; those of a frame are means over its repeats. */
static void test_repeats(void **state)
{
    (void)state;
    static const double gather[2][2] = {{2, 4}, {6, 20}};
    struct irb_error err = {0};
    char repeats[64], row[4096], value[64];
    snprintf(repeats, sizeof repeats, "%s/repeats", folder);
    struct irb_store *store = irb_store_open(repeats, true, &err);
    assert_non_null(store);
    int64_t trial = irb_store_trial(store, "box", "rsm", "rsm", "{}", 1, &err);
    for (int repeat = 0; repeat < 2; repeat++)
        for (int frame = 0; frame < 2; frame++) {
            const struct irb_store_value stages[] = {{"gather", gather[repeat][frame]},
                                                     {"filter", 1}};
            REQUIRE_OK(
                repeat ? irb_store_repeat(store, trial, repeat, frame, stages, 2, &err)
                       : irb_store_frame(store, trial, frame, "clock", stages, 2, NULL, 0, &err));
        }
    REQUIRE_OK(irb_store_cost(store, trial, "create_ms", 125, &err));
    REQUIRE_OK(irb_store_cost(store, trial, "settle_ms", 7, &err));
    expect_text(store, IRB_TABLE_FRAMES, IRB_TABLE_CSV, false,
                "scene,method,trial,seed,frame,frame_ms,stage_filter_ms,stage_gather_ms\n"
                "box,rsm,rsm,1,0,5,1,4\n"
                "box,rsm,rsm,1,1,13,1,12\n");
    expect_text(store, IRB_TABLE_STAGES, IRB_TABLE_CSV, false,
                "scene,method,trial,params,seed,seeds,stage_filter_ms,stage_gather_ms,frame_ms\n"
                "box,rsm,rsm,,1,1,1,5,6\n");
    static const char *const expected[][2] = {{"frame_ms", "6"},
                                              {"frame_ms_mean", "9"},
                                              {"frame_ms_p95", "21"},
                                              {"frame_ms_worst", "21"},
                                              {"precompute_ms", "125"}};
    char *text = write_table(store, IRB_TABLE_SCORES, IRB_TABLE_JSON, false);
    assert_true(json_item(text, 0, row, sizeof row));
    for (int i = 0; i < 5; i++) {
        assert_true(json_member(row, expected[i][0], value, sizeof value));
        assert_string_equal(value, expected[i][1]);
    }
    free(text);
    irb_store_close(store);
}

static void test_no_trials(void **state)
{
    (void)state;
    struct irb_error err = {0};
    char empty[64];
    snprintf(empty, sizeof empty, "%s/empty", folder);
    struct irb_store *store = irb_store_open(empty, true, &err);
    assert_non_null(store);
    static const enum irb_table_subject subjects[] = {IRB_TABLE_STAGES, IRB_TABLE_STATISTICS};
    for (int i = 0; i < 2; i++) {
        expect_text(store, subjects[i], IRB_TABLE_TEXT, false, "no trials yet\n");
        expect_text(store, subjects[i], IRB_TABLE_MD, false, "no trials yet\n");
        expect_text(store, subjects[i], IRB_TABLE_JSON, false, "[]\n");
        expect_text(store, subjects[i], IRB_TABLE_LATEX, false,
                    "% needs \\usepackage{booktabs} and \\usepackage[T1]{fontenc}\n"
                    "% no trials yet\n");
    }
    expect_text(store, IRB_TABLE_FRAMES, IRB_TABLE_JSON, false, "[]\n");
    expect_text(store, IRB_TABLE_FRAMES, IRB_TABLE_CSV, false, "scene,method,trial,seed,frame\n");
    irb_store_close(store);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_stages),    cmocka_unit_test(test_statistics),
        cmocka_unit_test(test_frames),    cmocka_unit_test(test_frames_for_people),
        cmocka_unit_test(test_no_trials), cmocka_unit_test(test_repeats),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
