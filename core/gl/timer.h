/* SPDX-License-Identifier: MIT
 *
 * Time per stage of a frame. On hardware by GL_TIME_ELAPSED queries; on a software rasteriser,
 * where those are wrong, by glFinish and the monotonic clock round each stage.
 */
#ifndef IRB_GL_TIMER_H
#define IRB_GL_TIMER_H

#include "core/gl/context.h"

enum { IRB_MAX_STAGES = 32 };

struct irb_timer;

/* "gl-query" or "finish+clock": stored with every number. */
const char *irb_timer_clock(const struct irb_timer *timer);

struct irb_timer *irb_timer_create(struct irb_gl *gl, struct irb_error *err);
void irb_timer_destroy(struct irb_timer *timer);

/* Begin and end stage `stage` (0..IRB_MAX_STAGES-1). Stages do not nest; one may run several times
 * a frame, and its times add up. NULL timers do nothing. */
void irb_timer_begin(struct irb_timer *timer, int stage);
void irb_timer_end(struct irb_timer *timer);

/* Runs a call as a stage, unless one before it failed: ok is a bool that takes what it returns. */
#define IRB_TIMED(ok, timer, stage, call)                                                          \
    do {                                                                                           \
        irb_timer_begin(timer, stage);                                                             \
        (ok) = (ok) && (call);                                                                     \
        irb_timer_end(timer);                                                                      \
    } while (0)

/* Ends the frame: writes milliseconds of each stage since the last call (0 where it did not run),
 * waiting for the GPU. */
void irb_timer_collect(struct irb_timer *timer, double ms[IRB_MAX_STAGES]);

#endif
