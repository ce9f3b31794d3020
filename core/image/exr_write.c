/* SPDX-License-Identifier: MIT */
#include "core/image/exr_stream.h"

#include "core/base/fs.h"

#include <stdlib.h>
#include <string.h>

/* Where a channel of the file comes from. */
struct source {
    char name[IRB_EXR_NAME_SIZE];
    const struct irb_image *image;
    int channel;
};

struct writer {
    const char *path;
    struct irb_exr_stream stream;
    exr_context_t context;
    exr_encode_pipeline_t pipeline;
    bool pipeline_ready;
    struct source *sources; /* in the order in which the format wants them: by name */
    int source_count;
    int width, height;
    struct irb_error *err;
};

static bool failed(struct writer *w, exr_result_t result)
{
    return irb_exr_fail(w->err, IRB_E_IO, w->path, &w->stream, result);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct source *)a)->name, ((const struct source *)b)->name);
}

static bool check_layer(struct writer *w, const struct irb_exr_layer *layer)
{
    const struct irb_image *image = layer->image;
    if ((int)strlen(layer->suffixes) != image->channels)
        return irb_fail(w->err, IRB_E_INTERNAL,
                        "%s: layer '%s': %d channels cannot be named \"%s\"", w->path, layer->name,
                        image->channels, layer->suffixes);
    if (image->width != w->width || image->height != w->height)
        return irb_fail(w->err, IRB_E_INTERNAL, "%s: layer '%s': expected %d x %d, found %d x %d",
                        w->path, layer->name, w->width, w->height, image->width, image->height);
    return true;
}

static bool collect_sources(struct writer *w, const struct irb_exr_layer *layers, int layer_count)
{
    w->sources = calloc(IRB_EXR_MAX_CHANNELS, sizeof *w->sources);
    if (!w->sources)
        return irb_fail(w->err, IRB_E_MEMORY, "%s: out of memory", w->path);
    for (int i = 0; i < layer_count; i++) {
        if (!check_layer(w, &layers[i]))
            return false;
        for (int c = 0; layers[i].suffixes[c]; c++) {
            if (w->source_count == IRB_EXR_MAX_CHANNELS)
                return irb_fail(w->err, IRB_E_INTERNAL, "%s: more than %d channels", w->path,
                                IRB_EXR_MAX_CHANNELS);
            struct source *source = &w->sources[w->source_count++];
            source->image = layers[i].image;
            source->channel = c;
            if (!irb_exr_channel_name(source->name, layers[i].name, layers[i].suffixes[c]))
                return irb_fail(w->err, IRB_E_INTERNAL, "%s: layer name too long: '%s'", w->path,
                                layers[i].name);
        }
    }
    qsort(w->sources, (size_t)w->source_count, sizeof *w->sources, by_name);
    for (int i = 1; i < w->source_count; i++)
        if (!strcmp(w->sources[i - 1].name, w->sources[i].name))
            return irb_fail(w->err, IRB_E_INTERNAL, "%s: two channels are called '%s'", w->path,
                            w->sources[i].name);
    return true;
}

/* Names above 31 bytes need a flag in the file. */
static bool needs_long_names(const struct writer *w, const struct irb_exr_attribute *attributes,
                             int count)
{
    for (int i = 0; i < w->source_count; i++)
        if (strlen(w->sources[i].name) > 31)
            return true;
    for (int i = 0; i < count; i++)
        if (strlen(attributes[i].name) > 31)
            return true;
    return false;
}

