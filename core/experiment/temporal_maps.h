/* SPDX-License-Identifier: MIT
 *
 * Pictures of a whole sequence of the indirect image, one set a trial. Made from the frame files in
 * a pass of its own, before keep removes them.
 *
 *     profile.exr  one row of the image (scene/NAME/profile_row) in every frame, the first on top:
 *                  layers result and reference
 *     profile.png  the same: result to the left, reference to the right
 *     flicker.exr  layers flicker (root of the mean square of |e_t - e_(t-1)| / mean reference over
 *                  the sequence), pops (how often it was one) and pairs (of so many frames)
 *     flicker.png  the first in false colour: black is 0, the palest yellow is
 *                  IRB_FLICKER_PICTURE_END and above
 */
#ifndef IRB_EXPERIMENT_TEMPORAL_MAPS_H
#define IRB_EXPERIMENT_TEMPORAL_MAPS_H

#include "core/experiment/keep.h"

#define IRB_FLICKER_PICTURE_END 0.5 /* one scale for all trials, to be compared; source: ours */

/* Writes what is not there yet, of every trial that has all its frame files. */
bool irb_temporal_maps_write(const struct irb_keep *keep, struct irb_error *err);

#endif
