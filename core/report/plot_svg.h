/* SPDX-License-Identifier: MIT
 *
 * What is done to gnuplot's SVG before anybody sees it.
 */
#ifndef IRB_REPORT_PLOT_SVG_H
#define IRB_REPORT_PLOT_SVG_H

#include <stdbool.h>

/* Gives every id, and every reference to one, the prefix "ID_", so that several figures can stand
 * in one page. Where `inlined`, the text begins with "<svg", has no background, and what was black
 * has the colour of the text around it (currentColor), so that it suits light and dark pages.
 * malloc'ed.
 */
char *irb_plot_svg_tidy(const char *svg, const char *id, bool inlined);

#endif
