/* SPDX-License-Identifier: MIT
 *
 * Score: every rendered frame against the reference. Frames are the outer loop, so that a
 * reference is read once for many trials; these are scored in parallel. All of them are, or as many
 * as there is memory for.
 */
#include "core/base/clock.h"
#include "core/base/fs.h"
#include "core/base/parallel.h"
#include "core/experiment/film.h"
#include "core/experiment/keep.h"
#include "core/experiment/score_frame.h"
#include "core/experiment/score_stage.h"
#include "core/experiment/target_pair.h"
#include "core/experiment/paths.h"
#include "core/score/metrics.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

struct trial_scores {
    struct irb_scored_trial trial;
    struct irb_scored_frame previous; /* images of the last frame that was scored */
    struct irb_frame_scores *frames;  /* one a frame of the sequence */
    bool *fresh;                      /* computed in this run: still to be stored */
    struct irb_error err;
};

struct scoring {
    struct irb_run *run;
    struct irb_sequence *sequence;
    struct irb_target_constants constants;
    struct irb_target_pair targets; /* of this frame and the one before it */
    int frame;
    atomic_int made; /* trials of the frame, for progress */
    struct trial_scores *trials;
    int trial_count;
    struct trial_scores *batch; /* those of them that go over the sequence together */
    int batch_count;
};

static bool score_and_film(const struct scoring *s, struct trial_scores *trial,
                           const struct irb_score_context *context,
                           const struct irb_scored_frame *current)
{
    const struct irb_trial *of = trial->trial.trial;
    const struct irb_frame_place place = {s->run->dir, trial->trial.scene, of->folder, s->frame};
    bool film = irb_film_has_trial(s->run->config, of);
    struct irb_score_maps maps = {0};
    bool ok =
        irb_score_frame(&trial->frames[s->frame], context, &trial->trial, current,
                        s->frame > 0 ? &trial->previous : NULL, film ? &maps : NULL, &trial->err) &&
        (!film ||
         irb_film_trial(&place, &current->indirect, &maps, context->constants, &trial->err));
    irb_score_maps_destroy(&maps);
    return ok;
}

/* Scores one trial's current frame; runs on any thread, touches its own trial only. */
static bool score_trial(void *user, int index, int thread)
{
    struct scoring *s = user;
    struct trial_scores *trial = &s->batch[index];
    int frame = s->frame;
    if (irb_frame_scores_present(&trial->frames[frame]))
        return true;
    struct irb_scored_frame current = {0};
    if (frame > 0 && trial->previous.frame != frame - 1) {
        irb_scored_frame_destroy(&trial->previous);
        if (!irb_scored_frame_load(&trial->previous, s->run, &trial->trial, frame - 1,
                                   &s->targets.previous, &trial->err))
            return false;
    }
    if (!irb_scored_frame_load(&current, s->run, &trial->trial, frame, &s->targets.target,
                               &trial->err))
        return false;
    struct irb_score_context context = {
        .constants = &s->constants,
        .target = &s->targets.target,
        .previous_target = frame > 0 ? &s->targets.previous : NULL,
        .motion = irb_target_motion(&s->targets),
        .settings = s->run->config,
    };
    bool ok = score_and_film(s, trial, &context, &current);
    trial->fresh[frame] = ok;
    irb_scored_frame_destroy(&trial->previous);
    trial->previous = current;
    int made = atomic_fetch_add(&s->made, 1) + 1;
    if (thread == 0)
        irb_run_part(s->run, made);
    return ok;
}

static bool store_fresh(struct scoring *s, struct irb_error *err)
{
    irb_run_work(s->run, IRB_WORK_STORE);
    for (int t = 0; t < s->batch_count; t++) {
        struct trial_scores *trial = &s->batch[t];
        if (!trial->fresh[s->frame])
            continue;
        if (!irb_frame_scores_store(&trial->frames[s->frame], s->run->store, &trial->trial,
                                    s->frame, err))
            return false;
    }
    irb_run_work(s->run, IRB_WORK_SCORE);
    return true;
}

