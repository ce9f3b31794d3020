/* SPDX-License-Identifier: MIT
 *
 * GLSL programs. Sources are named by their path under shaders/ ("frame/gbuffer.vert"); an
 * #include "frame/light.glsl" is a path under shaders/ too, and is included at most once a stage.
 * "#version 450 core" and the defines are put first. Compile errors name file:line of the included
 * source.
 */
#ifndef IRB_GL_PROGRAM_H
#define IRB_GL_PROGRAM_H

#include "core/gl/context.h"

struct irb_program_desc {
    const char *name; /* for messages and debug labels, "rsm: gather" */
    const char *vertex, *tess_control, *tess_evaluation, *geometry, *fragment, *compute;
    const char *const *defines; /* NULL-terminated "NAME VALUE" strings, or NULL */
};

struct irb_program {
    unsigned id;
    char *name;        /* owned */
    struct irb_gl *gl; /* borrowed */
};

/* The stages that are named are compiled and linked. NULL with IRB_E_INPUT: an unknown path (with
 * the nearest one), an #include that fails, a compile error ("file:line: message"), a link error
 * (with the program's name). See core/gl/glsl.h for the rules of #include. */
struct irb_program *irb_program_create(struct irb_gl *gl, const struct irb_program_desc *desc,
                                       struct irb_error *err);
void irb_program_destroy(struct irb_program *program);
void irb_program_use(const struct irb_program *program);

/* Uniforms by name. A name that the compiler removed is ignored. */
void irb_program_int(const struct irb_program *program, const char *name, int value);
void irb_program_uint(const struct irb_program *program, const char *name, unsigned value);
void irb_program_float(const struct irb_program *program, const char *name, float value);
void irb_program_vec2(const struct irb_program *program, const char *name, const float value[2]);
void irb_program_vec3(const struct irb_program *program, const char *name, const float value[3]);
void irb_program_vec4(const struct irb_program *program, const char *name, const float value[4]);
void irb_program_ivec2(const struct irb_program *program, const char *name, const int value[2]);
/* column-major, 16 floats */
void irb_program_mat4(const struct irb_program *program, const char *name, const float *value);

/* Hash of the final text of every shader that is embedded or lies under shader_dir: part of a
 * run's provenance. hex gets 33 bytes. */
void irb_shader_hash(const struct irb_gl *gl, char hex[33]);

#endif
