/* SPDX-License-Identifier: MIT
 *
 * The scripts of plots/ on data written here, run as the program runs them; what is done to SVG;
 * the colours of methods.
 */
#include "core/report/gnuplot.h"
#include "core/report/palette.h"
#include "core/report/plot_svg.h"
#include "tests/support/compare.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[] = "/tmp/irb_plots_XXXXXX";

#define ERRORS(e) #e "," #e "_low," #e "_high," #e "_front_ms," #e "_front_bytes"
#define PARETO                                                                                     \
    "scene,method,trial,frame_ms,frame_ms_low,frame_ms_high,gl_bytes," ERRORS(                     \
        indirect_flip) "," ERRORS(indirect_rmse) "\n"

/* scene names that a shell, gnuplot's strings, formats, enhanced text, CSV or XML would trip over
 */
static const char pareto[] =
    PARETO "a_b%d,rsm,rsm,10,9,11,1000000,0.5,0.4,0.6,1,1,0.5,,,1,1\n"
           "a_b%d,rsm,rsm:x=1,20,19,21,1000000,0.3,0.2,0.4,1,0,0,,,0,0\n"
           "a_b%d,rsm,rsm:x=2,30,29,31,2000000,0.4,0.3,0.5,0,0,,,,0,0\n"
           "a_b%d,rsm,rsm:x=3,40,,,0,0.1,,,1,1,0.1,-1,2,1,1\n"
           "\"it's \"\"q, <x>\"\"\",`touch x`,\"`touch x`:{/Bold y}\",1,,,1,0.1,,,1,1,0.1,,,1,1\n"
           "$(touch x) @y,fourth,fourth,1,,,1,,,,0,0,,,,0,0\n";
static const char stages[] = "scene,method,trial,stage,ms\n"
                             "a_b%d,rsm,rsm,gbuffer,1\na_b%d,rsm,rsm,gather%,20\n"
                             "a_b%d,ism,ism,gbuffer,1\na_b%d,ism,ism,splat_it,0\n";
static const char timeline[] =
    "scene,method,trial,frame,indirect_flip,indirect_rmse,indirect_relmse,indirect_flicker,"
    "frame_ms\n"
    "a_b%d,rsm,rsm,0,0.1,1,1,,5\na_b%d,rsm,rsm,1,0.1,1,1,0,5\na_b%d,rsm,rsm:x=1,0,0.2,1,1,,5\n"
    "b,ism,ism,0,,,,,\n";
static const char convergence[] =
    "scene,method,family,parameter,x,indirect_rmse,indirect_rmse_low,indirect_rmse_high,"
    "indirect_flip,indirect_flip_low,indirect_flip_high\n"
    "a_b%d,rsm,rsm,samples,0,0.5,,,0.1,0.05,0.2\na_b%d,rsm,rsm,samples,100,0.4,,,0.1,,\n"
    "a_b%d,rsm,rsm,r_max,0.3,0.4,0,1,0.1,,\n";
static const char flicker[] =
    "scene,method,trial,flicker,low,high,pop_share,temporal_flip,lag,reference_flicker\n"
    "a_b%d,rsm,rsm,0.5,0.4,0.7,0.1,0.2,0,0.1\na_b%d,ism,ism,0,0,0,,,,0.1\n";

static const struct {
    const char *script, *csv;
} figures[] = {{"pareto", pareto},
               {"stages", stages},
               {"timeline", timeline},
               {"convergence", convergence},
               {"flicker", flicker}};
enum { FIGURES = sizeof figures / sizeof *figures };

static char *draw(const char *script, const char *csv, const char *format,
                  const struct irb_gnuplot_variable *variables, int count, size_t *size)
{
    struct irb_error err = {0};
    char *out = NULL;
    if (!irb_gnuplot(script, csv, format, variables, count, &out, size, &err))
        fail_msg("%s, %s: %s", script, format, err.message);
    return out;
}

static int entries_of(const char *path)
{
    int count = -2; /* . and .. */
    DIR *dir = opendir(path);
    while (dir && readdir(dir))
        count++;
    closedir(dir);
    return count;
}

static void test_every_figure_in_every_format(void **state)
{
    (void)state;
    static const struct {
        const char *format, *magic;
    } formats[] = {{"svg", "<?xml"}, {"png", "\x89PNG\r\n\x1a\n"}, {"pdf", "%PDF-"}};
    for (int i = 0; i < FIGURES; i++)
        for (int f = 0; f < 3; f++) {
            size_t size = 0;
            char *out = draw(figures[i].script, figures[i].csv, formats[f].format, NULL, 0, &size);
            assert_true(size > 1000);
            assert_memory_equal(out, formats[f].magic, strlen(formats[f].magic));
            free(out);
        }
    assert_int_equal(entries_of(folder), 0);
}

