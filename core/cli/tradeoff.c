/* SPDX-License-Identifier: MIT
 *
 * The command that runs an experiment, or takes a run that is there, and says what its error costs.
 */
#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/cli/cli.h"
#include "core/cli/run_options.h"
#include "core/report/tradeoff_images.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* Whether the argument is the folder of a run. */
static bool is_run(const char *path)
{
    char *database = irb_asprintf("%s/results.sqlite", path);
    bool there = irb_fs_exists(database);
    free(database);
    return there;
}

static bool print_text(const struct irb_str *text, struct irb_error *err)
{
    return (fwrite(irb_str_text(text), 1, text->length, stdout) == text->length &&
            !fflush(stdout)) ||
           irb_fail(err, IRB_E_IO, "cannot write the answers to standard output");
}

static bool answer(struct irb_cli *cli, const char *run_dir, struct irb_store *store,
                   const struct irb_tradeoff_options *options, enum irb_table_format format,
                   struct irb_error *err)
{
    bool colour = irb_colour_wanted(STDOUT_FILENO);
    struct irb_analysis analysis;
    struct irb_str images = {0}, text = {0};
    if (!irb_analysis_read(&analysis, store, IRB_CONFIDENCE, err))
        return false;
    char *folder = irb_asprintf("%s/tradeoff", run_dir);
    bool ok = irb_tradeoff_check(&analysis, options, err) &&
              irb_tradeoff_images(folder, run_dir, store, &analysis, options, &images, err) &&
              irb_tradeoff_save(folder, &analysis, options, images.text, err);
    if (ok) {
        irb_tradeoff_write(&analysis, options, format, colour, &text);
        ok = print_text(&text, err);
        irb_info(&cli->log, "tables and images: %s", folder);
    }
    free(folder);
    irb_str_free(&text);
    irb_str_free(&images);
    irb_analysis_destroy(&analysis);
    return ok;
}

static bool run_config(struct irb_cli *cli, struct irb_error *err)
{
    struct irb_config config = {0};
    struct irb_run_options options = irb_cli_run_options(cli);
    if (!irb_config_load(&config, cli->arguments[0], cli->overrides, &cli->registry, err))
        return false;
    bool ok = irb_run_experiment(&config, &options, &cli->run_dir, err);
    if (!ok && cli->run_dir)
        irb_info(&cli->log, "results so far: %s", cli->run_dir);
    irb_config_destroy(&config);
    return ok;
}

bool irb_command_tradeoff(struct irb_cli *cli, struct irb_error *err)
{
    struct irb_tradeoff_options options = {IRB_METRIC_indirect_flip, cli->time_ms, cli->error_most};
    bool there = is_run(cli->arguments[0]);
    enum irb_table_format format = IRB_TABLE_TEXT;
    if ((cli->metric && !irb_tradeoff_metric(cli->metric, &options.metric, err)) ||
        (cli->format && !irb_table_format_parse(cli->format, &format, err)))
        return false;
    if (format != IRB_TABLE_TEXT && format != IRB_TABLE_MD)
        return irb_fail(err, IRB_E_USAGE,
                        "format: answers are printed as text or md; RUN/tradeoff has them as csv");
    if (!there && !run_config(cli, err))
        return false;
    if (there)
        cli->run_dir = irb_strdup(cli->arguments[0]);
    struct irb_store *store = irb_store_open_snapshot(cli->run_dir, err);
    bool ok = store && answer(cli, cli->run_dir, store, &options, format, err);
    irb_store_close(store);
    return ok;
}
