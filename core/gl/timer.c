/* SPDX-License-Identifier: MIT */
#include "core/gl/timer.h"
#include "core/base/clock.h"

#include <stdlib.h>

/* Intervals that may be open between two collections; beyond that the oldest is read at once. */
enum { RING_SIZE = 256 };

struct irb_timer {
    struct irb_gl *gl; /* borrowed */
    double ms[IRB_MAX_STAGES];
    int stage; /* -1 between stages */
    /* software: */
    double begin_s;
    /* hardware: a ring of queries, `pending` of them from `oldest` on */
    GLuint queries[RING_SIZE];
    int query_stage[RING_SIZE];
    int oldest, pending;
};

const char *irb_timer_clock(const struct irb_timer *timer)
{
    if (!timer)
        return "none";
    return timer->gl->software ? "finish+clock" : "gl-query";
}

struct irb_timer *irb_timer_create(struct irb_gl *gl, struct irb_error *err)
{
    struct irb_timer *timer = calloc(1, sizeof *timer);
    if (!timer) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    timer->gl = gl;
    timer->stage = -1;
    if (!gl->software)
        gl->api.CreateQueries(GL_TIME_ELAPSED, RING_SIZE, timer->queries);
    if (irb_gl_check(gl, "timer", err))
        return timer;
    irb_timer_destroy(timer);
    return NULL;
}

void irb_timer_destroy(struct irb_timer *timer)
{
    if (!timer)
        return;
    if (!timer->gl->software)
        timer->gl->api.DeleteQueries(RING_SIZE, timer->queries);
    free(timer);
}

static void read_oldest(struct irb_timer *timer)
{
    GLuint64 ns = 0;
    timer->gl->api.GetQueryObjectui64v(timer->queries[timer->oldest], GL_QUERY_RESULT, &ns);
    timer->ms[timer->query_stage[timer->oldest]] += (double)ns * 1e-6;
    timer->oldest = (timer->oldest + 1) % RING_SIZE;
    timer->pending--;
}

void irb_timer_begin(struct irb_timer *timer, int stage)
{
    if (!timer || stage < 0 || stage >= IRB_MAX_STAGES)
        return;
    irb_timer_end(timer); /* stages do not nest: a forgotten end is made up for */
    timer->stage = stage;
    if (timer->gl->software) {
        timer->gl->api.Finish();
        timer->begin_s = irb_clock_s();
        return;
    }
    if (timer->pending == RING_SIZE)
        read_oldest(timer);
    int slot = (timer->oldest + timer->pending++) % RING_SIZE;
    timer->query_stage[slot] = stage;
    timer->gl->api.BeginQuery(GL_TIME_ELAPSED, timer->queries[slot]);
}

void irb_timer_end(struct irb_timer *timer)
{
    if (!timer || timer->stage < 0)
        return;
    if (timer->gl->software) {
        timer->gl->api.Finish();
        timer->ms[timer->stage] += 1e3 * (irb_clock_s() - timer->begin_s);
    } else {
        timer->gl->api.EndQuery(GL_TIME_ELAPSED);
    }
    timer->stage = -1;
}

void irb_timer_collect(struct irb_timer *timer, double ms[IRB_MAX_STAGES])
{
    if (timer) {
        irb_timer_end(timer);
        while (timer->pending)
            read_oldest(timer);
    }
    for (int i = 0; i < IRB_MAX_STAGES; i++) {
        ms[i] = timer ? timer->ms[i] : 0;
        if (timer)
            timer->ms[i] = 0;
    }
}
