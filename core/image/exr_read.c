/* SPDX-License-Identifier: MIT */
#include "core/image/exr_stream.h"

#include "core/base/fs.h"

#include <stdlib.h>
#include <string.h>

enum {
    /* A file above this is no image of ours (bytes). */
    MAX_FILE_SIZE = 2000000000,
    /* Deflate cannot pack more than this many bytes into one (zlib's technical notes). */
    MAX_ZIP_RATIO = 1032,
};

struct reader {
    const char *path;
    struct irb_exr_stream stream;
    exr_context_t context;
    exr_decode_pipeline_t pipeline;
    bool pipeline_ready;
    const struct irb_exr_layer *layers;
    struct irb_image *images;
    int layer_count;
    int width, height, first_line;
    /* For each channel of the file: the layer that wants it, or -1, and the place there. */
    int *layer_of, *place_of;
    int channel_count;
    struct irb_error *err;
};

static bool failed(struct reader *r, exr_result_t result)
{
    return irb_exr_fail(r->err, IRB_E_INPUT, r->path, &r->stream, result);
}

static bool open_file(struct reader *r)
{
    char *data = NULL;
    size_t size = 0;
    if (!irb_fs_read(r->path, MAX_FILE_SIZE, &data, &size, r->err))
        return false;
    r->stream.data = (unsigned char *)data;
    r->stream.size = r->stream.capacity = size;
    /* Magic number of the format (OpenEXR File Layout). */
    if (size < 4 || memcmp(data, "\x76\x2f\x31\x01", 4))
        return irb_fail(r->err, IRB_E_INPUT, "%s: expected an OpenEXR file, found something else",
                        r->path);
    exr_context_initializer_t settings = irb_exr_context_settings(&r->stream);
    exr_result_t result = exr_start_read(&r->context, r->path, &settings);
    return result == EXR_ERR_SUCCESS || failed(r, result);
}

static bool check_kind(struct reader *r)
{
    exr_storage_t storage;
    exr_result_t result = exr_get_storage(r->context, 0, &storage);
    if (result != EXR_ERR_SUCCESS)
        return failed(r, result);
    if (storage != EXR_STORAGE_SCANLINE)
        return irb_fail(r->err, IRB_E_INPUT,
                        "%s: expected an EXR of scanlines, found tiles or deep data", r->path);
    return true;
}

/* Bytes that all channels take once unpacked, as far as a damaged header can be believed. */
static uint64_t unpacked_size(const struct reader *r, const exr_attr_chlist_t *channels)
{
    uint64_t pixel = 0;
    for (int i = 0; i < channels->num_channels; i++)
        pixel += channels->entries[i].pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    return pixel * (uint64_t)r->width * (uint64_t)r->height;
}

static bool check_size(struct reader *r, const exr_attr_chlist_t *channels)
{
    exr_attr_box2i_t window;
    exr_compression_t compression;
    exr_result_t result = exr_get_data_window(r->context, 0, &window);
    if (result == EXR_ERR_SUCCESS)
        result = exr_get_compression(r->context, 0, &compression);
    if (result != EXR_ERR_SUCCESS)
        return failed(r, result);
    int64_t width = (int64_t)window.max.x - window.min.x + 1;
    int64_t height = (int64_t)window.max.y - window.min.y + 1;
    if (width < 1 || height < 1 || width > IRB_EXR_MAX_SIDE || height > IRB_EXR_MAX_SIDE)
        return irb_fail(r->err, IRB_E_INPUT,
                        "%s: expected 1 to %d pixels a side, found %lld x %lld", r->path,
                        IRB_EXR_MAX_SIDE, (long long)width, (long long)height);
    r->width = (int)width;
    r->height = (int)height;
    r->first_line = window.min.y;
    uint64_t unpacked = unpacked_size(r, channels);
    bool plain = compression == EXR_COMPRESSION_NONE;
    bool zip = compression == EXR_COMPRESSION_ZIP || compression == EXR_COMPRESSION_ZIPS;
    if ((plain && unpacked > r->stream.size) || (zip && unpacked / MAX_ZIP_RATIO > r->stream.size))
        return irb_fail(r->err, IRB_E_INPUT,
                        "%s: truncated or damaged: %d x %d pixels of %d channels cannot be in %llu "
                        "bytes",
                        r->path, r->width, r->height, channels->num_channels,
                        (unsigned long long)r->stream.size);
    return true;
}

