/* SPDX-License-Identifier: MIT */
#include "core/experiment/render_round.h"
#include "core/base/clock.h"
#include "core/base/str.h"

bool irb_round_look(struct irb_round *round, const struct irb_passes *passes)
{
    bool any = false;
    for (int t = 0; t < round->trial_count; t++) {
        irb_trial_run_look(round->trials[t], passes, round->repeat);
        any = any || round->trials[t]->last_frame >= 0;
    }
    return any;
}

static int common_divisor(int a, int b)
{
    while (b) {
        int rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

int irb_round_order(int turn, int place, int count)
{
    int steps = 0; /* step lengths that reach all trials */
    for (int s = 1; s <= count; s++)
        steps += common_divisor(s, count) == 1;
    int step = 0, left = turn % steps;
    while (left >= 0)
        left -= common_divisor(++step, count) == 1;
    return (int)(((long long)turn + (long long)place * step) % count);
}

/* ---- the states of a round ---- */

static void end_trials(struct irb_round *round)
{
    for (int t = 0; t < round->trial_count; t++)
        irb_trial_run_end(round->trials[t]);
}

static bool begin_trials(struct irb_round *round, struct irb_passes *passes, struct irb_error *err)
{
    /* methods are created with the scene as it is at the start */
    bool ok =
        irb_sequence_pose(passes->sequence, 0, err) && irb_scene_gl_update(passes->scene, err);
    for (int t = 0; ok && t < round->trial_count; t++) {
        ok = round->trials[t]->last_frame < 0 || irb_trial_run_begin(round->trials[t], passes, err);
        irb_run_part(passes->run, 0);
    }
    return ok;
}

/* ---- its frames ---- */

static bool anybody_needs(const struct irb_round *round, const struct irb_passes *passes, int frame)
{
    for (int t = 0; t < round->trial_count; t++)
        if (irb_trial_run_needs_frame(round->trials[t], passes, frame))
            return true;
    return false;
}

/* Repeat 0 is scored: it sees to the files of all frames, also of those that no trial needs. */
static bool render_shared(const struct irb_round *round, struct irb_passes *passes, int frame,
                          struct irb_error *err)
{
    bool for_files = frame >= 0 && !round->repeat && !passes->stored[frame];
    if (!for_files && !anybody_needs(round, passes, frame))
        return true;
    irb_run_work(passes->run, IRB_WORK_RENDER);
    if (irb_run_stopped(passes->run, err) || !irb_passes_render(passes, frame, err))
        return false;
    irb_run_work(passes->run, IRB_WORK_STORE);
    return !for_files || irb_passes_store(passes, frame, err);
}

static bool turn(struct irb_trial_run *trial, struct irb_passes *passes, int frame,
                 struct irb_error *err)
{
    struct irb_run *run = passes->run;
    int units = irb_progress_trial_units(run->config, trial->trial);
    if (irb_trial_run_needs_frame(trial, passes, frame)) {
        if (!irb_trial_run_frame(trial, passes, frame, err))
            return false;
        irb_run_step(run, 1);
    } else if (frame >= run->config->render.frames - units) {
        irb_progress_skip(&run->progress, IRB_PROGRESS_RENDER, 1);
    }
    return true;
}

static bool render_frames(struct irb_round *round, struct irb_passes *passes, struct irb_error *err)
{
    const struct irb_render_settings *render = &passes->run->config->render;
    struct irb_run *run = passes->run;
    int settle = irb_settle_frames(render);
    int first = -(settle > IRB_WARM_UP_FRAMES ? settle : IRB_WARM_UP_FRAMES);
    for (int frame = first; frame < render->frames; frame++) {
        if (!render_shared(round, passes, frame, err))
            return false;
        for (int place = 0; place < round->trial_count; place++) {
            int which = irb_round_order(frame - first + round->index, place, round->trial_count);
            struct irb_trial_run *trial = round->trials[which];
            if (irb_run_stopped(run, err))
                return false;
            if (!turn(trial, passes, frame, err))
                return false;
            double done =
                (frame - first + (place + 1.0) / round->trial_count) / (render->frames - first);
            irb_log_progress(run->log, "render", (round->number + done) / round->count,
                             irb_clock_s() - round->since_s);
        }
    }
    return true;
}

static void say_what(const struct irb_round *round, struct irb_passes *passes)
{
    const struct irb_config *config = passes->run->config;
    struct irb_str what = {0};
    irb_str_printf(&what, "render %s", passes->sequence->entry->name);
    if (config->seed_count > 1)
        irb_str_printf(&what, ", seed %d of %d", round->index % config->seed_count + 1,
                       config->seed_count);
    if (config->repeats > 1)
        irb_str_printf(&what, ", time %d of %d", round->repeat + 1, config->repeats);
    irb_run_begin(passes->run, IRB_PROGRESS_RENDER, "%s", irb_str_text(&what));
    irb_str_free(&what);
}

void irb_round_skip(const struct irb_round *round, struct irb_passes *passes)
{
    struct irb_run *run = passes->run;
    for (int t = 0; t < round->trial_count; t++)
        irb_progress_skip(&run->progress, IRB_PROGRESS_RENDER,
                          irb_progress_trial_units(run->config, round->trials[t]->trial));
}

void irb_round_leave_out(const struct irb_round *round, struct irb_passes *passes)
{
    struct irb_run *run = passes->run;
    for (int t = 0; t < round->trial_count; t++) {
        const struct irb_trial_run *trial = round->trials[t];
        double units = irb_progress_trial_units(run->config, trial->trial);
        if (trial->last_frame >= 0)
            irb_progress_leave_out(&run->progress, IRB_PROGRESS_RENDER, units);
        else
            irb_progress_skip(&run->progress, IRB_PROGRESS_RENDER, units);
    }
}

bool irb_round_render(struct irb_round *round, struct irb_passes *passes, struct irb_error *err)
{
    struct irb_run *run = passes->run;
    irb_run_work(run, IRB_WORK_RENDER);
    irb_progress_round(&run->progress, run->scenes_after);
    say_what(round, passes);
    bool ok = begin_trials(round, passes, err) && render_frames(round, passes, err);
    end_trials(round);
    return ok;
}
