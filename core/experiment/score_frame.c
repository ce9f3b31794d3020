/* SPDX-License-Identifier: MIT */
#include "core/experiment/score_frame.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/frame/composite.h"
#include "core/score/metrics.h"

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
    *scored = (struct irb_scored_trial){.trial = trial, .scene = sequence->entry->name};
    scored->id = irb_store_trial_find(run->store, scored->scene, trial->name, run->config->seed);
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
    char *path = irb_run_file(run->dir, trial->scene, trial->trial->name, "frame", frame, "exr");
    bool ok = irb_frame_file_load(path, &file, err);
    free(path);
    if (!ok)
        return false;
    ok = irb_composite(&target->gbuffer, &target->direct, &file.irradiance,
                       file.radiance.data ? &file.radiance : NULL, &out->indirect, &out->full, err);
    irb_frame_file_destroy(&file);
    return ok;
}

/* RMSE, relMSE, bias and energy ratio of one image, into four consecutive metrics. */
static struct irb_error_scores score_image(const struct irb_pair *pair, double eps, double *rmse,
                                           double *relmse, double *bias, double *energy_ratio)
{
    struct irb_error_scores scores = irb_score_errors(pair, eps);
    *rmse = scores.rmse;
    *relmse = scores.relmse;
    if (bias)
        *bias = scores.bias;
    *energy_ratio = scores.energy_ratio;
    return scores;
}

/* reference NULL: a black sequence, for which FLIP is not defined. */
static bool score_flip(const struct irb_pair *pair, const struct irb_flip_reference *reference,
                       double *value, struct irb_error *err)
{
    struct irb_flip_scores scores;
    /* one thread: the trials are what runs in parallel */
    if (reference &&
        !irb_flip_hdr_prepared(pair->test, reference, pair->mask, 1, NULL, &scores, err))
        return false;
    if (reference)
        *value = scores.mean;
    return true;
}

/* The previous frame's pair, brought to this frame's pixels where the camera moved. */
struct warped_pair {
    struct irb_pair pair;
    struct irb_image test, reference; /* owned where warped */
    uint8_t *mask;                    /* owned where warped */
};

static bool warp_pair(struct warped_pair *out, const struct irb_pair *previous,
                      const struct irb_reprojection *motion, struct irb_error *err)
{
    *out = (struct warped_pair){.pair = *previous};
    if (!motion)
        return true;
    size_t pixels = irb_image_pixels(previous->test);
    out->mask = malloc(pixels);
    if (!out->mask)
        return irb_fail(err, IRB_E_MEMORY, "no memory for a mask of %zu pixels", pixels);
    for (size_t i = 0; i < pixels; i++)
        out->mask[i] = motion->source[i] >= 0 && previous->mask[motion->source[i]];
    if (!irb_reprojection_apply(motion, previous->test, &out->test, err) ||
        !irb_reprojection_apply(motion, previous->reference, &out->reference, err))
        return false;
    out->pair = (struct irb_pair){&out->test, &out->reference, out->mask};
    return true;
}

static bool score_flicker(const struct irb_pair *previous, const struct irb_pair *current,
                          const struct irb_reprojection *motion, double mean_reference,
                          double *flicker, double *pop_share, struct irb_error *err)
{
    struct warped_pair warped;
    bool ok = warp_pair(&warped, previous, motion, err);
    if (ok) {
        struct irb_flicker_scores scores =
            irb_score_flicker(&warped.pair, current, mean_reference);
        *flicker = scores.flicker;
        *pop_share = scores.pop_share;
    }
    irb_image_destroy(&warped.test);
    irb_image_destroy(&warped.reference);
    free(warped.mask);
    return ok;
}

static bool score_temporal(double *v, const struct irb_score_context *context,
                           const struct irb_pair *indirect, const struct irb_pair *full,
                           const struct irb_scored_frame *previous, struct irb_error *err)
{
    const struct irb_target *before = context->previous_target;
    const struct irb_target_constants *c = context->constants;
    struct irb_pair indirect_before = {&previous->indirect, &before->indirect, before->mask};
    struct irb_pair full_before = {&previous->full, &before->full, before->mask};
    double variance = context->target->noise_variance + before->noise_variance;
    v[IRB_METRIC_reference_flicker] =
        c->mean_indirect > 0 ? sqrt(variance) / c->mean_indirect : NAN;
    return score_flicker(&indirect_before, indirect, context->motion, c->mean_indirect,
                         &v[IRB_METRIC_indirect_flicker], &v[IRB_METRIC_indirect_pop_share],
                         err) &&
           score_flicker(&full_before, full, context->motion, c->mean_full,
                         &v[IRB_METRIC_full_flicker], &v[IRB_METRIC_full_pop_share], err);
}

