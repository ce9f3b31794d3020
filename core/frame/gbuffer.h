/* SPDX-License-Identifier: MIT
 *
 * The camera's G-buffer, in full precision (all 32-bit float; thesis 5.1.1 without its packing) or
 * in the thesis's slim layout. The reference, the direct light and the masks use the full one only;
 * methods are given either, and read both through irb_gbuffer_bind().
 */
#ifndef IRB_FRAME_GBUFFER_H
#define IRB_FRAME_GBUFFER_H

#include "core/frame/gbuffer_image.h"
#include "core/frame/layout.h"
#include "core/frame/scene_gl.h"
#include "core/scene/light.h"

struct irb_gbuffer {
    int width, height;
    enum irb_layout layout;
    /* full | slim, where the layers differ */
    struct irb_texture *position;  /* RGBA32F: world position (m), 1 where there is geometry, else 0
                                      |  NULL */
    struct irb_texture *normal;    /* RGBA32F: unit shading normal on the side that is seen; linear
                                      Euclidean distance to the camera (m) in w | RG16: spheremap of
                                      the normal in view space */
    struct irb_texture *geometric; /* RGBA32F: unit normal of the triangle, same side; 0 | NULL */
    struct irb_texture *diffuse;   /* RGBA32F: k_d; 0 | RGBA8 */
    struct irb_texture *specular;  /* RGBA32F: k_s; exponent alpha | RGBA8: k_s; log of alpha */
    struct irb_texture *depth;     /* DEPTH_COMPONENT32F, the rasteriser's own */
    struct irb_framebuffer *framebuffer;
    struct irb_surface_program program;
    /* of the last render; the slim layout's positions and normals are decoded with them */
    float camera_position[3], right[3], up[3], back[3]; /* world; unit */
    float tangent[2];    /* of half the field of view, across and up */
    float z_near, z_far; /* m */
    struct irb_gl *gl;   /* borrowed */
};

/* In full precision. */
struct irb_gbuffer *irb_gbuffer_create(struct irb_gl *gl, int width, int height,
                                       struct irb_error *err);
struct irb_gbuffer *irb_gbuffer_create_layout(struct irb_gl *gl, enum irb_layout layout, int width,
                                              int height, struct irb_error *err);
void irb_gbuffer_destroy(struct irb_gbuffer *gbuffer);
bool irb_gbuffer_render(struct irb_gbuffer *gbuffer, const struct irb_scene_gl *scene,
                        const struct irb_camera *camera, struct irb_error *err);

/* Memory of a pixel, bytes, its depth included: 84 full, 16 slim. */
int irb_gbuffer_pixel_bytes(const struct irb_gbuffer *gbuffer);

/* The define that a shader which includes frame/gbuffer_fetch.glsl is compiled with. */
const char *irb_gbuffer_define(enum irb_layout layout);

/* Binds the layers to texture units first_unit.. and sets the uniforms of
 * frame/gbuffer_fetch.glsl; returns the first unit after them (at most 5 are used). */
int irb_gbuffer_bind(const struct irb_gbuffer *gbuffer, const struct irb_program *program,
                     int first_unit);

/* Reads all layers back, of the full layout only (IRB_E_INTERNAL for the slim one); *out is
 * created. */
bool irb_gbuffer_read(const struct irb_gbuffer *gbuffer, struct irb_gbuffer_image *out,
                      struct irb_error *err);

#endif
