/* SPDX-License-Identifier: MIT */
#include "core/scene/keyframes.h"

#include <math.h>

const char *const irb_interpolation_names[] = {"linear", "catmull-rom", NULL};

/* `frames` is the first key's frame; keys lie `stride` bytes apart. */
static double frame_of(const float *frames, size_t stride, int key)
{
    return *(const float *)(const void *)((const char *)frames + stride * (size_t)key);
}

struct irb_key_segment irb_keys_find(const float *frames, size_t stride, int count, double frame)
{
    struct irb_key_segment segment = {0};
    double first = frame_of(frames, stride, 0), last = frame_of(frames, stride, count - 1);
    int k = 0;

    frame = fmax(frame, 0); /* settle frames equal frame 0 */
    frame = fmin(fmax(frame, first), last);
    while (k + 2 < count && frame_of(frames, stride, k + 1) <= frame)
        k++;
    for (int i = 0; i < 4; i++) {
        int key = k - 1 + i;

        segment.keys[i] = key < 0 ? 0 : (key >= count ? count - 1 : key);
        segment.frames[i] = frame_of(frames, stride, segment.keys[i]);
    }
    if (segment.frames[2] > segment.frames[1])
        segment.s = (frame - segment.frames[1]) / (segment.frames[2] - segment.frames[1]);
    return segment;
}

/* Slope (units a frame) at key i = 1 or 2: the chord between its neighbours, (p[i+1] - p[i-1]) /
 * (t[i+1] - t[i-1]), which is Catmull and Rom 1974 where keys are evenly spaced; one-sided at the
 * first and last key. */
static double tangent(const struct irb_key_segment *segment, const double p[4], int i)
{
    return (p[i + 1] - p[i - 1]) / (segment->frames[i + 1] - segment->frames[i - 1]);
}

/* Value of one scalar whose four keys are p. */
static double interpolate(const struct irb_key_segment *segment, enum irb_interpolation kind,
                          const double p[4])
{
    double s = segment->s, length = segment->frames[2] - segment->frames[1];

    if (!(length > 0) || s <= 0)
        return p[1];
    if (s >= 1)
        return p[2];
    if (kind == IRB_LINEAR)
        return p[1] + (p[2] - p[1]) * s;
    /* cubic Hermite */
    double s2 = s * s, s3 = s2 * s;

    return (2 * s3 - 3 * s2 + 1) * p[1] + (s3 - 2 * s2 + s) * length * tangent(segment, p, 1) +
           (3 * s2 - 2 * s3) * p[2] + (s3 - s2) * length * tangent(segment, p, 2);
}

double irb_keys_value(const struct irb_key_segment *segment, enum irb_interpolation kind,
                      const float *values, size_t stride, bool bounded)
{
    double p[4], value;

    for (int i = 0; i < 4; i++)
        p[i] = frame_of(values, stride, segment->keys[i]);
    value = interpolate(segment, kind, p);
    return bounded ? fmin(fmax(value, fmin(p[1], p[2])), fmax(p[1], p[2])) : value;
}