bool irb_score_frame(struct irb_frame_scores *scores, const struct irb_score_context *context,
                     const struct irb_scored_trial *trial, const struct irb_scored_frame *current,
                     const struct irb_scored_frame *previous, struct irb_error *err)
{
    const struct irb_target *target = context->target;
    const struct irb_target_constants *c = context->constants;
    double *v = scores->values;
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        v[i] = NAN;
    struct irb_pair indirect = {&current->indirect, &target->indirect, target->mask};
    struct irb_pair full = {&current->full, &target->full, target->mask};
    struct irb_pair solution = {&current->full, &target->solution, target->mask};
    struct irb_pair claim = {&current->indirect, &target->claim, target->mask};
    struct irb_error_scores errors = score_image(
        &indirect, c->eps_indirect, &v[IRB_METRIC_indirect_rmse], &v[IRB_METRIC_indirect_relmse],
        &v[IRB_METRIC_indirect_bias], &v[IRB_METRIC_indirect_energy_ratio]);
    v[IRB_METRIC_non_finite] = (double)errors.non_finite;
    v[IRB_METRIC_negative] = (double)errors.negative;
    score_image(&full, c->eps_full, &v[IRB_METRIC_full_rmse], &v[IRB_METRIC_full_relmse],
                &v[IRB_METRIC_full_bias], &v[IRB_METRIC_full_energy_ratio]);
    if (context->settings->reference.bounces > 1)
        score_image(&solution, c->eps_solution, &v[IRB_METRIC_solution_rmse],
                    &v[IRB_METRIC_solution_relmse], NULL, &v[IRB_METRIC_solution_energy_ratio]);
    if (context->settings->reference.unoccluded && !trial->trial->method->claims_visibility)
        score_image(&claim, c->eps_claim, &v[IRB_METRIC_claim_rmse], &v[IRB_METRIC_claim_relmse],
                    NULL, &v[IRB_METRIC_claim_energy_ratio]);
    v[IRB_METRIC_reference_noise] = target->noise_relmse;
    scores->present =
        score_flip(&indirect, target->flip_indirect, &v[IRB_METRIC_indirect_flip], err) &&
        score_flip(&full, target->flip_full, &v[IRB_METRIC_full_flip], err) &&
        (!previous || score_temporal(v, context, &indirect, &full, previous, err));
    return scores->present;
}

bool irb_frame_scores_store(const struct irb_frame_scores *scores, struct irb_store *store,
                            int64_t trial, int frame, struct irb_error *err)
{
    struct irb_store_value values[IRB_METRIC_COUNT];
    int count = 0;
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        if (!isnan(scores->values[i]))
            values[count++] = (struct irb_store_value){irb_metrics[i].name, scores->values[i]};
    return irb_store_scores(store, trial, frame, values, count, err);
}

struct frames_reader {
    struct irb_frame_scores *frames;
    int count;
};

static void read_value(void *user, int frame, const char *name, double value)
{
    struct frames_reader *reader = user;
    int metric = irb_metric_find(name);
    if (frame < 0 || frame >= reader->count || metric < 0)
        return;
    struct irb_frame_scores *scores = &reader->frames[frame];
    if (!scores->present)
        for (int i = 0; i < IRB_METRIC_COUNT; i++)
            scores->values[i] = NAN;
    scores->present = true;
    scores->values[metric] = value;
}

bool irb_frame_scores_read(struct irb_frame_scores *frames, int count, struct irb_store *store,
                           int64_t trial, struct irb_error *err)
{
    struct frames_reader reader = {frames, count};
    return irb_store_read_scores(store, trial, read_value, &reader, err);
}

int irb_worst_frame(const struct irb_frame_scores *frames, int count)
{
    int worst = 0;
    for (int i = 1; i < count; i++)
        if (frames[i].values[IRB_METRIC_indirect_relmse] >
            frames[worst].values[IRB_METRIC_indirect_relmse])
            worst = i;
    return worst;
}

