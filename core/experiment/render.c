/* SPDX-License-Identifier: MIT
 *
 * Render: every trial of one scene, round by round. A round is a seed and a repeat: first every
 * seed once, then every seed again, so that what a stopped run has is spread over the seeds, and
 * repeats of a seed over the time that the run takes.
 */
#include "core/experiment/render.h"
#include "core/base/clock.h"
#include "core/experiment/provenance.h"
#include "core/experiment/render_round.h"

#include <stdlib.h>

struct scene_run {
    struct irb_passes passes;
    struct irb_trial_run *trials; /* of all seeds */
    int trial_count;
    struct irb_trial_run **of_seed; /* those of the round's */
};

static bool open_scene(struct scene_run *scene, struct irb_error *err)
{
    struct irb_run *run = scene->passes.run;
    size_t count = (size_t)run->config->trial_count;
    scene->trials = calloc(count, sizeof *scene->trials);
    scene->of_seed = calloc(count, sizeof *scene->of_seed);
    if (!scene->trials || !scene->of_seed)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %zu trials", count);
    scene->trial_count = run->config->trial_count;
    irb_run_work(run, IRB_WORK_STORE);
    for (int i = 0; i < scene->trial_count; i++)
        if (!irb_trial_run_open(&scene->trials[i], run, scene->passes.sequence,
                                &run->config->trials[i], err))
            return false;
    return true;
}

static void close_scene(struct scene_run *scene)
{
    irb_passes_close(&scene->passes);
    free(scene->of_seed);
    free(scene->trials);
}

/* The round of that index, with what is missing of it looked up; false where nothing is. */
static bool find_round(struct scene_run *scene, int index, struct irb_round *round)
{
    const struct irb_config *config = scene->passes.run->config;
    *round = (struct irb_round){
        .index = index,
        .seed = config->seeds[index % config->seed_count],
        .repeat = index / config->seed_count,
        .trials = scene->of_seed,
    };
    for (int t = 0; t < scene->trial_count; t++)
        if (scene->trials[t].trial->seed == round->seed)
            round->trials[round->trial_count++] = &scene->trials[t];
    return irb_round_look(round, &scene->passes);
}

/* How many there are with something missing. */
static int rounds_left(struct scene_run *scene, int rounds)
{
    struct irb_round round;
    int left = 0;
    for (int i = 0; i < rounds; i++) {
        if (find_round(scene, i, &round))
            left++;
        else
            irb_round_skip(&round, &scene->passes);
    }
    return left;
}

/* Those that there is time for; the first one in any case, and one that is missing where this
 * process has rendered none: else a run that takes long to prepare would never go on. */
static bool render_rounds(struct scene_run *scene, int rounds, int left, struct irb_error *err)
{
    struct irb_run *run = scene->passes.run;
    struct irb_round round;
    double since_s = irb_clock_s();
    int number = 0, left_out = 0;
    bool ok = true;
    for (int i = 0; ok && i < rounds; i++) {
        if (!find_round(scene, i, &round))
            continue;
        if (i && run->rounds_rendered && irb_clock_s() >= run->deadline_s) {
            irb_round_leave_out(&round, &scene->passes);
            left_out++;
            continue;
        }
        round.number = number++;
        round.count = left;
        round.since_s = since_s;
        ok = irb_round_render(&round, &scene->passes, err);
        run->rounds_rendered += ok;
    }
    irb_log_progress_done(run->log);
    if (ok && left_out)
        irb_warn(
            run->log,
            "%s: %.4g minutes are over: %d of %d rounds left out; the same command goes on with "
            "them",
            scene->passes.sequence->entry->name, run->options->minutes, left_out, rounds);
    run->rounds_left_out += left_out;
    return ok;
}

bool irb_render_sequence(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err)
{
    struct scene_run scene = {.passes = {.run = run, .sequence = sequence}};
    int rounds = run->config->seed_count * run->config->repeats;
    bool ok =
        irb_run_need_gl(run, err) && irb_provenance_store_gl(run, err) && open_scene(&scene, err);
    int left = ok ? rounds_left(&scene, rounds) : 0;
    irb_run_work(run, IRB_WORK_RENDER);
    if (ok && left) {
        irb_info(run->log, "%s: rendering %d of %d rounds of %d trials, %d frames",
                 sequence->entry->name, left, rounds, scene.trial_count / run->config->seed_count,
                 run->config->render.frames);
        ok = irb_passes_open(&scene.passes, err) && render_rounds(&scene, rounds, left, err);
    }
    close_scene(&scene);
    return ok;
}
