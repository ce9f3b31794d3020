/* SPDX-License-Identifier: MIT
 *
 * One scene of an experiment under its script: the loaded scene and, for every frame, light and
 * camera as plain values, and where the objects and their vertices are.
 */
#ifndef IRB_EXPERIMENT_SEQUENCE_H
#define IRB_EXPERIMENT_SEQUENCE_H

#include "core/config/config.h"
#include "core/score/reproject.h"

struct irb_sequence_frame {
    struct irb_light light;
    struct irb_camera camera;
    struct irb_key scene;              /* of the scene as this frame has its objects and vertices */
    struct irb_key gbuffer, reference; /* set by prepare; "" before */
};

struct irb_sequence {
    const struct irb_scene_entry *entry; /* borrowed */
    struct irb_scene *scene;             /* owned; in the pose that was asked for last */
    struct irb_sequence_frame *frames;   /* owned */
    int frame_count;
    bool moves; /* objects, or their vertices, differ between frames */
};

/* Names in the config that the scene does not have (a light, a camera, an object) give IRB_E_INPUT
 * with the config's line and what there is. */
bool irb_sequence_open(struct irb_sequence *sequence, const struct irb_config *config,
                       const struct irb_scene_entry *entry, struct irb_log *log,
                       struct irb_error *err);
void irb_sequence_close(struct irb_sequence *sequence);

/* Puts the scene's objects and vertices where frame `frame` has them; settle frames are negative
 * and equal frame 0. Errors as of irb_scene_animate(). */
bool irb_sequence_pose(struct irb_sequence *sequence, int frame, struct irb_error *err);

/* Whether frame `frame` shows what the frame before it does: by the same camera, with all objects
 * in the same place. The light may differ. */
bool irb_sequence_same_view(const struct irb_sequence *sequence, int frame);
/* Whether all objects are where they were in the frame before, in the shape that they had. */
bool irb_sequence_same_pose(const struct irb_sequence *sequence, int frame);
/* The objects that are not where they were in the frame before (frame > 0), or not in that shape;
 * the box of one that deforms takes in both shapes. Malloc'ed, NULL where there are none. Leaves
 * the scene in the pose of `frame`. Errors as above. */
bool irb_sequence_moved(struct irb_sequence *sequence, int frame, struct irb_moved_object **moved,
                        int *count, struct irb_error *err);

#endif
