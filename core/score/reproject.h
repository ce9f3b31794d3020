/* SPDX-License-Identifier: MIT
 *
 * Where a pixel's surface was in the previous frame: the temporal residual under camera and object
 * motion compares the same surface at rest, and leaves disocclusions and what moved out.
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

/* An object whose transform, or whose vertices, differ between the two frames. */
struct irb_moved_object {
    float low[3], high[3]; /* bounds of its vertices in both frames before the transforms, m */
    double to_rest[2][16]; /* world -> before the transform in the previous and the current frame;
                              column-major */
    bool visible[2];       /* false: flattened there, and the matrix means nothing */
};

/* A pixel is found again when the previous frame's nearest pixel shows a point within 1 % of its
 * distance to the camera and a normal within 25 degrees (source: ours). Pixels that lie in the box
 * of a moved object, in either frame, are left out: all of the object's own, however slowly it
 * moves, and the few of other surfaces that reach into its box. */
bool irb_reproject(struct irb_reprojection *out, const struct irb_gbuffer_image *current,
                   const struct irb_gbuffer_image *previous,
                   const struct irb_camera *previous_camera, const struct irb_moved_object *moved,
                   int moved_count, struct irb_error *err);

/* Sets `out` for the transform of the previous and of the current frame, and bounds before them. */
void irb_moved_object_set(struct irb_moved_object *out, const float previous[16],
                          const float current[16], const float low[3], const float high[3]);
void irb_reprojection_destroy(struct irb_reprojection *reprojection);

/* warped[i] = image[source[i]], 0 where there is none; created. */
bool irb_reprojection_apply(const struct irb_reprojection *reprojection,
                            const struct irb_image *image, struct irb_image *warped,
                            struct irb_error *err);

#endif
