/* SPDX-License-Identifier: MIT
 *
 * Prepare: the full-precision G-buffer of every frame, and its ray-traced reference, into the
 * cache. Both are content-addressed, so that frames, trials, configs and runs share them.
 */
#include "core/base/clock.h"
#include "core/base/fs.h"
#include "core/experiment/paths.h"
#include "core/experiment/prepare.h"
#include "core/frame/gbuffer.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Renders and keys the G-buffer of one frame and stores it unless the cache has it. */
static bool prepare_gbuffer(struct irb_run *run, struct irb_gbuffer *gbuffer,
                            struct irb_scene_gl *scene, struct irb_sequence *sequence, int index,
                            struct irb_error *err)
{
    struct irb_sequence_frame *frame = &sequence->frames[index];
    struct irb_gbuffer_image image = {0};
    if (!irb_sequence_pose(sequence, index, err) || !irb_scene_gl_update(scene, err) ||
        !irb_gbuffer_render(gbuffer, scene, &frame->camera, err) ||
        !irb_gbuffer_read(gbuffer, &image, err))
        return false;
    frame->gbuffer = irb_gbuffer_image_key(&image);
    char *path = irb_cache_gbuffer(run->cache, &frame->gbuffer);
    bool ok = irb_fs_exists(path) || irb_gbuffer_image_save(&image, path, err);
    free(path);
    irb_gbuffer_image_destroy(&image);
    return ok;
}

bool irb_prepare_gbuffers(struct irb_run *run, struct irb_sequence *sequence, struct irb_error *err)
{
    const struct irb_config *config = run->config;
    if (!irb_run_need_gl(run, err) || !irb_fs_make_dirs(run->cache, err))
        return false;
    irb_fs_remove_stale(run->cache);
    irb_run_work(run, IRB_WORK_REFERENCE);
    struct irb_scene_gl *scene = irb_scene_gl_create(run->gl, sequence->scene, err);
    struct irb_gbuffer *gbuffer =
        scene ? irb_gbuffer_create(run->gl, config->render.width, config->render.height, err)
              : NULL;
    bool ok = gbuffer != NULL;
    for (int i = 0; ok && i < sequence->frame_count; i++) {
        struct irb_sequence_frame *frame = &sequence->frames[i];
        if (irb_sequence_same_view(sequence, i))
            frame->gbuffer = sequence->frames[i - 1].gbuffer;
        else
            ok = prepare_gbuffer(run, gbuffer, scene, sequence, i, err);
        if (ok)
            frame->reference = irb_reference_key(&frame->scene, &frame->light, &frame->camera,
                                                 &frame->gbuffer, &config->reference);
    }
    irb_gbuffer_destroy(gbuffer);
    irb_scene_gl_destroy(scene);
    return ok;
}

/* Traces one frame into the cache. */
static bool prepare_reference(struct irb_run *run, const struct irb_tracer *tracer,
                              const struct irb_sequence_frame *frame, struct irb_error *err)
{
    struct irb_gbuffer_image gbuffer = {0};
    struct irb_reference_image image = {0};
    char *gbuffer_path = irb_cache_gbuffer(run->cache, &frame->gbuffer);
    char *path = irb_cache_reference(run->cache, &frame->reference);
    char *checkpoint = irb_cache_checkpoint(run->cache, &frame->reference);
    struct irb_reference_job job = {
        .tracer = tracer,
        .light = &frame->light,
        .camera = &frame->camera,
        .gbuffer = &gbuffer,
        .settings = &run->config->reference,
        .threads = run->options->threads,
        .checkpoint = checkpoint,
        .log = run->log,
        .stop = run->options->stop,
    };
    bool ok = irb_gbuffer_image_load(&gbuffer, gbuffer_path, err);
    irb_run_watch(run, true);
    ok = ok && irb_reference_render(&job, &image, err);
    irb_run_watch(run, false);
    ok = ok && irb_reference_image_save(&image, path, frame->reference.hex, err);
    if (ok) {
        unlink(checkpoint);
        irb_debug(run->log, "  %d samples a pixel, noise %.3g, %.1f s, %.1f M rays/s",
                  image.samples, image.noise, image.seconds,
                  image.seconds > 0 ? 1e-6 * (double)image.rays / image.seconds : 0.0);
    }
    irb_reference_image_destroy(&image);
    irb_gbuffer_image_destroy(&gbuffer);
    free(checkpoint);
    free(path);
    free(gbuffer_path);
    return ok;
}

static bool reference_missing(const struct irb_run *run, const struct irb_sequence_frame *frame)
{
    char *path = irb_cache_reference(run->cache, &frame->reference);
    bool missing = !irb_fs_exists(path);
    free(path);
    return missing;
}

/* The tracer of a frame: made anew where objects have moved since *posed, the key of what *tracer
 * holds. */
static bool prepare_tracer(struct irb_sequence *sequence, int frame, struct irb_tracer **tracer,
                           struct irb_key *posed, struct irb_error *err)
{
    const struct irb_key *wanted = &sequence->frames[frame].scene;
    if (*tracer && !strcmp(posed->hex, wanted->hex))
        return true;
    irb_tracer_destroy(*tracer);
    *tracer =
        irb_sequence_pose(sequence, frame, err) ? irb_tracer_create(sequence->scene, err) : NULL;
    *posed = *wanted;
    return *tracer != NULL;
}

bool irb_prepare_references(struct irb_run *run, struct irb_sequence *sequence,
                            struct irb_error *err)
{
    irb_run_work(run, IRB_WORK_REFERENCE);
    int missing = 0;
    for (int i = 0; i < sequence->frame_count; i++)
        missing += reference_missing(run, &sequence->frames[i]);
    irb_progress_skip(&run->progress, IRB_PROGRESS_REFERENCE, sequence->frame_count - missing);
    if (!missing) {
        irb_info(run->log, "%s: %d reference frames, all cached", sequence->entry->name,
                 sequence->frame_count);
        return true;
    }
    struct irb_tracer *tracer = NULL;
    struct irb_key posed = {0};
    bool ok = true;
    double start = irb_clock_s();
    int done = 0;
    irb_run_begin(run, IRB_PROGRESS_REFERENCE, "references of %s", sequence->entry->name);
    for (int i = 0; ok && i < sequence->frame_count; i++) {
        if (!reference_missing(run, &sequence->frames[i])) /* an equal frame may have made it */
            continue;
        irb_info(run->log, "%s: reference of frame %d (%d missing of %d)", sequence->entry->name, i,
                 missing - done, sequence->frame_count);
        ok = !irb_run_stopped(run, err) && prepare_tracer(sequence, i, &tracer, &posed, err) &&
             prepare_reference(run, tracer, &sequence->frames[i], err);
        if (ok)
            irb_run_step(run, 1);
        done++;
    }
    if (ok)
        irb_progress_skip(&run->progress, IRB_PROGRESS_REFERENCE, missing - done);
    if (ok)
        irb_info(run->log, "%s: references took %.1f s", sequence->entry->name,
                 irb_clock_s() - start);
    irb_tracer_destroy(tracer);
    return ok;
}
