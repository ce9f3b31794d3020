/* SPDX-License-Identifier: MIT */
#include "core/image/image.h"

#include <stdint.h>
#include <stdlib.h>

bool irb_image_create(struct irb_image *image, int width, int height, int channels,
                      struct irb_error *err)
{
    *image = (struct irb_image){0};
    if (width <= 0 || height <= 0 || channels < 1 || channels > 4)
        return irb_fail(
            err, IRB_E_INTERNAL,
            "image of %d x %d with %d channels: expected positive sizes, 1 to 4 channels", width,
            height, channels);
    /* 4 channels of float: the product cannot wrap below this. */
    if ((size_t)width > SIZE_MAX / sizeof(float) / 4 / (size_t)height)
        return irb_fail(err, IRB_E_MEMORY, "image of %d x %d: too large", width, height);
    size_t values = (size_t)width * (size_t)height * (size_t)channels;
    float *data = calloc(values, sizeof *data);
    if (!data)
        return irb_fail(err, IRB_E_MEMORY, "image of %d x %d with %d channels: out of memory",
                        width, height, channels);
    *image = (struct irb_image){width, height, channels, data};
    return true;
}

void irb_image_destroy(struct irb_image *image)
{
    free(image->data);
    *image = (struct irb_image){0};
}
