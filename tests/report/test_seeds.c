/* SPDX-License-Identifier: MIT
 *
 * Trials that ran with several seeds: means and spreads, one row or one a seed. And LaTeX's
 * escapes.
 */
#include "core/report/table.h"
#include "core/report/table_latex.h"
#include "tests/support/compare.h"

#include "tests/report/json.h"

#include <stdlib.h>
#include <string.h>

static char folder[] = "/tmp/irb_seeds_XXXXXX";

/* relMSE 1, 2 and 6 with seeds 1, 2 and 9: mean 3, standard deviation sqrt((4 + 1 + 9) / 2) =
 * sqrt(7). Frames of 1 and 3 ms, 2 and 4, 3 and 11: medians 2, 3 and 7 of mean 4 (the median of two
 * being their mean). The seeds of two trials are stored alternately. */
static int set_up(void **state)
{
    static const int seeds[] = {1, 2, 9};
    static const double relmse[] = {1, 2, 6}, ms[][2] = {{1, 3}, {2, 4}, {3, 11}};
    struct irb_error err = {0};
    struct irb_store *store = mkdtemp(folder) ? irb_store_open(folder, true, &err) : NULL;
    *state = store;
    if (!store)
        return -1;
    bool ok = true;
    for (int i = 0; ok && i < 3; i++) {
        int64_t random = irb_store_trial(store, "box", "rsm", "rsm:x_y=1", "{}", seeds[i], &err);
        int64_t fixed = irb_store_trial(store, "box", "rsm", "rsm", "{}", seeds[i], &err);
        const struct irb_store_value first[] = {{"indirect_relmse", relmse[i]},
                                                {"indirect_flip", 0.1}};
        const struct irb_store_value second[] = {{"indirect_relmse", 0.1}, {"lag", i}};
        ok = random && fixed && irb_store_scores(store, random, -1, first, 2, &err) &&
             irb_store_scores(store, fixed, -1, second, i == 1 ? 1 : 2, &err);
        for (int f = 0; ok && f < 2; f++)
            ok = irb_store_frame(store, random, f, "clock",
                                 &(struct irb_store_value){"gather", ms[i][f]}, 1, NULL, 0, &err);
    }
    /* a trial with one seed only */
    int64_t one = irb_store_trial(store, "box", "plain", "plain", "{}", 1, &err);
    return ok && one ? 0 : -1;
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
    REQUIRE_OK(irb_table_write(
        out, store, &(struct irb_table_options){.format = format, .per_seed = per_seed}, &err));
    fclose(out);
    return text;
}

enum { OBJECT = 8192 };

static double number(const char *table, int row, const char *key)
{
    char object[OBJECT], found[64];
    if (!json_item(table, row, object, sizeof object))
        fail_msg("no row %d", row);
    if (!json_member(object, key, found, sizeof found))
        fail_msg("no %s in %s", key, object);
    return strcmp(found, "null") ? strtod(found, NULL) : NAN;
}

static int row_count(const char *table)
{
    char object[OBJECT];
    int count = 0;
    while (json_item(table, count, object, sizeof object))
        count++;
    return count;
}

static void test_means(void **state)
{
    char *text = write_table(*state, IRB_TABLE_JSON, false);
    assert_true(json_valid(text));
    assert_int_equal(row_count(text), 3);
    REQUIRE_NEAR(number(text, 0, "seeds"), 3, 0);
    assert_true(isnan(number(text, 0, "seed")));
    REQUIRE_NEAR(number(text, 0, "indirect_relmse"), 3, 1e-12);
    REQUIRE_NEAR(number(text, 0, "indirect_relmse_sd"), sqrt(7), 1e-8);
    REQUIRE_NEAR(number(text, 0, "frame_ms"), 4, 1e-12);
    REQUIRE_NEAR(number(text, 0, "frame_ms_worst"), 11, 0);
    REQUIRE_NEAR(number(text, 0, "stage_gather_ms"), 4, 1e-12);
    /* equal values have no spread, not one of rounding */
    REQUIRE_NEAR(number(text, 0, "indirect_flip"), 0.1, 0);
    REQUIRE_NEAR(number(text, 0, "indirect_flip_sd"), 0, 0);
    /* what a seed does not have does not count: 0 and 2 */
    REQUIRE_NEAR(number(text, 1, "lag"), 1, 0);
    REQUIRE_NEAR(number(text, 1, "lag_sd"), sqrt(2), 1e-8);
    REQUIRE_NEAR(number(text, 2, "seeds"), 1, 0);
    REQUIRE_NEAR(number(text, 2, "seed"), 1, 0);
    assert_true(isnan(number(text, 2, "indirect_relmse_sd")));
    free(text);
}

static void test_per_seed(void **state)
{
    char *text = write_table(*state, IRB_TABLE_JSON, true), object[OBJECT], found[64];
    assert_int_equal(row_count(text), 7);
    REQUIRE_NEAR(number(text, 0, "seed"), 1, 0);
    REQUIRE_NEAR(number(text, 4, "seed"), 9, 0);
    REQUIRE_NEAR(number(text, 4, "seeds"), 1, 0);
    REQUIRE_NEAR(number(text, 4, "indirect_relmse"), 6, 0);
    assert_true(json_item(text, 4, object, sizeof object));
    assert_true(json_member(object, "trial", found, sizeof found));
    assert_string_equal(found, "\"rsm:x_y=1\"");
    assert_false(json_member(object, "indirect_relmse_sd", found, sizeof found));
    free(text);
    text = write_table(*state, IRB_TABLE_TEXT, true);
    assert_non_null(strstr(text, "rsm:x_y=1 seed 9 "));
    assert_non_null(strstr(text, " plain  "));
    assert_null(strstr(text, "+-"));
    free(text);
}

static void expect_words(struct irb_store *store, enum irb_table_format format, const char *words)
{
    char *text = write_table(store, format, false);
    if (!strstr(text, words))
        fail_msg("'%s' is not in\n%s", words, text);
    free(text);
}

static void test_people(void **state)
{
    expect_words(*state, IRB_TABLE_TEXT, " 3.00  +-2.6");
    expect_words(*state, IRB_TABLE_TEXT, "Means over 3 seeds; +- is the standard deviation");
    expect_words(*state, IRB_TABLE_MD, " 3.00 ± 2.6 |");
    expect_words(*state, IRB_TABLE_LATEX, "rsm:x\\_y=1 & $3.00 \\pm 2.6$");
    expect_words(*state, IRB_TABLE_CSV, "box,rsm,rsm:x_y=1,,,3,");
    /* aligned: every line of the block is as long */
    char *text = write_table(*state, IRB_TABLE_TEXT, false);
    const char *line = strchr(text, '\n') + 1;
    size_t length = strcspn(line, "\n");
    for (int i = 0; i < 5; i++, line += strcspn(line, "\n") + 1)
        assert_int_equal(strcspn(line, "\n"), length);
    free(text);
}

static void test_latex_escapes(void **state)
{
    (void)state;
    struct irb_str out = {0};
    irb_latex_text(&out, "a_b 100% {x} $1 & #2 ~^\\ <é>\n");
    assert_string_equal(irb_str_text(&out),
                        "a\\_b 100\\% \\{x\\} \\$1 \\& \\#2 \\textasciitilde{}"
                        "\\textasciicircum{}\\textbackslash{} \\textless{}é\\textgreater{} ");
    irb_str_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_means),
        cmocka_unit_test(test_per_seed),
        cmocka_unit_test(test_people),
        cmocka_unit_test(test_latex_escapes),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
