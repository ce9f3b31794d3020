/* SPDX-License-Identifier: MIT */
#include "core/experiment/sequence.h"

#include "core/base/str.h"
#include "core/scene/deform.h"

#include <stdlib.h>
#include <string.h>

/* ---- what the scene's file brings ---- */

static void list_names(const struct irb_scene *scene, bool lights, struct irb_str *list)
{
    int count = lights ? scene->light_count : scene->camera_count;
    for (int i = 0; i < count; i++)
        irb_str_printf(list, "%s'%s'", i ? ", " : "; there are ",
                       lights ? scene->lights[i].name : scene->cameras[i].name);
}

static bool fail_missing(const struct irb_scene_entry *entry, const struct irb_scene *scene,
                         bool light, struct irb_error *err)
{
    const char *what = light ? "light" : "camera";
    const char *place = light ? entry->light_place : entry->camera_place;
    const char *name = light ? entry->light_name : entry->camera_name;
    struct irb_str list = {0};
    list_names(scene, light, &list);
    if (name)
        irb_fail(err, IRB_E_INPUT, "%s: %s: the file of scene %s has none called '%.64s'%s", place,
                 what, entry->name, name, list.text ? list.text : "; it has none at all");
    else
        irb_fail(err, IRB_E_INPUT,
                 "%s: %s: missing; scene %s has none of its own, give position and target", place,
                 what, entry->name);
    irb_str_free(&list);
    return false;
}

/* Light and camera of one frame, with the objects in place. */
static bool set_view(const struct irb_sequence *sequence, int frame, struct irb_error *err)
{
    const struct irb_scene_entry *entry = sequence->entry;
    const struct irb_scene *scene = sequence->scene;
    const struct irb_animation *animation = &entry->animation;
    struct irb_sequence_frame *out = &sequence->frames[frame];
    if (animation->light_key_count) {
        irb_animation_light(animation, scene, (float)frame, &out->light);
    } else {
        const struct irb_light *light = irb_scene_light_find(scene, entry->light_name);
        if (!light)
            return fail_missing(entry, scene, true, err);
        out->light = *light;
        if (animation->beam_half_width > 0)
            out->light.half_width = animation->beam_half_width;
        irb_light_fit(&out->light, scene);
    }
    if (animation->camera_key_count) {
        irb_animation_camera(animation, scene, (float)frame, &out->camera);
    } else {
        const struct irb_camera *camera = irb_scene_camera_find(scene, entry->camera_name);
        if (!camera)
            return fail_missing(entry, scene, false, err);
        out->camera = *camera;
        out->camera.z_near = animation->z_near > 0 ? animation->z_near : out->camera.z_near;
        out->camera.z_far = animation->z_far > 0 ? animation->z_far : out->camera.z_far;
        irb_camera_fit(&out->camera, scene);
    }
    return true;
}

/* ---- frames ---- */

static bool at_rest(const struct irb_scene *scene)
{
    for (int i = 0; i < scene->object_count; i++)
        for (int k = 0; k < 16; k++)
            if (scene->objects[i].transform[k] != (k % 5 == 0 ? 1.0f : 0.0f))
                return false;
    return irb_deform_at_rest(scene);
}

/* The scene's key at rest, the objects' transforms where any has moved, and the vertices of what
 * deforms: hashing all of them anew for each frame would be slow. */
static struct irb_key pose_key(const struct irb_scene *scene, const struct irb_key *rest)
{
    if (at_rest(scene))
        return *rest;
    struct irb_hash *hash = irb_hash_create();
    irb_hash_string(hash, "posed scene");
    irb_hash_string(hash, rest->hex);
    for (int i = 0; i < scene->object_count; i++)
        irb_hash_floats(hash, scene->objects[i].transform, 16);
    irb_deform_hash(scene, hash);
    return irb_hash_finish(hash);
}

static bool set_frames(struct irb_sequence *sequence, struct irb_error *err)
{
    struct irb_key rest = irb_scene_key(sequence->scene);
    for (int i = 0; i < sequence->frame_count; i++) {
        if (!irb_sequence_pose(sequence, i, err) || !set_view(sequence, i, err))
            return false;
        sequence->frames[i].scene = pose_key(sequence->scene, &rest);
        sequence->moves = sequence->moves || (i > 0 && !irb_sequence_same_pose(sequence, i));
    }
    return true;
}

