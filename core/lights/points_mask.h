/* SPDX-License-Identifier: MIT
 *
 * Alpha masks at points of the scene: the texture's finest level, bilinear, repeated, as the
 * G-buffer, the RSM and the reference see it.
 */
#ifndef IRB_LIGHTS_POINTS_MASK_H
#define IRB_LIGHTS_POINTS_MASK_H

#include "core/scene/scene.h"

/* Of one triangle. */
struct irb_points_mask {
    float cutoff;                            /* 0: nothing is cut away */
    const struct irb_scene_texture *texture; /* borrowed; NULL: alpha is 1 */
    const float *texcoords[3];               /* of its corners; borrowed */
};

struct irb_points_mask irb_points_mask(const struct irb_scene *scene,
                                       const struct irb_object *object, uint32_t triangle);
/* Weights of corners 1 and 2 in 1/65535. */
bool irb_points_mask_cuts(const struct irb_points_mask *mask, unsigned u, unsigned v);

#endif
