/* SPDX-License-Identifier: MIT */
#include "core/experiment/target_pair.h"

#include <stdlib.h>

/* How the previous frame's surfaces moved into this one's. */
static bool find_motion(struct irb_target_pair *pair, struct irb_sequence *sequence,
                        struct irb_error *err)
{
    struct irb_moved_object *moved = NULL;
    int count = 0;
    if (!irb_sequence_moved(sequence, pair->frame, &moved, &count, err))
        return false;
    bool ok = irb_reproject(&pair->motion, &pair->target.gbuffer, &pair->previous.gbuffer,
                            &sequence->frames[pair->frame - 1].camera, moved, count, err);
    free(moved);
    return ok;
}

/* `previous` becomes that of frame - 1, `target` is empty. */
static bool step(struct irb_target_pair *pair, const struct irb_run *run,
                 const struct irb_sequence *sequence, const struct irb_target_constants *constants,
                 int frame, struct irb_error *err)
{
    irb_reprojection_destroy(&pair->motion);
    irb_target_unprepare(&pair->target);
    irb_target_destroy(&pair->previous);
    if (frame > 0 && pair->frame == frame - 1) {
        pair->previous = pair->target; /* moved */
        pair->target = (struct irb_target){0};
        return true;
    }
    irb_target_destroy(&pair->target);
    return frame == 0 || irb_target_load(&pair->previous, run, sequence, frame - 1, constants, err);
}

bool irb_target_pair_load(struct irb_target_pair *pair, const struct irb_run *run,
                          struct irb_sequence *sequence,
                          const struct irb_target_constants *constants, int frame,
                          struct irb_error *err)
{
    if (pair->frame == frame)
        return true;
    bool ok = step(pair, run, sequence, constants, frame, err);
    pair->frame = -1;
    if (!ok || !irb_target_load(&pair->target, run, sequence, frame, constants, err))
        return false;
    pair->frame = frame;
    return frame == 0 || irb_sequence_same_view(sequence, frame) ||
           find_motion(pair, sequence, err);
}

void irb_target_pair_destroy(struct irb_target_pair *pair)
{
    irb_reprojection_destroy(&pair->motion);
    irb_target_destroy(&pair->target);
    irb_target_destroy(&pair->previous);
    pair->frame = -1;
}
