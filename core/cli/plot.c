/* SPDX-License-Identifier: MIT
 *
 * The command plot: a figure of a run as SVG, PNG or PDF.
 */
#include "core/base/str.h"
#include "core/cli/cli.h"
#include "core/report/plot.h"

#include <stdlib.h>
#include <string.h>

/* --format, else the ending of --out, else svg. */
static const char *chosen_format(const struct irb_cli *cli)
{
    const char *dot = cli->out ? strrchr(cli->out, '.') : NULL;
    if (cli->format)
        return cli->format;
    return dot && !strchr(dot, '/') ? dot + 1 : "svg";
}

/* --out, else RUN/KIND[-SCENE][-METRIC][-bytes].FORMAT; malloc'ed. */
static char *chosen_file(const struct irb_cli *cli, enum irb_figure figure, const char *format)
{
    struct irb_str path = {0};
    if (cli->out)
        return irb_strdup(cli->out);
    irb_str_printf(&path, "%s/%s", cli->arguments[0], irb_figure_names[figure]);
    const char *const parts[] = {cli->scene, cli->metric, cli->cost};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (parts[i])
            irb_str_printf(&path, "-%s", parts[i]);
    irb_str_printf(&path, ".%s", format);
    return path.text;
}

static char *joined_trials(const struct irb_cli *cli)
{
    struct irb_str names = {0};
    for (int i = 0; i < cli->only_count; i++)
        irb_str_printf(&names, "%s%s", i ? " " : "", cli->only[i]);
    return names.text;
}

static bool draw(struct irb_cli *cli, enum irb_figure figure, const char *format,
                 const struct irb_plot_options *options, struct irb_error *err)
{
    struct irb_analysis analysis;
    struct irb_store *store = irb_store_open_snapshot(cli->arguments[0], err);
    bool read = store && irb_analysis_read(&analysis, store, IRB_CONFIDENCE, err);
    irb_store_close(store);
    if (!read)
        return false;
    char *path = chosen_file(cli, figure, format);
    bool ok = irb_plot(&analysis, figure, format, options, path, err);
    if (ok)
        irb_info(&cli->log, "plot: %s", path);
    free(path);
    irb_analysis_destroy(&analysis);
    return ok;
}

bool irb_command_plot(struct irb_cli *cli, struct irb_error *err)
{
    enum irb_figure figure;
    const char *format = chosen_format(cli);
    if (!irb_figure_parse(cli->kind ? cli->kind : "", &figure, err))
        return irb_error_prefix(err, "plot: --kind");
    char *trials = joined_trials(cli);
    const struct irb_plot_options options = {
        .scene = cli->scene, .metric = cli->metric, .cost = cli->cost, .trials = trials};
    bool ok =
        irb_plot_check(figure, format, &options, err) && draw(cli, figure, format, &options, err);
    free(trials);
    return ok || irb_error_prefix(err, "plot");
}
