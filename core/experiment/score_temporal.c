/* SPDX-License-Identifier: MIT */
#include "core/experiment/score_temporal.h"

#include <math.h>
#include <stdlib.h>

bool irb_warp_pair(struct irb_warped_pair *out, const struct irb_pair *previous,
                   const struct irb_reprojection *motion, struct irb_error *err)
{
    *out = (struct irb_warped_pair){.pair = *previous};
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

void irb_warped_pair_destroy(struct irb_warped_pair *warped)
{
    irb_image_destroy(&warped->test);
    irb_image_destroy(&warped->reference);
    free(warped->mask);
}

/* What the test image would be if it followed the reference exactly: max(0, I_(t-1) + R_t -
 * R_(t-1)), where both frames have a finite pixel; elsewhere the test image itself, and `mask` is 0
 * there. */
static bool follow_reference(const struct irb_pair *previous, const struct irb_pair *current,
                             struct irb_image *expected, uint8_t *mask, struct irb_error *err)
{
    const struct irb_image *test = current->test;
    if (!irb_image_create(expected, test->width, test->height, 3, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(test); i++) {
        mask[i] = previous->mask[i] && current->mask[i];
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            /* the error first: where there is none, the result is the reference to the bit */
            double error = (double)previous->test->data[c] - previous->reference->data[c];
            double value = current->reference->data[c] + error;
            expected->data[c] = value > 0 ? (float)value : 0;
            mask[i] = mask[i] && isfinite(value) && isfinite(test->data[c]);
        }
        for (size_t c = 3 * i; !mask[i] && c < 3 * i + 3; c++)
            expected->data[c] = test->data[c];
    }
    return true;
}

bool irb_temporal_flip(struct irb_temporal_flip *out, const struct irb_pair *previous,
                       const struct irb_pair *current, const struct irb_target_view *shown,
                       double exposure, struct irb_error *err)
{
    struct irb_image expected = {0};
    struct irb_target_view expected_view = {0};
    struct irb_flip_scores flip;
    *out = (struct irb_temporal_flip){.mean = NAN};
    out->mask = malloc(irb_image_pixels(current->test));
    bool ok = out->mask != NULL;
    if (!ok)
        irb_fail(err, IRB_E_MEMORY, "no memory for a mask");
    ok = ok && follow_reference(previous, current, &expected, out->mask, err) &&
         irb_target_view_create(&expected_view, &expected, exposure, 1, err) &&
         irb_flip_views(shown->flip, expected_view.flip, out->mask, 1, &out->map, &flip, err);
    if (ok)
        out->mean = flip.mean;
    irb_target_view_destroy(&expected_view);
    irb_image_destroy(&expected);
    return ok;
}

bool irb_temporal_flip_mean(const struct irb_temporal_flip *flip, const uint8_t *mask, double *mean,
                            struct irb_error *err)
{
    size_t pixels = irb_image_pixels(&flip->map);
    uint8_t *both = malloc(pixels);
    if (!both)
        return irb_fail(err, IRB_E_MEMORY, "no memory for a mask of %zu pixels", pixels);
    for (size_t i = 0; i < pixels; i++)
        both[i] = flip->mask[i] && mask[i];
    *mean = irb_masked_mean(&flip->map, both);
    free(both);
    return true;
}

void irb_temporal_flip_destroy(struct irb_temporal_flip *flip)
{
    irb_image_destroy(&flip->map);
    free(flip->mask);
    *flip = (struct irb_temporal_flip){0};
}
