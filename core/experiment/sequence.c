/* SPDX-License-Identifier: MIT */
#include "core/experiment/sequence.h"

#include <stdlib.h>
#include <string.h>

bool irb_sequence_open(struct irb_sequence *sequence, const struct irb_config *config,
                       const struct irb_scene_entry *entry, struct irb_log *log,
                       struct irb_error *err)
{
    *sequence = (struct irb_sequence){.entry = entry, .frame_count = config->render.frames};
    sequence->scene = irb_scene_load(entry->source, log, err);
    if (!sequence->scene)
        return false;
    sequence->scene_key = irb_scene_key(sequence->scene);
    sequence->frames = calloc((size_t)sequence->frame_count, sizeof *sequence->frames);
    if (!sequence->frames) {
        irb_sequence_close(sequence);
        return irb_fail(err, IRB_E_MEMORY, "%s: no memory for %d frames", entry->name,
                        config->render.frames);
    }
    for (int i = 0; i < sequence->frame_count; i++) {
        struct irb_sequence_frame *frame = &sequence->frames[i];
        irb_animation_light(&entry->animation, sequence->scene, (float)i, &frame->light);
        irb_animation_camera(&entry->animation, sequence->scene, (float)i, &frame->camera);
    }
    return true;
}

void irb_sequence_close(struct irb_sequence *sequence)
{
    irb_scene_destroy(sequence->scene);
    free(sequence->frames);
    *sequence = (struct irb_sequence){0};
}

static struct irb_key camera_key(const struct irb_camera *camera)
{
    struct irb_hash *hash = irb_hash_create();
    irb_camera_hash(camera, hash);
    return irb_hash_finish(hash);
}

bool irb_sequence_same_camera(const struct irb_sequence *sequence, int frame)
{
    if (frame == 0)
        return false;
    struct irb_key now = camera_key(&sequence->frames[frame].camera);
    struct irb_key before = camera_key(&sequence->frames[frame - 1].camera);
    return !strcmp(now.hex, before.hex);
}
