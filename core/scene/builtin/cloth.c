/* SPDX-License-Identifier: MIT
 *
 * A cloth in the wind: a rectangle that leans, held along its upper edge, with a wave that runs
 * down it. Its height over its plane, s and t in [0,1] across and down, is
 *
 *     h = A t sin(p - w time),   p = 2 pi (a s + b t),   w = 2 pi/T
 *       = cos(w time) h1 + sin(w time) h2,   h1 = A t sin p,   h2 = -A t cos p
 *
 * so that two morph targets, with animated weights, are all of it. The normals are exact as well:
 * n - h_x x - h_y y is linear in h.
 */
#include "core/scene/builtin/geometry.h"

#include "core/scene/deform.h"
#include "core/scene/motion.h"
#include "core/scene/vec.h"

#include <stdlib.h>
#include <string.h>

enum { COLUMNS = 48, ROWS = 48, VERTICES = (COLUMNS + 1) * (ROWS + 1), TARGETS = 2 };

/* Sizes are ours, metres; waves across and down the cloth. */
static const double corner[3] = {0.1, 0.36, 0.44}; /* upper left */
static const double across[3] = {1, 0, 0};
static const double down[3] = {0, -0.64278760968653932, -0.76604444311897804}; /* 40 degrees */
static const double width = 0.36, length = 0.38, amplitude = 0.04;
static const double waves_across = 1.25, waves_down = 0.75;

/* Of the animation: seconds a period; keys of it, cubic (0.1 % of the sine that they stand for);
 * periods that it lasts. */
static const double period = 2;
enum { KEYS_A_PERIOD = 8, PERIODS = 60, KEYS = KEYS_A_PERIOD * PERIODS + 1 };

/* ---- Shape ---- */

static void add_vertices(struct irb_builder *builder, const double up[3])
{
    for (int j = 0; j <= ROWS; j++)
        for (int i = 0; i <= COLUMNS; i++) {
            const double s = (double)i / COLUMNS, t = (double)j / ROWS;
            double p[3];

            for (int c = 0; c < 3; c++)
                p[c] = corner[c] + s * width * across[c] + t * length * down[c];
            irb_builder_vertex(builder, p, up, (const double[]){s, t});
        }
}

static void add_triangles(struct irb_builder *builder, uint32_t first)
{
    for (int j = 0; j < ROWS; j++)
        for (int i = 0; i < COLUMNS; i++) {
            const uint32_t a = first + (uint32_t)(j * (COLUMNS + 1) + i), d = a + COLUMNS + 1;

            irb_builder_triangle(builder, a, a + 1, d + 1);
            irb_builder_triangle(builder, a, d + 1, d);
        }
}

/* Displacements of one vertex by both targets. */
static void set_targets(struct irb_deform_object *object, size_t v, const double up[3])
{
    const double s = (double)(v % (COLUMNS + 1)) / COLUMNS, t = (double)(v / (COLUMNS + 1)) / ROWS;
    const double turn_across = 2 * M_PI * waves_across, turn_down = 2 * M_PI * waves_down;
    const double phase = turn_across * s + turn_down * t;

    for (int k = 0; k < TARGETS; k++) {
        /* sin p, or -cos p, and its derivative by p */
        const double wave = k == 0 ? sin(phase) : -cos(phase);
        const double slope = k == 0 ? cos(phase) : sin(phase);
        const double h = amplitude * t * wave;
        const double h_across = amplitude * t * slope * turn_across / width;
        const double h_down = amplitude * (wave + t * slope * turn_down) / length;
        const size_t at = 3 * ((size_t)k * VERTICES + v);

        for (size_t c = 0; c < 3; c++) {
            object->target_positions[at + c] = (float)(h * up[c]);
            object->target_normals[at + c] = (float)(-h_across * across[c] - h_down * down[c]);
        }
    }
}

static bool deform_cloth(struct irb_scene *scene, uint32_t first, const double up[3])
{
    const size_t size = 3 * VERTICES * sizeof(float);
    struct irb_error err = {0};
    struct irb_deform_object object = {.object = scene->object_count - 1,
                                       .first_vertex = first,
                                       .vertex_count = VERTICES,
                                       .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                       .positions = malloc(size),
                                       .normals = malloc(size),
                                       .target_count = TARGETS,
                                       .weights = calloc(TARGETS, sizeof(double)),
                                       .target_positions = malloc(TARGETS * size),
                                       .target_normals = malloc(TARGETS * size)};

    if (!object.positions || !object.normals || !object.weights || !object.target_positions ||
        !object.target_normals) {
        irb_deform_object_free(&object);
        return false;
    }
    memcpy(object.positions, scene->positions + 3 * (size_t)first, size);
    memcpy(object.normals, scene->normals + 3 * (size_t)first, size);
    object.weights[0] = 1; /* as the animation starts */
    for (size_t v = 0; v < VERTICES; v++)
        set_targets(&object, v, up);
    return irb_deform_add(scene, &object, &err);
}

/* ---- Animation ---- */

static void set_keys(struct irb_motion_channel *channel)
{
    const double turn = 2 * M_PI / period;

    for (int k = 0; k < KEYS; k++) {
        const double angle = 2 * M_PI * (k % KEYS_A_PERIOD) / KEYS_A_PERIOD;
        const double value[TARGETS] = {cos(angle), sin(angle)};
        const double tangent[TARGETS] = {-turn * sin(angle), turn * cos(angle)};
        float *out = channel->values + 3 * TARGETS * k;

        channel->times[k] = (float)(period * k / KEYS_A_PERIOD);
        for (int i = 0; i < TARGETS; i++) {
            out[i] = out[2 * TARGETS + i] = (float)tangent[i];
            out[TARGETS + i] = (float)value[i];
        }
    }
}

/* One node, with one channel: the weights. */
static bool animate_cloth(struct irb_scene *scene)
{
    struct irb_motion *motion = calloc(1, sizeof *motion);
    struct irb_motion_channel *channel;

    scene->motion = motion;
    if (!motion)
        return false;
    motion->nodes = calloc(1, sizeof *motion->nodes);
    motion->channels = calloc(1, sizeof *motion->channels);
    motion->object_nodes = malloc((size_t)scene->object_count * sizeof *motion->object_nodes);
    if (!motion->nodes || !motion->channels || !motion->object_nodes)
        return false;
    for (int i = 0; i < scene->object_count; i++)
        motion->object_nodes[i] = -1;
    motion->nodes[0] =
        (struct irb_motion_node){.parent = -1, .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    motion->node_count = motion->channel_count = 1;
    channel = motion->channels;
    *channel = (struct irb_motion_channel){.path = IRB_MOTION_WEIGHTS,
                                           .interpolation = IRB_MOTION_CUBIC,
                                           .count = KEYS,
                                           .width = TARGETS,
                                           .times = malloc(KEYS * sizeof(float)),
                                           .values = malloc(3 * TARGETS * KEYS * sizeof(float))};
    if (!channel->times || !channel->values)
        return false;
    set_keys(channel);
    motion->last = PERIODS * period;
    return true;
}

void irb_builder_cloth(struct irb_builder *builder, const char *name, int material)
{
    struct irb_error err = {0};
    uint32_t first;
    double up[3];

    vec_cross(across, down, up);
    irb_builder_object(builder, name, material);
    first = builder->scene ? builder->scene->vertex_count : 0;
    add_vertices(builder, up);
    add_triangles(builder, first);
    if (!builder->failure &&
        (!deform_cloth(builder->scene, first, up) || !animate_cloth(builder->scene) ||
         !irb_deform_start(builder->scene, &err)))
        builder->failure = IRB_E_MEMORY;
}
