/* SPDX-License-Identifier: MIT */
#include "core/gl/account.h"
#include "core/gl/format.h"
#include "core/gl/objects.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static int max_levels(int width, int height)
{
    int levels = 1;
    for (int size = width > height ? width : height; size > 1; size /= 2)
        levels++;
    return levels;
}

static bool check_desc(struct irb_gl *gl, const struct irb_texture_desc *desc,
                       const struct irb_format *format, struct irb_error *err)
{
    const char *name = irb_gl_name(desc->name, "texture");
    GLint size = 0, layers = 0;
    gl->api.GetIntegerv(GL_MAX_TEXTURE_SIZE, &size);
    gl->api.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    if (!format)
        return irb_fail(err, IRB_E_INTERNAL, "%s: texture format 0x%04x is not in format.c", name,
                        desc->format);
    if (desc->width < 1 || desc->height < 1 || desc->width > size || desc->height > size)
        return irb_fail(err, IRB_E_INPUT, "%s: expected a size of 1..%d, found %d x %d", name, size,
                        desc->width, desc->height);
    if (desc->layers < 0 || desc->layers > layers)
        return irb_fail(err, IRB_E_INPUT, "%s: expected 0..%d layers, found %d", name, layers,
                        desc->layers);
    int most = max_levels(desc->width, desc->height);
    if (desc->levels < 0 || desc->levels > most)
        return irb_fail(err, IRB_E_INPUT, "%s: expected 0..%d levels for %d x %d, found %d", name,
                        most, desc->width, desc->height, desc->levels);
    return true;
}

static int64_t count_bytes(const struct irb_texture *t, int texel)
{
    int64_t texels = 0;
    for (int level = 0; level < t->levels; level++) {
        int64_t width = t->width >> level, height = t->height >> level;
        texels += (width ? width : 1) * (height ? height : 1);
    }
    return texels * (t->layers ? t->layers : 1) * texel;
}

