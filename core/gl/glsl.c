/* SPDX-License-Identifier: MIT */
#include "core/gl/glsl.h"
#include "core/gl/shaders.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Deeper nesting is a mistake. */
enum { MAX_DEPTH = 16 };

struct expander {
    struct irb_glsl *glsl;
    const char *shader_dir;
    int stack[MAX_DEPTH]; /* source numbers of the files that are open */
    int depth;
};

static int add_file(struct irb_glsl *glsl, const char *path)
{
    char **files = realloc(glsl->files, (size_t)(glsl->file_count + 1) * sizeof *files);
    if (!files)
        abort();
    glsl->files = files;
    files[glsl->file_count] = irb_strdup(path);
    return glsl->file_count++;
}

/* Appends one line (without its end) that comes from `line` of file number `file`. */
static void emit_line(struct irb_glsl *glsl, const char *text, size_t length, int file, int line)
{
    irb_str_append(&glsl->text, text, length);
    irb_str_append(&glsl->text, "\n", 1);
    int n = glsl->line_count++;
    if ((n & (n - 1)) == 0) { /* full at each power of two */
        size_t capacity = n ? 2 * (size_t)n : 1;
        glsl->origins = realloc(glsl->origins, capacity * sizeof *glsl->origins);
        if (!glsl->origins)
            abort();
    }
    glsl->origins[n] = (struct irb_glsl_origin){file, line};
}

static int find_file(const struct irb_glsl *glsl, const char *path)
{
    for (int i = 1; i < glsl->file_count; i++)
        if (strcmp(glsl->files[i], path) == 0)
            return i;
    return -1;
}

/* Follows block comments over a line's end: returns whether one is open after it. */
static bool comment_after(const char *line, size_t length, bool open)
{
    for (size_t i = 0; i + 1 < length; i++) {
        if (open && line[i] == '*' && line[i + 1] == '/') {
            open = false;
            i++;
        } else if (!open && line[i] == '/' && line[i + 1] == '*') {
            open = true;
            i++;
        } else if (!open && line[i] == '/' && line[i + 1] == '/') {
            return false;
        }
    }
    return open;
}

/* The text after "# name" where the line is that directive, else NULL. */
static const char *directive(const char *line, const char *end, const char *name)
{
    while (line < end && isblank((unsigned char)*line))
        line++;
    if (line == end || *line++ != '#')
        return NULL;
    while (line < end && isblank((unsigned char)*line))
        line++;
    size_t length = strlen(name);
    if ((size_t)(end - line) < length || strncmp(line, name, length) != 0)
        return NULL;
    line += length;
    return line < end && (isalnum((unsigned char)*line) || *line == '_') ? NULL : line;
}

/* "path" between quotes, nothing but a line comment after it. malloc'ed, or NULL. */
static char *include_path(const char *at, const char *end)
{
    while (at < end && isblank((unsigned char)*at))
        at++;
    if (at == end || *at != '"')
        return NULL;
    const char *close = memchr(at + 1, '"', (size_t)(end - at - 1));
    if (!close || close == at + 1)
        return NULL;
    const char *rest = close + 1;
    while (rest < end && isspace((unsigned char)*rest))
        rest++;
    if (rest != end && !(end - rest >= 2 && rest[0] == '/' && (rest[1] == '/' || rest[1] == '*')))
        return NULL;
    return strndup(at + 1, (size_t)(close - at - 1));
}

static bool expand_file(struct expander *x, const char *path, struct irb_error *err);

/* An #include in line `line` of file number `from`. */
static bool expand_include(struct expander *x, int from, int line, const char *path,
                           struct irb_error *err)
{
    struct irb_glsl *glsl = x->glsl;
    const char *where = glsl->files[from];
    int known = find_file(glsl, path);
    for (int i = 0; i < x->depth; i++) {
        if (x->stack[i] != known)
            continue;
        struct irb_str chain = {0};
        for (; i < x->depth; i++)
            irb_str_printf(&chain, "%s -> ", glsl->files[x->stack[i]]);
        irb_fail(err, IRB_E_INPUT, "%s:%d: #include goes round in a circle: %.600s%s", where, line,
                 irb_str_text(&chain), path);
        irb_str_free(&chain);
        return false;
    }
    if (known >= 0)
        return true;
    if (x->depth == MAX_DEPTH)
        return irb_fail(err, IRB_E_INPUT, "%s:%d: #include is nested more than %d deep", where,
                        line, MAX_DEPTH);
    int before = glsl->file_count;
    if (expand_file(x, path, err))
        return true;
    bool missing = glsl->file_count == before; /* else the error names a line inside it */
    return missing ? irb_error_prefix(err, "%s:%d: #include", where, line) : false;
}

