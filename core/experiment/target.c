/* SPDX-License-Identifier: MIT */
#include "core/experiment/target.h"
#include "core/experiment/frame_file.h"
#include "core/experiment/paths.h"
#include "core/base/fs.h"
#include "core/frame/composite.h"
#include "core/image/exr.h"
#include "core/score/metrics.h"
#include "core/score/noise.h"
#include "core/score/profile.h"

#include <math.h>
#include <stdlib.h>

bool irb_target_view_create(struct irb_target_view *view, const struct irb_image *radiance,
                            double exposure, int threads, struct irb_error *err)
{
    struct irb_displayed displayed;
    *view = (struct irb_target_view){0};
    if (!irb_display(radiance, exposure, &displayed, err))
        return false;
    view->luma = displayed.luma; /* moved */
    view->flip = irb_flip_view_create(&displayed.linear, IRB_FLIP_PPD, threads, err);
    irb_image_destroy(&displayed.linear);
    if (!view->flip)
        irb_target_view_destroy(view);
    return view->flip != NULL;
}

void irb_target_view_destroy(struct irb_target_view *view)
{
    irb_image_destroy(&view->luma);
    irb_flip_reference_destroy(view->flip);
    view->flip = NULL;
}

void irb_target_unprepare(struct irb_target *target)
{
    irb_flip_reference_destroy(target->flip_indirect);
    irb_flip_reference_destroy(target->flip_full);
    irb_flip_reference_destroy(target->flip_noisy);
    target->flip_indirect = target->flip_full = target->flip_noisy = NULL;
    irb_target_view_destroy(&target->view_indirect);
    irb_target_view_destroy(&target->view_full);
    for (int i = 0; i < IRB_MOST_REGIONS; i++) {
        free(target->regions[i]);
        target->regions[i] = NULL;
    }
}

/* The target's mask inside the region. */
static bool region_mask(struct irb_target *target, int index, const struct irb_region *region,
                        struct irb_error *err)
{
    int width = target->indirect.width, height = target->indirect.height, box[4];
    if (!irb_region_pixels(region, width, height, box))
        return irb_fail(err, IRB_E_INTERNAL, "region %s: outside %d x %d pixels", region->name,
                        width, height);
    uint8_t *mask = calloc((size_t)width * (size_t)height, 1);
    target->regions[index] = mask;
    if (!mask)
        return irb_fail(err, IRB_E_MEMORY, "no memory for a mask of %d x %d pixels", width, height);
    for (int y = box[1]; y < box[3]; y++)
        for (int x = box[0]; x < box[2]; x++) {
            size_t i = (size_t)y * (size_t)width + (size_t)x;
            mask[i] = target->mask[i];
        }
    return true;
}

bool irb_target_prepare(struct irb_target *target, const struct irb_scene_entry *entry,
                        const struct irb_target_constants *constants, int threads,
                        struct irb_error *err)
{
    if (constants->indirect_lit &&
        !(target->flip_indirect = irb_flip_reference_create(
              &target->indirect, &constants->flip_indirect, IRB_FLIP_PPD, threads, err)))
        return false;
    if (constants->full_lit &&
        !(target->flip_full = irb_flip_reference_create(&target->full, &constants->flip_full,
                                                        IRB_FLIP_PPD, threads, err)))
        return false;
    if (!irb_target_view_create(&target->view_indirect, &target->indirect, constants->exposure,
                                threads, err) ||
        !irb_target_view_create(&target->view_full, &target->full, constants->exposure, threads,
                                err))
        return false;
    for (int i = 0; i < entry->region_count; i++)
        if (!region_mask(target, i, &entry->regions[i], err))
            return false;
    return true;
}

bool irb_target_prepare_noisy(struct irb_target *target,
                              const struct irb_target_constants *constants, int threads,
                              struct irb_error *err)
{
    const uint64_t seed = 1; /* any; the reference's own samples come from other sequences */
    struct irb_image noisy = {0};
    if (!constants->indirect_lit)
        return true;
    if (irb_noisy_image(&target->indirect, &target->deviation, seed, &noisy, err))
        target->flip_noisy = irb_flip_reference_create(&noisy, &constants->flip_indirect,
                                                       IRB_FLIP_PPD, threads, err);
    irb_image_destroy(&noisy);
    return target->flip_noisy != NULL;
}