static void test_names_are_drawn_as_they_are(void **state)
{
    (void)state;
    size_t size;
    char *svg = draw("pareto", pareto, "svg", NULL, 0, &size);
    assert_non_null(strstr(svg, "a_b%d"));
    assert_non_null(strstr(svg, "it's \u201dq, &lt;x>\u201d"));
    assert_non_null(strstr(svg, "`touch x`"));
    assert_non_null(strstr(svg, "{/Bold y}"));
    assert_non_null(strstr(svg, "$(touch x) @y"));
    assert_false(access("x", F_OK) == 0);
    free(svg);
    svg = draw("stages", stages, "svg", NULL, 0, &size);
    assert_non_null(strstr(svg, "gather%"));
    assert_non_null(strstr(svg, "splat_it"));
    free(svg);
}

static void test_variables(void **state)
{
    (void)state;
    const struct irb_gnuplot_variable bytes[] = {{"metric", "indirect_rmse"}, {"cost", "bytes"}};
    size_t size;
    char *svg = draw("pareto", pareto, "svg", bytes, 2, &size);
    assert_non_null(strstr(svg, "OpenGL memory (MiB)"));
    assert_non_null(strstr(svg, "RMSE"));
    free(svg);
    /* by default of each method the trial with the least mean */
    svg = draw("timeline", timeline, "svg", NULL, 0, &size);
    assert_null(strstr(svg, "rsm:x=1"));
    free(svg);
    const struct irb_gnuplot_variable named = {"trials", "rsm:x=1"};
    svg = draw("timeline", timeline, "svg", &named, 1, &size);
    assert_non_null(strstr(svg, "rsm:x=1"));
    free(svg);
}

/* The path of the group with that title: 1 + the number of its "L". */
static int vertices_of(const char *svg, const char *title)
{
    const char *group = strstr(svg, title), *path = group ? strstr(group, " d='M") : NULL;
    int count = 1;
    assert_non_null(path);
    for (const char *c = path + 5; *c != '\''; c++)
        count += *c == 'L';
    return count;
}

/* The third of four trials is slower and worse than the second: the method's line has three. */
static void test_front_of_a_method(void **state)
{
    (void)state;
    size_t size;
    char *svg = draw("pareto", pareto, "svg", NULL, 0, &size);
    assert_int_equal(vertices_of(svg, "<title>rsm</title>"), 3);
    free(svg);
}

/* The scripts read methods.csv themselves; C must say the same. */
static void test_colours_of_methods(void **state)
{
    (void)state;
    static const char *const methods[] = {"rsm", "rsm-clustering", "ism", "clustered-visibility",
                                          "acrsm"};
    for (int i = 0; i < 5; i++) {
        char csv[512], fill[64];
        unsigned r, g, b;
        size_t size;
        for (int k = 0; k < i; k++)
            assert_string_not_equal(irb_method_colour(methods[i]), irb_method_colour(methods[k]));
        assert_int_equal(sscanf(irb_method_colour(methods[i]), "#%2x%2x%2x", &r, &g, &b), 3);
        snprintf(csv, sizeof csv, PARETO "a,%s,%s,1,,,1,0.1,,,0,0,0.1,,,0,0\n", methods[i],
                 methods[i]);
        snprintf(fill, sizeof fill, "color='rgb(%3u, %3u, %3u)'", r, g, b);
        char *svg = draw("pareto", csv, "svg", NULL, 0, &size);
        if (!strstr(svg, fill))
            fail_msg("%s: no %s", methods[i], fill);
        free(svg);
    }
}

static void test_colours_of_others(void **state)
{
    (void)state;
    assert_string_equal(irb_method_colour("nobody's"), irb_other_colour(0));
    assert_string_equal(irb_method_colour("*"), irb_other_colour(0));
    assert_string_not_equal(irb_other_colour(0), irb_other_colour(1));
    assert_int_equal(strlen(irb_other_colour(1000)), 7);
}

/* Calls fn with each value of ATTRIBUTE='value' or ="value" that begins with `mark`. */
static void each_value(const char *svg, const char *attribute, const char *mark,
                       void (*fn)(const char *svg, const char *value, const char *id),
                       const char *id, int *count)
{
    for (const char *c = svg; (c = strstr(c, attribute)); c++) {
        const char *value = c + strlen(attribute) + 1;
        char text[128];
        snprintf(text, sizeof text, "%.*s", (int)strcspn(value, "'\")"), value);
        if (strncmp(text, mark, strlen(mark)))
            continue;
        fn(svg, text + strlen(mark), id);
        (*count)++;
    }
}

