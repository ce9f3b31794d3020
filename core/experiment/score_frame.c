/* SPDX-License-Identifier: MIT */
#include "core/experiment/score_frame.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/experiment/score_temporal.h"
#include "core/frame/composite.h"
#include "core/score/flicker.h"
#include "core/score/ssim.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void irb_scored_frame_destroy(struct irb_scored_frame *frame)
{
    irb_image_destroy(&frame->indirect);
    irb_image_destroy(&frame->full);
    frame->frame = -1;
}

bool irb_scored_trial_open(struct irb_scored_trial *scored, struct irb_run *run,
                           const struct irb_sequence *sequence, const struct irb_trial *trial,
                           struct irb_error *err)
{
    *scored = (struct irb_scored_trial){
        .trial = trial, .scene = sequence->entry->name, .entry = sequence->entry};
    scored->id = irb_store_trial_find(run->store, scored->scene, trial->name, trial->seed);
    return scored->id > 0 ||
           irb_fail(err, IRB_E_USAGE, "%s: %s is not rendered; run --stage render first", run->dir,
                    trial->name);
}

bool irb_scored_frame_load(struct irb_scored_frame *out, const struct irb_run *run,
                           const struct irb_scored_trial *trial, int frame,
                           const struct irb_target *target, struct irb_error *err)
{
    *out = (struct irb_scored_frame){.frame = frame};
    if (!target->direct.data)
        return irb_fail(err, IRB_E_INPUT, "%s: the direct light of frame %d of scene %s is missing",
                        run->dir, frame, trial->scene);
    struct irb_frame_file file;
    char *path = irb_run_file(run->dir, trial->scene, trial->trial->folder, "frame", frame, "exr");
    bool ok = irb_frame_file_load(path, &file, err);
    free(path);
    if (!ok)
        return false;
    ok = irb_composite(&target->gbuffer, &target->direct, &file.irradiance,
                       file.radiance.data ? &file.radiance : NULL, &out->indirect, &out->full, err);
    irb_frame_file_destroy(&file);
    return ok;
}

/* One ranked image, what it is held against, and where its scores go. */
struct ranked {
    struct irb_pair pair;
    const struct irb_flip_reference *flip; /* NULL: a black sequence, HDR-FLIP is not defined */
    const struct irb_target_view *view;
    double eps, peak, mean_reference;
    bool full; /* which of the two: picks the metrics */
};

/* The metric `name` of the image. */
#define RANKED(image, name) ((image)->full ? IRB_METRIC_full_##name : IRB_METRIC_indirect_##name)

static struct ranked ranked_image(bool full, const struct irb_score_context *context,
                                  const struct irb_scored_frame *frame)
{
    const struct irb_target *target = context->target;
    const struct irb_target_constants *c = context->constants;
    if (full)
        return (struct ranked){
            .pair = {&frame->full, &target->full, target->mask},
            .flip = target->flip_full,
            .view = &target->view_full,
            .eps = c->eps_full,
            .peak = c->peak_full,
            .mean_reference = c->mean_full,
            .full = true,
        };
    return (struct ranked){
        .pair = {&frame->indirect, &target->indirect, target->mask},
        .flip = target->flip_indirect,
        .view = &target->view_indirect,
        .eps = c->eps_indirect,
        .peak = c->peak_indirect,
        .mean_reference = c->mean_indirect,
    };
}

static struct irb_error_scores score_errors(const struct ranked *image, double *v)
{
    struct irb_error_scores scores = irb_score_errors(&image->pair, image->eps);
    v[RANKED(image, rmse)] = scores.rmse;
    v[RANKED(image, relmse)] = scores.relmse;
    v[RANKED(image, smape)] = scores.smape;
    v[RANKED(image, psnr)] = irb_psnr(scores.rmse, image->peak);
    v[RANKED(image, bias)] = scores.bias;
    v[RANKED(image, energy_ratio)] = scores.energy_ratio;
    return scores;
}

/* RMSE, relMSE and energy ratio of an image that is not ranked. */
static void score_unranked(const struct irb_pair *pair, double eps, double *rmse, double *relmse,
                           double *energy_ratio)
{
    struct irb_error_scores scores = irb_score_errors(pair, eps);
    *rmse = scores.rmse;
    *relmse = scores.relmse;
    *energy_ratio = scores.energy_ratio;
}

/* HDR-FLIP, and its map where a region wants it. One thread: the trials are what runs in
 * parallel. */
