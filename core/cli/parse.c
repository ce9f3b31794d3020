/* SPDX-License-Identifier: MIT
 *
 * The options of the command line, from one table that also prints the help.
 */
#include "core/base/str.h"
#include "core/cli/cli.h"
#include "core/experiment/run.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool set_override(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    if (!strchr(value, '='))
        return irb_fail(err, IRB_E_USAGE, "--set: expected key=value; found '%s'", value);
    if (cli->override_count == IRB_CLI_MAX_ARGUMENTS)
        return irb_fail(err, IRB_E_USAGE, "--set: at most %d overrides", IRB_CLI_MAX_ARGUMENTS);
    cli->overrides[cli->override_count++] = value;
    return true;
}

static bool set_seed(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    free(cli->seed);
    cli->seed = irb_asprintf("seed=%s", value);
    return set_override(cli, cli->seed, err);
}

static bool set_debug_layers(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value;
    return set_override(cli, "debug_layers=true", err);
}

static bool set_only(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    if (cli->only_count == IRB_CLI_MAX_ARGUMENTS)
        return irb_fail(err, IRB_E_USAGE, "--only: at most %d trials", IRB_CLI_MAX_ARGUMENTS);
    cli->only[cli->only_count++] = value;
    return true;
}

static bool set_trial(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    if (cli->trial_count == IRB_CLI_MAX_ARGUMENTS)
        return irb_fail(err, IRB_E_USAGE, "--trial: at most %d trials", IRB_CLI_MAX_ARGUMENTS);
    cli->trials[cli->trial_count++] = value;
    return true;
}

static bool set_max_mb(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    char *end;
    double mb = strtod(value, &end);
    if (end == value || *end || !(mb >= 1 && mb <= 1000))
        return irb_fail(err, IRB_E_USAGE, "--max-mb: expected 1 to 1000; found '%s'", value);
    cli->max_mb = mb;
    return true;
}

static bool set_backend(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    for (int i = 0; irb_backend_names[i]; i++) {
        if (!strcmp(irb_backend_names[i], value)) {
            cli->backend = (enum irb_backend)i;
            return true;
        }
    }
    return irb_fail(err, IRB_E_USAGE, "--backend: expected auto, osmesa, egl or null; found '%s'",
                    value);
}

static bool set_stage(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    static const struct {
        const char *name;
        unsigned stages;
    } stages[] = {{"prepare", IRB_STAGE_PREPARE},
                  {"render", IRB_STAGE_RENDER},
                  {"score", IRB_STAGE_SCORE},
                  {"all", IRB_STAGE_ALL}};
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
        if (!strcmp(stages[i].name, value)) {
            cli->stages = stages[i].stages;
            return true;
        }
    }
    return irb_fail(err, IRB_E_USAGE, "--stage: expected prepare, render, score or all; found '%s'",
                    value);
}

static bool set_threads(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    char *end;
    errno = 0;
    long threads = strtol(value, &end, 10);
    if (end == value || *end || errno || threads < 1 || threads > 1024)
        return irb_fail(err, IRB_E_USAGE, "--threads: expected 1 to 1024; found '%s'", value);
    cli->threads = (int)threads;
    return true;
}

static bool set_keep(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    if (strcmp(value, "all") && strcmp(value, "some"))
        return irb_fail(err, IRB_E_USAGE, "--keep: expected some or all; found '%s'", value);
    cli->keep_all = !strcmp(value, "all");
    return true;
}

static bool set_minutes(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    char *end;
    double minutes = strtod(value, &end);
    if (end == value || *end || !(minutes > 0 && minutes <= 1e6))
        return irb_fail(err, IRB_E_USAGE, "--minutes: expected a number above 0; found '%s'",
                        value);
    cli->minutes = minutes;
    return true;
}

static bool add_bound(struct irb_cli *cli, const char *value, bool most, struct irb_error *err)
{
    if (cli->bound_count == IRB_CLI_MAX_ARGUMENTS)
        return irb_fail(err, IRB_E_USAGE, "--max, --min: at most %d bounds", IRB_CLI_MAX_ARGUMENTS);
    cli->bounds[cli->bound_count++] = (struct irb_cli_bound){value, most};
    return true;
}

static bool set_max(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    return add_bound(cli, value, true, err);
}

