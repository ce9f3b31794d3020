/* SPDX-License-Identifier: MIT
 *
 * A table for papers: LaTeX with the package booktabs, one `table` a scene.
 */
#ifndef IRB_REPORT_TABLE_LATEX_H
#define IRB_REPORT_TABLE_LATEX_H

#include "core/base/str.h"
#include "core/report/table_data.h"

void irb_table_latex(const struct irb_table_data *data, struct irb_str *out);

/* Appends text so that LaTeX prints it as it is, on one line. */
void irb_latex_text(struct irb_str *out, const char *text);
/* "1.20e-05" as 1.20 \times 10^{-5}, for math mode. */
void irb_latex_number(struct irb_str *out, const char *number);
/* Each line a comment. */
void irb_latex_comment(struct irb_str *out, const char *text);
/* What stands before the first table. */
void irb_latex_begin(struct irb_str *out, const struct irb_table_data *data);

#endif
