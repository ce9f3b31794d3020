/* SPDX-License-Identifier: MIT
 *
 * What equal time and equal error look like: for each scene one picture of a row of images and,
 * below each, its error. From the left: the reference, then each method in the order in which the
 * run has them, with its measured trial within the middle one of the budgets (tradeoff.h). Above is
 * the indirect image at the scene's preview exposure, below HDR-FLIP in false colour (0 black, 1
 * pale yellow); black where the method has no trial within the budget. The frame is the middle one
 * of the sequence, of the trial's first seed.
 */
#ifndef IRB_REPORT_TRADEOFF_IMAGES_H
#define IRB_REPORT_TRADEOFF_IMAGES_H

#include "core/report/tradeoff.h"

/* Writes FOLDER/SCENE-equal-time.png and SCENE-equal-error.png from what RUN has kept, and appends
 * Markdown that shows them and names their columns. Scenes without the images, and builds without
 * OpenImageIO, have none. IRB_E_INPUT where a kept image is damaged; IRB_E_IO. */
bool irb_tradeoff_images(const char *folder, const char *run_dir, struct irb_store *store,
                         const struct irb_analysis *analysis,
                         const struct irb_tradeoff_options *options, struct irb_str *markdown,
                         struct irb_error *err);

#endif
