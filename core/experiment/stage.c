/* SPDX-License-Identifier: MIT */
#include "core/experiment/stage.h"
#include "core/base/clock.h"
#include "core/base/parallel.h"
#include "core/base/str.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

const char *const irb_work_names[IRB_WORK_COUNT] = {"startup", "reference", "render", "score",
                                                    "store"};

void irb_run_work(struct irb_run *run, enum irb_work work)
{
    double now = irb_clock_s();
    run->seconds[run->working] += now - run->since_s;
    run->working = work;
    run->since_s = now;
}

/* ---- progress ---- */

static bool store_progress(struct irb_run *run, const char *state, struct irb_error *err)
{
    struct irb_progress *p = &run->progress;
    struct irb_str json = {0};
    char at[32];
    irb_clock_utc(at);
    irb_str_printf(&json,
                   "{\"fraction\": %.4f, \"left_s\": %.0f, \"what\": ", irb_progress_fraction(p),
                   irb_progress_left_s(p, irb_clock_s()));
    irb_str_json_string(&json, p->what);
    irb_str_printf(&json, ", \"at\": \"%s\", \"state\": \"%s\"}", at, state);
    bool ok = irb_store_set_meta(run->store, "progress", irb_str_text(&json), err);
    irb_str_free(&json);
    p->stored_s = irb_clock_s();
    return ok;
}

static void tell_progress(struct irb_run *run)
{
    static const double interval_s = 1;
    struct irb_progress *p = &run->progress;
    if (run->log)
        run->log->run = (struct irb_log_run){.known = true,
                                             .fraction = irb_progress_fraction(p),
                                             .left_s = irb_progress_left_s(p, irb_clock_s())};
    if (run->store && irb_clock_s() - p->stored_s >= interval_s) {
        struct irb_error ignored; /* what matters is stored elsewhere, and says so */
        store_progress(run, "running", &ignored);
    }
}

void irb_run_begin(struct irb_run *run, enum irb_progress_kind kind, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(run->progress.what, sizeof run->progress.what, format, args);
    va_end(args);
    irb_progress_begin(&run->progress, kind, irb_clock_s());
    run->progress.stored_s = -INFINITY;
    tell_progress(run);
}

void irb_run_step(struct irb_run *run, double units)
{
    irb_progress_step(&run->progress, units, irb_clock_s());
    tell_progress(run);
}

void irb_run_part(struct irb_run *run, double units)
{
    irb_progress_part(&run->progress, units);
    tell_progress(run);
}

static void see_part(void *user, double fraction)
{
    irb_run_part(user, fmin(fraction, 1));
}

void irb_run_watch(struct irb_run *run, bool on)
{
    if (!run->log)
        return;
    run->log->watch = on ? see_part : NULL;
    run->log->watcher = on ? run : NULL;
}

bool irb_run_end(struct irb_run *run, bool whole, struct irb_error *err)
{
    if (run->log)
        run->log->run = (struct irb_log_run){0};
    if (!whole && !*run->progress.what)
        return true; /* it has not begun, and another one may have been whole */
    return whole ? irb_store_set_meta(run->store, "progress", "done", err)
                 : store_progress(run, "stopped", err);
}

int irb_run_batch(const struct irb_run *run, size_t trial_bytes)
{
    static const size_t usual_bytes = (size_t)1 << 30; /* source: ours */
    size_t bytes = run->options->batch_bytes ? run->options->batch_bytes : usual_bytes;
    size_t fit = trial_bytes ? bytes / trial_bytes : IRB_MOST_TRIALS;
    size_t threads = (size_t)(run->options->threads > 0 ? run->options->threads : irb_core_count());
    return (int)(fit < threads ? threads : fit > IRB_MOST_TRIALS ? IRB_MOST_TRIALS : fit);
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
