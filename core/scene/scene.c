/* SPDX-License-Identifier: MIT */
#include "core/scene/scene.h"

#include "core/base/str.h"
#include "core/scene/builtin.h"
#include "core/scene/deform.h"
#include "core/scene/gltf/load.h"
#include "core/scene/motion.h"
#include "core/scene/vec.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

void irb_scene_destroy(struct irb_scene *scene)
{
    if (!scene)
        return;
    for (int i = 0; i < scene->texture_count; i++)
        free(scene->textures[i].rgba);
    free(scene->textures);
    free(scene->positions);
    free(scene->normals);
    free(scene->texcoords);
    free(scene->indices);
    free(scene->materials);
    free(scene->objects);
    free(scene->lights);
    free(scene->cameras);
    irb_motion_destroy(scene->motion);
    irb_deform_destroy(scene->deform);
    free(scene);
}

static bool has_suffix(const char *text, const char *suffix)
{
    size_t length = strlen(text), tail = strlen(suffix);

    return length > tail && strcasecmp(text + length - tail, suffix) == 0;
}

static void fail_unknown(const char *name, struct irb_error *err)
{
    const char *names[16];
    size_t count = 0;
    const char *near;

    while (count < 16 && irb_builtins[count].name) {
        names[count] = irb_builtins[count].name;
        count++;
    }
    near = irb_nearest(name, names, count);
    if (near)
        irb_fail(err, IRB_E_INPUT,
                 "scene '%s' is neither built in nor a .gltf or .glb file; did "
                 "you mean '%s'?",
                 name, near);
    else
        irb_fail(err, IRB_E_INPUT, "scene '%s' is neither built in nor a .gltf or .glb file", name);
}

struct irb_scene *irb_scene_load(const char *name_or_path, struct irb_log *log,
                                 struct irb_error *err)
{
    const struct irb_builtin *builtin = irb_builtin_find(name_or_path);

    if (builtin)
        return builtin->build(err);
    if (has_suffix(name_or_path, ".gltf") || has_suffix(name_or_path, ".glb"))
        return irb_gltf_load(name_or_path, log, err);
    fail_unknown(name_or_path, err);
    return NULL;
}

/* ---- Key ---- */

static void hash_material(struct irb_hash *hash, const struct irb_material *material)
{
    irb_hash_floats(hash, material->diffuse, 3);
    irb_hash_floats(hash, material->specular, 3);
    irb_hash_floats(hash, &material->exponent, 1);
    irb_hash_u64(hash, (uint64_t)(material->diffuse_texture + 1));
    if (material->alpha_cutoff > 0) {
        irb_hash_string(hash, "mask"); /* references from before masks were traced are others */
        irb_hash_floats(hash, &material->alpha_cutoff, 1);
    }
}

static void hash_object(struct irb_hash *hash, const struct irb_object *object)
{
    irb_hash_u64(hash, object->first_triangle);
    irb_hash_u64(hash, object->triangle_count);
    irb_hash_u64(hash, (uint64_t)object->material);
    irb_hash_floats(hash, object->transform, 16);
}

struct irb_key irb_scene_key(const struct irb_scene *scene)
{
    struct irb_hash *hash = irb_hash_create();

    irb_hash_string(hash, "scene 1"); /* the layout of what follows */
    irb_hash_u64(hash, scene->vertex_count);
    irb_hash_floats(hash, scene->positions, 3 * (size_t)scene->vertex_count);
    irb_hash_floats(hash, scene->normals, 3 * (size_t)scene->vertex_count);
    irb_hash_floats(hash, scene->texcoords, 2 * (size_t)scene->vertex_count);
    irb_hash_u64(hash, scene->triangle_count);
    irb_hash_bytes(hash, scene->indices, 3 * (size_t)scene->triangle_count * sizeof(uint32_t));
    irb_hash_u64(hash, (uint64_t)scene->material_count);
    for (int i = 0; i < scene->material_count; i++)
        hash_material(hash, &scene->materials[i]);
    irb_hash_u64(hash, (uint64_t)scene->texture_count);
    for (int i = 0; i < scene->texture_count; i++) {
        const struct irb_scene_texture *texture = &scene->textures[i];

        irb_hash_u64(hash, (uint64_t)texture->width);
        irb_hash_u64(hash, (uint64_t)texture->height);
        irb_hash_bytes(hash, texture->rgba, 4 * (size_t)texture->width * (size_t)texture->height);
    }
    irb_hash_u64(hash, (uint64_t)scene->object_count);
    for (int i = 0; i < scene->object_count; i++)
        hash_object(hash, &scene->objects[i]);
    irb_deform_hash(scene, hash);
    return irb_hash_finish(hash);
}

/* ---- What the file holds besides surfaces ---- */

