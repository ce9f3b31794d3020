/* SPDX-License-Identifier: MIT
 *
 * Where GLSL text comes from: the table embedded in the binary, and a folder laid over it.
 */
#ifndef IRB_GL_SHADERS_H
#define IRB_GL_SHADERS_H

#include "core/base/embedded.h"
#include "core/base/error.h"

/* Made by embed.py from shaders/, sorted by path ("frame/gbuffer.vert"). */
extern const struct irb_embedded_file irb_embedded_shaders[];
extern const size_t irb_embedded_shaders_count;

/* The text of one shader, malloc'ed: from shader_dir (may be NULL) where the file is there, else
 * the embedded one. NULL with IRB_E_INPUT; an unknown path gets the nearest known one. */
char *irb_shader_load(const char *shader_dir, const char *path, struct irb_error *err);

/* Paths of all embedded shaders and of those below shader_dir, sorted, each once; NULL-terminated.
 * The caller frees the list with irb_shader_list_free. */
char **irb_shader_list(const char *shader_dir, size_t *count);
void irb_shader_list_free(char **paths);

#endif
