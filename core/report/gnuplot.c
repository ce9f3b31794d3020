/* SPDX-License-Identifier: MIT */
#include "core/report/gnuplot.h"

#include "core/base/fs.h"
#include "core/base/str.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { LARGEST_FILE = 256 << 20, SCRIPTS_OWN = 2 /* exit status of what a script says itself */ };

/* A name in the temporary folder, malloc'ed. */
static char *inside(const char *folder, const char *name)
{
    return irb_asprintf("%s/%s", folder, name);
}

static bool write_file(const char *folder, const char *name, const char *text,
                       struct irb_error *err)
{
    char *path = inside(folder, name);
    bool ok = irb_fs_write(path, text, strlen(text), err);
    free(path);
    return ok;
}

static void remove_file(const char *folder, const char *name)
{
    char *path = inside(folder, name);
    unlink(path);
    free(path);
}

/* gnuplot ends a quoted name at the first comma, or at a doubled quote. So fields are separated by
 * tabs here, and a quote within a name becomes a typographic one. */
static char *separated_by_tabs(const char *csv)
{
    struct irb_str out = {0};
    bool quoted = false;
    for (const char *c = csv; *c; c++) {
        if (quoted && c[0] == '"' && c[1] == '"') {
            irb_str_printf(&out, "\u201d");
            c++;
        } else if (*c == '"') {
            quoted = !quoted;
        } else if (!quoted && *c == ',') {
            irb_str_append(&out, "\t", 1);
        } else {
            bool blank = quoted && (*c == '\t' || *c == '\n');
            irb_str_append(&out, blank ? " " : c, 1);
        }
    }
    if (!out.text)
        irb_str_append(&out, "", 0);
    return out.text;
}

/* NAME='value': within single quotes gnuplot expands nothing, and a doubled one stands for itself.
 */
static void assign(struct irb_str *out, const char *name, const char *value)
{
    irb_str_printf(out, "%s = '", name);
    for (const char *c = value; *c; c++)
        irb_str_append(out, *c == '\'' ? "''" : *c == '\n' ? " " : c, *c == '\'' ? 2 : 1);
    irb_str_printf(out, "'\n");
}

static bool write_inputs(const char *folder, const char *script, const char *csv,
                         const char *format, const struct irb_gnuplot_variable *variables,
                         int count, struct irb_error *err)
{
    bool ok = true;
    for (size_t i = 0; ok && i < irb_plot_files_count; i++)
        ok = write_file(folder, irb_plot_files[i].path, irb_plot_files[i].text, err);
    char *data = separated_by_tabs(csv);
    ok = ok && write_file(folder, "data.txt", data, err);
    free(data);
    struct irb_str main = {0};
    char *data_path = inside(folder, "data.txt"), *script_path = inside(folder, script);
    assign(&main, "csv", data_path);
    irb_str_printf(&main, "separator = \"\\t\"\nout = csv . '.%s'\n", format);
    for (int i = 0; i < count; i++)
        if (variables[i].value)
            assign(&main, variables[i].name, variables[i].value);
    assign(&main, "script", script_path);
    irb_str_printf(&main, "load script . '.gp'\n");
    ok = ok && write_file(folder, "main.gp", main.text, err);
    irb_str_free(&main);
    free(data_path);
    free(script_path);
    return ok;
}

/* Exit status, or -1 with *err where there is no gnuplot. What it prints goes to messages.txt. */
static int spawn(const char *folder, struct irb_error *err)
{
    char *messages = inside(folder, "messages.txt"), *main = inside(folder, "main.gp");
    /* -d: nobody's own settings */
    char *arguments[] = {"gnuplot", "-d", main, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages,
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    pid_t child;
    int status = 0, failure = posix_spawnp(&child, "gnuplot", &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    free(messages);
    free(main);
    if (failure) {
        irb_fail(err, IRB_E_INPUT,
                 "cannot run gnuplot: %s; it draws the plots: apt install gnuplot-nox",
                 failure == ENOENT ? "not found in PATH" : strerror(failure));
        return -1;
    }
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* The first line of what gnuplot said that says something, and is no warning. */
static bool fail_as_it_says(const char *folder, int status, struct irb_error *err)
{
    char *path = inside(folder, "messages.txt"), *text = NULL;
    size_t size;
    irb_fs_read(path, 1 << 20, &text, &size, NULL);
    free(path);
    const char *line = text ? text : "";
    while (*line) {
        size_t length = strcspn(line, "\n");
        char *copy = irb_asprintf("%.*s", (int)length, line);
        bool says = copy[strspn(copy, " \t^")] && !strstr(copy, "warning:");
        const char *words = copy + strspn(copy, " \t");
        if (says && status == SCRIPTS_OWN)
            irb_fail(err, IRB_E_INPUT, "%s", words);
        else if (says)
            irb_fail(err, IRB_E_INPUT, "gnuplot failed (status %d): %s", status, words);
        free(copy);
        if (says) {
            free(text);
            return false;
        }
        line += length + (line[length] != 0);
    }
    free(text);
    return irb_fail(err, IRB_E_INPUT, "gnuplot failed (status %d) and did not say why", status);
}

static bool run_in(const char *folder, const char *format, char **out, size_t *size,
                   struct irb_error *err)
{
    int status = spawn(folder, err);
    if (status < 0)
        return false;
    if (status > 0)
        return fail_as_it_says(folder, status, err);
    char *path = irb_asprintf("%s/data.txt.%s", folder, format);
    bool ok = irb_fs_exists(path) ? irb_fs_read(path, LARGEST_FILE, out, size, err)
                                  : fail_as_it_says(folder, status, err);
    free(path);
    return ok;
}

static void remove_folder(const char *folder, const char *format)
{
    char *figure = irb_asprintf("data.txt.%s", format);
    for (size_t i = 0; i < irb_plot_files_count; i++)
        remove_file(folder, irb_plot_files[i].path);
    remove_file(folder, "data.txt");
    remove_file(folder, "main.gp");
    remove_file(folder, "messages.txt");
    remove_file(folder, figure);
    free(figure);
    rmdir(folder);
}

bool irb_gnuplot(const char *script, const char *csv, const char *format,
                 const struct irb_gnuplot_variable *variables, int count, char **out, size_t *size,
                 struct irb_error *err)
{
    const char *root = getenv("TMPDIR");
    char *folder = irb_asprintf("%s/irbench-plot-XXXXXX", root && *root ? root : "/tmp");
    if (!mkdtemp(folder)) {
        irb_fail(err, IRB_E_IO, "%s: cannot create the folder: %s", folder, strerror(errno));
        free(folder);
        return false;
    }
    bool ok = write_inputs(folder, script, csv, format, variables, count, err) &&
              run_in(folder, format, out, size, err);
    remove_folder(folder, format);
    free(folder);
    return ok;
}
