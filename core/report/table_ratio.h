/* SPDX-License-Identifier: MIT
 *
 * Every trial against one: ratios of the metrics that decide, from paired units (analysis.h).
 *
 * text, md and latex have "0.83 [0.79, 0.88]", "~ 0.98 [0.93, 1.04]" where the interval contains 1,
 * "0.50 exact" where it has no width, in brackets where one of both errors is not above the
 * reference's own noise. csv and json have scene, method, trial, against, then METRIC_ratio, _low,
 * _high, _unit and _distinguishable (1, 0, or nothing where there is no interval).
 */
#ifndef IRB_REPORT_TABLE_RATIO_H
#define IRB_REPORT_TABLE_RATIO_H

#include "core/base/str.h"
#include "core/report/analysis.h"
#include "core/report/table.h"

/* options->against names the trial; scenes without it are left out. IRB_E_USAGE where no scene has
 * it, with the nearest name; IRB_E_INPUT where the run has no trials. */
bool irb_table_ratio(struct irb_store *store, const struct irb_table_options *options,
                     struct irb_str *out, struct irb_error *err);

#endif
