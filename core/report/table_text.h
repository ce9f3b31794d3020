/* SPDX-License-Identifier: MIT
 *
 * Tables for people: the metrics that matter most, for a terminal or as Markdown.
 */
#ifndef IRB_REPORT_TABLE_TEXT_H
#define IRB_REPORT_TABLE_TEXT_H

#include "core/base/str.h"
#include "core/report/table_data.h"

void irb_table_text(const struct irb_table_data *data, bool colour, struct irb_str *out);
void irb_table_markdown(const struct irb_table_data *data, struct irb_str *out);

#endif
