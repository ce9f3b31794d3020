/* SPDX-License-Identifier: MIT
 *
 * A scene's geometry and materials in OpenGL, drawn the same way from the camera and the light.
 */
#ifndef IRB_FRAME_SCENE_GL_H
#define IRB_FRAME_SCENE_GL_H

#include "core/gl/objects.h"
#include "core/gl/program.h"
#include "core/scene/scene.h"

struct irb_scene_gl {
    const struct irb_scene *scene; /* borrowed */
    struct irb_gl *gl;             /* borrowed */
    struct irb_buffer *positions, *normals, *texcoords, *indices;
    struct irb_texture **textures; /* one a scene texture, sRGB-decoded, mipmapped */
    unsigned vertex_array;
};

struct irb_scene_gl *irb_scene_gl_create(struct irb_gl *gl, const struct irb_scene *scene,
                                         struct irb_error *err);
void irb_scene_gl_destroy(struct irb_scene_gl *scene);

/* Draws every object with `program`, which has the uniforms of shaders/frame/geometry.glsl (model
 * matrix, material); the caller has set view, projection, framebuffer and depth state. */
void irb_scene_gl_draw(const struct irb_scene_gl *scene, const struct irb_program *program);

#endif
