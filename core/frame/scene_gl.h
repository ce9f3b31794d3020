/* SPDX-License-Identifier: MIT
 *
 * A scene's geometry and materials in OpenGL, drawn the same way from the camera and the light.
 * Vertices are the scene's current ones, before the objects' transforms.
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
    struct irb_buffer *flat_normals; /* one vec4 a triangle: unit normal before the transform; 0 */
    struct irb_texture **textures;   /* one a scene texture, sRGB-decoded, mipmapped */
    unsigned vertex_array;
    bool masked;        /* some material has an alpha mask */
    uint64_t *versions; /* of what deforms: those that the buffers hold; owned */
};

struct irb_scene_gl *irb_scene_gl_create(struct irb_gl *gl, const struct irb_scene *scene,
                                         struct irb_error *err);
void irb_scene_gl_destroy(struct irb_scene_gl *scene);

/* Uploads the vertices that have changed since they were last: to be called between a new pose of
 * the scene and the first draw of it. IRB_E_MEMORY. */
bool irb_scene_gl_update(struct irb_scene_gl *scene, struct irb_error *err);

/* A program that draws the scene's surfaces, in two variants: `masked`, which is NULL until a scene
 * needs it, cuts away what alpha masks hide (frame/alpha_mask.glsl). */
struct irb_surface_program {
    struct irb_program_desc stages;      /* borrowed strings; no defines */
    struct irb_program *opaque, *masked; /* owned */
};

/* frame/geometry.vert and a fragment shader that includes frame/geometry.glsl. */
bool irb_surface_program_create(struct irb_surface_program *out, struct irb_gl *gl,
                                const char *name, const char *fragment, struct irb_error *err);
/* Any stages. The vertex shader has the attributes and the uniform `model` of frame/geometry.vert.
 * Strings are kept; `defines` is not for this. */
bool irb_surface_program_create_stages(struct irb_surface_program *out, struct irb_gl *gl,
                                       const struct irb_program_desc *stages,
                                       struct irb_error *err);
void irb_surface_program_destroy(struct irb_surface_program *program);
/* Makes the variants that the scene needs. */
bool irb_surface_program_prepare(struct irb_surface_program *program,
                                 const struct irb_scene_gl *scene, struct irb_error *err);

/* Draws every object's current pose. The program is prepared, and the caller has set the uniform
 * view_projection and the shader's own in both variants, the framebuffer and the depth state;
 * culling and blending are turned off here. Uses texture unit 0 and shader storage binding 0. */
void irb_scene_gl_draw(const struct irb_scene_gl *scene, const struct irb_surface_program *program);

/* The same as `instances` instances of every object, with the caller's blending. */
void irb_scene_gl_draw_instances(const struct irb_scene_gl *scene,
                                 const struct irb_surface_program *program, int instances);

#endif
