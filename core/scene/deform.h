/* SPDX-License-Identifier: MIT
 *
 * Objects whose vertices change: morph targets and skins, as glTF 2.0 has them (3.7.2.2, 3.7.3).
 *
 *     p = p0 + sum_k w_k dp_k,   n = n0 + sum_k w_k dn_k          (in the mesh's own space)
 *     world = M p,  normal = cof(M) n / |cof(M) n|
 *
 * M is the node's matrix, or in a skin sum_j s_j J_j B_j: of the joints' world matrices J times
 * their inverse bind matrices B, by the vertex's shares s. Targets are added first, joints move the
 * sum. The object's own transform (irb_object.transform) goes on top of the result.
 *
 * Does not: find weights or joints, which core/scene/motion.h does.
 */
#ifndef IRB_SCENE_DEFORM_H
#define IRB_SCENE_DEFORM_H

#include "core/base/error.h"
#include "core/base/hash.h"

#include <stdbool.h>
#include <stdint.h>

struct irb_scene;

/* Owns its arrays, which are malloc'ed. */
struct irb_deform_object {
    int object;                          /* of the scene */
    uint32_t first_vertex, vertex_count; /* of the scene; no other object uses these */
    double matrix[16]; /* mesh -> world at rest, column-major; in a skin of vertices that no joint
                          holds (all shares 0) */
    float *positions;  /* before all of this, in the mesh's space; 3 a vertex */
    float *normals;    /* likewise, of any length; NULL: each triangle has vertices of its own, and
                          its geometric normal */
    /* ---- morph targets ---- */
    int target_count;
    double *weights;         /* at rest, one a target */
    float *target_positions; /* displacement at weight 1: 3 a vertex, target after target */
    float *target_normals;   /* likewise; NULL: none */
    int node;                /* of the scene's motion, whose weights are these; -1: none */
    /* ---- skin ---- */
    int joint_count;      /* 0: no skin */
    int *joints;          /* nodes of the scene's motion */
    double *inverse_bind; /* 16 a joint, column-major */
    int influences;       /* joints a vertex */
    uint16_t *held_by;    /* influences a vertex: indices into joints */
    float *shares;        /* of these; at least 0, of any sum: they are divided by it */
    /* ---- set by irb_deform_start() ---- */
    double *rest, *state; /* weights, then J B of each joint: at rest, and now */
    uint64_t version;     /* at least 1; rises whenever the vertices change */
};

struct irb_deform {
    struct irb_deform_object *objects; /* owned, in rising order of their objects */
    int object_count;
    float *positions, *normals; /* of all the scene's vertices, now; owned */
};

void irb_deform_destroy(struct irb_deform *deform); /* NULL is fine */

/* Adds the object to the scene's and takes over its arrays, on failure (IRB_E_MEMORY) too. */
bool irb_deform_add(struct irb_scene *scene, struct irb_deform_object *object,
                    struct irb_error *err);
void irb_deform_object_free(struct irb_deform_object *object);

/* Once, when scene and motion are complete but for their bounds: sets the scene's vertices at rest
 * (weights at rest, joints where they rest), and leaves scene->deform NULL where no channel changes
 * any of them. IRB_E_MEMORY; IRB_E_INPUT for a vertex that lands farther than
 * IRB_SCENE_MAX_COORDINATE. */
bool irb_deform_start(struct irb_scene *scene, struct irb_error *err);

/* Sets the vertices to those of `seconds`; `world` holds the motion's world matrices then. A normal
 * that vanishes keeps its direction at rest. Errors as above; the vertices are then at rest. */
bool irb_deform_animate(struct irb_scene *scene, double (*world)[16], double seconds,
                        struct irb_error *err);
void irb_deform_reset(struct irb_scene *scene); /* to rest */

/* Whether all vertices are where they rest, to the bit. */
bool irb_deform_at_rest(const struct irb_scene *scene);
/* Adds the vertices of what is not at rest; nothing where all is. */
void irb_deform_hash(const struct irb_scene *scene, struct irb_hash *hash);
/* The record of the scene's object; NULL where its vertices never change. */
const struct irb_deform_object *irb_deform_find(const struct irb_scene *scene, int object);

#endif