static void has_prefix(const char *svg, const char *value, const char *id)
{
    (void)svg;
    if (strncmp(value, id, strlen(id)))
        fail_msg("the id '%s' has no prefix", value);
}

static void is_there(const char *svg, const char *value, const char *id)
{
    char one[160], two[160];
    (void)id;
    snprintf(one, sizeof one, "id='%s'", value);
    snprintf(two, sizeof two, "id=\"%s\"", value);
    if (!strstr(svg, one) && !strstr(svg, two))
        fail_msg("nothing has the id '%s'", value);
}

static void test_ids_of_an_svg(void **state)
{
    (void)state;
    for (int i = 0; i < FIGURES; i++) {
        const struct irb_gnuplot_variable id = {"id", "one_1"};
        size_t size;
        int ids = 0, uses = 0;
        char *svg = draw(figures[i].script, figures[i].csv, "svg", &id, 1, &size);
        char *tidy = irb_plot_svg_tidy(svg, "one_1", false);
        each_value(tidy, " id=", "", has_prefix, "one_1_", &ids);
        each_value(tidy, "xlink:href=", "#", is_there, NULL, &uses);
        assert_true(ids > 15 && uses > 5);
        assert_null(strstr(tidy, "<script"));
        assert_null(strstr(tidy, ">one_1<"));
        assert_non_null(strstr(tidy, "fill=\"#ffffff\"")); /* its own background */
        free(tidy);
        free(svg);
    }
}

static void test_inlined_svg(void **state)
{
    (void)state;
    static const char *const fixed[] = {"=\"black\"",         "='black'", "#ffffff",  "rgb(0,0,0)",
                                        "rgb(  0,   0,   0)", "<?xml",    "<!DOCTYPE"};
    for (int i = 0; i < FIGURES; i++) {
        size_t size;
        char *svg = draw(figures[i].script, figures[i].csv, "svg", NULL, 0, &size);
        char *inlined = irb_plot_svg_tidy(svg, "one_1", true);
        assert_memory_equal(inlined, "<svg", 4);
        assert_non_null(strstr(inlined, "fill=\"currentColor\""));
        for (size_t k = 0; k < sizeof fixed / sizeof *fixed; k++)
            if (strstr(inlined, fixed[k]))
                fail_msg("%s: holds %s", figures[i].script, fixed[k]);
        free(inlined);
        free(svg);
    }
    /* names are no markup */
    char *kept =
        irb_plot_svg_tidy("<svg id='gpA'><text>id='gpB' fill=\"black\"</text></svg>", "z", true);
    assert_string_equal(kept, "<svg id='z_gpA'><text>id='gpB' fill=\"black\"</text></svg>");
    free(kept);
}

static void test_failures_are_one_line(void **state)
{
    (void)state;
    struct irb_error err = {0};
    char *out = NULL;
    size_t size = 0;
    assert_false(irb_gnuplot("nothing", pareto, "svg", NULL, 0, &out, &size, &err));
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_non_null(strstr(err.message, "gnuplot failed (status "));
    assert_null(strchr(err.message, '\n'));
    assert_false(irb_gnuplot("pareto", PARETO, "svg", NULL, 0, &out, &size, &err));
    assert_string_equal(err.message, "no data");
    const struct irb_gnuplot_variable named = {"trials", "it's-not-there"};
    assert_false(irb_gnuplot("timeline", timeline, "svg", &named, 1, &out, &size, &err));
    assert_string_equal(err.message, "no trial 'it's-not-there'");
    char *path = strdup(getenv("PATH"));
    setenv("PATH", "/nonexistent", 1);
    assert_false(irb_gnuplot("pareto", pareto, "svg", NULL, 0, &out, &size, &err));
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(err.code, IRB_E_INPUT);
    assert_non_null(strstr(err.message, "apt install gnuplot-nox"));
    assert_null(out);
    assert_int_equal(entries_of(folder), 0);
}

static int set_up(void **state)
{
    (void)state;
    return !mkdtemp(folder) || setenv("TMPDIR", folder, 1);
}

static int tear_down(void **state)
{
    (void)state;
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_figure_in_every_format),
        cmocka_unit_test(test_names_are_drawn_as_they_are),
        cmocka_unit_test(test_variables),
        cmocka_unit_test(test_front_of_a_method),
        cmocka_unit_test(test_colours_of_methods),
        cmocka_unit_test(test_colours_of_others),
        cmocka_unit_test(test_ids_of_an_svg),
        cmocka_unit_test(test_inlined_svg),
        cmocka_unit_test(test_failures_are_one_line),
    };
    if (system("gnuplot --version >/dev/null 2>&1")) {
        puts("skipped: no gnuplot");
        return 77;
    }
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
