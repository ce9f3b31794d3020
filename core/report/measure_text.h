/* SPDX-License-Identifier: MIT
 *
 * How a value with its interval is printed for people.
 */
#ifndef IRB_REPORT_MEASURE_TEXT_H
#define IRB_REPORT_MEASURE_TEXT_H

#include "core/base/str.h"
#include "core/report/analysis.h"

/* "0.173 [0.170, 0.178]"; the value alone where there is no interval or both ends are the value (of
 * memory, or in all blocks: exact); "-" where there is no value. 3 significant digits; bytes as
 * "12.3 MiB". */
void irb_measure_text(struct irb_str *out, const struct irb_measure *measure, int metric);
/* A value of the metric alone, with its unit: "36.6 ms", "0.173". */
void irb_metric_text(struct irb_str *out, int metric, double value);
/* "0.83 [0.79, 0.88]", "~ 0.98 [0.93, 1.04]" where the interval contains 1; "0.50 exact" and
 * "~ 1.00 exact" where both ends are the value; the value alone where there is no interval. */
void irb_ratio_text(struct irb_str *out, const struct irb_measure *ratio);

#endif
