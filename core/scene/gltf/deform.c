/* SPDX-License-Identifier: MIT
 *
 * Morph targets and skins of a glTF primitive.
 */
#include "core/scene/gltf/load.h"

#include "core/scene/deform.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of all morph targets of a file: 1 GiB. Targets may share their bytes in the file, so that
 * its size bounds nothing. */
#define MAX_DELTAS ((size_t)1 << 28)

/* A skin's vertex names joints in 16 bits. */
enum { MAX_JOINTS = 65536 };

static size_t source_of(const struct gltf_surface *surface, size_t v)
{
    return surface->sources ? surface->sources[v] : v;
}

static bool open_for_vertices(const struct gltf_loader *loader, const struct gltf_surface *surface,
                              int accessor, const char *what, int components,
                              struct gltf_array *array, struct irb_error *err)
{
    if (!gltf_array_open(loader->gltf, accessor, what, components, array, err))
        return false;
    if (array->count != surface->position->count)
        return irb_fail(err, IRB_E_INPUT, "%s has %zu entries but POSITION has %zu", what,
                        array->count, surface->position->count);
    return true;
}

/* ---- Vertices without morph and skin ---- */

static float *copy_vectors(const struct gltf_surface *surface, const struct gltf_array *array,
                           uint32_t count)
{
    float *out = malloc((3 * (size_t)count + 1) * sizeof *out);

    for (size_t v = 0; out && v < count; v++)
        for (int i = 0; i < 3; i++)
            out[3 * v + (size_t)i] = (float)gltf_array_get(array, source_of(surface, v), i);
    for (size_t i = 0; out && i < 3 * (size_t)count; i++)
        if (!isfinite(out[i]))
            out[i] = 0; /* of a normal; positions are checked */
    return out;
}

static bool copy_base(const struct gltf_surface *surface, struct irb_deform_object *out,
                      struct irb_error *err)
{
    memcpy(out->matrix, surface->world, sizeof out->matrix);
    out->positions = copy_vectors(surface, surface->position, out->vertex_count);
    if (surface->normal)
        out->normals = copy_vectors(surface, surface->normal, out->vertex_count);
    if (!out->positions || (surface->normal && !out->normals))
        return irb_fail(err, IRB_E_MEMORY, "out of memory");
    return true;
}

/* ---- Morph targets ---- */

static bool copy_deltas(const struct gltf_loader *loader, const struct gltf_surface *surface,
                        int target, bool normals, uint32_t count, float *out, struct irb_error *err)
{
    const struct irb_gltf_target *source = &surface->source->targets[target];
    struct gltf_array array;
    char what[48];

    snprintf(what, sizeof what, "morph target %d: %s", target, normals ? "NORMAL" : "POSITION");
    if (!open_for_vertices(loader, surface, normals ? source->normal : source->position, what, 3,
                           &array, err))
        return false;
    for (size_t v = 0; v < count; v++)
        for (int i = 0; i < 3; i++) {
            float value = (float)gltf_array_get(&array, source_of(surface, v), i);

            if (!isfinite(value))
                return irb_fail(err, IRB_E_INPUT, "%s of vertex %zu is not finite", what,
                                source_of(surface, v));
            out[3 * v + (size_t)i] = value;
        }
    return true;
}

/* Positions or normals of all targets; those of a target that has none stay 0. NULL in *out where
 * no target has any. */
static bool copy_targets(struct gltf_loader *loader, const struct gltf_surface *surface,
                         const struct irb_deform_object *object, bool normals, float **out,
                         struct irb_error *err)
{
    const struct irb_gltf_target *targets = surface->source->targets;
    const size_t stride = 3 * (size_t)object->vertex_count;
    bool any = false, ok = true;

    for (int k = 0; k < object->target_count; k++)
        any = any || (normals ? targets[k].normal : targets[k].position) >= 0;
    if (!any)
        return true;
    if ((size_t)object->target_count > (MAX_DELTAS - loader->deltas) / (stride + 1))
        return irb_fail(err, IRB_E_INPUT,
                        "%d morph targets of %u vertices: with these the file has more than %zu "
                        "numbers of morph targets",
                        object->target_count, object->vertex_count, MAX_DELTAS);
    loader->deltas += stride * (size_t)object->target_count;
    *out = calloc(stride * (size_t)object->target_count + 1, sizeof **out);
    if (!*out)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for %d morph targets",
                        object->target_count);
    for (int k = 0; ok && k < object->target_count; k++)
        if ((normals ? targets[k].normal : targets[k].position) >= 0)
            ok = copy_deltas(loader, surface, k, normals, object->vertex_count,
                             *out + stride * (size_t)k, err);
    return ok;
}

