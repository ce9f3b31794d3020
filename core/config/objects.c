/* SPDX-License-Identifier: MIT
 *
 * `animation:` and `objects:` of a scene: its own animation, and keyframed transforms of
 * objects. Names are checked once the scene is loaded (irb_poses_check); messages then still name
 * the line.
 */
#include "core/base/str.h"
#include "core/config/keys.h"
#include "core/config/parts.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_OBJECTS = 1024, MOST_KEYS = 4096 };

static const float default_fps = 24; /* 1/s: cinema's */
static const double highest_fps = 1e6, farthest_time = 1e6, largest_scale = 1e6;
static const double smallest_scale = 1e-6; /* of an object: 0 has no surface and no normals */

#define OBJECT_KEYS IRB_CONFIG_OBJECT_KEY(IRB_CONFIG_KEY_NAME)

static bool read_number(struct irb_yaml *yaml, irb_yaml_node map, const char *name, double min,
                        double max, float *out, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, map, name);
    return !node || irb_yaml_float(yaml, node, name, min, max, out, err);
}

static bool read_animation(struct irb_poses *poses, struct irb_yaml *yaml, irb_yaml_node node,
                           bool still, struct irb_error *err)
{
    static const char *const names[] = {IRB_CONFIG_ANIMATION_KEYS(IRB_CONFIG_KEY_NAME) NULL};
    irb_yaml_node fps = irb_yaml_find(yaml, node, "fps");
    if (still)
        return irb_yaml_fail(yaml, node, err,
                             "animation: this built-in scene has none of its own (objects: moves "
                             "its objects)");
    poses->plays = true;
    poses->fps = default_fps;
    poses->place = irb_yaml_place(yaml, node);
    if (!irb_yaml_check_map(yaml, node, "animation", names, err) ||
        !read_number(yaml, node, "fps", -FLT_MAX, highest_fps, &poses->fps, err) ||
        !read_number(yaml, node, "start", -farthest_time, farthest_time, &poses->start, err))
        return false;
    return poses->fps > 0 ||
           irb_yaml_fail(yaml, fps, err, "fps: expected frames a second above 0, found %g",
                         (double)poses->fps);
}

/* [x, y, z, degrees] */
static bool read_rotation(struct irb_pose_key *key, struct irb_yaml *yaml, irb_yaml_node map,
                          struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, map, "rotate");
    float values[4];
    if (!node)
        return true;
    if (!irb_yaml_floats(yaml, node, "rotate", values, 4, err))
        return false;
    double length = sqrt((double)values[0] * values[0] + (double)values[1] * values[1] +
                         (double)values[2] * values[2]);
    if (!(length > 0))
        return irb_yaml_fail(yaml, node, err,
                             "rotate: expected [x, y, z, degrees] about an axis that is not zero");
    for (int i = 0; i < 3; i++)
        key->rotation[i] = (float)(values[i] / length * values[3]);
    return true;
}

/* One number for all axes, or three. */
static bool read_scale(struct irb_pose_key *key, struct irb_yaml *yaml, irb_yaml_node map,
                       struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, map, "scale");
    if (!node)
        return true;
    if (node->type == YAML_SCALAR_NODE) {
        if (!irb_yaml_float(yaml, node, "scale", smallest_scale, largest_scale, key->scale, err))
            return false;
        key->scale[1] = key->scale[2] = key->scale[0];
        return true;
    }
    if (!irb_yaml_floats(yaml, node, "scale", key->scale, 3, err))
        return false;
    for (int i = 0; i < 3; i++)
        if (!(key->scale[i] >= (float)smallest_scale && key->scale[i] <= (float)largest_scale))
            return irb_yaml_fail(yaml, irb_yaml_item(yaml, node, i), err,
                                 "scale: expected %g to %g, found %g", smallest_scale,
                                 largest_scale, (double)key->scale[i]);
    return true;
}

/* *key holds the key before it. */
static bool read_key(struct irb_pose_key *key, bool first, struct irb_yaml *yaml,
                     irb_yaml_node node, struct irb_error *err)
{
    static const char *const names[] = {IRB_CONFIG_KEY_TIME(IRB_CONFIG_KEY_NAME) OBJECT_KEYS NULL};
    irb_yaml_node time, translate;
    float before = key->frame;
    if (!irb_yaml_check_map(yaml, node, "object", names, err))
        return false;
    time = irb_yaml_find(yaml, node, "frame");
    translate = irb_yaml_find(yaml, node, "translate");
    if (!time)
        return irb_yaml_fail(yaml, node, err, "object: frame: missing in a list of keys");
    if (!irb_yaml_float(yaml, time, "frame", 0, 1e6, &key->frame, err))
        return false;
    if (!first && !(key->frame > before))
        return irb_yaml_fail(yaml, time, err,
                             "frame: expected above %g, the key before it, found %g",
                             (double)before, (double)key->frame);
    return (!translate || irb_yaml_floats(yaml, translate, "translate", key->translate, 3, err)) &&
           read_rotation(key, yaml, node, err) && read_scale(key, yaml, node, err);
}

