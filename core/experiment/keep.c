/* SPDX-License-Identifier: MIT */
#include "core/experiment/keep.h"
#include "core/base/fs.h"
#include "core/base/parallel.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/experiment/score_temporal.h"
#include "core/experiment/target_pair.h"
#include "core/experiment/temporal_maps.h"
#include "core/score/sheet.h"
#include "core/image/exr.h"
#include "core/image/imageio.h"
#include "core/score/metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Error maps of one kept frame. */
struct maps {
    struct irb_image relmse, flip_indirect, flip_full;
    struct irb_image residual, temporal_flip; /* of the indirect image; 0 in the first frame, empty
                                                 where the frame before it is gone */
};

static void destroy_maps(struct maps *maps)
{
    irb_image_destroy(&maps->relmse);
    irb_image_destroy(&maps->flip_indirect);
    irb_image_destroy(&maps->flip_full);
    irb_image_destroy(&maps->residual);
    irb_image_destroy(&maps->temporal_flip);
}

/* Zero where the sequence is black and FLIP is not defined. */
static bool flip_map(const struct irb_pair *pair, const struct irb_flip_reference *reference,
                     struct irb_image *map, struct irb_error *err)
{
    struct irb_flip_scores scores;
    if (!reference)
        return irb_image_create(map, pair->test->width, pair->test->height, 1, err);
    return irb_flip_hdr_prepared(pair->test, reference, pair->mask, 1, map, &scores, err);
}

/* On one thread: the trials are what runs in parallel. */
static bool make_maps(struct maps *maps, const struct irb_scored_frame *frame,
                      const struct irb_target *target, const struct irb_target_constants *constants,
                      struct irb_error *err)
{
    struct irb_pair indirect = {&frame->indirect, &target->indirect, target->mask};
    struct irb_pair full = {&frame->full, &target->full, target->mask};
    *maps = (struct maps){0};
    return irb_relmse_map(&indirect, constants->eps_indirect, &maps->relmse, err) &&
           flip_map(&indirect, target->flip_indirect, &maps->flip_indirect, err) &&
           flip_map(&full, target->flip_full, &maps->flip_full, err);
}

/* The maps between this frame and the one before it; `previous` is NULL in the first one. */
static bool make_temporal_maps(struct maps *maps, const struct irb_scored_frame *frame,
                               const struct irb_scored_frame *previous,
                               const struct irb_target_pair *targets,
                               const struct irb_target_constants *constants, struct irb_error *err)
{
    int width = frame->indirect.width, height = frame->indirect.height;
    const struct irb_target *target = &targets->target, *before = &targets->previous;
    struct irb_pair now = {&frame->indirect, &target->indirect, target->mask};
    struct irb_warped_pair warped = {0};
    struct irb_temporal_flip flip = {0};
    struct irb_target_view view = {0};
    if (!previous)
        return irb_image_create(&maps->residual, width, height, 1, err) &&
               irb_image_create(&maps->temporal_flip, width, height, 1, err);
    struct irb_pair pair = {&previous->indirect, &before->indirect, before->mask};
    bool ok =
        irb_warp_pair(&warped, &pair, irb_target_motion(targets), err) &&
        irb_residual_map(&warped.pair, &now, constants->mean_indirect, &maps->residual, err) &&
        irb_target_view_create(&view, &frame->indirect, constants->exposure, 1, err) &&
        irb_temporal_flip(&flip, &warped.pair, &now, &view, constants->exposure, err);
    maps->temporal_flip = flip.map; /* moved */
    flip.map = (struct irb_image){0};
    irb_temporal_flip_destroy(&flip);
    irb_target_view_destroy(&view);
    irb_warped_pair_destroy(&warped);
    return ok;
}

