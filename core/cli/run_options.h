/* SPDX-License-Identifier: MIT
 *
 * What the command line says of a run, as its options.
 */
#ifndef IRB_CLI_RUN_OPTIONS_H
#define IRB_CLI_RUN_OPTIONS_H

#include "core/cli/cli.h"
#include "core/experiment/run.h"

/* Borrows from cli. */
struct irb_run_options irb_cli_run_options(struct irb_cli *cli);

#endif
