/* SPDX-License-Identifier: MIT
 *
 * The command report: a run as one HTML file.
 */
#include "core/base/str.h"
#include "core/cli/cli.h"
#include "core/report/html.h"

#include <stdlib.h>

bool irb_command_report(struct irb_cli *cli, struct irb_error *err)
{
    const char *run = cli->arguments[0];
    const struct irb_html_options options = {
        .trials = cli->trials,
        .trial_count = cli->trial_count,
        .max_mb = cli->max_mb > 0 ? cli->max_mb : IRB_HTML_MAX_MB,
        .version = IRB_VERSION,
        .log = &cli->log,
    };
    char *path = cli->out ? irb_strdup(cli->out) : irb_asprintf("%s/report.html", run);
    bool ok = irb_html_write(run, path, &options, err);
    if (ok)
        irb_info(&cli->log, "report: %s", path);
    free(path);
    return ok;
}
