/* SPDX-License-Identifier: MIT
 *
 * Scripted light and camera: keyframes over a fixed number of frames, no wall clock.
 */
#ifndef IRB_SCENE_ANIMATION_H
#define IRB_SCENE_ANIMATION_H

#include "core/scene/keyframes.h"
#include "core/scene/light.h"
#include "core/scene/scene.h"

/* One keyframe of the light; angles in degrees, as the config gives them. */
struct irb_light_key {
    float frame; /* need not be whole; keys are in rising order */
    float position[3], target[3];
    float intensity[3]; /* W/sr or W/m2 */
    float cone;         /* outer half-angle omega_s, degrees, (0, 90) */
    float inner;        /* inner half-angle, degrees, [0, cone) */
};

struct irb_camera_key {
    float frame;
    float position[3], target[3], up[3];
    float fov; /* vertical, full, degrees, (0, 180) */
};

struct irb_animation {
    enum irb_interpolation light_interpolation, camera_interpolation;
    enum irb_light_type light_type;
    enum irb_falloff falloff;
    float beam_half_width;            /* directional, metres; 0 = wide enough for the scene */
    float z_near, z_far;              /* camera; 0 = from the scene's bounds */
    struct irb_light_key *light_keys; /* owned */
    int light_key_count;
    struct irb_camera_key *camera_keys; /* owned */
    int camera_key_count;
};

void irb_animation_destroy(struct irb_animation *animation); /* frees what it owns, zeroes it */

/* Checks what cannot be evaluated: no keys, keys out of order, position equal to target, angles
 * out of range, non-finite values, up parallel to the view. The message names the key ("light key
 * 2:
 * ..."); put the file before it with irb_error_prefix(). */
bool irb_animation_validate(const struct irb_animation *animation, struct irb_error *err);

/* Light and camera of frame `frame` (clamped to the first and last key). Frames below 0 are the
 * settle frames and equal frame 0. `scene` gives the bounds for near, far and beam. */
void irb_animation_light(const struct irb_animation *animation, const struct irb_scene *scene,
                         float frame, struct irb_light *out);
void irb_animation_camera(const struct irb_animation *animation, const struct irb_scene *scene,
                          float frame, struct irb_camera *out);

/* What a light or camera of a scene's file leaves open, from the scene's current bounds: the half
 * width of a beam, the near and far planes where they are 0. */
void irb_light_fit(struct irb_light *light, const struct irb_scene *scene);
void irb_camera_fit(struct irb_camera *camera, const struct irb_scene *scene);

#endif
