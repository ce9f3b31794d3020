/* SPDX-License-Identifier: MIT */
#include "core/gl/program.h"
#include "core/gl/glsl.h"

#include <stdlib.h>
#include <string.h>

static char *read_log(struct irb_gl *gl, GLuint id, bool program)
{
    GLint length = 0;
    if (program)
        gl->api.GetProgramiv(id, GL_INFO_LOG_LENGTH, &length);
    else
        gl->api.GetShaderiv(id, GL_INFO_LOG_LENGTH, &length);
    char *log = calloc(1, (size_t)(length > 0 ? length : 0) + 1);
    if (!log)
        abort();
    if (length > 0 && program)
        gl->api.GetProgramInfoLog(id, length, NULL, log);
    else if (length > 0)
        gl->api.GetShaderInfoLog(id, length, NULL, log);
    return log;
}

static bool compile(struct irb_gl *gl, GLuint shader, const struct irb_glsl *glsl,
                    struct irb_error *err)
{
    bool clean = !gl->pending[0];
    const GLchar *text = irb_str_text(&glsl->text);
    const GLint length = (GLint)glsl->text.length;
    gl->api.ShaderSource(shader, 1, &text, &length);
    gl->api.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl->api.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return true;
    char *log = read_log(gl, shader, false);
    char message[640];
    irb_glsl_describe_log(glsl, log, message, sizeof message);
    free(log);
    if (clean)
        gl->pending[0] = 0; /* Mesa reports the log through KHR_debug as well */
    return irb_fail(err, IRB_E_INPUT, "%s", message);
}

static bool attach_stage(struct irb_program *program, GLenum stage, const char *path,
                         const char *const *defines, struct irb_error *err)
{
    struct irb_gl *gl = program->gl;
    struct irb_glsl glsl = {0};
    bool ok = irb_glsl_expand(&glsl, gl->shader_dir, path, defines, err);
    if (ok) {
        GLuint shader = gl->api.CreateShader(stage);
        ok = compile(gl, shader, &glsl, err);
        if (ok)
            gl->api.AttachShader(program->id, shader);
        gl->api.DeleteShader(shader); /* lives on while it is attached */
    }
    irb_glsl_free(&glsl);
    return ok;
}

static bool link(struct irb_program *program, struct irb_error *err)
{
    struct irb_gl *gl = program->gl;
    bool clean = !gl->pending[0];
    gl->api.LinkProgram(program->id);
    GLint linked = GL_FALSE;
    gl->api.GetProgramiv(program->id, GL_LINK_STATUS, &linked);
    if (linked)
        return true;
    char *log = read_log(gl, program->id, true);
    const char *first = strncmp(log, "error: ", 7) == 0 ? log + 7 : log;
    irb_fail(err, IRB_E_INPUT, "%s: the stages do not link: %.*s", program->name,
             (int)strcspn(first, "\n"), first);
    free(log);
    if (clean)
        gl->pending[0] = 0;
    return false;
}

static bool build(struct irb_program *program, const struct irb_program_desc *desc,
                  struct irb_error *err)
{
    const struct {
        GLenum stage;
        const char *path;
    } stages[] = {
        {GL_VERTEX_SHADER, desc->vertex},
        {GL_TESS_CONTROL_SHADER, desc->tess_control},
        {GL_TESS_EVALUATION_SHADER, desc->tess_evaluation},
        {GL_GEOMETRY_SHADER, desc->geometry},
        {GL_FRAGMENT_SHADER, desc->fragment},
        {GL_COMPUTE_SHADER, desc->compute},
    };
    for (size_t i = 0; i < sizeof stages / sizeof *stages; i++)
        if (stages[i].path &&
            !attach_stage(program, stages[i].stage, stages[i].path, desc->defines, err))
            return false;
    if (!link(program, err))
        return false;
    program->gl->api.ObjectLabel(GL_PROGRAM, program->id, -1, program->name);
    return irb_gl_check(program->gl, program->name, err);
}

struct irb_program *irb_program_create(struct irb_gl *gl, const struct irb_program_desc *desc,
                                       struct irb_error *err)
{
    struct irb_program *program = calloc(1, sizeof *program);
    if (!program) {
        irb_fail(err, IRB_E_MEMORY, "out of memory");
        return NULL;
    }
    program->gl = gl;
    program->name = irb_strdup(desc->name ? desc->name : "program");
    program->id = gl->api.CreateProgram();
    if (build(program, desc, err))
        return program;
    irb_program_destroy(program);
    return NULL;
}

void irb_program_destroy(struct irb_program *program)
{
    if (!program)
        return;
    program->gl->api.DeleteProgram(program->id);
    free(program->name);
    free(program);
}

void irb_program_use(const struct irb_program *program)
{
    program->gl->api.UseProgram(program->id);
}

static GLint location(const struct irb_program *program, const char *name)
{
    return program->gl->api.GetUniformLocation(program->id, name);
}

void irb_program_int(const struct irb_program *program, const char *name, int value)
{
    program->gl->api.ProgramUniform1i(program->id, location(program, name), value);
}

void irb_program_uint(const struct irb_program *program, const char *name, unsigned value)
{
    program->gl->api.ProgramUniform1ui(program->id, location(program, name), value);
}

void irb_program_float(const struct irb_program *program, const char *name, float value)
{
    program->gl->api.ProgramUniform1f(program->id, location(program, name), value);
}

void irb_program_vec2(const struct irb_program *program, const char *name, const float value[2])
{
    program->gl->api.ProgramUniform2fv(program->id, location(program, name), 1, value);
}

void irb_program_vec3(const struct irb_program *program, const char *name, const float value[3])
{
    program->gl->api.ProgramUniform3fv(program->id, location(program, name), 1, value);
}

void irb_program_vec4(const struct irb_program *program, const char *name, const float value[4])
{
    program->gl->api.ProgramUniform4fv(program->id, location(program, name), 1, value);
}

void irb_program_ivec2(const struct irb_program *program, const char *name, const int value[2])
{
    program->gl->api.ProgramUniform2iv(program->id, location(program, name), 1, value);
}

void irb_program_mat4(const struct irb_program *program, const char *name, const float *value)
{
    program->gl->api.ProgramUniformMatrix4fv(program->id, location(program, name), 1, GL_FALSE,
                                             value);
}
