/* SPDX-License-Identifier: MIT */
#include "core/gl/account.h"
#include "core/gl/objects.h"

#include <stdlib.h>

struct irb_buffer *irb_buffer_create(struct irb_gl *gl, const char *name, int64_t bytes,
                                     const void *data, struct irb_error *err)
{
    name = irb_gl_name(name, "buffer");
    if (bytes < 1) {
        irb_fail(err, IRB_E_INTERNAL, "%s: expected at least 1 byte, found %lld", name,
                 (long long)bytes);
        return NULL;
    }
    struct irb_buffer *buffer = calloc(1, sizeof *buffer);
    if (!buffer) {
        irb_fail(err, IRB_E_MEMORY, "%s: out of memory", name);
        return NULL;
    }
    buffer->gl = gl;
    gl->api.CreateBuffers(1, &buffer->id);
    gl->api.NamedBufferStorage(buffer->id, (GLsizeiptr)bytes, data, GL_DYNAMIC_STORAGE_BIT);
    gl->api.ObjectLabel(GL_BUFFER, buffer->id, -1, name);
    if (!irb_gl_check(gl, name, err)) {
        irb_buffer_destroy(buffer);
        return NULL;
    }
    buffer->bytes = bytes;
    irb_gl_account(gl, bytes);
    return buffer;
}

void irb_buffer_destroy(struct irb_buffer *buffer)
{
    if (!buffer)
        return;
    buffer->gl->api.DeleteBuffers(1, &buffer->id);
    irb_gl_account(buffer->gl, -buffer->bytes);
    free(buffer);
}

/* The label in `name`; whether the range lies within the buffer. */
static bool check_range(const struct irb_buffer *buffer, int64_t offset, int64_t bytes,
                        char name[128], struct irb_error *err)
{
    name[0] = 0;
    buffer->gl->api.GetObjectLabel(GL_BUFFER, buffer->id, 128, NULL, name);
    if (offset >= 0 && bytes >= 0 && offset <= buffer->bytes && bytes <= buffer->bytes - offset)
        return true;
    return irb_fail(err, IRB_E_INTERNAL, "%s: bytes %lld to %lld lie outside its %lld", name,
                    (long long)offset, (long long)(offset + bytes), (long long)buffer->bytes);
}

bool irb_buffer_read(const struct irb_buffer *buffer, int64_t offset, int64_t bytes, void *out,
                     struct irb_error *err)
{
    char name[128];
    if (!check_range(buffer, offset, bytes, name, err))
        return false;
    /* what shaders wrote becomes visible to this read */
    buffer->gl->api.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    buffer->gl->api.GetNamedBufferSubData(buffer->id, (GLintptr)offset, (GLsizeiptr)bytes, out);
    return irb_gl_check(buffer->gl, name, err);
}

bool irb_buffer_write(struct irb_buffer *buffer, int64_t offset, int64_t bytes, const void *data,
                      struct irb_error *err)
{
    char name[128];
    if (!check_range(buffer, offset, bytes, name, err))
        return false;
    buffer->gl->api.NamedBufferSubData(buffer->id, (GLintptr)offset, (GLsizeiptr)bytes, data);
    return irb_gl_check(buffer->gl, name, err);
}
