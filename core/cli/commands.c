/* SPDX-License-Identifier: MIT
 *
 * The commands that work on experiments: run, table, reference.
 */
#include "core/cli/cli.h"
#include "core/cli/run_options.h"
#include "core/report/figures.h"
#include "core/report/table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool table_options(const struct irb_cli *cli, struct irb_table_options *options,
                          struct irb_error *err)
{
    *options = (struct irb_table_options){
        .format = cli->subject == IRB_TABLE_FRAMES ? IRB_TABLE_CSV : IRB_TABLE_TEXT,
        .subject = cli->subject,
        .colour = irb_colour_wanted(STDOUT_FILENO),
        .per_seed = cli->per_seed,
        .against = cli->against,
    };
    return (!cli->format || irb_table_format_parse(cli->format, &options->format, err)) &&
           irb_table_check(options, err);
}

static bool print_table(const struct irb_cli *cli, const char *run_dir, struct irb_error *err)
{
    struct irb_table_options options;
    if (!table_options(cli, &options, err))
        return false;
    struct irb_store *store = irb_store_open_snapshot(run_dir, err);
    if (!store)
        return false;
    bool ok = irb_table_write(stdout, store, &options, err);
    irb_store_close(store);
    return ok;
}

struct irb_run_options irb_cli_run_options(struct irb_cli *cli)
{
    return (struct irb_run_options){
        .out = cli->out,
        .backend = cli->backend,
        .shader_dir = cli->shader_dir,
        .threads = cli->threads,
        .stages = cli->stages,
        .only = cli->only,
        .only_count = cli->only_count,
        .minutes = cli->minutes,
        .keep_all = cli->keep_all,
        .command_line = cli->command_line,
        .log = &cli->log,
        .stop = cli->stop,
    };
}

bool irb_command_run(struct irb_cli *cli, struct irb_error *err)
{
    struct irb_config config = {0};
    struct irb_run_options options = irb_cli_run_options(cli);
    struct irb_table_options table;
    if (!table_options(cli, &table, err) || /* before the work, not after it */
        !irb_config_load(&config, cli->arguments[0], cli->overrides, &cli->registry, err))
        return false;
    bool ok = irb_run_experiment(&config, &options, &cli->run_dir, err);
    if (ok && (cli->stages & IRB_STAGE_SCORE))
        ok = print_table(cli, cli->run_dir, err);
    if (!ok && cli->run_dir)
        irb_info(&cli->log, "results so far: %s", cli->run_dir);
    irb_config_destroy(&config);
    return ok;
}

static bool print_figure(const struct irb_cli *cli, const char *run_dir, struct irb_error *err)
{
    enum irb_figure figure;
    if (!irb_figure_parse(cli->figure, &figure, err))
        return false;
    if (cli->format && strcmp(cli->format, "csv"))
        return irb_fail(err, IRB_E_USAGE,
                        "format: a figure's numbers are printed as csv, not as %s", cli->format);
    if (cli->subject != IRB_TABLE_SCORES || cli->per_seed || cli->only_count)
        return irb_fail(err, IRB_E_USAGE,
                        "--figure goes with --scene alone; leave out --stages, --statistics, "
                        "--frames, --ratio, --per-seed and --only");
    struct irb_store *store = irb_store_open_snapshot(run_dir, err);
    if (!store)
        return false;
    bool ok = irb_figure_csv(stdout, store, figure, cli->scene, err);
    irb_store_close(store);
    return ok;
}

bool irb_command_table(struct irb_cli *cli, struct irb_error *err)
{
    if (cli->figure)
        return print_figure(cli, cli->arguments[0], err);
    if (cli->scene)
        return irb_fail(err, IRB_E_USAGE, "--scene: a table has all scenes; --figure takes one");
    return print_table(cli, cli->arguments[0], err);
}

bool irb_command_reference(struct irb_cli *cli, struct irb_error *err)
{
    struct irb_config config = {0};
    struct irb_run_options options = irb_cli_run_options(cli);
    if (!irb_config_load(&config, cli->arguments[0], cli->overrides, &cli->registry, err))
        return false;
    bool ok = irb_run_references(&config, &options, cli->key ? stdout : NULL, err);
    irb_config_destroy(&config);
    return ok;
}

bool irb_command_doctor(struct irb_cli *cli, struct irb_error *err)
{
    struct irb_gl_desc desc = {.backend = cli->backend, .log = &cli->log};
    printf("irbench %s\n", IRB_VERSION);
    printf("reference (Embree): %s\n",
           IRB_HAVE_REFERENCE
               ? "built in"
               : "left out of this build; apt install libembree-dev and build again");
    printf("images (OpenImageIO, glTF): %s\n",
           IRB_HAVE_IMAGES ? "built in"
                           : "left out of this build; apt install libopenimageio-dev "
                             "libtinygltf-dev and build again");
    if (irb_gl_doctor(stdout, &desc))
        return true;
    return irb_fail(err, IRB_E_BACKEND, "no usable OpenGL 4.5 backend; see the lines above");
}