/* At rest: the node's, else the mesh's, else 0 (glTF 2.0, 3.7.2.2). */
static bool copy_weights(const struct gltf_loader *loader, const struct gltf_surface *surface,
                         struct irb_deform_object *object, struct irb_error *err)
{
    const struct irb_gltf_node *node = &loader->gltf->nodes[surface->node];
    const struct irb_gltf_mesh *mesh = &loader->gltf->meshes[node->mesh];
    const double *weights = node->weight_count > 0 ? node->weights : mesh->weights;
    int count = node->weight_count > 0 ? node->weight_count : mesh->weight_count;

    if (object->target_count != mesh->primitives[0].target_count)
        return irb_fail(err, IRB_E_INPUT,
                        "has %d morph targets, but the mesh's first primitive has %d",
                        object->target_count, mesh->primitives[0].target_count);
    if (count > 0 && count != object->target_count)
        return irb_fail(err, IRB_E_INPUT, "%s has %d weights for %d morph targets",
                        node->weight_count > 0 ? "its node" : "its mesh", count,
                        object->target_count);
    object->weights = calloc((size_t)object->target_count + 1, sizeof *object->weights);
    if (!object->weights)
        return irb_fail(err, IRB_E_MEMORY, "out of memory");
    for (int k = 0; k < count; k++) {
        object->weights[k] = weights[k];
        if (!isfinite(weights[k]))
            return irb_fail(err, IRB_E_INPUT, "weight of morph target %d is not finite", k);
    }
    return true;
}

static bool read_morph(struct gltf_loader *loader, const struct gltf_surface *surface,
                       struct irb_deform_object *object, struct irb_error *err)
{
    object->node = surface->node;
    object->target_count = surface->source->target_count;
    return copy_weights(loader, surface, object, err) &&
           copy_targets(loader, surface, object, false, &object->target_positions, err) &&
           (!surface->normal ||
            copy_targets(loader, surface, object, true, &object->target_normals, err));
}

/* ---- Skins ---- */

bool gltf_has_skin(const struct irb_gltf *gltf, const struct irb_gltf_primitive *source, int node)
{
    return gltf->nodes[node].skin >= 0 && source->joints[0] >= 0;
}

static bool copy_joints(const struct irb_gltf *gltf, const struct irb_gltf_skin *skin,
                        struct irb_deform_object *object, struct irb_error *err)
{
    if (skin->joint_count < 1 || skin->joint_count > MAX_JOINTS)
        return irb_fail(err, IRB_E_INPUT, "has %d joints, expected 1 to %d", skin->joint_count,
                        MAX_JOINTS);
    object->joint_count = skin->joint_count;
    object->joints = malloc((size_t)skin->joint_count * sizeof *object->joints);
    if (!object->joints)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for %d joints", skin->joint_count);
    for (int j = 0; j < skin->joint_count; j++) {
        object->joints[j] = skin->joints[j];
        if (skin->joints[j] < 0 || skin->joints[j] >= gltf->node_count)
            return irb_fail(err, IRB_E_INPUT, "joint %d: node %d does not exist (the file has %d)",
                            j, skin->joints[j], gltf->node_count);
    }
    return true;
}

/* Identity where the skin gives none. */
static bool copy_inverse_bind(const struct irb_gltf *gltf, const struct irb_gltf_skin *skin,
                              struct irb_deform_object *object, struct irb_error *err)
{
    static const char *const what = "inverseBindMatrices";
    struct gltf_array array = {0};

    object->inverse_bind = calloc((size_t)skin->joint_count, 16 * sizeof *object->inverse_bind);
    if (!object->inverse_bind)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for %d joints", skin->joint_count);
    if (skin->inverse_bind >= 0 &&
        !gltf_array_open(gltf, skin->inverse_bind, what, 16, &array, err))
        return false;
    if (skin->inverse_bind >= 0 && array.component != IRB_GLTF_FLOAT)
        return irb_fail(err, IRB_E_INPUT, "%s has component type %d, expected float", what,
                        array.component);
    if (skin->inverse_bind >= 0 && array.count < (size_t)skin->joint_count)
        return irb_fail(err, IRB_E_INPUT, "%s has %zu entries for %d joints", what, array.count,
                        skin->joint_count);
    for (int j = 0; j < skin->joint_count; j++)
        for (int i = 0; i < 16; i++) {
            double value =
                skin->inverse_bind >= 0 ? gltf_array_get(&array, (size_t)j, i) : i % 5 == 0;

            if (!isfinite(value))
                return irb_fail(err, IRB_E_INPUT, "%s: that of joint %d is not finite", what, j);
            object->inverse_bind[16 * j + i] = value;
        }
    return true;
}

