/* SPDX-License-Identifier: MIT
 *
 * glTF 2.0 to scene. Split over load.c (file, nodes), material.c (materials, textures), mesh.c
 * (primitives), deform.c (morph targets, skins), motion.c (the animation) and array.c
 * (bounds-checked reading of accessors).
 *
 * What is read: the default scene's nodes with TRS or matrix (baked into the vertices); meshes of
 * triangles, strips and fans with positions, normals and one texture coordinate set; base colour
 * factor and texture.
 *
 * What that becomes: k_d = base colour (factor times texture), k_s = 0: Lambert. Only where the
 * file itself states metallicFactor > 0 or roughnessFactor < 1 and has no metallic-roughness
 * texture there is a highlight: with metallic m, roughness r, base colour b (the factor),
 *     F0 = lerp(0.04, b, m), k_d = b (1 - m), k_s = F0, alpha = clamp(2/r^4 - 2, 1, 1e4)
 * (alpha: the Blinn exponent of a Beckmann roughness r^2, Walter et al. 2007). The lobe k_s
 * (n.h)^alpha/pi is not normalised; at normal incidence it reflects rho_s = k_s 8 (1 -
 * 2^(-(alpha+2)/2))/(alpha + 2). To conserve energy k_s is scaled so that rho_s <= 1, then k_d <= 1
 * - rho_s. Files with textures for it stay Lambert, with a warning.
 *
 * Lights (spot and directional of KHR_lights_punctual, W/sr and W/m2 one to one), perspective
 * cameras and the first animation's translations, rotations, scales and morph weights go into the
 * scene; so do morph targets (positions and normals) and skins, which pose the vertices at rest
 * too. A skinned mesh goes where its joints are, not where its node is (glTF 2.0, 3.7.3.3). The
 * alpha mask goes into the material. Emission, point lights, further animations, blending and
 * texture transforms are dropped with a warning each. Missing normals become flat normals
 * (glTF 2.0, 3.7.2.1), so that such triangles share no vertices and stay flat when they deform; a
 * normal that is zero or not finite becomes the area-weighted mean of its triangles' (one counted
 * warning); degenerate triangles, by the vertices without morph and skin, are dropped (one counted
 * warning). Missing texture coordinates are 0.
 */
#ifndef IRB_SCENE_GLTF_LOAD_H
#define IRB_SCENE_GLTF_LOAD_H

#include "core/scene/builder.h"
#include "core/scene/gltf/gltf.h"

/* As irb_scene_load, for a path. */
struct irb_scene *irb_gltf_load(const char *path, struct irb_log *log, struct irb_error *err);

/* ---- Within the loader ---- */

struct gltf_loader {
    const char *path;
    const struct irb_gltf *gltf;
    struct irb_log *log;
    struct irb_builder builder;
    int *materials; /* scene's material for a glTF material, -1 until it is used; the last slot is
                       glTF's default material */
    int *textures;  /* scene's texture for a glTF image, -1 until it is used */
    long degenerate, bad_normals, unlit_primitives; /* counted for the warnings at the end */
    size_t deltas;                                  /* numbers of morph targets so far */
    bool *lights_placed;                            /* whether a node holds the light */
    int *object_nodes;                              /* glTF node of each object */
    int object_capacity, first_object;              /* the next object that has no node yet */
};

/* An accessor whose bytes are known to lie within its buffer. */
struct gltf_array {
    const unsigned char *data;
    size_t count, stride;
    int component, components;
    bool normalized;
};

/* `what` ("POSITION") appears in messages; `components` is the number that must be there. */
bool gltf_array_open(const struct irb_gltf *gltf, int accessor, const char *what, int components,
                     struct gltf_array *array, struct irb_error *err);
/* Component c of element i; normalised integers give [0,1] or [-1,1]. */
double gltf_array_get(const struct gltf_array *array, size_t i, int c);
uint32_t gltf_array_index(const struct gltf_array *array, size_t i);
/* The bytes of a buffer view, checked. */
bool gltf_view_bytes(const struct irb_gltf *gltf, int view, const unsigned char **data,
                     size_t *size, struct irb_error *err);

/* The scene's material for the glTF material (-1: the default); false on failure. */
bool gltf_material(struct gltf_loader *loader, int index, int *out, struct irb_error *err);

/* Adds the node's light, or camera, to the scene. What cannot be one is warned about. */
void gltf_light(struct gltf_loader *loader, const struct irb_gltf_node *node,
                const double world[16]);
void gltf_camera(struct gltf_loader *loader, const struct irb_gltf_node *node,
                 const double world[16]);
void gltf_warn_about_lights(const struct gltf_loader *loader);

/* The first animation, over the `count` nodes in `order` (parents first); `parents` holds the
 * parent of each glTF node, or -1. Poses what deforms at rest. Leaves the scene without an
 * animation where nothing moves. */
bool gltf_motion(struct gltf_loader *loader, const int *order, int count, const int *parents,
                 struct irb_error *err);

/* Appends the mesh of glTF's node as one object a primitive, transformed by `world` (column-major),
 * or left in its own space where the node has a skin. */
bool gltf_mesh(struct gltf_loader *loader, int node, const double world[16], struct irb_error *err);

/* A primitive that has become the last object of the scene. */
struct gltf_surface {
    const struct irb_gltf_primitive *source;
    int node;
    const double *world;
    const struct gltf_array *position, *normal; /* normal NULL: flat */
    const uint32_t *sources; /* the file's vertex of each of the object's; NULL: in order */
    uint32_t first_vertex;   /* the object's are all from here on */
};

bool gltf_has_skin(const struct irb_gltf *gltf, const struct irb_gltf_primitive *source, int node);
/* Adds its morph targets and skin to the scene; joints and node are glTF's numbers until
 * gltf_motion(). */
bool gltf_deform(struct gltf_loader *loader, const struct gltf_surface *surface,
                 struct irb_error *err);

#endif
