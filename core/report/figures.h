/* SPDX-License-Identifier: MIT
 *
 * The numbers behind each figure, as CSV with one line a point. Empty where there is no value;
 * E_low and E_high are the ends of the 95 % interval (analysis.h). Everything is over the seeds of
 * a trial.
 *
 *     pareto       scene,method,trial,frame_ms,frame_ms_low,frame_ms_high,gl_bytes, then for each E
 *                  of indirect_flip, indirect_rmse, indirect_relmse, indirect_flicker:
 *                  E,E_low,E_high,E_front_ms,E_front_bytes (1 where the trial is on the front of
 *                  its scene by E and frame_ms, or gl_bytes)
 *     stages       scene,method,trial,stage,ms: mean over all frames, in the order in which they
 * run timeline     scene,method,trial,frame, the four E, frame_ms: means over seeds and repeats
 *     convergence  scene,method,family,parameter,x, then E,E_low,E_high for E of indirect_rmse,
 *                  indirect_flip. A family is all of a method's trials that differ in this one
 *                  number alone, two at least; ordered by x
 *     flicker      scene,method,trial,flicker,low,high,pop_share,temporal_flip,lag,
 *                  reference_flicker, of the indirect image
 */
#ifndef IRB_REPORT_FIGURES_H
#define IRB_REPORT_FIGURES_H

#include "core/base/str.h"
#include "core/report/analysis.h"

#include <stdio.h>

enum irb_figure {
    IRB_FIGURE_PARETO,
    IRB_FIGURE_STAGES,
    IRB_FIGURE_TIMELINE,
    IRB_FIGURE_CONVERGENCE,
    IRB_FIGURE_FLICKER
};
extern const char *const irb_figure_names[]; /* "pareto", ..., NULL */

/* IRB_E_USAGE names the figures there are. */
bool irb_figure_parse(const char *text, enum irb_figure *figure, struct irb_error *err);

/* scene: one alone; NULL for all. IRB_E_INPUT where the run has no trials or no such scene;
 * IRB_E_IO where `out` does not take it. */
bool irb_figure_csv(FILE *out, struct irb_store *store, enum irb_figure figure, const char *scene,
                    struct irb_error *err);
/* The same from what has been read, appended to out. */
bool irb_figure_text(const struct irb_analysis *analysis, enum irb_figure figure, const char *scene,
                     struct irb_str *out, struct irb_error *err);

#endif
