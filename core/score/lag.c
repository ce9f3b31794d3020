/* SPDX-License-Identifier: MIT */
#include "core/score/lag.h"

#include <math.h>
#include <stdlib.h>

static const double unchanged = 1e-6; /* of the mean reference; source: ours */

enum { CHANNELS = 3, SHORTEST = 6 };

struct irb_lag_reference {
    int width, height, step, frames;
    size_t samples; /* of a frame */
    float *values;  /* frames x samples x CHANNELS; owned */
};

struct irb_lag_range irb_lag_range(int frames)
{
    if (frames < SHORTEST)
        return (struct irb_lag_range){0, -1};
    int ahead = frames / 6, behind = frames / 3;
    return (struct irb_lag_range){
        .first = ahead < -IRB_LAG_FIRST ? -ahead : IRB_LAG_FIRST,
        .last = behind < IRB_LAG_LAST ? behind : IRB_LAG_LAST,
    };
}

static size_t grid_points(int width, int height, int step)
{
    return (size_t)((width + step - 1) / step) * (size_t)((height + step - 1) / step);
}

struct irb_lag_reference *irb_lag_reference_create(int width, int height, int frames,
                                                   struct irb_error *err)
{
    struct irb_lag_reference *out = malloc(sizeof *out);
    if (!out) {
        irb_fail(err, IRB_E_MEMORY, "lag: out of memory");
        return NULL;
    }
    *out =
        (struct irb_lag_reference){.width = width, .height = height, .step = 1, .frames = frames};
    while (grid_points(width, height, out->step) > IRB_LAG_PIXELS)
        out->step++;
    out->samples = grid_points(width, height, out->step);
    out->values = calloc((size_t)frames * out->samples * CHANNELS, sizeof *out->values);
    if (out->values)
        return out;
    irb_fail(err, IRB_E_MEMORY, "lag of %d frames: out of memory", frames);
    irb_lag_reference_destroy(out);
    return NULL;
}

void irb_lag_reference_destroy(struct irb_lag_reference *reference)
{
    if (!reference)
        return;
    free(reference->values);
    free(reference);
}

static float *frame_values(const struct irb_lag_reference *reference, int frame)
{
    return reference->values + (size_t)frame * reference->samples * CHANNELS;
}

void irb_lag_reference_set(struct irb_lag_reference *reference, int frame,
                           const struct irb_image *image)
{
    float *out = frame_values(reference, frame);
    for (int y = 0; y < image->height; y += reference->step)
        for (int x = 0; x < image->width; x += reference->step)
            for (int c = 0; c < CHANNELS; c++)
                *out++ = irb_image_at(image, x, y)[c];
}

static bool finite3(const float *v)
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static double mean_difference(const struct irb_lag_reference *reference,
                              const struct irb_image *image, const uint8_t *mask,
                              const float *other)
{
    double sum = 0;
    long count = 0;
    for (int y = 0; y < image->height; y += reference->step)
        for (int x = 0; x < image->width; x += reference->step, other += CHANNELS) {
            const float *v = irb_image_at(image, x, y);
            if ((mask && !mask[(size_t)y * (size_t)image->width + (size_t)x]) || !finite3(v) ||
                !finite3(other))
                continue;
            for (int c = 0; c < CHANNELS; c++)
                sum += fabs((double)v[c] - other[c]);
            count += CHANNELS;
        }
    return sum / (double)count;
}

void irb_lag_errors(const struct irb_lag_reference *reference, int frame,
                    const struct irb_image *image, const uint8_t *mask,
                    double errors[IRB_LAG_COUNT])
{
    for (int i = 0; i < IRB_LAG_COUNT; i++) {
        int other = frame - (IRB_LAG_FIRST + i);
        bool there = other >= 0 && other < reference->frames;
        errors[i] =
            there ? mean_difference(reference, image, mask, frame_values(reference, other)) : NAN;
    }
}

double irb_lag(const double (*errors)[IRB_LAG_COUNT], int frames, double mean_reference)
{
    struct irb_lag_range range = irb_lag_range(frames);
    double least = INFINITY, largest = 0;
    int lag = 0;
    for (int tau = range.first; tau <= range.last; tau++) {
        double sum = 0;
        /* the frames that have a partner at every shift */
        for (int t = range.last; t < frames + range.first; t++)
            sum += errors[t][tau - IRB_LAG_FIRST];
        if (isnan(sum))
            return NAN;
        if (sum < least || (sum == least && abs(tau) < abs(lag)))
            lag = tau;
        least = fmin(least, sum);
        largest = fmax(largest, sum);
    }
    int compared = frames + range.first - range.last;
    bool flat = !(largest - least > unchanged * mean_reference * compared);
    return range.first > range.last || flat ? NAN : lag;
}
