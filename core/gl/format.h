/* SPDX-License-Identifier: MIT
 *
 * What a sized internal format takes and how its texels are exchanged. Private to core/gl.
 */
#ifndef IRB_GL_FORMAT_H
#define IRB_GL_FORMAT_H

#include <stdbool.h>
#include <stddef.h>

enum irb_format_kind {
    IRB_FORMAT_COLOUR,  /* fixed point or float: exchanged as floats */
    IRB_FORMAT_INTEGER, /* exchanged as integers only */
    IRB_FORMAT_DEPTH,
    IRB_FORMAT_DEPTH_STENCIL,
};

struct irb_format {
    unsigned format;  /* GL_RGBA32F */
    const char *name; /* "GL_RGBA32F" */
    int bytes;        /* a texel; drivers may pad it */
    enum irb_format_kind kind;
};

/* NULL where the format is not in the table. */
const struct irb_format *irb_format_find(unsigned format);

#endif
