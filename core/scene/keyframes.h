/* SPDX-License-Identifier: MIT
 *
 * Interpolation between keyframes that lie in an array of structs.
 */
#ifndef IRB_SCENE_KEYFRAMES_H
#define IRB_SCENE_KEYFRAMES_H

#include <stdbool.h>
#include <stddef.h>

enum irb_interpolation { IRB_LINEAR, IRB_CATMULL_ROM };
extern const char *const irb_interpolation_names[]; /* "linear", "catmull-rom", NULL */

/* A frame's place among the keys: between keys[1] and keys[2] at s in [0,1], with their neighbours
 * for the tangents (the same key again at the ends). */
struct irb_key_segment {
    int keys[4];
    double frames[4];
    double s;
};

/* `frames` is the first key's frame; keys lie `stride` bytes apart, in rising order. Frames before
 * the first and after the last key are moved to it, those below 0 to frame 0. */
struct irb_key_segment irb_keys_find(const float *frames, size_t stride, int count, double frame);

/* One scalar there; `values` is the first key's. Scalars that have a range (intensities, angles,
 * scales) must not overshoot their two keys: `bounded`. */
double irb_keys_value(const struct irb_key_segment *segment, enum irb_interpolation kind,
                      const float *values, size_t stride, bool bounded);

#endif
