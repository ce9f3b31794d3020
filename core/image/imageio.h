/* SPDX-License-Identifier: MIT
 *
 * Images of other formats through OpenImageIO (the C++ behind these declarations is one thin
 * file). In a build without it (-Dimages=disabled) all functions fail with IRB_E_USAGE and say so.
 */
#ifndef IRB_IMAGE_IMAGEIO_H
#define IRB_IMAGE_IMAGEIO_H

#include "core/image/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes values in [0,1] (clamped) as an 8-bit PNG, with no colour conversion: pass sRGB values.
 * 1 or 3 channels; NaN becomes 0. Equal images give equal files (a fixed date is stored). */
bool irb_png_write(const char *path, const struct irb_image *image, struct irb_error *err);

/* The same as a baseline JPEG of `quality` 1 to 100, without subsampled colour. Equal images give
 * equal files. Written beside `path` and renamed into place. */
bool irb_jpeg_write(const char *path, const struct irb_image *image, int quality,
                    struct irb_error *err);

/* Encodes 8-bit RGBA (not premultiplied, row 0 at the top, as stored) as a PNG in memory; without
 * the alpha channel where it is 255 everywhere. `name` appears in messages. *data is malloc'ed.
 * Equal images give equal bytes. */
bool irb_png_encode(const char *name, const unsigned char *rgba, int width, int height,
                    unsigned char **data, size_t *size, struct irb_error *err);

/* Decodes an image file from memory (PNG, JPEG, WebP, ...) to RGBA, 8 bits a channel, row 0 at
 * the top, as stored (no colour conversion). `name` appears in messages. *rgba is malloc'ed. */
bool irb_image_decode(const char *name, const void *data, size_t size, int *width, int *height,
                      unsigned char **rgba, struct irb_error *err);

/* Reads any image file that OpenImageIO knows as linear float RGB: channels R, G, B where there are
 * such, else the first three, or the one there is; files marked as sRGB are linearised. */
bool irb_image_read_rgb(const char *path, struct irb_image *image, struct irb_error *err);

#ifdef __cplusplus
}
#endif

#endif
