/* SPDX-License-Identifier: MIT
 *
 * Where a number comes from: stored with every run.
 */
#ifndef IRB_EXPERIMENT_PROVENANCE_H
#define IRB_EXPERIMENT_PROVENANCE_H

#include "core/experiment/stage.h"

/* Version, git commit, config key and text, command line, CPU, threads, date. */
bool irb_provenance_store_host(struct irb_run *run, struct irb_error *err);
/* GL vendor, renderer, version, platform; shader hash: of the stage that renders. IRB_E_USAGE where
 * the run holds frames of another. */
bool irb_provenance_store_gl(struct irb_run *run, struct irb_error *err);
/* The order of the stages that a method's frames are timed in, as method/NAME/stages: tables list
 * them so. */
bool irb_provenance_store_stages(struct irb_run *run, const struct irb_method *method,
                                 struct irb_error *err);
/* Seconds by kind of work, of this process. */
bool irb_provenance_store_seconds(struct irb_run *run, struct irb_error *err);

#endif
