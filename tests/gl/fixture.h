/* SPDX-License-Identifier: MIT
 *
 * For tests that need OpenGL: a context on the backend that argv[1] names, or exit status 77, and
 * a folder of shaders that a test writes. Include after cmocka.h.
 */
#ifndef IRB_TESTS_GL_FIXTURE_H
#define IRB_TESTS_GL_FIXTURE_H

#include "core/base/fs.h"
#include "core/base/str.h"
#include "core/gl/context.h"

#include <stdlib.h>
#include <string.h>

/* Index of argv[1] in irb_backend_names; AUTO without one. */
static inline enum irb_backend fixture_backend(int argc, char **argv)
{
    for (int i = 0; argc > 1 && irb_backend_names[i]; i++)
        if (strcmp(argv[1], irb_backend_names[i]) == 0)
            return (enum irb_backend)i;
    return IRB_BACKEND_AUTO;
}

/* Ends the test as skipped where the backend is missing. */
static inline struct irb_gl *fixture_gl(enum irb_backend backend, const char *shader_dir)
{
    struct irb_error err = {0};
    struct irb_gl_desc desc = {.backend = backend, .shader_dir = shader_dir};
    struct irb_gl *gl = irb_gl_create(&desc, &err);
    if (!gl) {
        printf("skipped: %s\n", err.message);
        exit(77);
    }
    return gl;
}

/* A new folder below the working directory; the caller frees the name. */
static inline char *fixture_folder(void)
{
    char *folder = irb_strdup("gl-test-XXXXXX");
    if (!mkdtemp(folder))
        fail_msg("cannot create a folder for the test");
    return folder;
}

static inline void fixture_write(const char *folder, const char *path, const char *text)
{
    struct irb_error err = {0};
    char *file = irb_asprintf("%s/%s", folder, path);
    char *slash = strrchr(file, '/');
    *slash = 0;
    bool ok = irb_fs_make_dirs(file, &err);
    *slash = '/';
    if (!ok || !irb_fs_write(file, text, strlen(text), &err))
        fail_msg("%s", err.message);
    free(file);
}

static inline void fixture_remove(char *folder)
{
    char *command = irb_asprintf("rm -r '%s'", folder);
    if (system(command))
        print_message("%s: left behind\n", folder);
    free(command);
    free(folder);
}

/* The text must contain the part; both are printed where it does not. */
#define REQUIRE_CONTAINS(text, part)                                                               \
    do {                                                                                           \
        if (!strstr(text, part))                                                                   \
            fail_msg("expected \"%s\" in: %s", part, text);                                        \
    } while (0)

/* A message is one line. */
#define REQUIRE_ONE_LINE(text)                                                                     \
    do {                                                                                           \
        if (!*(text) || strchr(text, '\n'))                                                        \
            fail_msg("expected one line, found: %s", text);                                        \
    } while (0)

#endif