static bool score_flip(const struct ranked *image, struct irb_image *map, double *v,
                       struct irb_error *err)
{
    struct irb_flip_scores scores;
    if (!image->flip)
        return true;
    if (!irb_flip_hdr_prepared(image->pair.test, image->flip, image->pair.mask, 1, map, &scores,
                               err))
        return false;
    v[RANKED(image, flip)] = scores.mean;
    return true;
}

/* By how much HDR-FLIP grows with as much noise again in the reference. */
static bool score_flip_noise(const struct irb_target *target, const struct irb_image *indirect,
                             double *v, struct irb_error *err)
{
    struct irb_flip_scores scores;
    if (!target->flip_noisy)
        return true;
    if (!irb_flip_hdr_prepared(indirect, target->flip_noisy, target->mask, 1, NULL, &scores, err))
        return false;
    v[IRB_METRIC_indirect_flip_noise] = scores.mean - v[IRB_METRIC_indirect_flip];
    return true;
}

/* SSIM and LDR-FLIP. */
static bool score_view(const struct ranked *image, const struct irb_target_view *view, double *v,
                       struct irb_error *err)
{
    struct irb_flip_scores flip;
    if (!irb_ssim(&view->luma, &image->view->luma, image->pair.mask, NULL, &v[RANKED(image, ssim)],
                  err) ||
        !irb_flip_views(view->flip, image->view->flip, image->pair.mask, 1, NULL, &flip, err))
        return false;
    v[RANKED(image, ldr_flip)] = flip.mean;
    return true;
}

/* What there is between this frame and the one before it. */
struct change {
    struct irb_warped_pair before;
    struct irb_temporal_flip flip;
};

static bool score_region(const struct ranked *image, const uint8_t *mask,
                         const struct irb_image *flip_map, const struct change *change,
                         double values[IRB_REGION_METRIC_COUNT / 2], struct irb_error *err)
{
    struct irb_pair pair = image->pair;
    pair.mask = mask;
    struct irb_error_scores errors = irb_score_errors(&pair, image->eps);
    struct irb_flicker_scores flicker = {NAN, NAN};
    double temporal_flip = NAN;
    if (change) {
        flicker = irb_score_flicker(&change->before.pair, &pair, image->mean_reference);
        if (!irb_temporal_flip_mean(&change->flip, mask, &temporal_flip, err))
            return false;
    }
    const double all[] = {errors.rmse,     errors.relmse,
                          errors.bias,     flip_map->data ? irb_masked_mean(flip_map, mask) : NAN,
                          flicker.flicker, flicker.pop_share,
                          temporal_flip};
    _Static_assert(2 * sizeof all == IRB_REGION_METRIC_COUNT * sizeof *all,
                   "the order of IRB_REGION_METRICS");
    memcpy(values, all, sizeof all);
    return true;
}

/* change is NULL in the first frame. */
static bool score_regions(const struct irb_score_context *context, const struct ranked *image,
                          const struct irb_image *flip_map, const struct change *change,
                          struct irb_frame_scores *scores, const struct irb_scene_entry *entry,
                          struct irb_error *err)
{
    for (int r = 0; r < entry->region_count; r++)
        if (!score_region(image, context->target->regions[r], flip_map, change,
                          scores->regions[r] + (image->full ? IRB_REGION_METRIC_COUNT / 2 : 0),
                          err))
            return false;
    return true;
}

/* The previous frame's pair of the same image. */
static struct irb_pair previous_pair(bool full, const struct irb_score_context *context,
                                     const struct irb_scored_frame *previous)
{
    const struct irb_target *before = context->previous_target;
    if (full)
        return (struct irb_pair){&previous->full, &before->full, before->mask};
    return (struct irb_pair){&previous->indirect, &before->indirect, before->mask};
}

/* *change is to be destroyed after a failure too. */
static bool score_change(struct change *change, const struct irb_score_context *context,
                         const struct ranked *image, const struct irb_scored_frame *previous,
                         const struct irb_target_view *view, struct irb_score_maps *maps, double *v,
                         struct irb_error *err)
{
    struct irb_pair pair = previous_pair(image->full, context, previous);
    double mean = image->mean_reference;
    if (!irb_warp_pair(&change->before, &pair, context->motion, err) ||
        !irb_temporal_flip(&change->flip, &change->before.pair, &image->pair, view,
                           context->constants->exposure, err))
        return false;
    struct irb_flicker_scores flicker = irb_score_flicker(&change->before.pair, &image->pair, mean);
    v[RANKED(image, flicker)] = flicker.flicker;
    v[RANKED(image, pop_share)] = flicker.pop_share;
    v[RANKED(image, temporal_flip)] = change->flip.mean;
    return !maps ||
           irb_residual_map(&change->before.pair, &image->pair, mean, &maps->residual, err);
}

