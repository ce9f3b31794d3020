/* SPDX-License-Identifier: MIT
 *
 * A float image: width x height pixels of 1 to 4 interleaved channels, row 0 at the top, linear.
 */
#ifndef IRB_IMAGE_IMAGE_H
#define IRB_IMAGE_IMAGE_H

#include "core/base/error.h"

#include <stddef.h>

struct irb_image {
    int width, height, channels;
    float *data; /* owned; width*height*channels */
};

/* Zero-filled. IRB_E_MEMORY on failure; sizes must be positive and channels in 1..4. */
bool irb_image_create(struct irb_image *image, int width, int height, int channels,
                      struct irb_error *err);
/* Frees the pixels and zeroes the struct; a zeroed image is fine. */
void irb_image_destroy(struct irb_image *image);

static inline size_t irb_image_pixels(const struct irb_image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

static inline float *irb_image_at(const struct irb_image *image, int x, int y)
{
    return image->data + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels;
}

#endif
