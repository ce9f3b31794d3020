/* SPDX-License-Identifier: MIT */
#include "core/report/plot.h"

#include "core/base/fs.h"
#include "core/base/hash.h"
#include "core/base/str.h"
#include "core/report/gnuplot.h"
#include "core/report/plot_svg.h"

#include <stdlib.h>
#include <string.h>

const char *const irb_plot_format_names[] = {"svg", "png", "pdf", NULL};
static const char *const cost_names[] = {"ms", "bytes", NULL};

/* What each figure can show; NULL where it has no choice. */
static const char *const *metrics_of(enum irb_figure figure)
{
    static const char *const errors[] = {"indirect_flip", "indirect_rmse", "indirect_relmse",
                                         "indirect_flicker", NULL};
    static const char *const frames[] = {"indirect_flip",    "indirect_rmse", "indirect_relmse",
                                         "indirect_flicker", "frame_ms",      NULL};
    static const char *const curves[] = {"indirect_rmse", "indirect_flip", NULL};
    switch (figure) {
    case IRB_FIGURE_PARETO:
        return errors;
    case IRB_FIGURE_TIMELINE:
        return frames;
    case IRB_FIGURE_CONVERGENCE:
        return curves;
    default:
        return NULL;
    }
}

/* Index of the text in a NULL-terminated list, or -1 with *err. */
static int choose(const char *what, const char *text, const char *const *list,
                  struct irb_error *err)
{
    struct irb_str names = {0};
    for (int i = 0; list[i]; i++) {
        if (!strcmp(list[i], text)) {
            irb_str_free(&names);
            return i;
        }
        irb_str_printf(&names, "%s%s", !i ? "" : list[i + 1] ? ", " : " or ", list[i]);
    }
    irb_fail(err, IRB_E_USAGE, "%s: expected %s; found '%s'", what, irb_str_text(&names), text);
    irb_str_free(&names);
    return -1;
}

static bool refuse(const char *option, enum irb_figure figure, struct irb_error *err)
{
    return irb_fail(err, IRB_E_USAGE, "%s: the figure '%s' has no such choice", option,
                    irb_figure_names[figure]);
}

bool irb_plot_check(enum irb_figure figure, const char *format,
                    const struct irb_plot_options *options, struct irb_error *err)
{
    const char *const *metrics = metrics_of(figure);
    if (choose("--format", format, irb_plot_format_names, err) < 0)
        return false;
    if (options->metric && !metrics)
        return refuse("--metric", figure, err);
    if (options->metric && choose("--metric", options->metric, metrics, err) < 0)
        return false;
    if (options->cost && figure != IRB_FIGURE_PARETO)
        return refuse("--cost", figure, err);
    if (options->trials && figure != IRB_FIGURE_TIMELINE)
        return refuse("--only", figure, err);
    return !options->cost || choose("--cost", options->cost, cost_names, err) >= 0;
}

/* malloc'ed; NULL where there is not one row of data. */
static char *figure_csv(const struct irb_analysis *analysis, enum irb_figure figure,
                        const char *scene, struct irb_error *err)
{
    struct irb_str csv = {0};
    bool ok = irb_figure_text(analysis, figure, scene, &csv, err);
    const char *rows = ok ? strchr(irb_str_text(&csv), '\n') : NULL;
    if (rows && rows[1])
        return csv.text;
    irb_str_free(&csv);
    if (ok)
        irb_fail(err, IRB_E_INPUT, "%s: nothing to draw: %s", irb_figure_names[figure],
                 figure == IRB_FIGURE_CONVERGENCE
                     ? "no two trials of a method differ in one number alone"
                     : "the run has no data for it");
    return NULL;
}

/* An id that differs where the figure does. */
static char *figure_id(enum irb_figure figure, const char *csv,
                       const struct irb_plot_options *options)
{
    struct irb_hash *hash = irb_hash_create();
    irb_hash_string(hash, csv);
    irb_hash_string(hash, options->metric ? options->metric : "");
    irb_hash_string(hash, options->cost ? options->cost : "");
    irb_hash_string(hash, options->trials ? options->trials : "");
    struct irb_key key = irb_hash_finish(hash);
    return irb_asprintf("%s_%.8s", irb_figure_names[figure], key.hex);
}

static bool draw(const struct irb_analysis *analysis, enum irb_figure figure, const char *format,
                 const struct irb_plot_options *options, bool inlined, char **out, size_t *size,
                 struct irb_error *err)
{
    static const struct irb_plot_options none = {0};
    if (!options)
        options = &none;
    char *csv = irb_plot_check(figure, format, options, err)
                    ? figure_csv(analysis, figure, options->scene, err)
                    : NULL;
    if (!csv)
        return false;
    char *id = figure_id(figure, csv, options);
    const struct irb_gnuplot_variable variables[] = {
        {"id", id},
        {"metric", options->metric},
        {"cost", options->cost},
        {"trials", options->trials},
    };
    bool ok = irb_gnuplot(irb_figure_names[figure], csv, format, variables,
                          sizeof variables / sizeof *variables, out, size, err);
    if (ok && !strcmp(format, "svg")) {
        char *svg = irb_plot_svg_tidy(*out, id, inlined);
        free(*out);
        *out = svg;
        *size = strlen(svg);
    }
    free(id);
    free(csv);
    return ok;
}

bool irb_plot(const struct irb_analysis *analysis, enum irb_figure figure, const char *format,
              const struct irb_plot_options *options, const char *out_path, struct irb_error *err)
{
    char *data = NULL;
    size_t size = 0;
    bool ok = draw(analysis, figure, format, options, false, &data, &size, err) &&
              irb_fs_write(out_path, data, size, err);
    free(data);
    return ok;
}

char *irb_plot_svg(const struct irb_analysis *analysis, enum irb_figure figure,
                   const struct irb_plot_options *options, struct irb_error *err)
{
    char *svg = NULL;
    size_t size = 0;
    return draw(analysis, figure, "svg", options, true, &svg, &size, err) ? svg : NULL;
}
