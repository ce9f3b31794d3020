/* SPDX-License-Identifier: MIT
 *
 * One scene of an experiment under its script: the loaded scene and, for every frame, light and
 * camera as plain values.
 */
#ifndef IRB_EXPERIMENT_SEQUENCE_H
#define IRB_EXPERIMENT_SEQUENCE_H

#include "core/experiment/config.h"

struct irb_sequence_frame {
    struct irb_light light;
    struct irb_camera camera;
    struct irb_key gbuffer, reference; /* set by prepare; "" before */
};

struct irb_sequence {
    const struct irb_scene_entry *entry; /* borrowed */
    struct irb_scene *scene;             /* owned */
    struct irb_key scene_key;
    struct irb_sequence_frame *frames;   /* owned */
    int frame_count;
};

bool irb_sequence_open(struct irb_sequence *sequence, const struct irb_config *config,
                       const struct irb_scene_entry *entry, struct irb_log *log,
                       struct irb_error *err);
void irb_sequence_close(struct irb_sequence *sequence);

/* Whether frame `frame` is seen by the same camera as the frame before it. */
bool irb_sequence_same_camera(const struct irb_sequence *sequence, int frame);

#endif