static bool write_exr(const char *path, const struct irb_run *run,
                      const struct irb_scored_trial *trial, const struct irb_scored_frame *frame,
                      const struct irb_target *target, const struct maps *maps,
                      const struct irb_debug_layers *debug, struct irb_error *err)
{
    enum { OWN = 10, TEMPORAL = 2, MOST = IRB_FRAME_ATTRIBUTES + IRB_MAX_DEBUG_LAYERS + 1 };
    struct irb_exr_layer layers[OWN + IRB_MAX_DEBUG_LAYERS] = {
        {"", "RGB", &frame->full},
        {"indirect", "RGB", &frame->indirect},
        {"direct", "RGB", &target->direct},
        {"reference", "RGB", &target->full},
        {"reference_indirect", "RGB", &target->indirect},
        {"relmse", "Y", &maps->relmse},
        {"flip_indirect", "Y", &maps->flip_indirect},
        {"flip_full", "Y", &maps->flip_full},
        {"residual", "Y", &maps->residual},
        {"temporal_flip", "Y", &maps->temporal_flip},
    };
    irb_debug_layer_name names[IRB_MAX_DEBUG_LAYERS];
    int own = maps->residual.data ? OWN : OWN - TEMPORAL;
    int count = own + irb_debug_layers_append(debug, layers + own, names);
    struct irb_frame_provenance from;
    struct irb_debug_attributes of_debug;
    struct irb_exr_attribute attributes[MOST];
    irb_frame_provenance(&from, trial->scene, trial->trial, frame->frame, &run->config_key);
    irb_debug_attributes(&of_debug, debug);
    memcpy(attributes, from.list, sizeof from.list);
    memcpy(attributes + IRB_FRAME_ATTRIBUTES, of_debug.list, sizeof of_debug.list);
    return irb_exr_write(path, layers, count, attributes, IRB_FRAME_ATTRIBUTES + of_debug.count,
                         IRB_EXR_ZIP, err);
}

static bool write_sheet(const char *path, const struct irb_scored_frame *frame,
                        const struct irb_target *target, const struct maps *maps,
                        const struct irb_target_constants *constants, struct irb_error *err)
{
    struct irb_image sheet = {0};
    struct irb_sheet_inputs inputs = {
        .full = &frame->full,
        .indirect = &frame->indirect,
        .reference_full = &target->full,
        .reference_indirect = &target->indirect,
        .flip_indirect = &maps->flip_indirect,
        .exposure = constants->exposure,
        .mean_indirect = constants->mean_indirect,
    };
    bool ok = irb_sheet_make(&inputs, &sheet, err) && irb_png_write(path, &sheet, err);
    irb_image_destroy(&sheet);
    return ok;
}

/* One frame that is being kept: its targets are loaded once for all trials. */
struct keep_frame {
    const struct irb_keep *keep;
    const struct irb_target_pair *targets;
    int frame;
    const int *wanted;      /* indices of the trials that keep it */
    struct irb_error *errs; /* one a trial */
};

static struct irb_frame_place place_of(const struct irb_keep *keep, int trial, int frame)
{
    return (struct irb_frame_place){keep->run->dir, keep->trials[trial].scene,
                                    keep->trials[trial].trial->folder, frame};
}

static bool has_frame_file(const struct irb_keep *keep, int trial, int frame)
{
    const struct irb_frame_place place = place_of(keep, trial, frame);
    char *path = irb_frame_path(&place, "frame", "exr");
    bool there = frame >= 0 && irb_fs_exists(path);
    free(path);
    return there;
}

/* All maps of the trial's frame; the frame before it is read for them, and without its file there
 * are none of what lies between the two. */
static bool make_all_maps(struct maps *maps, const struct keep_frame *kept, int trial,
                          const struct irb_scored_frame *frame, struct irb_error *err)
{
    const struct irb_keep *keep = kept->keep;
    struct irb_scored_frame previous = {0};
    bool has_previous = has_frame_file(keep, trial, kept->frame - 1);
    bool ok =
        make_maps(maps, frame, &kept->targets->target, keep->constants, err) &&
        (!has_previous || irb_scored_frame_load(&previous, keep->run, &keep->trials[trial],
                                                kept->frame - 1, &kept->targets->previous, err)) &&
        ((kept->frame && !has_previous) ||
         make_temporal_maps(maps, frame, has_previous ? &previous : NULL, kept->targets,
                            keep->constants, err));
    irb_scored_frame_destroy(&previous);
    return ok;
}

static bool keep_one(void *user, int index, int thread)
{
    struct keep_frame *kept = user;
    const struct irb_keep *keep = kept->keep;
    const struct irb_target *target = &kept->targets->target;
    int t = kept->wanted[index];
    const struct irb_scored_trial *trial = &keep->trials[t];
    struct irb_error *err = &kept->errs[t];
    struct irb_scored_frame frame = {0};
    struct maps maps = {0};
    struct irb_debug_layers debug = {0};
    const struct irb_frame_place place = place_of(keep, t, kept->frame);
    char *exr = irb_frame_path(&place, "image", "exr"),
         *png = irb_frame_path(&place, "image", "png");
    bool ok = irb_scored_frame_load(&frame, keep->run, trial, kept->frame, target, err) &&
              irb_debug_layers_load(&debug, &place, err) &&
              make_all_maps(&maps, kept, t, &frame, err) &&
              write_exr(exr, keep->run, trial, &frame, target, &maps, &debug, err);
    if (ok && IRB_HAVE_IMAGES)
        ok = write_sheet(png, &frame, target, &maps, keep->constants, err) &&
             irb_debug_layers_show(&debug, &place, keep->constants->exposure, err);
    free(png);
    free(exr);
    irb_debug_layers_destroy(&debug);
    destroy_maps(&maps);
    irb_scored_frame_destroy(&frame);
    if (thread == 0)
        irb_run_part(keep->run, index);
    return ok;
}

