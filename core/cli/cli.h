/* SPDX-License-Identifier: MIT
 *
 * The command line: `irbench [OPTIONS] COMMAND [ARGUMENTS]`. One function a command; the table of
 * commands in main.c gives usage and examples.
 */
#ifndef IRB_CLI_CLI_H
#define IRB_CLI_CLI_H

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/gl/context.h"
#include "core/report/table.h"
#include "methods/registry.h"

#include <signal.h>

enum { IRB_CLI_MAX_ARGUMENTS = 32 };

/* A bound on a metric: --max METRIC=VALUE or --min. */
struct irb_cli_bound {
    const char *text;
    bool most;
};

/* What the options said; positional arguments without the command's name. */
struct irb_cli {
    const char *arguments[IRB_CLI_MAX_ARGUMENTS];
    int argument_count;
    const char *overrides[IRB_CLI_MAX_ARGUMENTS + 1]; /* --set and its like, NULL-terminated */
    int override_count;
    const char *only[IRB_CLI_MAX_ARGUMENTS]; /* --only, trial names */
    int only_count;
    const char *trials[IRB_CLI_MAX_ARGUMENTS]; /* --trial, names */
    int trial_count;
    double max_mb; /* --max-mb, 0 = default */
    char *seed;    /* owned: the override that --seed became */
    struct irb_cli_bound bounds[IRB_CLI_MAX_ARGUMENTS];
    int bound_count;
    const char *layer;                        /* --layer */
    const char *kind, *scene, *metric, *cost; /* --kind, ...: of plot, tradeoff; NULL = default */
    const char *out;                          /* --out, NULL = default */
    const char *shader_dir;                   /* --shader-dir */
    const char *format;                       /* --format, NULL = text */
    enum irb_backend backend;
    int threads;     /* --threads, 0 = all cores */
    unsigned stages; /* --stage, all by default */
    double minutes;  /* --minutes, 0 = no limit */
    bool keep_all, key;
    bool per_seed;                  /* --per-seed */
    enum irb_table_subject subject; /* --stages, --statistics, --frames, --ratio */
    const char *against;            /* --ratio, NULL = none */
    double time_ms, error_most;     /* --time, --error; NaN = none */
    const char *figure;             /* --figure, NULL = none */
    char *run_dir;                  /* owned: where a command has left results, else NULL */
    char *command_line;             /* owned: as it was given, for provenance */
    struct irb_log log;
    struct irb_registry registry;
    const volatile sig_atomic_t *stop;
};

typedef bool (*irb_command_fn)(struct irb_cli *cli, struct irb_error *err);

bool irb_command_run(struct irb_cli *cli, struct irb_error *err);
bool irb_command_table(struct irb_cli *cli, struct irb_error *err);
bool irb_command_tradeoff(struct irb_cli *cli, struct irb_error *err);
bool irb_command_reference(struct irb_cli *cli, struct irb_error *err);
bool irb_command_list(struct irb_cli *cli, struct irb_error *err);
bool irb_command_show(struct irb_cli *cli, struct irb_error *err);
bool irb_command_docs(struct irb_cli *cli, struct irb_error *err);
bool irb_command_inspect(struct irb_cli *cli, struct irb_error *err);
bool irb_command_plot(struct irb_cli *cli, struct irb_error *err);
bool irb_command_report(struct irb_cli *cli, struct irb_error *err);
bool irb_command_compare(struct irb_cli *cli, struct irb_error *err);
bool irb_command_export_scene(struct irb_cli *cli, struct irb_error *err);
bool irb_command_doctor(struct irb_cli *cli, struct irb_error *err);

struct irb_command {
    const char *name;
    const char *arguments; /* "CONFIG" */
    int min_arguments, max_arguments;
    const char *doc;  /* one line */
    const char *help; /* details and examples */
    irb_command_fn run;
};
extern const struct irb_command irb_commands[]; /* ended by a NULL name */

struct irb_cli_option {
    const char *name, *letter; /* "--out", "-o" or NULL */
    const char *value;         /* name of the value, NULL for a switch */
    const char *doc;           /* one line */
    bool (*set)(struct irb_cli *cli, const char *value, struct irb_error *err);
    size_t text; /* where set is NULL: the offset of the text in struct irb_cli that it is */
};
extern const struct irb_cli_option irb_cli_options[]; /* ended by a NULL name */

/* Parses argv after the program's name. *command is NULL when help or version was printed. */
bool irb_cli_parse(struct irb_cli *cli, int argc, char **argv, const struct irb_command **command,
                   struct irb_error *err);
void irb_cli_close(struct irb_cli *cli);

#endif
