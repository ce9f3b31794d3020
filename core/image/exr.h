/* SPDX-License-Identifier: MIT
 *
 * Multi-layer OpenEXR through OpenEXRCore. A layer "indirect" with the suffixes "RGB" is stored as
 * the channels indirect.R, indirect.G, indirect.B; the layer "" as plain R, G, B (what a viewer
 * shows first). One part, scanlines. Readable by tev, OpenImageIO and Blender.
 *
 * Does not: read tiles, deep data, further parts, subsampled or integer channels (imageio.h does).
 */
#ifndef IRB_IMAGE_EXR_H
#define IRB_IMAGE_EXR_H

#include "core/image/image.h"

struct irb_exr_layer {
    const char *name;              /* "" for the default layer */
    const char *suffixes;          /* one letter a channel: "RGB", "XYZ", "Y", "Z", "RGBA" */
    const struct irb_image *image; /* borrowed; as many channels as suffixes; one size for all */
};

/* String attributes: provenance. */
struct irb_exr_attribute {
    const char *name, *value;
};

enum irb_exr_compression { IRB_EXR_NONE, IRB_EXR_ZIP };

enum {
    IRB_EXR_MAX_SIDE = 16384, /* pixels; larger sizes are refused as damage, writing and reading */
    IRB_EXR_MAX_CHANNELS = 128, /* that one call writes or reads */
};

/* 32-bit float channels; written beside `path` and renamed into place. IRB_E_IO on failure. Equal
 * inputs give equal files. */
bool irb_exr_write(const char *path, const struct irb_exr_layer *layers, int layer_count,
                   const struct irb_exr_attribute *attributes, int attribute_count,
                   enum irb_exr_compression compression, struct irb_error *err);

/* Reads one layer (half or float channels; all of `suffixes` must be there). *image is created.
 * IRB_E_INPUT names the file and the missing channel, or what is wrong with the file. */
bool irb_exr_read(const char *path, const char *layer, const char *suffixes,
                  struct irb_image *image, struct irb_error *err);

/* Reads several layers of one file at once; images[i] is created for layers[i] (whose `image`
 * member is ignored). On failure none is left. */
bool irb_exr_read_layers(const char *path, const struct irb_exr_layer *layers,
                         struct irb_image *images, int layer_count, struct irb_error *err);

/* A string attribute that is asked for by name. */
struct irb_exr_value {
    const char *name;
    char text[128]; /* filled in; zero-terminated */
};

/* Reads string attributes of a file's header. IRB_E_INPUT names the file and the attribute that is
 * missing, no string, or too long. */
bool irb_exr_read_attributes(const char *path, struct irb_exr_value *values, int count,
                             struct irb_error *err);

#endif
