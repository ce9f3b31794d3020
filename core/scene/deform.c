/* SPDX-License-Identifier: MIT */
#include "core/scene/deform.h"

#include "core/scene/builder.h"
#include "core/scene/motion.h"
#include "core/scene/vec.h"

#include <stdlib.h>
#include <string.h>

/* ---- Records ---- */

void irb_deform_object_free(struct irb_deform_object *object)
{
    free(object->positions);
    free(object->normals);
    free(object->weights);
    free(object->target_positions);
    free(object->target_normals);
    free(object->joints);
    free(object->inverse_bind);
    free(object->held_by);
    free(object->shares);
    free(object->rest);
    free(object->state);
    *object = (struct irb_deform_object){0};
}

void irb_deform_destroy(struct irb_deform *deform)
{
    if (!deform)
        return;
    for (int i = 0; i < deform->object_count; i++)
        irb_deform_object_free(&deform->objects[i]);
    free(deform->objects);
    free(deform->positions);
    free(deform->normals);
    free(deform);
}

bool irb_deform_add(struct irb_scene *scene, struct irb_deform_object *object,
                    struct irb_error *err)
{
    struct irb_deform *deform = scene->deform ? scene->deform : calloc(1, sizeof *deform);
    struct irb_deform_object *grown = NULL;

    scene->deform = deform;
    if (deform)
        grown = realloc(deform->objects, ((size_t)deform->object_count + 1) * sizeof *grown);
    if (!grown) {
        irb_deform_object_free(object);
        return irb_fail(err, IRB_E_MEMORY, "out of memory");
    }
    deform->objects = grown;
    grown[deform->object_count++] = *object;
    *object = (struct irb_deform_object){0};
    return true;
}

const struct irb_deform_object *irb_deform_find(const struct irb_scene *scene, int object)
{
    int from = 0, to = scene->deform ? scene->deform->object_count : 0;

    while (from < to) {
        int middle = from + (to - from) / 2;

        if (scene->deform->objects[middle].object < object)
            from = middle + 1;
        else
            to = middle;
    }
    return scene->deform && from < scene->deform->object_count &&
                   scene->deform->objects[from].object == object
               ? &scene->deform->objects[from]
               : NULL;
}

/* ---- State: weights, then joint matrices ---- */

static size_t state_size(const struct irb_deform_object *object)
{
    return (size_t)object->target_count + 16 * (size_t)object->joint_count;
}

/* `motion` NULL: weights at rest. */
static void set_state(const struct irb_deform_object *object, const struct irb_motion *motion,
                      double (*world)[16], double seconds, double *state)
{
    double *joints = state + object->target_count;

    for (int k = 0; k < object->target_count; k++)
        state[k] = object->weights[k];
    if (motion && object->node >= 0)
        irb_motion_weights(motion, object->node, seconds, state);
    for (int k = 0; k < object->target_count; k++)
        state[k] += 0.0; /* -0 is 0 */
    for (int j = 0; j < object->joint_count; j++)
        irb_motion_multiply(world[object->joints[j]], object->inverse_bind + 16 * (size_t)j,
                            joints + 16 * (size_t)j);
}

static bool same_state(const struct irb_deform_object *object, const double *a, const double *b)
{
    return memcmp(a, b, state_size(object) * sizeof *a) == 0;
}

/* ---- Vertices ---- */

struct placement {
    double matrix[16], normal_matrix[9];
};

/* Of the vertex's joints; the node's own where none holds it. */
static void place_by_joints(const struct irb_deform_object *object, const double *state, size_t v,
                            struct placement *out)
{
    const double *joints = state + object->target_count;
    const size_t first = v * (size_t)object->influences;
    double sum = 0;

    for (int i = 0; i < object->influences; i++)
        sum += object->shares[first + (size_t)i];
    memset(out->matrix, 0, sizeof out->matrix);
    for (int i = 0; i < object->influences && sum > 0; i++) {
        const double share = object->shares[first + (size_t)i] / sum;
        const double *joint = joints + 16 * (size_t)object->held_by[first + (size_t)i];

        for (int k = 0; k < 16 && share > 0; k++)
            out->matrix[k] += share * joint[k];
    }
    if (!(sum > 0))
        memcpy(out->matrix, object->matrix, sizeof out->matrix);
    vec_normal_matrix(out->matrix, out->normal_matrix);
}

/* A position or normal with the targets added. */
static void add_targets(const struct irb_deform_object *object, const double *weights,
                        const float *base, const float *targets, size_t v, double out[3])
{
    vec_from_float(base + 3 * v, out);
    for (int k = 0; targets && k < object->target_count; k++) {
        const float *delta = targets + 3 * ((size_t)k * object->vertex_count + v);

        for (int i = 0; i < 3 && weights[k] != 0; i++)
            out[i] += weights[k] * delta[i];
    }
}