static bool set_min(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    return add_bound(cli, value, false, err);
}

static bool set_module(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    return irb_registry_load(&cli->registry, value, err);
}

static bool set_key(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value, (void)err;
    cli->key = true;
    return true;
}

static bool set_verbose(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value, (void)err;
    cli->log.level = IRB_LOG_DEBUG;
    return true;
}

static bool set_quiet(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value, (void)err;
    cli->log.level = IRB_LOG_ERROR;
    return true;
}

static bool set_per_seed(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value, (void)err;
    cli->per_seed = true;
    return true;
}

static bool set_subject(struct irb_cli *cli, enum irb_table_subject subject, struct irb_error *err)
{
    if (cli->subject != IRB_TABLE_SCORES && cli->subject != subject)
        return irb_fail(err, IRB_E_USAGE,
                        "--stages, --statistics, --frames and --ratio are four tables; expected "
                        "one of them");
    cli->subject = subject;
    return true;
}

static bool set_stages(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value;
    return set_subject(cli, IRB_TABLE_STAGES, err);
}

static bool set_statistics(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value;
    return set_subject(cli, IRB_TABLE_STATISTICS, err);
}

static bool set_frames(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value;
    return set_subject(cli, IRB_TABLE_FRAMES, err);
}

static bool set_ratio(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    cli->against = value;
    return set_subject(cli, IRB_TABLE_RATIO, err);
}

static bool set_figure(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)err;
    cli->figure = value;
    return true;
}

/* A number above 0 into *to. */
static bool set_positive(const char *option, const char *value, double *to, struct irb_error *err)
{
    char *end;
    *to = strtod(value, &end);
    return (end != value && !*end && *to > 0 && *to < 1e12) ||
           irb_fail(err, IRB_E_USAGE, "%s: expected a number above 0; found '%s'", option, value);
}

static bool set_time(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    return set_positive("--time", value, &cli->time_ms, err);
}

static bool set_error(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    return set_positive("--error", value, &cli->error_most, err);
}

static bool set_json(struct irb_cli *cli, const char *value, struct irb_error *err)
{
    (void)value, (void)err;
    cli->log.json = true;
    return true;
}

