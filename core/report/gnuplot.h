/* SPDX-License-Identifier: MIT
 *
 * Runs gnuplot on one of the scripts of plots/, which the binary carries, in a temporary folder
 * that is gone afterwards. No shell is involved, and names in the data reach gnuplot as data.
 */
#ifndef IRB_REPORT_GNUPLOT_H
#define IRB_REPORT_GNUPLOT_H

#include "core/base/embedded.h"
#include "core/base/error.h"

#include <stddef.h>

/* Made by embed.py from plots/, sorted by path. */
extern const struct irb_embedded_file irb_plot_files[];
extern const size_t irb_plot_files_count;

/* A variable that the script finds set. */
struct irb_gnuplot_variable {
    const char *name;
    const char *value; /* any text; NULL = not set */
};

/* Runs plots/SCRIPT.gp on `csv` (as irb_figure_csv() writes it) for a file in `format` ("svg",
 * "png", "pdf"). *out is malloc'ed, zero-terminated, the caller's. IRB_E_INPUT where there is no
 * gnuplot, or with what it says where it fails; IRB_E_IO for the temporary folder, which is in
 * $TMPDIR, else /tmp. */
bool irb_gnuplot(const char *script, const char *csv, const char *format,
                 const struct irb_gnuplot_variable *variables, int count, char **out, size_t *size,
                 struct irb_error *err);

#endif
