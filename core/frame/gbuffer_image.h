/* SPDX-License-Identifier: MIT
 *
 * The camera's G-buffer in main memory: what the reference shades and what scores mask by. Needs
 * no OpenGL; core/frame/gbuffer.h renders and reads it back.
 */
#ifndef IRB_FRAME_GBUFFER_IMAGE_H
#define IRB_FRAME_GBUFFER_IMAGE_H

#include "core/base/hash.h"
#include "core/image/image.h"

/* Row 0 = top. Where coverage is 0 every value is 0. The image owns its five layers. */
struct irb_gbuffer_image {
    int width, height;
    struct irb_image position;  /* 4: world position (m); coverage 0 or 1 */
    struct irb_image normal;    /* 4: unit shading normal on the side that is seen; Euclidean
                                   distance to the camera (m) */
    struct irb_image geometric; /* 3: unit normal of the triangle, same side */
    struct irb_image diffuse;   /* 3: k_d */
    struct irb_image specular;  /* 4: k_s; exponent alpha */
};

/* Creates the five layers, all zero. On failure nothing is left. */
bool irb_gbuffer_image_create(struct irb_gbuffer_image *image, int width, int height,
                              struct irb_error *err);
/* Frees the layers and zeroes the struct; a zeroed image is fine. */
void irb_gbuffer_image_destroy(struct irb_gbuffer_image *image);

/* Content hash of size and all layers. */
struct irb_key irb_gbuffer_image_key(const struct irb_gbuffer_image *image);

/* One multi-layer EXR, lossless: position.XYZA, normal.XYZD, geometric.XYZ, diffuse.RGB,
 * specular.RGBA. Load creates *image; on failure nothing is left. */
bool irb_gbuffer_image_save(const struct irb_gbuffer_image *image, const char *path,
                            struct irb_error *err);
bool irb_gbuffer_image_load(struct irb_gbuffer_image *image, const char *path,
                            struct irb_error *err);

/* Whether the pixel shows geometry. */
static inline bool irb_gbuffer_image_covered(const struct irb_gbuffer_image *image, size_t pixel)
{
    return image->position.data[4 * pixel + 3] > 0;
}

#endif
