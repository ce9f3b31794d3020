/* SPDX-License-Identifier: MIT
 *
 * glTF 2.0 to scene. Split over gltf_load.c (file, nodes), gltf_material.c (materials, textures),
 * gltf_mesh.c (primitives) and gltf_array.c (bounds-checked reading of accessors).
 *
 * What is read: the default scene's nodes with TRS or matrix (baked into the vertices); meshes of
 * triangles, strips and fans with positions, normals and one texture coordinate set; base colour
 * factor and texture.
 *
 * What that becomes: k_d = base colour (factor times texture), k_s = 0: Lambert, whatever metallic
 * and roughness say. Lights, cameras, emission, skins, morph targets, animations, transparency and
 * texture transforms are dropped with a warning each. Missing normals become flat normals (glTF
 * 2.0, 3.7.2.1), so that such triangles share no vertices; a normal that is zero or not finite
 * becomes the area-weighted mean of its triangles' (one counted warning); degenerate triangles are
 * dropped (one counted warning). Missing texture coordinates are 0.
 */
#ifndef IRB_SCENE_GLTF_LOAD_H
#define IRB_SCENE_GLTF_LOAD_H

#include "core/scene/builder.h"
#include "core/scene/gltf.h"

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
    long morphs, skins;
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

/* Appends the mesh as one object a primitive, transformed by `world` (column-major). */
bool gltf_mesh(struct gltf_loader *loader, int mesh, const char *node_name, const double world[16],
               struct irb_error *err);

#endif