/* How the values of the frames become the sequence's. */
enum aggregate { MEAN, ROOT_MEAN_SQUARE, SUM };

static enum aggregate aggregate_of(int metric)
{
    switch (metric) {
    case IRB_METRIC_indirect_rmse:
    case IRB_METRIC_full_rmse:
    case IRB_METRIC_solution_rmse:
    case IRB_METRIC_claim_rmse:
    case IRB_METRIC_indirect_flicker:
    case IRB_METRIC_full_flicker:
    case IRB_METRIC_reference_flicker:
        return ROOT_MEAN_SQUARE;
    case IRB_METRIC_non_finite:
    case IRB_METRIC_negative:
        return SUM;
    default:
        return MEAN;
    }
}

static double aggregate(const struct irb_frame_scores *frames, int count, int metric)
{
    double sum = 0, squares = 0;
    int n = 0;
    for (int i = 0; i < count; i++) {
        double value = frames[i].values[metric];
        if (isnan(value))
            continue;
        sum += value;
        squares += value * value;
        n++;
    }
    if (!n)
        return NAN;
    switch (aggregate_of(metric)) {
    case ROOT_MEAN_SQUARE:
        return sqrt(squares / n);
    case SUM:
        return sum;
    default:
        return sum / n;
    }
}

/* lost_energy: mean; gl_bytes: largest. */
struct statistics {
    double lost_energy, bytes;
    int lost_count;
};

static void read_statistic(void *user, int frame, const char *name, double value)
{
    struct statistics *s = user;
    if (frame < 0 || isnan(value))
        return;
    if (!strcmp(name, "lost_energy")) {
        s->lost_energy += value;
        s->lost_count++;
    } else if (!strcmp(name, "gl_bytes") && !(value <= s->bytes)) {
        s->bytes = value;
    }
}

bool irb_sequence_scores_store(const struct irb_frame_scores *frames, int count,
                               const struct irb_target_constants *constants,
                               struct irb_store *store, int64_t trial, struct irb_error *err)
{
    struct irb_frame_scores whole = {.present = true};
    struct statistics statistics = {.bytes = NAN};
    if (!irb_store_read_statistics(store, trial, read_statistic, &statistics, err))
        return false;
    double *v = whole.values;
    for (int i = 0; i < IRB_METRIC_COUNT; i++)
        v[i] = aggregate(frames, count, i);
    /* sum v / sum r = 1 + sum (v - r) / sum r */
    if (constants->mean_indirect > 0)
        v[IRB_METRIC_indirect_energy_ratio] =
            1 + v[IRB_METRIC_indirect_bias] / constants->mean_indirect;
    if (constants->mean_full > 0)
        v[IRB_METRIC_full_energy_ratio] = 1 + v[IRB_METRIC_full_bias] / constants->mean_full;
    v[IRB_METRIC_lost_energy] =
        statistics.lost_count ? statistics.lost_energy / statistics.lost_count : NAN;
    v[IRB_METRIC_gl_bytes] = statistics.bytes;
    return irb_frame_scores_store(&whole, store, trial, -1, err);
}

bool irb_target_constants_store(const struct irb_target_constants *constants, struct irb_run *run,
                                const struct irb_sequence *sequence, struct irb_error *err)
{
    const struct irb_store_value values[] = {
        {"mean_indirect", constants->mean_indirect},
        {"mean_full", constants->mean_full},
        {"relmse_eps_indirect", constants->eps_indirect},
        {"relmse_eps_full", constants->eps_full},
        {"flip_indirect_start", constants->flip_indirect.start},
        {"flip_indirect_stop", constants->flip_indirect.stop},
        {"flip_indirect_exposures", constants->flip_indirect.count},
        {"flip_full_start", constants->flip_full.start},
        {"flip_full_stop", constants->flip_full.stop},
        {"flip_full_exposures", constants->flip_full.count},
        {"preview_exposure", constants->exposure},
    };
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char *name = irb_asprintf("scene/%s/%s", sequence->entry->name, values[i].name);
        char *text = irb_asprintf("%.9g", values[i].value);
        bool ok = irb_store_set_meta(run->store, name, text, err);
        free(text);
        free(name);
        if (!ok)
            return false;
    }
    return true;
}