static bool read_keys(struct irb_object_script *script, struct irb_yaml *yaml, irb_yaml_node object,
                      struct irb_error *err)
{
    irb_yaml_node list = irb_yaml_find(yaml, object, "keys");
    int count = irb_yaml_count(list);
    if (!count || count > MOST_KEYS)
        return irb_yaml_fail(yaml, list ? list : object, err,
                             "object: keys: expected a list of 1 to %d keys, found %s", MOST_KEYS,
                             count ? "more" : "none");
    script->keys = calloc((size_t)count, sizeof *script->keys);
    if (!script->keys)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", yaml->path);
    for (int i = 0; i < count; i++) {
        script->keys[i] = i ? script->keys[i - 1] : (struct irb_pose_key){.scale = {1, 1, 1}};
        if (!read_key(&script->keys[i], i == 0, yaml, irb_yaml_item(yaml, list, i), err))
            return false;
    }
    script->key_count = count;
    return true;
}

static bool read_interpolation(struct irb_object_script *script, struct irb_yaml *yaml,
                               irb_yaml_node object, struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, object, "interpolation");
    const char *text = node ? irb_yaml_text(yaml, node, "interpolation", err) : NULL;
    if (!node)
        return true;
    for (int i = 0; text && irb_interpolation_names[i]; i++)
        if (!strcmp(text, irb_interpolation_names[i])) {
            script->interpolation = (enum irb_interpolation)i;
            return true;
        }
    return text &&
           irb_yaml_fail(yaml, node, err,
                         "interpolation: expected one of linear, catmull-rom; found '%.64s'", text);
}

static bool read_object(struct irb_poses *poses, struct irb_yaml *yaml, irb_yaml_node node,
                        struct irb_error *err)
{
    static const char *const names[] = {IRB_CONFIG_OBJECT_SETTINGS(IRB_CONFIG_KEY_NAME) NULL};
    struct irb_object_script *script = &poses->objects[poses->object_count];
    if (!irb_yaml_check_map(yaml, node, "object", names, err))
        return false;
    irb_yaml_node name = irb_yaml_find(yaml, node, "name");
    irb_yaml_node pivot = irb_yaml_find(yaml, node, "pivot");
    if (!name)
        return irb_yaml_fail(yaml, node, err, "object: name: missing");
    const char *text = irb_yaml_text(yaml, name, "name", err);
    if (!text)
        return false;
    for (int i = 0; i < poses->object_count; i++)
        if (!strcmp(poses->objects[i].name, text))
            return irb_yaml_fail(yaml, name, err, "objects: '%.64s' is there twice", text);
    poses->object_count++; /* from here on the config frees it */
    script->name = irb_strdup(text);
    script->place = irb_yaml_place(yaml, name);
    script->has_pivot = pivot != NULL;
    return (!pivot || irb_yaml_floats(yaml, pivot, "pivot", script->pivot, 3, err)) &&
           read_interpolation(script, yaml, node, err) && read_keys(script, yaml, node, err);
}

bool irb_config_read_poses(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                           irb_yaml_node scene, bool still, struct irb_error *err)
{
    irb_yaml_node animation = irb_yaml_find(yaml, scene, "animation");
    irb_yaml_node list = irb_yaml_find(yaml, scene, "objects");
    int count = irb_yaml_count(list);
    if (animation && !read_animation(&entry->poses, yaml, animation, still, err))
        return false;
    if (!list)
        return true;
    if (!count || count > MOST_OBJECTS)
        return irb_yaml_fail(yaml, list, err, "objects: expected a list of 1 to %d maps, found %s",
                             MOST_OBJECTS, count ? "more" : irb_yaml_kind(list));
    entry->poses.objects = calloc((size_t)count, sizeof *entry->poses.objects);
    if (!entry->poses.objects)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", yaml->path);
    for (int i = 0; i < count; i++)
        if (!read_object(&entry->poses, yaml, irb_yaml_item(yaml, list, i), err))
            return false;
    return true;
}

void irb_config_hash_poses(const struct irb_poses *poses, struct irb_hash *hash)
{
    if (!irb_poses_move(poses))
        return;
    irb_hash_u64(hash, poses->plays);
    irb_hash_floats(hash, (const float[]){poses->fps, poses->start}, 2);
    irb_hash_u64(hash, (uint64_t)poses->object_count);
    for (int i = 0; i < poses->object_count; i++) {
        const struct irb_object_script *o = &poses->objects[i];
        irb_hash_string(hash, o->name);
        irb_hash_string(hash, irb_interpolation_names[o->interpolation]);
        irb_hash_u64(hash, o->has_pivot);
        irb_hash_floats(hash, o->pivot, 3);
        irb_hash_u64(hash, (uint64_t)o->key_count);
        for (int k = 0; k < o->key_count; k++) {
            irb_hash_floats(hash, &o->keys[k].frame, 1);
            irb_hash_floats(hash, o->keys[k].translate, 3);
            irb_hash_floats(hash, o->keys[k].rotation, 3);
            irb_hash_floats(hash, o->keys[k].scale, 3);
        }
    }
}
