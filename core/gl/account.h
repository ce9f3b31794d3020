/* SPDX-License-Identifier: MIT
 *
 * Byte accounting and messages that the kinds of objects share. Private to core/gl.
 */
#ifndef IRB_GL_ACCOUNT_H
#define IRB_GL_ACCOUNT_H

#include "core/gl/context.h"

static inline void irb_gl_account(struct irb_gl *gl, int64_t bytes)
{
    gl->bytes += bytes;
    if (gl->bytes > gl->peak_bytes)
        gl->peak_bytes = gl->bytes;
}

/* The name for messages and labels. */
static inline const char *irb_gl_name(const char *name, const char *kind)
{
    return name && *name ? name : kind;
}

#endif
