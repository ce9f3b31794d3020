/* SPDX-License-Identifier: MIT */
#include "core/experiment/debug_layers.h"
#include "core/frame/composite.h"
#include "core/gl/objects.h"
#include "core/image/imageio.h"

#include <GL/glcorearb.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const kind_names[] = {"colour", "radiance", "scalar", "distance"};
enum { KINDS = sizeof kind_names / sizeof *kind_names };

static const char count_attribute[] = "irbench:debug";

static int channels_of(enum irb_debug_kind kind)
{
    return kind == IRB_DEBUG_COLOUR || kind == IRB_DEBUG_RADIANCE ? 3 : 1;
}

static const char *suffixes_of(const struct irb_debug_layer *layer)
{
    return channels_of(layer->kind) == 3 ? "RGB" : "Y";
}

/* ---- from the method ---- */

/* Names become those of files and of EXR layers. */
static bool name_is_valid(const char *name)
{
    static const char allowed[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    size_t length = name ? strspn(name, allowed) : 0;
    return length > 0 && length < IRB_DEBUG_NAME_SIZE && !name[length];
}

static bool check_output(const struct irb_frame_output *output, struct irb_error *err)
{
    if (output->debug_count < 0 || output->debug_count > IRB_MAX_DEBUG_LAYERS)
        return irb_fail(err, IRB_E_INPUT, "expected at most %d debug layers, found %d",
                        IRB_MAX_DEBUG_LAYERS, output->debug_count);
    for (int i = 0; i < output->debug_count; i++) {
        const char *name = output->debug[i].name;
        if (!name_is_valid(name) || !output->debug[i].texture)
            return irb_fail(err, IRB_E_INPUT,
                            "expected a debug layer with a texture and a name of at most %d "
                            "letters, digits, '-' and '_', found '%.64s'",
                            IRB_DEBUG_NAME_SIZE - 1, name ? name : "");
        if ((unsigned)output->debug[i].kind >= KINDS)
            return irb_fail(err, IRB_E_INPUT, "debug layer '%s' is of no kind", name);
        for (int j = 0; j < i; j++)
            if (!strcmp(name, output->debug[j].name))
                return irb_fail(err, IRB_E_INPUT, "there are two debug layers called '%s'", name);
    }
    return true;
}

/* Floats whose bits are whole numbers become those numbers. */
static void count_bits(struct irb_image *image)
{
    for (size_t i = 0; i < irb_image_pixels(image); i++) {
        uint32_t bits;
        memcpy(&bits, &image->data[i], sizeof bits);
        image->data[i] = (float)bits;
    }
}

/* Keeps every k-th texel, from the upper left one on, where files have no room for all: no mean,
 * since distances and numbers of clusters have none. */
static bool thin_out(struct irb_image *image, struct irb_error *err)
{
    const int longest = image->width > image->height ? image->width : image->height;
    const int k = (longest + IRB_EXR_MAX_SIDE - 1) / IRB_EXR_MAX_SIDE;
    struct irb_image thin;
    if (k <= 1)
        return true;
    if (!irb_image_create(&thin, (image->width + k - 1) / k, (image->height + k - 1) / k,
                          image->channels, err)) {
        irb_image_destroy(image);
        return false;
    }
    for (int y = 0; y < thin.height; y++)
        for (int x = 0; x < thin.width; x++)
            memcpy(irb_image_at(&thin, x, y), irb_image_at(image, x * k, y * k),
                   (size_t)image->channels * sizeof(float));
    irb_image_destroy(image);
    *image = thin;
    return true;
}

static bool read_texels(struct irb_debug_layer *layer, const struct irb_texture *texture,
                        struct irb_error *err)
{
    if (texture->format != GL_R32UI)
        return irb_texture_read(texture, channels_of(layer->kind), &layer->image, err);
    if (channels_of(layer->kind) != 1)
        return irb_fail(err, IRB_E_INPUT, "GL_R32UI holds scalars or distances, not %s",
                        kind_names[layer->kind]);
    if (!irb_texture_read_bits(texture, &layer->image, err))
        return false;
    if (layer->kind == IRB_DEBUG_SCALAR)
        count_bits(&layer->image);
    return true;
}

static bool read_layer(struct irb_debug_layer *layer, const struct irb_texture *texture,
                       struct irb_error *err)
{
    return read_texels(layer, texture, err) && thin_out(&layer->image, err);
}

bool irb_debug_layers_read(struct irb_debug_layers *debug, const struct irb_frame_output *output,
                           struct irb_error *err)
{
    const struct irb_texture *frame = output->irradiance;
    *debug = (struct irb_debug_layers){0};
    if (!check_output(output, err))
        return false;
    for (int i = 0; i < output->debug_count; i++) {
        struct irb_debug_layer *layer = &debug->layers[debug->count++];
        snprintf(layer->name, sizeof layer->name, "%s", output->debug[i].name);
        layer->kind = output->debug[i].kind;
        if (!read_layer(layer, output->debug[i].texture, err)) {
            irb_error_prefix(err, "debug layer '%s'", layer->name);
            irb_debug_layers_destroy(debug);
            return false;
        }
        layer->apart = layer->image.width != frame->width || layer->image.height != frame->height;
    }
    return true;
}

void irb_debug_layers_destroy(struct irb_debug_layers *debug)
{
    for (int i = 0; i < debug->count; i++)
        irb_image_destroy(&debug->layers[i].image);
    *debug = (struct irb_debug_layers){0};
}

/* ---- files ---- */

void irb_debug_attributes(struct irb_debug_attributes *attributes,
                          const struct irb_debug_layers *debug)
{
    *attributes = (struct irb_debug_attributes){0};
    if (!debug->count)
        return;
    for (int i = 0; i <= debug->count; i++) {
        char *name = attributes->names[i], *value = attributes->values[i];
        const struct irb_debug_layer *layer = &debug->layers[i ? i - 1 : 0];
        if (i) {
            snprintf(name, sizeof *attributes->names, "%s_%d", count_attribute, i - 1);
            snprintf(value, sizeof *attributes->values, "%s %s %s", layer->apart ? "apart" : "here",
                     kind_names[layer->kind], layer->name);
        } else {
            snprintf(name, sizeof *attributes->names, "%s", count_attribute);
            snprintf(value, sizeof *attributes->values, "%d", debug->count);
        }
        attributes->list[i] = (struct irb_exr_attribute){name, value};
    }
    attributes->count = debug->count + 1;
}

int irb_debug_layers_append(const struct irb_debug_layers *debug, struct irb_exr_layer *layers,
                            irb_debug_layer_name names[IRB_MAX_DEBUG_LAYERS])
{
    int count = 0;
    for (int i = 0; i < debug->count; i++) {
        const struct irb_debug_layer *layer = &debug->layers[i];
        if (layer->apart)
            continue;
        snprintf(names[count], sizeof names[count], "debug.%s", layer->name);
        layers[count] = (struct irb_exr_layer){names[count], suffixes_of(layer), &layer->image};
        count++;
    }
    return count;
}

/* debug-NAME-0003.exr. Malloc'ed. */
static char *layer_path(const struct irb_frame_place *place, const struct irb_debug_layer *layer,
                        const char *extension)
{
    char stem[IRB_DEBUG_NAME_SIZE + 8];
    snprintf(stem, sizeof stem, "debug-%s", layer->name);
    return irb_frame_path(place, stem, extension);
}

bool irb_debug_layers_save_apart(const struct irb_debug_layers *debug,
                                 const struct irb_frame_place *place,
                                 const struct irb_exr_attribute *attributes, int attribute_count,
                                 struct irb_error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < debug->count; i++) {
        const struct irb_debug_layer *layer = &debug->layers[i];
        if (!layer->apart)
            continue;
        struct irb_exr_layer only = {"", suffixes_of(layer), &layer->image};
        char *path = layer_path(place, layer, "exr");
        ok = irb_exr_write(path, &only, 1, attributes, attribute_count, IRB_EXR_ZIP, err);
        free(path);
    }
    return ok;
}

