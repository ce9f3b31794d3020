/* SPDX-License-Identifier: MIT
 *
 * GLSL text before the driver sees it: #include, defines, and the way back from a line of the
 * driver's log to a file. Needs no context.
 *
 *     #include "frame/light.glsl"
 *
 * stands alone on its line, outside comments; the path is below shaders/; each file is put in at
 * most once. Does not: evaluate #if, so an #include inside one is always carried out.
 */
#ifndef IRB_GL_GLSL_H
#define IRB_GL_GLSL_H

#include "core/base/error.h"
#include "core/base/str.h"

/* Where a line of the final text comes from. */
struct irb_glsl_origin {
    int file; /* index into files */
    int line; /* from 1 */
};

/* The final text of one stage. Zero-initialise; free with irb_glsl_free.
 *
 * The text has no #line: Mesa 22.3 drops the source number in most of its messages ("0:3" for line
 * 3 of any file), so lines are counted through the whole text and mapped back here. */
struct irb_glsl {
    struct irb_str text;
    char **files; /* owned; 0 is the text that is put first, 1 the stage's own file */
    int file_count;
    struct irb_glsl_origin *origins; /* owned; one a line of text */
    int line_count;
};

/* "#version 450 core", the defines ("NAME VALUE", NULL-terminated, may be NULL), then `path` with
 * its includes. IRB_E_INPUT names file:line of an #include that is missing, malformed or in a
 * cycle, or of a #version. */
bool irb_glsl_expand(struct irb_glsl *glsl, const char *shader_dir, const char *path,
                     const char *const *defines, struct irb_error *err);
void irb_glsl_free(struct irb_glsl *glsl);

/* The first error in a driver's compile log as "file:line: message" (and how many follow), on one
 * line. Understands Mesa "0:12(5): error: ...", NVIDIA "0(12) : error ...", others "ERROR: 0:12:
 * ...". */
void irb_glsl_describe_log(const struct irb_glsl *glsl, const char *log, char *out, size_t size);

#endif