bool irb_scene_animate(struct irb_scene *scene, double seconds, struct irb_error *err)
{
    double(*world)[16];
    bool ok;

    if (!scene->motion)
        return true;
    world = malloc(((size_t)scene->motion->node_count + 1) * sizeof *world);
    if (!world)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for the animation's nodes");
    irb_motion_evaluate(scene->motion, seconds, world);
    for (int i = 0; i < scene->object_count; i++)
        irb_motion_transform(scene->motion, world, i, scene->objects[i].transform);
    ok = irb_deform_animate(scene, world, seconds, err);
    free(world);
    return ok;
}

bool irb_scene_duration(const struct irb_scene *scene, double *first, double *last)
{
    *first = scene->motion ? scene->motion->first : 0;
    *last = scene->motion ? scene->motion->last : 0;
    return scene->motion != NULL;
}

const float *irb_scene_current_positions(const struct irb_scene *scene)
{
    return scene->deform ? scene->deform->positions : scene->positions;
}

const float *irb_scene_current_normals(const struct irb_scene *scene)
{
    return scene->deform ? scene->deform->normals : scene->normals;
}

const struct irb_light *irb_scene_light_find(const struct irb_scene *scene, const char *name)
{
    for (int i = 0; i < scene->light_count; i++)
        if (!name || strcmp(scene->lights[i].name, name) == 0)
            return &scene->lights[i].light;
    return NULL;
}

const struct irb_camera *irb_scene_camera_find(const struct irb_scene *scene, const char *name)
{
    for (int i = 0; i < scene->camera_count; i++)
        if (!name || strcmp(scene->cameras[i].name, name) == 0)
            return &scene->cameras[i].camera;
    return NULL;
}

/* ---- Bounds ---- */

static bool is_identity(const float m[16])
{
    for (int i = 0; i < 16; i++)
        if (m[i] != (i % 5 == 0 ? 1.0f : 0.0f))
            return false;
    return true;
}

static void extend_by_object(const struct irb_scene *scene, const struct irb_object *object,
                             float min[3], float max[3])
{
    const float *m = object->transform, *positions = irb_scene_current_positions(scene);
    const uint32_t *index = scene->indices + 3 * (size_t)object->first_triangle;

    for (size_t i = 0; i < 3 * (size_t)object->triangle_count; i++) {
        const float *p = positions + 3 * (size_t)index[i];

        for (int axis = 0; axis < 3; axis++) {
            float x = m[axis] * p[0] + m[4 + axis] * p[1] + m[8 + axis] * p[2] + m[12 + axis];

            min[axis] = x < min[axis] ? x : min[axis];
            max[axis] = x > max[axis] ? x : max[axis];
        }
    }
}

void irb_scene_current_bounds(const struct irb_scene *scene, float min[3], float max[3])
{
    bool at_rest = irb_deform_at_rest(scene);

    for (int i = 0; i < scene->object_count; i++)
        at_rest = at_rest && is_identity(scene->objects[i].transform);
    if (at_rest) {
        memcpy(min, scene->bounds_min, sizeof scene->bounds_min);
        memcpy(max, scene->bounds_max, sizeof scene->bounds_max);
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        min[axis] = INFINITY;
        max[axis] = -INFINITY;
    }
    for (int i = 0; i < scene->object_count; i++)
        extend_by_object(scene, &scene->objects[i], min, max);
}

static void object_bounds(const struct irb_scene *scene, const struct irb_object *object,
                          const float *positions, float min[3], float max[3])
{
    const uint32_t *index = scene->indices + 3 * (size_t)object->first_triangle;

    for (int axis = 0; axis < 3; axis++) {
        min[axis] = INFINITY;
        max[axis] = -INFINITY;
        for (size_t i = 0; i < 3 * (size_t)object->triangle_count; i++) {
            float x = positions[3 * (size_t)index[i] + (size_t)axis];

            min[axis] = x < min[axis] ? x : min[axis];
            max[axis] = x > max[axis] ? x : max[axis];
        }
    }
}

void irb_object_rest_bounds(const struct irb_scene *scene, const struct irb_object *object,
                            float min[3], float max[3])
{
    object_bounds(scene, object, scene->positions, min, max);
}

void irb_object_current_bounds(const struct irb_scene *scene, const struct irb_object *object,
                               float min[3], float max[3])
{
    object_bounds(scene, object, irb_scene_current_positions(scene), min, max);
}

float irb_scene_diagonal(const struct irb_scene *scene)
{
    double min[3], max[3], diagonal[3];

    vec_from_float(scene->bounds_min, min);
    vec_from_float(scene->bounds_max, max);
    vec_sub(max, min, diagonal);
    return (float)vec_length(diagonal);
}
