/* SPDX-License-Identifier: MIT
 *
 * What all trials of a scene share in a frame: G-buffer, reflective shadow map and direct light,
 * their times, and the files that scoring takes from them.
 */
#ifndef IRB_EXPERIMENT_RENDER_PASSES_H
#define IRB_EXPERIMENT_RENDER_PASSES_H

#include "core/experiment/stage.h"
#include "core/frame/direct.h"
#include "core/frame/rsm.h"
#include "core/gl/timer.h"

/* A reflective shadow map that methods are given. */
struct irb_passes_rsm {
    int resolution; /* texels a side */
    struct irb_rsm *rsm;
    bool shared; /* it is the passes' own, of the full layout */
    struct irb_timer *timer;
    double ms; /* of stage "rsm", in the frame rendered last */
};

struct irb_passes {
    struct irb_run *run; /* borrowed, and below; all else is owned */
    struct irb_sequence *sequence;
    struct irb_scene_gl *scene;
    struct irb_gbuffer *gbuffer;      /* full precision: direct light, masks */
    struct irb_rsm *rsm;              /* likewise, of the config's resolution */
    struct irb_gbuffer *slim_gbuffer; /* what methods get instead, NULL where they get the full */
    struct irb_passes_rsm *rsms;      /* one a resolution that trials have */
    int rsm_count;
    struct irb_direct *direct;
    struct irb_timer *timer;
    double ms[IRB_MAX_STAGES]; /* of the core's other stages, in the frame rendered last */
    bool *stored;              /* frames whose files have been seen to */
};

/* run and sequence are set, all else is zero. */
bool irb_passes_open(struct irb_passes *passes, struct irb_error *err);
void irb_passes_close(struct irb_passes *passes);

/* Settle frames are negative and equal frame 0. */
bool irb_passes_render(struct irb_passes *passes, int frame, struct irb_error *err);

/* The frame's direct light and, once a camera pose, the check against the reference's G-buffer,
 * whose mask is written; nothing where this has been done. */
bool irb_passes_store(struct irb_passes *passes, int frame, struct irb_error *err);

/* What methods are given; the RSM by the trial's resolution. */
const struct irb_gbuffer *irb_passes_gbuffer(const struct irb_passes *passes);
const struct irb_passes_rsm *irb_passes_rsm(const struct irb_passes *passes,
                                            const struct irb_trial *trial);

#endif
