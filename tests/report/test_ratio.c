/* SPDX-License-Identifier: MIT
 *
 * The marks of what is not distinguishable, intervals in the complete tables, and the table of
 * ratios, from a run whose numbers the test writes.
 */
#include "core/report/table.h"
#include "core/stats/interval.h"
#include "tests/report/json.h"
#include "tests/report/trials.h"

static char folder[] = "/tmp/irb_ratio_XXXXXX";
enum { SEEDS = 3 };

/* FLIP of good and near differ by less than from seed to seed, bad is far off and lone has one
 * seed; relMSE of quiet is below the noise. Scene "other" has no trial good. */
static const double of_good[] = {0.10, 0.11, 0.12}, of_near[] = {0.112, 0.108, 0.119},
                    of_bad[] = {0.2, 0.23, 0.25}, good_relmse[] = {0.02, 0.021, 0.019},
                    good_ms[] = {5, 5.1, 5.2}, near_ms[] = {4, 4.1, 4.1};

static void add(struct irb_store *store, const char *trial, int seed, double flip, double relmse,
                double ms)
{
    int64_t id = trials_add(store, "box", "m", trial, "{}", seed);
    const struct irb_store_value values[] = {{"indirect_flip", flip},
                                             {"indirect_relmse", relmse},
                                             {"reference_noise", 0.01},
                                             {"gl_bytes", seed < 5 && *trial == 'b' ? 3 : 2}};
    trials_scores(store, id, -1, values, 4);
    trials_time(store, id, 0, ms);
}

static int set_up(void **state)
{
    struct irb_store *store = trials_open(folder);
    *state = store;
    for (int i = 0; i < SEEDS; i++) {
        add(store, "good", i, of_good[i], good_relmse[i], good_ms[i]);
        add(store, "near", i, of_near[i], 0.03 + 0.001 * i, near_ms[i]);
        add(store, "bad", i, of_bad[i], 0.05, 5 + i);
        add(store, "quiet", i, 0.3, 0.005, 5);
    }
    add(store, "lone", 7, 0.111, 0.04, 50);
    trials_add(store, "other", "m", "elsewhere", "{}", 1);
    return 0;
}

static int tear_down(void **state)
{
    return trials_close(*state, folder);
}

static char *write_table(struct irb_store *store, struct irb_table_options options)
{
    struct irb_error err = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    REQUIRE_OK(irb_table_write(out, store, &options, &err));
    fclose(out);
    return text;
}

static void expect(const char *text, const char *words, bool there)
{
    if (!strstr(text, words) == there)
        fail_msg("'%s' is %s in\n%s", words, there ? "not" : "", text);
}

static void test_marks(void **state)
{
    char *text = write_table(*state, (struct irb_table_options){.format = IRB_TABLE_TEXT});
    expect(text, " 0.110* ", true);
    expect(text, " 0.113= ", true);
    expect(text, " 0.227  ", true);
    expect(text, " 0.111  ", true); /* one seed says nothing */
    expect(text, " 0.00500~", true);
    expect(text, " 4.07*", true);
    expect(text, " 5.10  ", true);
    expect(text,
           "; = not distinguishable from it (the 95 % interval of their paired ratio contains 1)",
           true);
    /* nothing is known of lone in any column, nor of quiet's FLIP, which is not ranked */
    expect(text,
           "\nbox: too few seeds or frames, or all alike, to tell every trial from the best in "
           "relMSE, FLIP, frame, p95.\n",
           true);
    expect(text, "\nother: ", false);
    free(text);
    text = write_table(*state, (struct irb_table_options){.format = IRB_TABLE_MD});
    expect(text, " **0.110** ", true);
    expect(text, " 0.113= ", true);
    free(text);
    text = write_table(*state, (struct irb_table_options){.format = IRB_TABLE_LATEX});
    expect(text, "$\\mathbf{0.110} ", true);
    expect(text, "$0.113^{=} ", true);
    free(text);
    text =
        write_table(*state, (struct irb_table_options){.format = IRB_TABLE_TEXT, .per_seed = true});
    expect(text, "=", false);
    free(text);
}

enum { OBJECT = 16384 };

static double number(const char *object, const char *key)
{
    char found[64];
    if (!json_member(object, key, found, sizeof found))
        fail_msg("no %s in %s", key, object);
    return strcmp(found, "null") ? strtod(found, NULL) : NAN;
}

static void expect_text(const char *object, const char *key, const char *value)
{
    char found[64];
    assert_true(json_member(object, key, found, sizeof found));
    assert_string_equal(found, value);
}

static void test_complete(void **state)
{
    char *text = write_table(*state, (struct irb_table_options){.format = IRB_TABLE_JSON});
    char object[OBJECT];
    assert_true(json_valid(text));
    assert_true(json_item(text, 0, object, OBJECT));
    struct irb_interval mean = irb_mean_interval(of_good, SEEDS, 0.95);
    REQUIRE_REL(number(object, "indirect_flip_low"), mean.low, 1e-8);
    REQUIRE_REL(number(object, "indirect_flip_high"), mean.high, 1e-8);
    expect_text(object, "indirect_flip_unit", "\"seed\"");
    mean = irb_mean_interval(good_relmse, SEEDS, 0.95);
    REQUIRE_REL(number(object, "indirect_relmse_low"), mean.low - 0.01, 1e-8);
    REQUIRE_REL(number(object, "indirect_relmse_high"), mean.high, 1e-8);
    assert_true(json_item(text, 3, object, OBJECT)); /* quiet has the same in each seed */
    expect_text(object, "indirect_flip_unit", "\"none\"");
    assert_true(isnan(number(object, "indirect_flip_low")));
    assert_true(json_item(text, 4, object, OBJECT));
    assert_true(isnan(number(object, "indirect_flip_low")));
    expect_text(object, "indirect_flip_unit", "\"none\"");
    free(text);
    text = write_table(*state, (struct irb_table_options){.format = IRB_TABLE_CSV});
    expect(text, ",indirect_flip_low,indirect_flip_high,indirect_flip_unit,", true);
    /* every line has as many cells */
    int commas = 0, first = 0;
    for (const char *c = text; *c; c++) {
        commas += *c == ',';
        if (*c != '\n')
            continue;
        first = first ? first : commas;
        assert_int_equal(commas, first);
        commas = 0;
    }
    free(text);
    text =
        write_table(*state, (struct irb_table_options){.format = IRB_TABLE_CSV, .per_seed = true});
    expect(text, "_unit", false);
    free(text);
}

