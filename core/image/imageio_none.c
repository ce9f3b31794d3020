/* SPDX-License-Identifier: MIT
 *
 * imageio.h in a build without OpenImageIO.
 */
#include "core/image/imageio.h"

static bool absent(const char *name, struct irb_error *err)
{
    return irb_fail(err, IRB_E_USAGE,
                    "%s: this build reads and writes EXR only; install libopenimageio-dev and "
                    "configure with -Dimages=enabled",
                    name);
}

bool irb_png_write(const char *path, const struct irb_image *image, struct irb_error *err)
{
    (void)image;
    return absent(path, err);
}

bool irb_jpeg_write(const char *path, const struct irb_image *image, int quality,
                    struct irb_error *err)
{
    (void)image, (void)quality;
    return absent(path, err);
}

bool irb_png_encode(const char *name, const unsigned char *rgba, int width, int height,
                    unsigned char **data, size_t *size, struct irb_error *err)
{
    (void)rgba, (void)width, (void)height, (void)data, (void)size;
    return absent(name, err);
}

bool irb_image_decode(const char *name, const void *data, size_t size, int *width, int *height,
                      unsigned char **rgba, struct irb_error *err)
{
    (void)data, (void)size, (void)width, (void)height, (void)rgba;
    return absent(name, err);
}

bool irb_image_read_rgb(const char *path, struct irb_image *image, struct irb_error *err)
{
    *image = (struct irb_image){0};
    return absent(path, err);
}
