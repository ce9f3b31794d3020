/* SPDX-License-Identifier: MIT */
#include "core/scene/pose.h"

#include "core/base/str.h"
#include "core/scene/deform.h"
#include "core/scene/motion.h"
#include "core/scene/vec.h"

#include <stdlib.h>
#include <string.h>

void irb_poses_destroy(struct irb_poses *poses)
{
    for (int i = 0; i < poses->object_count; i++) {
        free(poses->objects[i].name);
        free(poses->objects[i].place);
        free(poses->objects[i].keys);
    }
    free(poses->objects);
    free(poses->place);
    *poses = (struct irb_poses){0};
}

/* ---- Names ---- */

static bool fail_unknown(const struct irb_object_script *script, const struct irb_scene *scene,
                         struct irb_error *err)
{
    enum { MOST_LISTED = 12 };
    const char **names = calloc((size_t)scene->object_count + 1, sizeof *names);
    const char *near;
    struct irb_str list = {0};

    for (int i = 0; names && i < scene->object_count; i++)
        names[i] = scene->objects[i].name;
    near = names ? irb_nearest(script->name, names, (size_t)scene->object_count) : NULL;
    if (near)
        irb_str_printf(&list, "; did you mean '%s'?", near);
    for (int i = 0; !near && i < scene->object_count && i < MOST_LISTED; i++)
        irb_str_printf(&list, "%s%s", i ? ", " : "; there are ", scene->objects[i].name);
    if (!near && scene->object_count > MOST_LISTED)
        irb_str_printf(&list, " and %d more", scene->object_count - MOST_LISTED);
    irb_fail(err, IRB_E_INPUT, "%s%sobjects: scene %s has no object '%.64s'%s",
             script->place ? script->place : "", script->place ? ": " : "", scene->name,
             script->name, irb_str_text(&list));
    irb_str_free(&list);
    free(names);
    return false;
}

bool irb_poses_check(const struct irb_poses *poses, const struct irb_scene *scene,
                     struct irb_error *err)
{
    if (poses->plays && !scene->motion)
        return irb_fail(err, IRB_E_INPUT, "%s%sanimation: scene %s has none of its own",
                        poses->place ? poses->place : "", poses->place ? ": " : "", scene->name);
    for (int i = 0; i < poses->object_count; i++) {
        bool found = false;

        for (int k = 0; k < scene->object_count; k++)
            found = found || !strcmp(scene->objects[k].name, poses->objects[i].name);
        if (!found)
            return fail_unknown(&poses->objects[i], scene, err);
    }
    return true;
}

/* The script's own, or the centre of the bounds at rest of all objects of its name. */
static void find_pivot(const struct irb_object_script *script, const struct irb_scene *scene,
                       float pivot[3])
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};

    memcpy(pivot, script->pivot, sizeof script->pivot);
    if (script->has_pivot)
        return;
    for (int k = 0; k < scene->object_count; k++)
        if (!strcmp(scene->objects[k].name, script->name)) {
            float min[3], max[3];

            irb_object_rest_bounds(scene, &scene->objects[k], min, max);
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = fminf(low[axis], min[axis]);
                high[axis] = fmaxf(high[axis], max[axis]);
            }
        }
    for (int axis = 0; axis < 3; axis++)
        pivot[axis] = low[axis] / 2 + high[axis] / 2;
}

/* ---- Matrices ---- */

/* Rodrigues' formula for a rotation vector in degrees, times a scale: R S. */
static void turn_and_scale(const double degrees[3], const double scale[3], double out[16])
{
    double axis[3] = {degrees[0], degrees[1], degrees[2]};
    double angle = vec_length(degrees) * (M_PI / 180), c = cos(angle), s = sin(angle);

    if (!vec_normalize(axis)) {
        c = 1;
        s = 0;
    }
    const double cross[3][3] = {
        {0, axis[2], -axis[1]}, {-axis[2], 0, axis[0]}, {axis[1], -axis[0], 0}}; /* columns */
    memset(out, 0, 16 * sizeof *out);
    out[15] = 1;
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            out[4 * column + row] =
                scale[column] *
                (c * (row == column) + (1 - c) * axis[row] * axis[column] + s * cross[column][row]);
}

/* Rest position -> current position. */
static void script_matrix(const struct irb_object_script *script, const float pivot[3], float frame,
                          double out[16])
{
    const struct irb_pose_key *keys = script->keys;
    const size_t stride = sizeof *keys;
    struct irb_key_segment at = irb_keys_find(&keys->frame, stride, script->key_count, frame);
    double move[3], degrees[3], scale[3];

    for (int i = 0; i < 3; i++) {
        enum irb_interpolation kind = script->interpolation;

        move[i] = irb_keys_value(&at, kind, &keys->translate[i], stride, false);
        degrees[i] = irb_keys_value(&at, kind, &keys->rotation[i], stride, false);
        scale[i] = irb_keys_value(&at, kind, &keys->scale[i], stride, true);
    }
    turn_and_scale(degrees, scale, out);
    for (int row = 0; row < 3; row++) { /* p -> R S (p - pivot) + pivot + move */
        out[12 + row] = (double)pivot[row] + move[row];
        for (int column = 0; column < 3; column++)
            out[12 + row] -= out[4 * column + row] * (double)pivot[column];
    }
}

/* ---- Frames ---- */

static void set_identity(float transform[16])
{
    for (int i = 0; i < 16; i++)
        transform[i] = i % 5 == 0;
}

static void put_on_top(const double matrix[16], float transform[16])
{
    double below[16], product[16];

    for (int i = 0; i < 16; i++)
        below[i] = (double)transform[i];
    irb_motion_multiply(matrix, below, product);
    for (int i = 0; i < 16; i++)
        transform[i] = (float)product[i];
}

bool irb_poses_apply(const struct irb_poses *poses, struct irb_scene *scene, float frame,
                     struct irb_error *err)
{
    frame = fmaxf(frame, 0);
    for (int i = 0; i < scene->object_count; i++)
        set_identity(scene->objects[i].transform);
    if (!poses->plays)
        irb_deform_reset(scene);
    else if (!irb_scene_animate(scene, (double)poses->start + (double)frame / (double)poses->fps,
                                err))
        return false;
    for (int i = 0; i < poses->object_count; i++) {
        double matrix[16];
        float pivot[3];

        find_pivot(&poses->objects[i], scene, pivot);
        script_matrix(&poses->objects[i], pivot, frame, matrix);
        for (int k = 0; k < scene->object_count; k++)
            if (!strcmp(scene->objects[k].name, poses->objects[i].name))
                put_on_top(matrix, scene->objects[k].transform);
    }
    return true;
}