static bool check_channel(struct reader *r, const exr_attr_chlist_entry_t *entry)
{
    if (entry->x_sampling != 1 || entry->y_sampling != 1)
        return irb_fail(r->err, IRB_E_INPUT, "%s: channel '%s' is subsampled, expected 1 x 1",
                        r->path, entry->name.str);
    if (entry->pixel_type != EXR_PIXEL_HALF && entry->pixel_type != EXR_PIXEL_FLOAT)
        return irb_fail(r->err, IRB_E_INPUT,
                        "%s: channel '%s' holds integers, expected half or float", r->path,
                        entry->name.str);
    return true;
}

static int find_channel(const exr_attr_chlist_t *channels, const char *name)
{
    for (int i = 0; i < channels->num_channels; i++)
        if (!strcmp(channels->entries[i].name.str, name))
            return i;
    return -1;
}

static bool match_layer(struct reader *r, const exr_attr_chlist_t *channels, int layer)
{
    const struct irb_exr_layer *wanted = &r->layers[layer];
    for (int c = 0; wanted->suffixes[c]; c++) {
        char name[IRB_EXR_NAME_SIZE];
        int index = -1;
        if (irb_exr_channel_name(name, wanted->name, wanted->suffixes[c]))
            index = find_channel(channels, name);
        if (index < 0)
            return irb_fail(r->err, IRB_E_INPUT, "%s: expected a channel '%s', found none", r->path,
                            name);
        if (!check_channel(r, &channels->entries[index]))
            return false;
        if (r->layer_of[index] >= 0)
            return irb_fail(r->err, IRB_E_INTERNAL, "%s: channel '%s' is asked for twice", r->path,
                            name);
        r->layer_of[index] = layer;
        r->place_of[index] = c;
    }
    return irb_image_create(&r->images[layer], r->width, r->height, (int)strlen(wanted->suffixes),
                            r->err) ||
           irb_error_prefix(r->err, "%s", r->path);
}

static bool match_layers(struct reader *r)
{
    const exr_attr_chlist_t *channels = NULL;
    exr_result_t result = exr_get_channels(r->context, 0, &channels);
    if (result != EXR_ERR_SUCCESS)
        return failed(r, result);
    if (!check_size(r, channels))
        return false;
    r->channel_count = channels->num_channels;
    r->layer_of = calloc((size_t)r->channel_count + 1, sizeof *r->layer_of);
    r->place_of = calloc((size_t)r->channel_count + 1, sizeof *r->place_of);
    if (!r->layer_of || !r->place_of)
        return irb_fail(r->err, IRB_E_MEMORY, "%s: out of memory", r->path);
    for (int i = 0; i < r->channel_count; i++)
        r->layer_of[i] = -1;
    for (int i = 0; i < r->layer_count; i++)
        if (!match_layer(r, channels, i))
            return false;
    return true;
}

/* Channels that nobody wants stay NULL: the library skips them. */
static bool point_at_images(struct reader *r, int row)
{
    if (r->pipeline.channel_count != r->channel_count)
        return irb_fail(r->err, IRB_E_INPUT, "%s: %d channels in the header, %d in a chunk",
                        r->path, r->channel_count, (int)r->pipeline.channel_count);
    for (int i = 0; i < r->channel_count; i++) {
        exr_coding_channel_info_t *info = &r->pipeline.channels[i];
        info->decode_to_ptr = NULL;
        if (r->layer_of[i] < 0)
            continue;
        struct irb_image *image = &r->images[r->layer_of[i]];
        info->user_bytes_per_element = sizeof(float);
        info->user_data_type = EXR_PIXEL_FLOAT;
        info->user_pixel_stride = image->channels * (int)sizeof(float);
        info->user_line_stride = r->width * image->channels * (int)sizeof(float);
        info->decode_to_ptr = (uint8_t *)(irb_image_at(image, 0, row) + r->place_of[i]);
    }
    return true;
}

