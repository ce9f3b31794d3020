/* SPDX-License-Identifier: MIT
 *
 * A scene's triangles in world space as they are now: objects' transforms and animated vertices
 * applied, once a frame, so that each of the many points on them costs three fetches. Read in GLSL
 * by lights/points.glsl.
 */
#ifndef IRB_LIGHTS_WORLD_TRIANGLES_H
#define IRB_LIGHTS_WORLD_TRIANGLES_H

#include "core/frame/scene_gl.h"

struct irb_world_triangles {
    struct irb_gl *gl;          /* borrowed */
    struct irb_buffer *corners; /* 3 vec4 a triangle: corner 0, edge to corner 1, edge to corner 2
                                   (m); their w are the vector unit normal * area / points on it
                                   (m2), area / 1 without points */
    unsigned texture;           /* the same as GL_RGBA32F texels */
    uint32_t count;             /* triangles */
    struct irb_program *program;
};

struct irb_world_triangles *irb_world_triangles_create(struct irb_gl *gl, struct irb_error *err);
void irb_world_triangles_destroy(struct irb_world_triangles *triangles);

/* Reads the scene's buffers and objects' transforms. density: a float a triangle, points there;
 * NULL: 1 everywhere. IRB_E_BACKEND for more triangles than the driver's buffers hold (2.7 million
 * in the 128 MiB that GL promises). */
bool irb_world_triangles_update(struct irb_world_triangles *triangles,
                                const struct irb_scene_gl *scene, const struct irb_buffer *density,
                                struct irb_error *err);

/* Texture unit `unit` and the uniform triangles of lights/points.glsl. */
void irb_world_triangles_bind(const struct irb_world_triangles *triangles,
                              const struct irb_program *program, int unit);

#endif
