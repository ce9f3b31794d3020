/* SPDX-License-Identifier: MIT */
#include "core/experiment/stage.h"
#include "core/base/clock.h"

const char *const irb_work_names[IRB_WORK_COUNT] = {"startup", "reference", "render", "score",
                                                    "store"};

void irb_run_work(struct irb_run *run, enum irb_work work)
{
    double now = irb_clock_s();
    run->seconds[run->working] += now - run->since_s;
    run->working = work;
    run->since_s = now;
}

bool irb_run_stopped(const struct irb_run *run, struct irb_error *err)
{
    if (!run->options->stop || !*run->options->stop)
        return false;
    irb_fail(err, IRB_E_INTERRUPTED, "stopped; the same command goes on from here");
    return true;
}

bool irb_run_need_gl(struct irb_run *run, struct irb_error *err)
{
    if (run->gl)
        return true;
    struct irb_gl_desc desc = {
        .backend = run->options->backend, .shader_dir = run->options->shader_dir, .log = run->log};
    enum irb_work before = run->working;
    irb_run_work(run, IRB_WORK_STARTUP);
    run->gl = irb_gl_create(&desc, err);
    bool ok = run->gl != NULL;
    if (ok)
        irb_debug(run->log, "OpenGL: %s (%s)", run->gl->renderer, run->gl->platform);
    irb_run_work(run, before);
    return ok;
}