static bool read_chunk(struct reader *r, int row, int lines)
{
    exr_chunk_info_t chunk;
    exr_result_t result = exr_read_scanline_chunk_info(r->context, 0, r->first_line + row, &chunk);
    if (result != EXR_ERR_SUCCESS)
        return failed(r, result);
    int expected = r->height - row < lines ? r->height - row : lines;
    if (chunk.height != expected || chunk.width != r->width || chunk.start_y != r->first_line + row)
        return irb_fail(r->err, IRB_E_INPUT, "%s: damaged: line %d has a chunk of another size",
                        r->path, row);
    result = r->pipeline_ready ? exr_decoding_update(r->context, 0, &chunk, &r->pipeline)
                               : exr_decoding_initialize(r->context, 0, &chunk, &r->pipeline);
    if (result != EXR_ERR_SUCCESS)
        return failed(r, result);
    bool first = !r->pipeline_ready;
    r->pipeline_ready = true;
    if (!point_at_images(r, row))
        return false;
    if (first)
        result = exr_decoding_choose_default_routines(r->context, 0, &r->pipeline);
    if (result == EXR_ERR_SUCCESS)
        result = exr_decoding_run(r->context, 0, &r->pipeline);
    return result == EXR_ERR_SUCCESS || failed(r, result);
}

static bool read_pixels(struct reader *r)
{
    int32_t lines = 0;
    exr_result_t result = exr_get_scanlines_per_chunk(r->context, 0, &lines);
    if (result != EXR_ERR_SUCCESS || lines < 1)
        return failed(r, result);
    for (int row = 0; row < r->height; row += lines)
        if (!read_chunk(r, row, lines))
            return false;
    return true;
}

bool irb_exr_read_layers(const char *path, const struct irb_exr_layer *layers,
                         struct irb_image *images, int layer_count, struct irb_error *err)
{
    struct reader r = {
        .path = path, .layers = layers, .images = images, .layer_count = layer_count, .err = err};
    for (int i = 0; i < layer_count; i++)
        images[i] = (struct irb_image){0};
    bool ok = open_file(&r) && check_kind(&r) && match_layers(&r) && read_pixels(&r);
    if (r.pipeline_ready)
        exr_decoding_destroy(r.context, &r.pipeline);
    if (r.context)
        exr_finish(&r.context);
    for (int i = 0; !ok && i < layer_count; i++)
        irb_image_destroy(&images[i]);
    free(r.layer_of);
    free(r.place_of);
    free(r.stream.data);
    return ok;
}

bool irb_exr_read(const char *path, const char *layer, const char *suffixes,
                  struct irb_image *image, struct irb_error *err)
{
    struct irb_exr_layer wanted = {.name = layer, .suffixes = suffixes};
    return irb_exr_read_layers(path, &wanted, image, 1, err);
}

static bool read_value(struct reader *r, struct irb_exr_value *value)
{
    int32_t length = 0;
    const char *text = NULL;
    exr_result_t result = exr_attr_get_string(r->context, 0, value->name, &length, &text);
    if (result != EXR_ERR_SUCCESS || !text)
        return irb_fail(r->err, IRB_E_INPUT, "%s: expected a string attribute '%s', found none",
                        r->path, value->name);
    if (length < 0 || (size_t)length >= sizeof value->text)
        return irb_fail(r->err, IRB_E_INPUT,
                        "%s: attribute '%s': expected fewer than %zu bytes, found %d", r->path,
                        value->name, sizeof value->text, (int)length);
    memcpy(value->text, text, (size_t)length);
    value->text[length] = 0;
    return true;
}

bool irb_exr_read_attributes(const char *path, struct irb_exr_value *values, int count,
                             struct irb_error *err)
{
    struct reader r = {.path = path, .err = err};
    bool ok = open_file(&r);
    for (int i = 0; ok && i < count; i++)
        ok = read_value(&r, &values[i]);
    if (r.context)
        exr_finish(&r.context);
    free(r.stream.data);
    return ok;
}
