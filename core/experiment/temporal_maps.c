/* SPDX-License-Identifier: MIT */
#include "core/experiment/temporal_maps.h"
#include "core/base/fs.h"
#include "core/base/parallel.h"
#include "core/base/str.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/experiment/score_temporal.h"
#include "core/experiment/target_pair.h"
#include "core/image/exr.h"
#include "core/image/imageio.h"
#include "core/score/falsecolour.h"
#include "core/score/profile.h"

#include <stdio.h>
#include <stdlib.h>

/* One trial on its way through the sequence. */
struct growing {
    const struct irb_scored_trial *trial;
    struct irb_scored_frame previous; /* `full` is empty */
    struct irb_flicker_sum sum;
    struct irb_image profile; /* a row a frame */
    struct irb_error err;
};

struct pass {
    const struct irb_keep *keep;
    struct irb_target_pair targets;
    struct irb_image reference; /* its profile */
    struct growing *trials;
    int trial_count, frame;
};

/* The format has no longer images. */
static int profile_rows(const struct irb_keep *keep)
{
    int frames = keep->sequence->frame_count;
    return frames < IRB_EXR_MAX_SIDE ? frames : IRB_EXR_MAX_SIDE;
}

/* RUN/SCENE/TRIAL/NAME */
static char *file_path(const struct irb_keep *keep, const struct irb_scored_trial *trial,
                       const char *name)
{
    char *folder = irb_run_folder(keep->run->dir, trial->scene, trial->trial->folder);
    char *path = irb_asprintf("%s/%s", folder, name);
    free(folder);
    return path;
}

/* Whether the trial lacks its pictures and has what they are made from. flicker.exr is written
 * last. */
static bool is_wanted(const struct irb_keep *keep, const struct irb_scored_trial *trial)
{
    char *path = file_path(keep, trial, "flicker.exr");
    bool wanted = !irb_fs_exists(path);
    free(path);
    for (int i = 0; wanted && i < keep->sequence->frame_count; i++) {
        path = irb_run_file(keep->run->dir, trial->scene, trial->trial->folder, "frame", i, "exr");
        wanted = irb_fs_exists(path);
        free(path);
    }
    return wanted;
}

/* ---- a frame ---- */

/* The residual between `growing`'s last frame and this one. */
static bool add_residual(struct growing *growing, const struct pass *pass,
                         const struct irb_scored_frame *current)
{
    const struct irb_target *before = &pass->targets.previous, *now = &pass->targets.target;
    struct irb_warped_pair warped;
    struct irb_pair previous = {&growing->previous.indirect, &before->indirect, before->mask};
    struct irb_pair pair = {&current->indirect, &now->indirect, now->mask};
    bool ok = irb_warp_pair(&warped, &previous, irb_target_motion(&pass->targets), &growing->err);
    if (ok)
        irb_flicker_sum_add(&growing->sum, &warped.pair, &pair,
                            pass->keep->constants->mean_indirect);
    irb_warped_pair_destroy(&warped);
    return ok;
}

static bool add_frame(void *user, int index, int thread)
{
    const struct pass *pass = user;
    struct growing *growing = &pass->trials[index];
    struct irb_scored_frame current;
    if (!irb_scored_frame_load(&current, pass->keep->run, growing->trial, pass->frame,
                               &pass->targets.target, &growing->err))
        return false;
    irb_image_destroy(&current.full);
    bool ok = pass->frame == 0 || add_residual(growing, pass, &current);
    if (pass->frame < growing->profile.height)
        irb_profile_set(&growing->profile, pass->frame, &current.indirect,
                        pass->keep->constants->profile_row);
    irb_scored_frame_destroy(&growing->previous);
    growing->previous = current;
    if (thread == 0)
        irb_run_part(pass->keep->run, index);
    return ok;
}

/* ---- files ---- */

/* What says where a picture is from: as with a frame's, but for the frame. */
static int sequence_attributes(struct irb_exr_attribute *list, struct irb_frame_provenance *from,
                               const struct irb_scored_trial *trial, const struct irb_run *run)
{
    int count = 0;
    irb_frame_provenance(from, trial->scene, trial->trial, 0, &run->config_key);
    for (int i = 0; i < IRB_FRAME_ATTRIBUTES; i++)
        if (from->list[i].value != from->frame)
            list[count++] = from->list[i];
    return count;
}

static bool write_exr(const struct pass *pass, const struct growing *growing, const char *name,
                      const struct irb_exr_layer *layers, int layer_count, struct irb_error *err)
{
    struct irb_exr_attribute attributes[IRB_FRAME_ATTRIBUTES + 1];
    struct irb_frame_provenance from;
    int count = sequence_attributes(attributes, &from, growing->trial, pass->keep->run);
    char row[16];
    snprintf(row, sizeof row, "%d", pass->keep->constants->profile_row);
    attributes[count++] = (struct irb_exr_attribute){"irbench:profile_row", row};
    char *path = file_path(pass->keep, growing->trial, name);
    bool ok = irb_exr_write(path, layers, layer_count, attributes, count, IRB_EXR_ZIP, err);
    free(path);
    return ok;
}

static bool write_png(const struct pass *pass, const struct growing *growing, const char *name,
                      const struct irb_image *picture, struct irb_error *err)
{
    char *path = file_path(pass->keep, growing->trial, name);
    bool ok = irb_png_write(path, picture, err);
    free(path);
    return ok;
}

