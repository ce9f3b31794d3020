/* SPDX-License-Identifier: MIT */
#include "core/cli/cli.h"
#include "core/experiment/run.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

/* The one piece of state that a signal handler can reach. */
static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    stop_requested = 1;
    signal(signal_number, SIG_DFL); /* a second Ctrl-C ends the program at once */
}

int main(int argc, char **argv)
{
    struct irb_cli cli = {.time_ms = NAN,
                          .error_most = NAN,
                          .log = irb_log_default(),
                          .stages = IRB_STAGE_ALL,
                          .stop = &stop_requested};
    struct irb_error err = {0};
    const struct irb_command *command = NULL;
    signal(SIGINT, request_stop);
    signal(SIGTERM, request_stop);
#ifdef SIGXFSZ
    signal(SIGXFSZ, SIG_IGN); /* a file size limit is a write error like a full disk */
#endif
    irb_registry_init(&cli.registry);
    bool ok = irb_cli_parse(&cli, argc, argv, &command, &err);
    if (ok && command)
        ok = command->run(&cli, &err);
    if (ok && fflush(stdout))
        ok = irb_fail(&err, IRB_E_IO, "standard output: cannot write");
    irb_log_progress_done(&cli.log);
    if (!ok)
        irb_log_error(&cli.log, &err);
    else if (command)
        irb_log_done(&cli.log, cli.run_dir);
    int status = ok ? 0 : irb_error_status(err.code);
    irb_cli_close(&cli);
    return status;
}
