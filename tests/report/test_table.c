/* SPDX-License-Identifier: MIT */
#include "core/report/table.h"
#include "core/score/metric_list.h"
#include "tests/support/compare.h"

#include "tests/report/json.h"
#include "tests/report/synthetic.h"

#include <stdlib.h>
#include <string.h>

static char folder[] = "/tmp/irb_table_XXXXXX";
static const char *const no_value = "null";

static int set_up(void **state)
{
    struct irb_error err = {0};
    if (!mkdtemp(folder))
        return -1;
    *state = synthetic_store(folder, &err);
    if (!*state)
        fprintf(stderr, "%s\n", err.message);
    return *state ? 0 : -1;
}

static int tear_down(void **state)
{
    irb_store_close(*state);
    char command[64];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

/* The table as malloc'ed text. */
static char *write_table(struct irb_store *store, enum irb_table_format format, bool colour)
{
    struct irb_error err = {0};
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    REQUIRE_OK(irb_table_write(
        out, store, &(struct irb_table_options){.format = format, .colour = colour}, &err));
    fclose(out);
    return text;
}

static void test_formats(void **state)
{
    (void)state;
    struct irb_error err = {0};
    enum irb_table_format format;
    REQUIRE_OK(irb_table_format_parse("json", &format, &err));
    assert_int_equal(format, IRB_TABLE_JSON);
    REQUIRE_OK(irb_table_format_parse("text", &format, &err));
    assert_int_equal(format, IRB_TABLE_TEXT);
    assert_false(irb_table_format_parse("xml", &format, &err));
    assert_int_equal(err.code, IRB_E_USAGE);
    assert_string_equal(err.message, "format: expected text, csv, md, json or latex, found 'xml'");
}

/* The reader itself, on texts whose answer the RFC gives. */
static void test_json_reader(void **state)
{
    (void)state;
    static const char *const good[] = {"[]", "{}", " [1, -0.5e+3, null] ", "{\"a\": [true, {}]}",
                                       "\"\\u00e9\\n\""};
    static const char *const bad[] = {"",          "[1,]",  "{a: 1}", "nan", "[01]",
                                      "{\"a\" 1}", "[1] 2", "\"\n\"", "inf", "[1",
                                      "{\"a\":}",  ".5",    "1."};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        if (!json_valid(good[i]))
            fail_msg("refused %s", good[i]);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        if (json_valid(bad[i]))
            fail_msg("accepted %s", bad[i]);
}

enum { OBJECT = 8192 };

static void expect_member(const char *object, const char *key, const char *value)
{
    char found[OBJECT];
    if (!json_member(object, key, found, sizeof found))
        fail_msg("no %s in %s", key, object);
    if (strcmp(found, value))
        fail_msg("%s is %s, expected %s", key, found, value);
}

static void test_json(void **state)
{
    char *text = write_table(*state, IRB_TABLE_JSON, true);
    assert_true(json_valid(text));
    char rows[4][OBJECT];
    for (int i = 0; i < 4; i++)
        assert_true(json_item(text, i, rows[i], OBJECT));
    char fifth[OBJECT];
    assert_false(json_item(text, 4, fifth, OBJECT));

    /* scenes together, in order of appearance */
    expect_member(rows[0], "scene", "\"cornell\"");
    expect_member(rows[0], "trial", "\"rsm\"");
    expect_member(rows[0], "method", "\"rsm\"");
    expect_member(rows[0], "params", "{\"mode\": \"uniform\", \"samples\": 400}");
    expect_member(rows[1], "trial", "\"rsm:mode=all\"");
    expect_member(rows[2], "trial", "\"plain\"");
    expect_member(rows[3], "scene", "\"a,\\\"b\\\"\"");

    expect_member(rows[0], "seed", "1");
    expect_member(rows[0], "seeds", "1");
    expect_member(rows[0], "indirect_relmse", "0.04");
    expect_member(rows[0], "indirect_bias", "-0.01");
    expect_member(rows[0], "claim_rmse", no_value);
    /* of regions; nothing else that has an '@' */
    expect_member(rows[0], "full_flip@door", "0.5");
    expect_member(rows[1], "full_flip@door", no_value);
    expect_member(rows[1], "indirect_rmse@wall", "0.75");
    expect_member(rows[0], "indirect_rmse@wall", no_value);
    assert_null(strstr(text, "tomorrow"));
    assert_null(strstr(text, "lag_error"));
    expect_member(rows[2], "indirect_rmse", no_value); /* infinite: JSON has no such number */
    /* over frames 0 to 4; sums over stages */
    expect_member(rows[0], "frame_ms", "3");
    expect_member(rows[0], "frame_ms_worst", "10");
    expect_member(rows[0], "stage_gather_ms", "3");
    expect_member(rows[0], "stage_filter_ms", no_value);
    expect_member(rows[1], "frame_ms", "6");
    expect_member(rows[1], "frame_ms_p95", "6");
    expect_member(rows[1], "stage_gather_ms", "5");
    expect_member(rows[1], "stage_filter_ms", "1");
    expect_member(rows[2], "frame_ms", no_value);
    for (int row = 0; row < 4; row++) {
        for (int i = 0; i < IRB_METRIC_COUNT; i++)
            assert_true(json_member(rows[row], irb_metrics[i].name, fifth, sizeof fifth));
        assert_false(json_member(rows[row], "a_metric_of_tomorrow", fifth, sizeof fifth));
        assert_false(json_member(rows[row], "indirect_relmse_sd", fifth, sizeof fifth));
    }
    free(text);
}

/* Field `index` of the CSV record at `line`, unquoted (RFC 4180). */
static void csv_field(const char *line, int index, char *out, size_t size)
{
    size_t n = 0;
    bool quoted = false;
    for (const char *c = line;; c++) {
        if (*c == '"' && quoted && c[1] == '"')
            c++;
        else if (*c == '"') {
            quoted = !quoted;
            continue;
        } else if (!*c || (!quoted && (*c == ',' || *c == '\n'))) {
            if (index-- == 0)
                break;
            if (!*c || *c == '\n') {
                n = 0;
                snprintf(out, size, "(no such field)");
                return;
            }
            continue;
        }
        if (index == 0 && n + 1 < size)
            out[n++] = *c;
    }
    out[n] = 0;
}

static void expect_cell(const char *text, int row, const char *column, const char *value)
{
    char found[256];
    int index = 0;
    do {
        csv_field(text, index++, found, sizeof found);
        if (!strcmp(found, "(no such field)"))
            fail_msg("there is no column %s", column);
    } while (strcmp(found, column));
    const char *line = text;
    for (int i = 0; i <= row; i++)
        line = strchr(line, '\n') + 1;
    csv_field(line, index - 1, found, sizeof found);
    if (strcmp(found, value))
        fail_msg("row %d, %s: found '%s', expected '%s'", row, column, found, value);
}

static void test_csv(void **state)
{
    char *text = write_table(*state, IRB_TABLE_CSV, true);
    static const char start[] = "scene,method,trial,params,seed,seeds,indirect_rmse,";
    assert_int_equal(strncmp(text, start, sizeof start - 1), 0);
    int lines = 0;
    for (const char *c = text; (c = strchr(c, '\n')); c++)
        lines++;
    assert_int_equal(lines, 5);
    expect_cell(text, 0, "scene", "cornell");
    expect_cell(text, 0, "params", "mode=uniform;samples=400");
    expect_cell(text, 0, "indirect_relmse", "0.04");
    expect_cell(text, 0, "claim_rmse", "");
    expect_cell(text, 0, "frame_ms", "3");
    expect_cell(text, 0, "stage_filter_ms", "");
    expect_cell(text, 1, "trial", "rsm:mode=all");
    expect_cell(text, 1, "stage_filter_ms", "1");
    expect_cell(text, 2, "indirect_rmse", "inf");
    expect_cell(text, 3, "scene", "a,\"b\"");
    expect_cell(text, 3, "indirect_relmse", "");
    free(text);
}

static void expect_words(const char *text, const char *words)
{
    if (!strstr(text, words))
        fail_msg("'%s' is not in\n%s", words, text);
}

static void test_text(void **state)
{
    char *text = write_table(*state, IRB_TABLE_TEXT, false);
    assert_null(strchr(text, '\033'));
    expect_words(text, "cornell   reference: noise 0.00100 (relMSE), flicker floor <= 0.00200; "
                       "relMSE eps 0.000123\n");
    expect_words(text, " W/(m2 sr)");
    expect_words(text, " ms");
    /* 0.0005 is below the noise: the best that is ranked is plain's 0.01; and 0.02 below the
     * noise's RMSE, which leaves 0.2 */
    expect_words(text, " 0.000500~");
    expect_words(text, " 0.0200~");
    expect_words(text, " 0.200*");
    expect_words(text, " 0.0100*");
    expect_words(text, " 0.0400 ");
    /* FLIP of the same image is not ranked either; that leaves the other */
    expect_words(text, " 0.0625~");
    expect_words(text, " 0.125*");
    /* the noise makes less flicker than its bound: who is below that is ranked all the same */
    expect_words(text, " 0.00100*");
    expect_words(text, " 0.00300 ");
    /* 1.02 is nearer to one than 0.97 */
    expect_words(text, " 1.020*");
    expect_words(text, " 0.9700 ");
    expect_words(text, " 3.00*");
    expect_words(text, " 6.00 ");
    /* a column is there where some trial has a value, or a value that is not 0 */
    expect_words(text, "uncovered");
    assert_null(strstr(text, "clamped"));
    assert_null(strstr(text, "non-finite"));
    assert_null(strstr(text, "solution"));
    expect_words(text, "times: finish+clock on a device\n");
    expect_words(text, "* best of its column and scene; ~ not above the reference's own noise");
    expect_words(text, "\ncornell: too few seeds or frames, or all alike, to tell every trial from "
                       "the best in relMSE, RMSE, energy, flicker, frame, p95.\n");
    free(text);
}

/* All lines of a scene's block are equally long: the columns are aligned. */
static void test_text_is_aligned(void **state)
{
    char *text = write_table(*state, IRB_TABLE_TEXT, false);
    const char *line = strchr(text, '\n') + 1;
    size_t length = strcspn(line, "\n");
    for (int i = 0; i < 5; i++, line += strcspn(line, "\n") + 1)
        assert_int_equal(strcspn(line, "\n"), length);
    assert_int_equal(*line, '\n');
    free(text);
}

static void test_colour(void **state)
{
    char *text = write_table(*state, IRB_TABLE_TEXT, true);
    expect_words(text, "\033[1m0.0100*\033[0m");
    expect_words(text, " 0.0400 ");
    free(text);
}

static void test_markdown(void **state)
{
    char *text = write_table(*state, IRB_TABLE_MD, true);
    assert_null(strchr(text, '\033'));
    expect_words(text, "### cornell\n\n| trial ");
    expect_words(text, "| RMSE [W/(m2 sr)] |");
    expect_words(text, " **0.0100** |");
    expect_words(text, " 0.000500~ |");
    /* header, rule and rows have as many cells and the same width */
    const char *line = strstr(text, "| trial");
    size_t length = strcspn(line, "\n");
    for (int i = 0; i < 5; i++, line += strcspn(line, "\n") + 1)
        assert_int_equal(strcspn(line, "\n"), length);
    assert_int_equal(*line, '\n');
    free(text);
}

static void test_latex(void **state)
{
    char *text = write_table(*state, IRB_TABLE_LATEX, true);
    assert_null(strchr(text, '\033'));
    expect_words(text, "  \\caption{cornell. reference: noise 0.00100 (relMSE), flicker floor");
    expect_words(text, "  \\begin{tabular}{lrrrrrrrrr}\n    \\toprule\n    trial & relMSE & "
                       "RMSE [W/(m\\textsuperscript{2} sr)] & FLIP");
    expect_words(text, "    rsm:mode=all & $0.000500^{\\sim}$ & $0.0200^{\\sim}$ & ");
    expect_words(text, "    plain & $\\mathbf{0.0100}$ & $\\infty$ & --");
    /* a scene whose name is full of what LaTeX takes for its own */
    expect_words(text, "\\caption{a,\\textquotedbl{}b\\textquotedbl{}. ");
    expect_words(text, "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n");
    expect_words(text, "% times: finish+clock on a device\n");
    /* rows have as many cells as there are columns, and braces pair */
    int depth = 0, cells = 0;
    const char *table = strstr(text, "\\toprule"), *end = strstr(text, "\\bottomrule");
    for (const char *c = table; c < end; c++) {
        cells += *c == '&';
        if (c[0] == '\\' && c[1] == '\\') {
            assert_int_equal(cells, 9);
            cells = 0;
        }
    }
    for (const char *c = text; *c; c++)
        depth += *c == '{' ? 1 : *c == '}' ? -1 : 0;
    assert_int_equal(depth, 0);
    free(text);
}

static void test_no_trials(void **state)
{
    (void)state;
    struct irb_error err = {0};
    char empty[64];
    snprintf(empty, sizeof empty, "%s/empty", folder);
    struct irb_store *store = irb_store_open(empty, true, &err);
    assert_non_null(store);
    static const char *const expected[] = {"no trials yet\n", NULL, "no trials yet\n", "[]\n",
                                           "% needs \\usepackage{booktabs} and "
                                           "\\usepackage[T1]{fontenc}\n% no trials yet\n"};
    for (int format = IRB_TABLE_TEXT; format <= IRB_TABLE_LATEX; format++) {
        char *text = write_table(store, (enum irb_table_format)format, false);
        if (expected[format])
            assert_string_equal(text, expected[format]);
        else
            assert_ptr_equal(strchr(text, '\n'), text + strlen(text) - 1);
        free(text);
    }
    irb_store_close(store);
}

static void test_full_disk(void **state)
{
    struct irb_error err = {0};
    FILE *full = fopen("/dev/full", "w");
    if (!full)
        skip();
    assert_false(
        irb_table_write(full, *state, &(struct irb_table_options){.format = IRB_TABLE_JSON}, &err));
    assert_int_equal(err.code, IRB_E_IO);
    expect_words(err.message, "cannot write the table: No space left on device");
    fclose(full);
}

static int print_table(const char *name)
{
    void *store = NULL;
    struct irb_error err;
    enum irb_table_format format;
    if (!irb_table_format_parse(name, &format, &err) || set_up(&store))
        return 1;
    char *text = write_table(store, format, false);
    fputs(text, stdout);
    free(text);
    return tear_down(&store);
}

int main(int argc, char **argv)
{
    if (argc == 2) /* a format: the table itself, for other programs and eyes */
        return print_table(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_formats),   cmocka_unit_test(test_json_reader),
        cmocka_unit_test(test_json),      cmocka_unit_test(test_csv),
        cmocka_unit_test(test_text),      cmocka_unit_test(test_text_is_aligned),
        cmocka_unit_test(test_colour),    cmocka_unit_test(test_markdown),
        cmocka_unit_test(test_no_trials), cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_latex),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