/* "here scalar NAME" */
static bool parse_layer(const char *text, struct irb_debug_layer *layer)
{
    char where[8], kind[16], name[IRB_DEBUG_NAME_SIZE];
    _Static_assert(IRB_DEBUG_NAME_SIZE == 32, "the width below");
    if (sscanf(text, "%7s %15s %31s", where, kind, name) != 3 || !name_is_valid(name))
        return false;
    for (int k = 0; k < KINDS; k++) {
        if (strcmp(kind, kind_names[k]))
            continue;
        *layer = (struct irb_debug_layer){.kind = (enum irb_debug_kind)k,
                                          .apart = !strcmp(where, "apart")};
        memcpy(layer->name, name, sizeof name);
        return true;
    }
    return false;
}

/* Which layers a frame has, without their images. None where the file says nothing of them. */
static void list_layers(struct irb_debug_layers *debug, const char *path)
{
    struct irb_error ignored;
    struct irb_exr_value count = {.name = count_attribute};
    *debug = (struct irb_debug_layers){0};
    if (!irb_exr_read_attributes(path, &count, 1, &ignored))
        return;
    int expected = atoi(count.text);
    for (int i = 0; i < expected && i < IRB_MAX_DEBUG_LAYERS; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s_%d", count_attribute, i);
        struct irb_exr_value value = {.name = name};
        if (!irb_exr_read_attributes(path, &value, 1, &ignored) ||
            !parse_layer(value.text, &debug->layers[debug->count]))
            return;
        debug->count++;
    }
}

