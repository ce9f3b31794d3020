/* SPDX-License-Identifier: MIT
 *
 * Tables of stage times and of statistics: for people one table for each method of a scene, since
 * methods have stages of their own; for programs one in all.
 */
#ifndef IRB_REPORT_TABLE_MEASURES_H
#define IRB_REPORT_TABLE_MEASURES_H

#include "core/base/str.h"
#include "core/report/table.h"
#include "core/report/table_data.h"

/* options->subject is IRB_TABLE_STAGES or IRB_TABLE_STATISTICS. */
void irb_table_measures(const struct irb_table_data *data, const struct irb_table_options *options,
                        struct irb_str *out);

#endif