static bool write_profile(const struct pass *pass, const struct growing *growing,
                          struct irb_error *err)
{
    const struct irb_exr_layer layers[] = {{"result", "RGB", &growing->profile},
                                           {"reference", "RGB", &pass->reference}};
    struct irb_image sheet = {0};
    bool ok =
        !IRB_HAVE_IMAGES || (irb_profile_sheet(&growing->profile, &pass->reference,
                                               pass->keep->constants->exposure, &sheet, err) &&
                             write_png(pass, growing, "profile.png", &sheet, err));
    irb_image_destroy(&sheet);
    return ok && write_exr(pass, growing, "profile.exr", layers, 2, err);
}

static bool write_flicker(const struct pass *pass, const struct growing *growing,
                          struct irb_error *err)
{
    struct irb_flicker_maps maps;
    struct irb_image picture = {0};
    if (!irb_flicker_maps_of(&maps, &growing->sum, err))
        return false;
    const struct irb_exr_layer layers[] = {
        {"flicker", "Y", &maps.flicker}, {"pops", "Y", &maps.pops}, {"pairs", "Y", &maps.pairs}};
    bool ok = !IRB_HAVE_IMAGES ||
              (irb_falsecolour(&maps.flicker, IRB_FLICKER_PICTURE_END, &picture, err) &&
               write_png(pass, growing, "flicker.png", &picture, err));
    ok = ok && write_exr(pass, growing, "flicker.exr", layers, 3, err);
    irb_image_destroy(&picture);
    irb_flicker_maps_destroy(&maps);
    return ok;
}

static bool write_trial(void *user, int index, int thread)
{
    (void)thread;
    struct pass *pass = user;
    struct growing *growing = &pass->trials[index];
    return write_profile(pass, growing, &growing->err) &&
           write_flicker(pass, growing, &growing->err);
}

/* ---- a pass over the sequence ---- */

static bool start(struct growing *growing, const struct irb_keep *keep, struct irb_error *err)
{
    int width = keep->run->config->render.width, height = keep->run->config->render.height;
    growing->previous.frame = -1;
    return irb_flicker_sum_create(&growing->sum, width, height, err) &&
           irb_image_create(&growing->profile, width, profile_rows(keep), 3, err);
}

static bool on_all(struct pass *pass, irb_parallel_fn fn, struct irb_error *err)
{
    if (irb_parallel_for(pass->trial_count, pass->keep->run->options->threads, fn, pass))
        return true;
    for (int t = 0; t < pass->trial_count; t++)
        if (pass->trials[t].err.code != IRB_E_OK && err)
            *err = pass->trials[t].err;
    return false;
}

static bool go_through(struct pass *pass, struct irb_error *err)
{
    const struct irb_keep *keep = pass->keep;
    if (!irb_image_create(&pass->reference, keep->run->config->render.width, profile_rows(keep), 3,
                          err))
        return false;
    for (int t = 0; t < pass->trial_count; t++)
        if (!start(&pass->trials[t], keep, err))
            return false;
    for (pass->frame = 0; pass->frame < keep->sequence->frame_count; pass->frame++) {
        if (irb_run_stopped(keep->run, err) ||
            !irb_target_pair_load(&pass->targets, keep->run, keep->sequence, keep->constants,
                                  pass->frame, err))
            return false;
        if (pass->frame < pass->reference.height)
            irb_profile_set(&pass->reference, pass->frame, &pass->targets.target.indirect,
                            keep->constants->profile_row);
        if (!on_all(pass, add_frame, err))
            return false;
        irb_run_step(keep->run, pass->trial_count);
    }
    return on_all(pass, write_trial, err);
}

static void finish(struct pass *pass)
{
    for (int t = 0; t < pass->trial_count; t++) {
        irb_scored_frame_destroy(&pass->trials[t].previous);
        irb_flicker_sum_destroy(&pass->trials[t].sum);
        irb_image_destroy(&pass->trials[t].profile);
    }
    irb_image_destroy(&pass->reference);
    irb_target_pair_destroy(&pass->targets);
}

/* Trials that go over the sequence together. */
static int batch_size(const struct irb_keep *keep)
{
    const struct irb_render_settings *render = &keep->run->config->render;
    size_t pixel = 3 * sizeof(float) + 16; /* of the last frame, and of the sum */
    size_t rows = (size_t)render->height + (size_t)profile_rows(keep);
    return irb_run_batch(keep->run, pixel * (size_t)render->width * rows);
}

bool irb_temporal_maps_write(const struct irb_keep *keep, struct irb_error *err)
{
    int most = batch_size(keep), skipped = 0;
    bool ok = true;
    struct growing *trials = calloc((size_t)most, sizeof *trials);
    if (!trials)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d trials", most);
    irb_run_begin(keep->run, IRB_PROGRESS_PICTURES, "pictures of %s", keep->sequence->entry->name);
    for (int t = 0; ok && t < keep->trial_count;) {
        struct pass pass = {.keep = keep, .targets = IRB_TARGET_PAIR_NONE, .trials = trials};
        for (; t < keep->trial_count && pass.trial_count < most; t++)
            if (is_wanted(keep, &keep->trials[t]))
                trials[pass.trial_count++] = (struct growing){.trial = &keep->trials[t]};
            else
                skipped++;
        ok = pass.trial_count == 0 || go_through(&pass, err);
        finish(&pass);
    }
    irb_progress_skip_trials(&keep->run->progress, IRB_PROGRESS_PICTURES, skipped);
    free(trials);
    return ok;
}
