/* SPDX-License-Identifier: MIT
 *
 * OSMesa, loaded at run time: Mesa dropped it in 25.1, so the program must start without it.
 */
#include "core/gl/backend.h"

#if IRB_HAVE_OSMESA

#include <stdlib.h>

/* The part of <GL/osmesa.h> that is used here; that header cannot be included, since it brings
 * <GL/gl.h>, and need not be installed. */
enum {
    OSMESA_FORMAT = 0x22,
    OSMESA_DEPTH_BITS = 0x30,
    OSMESA_STENCIL_BITS = 0x31,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37,
};

typedef void *(*create_context_fn)(const int *attributes, void *share);
typedef GLboolean (*make_current_fn)(void *context, void *buffer, GLenum type, GLsizei width,
                                     GLsizei height);
typedef void (*destroy_context_fn)(void *context);

/* OSMesa wants a default framebuffer; nothing is drawn into it. */
enum { DEFAULT_SIZE = 16 };

struct osmesa {
    struct irb_gl_native native;
    void *library, *context;
    make_current_fn make_current;
    destroy_context_fn destroy_context;
    unsigned char pixels[DEFAULT_SIZE * DEFAULT_SIZE * 4];
};

static void *open_library(void)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        /* NODELETE: LLVM's own destructors do not survive being unloaded and loaded again */
        void *library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
        if (library)
            return library;
    }
    return NULL;
}

static void destroy(struct irb_gl_native *native)
{
    struct osmesa *o = (struct osmesa *)native;
    if (o->context) {
        o->make_current(NULL, NULL, 0, 0, 0);
        o->destroy_context(o->context);
    }
    if (o->library)
        dlclose(o->library);
    free(o);
}

static bool start(struct osmesa *o, struct irb_error *err)
{
    o->library = open_library();
    if (!o->library)
        return irb_fail(err, IRB_E_BACKEND,
                        "libOSMesa.so.8 not found (apt install libosmesa6; Mesa 25.1 and later has "
                        "none)");
    create_context_fn create_context =
        (create_context_fn)irb_gl_symbol(o->library, "OSMesaCreateContextAttribs");
    o->make_current = (make_current_fn)irb_gl_symbol(o->library, "OSMesaMakeCurrent");
    o->destroy_context = (destroy_context_fn)irb_gl_symbol(o->library, "OSMesaDestroyContext");
    o->native.get_proc = (irb_gl_get_proc)irb_gl_symbol(o->library, "OSMesaGetProcAddress");
    if (!create_context || !o->make_current || !o->destroy_context || !o->native.get_proc)
        return irb_fail(err, IRB_E_BACKEND,
                        "libOSMesa lacks OSMesaCreateContextAttribs (older than Mesa 12)");
    const int attributes[] = {OSMESA_FORMAT,
                              GL_RGBA,
                              OSMESA_DEPTH_BITS,
                              0,
                              OSMESA_STENCIL_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    o->context = create_context(attributes, NULL);
    if (!o->context)
        return irb_fail(err, IRB_E_BACKEND,
                        "no OpenGL 4.5 core context (needs Mesa 20.3 or later with llvmpipe)");
    if (!o->make_current(o->context, o->pixels, GL_UNSIGNED_BYTE, DEFAULT_SIZE, DEFAULT_SIZE))
        return irb_fail(err, IRB_E_BACKEND, "OSMesaMakeCurrent failed");
    return true;
}

struct irb_gl_native *irb_osmesa_create(struct irb_error *err)
{
    struct osmesa *o = calloc(1, sizeof *o);
    if (!o) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    o->native = (struct irb_gl_native){.platform = "osmesa", .destroy = destroy};
    if (start(o, err))
        return &o->native;
    destroy(&o->native);
    return NULL;
}

#else

struct irb_gl_native *irb_osmesa_create(struct irb_error *err)
{
    irb_fail(err, IRB_E_BACKEND, "not built in (meson setup -Dosmesa=enabled)");
    return NULL;
}

#endif
