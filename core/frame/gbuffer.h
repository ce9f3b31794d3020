/* SPDX-License-Identifier: MIT
 *
 * The camera's G-buffer in full precision (all 32-bit float; thesis 5.1.1 without its packing).
 */
#ifndef IRB_FRAME_GBUFFER_H
#define IRB_FRAME_GBUFFER_H

#include "core/frame/gbuffer_image.h"
#include "core/frame/scene_gl.h"
#include "core/scene/light.h"

struct irb_gbuffer {
    int width, height;
    struct irb_texture
        *position;              /* RGBA32F: world position (m), 1 where there is geometry, else 0 */
    struct irb_texture *normal; /* RGBA32F: unit shading normal on the side that is seen; linear
                                   Euclidean distance to the camera (m) in w */
    struct irb_texture *geometric; /* RGBA32F: unit normal of the triangle, same side; 0 */
    struct irb_texture *diffuse;   /* RGBA32F: k_d; 0 */
    struct irb_texture *specular;  /* RGBA32F: k_s; exponent alpha */
    struct irb_texture *depth;     /* DEPTH_COMPONENT32F, the rasteriser's own */
    struct irb_framebuffer *framebuffer;
    struct irb_program *program;
    struct irb_gl *gl; /* borrowed */
};

struct irb_gbuffer *irb_gbuffer_create(struct irb_gl *gl, int width, int height,
                                       struct irb_error *err);
void irb_gbuffer_destroy(struct irb_gbuffer *gbuffer);
bool irb_gbuffer_render(struct irb_gbuffer *gbuffer, const struct irb_scene_gl *scene,
                        const struct irb_camera *camera, struct irb_error *err);

/* Reads all layers back; *out is created. */
bool irb_gbuffer_read(const struct irb_gbuffer *gbuffer, struct irb_gbuffer_image *out,
                      struct irb_error *err);

#endif
