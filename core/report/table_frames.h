/* SPDX-License-Identifier: MIT
 *
 * The table of frames: a time series of every score, stage time and statistic, for plots.
 */
#ifndef IRB_REPORT_TABLE_FRAMES_H
#define IRB_REPORT_TABLE_FRAMES_H

#include "core/base/str.h"
#include "core/report/table.h"

/* format: csv or json. Rows are in the order of the store's trials, frames >= 0 that have any
 * value; each seed has rows of its own. Columns are in the order of the full table, statistics
 * last. */
bool irb_table_frames(struct irb_store *store, enum irb_table_format format, struct irb_str *out,
                      struct irb_error *err);

#endif
