/* SPDX-License-Identifier: MIT
 *
 * OpenGL objects with an owner and a size. Created objects are the caller's and end with their
 * destroy function (NULL is fine); bytes are counted in gl->bytes. All creation goes through direct
 * state access, so nothing is left bound.
 */
#ifndef IRB_GL_OBJECTS_H
#define IRB_GL_OBJECTS_H

#include "core/gl/context.h"
#include "core/image/image.h"

#include <stddef.h>

struct irb_texture_desc {
    const char *name; /* for messages and debug labels */
    unsigned format;  /* GL_RGBA32F, GL_R32UI, GL_DEPTH_COMPONENT32F, ...: those in format.c */
    int width, height;
    int layers;          /* 0: GL_TEXTURE_2D, else GL_TEXTURE_2D_ARRAY */
    int levels;          /* 0 means 1 */
    bool linear;         /* bilinear filter (trilinear with levels); else nearest */
    bool repeat;         /* wrap; else clamp to edge */
    bool shadow_compare; /* depth comparison (GL_LEQUAL) */
};

struct irb_texture {
    unsigned id, target, format;
    int width, height, layers, levels;
    int64_t bytes;     /* of all levels and layers, as the format is defined */
    struct irb_gl *gl; /* borrowed */
};

/* Contents are undefined. IRB_E_INPUT names a size beyond the driver's limits. */
struct irb_texture *irb_texture_create(struct irb_gl *gl, const struct irb_texture_desc *desc,
                                       struct irb_error *err);
void irb_texture_destroy(struct irb_texture *texture);
/* Level 0 to a float image with the given number of channels (1..4), rows flipped so that row 0 is
 * the top; the layers of an array one below the other. *image is created. Integer formats are not
 * for this, depth formats with 1 channel. */
bool irb_texture_read(const struct irb_texture *texture, int channels, struct irb_image *image,
                      struct irb_error *err);
/* Level 0 of a GL_R32UI texture as the floats whose bits its texels are (distances that atomics
 * compared), laid out as irb_texture_read does. *image is created with 1 channel. */
bool irb_texture_read_bits(const struct irb_texture *texture, struct irb_image *image,
                           struct irb_error *err);
/* Uploads a float image (row 0 = top, laid out as irb_texture_read gives it) into level 0. No
 * conversion to sRGB: values go into GL_SRGB8_ALPHA8 as they are. */
bool irb_texture_write(struct irb_texture *texture, const struct irb_image *image,
                       struct irb_error *err);

struct irb_buffer {
    unsigned id;
    int64_t bytes;
    struct irb_gl *gl; /* borrowed */
};

/* data may be NULL (contents undefined). For every target: uniform, storage, vertex, index. */
struct irb_buffer *irb_buffer_create(struct irb_gl *gl, const char *name, int64_t bytes,
                                     const void *data, struct irb_error *err);
void irb_buffer_destroy(struct irb_buffer *buffer);
/* Waits for shaders that write it. A range outside the buffer is an error. */
bool irb_buffer_read(const struct irb_buffer *buffer, int64_t offset, int64_t bytes, void *out,
                     struct irb_error *err);
bool irb_buffer_write(struct irb_buffer *buffer, int64_t offset, int64_t bytes, const void *data,
                      struct irb_error *err);

struct irb_framebuffer {
    unsigned id;
    int width, height;
    struct irb_gl *gl; /* borrowed */
};

/* Up to 8 colour textures (borrowed) and a depth texture (borrowed, may be NULL), level 0; all of
 * one size. Layered when the textures are arrays. Fails unless complete. */
struct irb_framebuffer *irb_framebuffer_create(struct irb_gl *gl, const char *name,
                                               struct irb_texture *const *colour, int colour_count,
                                               struct irb_texture *depth, struct irb_error *err);
void irb_framebuffer_destroy(struct irb_framebuffer *framebuffer);
/* Binds it and sets the viewport to its size. */
void irb_framebuffer_bind(const struct irb_framebuffer *framebuffer);

#endif