static struct irb_table_options against(const char *trial, enum irb_table_format format)
{
    return (struct irb_table_options){
        .format = format, .subject = IRB_TABLE_RATIO, .against = trial};
}

static void test_ratio_json(void **state)
{
    char *text = write_table(*state, against("good", IRB_TABLE_JSON)), object[OBJECT];
    assert_true(json_valid(text));
    assert_true(json_item(text, 0, object, OBJECT));
    expect_text(object, "trial", "\"near\"");
    expect_text(object, "against", "\"good\"");
    struct irb_interval pairs = irb_ratio_interval(of_near, of_good, SEEDS, 0.95);
    REQUIRE_REL(number(object, "indirect_flip_ratio"), 0.339 / 0.33, 1e-8);
    REQUIRE_REL(number(object, "indirect_flip_low"), pairs.low, 1e-8);
    REQUIRE_REL(number(object, "indirect_flip_high"), pairs.high, 1e-8);
    REQUIRE_NEAR(number(object, "indirect_flip_distinguishable"), 0, 0);
    REQUIRE_REL(number(object, "frame_ms_ratio"), 12.2 / 15.3, 1e-8);
    REQUIRE_NEAR(number(object, "frame_ms_distinguishable"), 1, 0);
    assert_true(json_item(text, 1, object, OBJECT));
    expect_text(object, "trial", "\"bad\"");
    REQUIRE_NEAR(number(object, "indirect_flip_distinguishable"), 1, 0);
    REQUIRE_NEAR(number(object, "gl_bytes_ratio"), 1.5, 0);
    REQUIRE_NEAR(number(object, "gl_bytes_low"), 1.5, 0);
    REQUIRE_NEAR(number(object, "gl_bytes_distinguishable"), 1, 0);
    /* no seed in common */
    assert_true(json_item(text, 3, object, OBJECT));
    expect_text(object, "trial", "\"lone\"");
    assert_true(isnan(number(object, "indirect_flip_ratio")));
    assert_true(isnan(number(object, "indirect_flip_distinguishable")));
    expect_text(object, "indirect_flip_unit", "\"none\"");
    assert_false(json_item(text, 4, object, OBJECT)); /* no row of "other" */
    free(text);
}

static void test_ratio_people(void **state)
{
    char expected[64];
    struct irb_interval pairs = irb_ratio_interval(of_bad, of_good, SEEDS, 0.95);
    snprintf(expected, sizeof expected, "  %.2f [%.2f, %.2f]", pairs.value, pairs.low, pairs.high);
    char *text = write_table(*state, against("good", IRB_TABLE_TEXT));
    expect(text, "box: ratios to good\n", true);
    expect(text, expected, true);
    expect(text, "  ~ 1.03 [", true);
    expect(text, "  (0.25 [", true);      /* relMSE of quiet is not above the noise */
    expect(text, "  1.50 exact\n", true); /* memory */
    expect(text, "  ~ 1.00 exact\n", true);
    expect(text, "  -\n", true); /* lone has no seed in common */
    expect(text, "Exact: all units have the same\nratio. Without an interval: too few units", true);
    expect(text, "other", true); /* of the foot alone */
    expect(text, "elsewhere", false);
    expect(text, "  RMSE", false);
    expect(text, "flicker", false); /* nor has anybody these */
    free(text);
    text = write_table(*state, against("good", IRB_TABLE_MD));
    expect(text, "### box: ratios to good\n\n| trial |", true);
    expect(text, "\n|:------|-", true);
    free(text);
    text = write_table(*state, against("good", IRB_TABLE_LATEX));
    expect(text, "\\begin{tabular}{lrrrr}\n", true);
    expect(text, "    near & ", true);
    expect(text, " & \\textasciitilde{} 1.03 [", true);
    free(text);
    text = write_table(*state, against("good", IRB_TABLE_CSV));
    expect(text, "scene,method,trial,against,indirect_relmse_ratio,", true);
    expect(text, "\nbox,m,near,good,", true);
    free(text);
}

static void test_refused(void **state)
{
    struct irb_error err = {0};
    struct irb_table_options options = against("gud", IRB_TABLE_TEXT);
    assert_false(irb_table_write(stdout, *state, &options, &err));
    assert_int_equal(err.code, IRB_E_USAGE);
    assert_string_equal(err.message, "--ratio: the run has no trial 'gud'; did you mean 'good'?");
    options.per_seed = true;
    assert_false(irb_table_write(stdout, *state, &options, &err));
    assert_string_equal(err.message, "--ratio is over all seeds; leave out --per-seed");
    char empty[] = "/tmp/irb_ratio_none_XXXXXX";
    struct irb_store *none = trials_open(empty);
    options.per_seed = false;
    assert_false(irb_table_write(stdout, none, &options, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_string_equal(err.message, "--ratio: the run has no trials yet");
    assert_int_equal(trials_close(none, empty), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_marks),      cmocka_unit_test(test_complete),
        cmocka_unit_test(test_ratio_json), cmocka_unit_test(test_ratio_people),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