static bool write_header(struct writer *w, const struct irb_exr_attribute *attributes,
                         int attribute_count, enum irb_exr_compression compression)
{
    exr_context_initializer_t settings = irb_exr_context_settings(&w->stream);
    exr_result_t r = exr_start_write(&w->context, w->path, EXR_WRITE_FILE_DIRECTLY, &settings);
    if (r == EXR_ERR_SUCCESS && needs_long_names(w, attributes, attribute_count))
        r = exr_set_longname_support(w->context, 1);
    int part = 0;
    if (r == EXR_ERR_SUCCESS)
        r = exr_add_part(w->context, NULL, EXR_STORAGE_SCANLINE, &part);
    if (r == EXR_ERR_SUCCESS)
        r = exr_initialize_required_attr_simple(w->context, part, w->width, w->height,
                                                compression == IRB_EXR_ZIP ? EXR_COMPRESSION_ZIP
                                                                           : EXR_COMPRESSION_NONE);
    for (int i = 0; r == EXR_ERR_SUCCESS && i < w->source_count; i++)
        r = exr_add_channel(w->context, part, w->sources[i].name, EXR_PIXEL_FLOAT,
                            EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    for (int i = 0; r == EXR_ERR_SUCCESS && i < attribute_count; i++)
        r = exr_attr_set_string(w->context, part, attributes[i].name,
                                attributes[i].value ? attributes[i].value : "");
    if (r == EXR_ERR_SUCCESS)
        r = exr_write_header(w->context);
    return r == EXR_ERR_SUCCESS || failed(w, r);
}

static bool point_at_sources(struct writer *w, int y)
{
    exr_encode_pipeline_t *pipeline = &w->pipeline;
    if (pipeline->channel_count != w->source_count)
        return irb_fail(w->err, IRB_E_INTERNAL, "%s: %d channels declared, %d in the file", w->path,
                        w->source_count, (int)pipeline->channel_count);
    for (int c = 0; c < w->source_count; c++) {
        exr_coding_channel_info_t *info = &pipeline->channels[c];
        const struct source *source = &w->sources[c];
        if (strcmp(info->channel_name, source->name))
            return irb_fail(w->err, IRB_E_INTERNAL, "%s: channel order: expected '%s', found '%s'",
                            w->path, source->name, info->channel_name);
        int channels = source->image->channels;
        info->user_bytes_per_element = sizeof(float);
        info->user_data_type = EXR_PIXEL_FLOAT;
        info->user_pixel_stride = channels * (int)sizeof(float);
        info->user_line_stride = w->width * channels * (int)sizeof(float);
        info->encode_from_ptr =
            (const uint8_t *)(irb_image_at(source->image, 0, y) + source->channel);
    }
    return true;
}

static bool write_chunk(struct writer *w, int y)
{
    exr_chunk_info_t chunk;
    exr_result_t r = exr_write_scanline_chunk_info(w->context, 0, y, &chunk);
    if (r == EXR_ERR_SUCCESS)
        r = w->pipeline_ready ? exr_encoding_update(w->context, 0, &chunk, &w->pipeline)
                              : exr_encoding_initialize(w->context, 0, &chunk, &w->pipeline);
    if (r != EXR_ERR_SUCCESS)
        return failed(w, r);
    bool first = !w->pipeline_ready;
    w->pipeline_ready = true;
    if (!point_at_sources(w, y))
        return false;
    if (first)
        r = exr_encoding_choose_default_routines(w->context, 0, &w->pipeline);
    if (r == EXR_ERR_SUCCESS)
        r = exr_encoding_run(w->context, 0, &w->pipeline);
    return r == EXR_ERR_SUCCESS || failed(w, r);
}

static bool write_pixels(struct writer *w)
{
    int32_t lines = 0;
    exr_result_t r = exr_get_scanlines_per_chunk(w->context, 0, &lines);
    if (r != EXR_ERR_SUCCESS || lines < 1)
        return failed(w, r);
    for (int y = 0; y < w->height; y += lines)
        if (!write_chunk(w, y))
            return false;
    return true;
}

static bool finish(struct writer *w)
{
    if (w->pipeline_ready)
        exr_encoding_destroy(w->context, &w->pipeline);
    if (!w->context)
        return true;
    exr_result_t r = exr_finish(&w->context);
    return r == EXR_ERR_SUCCESS || failed(w, r);
}

static bool check_size(struct writer *w, const struct irb_exr_layer *layers, int layer_count)
{
    if (layer_count < 1)
        return irb_fail(w->err, IRB_E_INTERNAL, "%s: an EXR file needs a layer", w->path);
    w->width = layers[0].image->width;
    w->height = layers[0].image->height;
    if (w->width < 1 || w->height < 1 || w->width > IRB_EXR_MAX_SIDE ||
        w->height > IRB_EXR_MAX_SIDE)
        return irb_fail(w->err, IRB_E_INTERNAL, "%s: expected 1 to %d pixels a side, found %d x %d",
                        w->path, IRB_EXR_MAX_SIDE, w->width, w->height);
    return true;
}

bool irb_exr_write(const char *path, const struct irb_exr_layer *layers, int layer_count,
                   const struct irb_exr_attribute *attributes, int attribute_count,
                   enum irb_exr_compression compression, struct irb_error *err)
{
    struct writer w = {.path = path, .err = err};
    bool ok = check_size(&w, layers, layer_count) && collect_sources(&w, layers, layer_count);
    if (ok) {
        /* Room for the pixels and a usual header, so that the file rarely has to grow. */
        w.stream.capacity = (uint64_t)w.width * (uint64_t)w.height * (uint64_t)w.source_count * 4 +
                            (uint64_t)w.height * 16 + 65536;
        w.stream.data = malloc(w.stream.capacity);
        ok = w.stream.data || irb_fail(err, IRB_E_MEMORY, "%s: out of memory", path);
    }
    ok = ok && write_header(&w, attributes, attribute_count, compression) && write_pixels(&w);
    /* The table of chunk offsets is written here; a failure above is the one to report. */
    struct irb_error ignored;
    w.err = ok ? err : &ignored;
    ok = finish(&w) && ok;
    ok = ok && irb_fs_write(path, w.stream.data, w.stream.size, err);
    free(w.stream.data);
    free(w.sources);
    return ok;
}
