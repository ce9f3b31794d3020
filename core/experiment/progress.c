/* SPDX-License-Identifier: MIT */
#include "core/experiment/progress.h"
#include "core/experiment/stage.h"

#include <math.h>

/* Before anything has been measured: seconds for an image of 512 x 384 on two cores. */
static const double usual_s[IRB_PROGRESS_KINDS] = {20, 0.3, 0.3, 0.1, 1};
static const double usual_pixels = 512 * 384;

int irb_progress_trial_units(const struct irb_config *config, const struct irb_trial *trial)
{
    int frames = config->render.frames;
    bool history = irb_trial_needs(trial, frames) & IRB_NEEDS_HISTORY;
    return frames + (history ? irb_settle_frames(&config->render) : IRB_WARM_UP_FRAMES);
}

/* What scoring and keeping a trial's sequence takes. */
static void plan_trials(struct irb_progress *p, const struct irb_config *config, bool keep_all)
{
    enum { KEPT = 4 }; /* first, middle, worst and last; in some trials these are fewer */
    int frames = config->render.frames;
    p->kinds[IRB_PROGRESS_SCORE].of_trial = frames;
    p->kinds[IRB_PROGRESS_PICTURES].of_trial = frames;
    p->kinds[IRB_PROGRESS_KEEP].of_trial = keep_all || frames < KEPT ? frames : KEPT;
    for (int i = 0; i < IRB_PROGRESS_KINDS; i++)
        p->kinds[i].total += config->scene_count * config->trial_count * p->kinds[i].of_trial;
}

struct irb_progress irb_progress_plan(const struct irb_config *config, unsigned stages,
                                      bool keep_all)
{
    const struct irb_render_settings *render = &config->render;
    struct irb_progress p = {.stored_s = -INFINITY, .deadline_s = INFINITY};
    double scenes = config->scene_count, units = 0;
    for (int i = 0; i < IRB_PROGRESS_KINDS; i++)
        p.kinds[i].guess_s = usual_s[i] * render->width * render->height / usual_pixels;
    for (int i = 0; i < config->trial_count; i++)
        units += irb_progress_trial_units(config, &config->trials[i]);
    if (stages & IRB_STAGE_PREPARE)
        p.kinds[IRB_PROGRESS_REFERENCE].total = scenes * render->frames;
    if (stages & IRB_STAGE_RENDER)
        p.kinds[IRB_PROGRESS_RENDER].total = scenes * units * config->repeats;
    if (stages & IRB_STAGE_SCORE)
        plan_trials(&p, config, keep_all);
    p.round = units / config->seed_count;
    p.due = scenes * p.round;
    return p;
}

void irb_progress_begin(struct irb_progress *p, enum irb_progress_kind kind, double now_s)
{
    p->kind = kind;
    p->since_s = now_s;
    p->part = 0;
}

void irb_progress_round(struct irb_progress *p, int scenes_after)
{
    p->due = (1 + scenes_after) * p->round;
}

static void none_due(struct irb_progress *p, enum irb_progress_kind kind, double units)
{
    if (kind == IRB_PROGRESS_RENDER)
        p->due = fmax(p->due - units, 0);
}

void irb_progress_leave_out(struct irb_progress *p, enum irb_progress_kind kind, double units)
{
    p->kinds[kind].left_out += units;
}

void irb_progress_leave_out_trials(struct irb_progress *p, int trials)
{
    for (int i = 0; i < IRB_PROGRESS_KINDS; i++)
        p->kinds[i].left_out += trials * p->kinds[i].of_trial;
}

void irb_progress_skip_trials(struct irb_progress *p, enum irb_progress_kind kind, int trials)
{
    p->kinds[kind].done += trials * p->kinds[kind].of_trial;
}

void irb_progress_skip(struct irb_progress *p, enum irb_progress_kind kind, double units)
{
    none_due(p, kind, units);
    if (kind == IRB_PROGRESS_REFERENCE)
        p->kinds[kind].total = fmax(p->kinds[kind].total - units, 0);
    else
        p->kinds[kind].done += units;
}

void irb_progress_step(struct irb_progress *p, double units, double now_s)
{
    none_due(p, p->kind, units);
    p->kinds[p->kind].done += units;
    p->kinds[p->kind].made += units;
    p->kinds[p->kind].seconds += now_s - p->since_s;
    p->since_s = now_s;
    p->part = 0;
}

void irb_progress_part(struct irb_progress *p, double units)
{
    p->part = fmax(units, 0);
}

static double unit_s(const struct irb_progress *p, int kind)
{
    double made = p->kinds[kind].made;
    return made > 0 ? p->kinds[kind].seconds / made : p->kinds[kind].guess_s;
}

static double units_left(const struct irb_progress *p, int kind)
{
    double part = kind == (int)p->kind ? p->part : 0;
    return fmax(p->kinds[kind].total - p->kinds[kind].done - part, 0);
}

double irb_progress_fraction(struct irb_progress *p)
{
    double all = 0, left = 0;
    for (int i = 0; i < IRB_PROGRESS_KINDS; i++) {
        all += p->kinds[i].total * unit_s(p, i);
        left += units_left(p, i) * unit_s(p, i);
    }
    if (all > 0)
        p->shown = fmax(p->shown, fmin(1 - left / all, 1));
    return p->shown;
}

double irb_progress_left_s(const struct irb_progress *p, double now_s)
{
    double left_s[IRB_PROGRESS_KINDS], all_s = 0;
    for (int i = 0; i < IRB_PROGRESS_KINDS; i++)
        left_s[i] = fmax(units_left(p, i) - p->kinds[i].left_out, 0) * unit_s(p, i);
    double until_s = p->deadline_s - now_s - left_s[IRB_PROGRESS_REFERENCE];
    double most_s = fmax(until_s, p->due * unit_s(p, IRB_PROGRESS_RENDER));
    left_s[IRB_PROGRESS_RENDER] = fmin(left_s[IRB_PROGRESS_RENDER], most_s);
    for (int i = 0; i < IRB_PROGRESS_KINDS; i++)
        all_s += left_s[i];
    return all_s;
}