void irb_target_destroy(struct irb_target *target)
{
    irb_target_unprepare(target);
    irb_gbuffer_image_destroy(&target->gbuffer);
    free(target->mask);
    irb_image_destroy(&target->direct);
    irb_image_destroy(&target->direct_reference);
    irb_image_destroy(&target->indirect);
    irb_image_destroy(&target->deviation);
    irb_image_destroy(&target->full);
    irb_image_destroy(&target->solution);
    irb_image_destroy(&target->claim);
    *target = (struct irb_target){0};
}

/* The frame whose mask file holds for `frame`: the first one with the same view. */
static int mask_frame(const struct irb_sequence *sequence, int frame)
{
    while (frame > 0 && irb_sequence_same_view(sequence, frame))
        frame--;
    return frame;
}

static bool make_mask(struct irb_target *target, const struct irb_run *run,
                      const struct irb_sequence *sequence, int frame, struct irb_error *err)
{
    size_t pixels = irb_image_pixels(&target->gbuffer.position);
    struct irb_image excluded = {0};
    char *path = irb_run_file(run->dir, sequence->entry->name, NULL, "mask",
                              mask_frame(sequence, frame), "exr");
    bool ok = !irb_fs_exists(path) || irb_exr_read(path, "mask", "Y", &excluded, err);
    free(path);
    target->mask = ok ? malloc(pixels) : NULL;
    if (ok && !target->mask)
        ok = irb_fail(err, IRB_E_MEMORY, "no memory for a mask of %zu pixels", pixels);
    size_t covered = 0, left_out = 0;
    for (size_t i = 0; ok && i < pixels; i++) {
        bool geometry = target->gbuffer.position.data[4 * i + 3] > 0;
        bool differs = excluded.data && excluded.data[i] > 0;
        covered += geometry;
        left_out += geometry && differs;
        target->mask[i] = geometry && !differs;
    }
    target->masked_share = covered ? (double)left_out / (double)covered : 0;
    irb_image_destroy(&excluded);
    return ok;
}

/* bounce 2 and the rest onto `full`, with the receiver's albedo. */
static bool add_higher_bounces(struct irb_target *target, struct irb_reference_image *reference,
                               struct irb_error *err)
{
    size_t values = 3 * irb_image_pixels(&reference->bounce2);
    for (size_t i = 0; i < values; i++)
        reference->bounce2.data[i] += reference->rest.data[i];
    struct irb_image higher = {0};
    bool ok = irb_composite(&target->gbuffer, &target->full, &reference->bounce2, NULL, &higher,
                            &target->solution, err);
    irb_image_destroy(&higher);
    return ok;
}

/* Variance of the indirect radiance: that of the irradiance's luminance times (albedo/pi)^2. */
static void noise_of(struct irb_target *target, const struct irb_image *variance,
                     const struct irb_target_constants *constants)
{
    size_t pixels = irb_image_pixels(variance), counted = 0;
    double absolute = 0, relative = 0;
    for (size_t i = 0; i < pixels; i++) {
        if (!target->mask[i])
            continue;
        const float *albedo = target->gbuffer.diffuse.data + 3 * i;
        const float *radiance = target->indirect.data + 3 * i;
        for (int c = 0; c < 3; c++) {
            double noise = (double)albedo[c] * albedo[c] / (M_PI * M_PI) * variance->data[i] / 3;
            absolute += noise;
            if (constants)
                relative += noise / ((double)radiance[c] * radiance[c] + constants->eps_indirect);
        }
        counted++;
    }
    target->noise_variance = counted ? absolute / (double)counted : 0;
    target->noise_relmse = counted ? relative / (double)counted : 0;
}