static bool is_wanted(const struct irb_keep *keep, int trial, int frame)
{
    int frames = keep->sequence->frame_count;
    return keep->run->options->keep_all || frame == 0 || frame == frames / 2 ||
           frame == keep->worst[trial] || frame == frames - 1;
}

/* Without its file, an earlier run has kept or removed it. */
static bool is_kept(const struct irb_keep *keep, int trial, int frame)
{
    return is_wanted(keep, trial, frame) && has_frame_file(keep, trial, frame);
}

static void warn_of_gaps(const struct irb_keep *keep, int frame, const int *wanted, int count)
{
    for (int i = 0; frame && i < count; i++)
        if (!has_frame_file(keep, wanted[i], frame - 1))
            irb_warn(keep->run->log,
                     "%s: %s: the file of frame %d is gone: frame %d is kept without the layers "
                     "residual and temporal_flip",
                     keep->sequence->entry->name, keep->trials[wanted[i]].trial->folder, frame - 1,
                     frame);
}

static bool keep_frame(const struct irb_keep *keep, int frame, struct irb_target_pair *targets,
                       int *wanted, struct irb_error *errs, struct irb_error *err)
{
    struct keep_frame kept = {
        .keep = keep, .targets = targets, .frame = frame, .wanted = wanted, .errs = errs};
    int count = 0, threads = keep->run->options->threads;
    for (int t = 0; t < keep->trial_count; t++)
        if (is_kept(keep, t, frame))
            wanted[count++] = t;
    if (!count)
        return true;
    warn_of_gaps(keep, frame, wanted, count);
    if (!irb_target_pair_load(targets, keep->run, keep->sequence, keep->constants, frame, err) ||
        !irb_target_prepare(&targets->target, keep->sequence->entry, keep->constants, threads, err))
        return false;
    bool ok = irb_parallel_for(count, threads, keep_one, &kept);
    for (int t = 0; !ok && t < keep->trial_count; t++)
        if (errs[t].code != IRB_E_OK && err)
            *err = errs[t];
    irb_run_step(keep->run, count);
    return ok;
}

static void remove_frame(const struct irb_keep *keep, int frame)
{
    for (int t = 0; t < keep->trial_count; t++) {
        const struct irb_frame_place place = place_of(keep, t, frame);
        if (!is_wanted(keep, t, frame))
            irb_debug_layers_remove_apart(&place);
        char *path = irb_frame_path(&place, "frame", "exr");
        unlink(path);
        free(path);
    }
}

static bool keep_frames(const struct irb_keep *keep, struct irb_error *err)
{
    int *wanted = calloc((size_t)keep->trial_count, sizeof *wanted);
    struct irb_error *errs = calloc((size_t)keep->trial_count, sizeof *errs);
    struct irb_target_pair targets = IRB_TARGET_PAIR_NONE;
    bool ok = wanted && errs;
    if (!ok)
        irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", keep->trial_count);
    struct irb_progress *p = &keep->run->progress;
    double end =
        p->kinds[IRB_PROGRESS_KEEP].done + keep->trial_count * p->kinds[IRB_PROGRESS_KEEP].of_trial;
    irb_run_begin(keep->run, IRB_PROGRESS_KEEP, "keep images of %s", keep->sequence->entry->name);
    for (int i = 0; ok && i < keep->sequence->frame_count; i++)
        ok = !irb_run_stopped(keep->run, err) && keep_frame(keep, i, &targets, wanted, errs, err);
    if (ok) /* there are fewer where frames are the worst and the last, or kept already */
        irb_progress_skip(p, IRB_PROGRESS_KEEP, fmax(end - p->kinds[IRB_PROGRESS_KEEP].done, 0));
    irb_target_pair_destroy(&targets);
    free(wanted);
    free(errs);
    return ok;
}

bool irb_keep_images(const struct irb_keep *keep, struct irb_error *err)
{
    if (!irb_temporal_maps_write(keep, err) || !keep_frames(keep, err))
        return false;
    /* The last one first: a frame that is there still has all before it, for its maps. */
    for (int i = keep->sequence->frame_count - 1; i >= 0; i--)
        remove_frame(keep, i);
    for (int i = 0; i < keep->sequence->frame_count; i++) {
        char *path =
            irb_run_file(keep->run->dir, keep->sequence->entry->name, NULL, "direct", i, "exr");
        unlink(path);
        free(path);
    }
    return true;
}