const struct irb_cli_option irb_cli_options[] = {
    {"--out", "-o", "DIR",
     "run folder (default results/runs/NAME-KEY); folder of compare's maps; file of a plot", NULL,
     offsetof(struct irb_cli, out)},
    {"--set", NULL, "KEY=VALUE", "override a config value: frames=4, reference.noise=0.02",
     set_override},
    {"--seed", NULL, "N", "run with this seed instead of the config's", set_seed},
    {"--only", NULL, "TRIAL", "run only this trial, or show it in a timeline (may be repeated)",
     set_only},
    {"--trial", NULL, "TRIAL", "report: show this trial's images in any case (may be repeated)",
     set_trial},
    {"--max-mb", NULL, "N", "report: megabytes that images may make the file (default 25)",
     set_max_mb},
    {"--stage", NULL, "STAGE", "prepare, render, score or all (default)", set_stage},
    {"--minutes", NULL, "N",
     "run, tradeoff: begin no new round (a pass with one seed) after N minutes but each scene's "
     "first, and one that is missing in any case",
     set_minutes},
    {"--keep", NULL, "WHICH", "images to keep: some (first, middle, worst, last) or all", set_keep},
    {"--debug-layers", NULL, NULL,
     "keep the methods' debug layers with the images; short for --set debug_layers=true",
     set_debug_layers},
    {"--backend", NULL, "NAME", "auto (default), osmesa, egl or null", set_backend},
    {"--shader-dir", NULL, "DIR", "read shaders from here instead of the binary", NULL,
     offsetof(struct irb_cli, shader_dir)},
    {"--module", NULL, "FILE.so", "load a method from a shared object", set_module},
    {"--threads", NULL, "N", "threads of reference and scoring (default: all cores)", set_threads},
    {"--format", NULL, "FORMAT",
     "of tables: text (default), csv, md, json or latex; of plots: svg (default), png or pdf", NULL,
     offsetof(struct irb_cli, format)},
    {"--per-seed", NULL, NULL, "tables: a row for each seed instead of means over the seeds",
     set_per_seed},
    {"--stages", NULL, NULL, "tables: the median time of every stage instead of the scores",
     set_stages},
    {"--statistics", NULL, NULL,
     "tables: the mean of every statistic that methods report instead of the scores",
     set_statistics},
    {"--frames", NULL, NULL,
     "tables: scores, times and statistics of every frame, as csv (default) or json", set_frames},
    {"--ratio", NULL, "TRIAL",
     "tables: every trial against this one: ratios with intervals from paired units", set_ratio},
    {"--figure", NULL, "KIND",
     "tables: the numbers behind a figure as csv: pareto, stages, timeline, convergence or flicker",
     set_figure},
    {"--time", NULL, "MS",
     "tradeoff: the time budget of a frame (default: three that all methods reach)", set_time},
    {"--error", NULL, "VALUE", "tradeoff: the error that is asked for (default: likewise)",
     set_error},
    {"--layer", NULL, "NAME", "compare: the EXR layer to read (default: plain R, G, B)", NULL,
     offsetof(struct irb_cli, layer)},
    {"--max", NULL, "METRIC=VALUE", "compare: exit status 1 when the metric is above", set_max},
    {"--min", NULL, "METRIC=VALUE", "compare: exit status 1 when the metric is below", set_min},
    {"--kind", NULL, "KIND", "plot: pareto, stages, timeline, convergence or flicker", NULL,
     offsetof(struct irb_cli, kind)},
    {"--scene", NULL, "NAME", "plot, table --figure: this scene alone (default: all)", NULL,
     offsetof(struct irb_cli, scene)},
    {"--metric", NULL, "NAME",
     "plot, tradeoff: indirect_flip, indirect_rmse, indirect_relmse or indirect_flicker; for "
     "tradeoff "
     "the short names do: flip (default), rmse, relmse, flicker",
     NULL, offsetof(struct irb_cli, metric)},
    {"--cost", NULL, "COST", "plot: pareto's cost, ms (default) or bytes", NULL,
     offsetof(struct irb_cli, cost)},
    {"--key", NULL, NULL, "reference: print the cache key of every frame and stop", set_key},
    {"--verbose", "-v", NULL, "say more", set_verbose},
    {"--json", NULL, NULL, "progress and messages on stderr as JSON lines, for programs", set_json},
    {"--quiet", "-q", NULL, "say nothing but errors", set_quiet},
    {NULL, NULL, NULL, NULL, NULL, 0},
};
enum { OPTION_COUNT = sizeof irb_cli_options / sizeof *irb_cli_options - 1 };

static void print_help(const struct irb_command *command)
{
    if (command) {
        printf("irbench %s %s\n\n%s\n%s\n", command->name, command->arguments, command->doc,
               command->help);
    } else {
        printf("irbench " IRB_VERSION ": compares many-light methods for interactive global "
               "illumination\n\nusage: irbench COMMAND [ARGUMENTS] [OPTIONS]\n\n");
        for (const struct irb_command *c = irb_commands; c->name; c++)
            printf("  %-10s %-14s %s\n", c->name, c->arguments, c->doc);
        printf("\nexamples:\n"
               "  irbench run experiments/quick.yaml\n"
               "  irbench table results/runs/quick-1a2b3c4d --format md\n"
               "  irbench show rsm\n"
               "  irbench help run\n");
    }
    printf("\noptions:\n");
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct irb_cli_option *o = &irb_cli_options[i];
        char left[64];
        snprintf(left, sizeof left, "%s%s%s%s%s", o->letter ? o->letter : "", o->letter ? ", " : "",
                 o->name, o->value ? " " : "", o->value ? o->value : "");
        printf("  %-22s %s\n", left, o->doc);
    }
    printf("  %-22s %s\n  %-22s %s\n", "-h, --help", "this, or a command's own help", "--version",
           "version and build");
    printf("\nexit status:\n");
#define X(name, status, doc) printf("  %3d  %s\n", status, doc);
    IRB_ERROR_CODES(X)
#undef X
}

static void print_version(void)
{
    printf("irbench " IRB_VERSION " (%s%s%s%s)\n", IRB_HAVE_OSMESA ? "osmesa " : "",
           IRB_HAVE_EGL ? "egl " : "", IRB_HAVE_REFERENCE ? "reference " : "",
           IRB_HAVE_IMAGES ? "images" : "");
}

