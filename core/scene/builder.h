/* SPDX-License-Identifier: MIT
 *
 * Grows a scene vertex by vertex; for the built-ins and the glTF loader. Running out of memory or
 * over a bound is remembered and reported once, by irb_builder_finish(), so that code that makes
 * geometry reads without error checks.
 *
 *     struct irb_builder builder;
 *     irb_builder_begin(&builder, "name");
 *     int white = irb_builder_material(&builder, "white", (const float[3]){0.7f, 0.7f, 0.7f});
 *     irb_builder_object(&builder, "floor", white);
 *     irb_builder_quad(&builder, corners);
 *     return irb_builder_finish(&builder, err);
 */
#ifndef IRB_SCENE_BUILDER_H
#define IRB_SCENE_BUILDER_H

#include "core/scene/scene.h"

/* Bounds that keep every count and byte size well inside 32 bits of index and ordinary memory. */
enum { IRB_SCENE_MAX_VERTICES = 300000000, IRB_SCENE_MAX_TRIANGLES = 100000000 };

/* Farthest vertex from the origin that a file may have, along an axis, metres: squares of squares
 * of it still fit a float. */
#define IRB_SCENE_MAX_COORDINATE 1e9

struct irb_builder {
    struct irb_scene *scene; /* owned until irb_builder_finish */
    uint32_t vertex_capacity, triangle_capacity;
    enum irb_error_code failure; /* the first failure, or IRB_E_OK */
};

void irb_builder_begin(struct irb_builder *builder, const char *name);

/* Index of a new Lambert material without texture. */
int irb_builder_material(struct irb_builder *builder, const char *name, const float diffuse[3]);

/* Takes over `rgba` (malloc'ed); index of the new texture. */
int irb_builder_texture(struct irb_builder *builder, const char *name, int width, int height,
                        unsigned char *rgba);

/* Triangles that follow belong to this object. An object that got none is dropped. */
void irb_builder_object(struct irb_builder *builder, const char *name, int material);

/* Index of the new vertex. `texcoord` may be NULL for (0,0). */
uint32_t irb_builder_vertex(struct irb_builder *builder, const double position[3],
                            const double normal[3], const double texcoord[2]);
void irb_builder_triangle(struct irb_builder *builder, uint32_t a, uint32_t b, uint32_t c);

/* Two triangles (0,1,2), (0,2,3), each with its own flat normal on the side from which the corners
 * run counter-clockwise. */
void irb_builder_quad(struct irb_builder *builder, const double corners[4][3]);

/* Replaces the normals of all vertices from `first_vertex` on by the area-weighted mean of the
 * triangles from `first_triangle` on that share them. With `only_zero` just those that are zero. A
 * vertex without any such triangle gets +y. */
void irb_builder_smooth_normals(struct irb_builder *builder, uint32_t first_vertex,
                                uint32_t first_triangle, bool only_zero);

/* The finished scene with its bounds; NULL and IRB_E_MEMORY on failure. Empties the builder. */
struct irb_scene *irb_builder_finish(struct irb_builder *builder, struct irb_error *err);
/* Frees a scene that will not be finished. */
void irb_builder_abandon(struct irb_builder *builder);

#endif