/* Trials of which the frame has no scores. */
static int count_missing(const struct trial_scores *trials, int count, int frame)
{
    int missing = 0;
    for (int t = 0; t < count; t++)
        missing += !irb_frame_scores_present(&trials[t].frames[frame]);
    return missing;
}

/* What is made once for all trials. */
static bool prepare_target(struct scoring *s, struct irb_error *err)
{
    int threads = s->run->options->threads;
    bool middle = s->frame == s->sequence->frame_count / 2;
    return irb_target_prepare(&s->targets.target, s->sequence->entry, &s->constants, threads,
                              err) &&
           (!middle || irb_target_prepare_noisy(&s->targets.target, &s->constants, threads, err));
}

static bool score_one_frame(struct scoring *s, struct irb_error *err)
{
    if (!irb_target_pair_load(&s->targets, s->run, s->sequence, &s->constants, s->frame, err) ||
        !prepare_target(s, err))
        return false;
    if (irb_film_wanted(s->run->config) &&
        !irb_film_target(s->run->dir, s->sequence->entry->name, s->frame, &s->targets.target,
                         &s->constants, err))
        return false;
    atomic_store(&s->made, 0);
    if (!irb_parallel_for(s->batch_count, s->run->options->threads, score_trial, s)) {
        for (int t = 0; t < s->batch_count; t++)
            if (s->batch[t].err.code != IRB_E_OK && err)
                *err = s->batch[t].err;
        return false;
    }
    return store_fresh(s, err);
}

/* The folders of the films. */
static bool open_films(const struct scoring *s, struct irb_error *err)
{
    const char *scene = s->sequence->entry->name;
    if (!irb_film_wanted(s->run->config))
        return true;
    bool ok = irb_film_open(s->run->dir, scene, NULL, err);
    for (int t = 0; ok && t < s->trial_count; t++) {
        const struct irb_trial *trial = s->trials[t].trial.trial;
        if (irb_film_has_trial(s->run->config, trial))
            ok = irb_film_open(s->run->dir, scene, trial->folder, err);
    }
    return ok;
}

/* The batch's frames; the trials before it have all their scores. */
static bool score_batch(struct scoring *s, double start_s, struct irb_error *err)
{
    int frames = s->sequence->frame_count;
    double before = (double)(s->batch - s->trials);
    for (s->frame = 0; s->frame < frames; s->frame++) {
        if (irb_run_stopped(s->run, err))
            return false;
        int missing = count_missing(s->batch, s->batch_count, s->frame);
        irb_progress_skip(&s->run->progress, IRB_PROGRESS_SCORE, s->batch_count - missing);
        if (missing && !score_one_frame(s, err))
            return false;
        if (missing)
            irb_run_step(s->run, missing);
        irb_log_progress(s->run->log, "score",
                         (before + s->batch_count * (s->frame + 1.0) / frames) / s->trial_count,
                         irb_clock_s() - start_s);
    }
    return true;
}

static bool score_frames(struct scoring *s, struct irb_error *err)
{
    const struct irb_render_settings *render = &s->run->config->render;
    /* the last frame's two images */
    size_t bytes = 2 * 3 * sizeof(float) * (size_t)render->width * (size_t)render->height;
    int most = irb_run_batch(s->run, bytes);
    double start_s = irb_clock_s();
    bool ok = open_films(s, err);
    for (int t = 0; ok && t < s->trial_count; t += most) {
        s->batch = s->trials + t;
        s->batch_count = s->trial_count - t < most ? s->trial_count - t : most;
        ok = score_batch(s, start_s, err);
        for (int i = 0; i < s->batch_count; i++)
            irb_scored_frame_destroy(&s->batch[i].previous);
        irb_target_pair_destroy(&s->targets);
    }
    if (ok)
        irb_log_progress_done(s->run->log);
    return ok;
}

