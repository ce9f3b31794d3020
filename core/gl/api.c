/* SPDX-License-Identifier: MIT */
#include "core/gl/api.h"

#include <string.h>

bool irb_gl_api_load(struct irb_gl_api *api, irb_gl_get_proc get_proc, struct irb_error *err)
{
    const char *missing = NULL;
    int count = 0;
    irb_gl_proc proc;
    /* every entry is a function pointer: copied as such, since ISO C has no cast for it that is
     * free of warnings under all compilers */
#define X(type, name)                                                                              \
    proc = get_proc("gl" #name);                                                                   \
    _Static_assert(sizeof proc == sizeof api->name, "function pointers have one size");            \
    memcpy(&api->name, &proc, sizeof proc);                                                        \
    if (!proc && count++ == 0)                                                                     \
        missing = "gl" #name;
    IRB_GL_FUNCTIONS(X)
#undef X
    if (count)
        return irb_fail(err, IRB_E_BACKEND,
                        "the driver lacks %d entry point%s of OpenGL 4.5 core, first %s", count,
                        count == 1 ? "" : "s", missing);
    return true;
}
