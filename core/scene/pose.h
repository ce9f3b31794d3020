/* SPDX-License-Identifier: MIT
 *
 * Where a scene's objects are in a frame: the scene's own animation, and keyframed transforms on
 * top of it. Frames need not be whole; no wall clock.
 */
#ifndef IRB_SCENE_POSE_H
#define IRB_SCENE_POSE_H

#include "core/scene/keyframes.h"
#include "core/scene/scene.h"

/* One keyframe of an object. The rotation is interpolated as axis times angle, so that keys about
 * one axis may turn by any number of turns. */
struct irb_pose_key {
    float frame;        /* keys are in rising order */
    float translate[3]; /* m */
    float rotation[3];  /* unit axis times angle, degrees */
    float scale[3];     /* along the world's axes, above 0 */
};

/* Moves every object of that name: scaled, turned about `pivot`, then moved. */
struct irb_object_script {
    char *name;     /* owned */
    char *place;    /* "FILE:LINE:COLUMN" for messages, or NULL; owned */
    bool has_pivot; /* else: the centre of the bounds at rest of all objects of that name */
    float pivot[3]; /* m, world */
    enum irb_interpolation interpolation;
    struct irb_pose_key *keys; /* owned */
    int key_count;
};

struct irb_poses {
    bool plays;       /* the scene's own animation: frame i is shown at start + i/fps */
    float fps, start; /* 1/s, above 0; s */
    char *place;      /* of the above, for messages, or NULL; owned */
    struct irb_object_script *objects; /* owned */
    int object_count;
};

void irb_poses_destroy(struct irb_poses *poses); /* frees what it owns, zeroes it */

/* Whether anything may move. */
static inline bool irb_poses_move(const struct irb_poses *poses)
{
    return poses->plays || poses->object_count > 0;
}

/* IRB_E_INPUT with the place: no object of that name (with the nearest one), no animation in the
 * file. */
bool irb_poses_check(const struct irb_poses *poses, const struct irb_scene *scene,
                     struct irb_error *err);

/* Sets every object's transform, and the current vertices, to those of frame `frame`; frames below
 * 0 are the settle frames and equal frame 0. Poses that passed the check only. Errors as of
 * irb_scene_animate(). */
bool irb_poses_apply(const struct irb_poses *poses, struct irb_scene *scene, float frame,
                     struct irb_error *err);

#endif
