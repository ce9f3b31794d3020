/* SPDX-License-Identifier: MIT */
#include "core/image/exr_stream.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The library hands its context to the callbacks, and that leads back to the stream. */
static void on_error(exr_const_context_t context, exr_result_t code, const char *text)
{
    void *user = NULL;
    if (!context || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || !user)
        return;
    struct irb_exr_stream *stream = user;
    if (stream->message[0])
        return; /* the first one is the cause */
    snprintf(stream->message, sizeof stream->message, "%s",
             text && *text ? text : exr_get_default_error_message(code));
    for (char *c = stream->message; *c; c++)
        if (*c == '\n' || *c == '\r')
            *c = ' ';
}

static int64_t stream_size(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((struct irb_exr_stream *)user)->size;
}

static int64_t stream_read(exr_const_context_t context, void *user, void *buffer, uint64_t size,
                           uint64_t offset, exr_stream_error_func_ptr_t report)
{
    struct irb_exr_stream *stream = user;
    /* The header is read in blocks that may reach beyond the end: fewer bytes are no error here. */
    uint64_t left = offset < stream->size ? stream->size - offset : 0;
    if (size > left)
        size = left;
    if (size == 0) {
        report(context, EXR_ERR_READ_IO, "truncated: the file ends after %llu bytes",
               (unsigned long long)stream->size);
        return -1;
    }
    memcpy(buffer, stream->data + offset, size);
    return (int64_t)size;
}

static bool reserve(struct irb_exr_stream *stream, uint64_t needed)
{
    if (needed <= stream->capacity)
        return true;
    uint64_t capacity = stream->capacity + stream->capacity / 2;
    if (capacity < needed)
        capacity = needed;
    unsigned char *data = realloc(stream->data, capacity);
    if (!data) {
        stream->out_of_memory = true;
        return false;
    }
    stream->data = data;
    stream->capacity = capacity;
    return true;
}

static int64_t stream_write(exr_const_context_t context, void *user, const void *buffer,
                            uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t report)
{
    struct irb_exr_stream *stream = user;
    if (!reserve(stream, offset + size)) {
        report(context, EXR_ERR_OUT_OF_MEMORY, "out of memory");
        return -1;
    }
    if (offset > stream->size)
        memset(stream->data + stream->size, 0, offset - stream->size);
    memcpy(stream->data + offset, buffer, size);
    if (offset + size > stream->size)
        stream->size = offset + size;
    return (int64_t)size;
}

exr_context_initializer_t irb_exr_context_settings(struct irb_exr_stream *stream)
{
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = on_error;
    settings.user_data = stream;
    settings.read_fn = stream_read;
    settings.write_fn = stream_write;
    settings.size_fn = stream_size;
    settings.max_image_width = IRB_EXR_MAX_SIDE;
    settings.max_image_height = IRB_EXR_MAX_SIDE;
    settings.flags = EXR_CONTEXT_FLAG_STRICT_HEADER | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    return settings;
}

bool irb_exr_fail(struct irb_error *err, enum irb_error_code code, const char *path,
                  const struct irb_exr_stream *stream, exr_result_t result)
{
    if (stream->out_of_memory || result == EXR_ERR_OUT_OF_MEMORY)
        code = IRB_E_MEMORY;
    const char *text = stream->message[0] ? stream->message : exr_get_default_error_message(result);
    return irb_fail(err, code, "%s: %s", path, text);
}

bool irb_exr_channel_name(char out[IRB_EXR_NAME_SIZE], const char *layer, char suffix)
{
    int length = *layer ? snprintf(out, IRB_EXR_NAME_SIZE, "%s.%c", layer, suffix)
                        : snprintf(out, IRB_EXR_NAME_SIZE, "%c", suffix);
    return length < IRB_EXR_NAME_SIZE;
}
