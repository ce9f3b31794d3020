/* SPDX-License-Identifier: MIT
 *
 * A scene: triangles in world space at rest, grouped into objects, with materials and textures.
 * Objects move by their transform; the vertices of some are moved by an animation before that.
 * Metres, y up, right-handed. Surfaces are two-sided diffuse reflectors: the side that is seen (or
 * lit) is the side that reflects, nothing passes through.
 *
 * Does not: know OpenGL or Embree. Lights and cameras are only carried along from a file.
 */
#ifndef IRB_SCENE_SCENE_H
#define IRB_SCENE_SCENE_H

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/log.h"
#include "core/scene/light.h"

#include <stdint.h>

/* Lambert + Blinn (thesis 2.2.3, 5.3.4): L = (k_d n.l + k_s (n.h)^alpha) I/(pi r^2). */
struct irb_material {
    char name[64];
    float diffuse[3];    /* k_d, linear reflectance in [0,1], multiplied by the texture */
    float specular[3];   /* k_s, in [0,1] */
    float exponent;      /* alpha, >= 1 */
    int diffuse_texture; /* index into textures, or -1 */
    float alpha_cutoff;  /* > 0: surface only where the texture's alpha (its finest level, bilinear;
                            1 without one) reaches this; 0: opaque */
};

/* 8-bit RGBA texture, colour sRGB-encoded (glTF base colour); row 0 at the top (glTF v = 0). */
struct irb_scene_texture {
    char name[64];
    int width, height;
    unsigned char *rgba; /* owned */
};

/* A run of triangles that moves and is shaded as one. */
struct irb_object {
    char name[64];
    uint32_t first_triangle, triangle_count;
    int material;
    float transform[16]; /* column-major; of the current vertices; identity at rest */
};

/* A light or camera that the scene's file holds, in world space, at rest. A directional light's
 * half_width and a camera's z_far are 0 where the file leaves them open. */
struct irb_scene_light {
    char name[64];
    struct irb_light light;
};
struct irb_scene_camera {
    char name[64];
    struct irb_camera camera;
};

struct irb_scene {
    char name[64];
    uint32_t vertex_count, triangle_count;
    float *positions;  /* 3 a vertex, world space at rest, metres; owned */
    float *normals;    /* 3 a vertex, unit, at rest; owned */
    float *texcoords;  /* 2 a vertex; owned */
    uint32_t *indices; /* 3 a triangle; owned */
    struct irb_material *materials;
    int material_count;
    struct irb_scene_texture *textures;
    int texture_count;
    struct irb_object *objects;
    int object_count;
    float bounds_min[3], bounds_max[3]; /* of all vertices that a triangle uses, at rest */
    struct irb_scene_light *lights;     /* of the file, the primary one first; owned */
    int light_count;
    struct irb_scene_camera *cameras; /* owned */
    int camera_count;
    struct irb_motion *motion; /* the scene's own animation, or NULL; owned */
    struct irb_deform *deform; /* of the objects whose vertices it moves, or NULL; owned */
};

void irb_scene_destroy(struct irb_scene *scene); /* frees the scene too; NULL is fine */

/* Loads a built-in by its name, or a .gltf/.glb file by its path. IRB_E_INPUT names what is wrong:
 * a missing or truncated file, an index out of range, a non-finite vertex (mesh and number), no
 * triangles, a texture that is missing. Warnings (dropped lights, degenerate triangles) go to log.
 * What glTF materials become: core/scene/gltf/load.h. */
struct irb_scene *irb_scene_load(const char *name_or_path, struct irb_log *log,
                                 struct irb_error *err);

/* Moves the objects to where the scene's own animation has them at `seconds` (sets
 * irb_object.transform and the current vertices; objects that it does not move keep theirs). Times
 * before the first and after the last key hold those. Nothing happens in a scene without one.
 * IRB_E_MEMORY; IRB_E_INPUT for a vertex that it moves too far away. */
bool irb_scene_animate(struct irb_scene *scene, double seconds, struct irb_error *err);
/* When its animation starts and ends, seconds; false (and 0, 0) without one. */
bool irb_scene_duration(const struct irb_scene *scene, double *first, double *last);

/* Vertices now, before the objects' transforms: scene->positions and normals where nothing deforms,
 * else as the last irb_scene_animate() or irb_poses_apply() left them. */
const float *irb_scene_current_positions(const struct irb_scene *scene);
const float *irb_scene_current_normals(const struct irb_scene *scene);

/* The file's light of that name (NULL: the first); NULL where there is none. Cameras likewise. */
const struct irb_light *irb_scene_light_find(const struct irb_scene *scene, const char *name);
const struct irb_camera *irb_scene_camera_find(const struct irb_scene *scene, const char *name);

/* Content hash of everything that can change an image. */
struct irb_key irb_scene_key(const struct irb_scene *scene);

/* Bounds of the scene's current vertices with every object's current transform applied. */
void irb_scene_current_bounds(const struct irb_scene *scene, float min[3], float max[3]);

/* Bounds of one object at rest, and of its current vertices before its transform. */
void irb_object_rest_bounds(const struct irb_scene *scene, const struct irb_object *object,
                            float min[3], float max[3]);
void irb_object_current_bounds(const struct irb_scene *scene, const struct irb_object *object,
                               float min[3], float max[3]);

/* Length of the diagonal of the rest bounds. */
float irb_scene_diagonal(const struct irb_scene *scene);

#endif
