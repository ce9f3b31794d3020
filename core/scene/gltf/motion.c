/* SPDX-License-Identifier: MIT
 *
 * The first animation of a glTF file, and what it deforms.
 */
#include "core/scene/gltf/load.h"

#include "core/scene/deform.h"
#include "core/scene/motion.h"
#include "core/scene/vec.h"

#include <stdlib.h>
#include <string.h>

/* ---- Channels ---- */

/* Index of `name` among `names`, or -1. */
static int find_name(const char *name, const char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

static bool copy_times(const struct gltf_array *input, struct irb_motion_channel *channel,
                       struct irb_error *err)
{
    for (int k = 0; k < channel->count; k++) {
        channel->times[k] = (float)gltf_array_get(input, (size_t)k, 0);
        if (!isfinite(channel->times[k]) || (k > 0 && !(channel->times[k] > channel->times[k - 1])))
            return irb_fail(err, IRB_E_INPUT,
                            "time %g of key %d does not come after the one before",
                            channel->times[k], k);
    }
    return true;
}

static bool copy_values(const struct gltf_array *output, struct irb_motion_channel *channel,
                        struct irb_error *err)
{
    float *value = channel->values;

    for (size_t i = 0; i < output->count; i++)
        for (int c = 0; c < output->components; c++, value++) {
            *value = (float)gltf_array_get(output, i, c);
            if (!isfinite(*value))
                return irb_fail(err, IRB_E_INPUT, "value %zu is not finite", i);
        }
    return true;
}

/* Numbers that a key of the channel holds; 0 where there is nothing to animate. */
static int channel_width(const struct irb_gltf *gltf, const struct irb_gltf_channel *source,
                         int path)
{
    int mesh = gltf->nodes[source->node].mesh;

    if (path != IRB_MOTION_WEIGHTS)
        return path == IRB_MOTION_ROTATION ? 4 : 3;
    return mesh >= 0 && gltf->meshes[mesh].primitive_count > 0
               ? gltf->meshes[mesh].primitives[0].target_count
               : 0;
}

static bool read_channel(const struct irb_gltf *gltf, const struct irb_gltf_channel *source,
                         struct irb_motion_channel *channel, struct irb_error *err)
{
    const bool weights = channel->path == IRB_MOTION_WEIGHTS; /* which come as single numbers */
    size_t values = (size_t)(channel->interpolation == IRB_MOTION_CUBIC ? 3 : 1) *
                    (size_t)(weights ? channel->width : 1);
    struct gltf_array input, output;

    if (!gltf_array_open(gltf, source->input, "input", 1, &input, err) ||
        !gltf_array_open(gltf, source->output, "output", weights ? 1 : channel->width, &output,
                         err))
        return false;
    if (input.count == 0 || input.count > INT32_MAX / 12 || output.count != values * input.count)
        return irb_fail(err, IRB_E_INPUT, "has %zu times and %zu values, expected %zu a time",
                        input.count, output.count, values);
    channel->count = (int)input.count;
    channel->times = malloc(input.count * sizeof(float));
    channel->values = malloc(output.count * (size_t)output.components * sizeof(float));
    if (!channel->times || !channel->values)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for %zu keys", input.count);
    return copy_times(&input, channel, err) && copy_values(&output, channel, err);
}

/* Channels whose node is not shown are left out. A matrix is not animated, but its node's weights
 * may be. */
static bool read_channels(struct gltf_loader *loader, struct irb_motion *motion, const int *places,
                          struct irb_error *err)
{
    static const char *const paths[] = {"translation", "rotation", "scale", "weights"};
    static const char *const kinds[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const struct irb_gltf *gltf = loader->gltf;

    for (int i = 0; i < gltf->channel_count; i++) {
        const struct irb_gltf_channel *source = &gltf->channels[i];
        int path = find_name(source->path, paths, 4), width;
        int kind = find_name(source->interpolation, kinds, 3);
        struct irb_motion_channel *channel = &motion->channels[motion->channel_count];

        if (source->node < 0 || source->node >= gltf->node_count || places[source->node] < 0)
            continue;
        width = path < 0 ? 0 : channel_width(gltf, source, path);
        if (width == 0 ||
            (path != IRB_MOTION_WEIGHTS && motion->nodes[places[source->node]].has_matrix)) {
            irb_warn(loader->log, "%s: animation channel %d ('%s' of node '%s') is ignored",
                     loader->path, i, source->path, gltf->nodes[source->node].name);
            continue;
        }
        channel->node = places[source->node];
        channel->path = (enum irb_motion_path)path;
        channel->width = width;
        channel->interpolation = kind < 0 ? IRB_MOTION_LINEAR : (enum irb_motion_interpolation)kind;
        motion->channel_count++;
        if (!read_channel(gltf, source, channel, err))
            return irb_error_prefix(err, "animation channel %d", i);
    }
    return true;
}

/* ---- Nodes ---- */

static void copy_nodes(const struct irb_gltf *gltf, struct irb_motion *motion, const int *order,
                       const int *parents, const int *places)
{
    for (int n = 0; n < motion->node_count; n++) {
        const struct irb_gltf_node *source = &gltf->nodes[order[n]];
        struct irb_motion_node *node = &motion->nodes[n];

        node->parent = parents[order[n]] < 0 ? -1 : places[parents[order[n]]];
        node->has_matrix = source->has_matrix;
        memcpy(node->matrix, source->matrix, sizeof node->matrix);
        memcpy(node->translation, source->translation, sizeof node->translation);
        memcpy(node->rotation, source->rotation, sizeof node->rotation);
        memcpy(node->scale, source->scale, sizeof node->scale);
    }
}

static void set_span(struct irb_motion *motion)
{
    for (int c = 0; c < motion->channel_count; c++) {
        const struct irb_motion_channel *channel = &motion->channels[c];
        double first = channel->times[0], last = channel->times[channel->count - 1];

        motion->first = c == 0 ? first : fmin(motion->first, first);
        motion->last = c == 0 ? last : fmax(motion->last, last);
    }
}

/* glTF's numbers of nodes become the motion's. */
static bool place_deformed(struct gltf_loader *loader, struct irb_motion *motion, const int *places,
                           struct irb_error *err)
{
    struct irb_deform *deform = loader->builder.scene->deform;

    for (int i = 0; deform && i < deform->object_count; i++) {
        struct irb_deform_object *object = &deform->objects[i];

        object->node = object->target_count > 0 ? places[object->node] : -1;
        for (int j = 0; j < object->joint_count; j++) {
            int node = object->joints[j];

            if (places[node] < 0)
                return irb_fail(err, IRB_E_INPUT, "joint %d, node %d '%s', is not in the scene", j,
                                node, loader->gltf->nodes[node].name);
            object->joints[j] = places[node];
        }
        if (object->joint_count > 0)
            motion->object_nodes[object->object] = -1; /* its joints move it */
    }
    return true;
}

/* Fills a motion whose arrays are there. */
static bool fill(struct gltf_loader *loader, struct irb_motion *motion, const int *order,
                 const int *parents, int *places, struct irb_error *err)
{
    int objects = loader->builder.scene->object_count, flat;

    for (int i = 0; i < loader->gltf->node_count; i++)
        places[i] = -1;
    for (int n = 0; n < motion->node_count; n++)
        places[order[n]] = n;
    copy_nodes(loader->gltf, motion, order, parents, places);
    for (int i = 0; i < objects; i++)
        motion->object_nodes[i] =
            loader->object_nodes[i] < 0 ? -1 : places[loader->object_nodes[i]];
    if (!read_channels(loader, motion, places, err) || !place_deformed(loader, motion, places, err))
        return false;
    set_span(motion);
    if (!irb_motion_prepare(motion, &flat))
        return irb_fail(err, IRB_E_INPUT,
                        "node %d '%s' is animated but has no extent at rest (a scale of 0)",
                        order[flat], loader->gltf->nodes[order[flat]].name);
    return true;
}

bool gltf_motion(struct gltf_loader *loader, const int *order, int count, const int *parents,
                 struct irb_error *err)
{
    const struct irb_gltf *gltf = loader->gltf;
    struct irb_scene *scene = loader->builder.scene;
    struct irb_motion *motion;
    int *places;
    bool ok;

    if (loader->builder.failure || (gltf->channel_count == 0 && !scene->deform))
        return true;
    motion = calloc(1, sizeof *motion);
    places = malloc(((size_t)gltf->node_count + 1) * sizeof *places);
    if (motion) {
        motion->node_count = count;
        motion->nodes = calloc((size_t)count + 1, sizeof *motion->nodes);
        motion->channels = calloc((size_t)gltf->channel_count + 1, sizeof *motion->channels);
        motion->object_nodes =
            malloc(((size_t)scene->object_count + 1) * sizeof *motion->object_nodes);
    }
    if (!motion || !places || !motion->nodes || !motion->channels || !motion->object_nodes)
        ok = irb_fail(err, IRB_E_MEMORY, "out of memory");
    else
        ok = fill(loader, motion, order, parents, places, err);
    free(places);
    scene->motion = motion;
    ok = ok && irb_deform_start(scene, err);
    if (ok && motion->channel_count > 0)
        return true;
    scene->motion = NULL;
    irb_motion_destroy(motion);
    return ok;
}
