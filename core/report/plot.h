/* SPDX-License-Identifier: MIT
 *
 * The figures of a run (core/report/figures.h), drawn by gnuplot with the scripts of plots/.
 */
#ifndef IRB_REPORT_PLOT_H
#define IRB_REPORT_PLOT_H

#include "core/report/figures.h"

extern const char *const irb_plot_format_names[]; /* "svg", "png", "pdf", NULL */

/* All may be NULL. */
struct irb_plot_options {
    const char *scene;  /* NULL = a panel a scene */
    const char *metric; /* NULL = the script's own choice */
    const char *cost;   /* pareto: "ms" (default) or "bytes" */
    const char *trials; /* timeline: names with blanks between; NULL = the best of each method */
};

/* Whether there is such a plot; IRB_E_USAGE names the formats, metrics or costs that there are. */
bool irb_plot_check(enum irb_figure figure, const char *format,
                    const struct irb_plot_options *options, struct irb_error *err);

/* Writes the figure to out_path, whole or not at all. IRB_E_INPUT where there is no gnuplot or
 * nothing to draw, IRB_E_IO for the file. `options` may be NULL. */
bool irb_plot(const struct irb_analysis *analysis, enum irb_figure figure, const char *format,
              const struct irb_plot_options *options, const char *out_path, struct irb_error *err);

/* The figure as an SVG element for an HTML page, malloc'ed, the caller's: its ids are its own, it
 * has no background and no size but its viewBox, and its ink is currentColor, so that it suits
 * light and dark pages. */
char *irb_plot_svg(const struct irb_analysis *analysis, enum irb_figure figure,
                   const struct irb_plot_options *options, struct irb_error *err);

#endif
