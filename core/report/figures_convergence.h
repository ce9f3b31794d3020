/* SPDX-License-Identifier: MIT
 *
 * The figure of convergence: error over each number that a method's trials differ in alone. For
 * core/report only.
 */
#ifndef IRB_REPORT_FIGURES_CONVERGENCE_H
#define IRB_REPORT_FIGURES_CONVERGENCE_H

#include "core/base/str.h"
#include "core/report/analysis.h"

/* As the lines of figures.h. A family bears the name of its trials without the parameter. */
void irb_convergence_titles(struct irb_str *out);
void irb_convergence_lines(const struct irb_analysis *analysis,
                           const struct irb_analysis_scene *scene, struct irb_str *out);

#endif