/* Joints and shares of one vertex from one pair of accessors; a joint without share may be any. */
static bool copy_influences(const struct gltf_array *joints, const struct gltf_array *shares,
                            size_t source, int joint_count, uint16_t *held_by, float *out,
                            struct irb_error *err)
{
    for (int i = 0; i < 4; i++) {
        const int joint = (int)gltf_array_get(joints, source, i);

        out[i] = (float)gltf_array_get(shares, source, i);
        if (!isfinite(out[i]) || out[i] < 0)
            return irb_fail(err, IRB_E_INPUT, "vertex %zu has weight %g, expected 0 or more",
                            source, out[i]);
        held_by[i] = out[i] > 0 ? (uint16_t)joint : 0;
        if (out[i] > 0 && joint >= joint_count)
            return irb_fail(err, IRB_E_INPUT,
                            "vertex %zu: joint %d is out of range (the skin has %d)", source, joint,
                            joint_count);
    }
    return true;
}

static bool copy_set(const struct gltf_loader *loader, const struct gltf_surface *surface, int set,
                     struct irb_deform_object *object, struct irb_error *err)
{
    const struct irb_gltf_primitive *source = surface->source;
    struct gltf_array joints, shares;
    char names[2][32];

    snprintf(names[0], sizeof names[0], "JOINTS_%d", set);
    snprintf(names[1], sizeof names[1], "WEIGHTS_%d", set);
    if (!open_for_vertices(loader, surface, source->joints[set], names[0], 4, &joints, err) ||
        !open_for_vertices(loader, surface, source->shares[set], names[1], 4, &shares, err))
        return false;
    if (joints.component != IRB_GLTF_UNSIGNED_BYTE && joints.component != IRB_GLTF_UNSIGNED_SHORT)
        return irb_fail(err, IRB_E_INPUT,
                        "%s has component type %d, expected unsigned byte or short", names[0],
                        joints.component);
    joints.normalized = false;
    for (size_t v = 0; v < object->vertex_count; v++) {
        const size_t at = v * (size_t)object->influences + 4 * (size_t)set;

        if (!copy_influences(&joints, &shares, source_of(surface, v), object->joint_count,
                             object->held_by + at, object->shares + at, err))
            return false;
    }
    return true;
}

static bool read_skin(const struct gltf_loader *loader, const struct gltf_surface *surface,
                      struct irb_deform_object *object, struct irb_error *err)
{
    const struct irb_gltf *gltf = loader->gltf;
    const int skin = gltf->nodes[surface->node].skin;
    int sets = 0;
    size_t count;

    if (skin >= gltf->skin_count)
        return irb_fail(err, IRB_E_INPUT, "skin %d does not exist (the file has %d)", skin,
                        gltf->skin_count);
    if (!copy_joints(gltf, &gltf->skins[skin], object, err) ||
        !copy_inverse_bind(gltf, &gltf->skins[skin], object, err))
        return irb_error_prefix(err, "skin %d", skin);
    while (sets < IRB_GLTF_JOINT_SETS && surface->source->joints[sets] >= 0)
        sets++;
    object->influences = 4 * sets;
    count = (size_t)object->vertex_count * (size_t)object->influences;
    object->held_by = malloc((count + 1) * sizeof *object->held_by);
    object->shares = malloc((count + 1) * sizeof *object->shares);
    if (!object->held_by || !object->shares)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for the joints of %u vertices",
                        object->vertex_count);
    for (int set = 0; set < sets; set++)
        if (!copy_set(loader, surface, set, object, err))
            return false;
    return true;
}

/* ---- Both ---- */

bool gltf_deform(struct gltf_loader *loader, const struct gltf_surface *surface,
                 struct irb_error *err)
{
    struct irb_scene *scene = loader->builder.scene;
    struct irb_deform_object object = {.object = scene->object_count - 1,
                                       .first_vertex = surface->first_vertex,
                                       .vertex_count = scene->vertex_count - surface->first_vertex,
                                       .node = -1};

    if (copy_base(surface, &object, err) &&
        (surface->source->target_count == 0 || read_morph(loader, surface, &object, err)) &&
        (!gltf_has_skin(loader->gltf, surface->source, surface->node) ||
         read_skin(loader, surface, &object, err)))
        return irb_deform_add(scene, &object, err);
    irb_deform_object_free(&object);
    return false;
}