static bool check_place(const struct irb_scene *scene, const struct irb_deform_object *object,
                        size_t v, const double p[3], struct irb_error *err)
{
    for (int i = 0; i < 3; i++)
        if (!(fabs(p[i]) <= IRB_SCENE_MAX_COORDINATE))
            return irb_fail(err, IRB_E_INPUT,
                            "object '%s': vertex %zu is moved to %g m in the world, expected at "
                            "most %g m",
                            scene->objects[object->object].name, v, p[i], IRB_SCENE_MAX_COORDINATE);
    return true;
}

/* `positions` and `normals` are of all the scene's vertices; normals are left alone where they
 * vanish, and where they follow from the triangles. */
static bool move_vertices(const struct irb_scene *scene, const struct irb_deform_object *object,
                          const double *state, float *positions, float *normals,
                          struct irb_error *err)
{
    struct placement place;

    memcpy(place.matrix, object->matrix, sizeof place.matrix);
    vec_normal_matrix(place.matrix, place.normal_matrix);
    for (size_t v = 0; v < object->vertex_count; v++) {
        const size_t at = 3 * (object->first_vertex + v);
        double local[3], world[3];

        if (object->joint_count > 0)
            place_by_joints(object, state, v, &place);
        add_targets(object, state, object->positions, object->target_positions, v, local);
        vec_transform_point(place.matrix, local, world);
        if (!check_place(scene, object, v, world, err))
            return false;
        vec_to_float(world, positions + at);
        if (!object->normals)
            continue;
        add_targets(object, state, object->normals, object->target_normals, v, local);
        vec_transform_normal(place.normal_matrix, local, world);
        if (vec_normalize(world))
            vec_to_float(world, normals + at);
    }
    return true;
}

/* Geometric normals of triangles that share no vertices. */
static void set_flat_normals(const struct irb_scene *scene, const struct irb_object *object,
                             const float *positions, float *normals)
{
    const uint32_t *index = scene->indices + 3 * (size_t)object->first_triangle;

    for (uint32_t t = 0; t < object->triangle_count; t++, index += 3) {
        double p[3][3], cross[3];

        for (int i = 0; i < 3; i++)
            vec_from_float(positions + 3 * (size_t)index[i], p[i]);
        vec_triangle_cross(p[0], p[1], p[2], cross);
        if (!vec_normalize(cross))
            continue;
        for (int i = 0; i < 3; i++)
            vec_to_float(cross, normals + 3 * (size_t)index[i]);
    }
}

static bool deform(const struct irb_scene *scene, const struct irb_deform_object *object,
                   const double *state, float *positions, float *normals, struct irb_error *err)
{
    if (!move_vertices(scene, object, state, positions, normals, err))
        return false;
    if (!object->normals)
        set_flat_normals(scene, &scene->objects[object->object], positions, normals);
    return true;
}

static void copy_rest(struct irb_scene *scene, struct irb_deform_object *object)
{
    const size_t at = 3 * (size_t)object->first_vertex;
    const size_t size = 3 * (size_t)object->vertex_count * sizeof(float);

    memcpy(scene->deform->positions + at, scene->positions + at, size);
    memcpy(scene->deform->normals + at, scene->normals + at, size);
}

/* ---- Start ---- */

/* Whether a channel changes its weights or moves one of its joints. */
static bool varies(const struct irb_deform_object *object, const struct irb_motion *motion,
                   double *scratch)
{
    bool moves = motion && object->node >= 0 &&
                 irb_motion_weights(motion, object->node, motion->first, scratch);

    for (int j = 0; motion && j < object->joint_count; j++)
        moves = moves || motion->nodes[object->joints[j]].moves;
    return moves;
}

/* Whether the pose at rest differs from the vertices that the scene was given. */
static bool is_posed(const struct irb_deform_object *object)
{
    bool posed = object->joint_count > 0;

    for (int k = 0; k < object->target_count; k++)
        posed = posed || object->rest[k] != 0;
    return posed;
}

static bool start_object(struct irb_scene *scene, struct irb_deform_object *object,
                         double (*world)[16], bool *any_varies, struct irb_error *err)
{
    const size_t size = (state_size(object) + 1) * sizeof *object->rest;

    object->rest = malloc(size);
    object->state = malloc(size);
    if (!object->rest || !object->state)
        return irb_fail(err, IRB_E_MEMORY, "out of memory");
    *any_varies = varies(object, scene->motion, object->rest) || *any_varies;
    set_state(object, NULL, world, 0, object->rest);
    memcpy(object->state, object->rest, size - sizeof *object->rest);
    object->version = 1;
    return !is_posed(object) ||
           deform(scene, object, object->rest, scene->positions, scene->normals, err);
}

