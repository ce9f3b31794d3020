/* SPDX-License-Identifier: MIT
 *
 * Motion of a scene's objects: a tree of nodes with keyframed translation, rotation, scale and
 * morph weights (a glTF file's first animation), evaluated at any time. What weights and joints do
 * to vertices: core/scene/deform.h.
 */
#ifndef IRB_SCENE_MOTION_H
#define IRB_SCENE_MOTION_H

#include <stdbool.h>

enum irb_motion_path {
    IRB_MOTION_TRANSLATION,
    IRB_MOTION_ROTATION,
    IRB_MOTION_SCALE,
    IRB_MOTION_WEIGHTS
};
enum irb_motion_interpolation { IRB_MOTION_STEP, IRB_MOTION_LINEAR, IRB_MOTION_CUBIC };

struct irb_motion_channel {
    int node;
    enum irb_motion_path path;
    enum irb_motion_interpolation interpolation;
    int count;     /* of keys, at least 1 */
    int width;     /* numbers a value: 3, 4 for rotations (xyzw), one a morph target for weights */
    float *times;  /* seconds, rising; owned */
    float *values; /* of all keys; CUBIC: in-tangent, value, out-tangent a key; owned */
};

struct irb_motion_node {
    int parent; /* -1 for a root; parents come before their children */
    bool has_matrix, moves;
    double matrix[16];                            /* local, column-major, where has_matrix */
    double translation[3], rotation[4], scale[3]; /* local at rest, else */
    double rest_inverse[16];                      /* of the world matrix at rest, where it moves */
};

struct irb_motion {
    struct irb_motion_node *nodes; /* owned */
    int node_count;
    struct irb_motion_channel *channels; /* owned */
    int channel_count;
    int *object_nodes;  /* of each object of the scene; owned */
    double first, last; /* seconds: the earliest and latest key */
};

void irb_motion_destroy(struct irb_motion *motion); /* frees it too; NULL is fine */

/* T R S of a node, or its matrix; column-major. */
void irb_motion_local(const struct irb_motion_node *node, double out[16]);
void irb_motion_multiply(const double a[16], const double b[16], double out[16]);

/* World matrices of all nodes at rest; `world` has room for node_count matrices. */
void irb_motion_rest(const struct irb_motion *motion, double (*world)[16]);

/* The morph weights of a node at `seconds`; false (and untouched) where no channel animates them.
 * `weights` has room for the channel's width. */
bool irb_motion_weights(const struct irb_motion *motion, int node, double seconds, double *weights);

/* Marks nodes that a channel moves, themselves or through a parent, and sets their rest_inverse.
 * False when one of them has no inverse at rest (a scale of 0); *node is its index. */
bool irb_motion_prepare(struct irb_motion *motion, int *node);

/* The object's transform, rest to `seconds`; false (and untouched) where it does not move. Times
 * before the first and after the last key hold those. `world` has room for node_count matrices. */
void irb_motion_evaluate(const struct irb_motion *motion, double seconds, double (*world)[16]);
bool irb_motion_transform(const struct irb_motion *motion, double (*world)[16], int object,
                          float transform[16]);

#endif
