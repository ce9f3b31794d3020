/* SPDX-License-Identifier: MIT
 *
 * The units of a trial's metrics, and what they say of one trial or of two: see analysis.h, whose
 * rules these are. For core/report only.
 */
#ifndef IRB_REPORT_ANALYSIS_UNITS_H
#define IRB_REPORT_ANALYSIS_UNITS_H

#include "core/report/analysis.h"

/* Mean over the seeds that have a value, as the tables take it (of frame_ms_worst the largest). */
double irb_trial_value(const struct irb_analysis_trial *trial, int metric);

/* The trial's value with its interval, the reference's noise carried in. */
struct irb_measure irb_trial_measure(const struct irb_analysis_trial *trial, int metric,
                                     double confidence);

/* Whether the metric is not above what the reference's own noise makes of it. */
bool irb_trial_at_noise(const struct irb_analysis_trial *trial, int metric);

/* The reference's noise in the metric's own unit; NaN where another metric's decides, or none. */
double irb_trial_noise(const struct irb_analysis_trial *trial, int metric);

/* Values of a metric of one trial, or of two trials in pairs. */
struct irb_paired {
    enum irb_unit unit;
    double *of[2];  /* owned; the same one by one */
    double mean[2]; /* over the seeds that all have: the values of which the ratio is shown */
    int count;
    bool squares; /* units are squares of what the metric measures */
};
/* b may be NULL. Free with irb_paired_free. */
struct irb_paired irb_paired_units(const struct irb_analysis_trial *a,
                                   const struct irb_analysis_trial *b, int metric);
void irb_paired_free(struct irb_paired *paired);

#endif