/* Standard deviation of the irradiance's luminance (Rec.709, as the tracer takes it), relative. */
static bool deviation_of(struct irb_target *target, const struct irb_reference_image *reference,
                         struct irb_error *err)
{
    const struct irb_image *irradiance = &reference->bounce1;
    if (!irb_image_create(&target->deviation, irradiance->width, irradiance->height, 1, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(irradiance); i++) {
        const float *e = irradiance->data + 3 * i;
        double luminance = 0.2126 * e[0] + 0.7152 * e[1] + 0.0722 * e[2];
        if (luminance > 0)
            target->deviation.data[i] =
                (float)(sqrt(fmax(0, reference->variance.data[i])) / luminance);
    }
    return true;
}

static bool load_reference(struct irb_reference_image *reference, const struct irb_run *run,
                           const struct irb_sequence_frame *frame, struct irb_error *err)
{
    char *path = irb_cache_reference(run->cache, &frame->reference);
    bool ok = irb_reference_image_load(reference, path, err);
    free(path);
    return ok;
}

bool irb_target_load(struct irb_target *target, const struct irb_run *run,
                     const struct irb_sequence *sequence, int frame,
                     const struct irb_target_constants *constants, struct irb_error *err)
{
    *target = (struct irb_target){0};
    struct irb_reference_image reference = {0};
    struct irb_image unused = {0};
    const struct irb_sequence_frame *pose = &sequence->frames[frame];
    char *gbuffer = irb_cache_gbuffer(run->cache, &pose->gbuffer);
    char *direct = irb_run_file(run->dir, sequence->entry->name, NULL, "direct", frame, "exr");
    bool ok = irb_gbuffer_image_load(&target->gbuffer, gbuffer, err) &&
              load_reference(&reference, run, pose, err) &&
              make_mask(target, run, sequence, frame, err) &&
              (!irb_fs_exists(direct) || irb_direct_file_load(direct, &target->direct, err)) &&
              irb_composite(&target->gbuffer, &reference.direct, &reference.bounce1, NULL,
                            &target->indirect, &target->full, err) &&
              irb_composite(&target->gbuffer, &reference.direct, &reference.unoccluded, NULL,
                            &target->claim, &unused, err) &&
              add_higher_bounces(target, &reference, err) && deviation_of(target, &reference, err);
    if (ok) {
        noise_of(target, &reference.variance, constants);
        target->direct_reference = reference.direct; /* moved */
        reference.direct = (struct irb_image){0};
    }
    irb_image_destroy(&unused);
    irb_reference_image_destroy(&reference);
    free(direct);
    free(gbuffer);
    if (!ok)
        irb_target_destroy(target);
    return ok;
}

/* The images of all frames that the exposures are taken from. */
struct sequence_images {
    struct irb_image *indirect, *full;
    uint8_t **masks;
    int count;
};

static void add_means(struct irb_target_constants *c, const struct irb_target *target, int frames)
{
    c->mean_indirect += irb_masked_mean(&target->indirect, target->mask) / frames;
    c->mean_full += irb_masked_mean(&target->full, target->mask) / frames;
    c->mean_solution += irb_masked_mean(&target->solution, target->mask) / frames;
    c->mean_claim += irb_masked_mean(&target->claim, target->mask) / frames;
}

/* FLIP's exposures, PSNR's peak and the film's scale over all frames, through arrays of pointers.
 */
static bool scales_of(struct irb_image *images, uint8_t **masks, int count, double mean,
                      struct irb_flip_exposures *out, double *peak, struct irb_film_scale *film)
{
    const struct irb_image **references = malloc((size_t)count * sizeof *references);
    if (!references)
        return false;
    for (int i = 0; i < count; i++)
        references[i] = &images[i];
    const uint8_t *const *counted = (const uint8_t *const *)masks;
    bool lit = irb_flip_exposures_of(references, counted, count, out);
    *peak = irb_value_percentile(references, counted, count, IRB_PSNR_PEAK_FRACTION);
    *film = irb_film_scale_of(mean,
                              irb_value_percentile(references, counted, count, IRB_FILM_FRACTION));
    free(references);
    return lit;
}

static bool collect_frames(struct sequence_images *images, struct irb_target_constants *c,
                           const struct irb_run *run, const struct irb_sequence *sequence,
                           struct irb_error *err)
{
    for (int i = 0; i < sequence->frame_count; i++) {
        struct irb_target target;
        if (!irb_target_load(&target, run, sequence, i, NULL, err))
            return false;
        add_means(c, &target, sequence->frame_count);
        c->view_rests = c->view_rests && (i == 0 || irb_sequence_same_view(sequence, i));
        if (i == 0 && run->config->render.exposure <= 0)
            c->exposure = irb_exposure_of(&target.full, &target.gbuffer);
        images->indirect[i] = target.indirect;
        images->full[i] = target.full;
        images->masks[i] = target.mask;
        images->count = i + 1;
        target.indirect = target.full = (struct irb_image){0}; /* moved */
        target.mask = NULL;
        irb_target_destroy(&target);
    }
    return true;
}

/* The row that the config names, else the one where the reference changes most. */
static bool set_profile_row(struct irb_target_constants *c, const struct sequence_images *images,
                            const struct irb_scene_entry *entry, struct irb_error *err)
{
    int height = images->indirect->height;
    if (irb_profile_row(entry, height, &c->profile_row))
        return true;
    double *rows = calloc((size_t)height, sizeof *rows);
    if (!rows)
        return irb_fail(err, IRB_E_MEMORY, "no memory for %d rows", height);
    for (int i = 1; i < images->count; i++)
        irb_row_change_add(rows, &images->indirect[i - 1], &images->indirect[i]);
    c->profile_row = irb_busiest_row(rows, height);
    free(rows);
    return true;
}

/* Keeps what the lag is taken from: nothing where camera or objects move, or the sequence is short.
 */
static bool set_lag(struct irb_target_constants *c, const struct sequence_images *images,
                    struct irb_error *err)
{
    struct irb_lag_range range = irb_lag_range(images->count);
    if (!c->view_rests || range.first > range.last)
        return true;
    c->lag = irb_lag_reference_create(images->indirect->width, images->indirect->height,
                                      images->count, err);
    for (int i = 0; c->lag && i < images->count; i++)
        irb_lag_reference_set(c->lag, i, &images->indirect[i]);
    return c->lag != NULL;
}

void irb_target_constants_destroy(struct irb_target_constants *constants)
{
    irb_lag_reference_destroy(constants->lag);
    constants->lag = NULL;
}

bool irb_target_constants_of(struct irb_target_constants *constants, const struct irb_run *run,
                             const struct irb_sequence *sequence, struct irb_error *err)
{
    *constants =
        (struct irb_target_constants){.exposure = run->config->render.exposure, .view_rests = true};
    size_t n = (size_t)sequence->frame_count;
    struct sequence_images images = {
        .indirect = calloc(n, sizeof *images.indirect),
        .full = calloc(n, sizeof *images.full),
        .masks = calloc(n, sizeof *images.masks),
    };
    bool ok = images.indirect && images.full && images.masks;
    if (!ok)
        irb_fail(err, IRB_E_MEMORY, "no memory for %zu reference frames", n);
    ok = ok && collect_frames(&images, constants, run, sequence, err);
    if (ok) {
        constants->eps_indirect = irb_relmse_eps(constants->mean_indirect);
        constants->eps_full = irb_relmse_eps(constants->mean_full);
        constants->eps_solution = irb_relmse_eps(constants->mean_solution);
        constants->eps_claim = irb_relmse_eps(constants->mean_claim);
        constants->indirect_lit = scales_of(images.indirect, images.masks, images.count,
                                            constants->mean_indirect, &constants->flip_indirect,
                                            &constants->peak_indirect, &constants->film_indirect);
        constants->full_lit =
            scales_of(images.full, images.masks, images.count, constants->mean_full,
                      &constants->flip_full, &constants->peak_full, &constants->film_full);
        ok = set_profile_row(constants, &images, sequence->entry, err) &&
             set_lag(constants, &images, err);
    }
    for (int i = 0; i < images.count; i++) {
        irb_image_destroy(&images.indirect[i]);
        irb_image_destroy(&images.full[i]);
        free(images.masks[i]);
    }
    free(images.indirect);
    free(images.full);
    free(images.masks);
    return ok;
}
