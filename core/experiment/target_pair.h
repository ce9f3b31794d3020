/* SPDX-License-Identifier: MIT
 *
 * The target of a frame with that of the frame before it, and how the surfaces of one moved into
 * the other: what everything that is scored between two frames needs. In a loop over frames each
 * target is read once.
 */
#ifndef IRB_EXPERIMENT_TARGET_PAIR_H
#define IRB_EXPERIMENT_TARGET_PAIR_H

#include "core/experiment/target.h"
#include "core/score/reproject.h"

struct irb_target_pair {
    int frame;                          /* of `target`; -1 where nothing is loaded */
    struct irb_target target, previous; /* previous is empty in frame 0; owned */
    struct irb_reprojection motion;     /* source NULL in frame 0 and while the view rests; owned */
};
#define IRB_TARGET_PAIR_NONE ((struct irb_target_pair){.frame = -1})

/* Moves on to `frame`. *pair is to be destroyed after a failure too. */
bool irb_target_pair_load(struct irb_target_pair *pair, const struct irb_run *run,
                          struct irb_sequence *sequence,
                          const struct irb_target_constants *constants, int frame,
                          struct irb_error *err);
void irb_target_pair_destroy(struct irb_target_pair *pair);

/* NULL while the view rests. */
static inline const struct irb_reprojection *irb_target_motion(const struct irb_target_pair *pair)
{
    return pair->motion.source ? &pair->motion : NULL;
}

#endif
