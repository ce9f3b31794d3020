/* SPDX-License-Identifier: MIT */
#include "core/gl/account.h"
#include "core/gl/format.h"
#include "core/gl/objects.h"

#include <stdlib.h>

enum { MAX_COLOUR = 8 };

static const char *status_text(GLenum status)
{
    switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "an attachment's format cannot be rendered to";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "it has no attachment";
    case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
        return "layered and plain attachments are mixed";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "the driver does not support this combination of formats";
    }
    return "unknown status";
}

/* All attachments have one size and layer count, and the depth texture holds depth. */
static bool check_attachments(const char *name, struct irb_texture *const *colour, int count,
                              const struct irb_texture *depth, struct irb_error *err)
{
    if (count < 0 || count > MAX_COLOUR || (!count && !depth))
        return irb_fail(err, IRB_E_INTERNAL,
                        "%s: framebuffer incomplete: expected 1..%d attachments, found %d", name,
                        MAX_COLOUR, count);
    const struct irb_texture *first = count ? colour[0] : depth;
    for (int i = 0; i <= count; i++) {
        const struct irb_texture *t = i < count ? colour[i] : depth;
        if (!t && i == count)
            continue;
        if (t->width != first->width || t->height != first->height || t->layers != first->layers)
            return irb_fail(err, IRB_E_INTERNAL,
                            "%s: framebuffer incomplete: attachments of %d x %d x %d and "
                            "%d x %d x %d",
                            name, first->width, first->height, first->layers, t->width, t->height,
                            t->layers);
        const struct irb_format *format = irb_format_find(t->format);
        bool is_depth =
            format->kind == IRB_FORMAT_DEPTH || format->kind == IRB_FORMAT_DEPTH_STENCIL;
        if (is_depth != (i == count))
            return irb_fail(err, IRB_E_INTERNAL, "%s: framebuffer incomplete: %s as %s attachment",
                            name, format->name, i == count ? "depth" : "colour");
    }
    return true;
}

static bool attach(struct irb_framebuffer *f, const char *name, struct irb_texture *const *colour,
                   int count, const struct irb_texture *depth, struct irb_error *err)
{
    const struct irb_gl_api *api = &f->gl->api;
    GLenum buffers[MAX_COLOUR];
    for (int i = 0; i < count; i++) {
        buffers[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        api->NamedFramebufferTexture(f->id, buffers[i], colour[i]->id, 0);
    }
    if (count)
        api->NamedFramebufferDrawBuffers(f->id, count, buffers);
    else
        api->NamedFramebufferDrawBuffer(f->id, GL_NONE);
    if (depth) {
        bool stencil = irb_format_find(depth->format)->kind == IRB_FORMAT_DEPTH_STENCIL;
        api->NamedFramebufferTexture(
            f->id, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth->id, 0);
    }
    GLenum status = api->CheckNamedFramebufferStatus(f->id, GL_DRAW_FRAMEBUFFER);
    api->ObjectLabel(GL_FRAMEBUFFER, f->id, -1, name);
    if (!irb_gl_check(f->gl, name, err))
        return false;
    if (status == GL_FRAMEBUFFER_COMPLETE)
        return true;
    return irb_fail(err, IRB_E_BACKEND, "%s: framebuffer incomplete: %s (0x%04x)", name,
                    status_text(status), status);
}

struct irb_framebuffer *irb_framebuffer_create(struct irb_gl *gl, const char *name,
                                               struct irb_texture *const *colour, int colour_count,
                                               struct irb_texture *depth, struct irb_error *err)
{
    name = irb_gl_name(name, "framebuffer");
    if (!check_attachments(name, colour, colour_count, depth, err))
        return NULL;
    struct irb_framebuffer *f = calloc(1, sizeof *f);
    if (!f) {
        irb_fail(err, IRB_E_MEMORY, "%s: out of memory", name);
        return NULL;
    }
    f->gl = gl;
    f->width = colour_count ? colour[0]->width : depth->width;
    f->height = colour_count ? colour[0]->height : depth->height;
    gl->api.CreateFramebuffers(1, &f->id);
    if (attach(f, name, colour, colour_count, depth, err))
        return f;
    irb_framebuffer_destroy(f);
    return NULL;
}

void irb_framebuffer_destroy(struct irb_framebuffer *framebuffer)
{
    if (!framebuffer)
        return;
    framebuffer->gl->api.DeleteFramebuffers(1, &framebuffer->id);
    free(framebuffer);
}

void irb_framebuffer_bind(const struct irb_framebuffer *framebuffer)
{
    framebuffer->gl->api.BindFramebuffer(GL_FRAMEBUFFER, framebuffer->id);
    framebuffer->gl->api.Viewport(0, 0, framebuffer->width, framebuffer->height);
}
