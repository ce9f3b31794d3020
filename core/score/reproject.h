/* SPDX-License-Identifier: MIT
 *
 * Where a pixel's surface was in the previous frame: the temporal residual under camera motion
 * compares the same surface, and leaves disocclusions out.
 */
#ifndef IRB_SCORE_REPROJECT_H
#define IRB_SCORE_REPROJECT_H

#include "core/frame/gbuffer.h"
#include "core/scene/light.h"

#include <stdint.h>

struct irb_reprojection {
    int width, height;
    int32_t *source; /* per pixel: index of the pixel of the previous frame, -1 where it was hidden,
                        outside, or has no geometry; owned */
};

/* Static geometry. A pixel is found again when the previous frame's nearest pixel shows a point
 * within 1 % of its distance to the camera and a normal within 25 degrees (source: ours). */
bool irb_reproject(struct irb_reprojection *out, const struct irb_gbuffer_image *current,
                   const struct irb_gbuffer_image *previous,
                   const struct irb_camera *previous_camera, struct irb_error *err);
void irb_reprojection_destroy(struct irb_reprojection *reprojection);

/* warped[i] = image[source[i]], 0 where there is none; created. */
bool irb_reprojection_apply(const struct irb_reprojection *reprojection,
                            const struct irb_image *image, struct irb_image *warped,
                            struct irb_error *err);

#endif
