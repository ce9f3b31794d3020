/* SPDX-License-Identifier: MIT */
#include "core/gl/backend.h"
#include "core/base/str.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const char *const irb_backend_names[] = {"auto", "osmesa", "egl", "null", NULL};

/* Keeps the first error; everything else goes to the debug log. */
static void APIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                GLsizei length, const GLchar *message, const void *user)
{
    struct irb_gl *gl = (struct irb_gl *)user;
    (void)source;
    (void)id;
    int n = length >= 0 ? length : (int)strlen(message);
    while (n > 0 && message[n - 1] == '\n')
        n--;
    if (type == GL_DEBUG_TYPE_ERROR) {
        if (!gl->pending[0])
            snprintf(gl->pending, sizeof gl->pending, "%.*s", n, message);
    } else if (severity != GL_DEBUG_SEVERITY_NOTIFICATION) {
        irb_debug(gl->log, "OpenGL: %.*s", n, message);
    }
}

static bool is_software_renderer(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "swrast",
                                        "SWR",      "lavapipe", "Software Rasterizer"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strstr(renderer, names[i]))
            return true;
    return false;
}

static const char *string_or(const GLubyte *text)
{
    return text ? (const char *)text : "unknown";
}

static bool start(struct irb_gl *gl, struct irb_error *err)
{
    struct irb_gl_native *native = gl->native;
    gl->platform = native->platform;
    if (!irb_gl_api_load(&gl->api, native->get_proc, err))
        return false;
    gl->vendor = string_or(gl->api.GetString(GL_VENDOR));
    gl->renderer = string_or(gl->api.GetString(GL_RENDERER));
    gl->version = string_or(gl->api.GetString(GL_VERSION));
    gl->software = is_software_renderer(gl->renderer);
    GLint major = 0, minor = 0;
    gl->api.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->api.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 45)
        return irb_fail(err, IRB_E_BACKEND, "expected OpenGL 4.5 core, found %s", gl->version);
    gl->api.Enable(GL_DEBUG_OUTPUT);
    gl->api.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS); /* so that the message belongs to the last call */
    gl->api.DebugMessageCallback(on_message, gl);
    gl->api.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl->api.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->api.CreateVertexArrays(1, &gl->empty_vertex_array);
    return irb_gl_check(gl, "context", err);
}

static struct irb_gl *adopt(struct irb_gl_native *native, enum irb_backend backend,
                            const struct irb_gl_desc *desc, struct irb_error *err)
{
    if (!native)
        return NULL;
    struct irb_gl *gl = calloc(1, sizeof *gl);
    if (!gl) {
        native->destroy(native);
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    gl->backend = backend;
    gl->log = desc->log;
    gl->native = native;
    gl->shader_dir = desc->shader_dir ? irb_strdup(desc->shader_dir) : NULL;
    if (start(gl, err))
        return gl;
    irb_gl_destroy(gl);
    return NULL;
}

static struct irb_gl *create_egl(enum irb_egl_choice choice, const struct irb_gl_desc *desc,
                                 struct irb_error *err)
{
    return adopt(irb_egl_create(choice, err), IRB_BACKEND_EGL, desc, err);
}

static struct irb_gl *create_osmesa(const struct irb_gl_desc *desc, struct irb_error *err)
{
    return adopt(irb_osmesa_create(err), IRB_BACKEND_OSMESA, desc, err);
}

static struct irb_gl *create_auto(const struct irb_gl_desc *desc, struct irb_error *err)
{
    struct irb_error osmesa = {0}, egl = {0};
    struct irb_gl *gl = create_egl(IRB_EGL_HARDWARE, desc, &egl);
    if (gl && !gl->software)
        return gl;
    irb_gl_destroy(gl);
    if ((gl = create_osmesa(desc, &osmesa)) || (gl = create_egl(IRB_EGL_ANY, desc, &egl)))
        return gl;
    irb_fail(err, IRB_E_BACKEND, "no OpenGL backend works: osmesa: %.300s; egl: %.500s",
             osmesa.message, egl.message);
    return NULL;
}

struct irb_gl *irb_gl_create(const struct irb_gl_desc *desc, struct irb_error *err)
{
    struct irb_gl *gl = NULL;
    struct stat info;
    if (desc->shader_dir && (stat(desc->shader_dir, &info) || !S_ISDIR(info.st_mode))) {
        irb_fail(err, IRB_E_INPUT, "%s: expected a folder of shaders, found none",
                 desc->shader_dir);
        return NULL;
    }
    switch (desc->backend) {
    case IRB_BACKEND_AUTO:
        return create_auto(desc, err);
    case IRB_BACKEND_OSMESA:
        if (!(gl = create_osmesa(desc, err)))
            irb_error_prefix(err, "osmesa");
        return gl;
    case IRB_BACKEND_EGL:
        if (!(gl = create_egl(IRB_EGL_ANY, desc, err)))
            irb_error_prefix(err, "egl");
        return gl;
    case IRB_BACKEND_NULL:
        irb_fail(err, IRB_E_BACKEND,
                 "the null backend cannot render: use --backend auto, osmesa or egl for this");
        return NULL;
    }
    irb_fail(err, IRB_E_INTERNAL, "unknown backend %d", (int)desc->backend);
    return NULL;
}

void irb_gl_destroy(struct irb_gl *gl)
{
    if (!gl)
        return;
    if (gl->empty_vertex_array)
        gl->api.DeleteVertexArrays(1, &gl->empty_vertex_array);
    struct irb_gl_native *native = gl->native;
    native->destroy(native);
    free((char *)gl->shader_dir);
    free(gl);
}

static const char *error_text(GLenum code)
{
    switch (code) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    }
    return "unknown OpenGL error";
}

bool irb_gl_check(struct irb_gl *gl, const char *site, struct irb_error *err)
{
    GLenum first = gl->api.GetError();
    /* a lost context reports its error for ever */
    for (GLenum more = first; more != GL_NO_ERROR && more != GL_CONTEXT_LOST;)
        more = gl->api.GetError();
    if (!gl->pending[0] && first == GL_NO_ERROR)
        return true;
    enum irb_error_code code = first == GL_OUT_OF_MEMORY ? IRB_E_MEMORY : IRB_E_BACKEND;
    irb_fail(err, code, "%s: %s", site, gl->pending[0] ? gl->pending : error_text(first));
    gl->pending[0] = 0;
    return false;
}

void irb_gl_draw_fullscreen(struct irb_gl *gl)
{
    const struct irb_gl_api *api = &gl->api;
    static const GLenum off[] = {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE,
                                 GL_SCISSOR_TEST};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++)
        api->Disable(off[i]);
    api->DepthMask(GL_FALSE);
    api->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    api->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    api->BindVertexArray(gl->empty_vertex_array);
    api->DrawArrays(GL_TRIANGLES, 0, 3);
}