static const struct irb_command *find_command(const char *name, struct irb_error *err)
{
    const char *names[32];
    size_t count = 0;
    for (const struct irb_command *c = irb_commands; c->name; c++) {
        if (!strcmp(c->name, name))
            return c;
        names[count++] = c->name;
    }
    const char *near = irb_nearest(name, names, count);
    irb_fail(err, IRB_E_USAGE, "unknown command '%s'%s%s%s; see irbench --help", name,
             near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    return NULL;
}

static bool set_value(struct irb_cli *cli, const struct irb_cli_option *option, const char *value,
                      struct irb_error *err)
{
    if (option->set)
        return option->set(cli, value, err);
    memcpy((char *)cli + option->text, &value, sizeof value);
    return true;
}

/* Applies argv[*index] as an option, taking its value from "--name=value" or the next argument. */
static bool apply_option(struct irb_cli *cli, int argc, char **argv, int *index,
                         struct irb_error *err)
{
    const char *word = argv[*index];
    const char *equals = strncmp(word, "--", 2) ? NULL : strchr(word, '=');
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const char *names[OPTION_COUNT];
    for (int i = 0; i < OPTION_COUNT; i++) {
        const struct irb_cli_option *o = &irb_cli_options[i];
        names[i] = o->name;
        bool is_long = strlen(o->name) == length && !strncmp(o->name, word, length);
        if (!is_long && !(o->letter && !strcmp(o->letter, word)))
            continue;
        if (!o->value)
            return equals ? irb_fail(err, IRB_E_USAGE, "%s takes no value", o->name)
                          : set_value(cli, o, NULL, err);
        if (equals)
            return set_value(cli, o, equals + 1, err);
        if (*index + 1 >= argc)
            return irb_fail(err, IRB_E_USAGE, "%s: expected %s, found nothing", o->name, o->value);
        return set_value(cli, o, argv[++*index], err);
    }
    const char *near = irb_nearest(word, names, OPTION_COUNT);
    return irb_fail(err, IRB_E_USAGE, "unknown option '%s'%s%s%s; see irbench --help", word,
                    near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
}

static bool check_arguments(const struct irb_cli *cli, const struct irb_command *command,
                            struct irb_error *err)
{
    if (cli->argument_count >= command->min_arguments &&
        cli->argument_count <= command->max_arguments)
        return true;
    return irb_fail(err, IRB_E_USAGE, "%s: expected %s, found %d argument%s; see irbench help %s",
                    command->name, *command->arguments ? command->arguments : "no argument",
                    cli->argument_count, cli->argument_count == 1 ? "" : "s", command->name);
}

static char *join_command_line(int argc, char **argv)
{
    struct irb_str line = {0};
    irb_str_printf(&line, "irbench");
    for (int i = 1; i < argc; i++)
        irb_str_printf(&line, " %s", argv[i]);
    return line.text;
}

bool irb_cli_parse(struct irb_cli *cli, int argc, char **argv, const struct irb_command **command,
                   struct irb_error *err)
{
    bool help = false;
    *command = NULL;
    cli->command_line = join_command_line(argc, argv);
    /* first of all, so that what is wrong with the rest is said in JSON too */
    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--json"))
            cli->log.json = true;
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--version")) {
            print_version();
            return true;
        }
        if (!strcmp(argv[i], "--help") || !strcmp(argv[i], "-h")) {
            help = true;
        } else if (argv[i][0] == '-' && argv[i][1]) {
            if (!apply_option(cli, argc, argv, &i, err))
                return false;
        } else if (!*command && !help && !strcmp(argv[i], "help")) {
            help = true;
        } else if (!*command) {
            if (!(*command = find_command(argv[i], err)))
                return false;
        } else if (cli->argument_count < IRB_CLI_MAX_ARGUMENTS) {
            cli->arguments[cli->argument_count++] = argv[i];
        }
    }
    if (help) {
        print_help(*command);
        *command = NULL;
        return true;
    }
    if (!*command)
        return irb_fail(err, IRB_E_USAGE, "expected a command; see irbench --help");
    return check_arguments(cli, *command, err);
}

void irb_cli_close(struct irb_cli *cli)
{
    free(cli->seed);
    free(cli->run_dir);
    free(cli->command_line);
    irb_registry_close(&cli->registry);
}