static bool expand_line(struct expander *x, int file, int line, const char *text, size_t length,
                        struct irb_error *err)
{
    const char *end = text + length;
    const char *path = x->glsl->files[file];
    if (directive(text, end, "version"))
        return irb_fail(err, IRB_E_INPUT,
                        "%s:%d: #version is put first by the loader; remove it here", path, line);
    const char *rest = directive(text, end, "include");
    if (!rest) {
        emit_line(x->glsl, text, length, file, line);
        return true;
    }
    char *included = include_path(rest, end);
    if (!included)
        return irb_fail(err, IRB_E_INPUT, "%s:%d: expected #include \"path\", found: %.*s", path,
                        line, (int)length, text);
    bool ok = expand_include(x, file, line, included, err);
    free(included);
    return ok;
}

/* Registers the file only when it could be loaded. */
static bool expand_file(struct expander *x, const char *path, struct irb_error *err)
{
    char *text = irb_shader_load(x->shader_dir, path, err);
    if (!text)
        return false;
    int file = add_file(x->glsl, path);
    x->stack[x->depth++] = file;
    bool ok = true, comment = false;
    int line = 1;
    for (const char *at = text; ok && *at; line++) {
        size_t length = strcspn(at, "\n");
        size_t shown = length && at[length - 1] == '\r' ? length - 1 : length;
        if (comment)
            emit_line(x->glsl, at, shown, file, line);
        else
            ok = expand_line(x, file, line, at, shown, err);
        comment = comment_after(at, shown, comment);
        at += length + (at[length] == '\n');
    }
    x->depth--;
    free(text);
    return ok;
}

bool irb_glsl_expand(struct irb_glsl *glsl, const char *shader_dir, const char *path,
                     const char *const *defines, struct irb_error *err)
{
    struct expander x = {.glsl = glsl, .shader_dir = shader_dir};
    add_file(glsl, "defines");
    static const char version[] = "#version 450 core";
    emit_line(glsl, version, strlen(version), 0, 0);
    for (int i = 0; defines && defines[i]; i++) {
        struct irb_str define = {0};
        irb_str_printf(&define, "#define %s", defines[i]);
        emit_line(glsl, define.text, define.length, 0, i + 1);
        irb_str_free(&define);
    }
    return expand_file(&x, path, err);
}

void irb_glsl_free(struct irb_glsl *glsl)
{
    irb_str_free(&glsl->text);
    for (int i = 0; i < glsl->file_count; i++)
        free(glsl->files[i]);
    free(glsl->files);
    free(glsl->origins);
    *glsl = (struct irb_glsl){0};
}

/* One error line of a log: the line number that it names, and the message. */
static bool parse_log_line(const char *line, int *number, const char **message)
{
    int used = 0, source, column;
    if (sscanf(line, "%d:%d(%d): %n", &source, number, &column, &used) == 3 && used) /* Mesa */
        *message = line + used;
    else if (sscanf(line, "%d(%d) : %n", &source, number, &used) == 2 && used) /* NVIDIA */
        *message = line + used;
    else if (sscanf(line, "ERROR: %d:%d: %n", &source, number, &used) == 2 && used)
        *message = line + used;
    else
        return false;
    static const char error[] = "error: ";
    if (strncmp(*message, error, strlen(error)) == 0)
        *message += strlen(error);
    return strncmp(*message, "warning", strlen("warning")) != 0;
}

void irb_glsl_describe_log(const struct irb_glsl *glsl, const char *log, char *out, size_t size)
{
    char first[512] = "";
    int errors = 0;
    for (const char *at = log; *at;) {
        size_t length = strcspn(at, "\n");
        char line[512];
        snprintf(line, sizeof line, "%.*s", (int)length, at);
        int number;
        const char *message;
        if (parse_log_line(line, &number, &message) && errors++ == 0) {
            bool known = number >= 1 && number <= glsl->line_count;
            struct irb_glsl_origin from = {0, number};
            if (known)
                from = glsl->origins[number - 1];
            snprintf(first, sizeof first, "%.200s:%d: %.280s", glsl->files[from.file], from.line,
                     message);
        }
        at += length + (at[length] == '\n');
    }
    const char *root = glsl->files[glsl->file_count > 1 ? 1 : 0];
    if (!errors)
        snprintf(out, size, "%s: %.*s", root, (int)strcspn(log, "\n"), log);
    else if (errors > 1)
        snprintf(out, size, "%s (and %d more)", first, errors - 1);
    else
        snprintf(out, size, "%s", first);
}
