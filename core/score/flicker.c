/* SPDX-License-Identifier: MIT */
#include "core/score/flicker.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { CHANNELS = 3 };

/* |e_t - e_(t-1)|^2 */
static double residual_change(const struct irb_pair *previous, const struct irb_pair *current,
                              size_t pixel)
{
    double sum = 0;
    for (size_t i = CHANNELS * pixel; i < CHANNELS * (pixel + 1); i++) {
        double now = (double)current->test->data[i] - current->reference->data[i];
        double before = (double)previous->test->data[i] - previous->reference->data[i];
        sum += (now - before) * (now - before);
    }
    return sum / CHANNELS;
}

static double magnitude(const float *rgb)
{
    double sum = 0;
    for (int c = 0; c < CHANNELS; c++)
        sum += (double)rgb[c] * rgb[c];
    return sqrt(sum / CHANNELS);
}

static bool counts_in_both(const struct irb_pair *previous, const struct irb_pair *current,
                           size_t pixel)
{
    return irb_pair_counts(previous, pixel) && irb_pair_counts(current, pixel);
}

/* Whether a squared residual is a pop. */
static bool is_pop(double change, const struct irb_pair *current, size_t pixel,
                   double mean_reference)
{
    const double threshold = 0.1, dark_share = 0.1; /* of the definition in the header */
    double level = magnitude(current->reference->data + CHANNELS * pixel);
    return sqrt(change) > threshold * fmax(level, dark_share * mean_reference);
}

struct irb_flicker_scores irb_score_flicker(const struct irb_pair *previous,
                                            const struct irb_pair *current, double mean_reference)
{
    double sum = 0;
    long count = 0, pops = 0;
    size_t pixels = irb_image_pixels(current->test);
    for (size_t i = 0; i < pixels; i++) {
        if (!counts_in_both(previous, current, i))
            continue;
        double change = residual_change(previous, current, i);
        sum += change;
        pops += is_pop(change, current, i, mean_reference);
        count++;
    }
    double residual = sqrt(sum / (double)count);
    return (struct irb_flicker_scores){
        .flicker = residual == 0 ? 0 : residual / mean_reference,
        .pop_share = (double)pops / (double)count,
    };
}

bool irb_residual_map(const struct irb_pair *previous, const struct irb_pair *current,
                      double mean_reference, struct irb_image *map, struct irb_error *err)
{
    if (!irb_image_create(map, current->test->width, current->test->height, 1, err))
        return false;
    for (size_t i = 0; mean_reference > 0 && i < irb_image_pixels(map); i++)
        if (counts_in_both(previous, current, i))
            map->data[i] =
                (float)fmin(sqrt(residual_change(previous, current, i)) / mean_reference, FLT_MAX);
    return true;
}

bool irb_flicker_sum_create(struct irb_flicker_sum *sum, int width, int height,
                            struct irb_error *err)
{
    size_t pixels = (size_t)width * (size_t)height;
    *sum = (struct irb_flicker_sum){
        .width = width,
        .height = height,
        .square = calloc(pixels, sizeof *sum->square),
        .pops = calloc(pixels, sizeof *sum->pops),
        .pairs = calloc(pixels, sizeof *sum->pairs),
    };
    if (sum->square && sum->pops && sum->pairs)
        return true;
    irb_flicker_sum_destroy(sum);
    return irb_fail(err, IRB_E_MEMORY, "no memory for the flicker of %d x %d pixels", width,
                    height);
}

void irb_flicker_sum_destroy(struct irb_flicker_sum *sum)
{
    free(sum->square);
    free(sum->pops);
    free(sum->pairs);
    *sum = (struct irb_flicker_sum){0};
}

void irb_flicker_sum_add(struct irb_flicker_sum *sum, const struct irb_pair *previous,
                         const struct irb_pair *current, double mean_reference)
{
    for (size_t i = 0; i < (size_t)sum->width * (size_t)sum->height; i++) {
        if (!counts_in_both(previous, current, i))
            continue;
        double change = residual_change(previous, current, i);
        if (mean_reference > 0)
            sum->square[i] += change / (mean_reference * mean_reference);
        sum->pops[i] += is_pop(change, current, i, mean_reference);
        sum->pairs[i]++;
    }
}

bool irb_flicker_maps_of(struct irb_flicker_maps *maps, const struct irb_flicker_sum *sum,
                         struct irb_error *err)
{
    *maps = (struct irb_flicker_maps){0};
    if (!irb_image_create(&maps->flicker, sum->width, sum->height, 1, err) ||
        !irb_image_create(&maps->pops, sum->width, sum->height, 1, err) ||
        !irb_image_create(&maps->pairs, sum->width, sum->height, 1, err)) {
        irb_flicker_maps_destroy(maps);
        return false;
    }
    for (size_t i = 0; i < irb_image_pixels(&maps->flicker); i++) {
        if (sum->pairs[i])
            maps->flicker.data[i] = (float)fmin(sqrt(sum->square[i] / sum->pairs[i]), FLT_MAX);
        maps->pops.data[i] = (float)sum->pops[i];
        maps->pairs.data[i] = (float)sum->pairs[i];
    }
    return true;
}

void irb_flicker_maps_destroy(struct irb_flicker_maps *maps)
{
    irb_image_destroy(&maps->flicker);
    irb_image_destroy(&maps->pops);
    irb_image_destroy(&maps->pairs);
}