/* Those in the frame file, all at once. */
static bool load_here(struct irb_debug_layers *debug, const char *path, struct irb_error *err)
{
    struct irb_exr_layer layers[IRB_MAX_DEBUG_LAYERS];
    struct irb_image images[IRB_MAX_DEBUG_LAYERS];
    irb_debug_layer_name names[IRB_MAX_DEBUG_LAYERS];
    int count = irb_debug_layers_append(debug, layers, names);
    if (count && !irb_exr_read_layers(path, layers, images, count, err))
        return false;
    for (int i = 0, from = 0; i < debug->count; i++)
        if (!debug->layers[i].apart)
            debug->layers[i].image = images[from++];
    return true;
}

bool irb_debug_layers_load(struct irb_debug_layers *debug, const struct irb_frame_place *place,
                           struct irb_error *err)
{
    char *path = irb_frame_path(place, "frame", "exr");
    list_layers(debug, path);
    bool ok = load_here(debug, path, err);
    free(path);
    for (int i = 0; ok && i < debug->count; i++) {
        struct irb_debug_layer *layer = &debug->layers[i];
        if (!layer->apart)
            continue;
        path = layer_path(place, layer, "exr");
        ok = irb_exr_read(path, "", suffixes_of(layer), &layer->image, err);
        free(path);
    }
    if (!ok)
        irb_debug_layers_destroy(debug);
    return ok;
}

void irb_debug_layers_remove_apart(const struct irb_frame_place *place)
{
    struct irb_debug_layers debug;
    char *path = irb_frame_path(place, "frame", "exr");
    list_layers(&debug, path);
    free(path);
    for (int i = 0; i < debug.count; i++) {
        if (!debug.layers[i].apart)
            continue;
        path = layer_path(place, &debug.layers[i], "exr");
        unlink(path);
        free(path);
    }
}

/* ---- PNG ---- */

/* In units of the largest finite value; black where there is none above 0. */
static bool scale_to_largest(const struct irb_image *image, struct irb_image *out,
                             struct irb_error *err)
{
    float largest = 0;
    if (!irb_image_create(out, image->width, image->height, 1, err))
        return false;
    for (size_t i = 0; i < irb_image_pixels(image); i++)
        if (isfinite(image->data[i]) && image->data[i] > largest)
            largest = image->data[i];
    for (size_t i = 0; i < irb_image_pixels(image); i++)
        if (isfinite(image->data[i]) && image->data[i] > 0)
            out->data[i] = image->data[i] / largest;
    return true;
}

/* NaN is 0. */
static bool clamp_to_unit(const struct irb_image *image, struct irb_image *out,
                          struct irb_error *err)
{
    if (!irb_image_create(out, image->width, image->height, image->channels, err))
        return false;
    size_t values = irb_image_pixels(image) * (size_t)image->channels;
    for (size_t i = 0; i < values; i++) {
        float v = image->data[i] > 0 ? image->data[i] : 0;
        out->data[i] = v < 1 ? v : 1;
    }
    return true;
}

bool irb_debug_preview(const struct irb_debug_layer *layer, double exposure, struct irb_image *out,
                       struct irb_error *err)
{
    switch (layer->kind) {
    case IRB_DEBUG_COLOUR:
        return clamp_to_unit(&layer->image, out, err);
    case IRB_DEBUG_RADIANCE:
        return irb_tonemap(&layer->image, exposure, out, err);
    default:
        return scale_to_largest(&layer->image, out, err);
    }
}

bool irb_debug_layers_show(const struct irb_debug_layers *debug,
                           const struct irb_frame_place *place, double exposure,
                           struct irb_error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < debug->count; i++) {
        struct irb_image preview = {0};
        char *path = layer_path(place, &debug->layers[i], "png");
        ok = irb_debug_preview(&debug->layers[i], exposure, &preview, err) &&
             irb_png_write(path, &preview, err);
        irb_image_destroy(&preview);
        free(path);
    }
    return ok;
}