bool irb_sequence_open(struct irb_sequence *sequence, const struct irb_config *config,
                       const struct irb_scene_entry *entry, struct irb_log *log,
                       struct irb_error *err)
{
    *sequence = (struct irb_sequence){.entry = entry, .frame_count = config->render.frames};
    sequence->scene = irb_scene_load(entry->source, log, err);
    sequence->frames =
        sequence->scene ? calloc((size_t)sequence->frame_count, sizeof *sequence->frames) : NULL;
    bool ok = sequence->frames != NULL;
    if (!ok && sequence->scene)
        irb_fail(err, IRB_E_MEMORY, "%s: no memory for %d frames", entry->name,
                 config->render.frames);
    ok = ok && irb_poses_check(&entry->poses, sequence->scene, err) && set_frames(sequence, err);
    if (!ok)
        irb_sequence_close(sequence);
    return ok;
}

void irb_sequence_close(struct irb_sequence *sequence)
{
    irb_scene_destroy(sequence->scene);
    free(sequence->frames);
    *sequence = (struct irb_sequence){0};
}

bool irb_sequence_pose(struct irb_sequence *sequence, int frame, struct irb_error *err)
{
    const struct irb_poses *poses = &sequence->entry->poses;
    return !irb_poses_move(poses) || irb_poses_apply(poses, sequence->scene, (float)frame, err);
}

static struct irb_key camera_key(const struct irb_camera *camera)
{
    struct irb_hash *hash = irb_hash_create();
    irb_camera_hash(camera, hash);
    return irb_hash_finish(hash);
}

bool irb_sequence_same_pose(const struct irb_sequence *sequence, int frame)
{
    return frame > 0 &&
           !strcmp(sequence->frames[frame].scene.hex, sequence->frames[frame - 1].scene.hex);
}

bool irb_sequence_same_view(const struct irb_sequence *sequence, int frame)
{
    if (!irb_sequence_same_pose(sequence, frame))
        return false;
    struct irb_key now = camera_key(&sequence->frames[frame].camera);
    struct irb_key before = camera_key(&sequence->frames[frame - 1].camera);
    return !strcmp(now.hex, before.hex);
}

/* Where an object was, and in what shape. */
struct posed_object {
    float transform[16];
    uint64_t version;      /* of its vertices; 0: they never change */
    float low[3], high[3]; /* of them, where they may change */
};

static uint64_t vertex_version(const struct irb_scene *scene, int object)
{
    const struct irb_deform_object *deform = irb_deform_find(scene, object);
    return deform ? deform->version : 0;
}

static struct posed_object *copy_poses(const struct irb_scene *scene)
{
    struct posed_object *copy = calloc((size_t)scene->object_count + 1, sizeof *copy);
    for (int i = 0; copy && i < scene->object_count; i++) {
        const struct irb_object *object = &scene->objects[i];
        memcpy(copy[i].transform, object->transform, sizeof copy[i].transform);
        copy[i].version = vertex_version(scene, i);
        if (copy[i].version)
            irb_object_current_bounds(scene, object, copy[i].low, copy[i].high);
    }
    return copy;
}

static void list_moved(const struct irb_scene *scene, const struct posed_object *before,
                       struct irb_moved_object *moved, int *count)
{
    for (int i = 0; i < scene->object_count; i++) {
        const struct irb_object *object = &scene->objects[i];
        float low[3], high[3];
        if (!memcmp(before[i].transform, object->transform, sizeof object->transform) &&
            before[i].version == vertex_version(scene, i))
            continue;
        irb_object_current_bounds(scene, object, low, high);
        for (int k = 0; k < 3 && before[i].version; k++) {
            low[k] = before[i].low[k] < low[k] ? before[i].low[k] : low[k];
            high[k] = before[i].high[k] > high[k] ? before[i].high[k] : high[k];
        }
        irb_moved_object_set(&moved[(*count)++], before[i].transform, object->transform, low, high);
    }
}

bool irb_sequence_moved(struct irb_sequence *sequence, int frame, struct irb_moved_object **moved,
                        int *count, struct irb_error *err)
{
    struct irb_scene *scene = sequence->scene;
    *moved = NULL;
    *count = 0;
    if (irb_sequence_same_pose(sequence, frame))
        return true;
    if (!irb_sequence_pose(sequence, frame - 1, err))
        return false;
    struct posed_object *before = copy_poses(scene);
    *moved = calloc((size_t)scene->object_count + 1, sizeof **moved);
    bool ok = before && *moved;
    if (!ok)
        irb_fail(err, IRB_E_MEMORY, "no memory for %d objects", scene->object_count);
    ok = ok && irb_sequence_pose(sequence, frame, err);
    if (ok) {
        list_moved(scene, before, *moved, count);
    } else {
        free(*moved);
        *moved = NULL;
    }
    free(before);
    return ok;
}