/* All scores of one ranked image; maps may be NULL. */
static bool score_ranked(struct irb_frame_scores *scores, const struct irb_score_context *context,
                         const struct irb_scored_trial *trial, const struct ranked *image,
                         const struct irb_scored_frame *previous, struct irb_score_maps *maps,
                         struct irb_error *err)
{
    double *v = scores->values, exposure = context->constants->exposure;
    struct irb_target_view view = {0};
    struct irb_image flip_map = {0};
    struct change change = {0};
    bool wants_map = maps || trial->entry->region_count > 0;
    bool ok = irb_target_view_create(&view, image->pair.test, exposure, 1, err) &&
              score_flip(image, wants_map ? &flip_map : NULL, v, err) &&
              score_view(image, &view, v, err) &&
              (!previous || score_change(&change, context, image, previous, &view, maps, v, err)) &&
              score_regions(context, image, &flip_map, previous ? &change : NULL, scores,
                            trial->entry, err);
    irb_warped_pair_destroy(&change.before);
    irb_temporal_flip_destroy(&change.flip);
    if (maps)
        maps->flip = flip_map; /* moved */
    else
        irb_image_destroy(&flip_map);
    irb_target_view_destroy(&view);
    return ok;
}

/* What is known of the reference itself. */
static void score_reference(const struct irb_score_context *context, bool temporal, double *v)
{
    const struct irb_target *target = context->target;
    double mean = context->constants->mean_indirect;
    v[IRB_METRIC_reference_noise] = target->noise_relmse;
    v[IRB_METRIC_reference_noise_rmse] = sqrt(target->noise_variance);
    v[IRB_METRIC_masked_share] = target->masked_share;
    if (!temporal)
        return;
    double variance = target->noise_variance + context->previous_target->noise_variance;
    v[IRB_METRIC_reference_flicker] = mean > 0 ? sqrt(variance) / mean : NAN;
}

bool irb_score_frame(struct irb_frame_scores *scores, const struct irb_score_context *context,
                     const struct irb_scored_trial *trial, const struct irb_scored_frame *current,
                     const struct irb_scored_frame *previous, struct irb_score_maps *maps,
                     struct irb_error *err)
{
    const struct irb_target *target = context->target;
    const struct irb_target_constants *c = context->constants;
    const struct irb_reference_settings *reference = &context->settings->reference;
    double *v = scores->values;
    irb_frame_scores_clear(scores);
    if (maps)
        *maps = (struct irb_score_maps){0};
    struct ranked indirect = ranked_image(false, context, current);
    struct ranked full = ranked_image(true, context, current);
    struct irb_pair solution = {&current->full, &target->solution, target->mask};
    struct irb_pair claim = {&current->indirect, &target->claim, target->mask};
    struct irb_error_scores errors = score_errors(&indirect, v);
    v[IRB_METRIC_non_finite] = (double)errors.non_finite;
    v[IRB_METRIC_negative] = (double)errors.negative;
    score_errors(&full, v);
    if (reference->bounces > 1)
        score_unranked(&solution, c->eps_solution, &v[IRB_METRIC_solution_rmse],
                       &v[IRB_METRIC_solution_relmse], &v[IRB_METRIC_solution_energy_ratio]);
    if (reference->unoccluded && !irb_trial_claims_visibility(trial->trial, current->frame))
        score_unranked(&claim, c->eps_claim, &v[IRB_METRIC_claim_rmse], &v[IRB_METRIC_claim_relmse],
                       &v[IRB_METRIC_claim_energy_ratio]);
    score_reference(context, previous != NULL, v);
    if (c->lag)
        irb_lag_errors(c->lag, current->frame, &current->indirect, target->mask,
                       scores->lag_errors);
    scores->present = score_ranked(scores, context, trial, &indirect, previous, maps, err) &&
                      score_flip_noise(target, &current->indirect, v, err) &&
                      score_ranked(scores, context, trial, &full, previous, NULL, err);
    return scores->present;
}

void irb_score_maps_destroy(struct irb_score_maps *maps)
{
    irb_image_destroy(&maps->flip);
    irb_image_destroy(&maps->residual);
}