static bool open_trials(struct scoring *s, struct irb_error *err)
{
    const struct irb_config *config = s->run->config;
    s->trials = calloc((size_t)config->trial_count, sizeof *s->trials);
    if (!s->trials)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", config->trial_count);
    for (int t = 0; t < config->trial_count; t++) {
        struct trial_scores *trial = &s->trials[t];
        size_t n = (size_t)config->render.frames;
        s->trial_count = t + 1;
        trial->previous.frame = -1;
        trial->frames = calloc(n, sizeof *trial->frames);
        trial->fresh = calloc(n, sizeof *trial->fresh);
        if (!trial->frames || !trial->fresh)
            return irb_fail(err, IRB_E_MEMORY, "no memory for the scores of %zu frames", n);
        if (!irb_scored_trial_open(&trial->trial, s->run, s->sequence, &config->trials[t], err) ||
            !irb_frame_scores_read(trial->frames, config->render.frames, s->run->store,
                                   &trial->trial, err))
            return false;
    }
    return true;
}

static void close_scoring(struct scoring *s)
{
    for (int t = 0; t < s->trial_count; t++) {
        irb_scored_frame_destroy(&s->trials[t].previous);
        free(s->trials[t].frames);
        free(s->trials[t].fresh);
    }
    free(s->trials);
    irb_target_pair_destroy(&s->targets);
    irb_target_constants_destroy(&s->constants);
}

/* The figures of the sequence. */
static bool store_sequences(struct scoring *s, struct irb_error *err)
{
    for (int t = 0; t < s->trial_count; t++)
        if (!irb_sequence_scores_store(s->trials[t].frames, s->sequence->frame_count, &s->constants,
                                       s->run->store, &s->trials[t].trial, err))
            return false;
    return true;
}

static bool keep_images(struct scoring *s, struct irb_error *err)
{
    size_t count = s->trial_count > 0 ? (size_t)s->trial_count : 0;
    struct irb_scored_trial *trials = calloc(count, sizeof *trials);
    int *worst = calloc(count, sizeof *worst);
    bool ok = trials && worst;
    if (!ok)
        irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", s->trial_count);
    for (int t = 0; ok && t < s->trial_count; t++) {
        trials[t] = s->trials[t].trial;
        worst[t] = irb_worst_frame(s->trials[t].frames, s->sequence->frame_count);
    }
    struct irb_keep keep = {.run = s->run,
                            .sequence = s->sequence,
                            .constants = &s->constants,
                            .trials = trials,
                            .worst = worst,
                            .trial_count = s->trial_count};
    ok = ok && irb_keep_images(&keep, err);
    free(trials);
    free(worst);
    return ok;
}

/* Whether a frame is left to score, or a scored one to be kept or removed. */
static bool anything_to_do(const struct scoring *s)
{
    bool todo = false;
    for (int i = 0; !todo && i < s->sequence->frame_count; i++) {
        todo = count_missing(s->trials, s->trial_count, i) > 0;
        for (int t = 0; !todo && t < s->trial_count; t++) {
            char *path = irb_run_file(s->run->dir, s->sequence->entry->name,
                                      s->trials[t].trial.trial->folder, "frame", i, "exr");
            todo = irb_fs_exists(path);
            free(path);
        }
    }
    return todo;
}

bool irb_score_sequence(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err)
{
    struct scoring s = {.run = run, .sequence = sequence, .targets = IRB_TARGET_PAIR_NONE};
    irb_run_work(run, IRB_WORK_SCORE);
    bool ok = open_trials(&s, err);
    if (ok && anything_to_do(&s)) {
        irb_info(run->log, "%s: scoring %d trials", sequence->entry->name, s.trial_count);
        irb_run_begin(run, IRB_PROGRESS_SCORE, "score %s", sequence->entry->name);
        ok = irb_target_constants_of(&s.constants, run, sequence, err) &&
             irb_target_constants_store(&s.constants, run, sequence, err) &&
             score_frames(&s, err) && store_sequences(&s, err) && keep_images(&s, err);
    } else {
        for (int kind = IRB_PROGRESS_SCORE; kind < IRB_PROGRESS_KINDS; kind++)
            irb_progress_skip_trials(&run->progress, (enum irb_progress_kind)kind, s.trial_count);
    }
    close_scoring(&s);
    return ok;
}