static void set_sampling(const struct irb_texture *t, const struct irb_texture_desc *desc)
{
    const struct irb_gl_api *api = &t->gl->api;
    GLint mag = desc->linear ? GL_LINEAR : GL_NEAREST, min = mag;
    if (t->levels > 1)
        min = desc->linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST;
    GLint wrap = desc->repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    api->TextureParameteri(t->id, GL_TEXTURE_MAG_FILTER, mag);
    api->TextureParameteri(t->id, GL_TEXTURE_MIN_FILTER, min);
    api->TextureParameteri(t->id, GL_TEXTURE_WRAP_S, wrap);
    api->TextureParameteri(t->id, GL_TEXTURE_WRAP_T, wrap);
    api->TextureParameteri(t->id, GL_TEXTURE_MAX_LEVEL, t->levels - 1);
    if (desc->shadow_compare) {
        api->TextureParameteri(t->id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        api->TextureParameteri(t->id, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
}

struct irb_texture *irb_texture_create(struct irb_gl *gl, const struct irb_texture_desc *desc,
                                       struct irb_error *err)
{
    const struct irb_format *format = irb_format_find(desc->format);
    const char *name = irb_gl_name(desc->name, "texture");
    if (!check_desc(gl, desc, format, err))
        return NULL;
    struct irb_texture *t = calloc(1, sizeof *t);
    if (!t) {
        irb_fail(err, IRB_E_MEMORY, "%s: out of memory", name);
        return NULL;
    }
    *t = (struct irb_texture){
        .target = desc->layers ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D,
        .format = desc->format,
        .width = desc->width,
        .height = desc->height,
        .layers = desc->layers,
        .levels = desc->levels ? desc->levels : 1,
        .gl = gl,
    };
    gl->api.CreateTextures(t->target, 1, &t->id);
    if (desc->layers)
        gl->api.TextureStorage3D(t->id, t->levels, t->format, t->width, t->height, t->layers);
    else
        gl->api.TextureStorage2D(t->id, t->levels, t->format, t->width, t->height);
    set_sampling(t, desc);
    gl->api.ObjectLabel(GL_TEXTURE, t->id, -1, name);
    if (!irb_gl_check(gl, name, err)) {
        irb_texture_destroy(t);
        return NULL;
    }
    t->bytes = count_bytes(t, format->bytes);
    irb_gl_account(gl, t->bytes);
    return t;
}

void irb_texture_destroy(struct irb_texture *texture)
{
    if (!texture)
        return;
    texture->gl->api.DeleteTextures(1, &texture->id);
    irb_gl_account(texture->gl, -texture->bytes);
    free(texture);
}

/* The label that creation gave the object, for messages. */
static void read_label(const struct irb_texture *texture, char name[128])
{
    texture->gl->api.GetObjectLabel(GL_TEXTURE, texture->id, 128, NULL, name);
}

/* The client format for a number of float channels, 0 where the texture has none such. */
static GLenum client_format(const struct irb_texture *texture, int channels)
{
    static const GLenum colour[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const struct irb_format *format = irb_format_find(texture->format);
    if (!format || channels < 1 || channels > 4)
        return 0;
    if (format->kind == IRB_FORMAT_COLOUR)
        return colour[channels - 1];
    return format->kind == IRB_FORMAT_DEPTH && channels == 1 ? GL_DEPTH_COMPONENT : 0;
}

static bool fail_exchange(const struct irb_texture *texture, int channels, struct irb_error *err)
{
    char name[128] = "";
    read_label(texture, name);
    const struct irb_format *format = irb_format_find(texture->format);
    return irb_fail(err, IRB_E_INTERNAL, "%s: %s cannot be exchanged as %d float channels", name,
                    format ? format->name : "an unknown format", channels);
}

/* Copies rows from OpenGL's order (row 0 at the bottom) to the image's, or back. */
static void flip_rows(float *to, const float *from, size_t row, int height)
{
    for (int y = 0; y < height; y++)
        memcpy(to + (size_t)(height - 1 - y) * row, from + (size_t)y * row, row * sizeof *to);
}

/* Level 0 in texels of `channels` times 4 bytes, which are copied as they are. */
static bool read_texels(const struct irb_texture *texture, GLenum client, GLenum type, int channels,
                        struct irb_image *image, struct irb_error *err)
{
    struct irb_gl *gl = texture->gl;
    int layers = texture->layers ? texture->layers : 1;
    size_t row = (size_t)texture->width * (size_t)channels;
    size_t layer = row * (size_t)texture->height;
    size_t bytes = layer * (size_t)layers * sizeof(float);
    if (bytes > INT_MAX || (int64_t)texture->height * layers > INT_MAX)
        return irb_fail(err, IRB_E_MEMORY, "a texture of %zu bytes is too large to read back",
                        bytes);
    float *pixels = malloc(bytes);
    if (!pixels)
        return irb_fail(err, IRB_E_MEMORY, "out of memory for a texture of %zu bytes", bytes);
    bool ok = irb_image_create(image, texture->width, texture->height * layers, channels, err);
    if (ok) {
        char name[128] = "";
        /* what shaders stored becomes visible to this read */
        gl->api.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        gl->api.GetTextureImage(texture->id, 0, client, type, (GLsizei)bytes, pixels);
        read_label(texture, name);
        ok = irb_gl_check(gl, name, err);
        for (int i = 0; ok && i < layers; i++)
            flip_rows(image->data + (size_t)i * layer, pixels + (size_t)i * layer, row,
                      texture->height);
        if (!ok)
            irb_image_destroy(image);
    }
    free(pixels);
    return ok;
}

bool irb_texture_read(const struct irb_texture *texture, int channels, struct irb_image *image,
                      struct irb_error *err)
{
    GLenum client = client_format(texture, channels);
    if (!client)
        return fail_exchange(texture, channels, err);
    return read_texels(texture, client, GL_FLOAT, channels, image, err);
}

bool irb_texture_read_bits(const struct irb_texture *texture, struct irb_image *image,
                           struct irb_error *err)
{
    if (texture->format != GL_R32UI)
        return fail_exchange(texture, 1, err);
    return read_texels(texture, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, image, err);
}

bool irb_texture_write(struct irb_texture *texture, const struct irb_image *image,
                       struct irb_error *err)
{
    struct irb_gl *gl = texture->gl;
    char name[128] = "";
    read_label(texture, name);
    GLenum client = client_format(texture, image->channels);
    if (!client)
        return fail_exchange(texture, image->channels, err);
    int layers = texture->layers ? texture->layers : 1;
    if (image->width != texture->width || image->height != texture->height * layers)
        return irb_fail(err, IRB_E_INTERNAL, "%s: expected an image of %d x %d, found %d x %d",
                        name, texture->width, texture->height * layers, image->width,
                        image->height);
    size_t row = (size_t)image->width * (size_t)image->channels;
    size_t layer = row * (size_t)texture->height;
    float *pixels = malloc(layer * (size_t)layers * sizeof *pixels);
    if (!pixels)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", name);
    for (int i = 0; i < layers; i++)
        flip_rows(pixels + (size_t)i * layer, image->data + (size_t)i * layer, row,
                  texture->height);
    if (texture->layers)
        gl->api.TextureSubImage3D(texture->id, 0, 0, 0, 0, texture->width, texture->height, layers,
                                  client, GL_FLOAT, pixels);
    else
        gl->api.TextureSubImage2D(texture->id, 0, 0, 0, texture->width, texture->height, client,
                                  GL_FLOAT, pixels);
    free(pixels);
    return irb_gl_check(gl, name, err);
}
