/* SPDX-License-Identifier: MIT */
#include "core/experiment/keep.h"
#include "core/base/fs.h"
#include "core/experiment/paths.h"
#include "core/score/sheet.h"
#include "core/image/exr.h"
#include "core/image/imageio.h"
#include "core/score/metrics.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool is_kept(const struct irb_run *run, int frame, int frames, int worst)
{
    return run->options->keep_all || frame == 0 || frame == frames / 2 || frame == worst ||
           frame == frames - 1;
}

/* Error maps of one kept frame. */
struct maps {
    struct irb_image relmse, flip_indirect, flip_full;
};

static void destroy_maps(struct maps *maps)
{
    irb_image_destroy(&maps->relmse);
    irb_image_destroy(&maps->flip_indirect);
    irb_image_destroy(&maps->flip_full);
}

static bool flip_map(const struct irb_pair *pair, bool lit,
                     const struct irb_flip_exposures *exposures, int threads,
                     struct irb_image *map, struct irb_error *err)
{
    struct irb_flip_scores scores;
    if (!lit)
        return irb_image_create(map, pair->test->width, pair->test->height, 1, err);
    return irb_flip_hdr(pair->test, pair->reference, pair->mask, exposures, IRB_FLIP_PPD, threads,
                        map, &scores, err);
}

static bool make_maps(struct maps *maps, const struct irb_run *run,
                      const struct irb_scored_frame *frame, const struct irb_target *target,
                      const struct irb_target_constants *constants, struct irb_error *err)
{
    struct irb_pair indirect = {&frame->indirect, &target->indirect, target->mask};
    struct irb_pair full = {&frame->full, &target->full, target->mask};
    *maps = (struct maps){0};
    return irb_relmse_map(&indirect, constants->eps_indirect, &maps->relmse, err) &&
           flip_map(&indirect, constants->indirect_lit, &constants->flip_indirect,
                    run->options->threads, &maps->flip_indirect, err) &&
           flip_map(&full, constants->full_lit, &constants->flip_full, run->options->threads,
                    &maps->flip_full, err);
}

static bool write_exr(const char *path, const struct irb_run *run,
                      const struct irb_scored_trial *trial, const struct irb_scored_frame *frame,
                      const struct irb_target *target, const struct maps *maps,
                      struct irb_error *err)
{
    const struct irb_exr_layer layers[] = {
        {"", "RGB", &frame->full},
        {"indirect", "RGB", &frame->indirect},
        {"direct", "RGB", &target->direct},
        {"reference", "RGB", &target->full},
        {"reference_indirect", "RGB", &target->indirect},
        {"relmse", "Y", &maps->relmse},
        {"flip_indirect", "Y", &maps->flip_indirect},
        {"flip_full", "Y", &maps->flip_full},
    };
    char number[16];
    snprintf(number, sizeof number, "%d", frame->frame);
    const struct irb_exr_attribute attributes[] = {
        {"irbench:scene", trial->scene},
        {"irbench:trial", trial->trial->name},
        {"irbench:frame", number},
        {"irbench:config_key", run->config_key.hex},
    };
    return irb_exr_write(path, layers, sizeof layers / sizeof *layers, attributes,
                         sizeof attributes / sizeof *attributes, IRB_EXR_ZIP, err);
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

static bool keep_frame(struct irb_run *run, const struct irb_sequence *sequence,
                       const struct irb_scored_trial *trial,
                       const struct irb_target_constants *constants, int number,
                       struct irb_error *err)
{
    struct irb_target target;
    struct irb_scored_frame frame = {0};
    struct maps maps = {0};
    if (!irb_target_load(&target, run, sequence, number, constants, err))
        return false;
    char *exr = irb_run_file(run->dir, trial->scene, trial->trial->name, "image", number, "exr");
    char *png = irb_run_file(run->dir, trial->scene, trial->trial->name, "image", number, "png");
    bool ok = irb_scored_frame_load(&frame, run, trial, number, &target, err) &&
              make_maps(&maps, run, &frame, &target, constants, err) &&
              write_exr(exr, run, trial, &frame, &target, &maps, err);
    if (ok && IRB_HAVE_IMAGES)
        ok = write_sheet(png, &frame, &target, &maps, constants, err);
    free(png);
    free(exr);
    destroy_maps(&maps);
    irb_scored_frame_destroy(&frame);
    irb_target_destroy(&target);
    return ok;
}

bool irb_keep_trial(struct irb_run *run, const struct irb_sequence *sequence,
                    const struct irb_scored_trial *trial,
                    const struct irb_target_constants *constants, int worst,
                    struct irb_error *err)
{
    for (int i = 0; i < sequence->frame_count; i++) {
        char *path = irb_run_file(run->dir, trial->scene, trial->trial->name, "frame", i, "exr");
        bool ok = true;
        if (irb_fs_exists(path)) { /* else an earlier run has kept or removed it */
            if (is_kept(run, i, sequence->frame_count, worst))
                ok = keep_frame(run, sequence, trial, constants, i, err);
            if (ok)
                unlink(path);
        }
        free(path);
        if (!ok)
            return false;
    }
    return true;
}

bool irb_keep_shared(struct irb_run *run, const struct irb_sequence *sequence,
                     struct irb_error *err)
{
    (void)err;
    for (int i = 0; i < sequence->frame_count; i++) {
        char *path = irb_run_file(run->dir, sequence->entry->name, NULL, "direct", i, "exr");
        unlink(path);
        free(path);
    }
    return true;
}
