/* SPDX-License-Identifier: MIT
 *
 * What a context needs from the library that provides it. Private to core/gl.
 */
#ifndef IRB_GL_BACKEND_H
#define IRB_GL_BACKEND_H

#include "core/gl/context.h"

#include <dlfcn.h>
#include <string.h>

/* dlsym for functions: POSIX promises that the pointer converts, ISO C has no cast for it. */
static inline irb_gl_proc irb_gl_symbol(void *library, const char *name)
{
    void *symbol = dlsym(library, name);
    irb_gl_proc proc;
    memcpy(&proc, &symbol, sizeof proc);
    return proc;
}

/* A current OpenGL 4.5 core context. */
struct irb_gl_native {
    const char *platform; /* "osmesa", "egl-device", "egl-surfaceless"; static */
    irb_gl_get_proc get_proc;
    /* Releases the context and everything below it, the struct included. */
    void (*destroy)(struct irb_gl_native *native);
};

/* NULL with IRB_E_BACKEND; the message says what was missing, without the backend's name. */
struct irb_gl_native *irb_osmesa_create(struct irb_error *err);

enum irb_egl_choice {
    IRB_EGL_HARDWARE, /* devices that are not declared as software */
    IRB_EGL_ANY,      /* those, else the surfaceless platform, else software devices */
};
struct irb_gl_native *irb_egl_create(enum irb_egl_choice choice, struct irb_error *err);

/* For `irbench doctor`: a line "  device N: ..." for each device that EGL lists; how many. */
int irb_egl_list_devices(FILE *out);

#endif
