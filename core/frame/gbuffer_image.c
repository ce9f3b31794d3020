/* SPDX-License-Identifier: MIT */
#include "core/frame/gbuffer_image.h"

#include "core/image/exr.h"

#include <string.h>

enum { LAYERS = 5 };

/* Name and channels of each layer, in the order of layer_of(). */
static const struct {
    const char *name, *suffixes;
} layer_table[LAYERS] = {
    {"position", "XYZA"}, {"normal", "XYZD"},   {"geometric", "XYZ"},
    {"diffuse", "RGB"},   {"specular", "RGBA"},
};

static struct irb_image *layer_of(struct irb_gbuffer_image *image, int layer)
{
    struct irb_image *const layers[LAYERS] = {&image->position, &image->normal, &image->geometric,
                                              &image->diffuse, &image->specular};
    return layers[layer];
}

static const struct irb_image *const_layer_of(const struct irb_gbuffer_image *image, int layer)
{
    const struct irb_image *const layers[LAYERS] = {
        &image->position, &image->normal, &image->geometric, &image->diffuse, &image->specular};
    return layers[layer];
}

bool irb_gbuffer_image_create(struct irb_gbuffer_image *image, int width, int height,
                              struct irb_error *err)
{
    *image = (struct irb_gbuffer_image){.width = width, .height = height};
    for (int i = 0; i < LAYERS; i++)
        if (!irb_image_create(layer_of(image, i), width, height,
                              (int)strlen(layer_table[i].suffixes), err)) {
            irb_gbuffer_image_destroy(image);
            return irb_error_prefix(err, "G-buffer image, layer '%s'", layer_table[i].name);
        }
    return true;
}

void irb_gbuffer_image_destroy(struct irb_gbuffer_image *image)
{
    if (!image)
        return;
    for (int i = 0; i < LAYERS; i++)
        irb_image_destroy(layer_of(image, i));
    *image = (struct irb_gbuffer_image){0};
}

struct irb_key irb_gbuffer_image_key(const struct irb_gbuffer_image *image)
{
    struct irb_hash *hash = irb_hash_create();
    irb_hash_u64(hash, (uint64_t)image->width);
    irb_hash_u64(hash, (uint64_t)image->height);
    for (int i = 0; i < LAYERS; i++) {
        const struct irb_image *layer = const_layer_of(image, i);
        irb_hash_floats(hash, layer->data, irb_image_pixels(layer) * (size_t)layer->channels);
    }
    return irb_hash_finish(hash);
}

bool irb_gbuffer_image_save(const struct irb_gbuffer_image *image, const char *path,
                            struct irb_error *err)
{
    struct irb_exr_layer layers[LAYERS];
    for (int i = 0; i < LAYERS; i++)
        layers[i] = (struct irb_exr_layer){layer_table[i].name, layer_table[i].suffixes,
                                           const_layer_of(image, i)};
    return irb_exr_write(path, layers, LAYERS, NULL, 0, IRB_EXR_ZIP, err);
}

bool irb_gbuffer_image_load(struct irb_gbuffer_image *image, const char *path,
                            struct irb_error *err)
{
    struct irb_exr_layer layers[LAYERS];
    struct irb_image images[LAYERS];
    for (int i = 0; i < LAYERS; i++)
        layers[i] = (struct irb_exr_layer){layer_table[i].name, layer_table[i].suffixes, NULL};
    *image = (struct irb_gbuffer_image){0};
    if (!irb_exr_read_layers(path, layers, images, LAYERS, err))
        return false;
    for (int i = 0; i < LAYERS; i++)
        *layer_of(image, i) = images[i];
    image->width = image->position.width;
    image->height = image->position.height;
    return true;
}