/* The vertices now, which are at rest. */
static bool copy_vertices(struct irb_scene *scene)
{
    const size_t size = 3 * (size_t)scene->vertex_count * sizeof(float);
    struct irb_deform *out = scene->deform;

    out->positions = malloc(size + 1);
    out->normals = malloc(size + 1);
    if (!out->positions || !out->normals)
        return false;
    memcpy(out->positions, scene->positions, size);
    memcpy(out->normals, scene->normals, size);
    return true;
}

bool irb_deform_start(struct irb_scene *scene, struct irb_error *err)
{
    struct irb_deform *all = scene->deform;
    const int nodes = scene->motion ? scene->motion->node_count : 0;
    double(*world)[16] = malloc(((size_t)nodes + 1) * sizeof *world);
    bool any_varies = false, ok = all && world;

    if (all && !world)
        irb_fail(err, IRB_E_MEMORY, "out of memory for the animation's nodes");
    if (ok && scene->motion)
        irb_motion_rest(scene->motion, world);
    for (int i = 0; ok && i < all->object_count; i++)
        ok = start_object(scene, &all->objects[i], world, &any_varies, err);
    free(world);
    if (ok && any_varies && !copy_vertices(scene))
        ok = irb_fail(err, IRB_E_MEMORY, "out of memory for %u vertices", scene->vertex_count);
    if (!ok || !any_varies) {
        irb_deform_destroy(scene->deform);
        scene->deform = NULL;
    }
    return ok || !all;
}

/* ---- Frames ---- */

static void reset_object(struct irb_scene *scene, struct irb_deform_object *object)
{
    if (same_state(object, object->state, object->rest))
        return;
    copy_rest(scene, object);
    memcpy(object->state, object->rest, state_size(object) * sizeof *object->state);
    object->version++;
}

/* `next` has room for a state. */
static bool animate_object(struct irb_scene *scene, struct irb_deform_object *object,
                           double (*world)[16], double seconds, double *next, struct irb_error *err)
{
    struct irb_deform *all = scene->deform;

    set_state(object, scene->motion, world, seconds, next);
    if (same_state(object, next, object->state))
        return true;
    if (same_state(object, next, object->rest)) {
        reset_object(scene, object);
        return true;
    }
    copy_rest(scene, object); /* what normals that vanish keep */
    memcpy(object->state, next, state_size(object) * sizeof *next);
    object->version++;
    if (deform(scene, object, next, all->positions, all->normals, err))
        return true;
    reset_object(scene, object);
    return irb_error_prefix(err, "animation at %g s", seconds);
}

bool irb_deform_animate(struct irb_scene *scene, double (*world)[16], double seconds,
                        struct irb_error *err)
{
    struct irb_deform *all = scene->deform;
    size_t largest = 0;
    double *next;
    bool ok = true;

    for (int i = 0; all && i < all->object_count; i++)
        if (state_size(&all->objects[i]) > largest)
            largest = state_size(&all->objects[i]);
    if (!largest)
        return true;
    next = malloc(largest * sizeof *next);
    if (!next)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for %zu weights", largest);
    for (int i = 0; ok && i < all->object_count; i++)
        ok = animate_object(scene, &all->objects[i], world, seconds, next, err);
    free(next);
    return ok;
}

void irb_deform_reset(struct irb_scene *scene)
{
    for (int i = 0; scene->deform && i < scene->deform->object_count; i++)
        reset_object(scene, &scene->deform->objects[i]);
}

bool irb_deform_at_rest(const struct irb_scene *scene)
{
    for (int i = 0; scene->deform && i < scene->deform->object_count; i++) {
        const struct irb_deform_object *object = &scene->deform->objects[i];

        if (!same_state(object, object->state, object->rest))
            return false;
    }
    return true;
}

void irb_deform_hash(const struct irb_scene *scene, struct irb_hash *hash)
{
    for (int i = 0; scene->deform && i < scene->deform->object_count; i++) {
        const struct irb_deform_object *object = &scene->deform->objects[i];
        const size_t at = 3 * (size_t)object->first_vertex;

        if (same_state(object, object->state, object->rest))
            continue;
        irb_hash_string(hash, "deformed");
        irb_hash_u64(hash, (uint64_t)object->object);
        irb_hash_floats(hash, scene->deform->positions + at, 3 * (size_t)object->vertex_count);
        irb_hash_floats(hash, scene->deform->normals + at, 3 * (size_t)object->vertex_count);
    }
}
