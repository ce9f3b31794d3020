/* SPDX-License-Identifier: MIT
 *
 * The report of a run: one HTML file that needs nothing else, neither a network nor other files.
 * It holds the answers at a glance, the table with intervals, the figures (core/report/plot.h), a
 * viewer with the run's film (core/experiment/film.h), and where the numbers come from. Page,
 * style and script are core/report/web/, embedded in the binary.
 */
#ifndef IRB_REPORT_HTML_H
#define IRB_REPORT_HTML_H

#include "core/base/error.h"
#include "core/base/log.h"

#define IRB_HTML_MAX_MB 25.0 /* decimal megabytes: opens within two seconds */

struct irb_html_options {
    const char *const *trials; /* whose images are wanted in any case; names */
    int trial_count;
    double max_mb;       /* size that images must not drive the file beyond */
    const char *version; /* of the program */
    struct irb_log *log; /* warnings: what is left out; may be NULL */
};

/* Writes the report of the run folder to `path`, whole or not at all. Equal runs give equal files.
 * IRB_E_INPUT for a folder that is no run or a trial that the run has not, IRB_E_IO for the file. A
 * figure that cannot be drawn or an image that is not there is said in the page and no error. */
bool irb_html_write(const char *run_dir, const char *path, const struct irb_html_options *options,
                    struct irb_error *err);

#endif
