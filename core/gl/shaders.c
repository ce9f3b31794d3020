/* SPDX-License-Identifier: MIT */
#include "core/gl/shaders.h"
#include "core/base/fs.h"
#include "core/base/hash.h"
#include "core/base/str.h"
#include "core/gl/program.h"

#include <fts.h>
#include <stdlib.h>
#include <string.h>

/* Above this a file is no shader. */
static const size_t max_shader_bytes = 1 << 20;

static const char *const extensions[] = {".vert", ".tesc", ".tese", ".geom",
                                         ".frag", ".comp", ".glsl"};

static bool is_shader(const char *name)
{
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; dot && i < sizeof extensions / sizeof *extensions; i++)
        if (strcmp(dot, extensions[i]) == 0)
            return true;
    return false;
}

struct list {
    char **paths;
    size_t count;
};

static void list_add(struct list *list, const char *path)
{
    char **paths = realloc(list->paths, (list->count + 2) * sizeof *paths);
    if (!paths)
        abort();
    paths[list->count++] = irb_strdup(path);
    paths[list->count] = NULL;
    list->paths = paths;
}

static void list_add_folder(struct list *list, const char *folder)
{
    char *const roots[] = {(char *)folder, NULL};
    FTS *walk = fts_open(roots, FTS_LOGICAL | FTS_NOCHDIR, NULL);
    if (!walk)
        return;
    for (FTSENT *entry; (entry = fts_read(walk));) {
        if (entry->fts_info != FTS_F || !is_shader(entry->fts_name))
            continue;
        const char *path = entry->fts_path + strlen(folder);
        list_add(list, path + strspn(path, "/"));
    }
    fts_close(walk);
}

static int compare_paths(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

char **irb_shader_list(const char *shader_dir, size_t *count)
{
    struct list list = {0};
    for (size_t i = 0; i < irb_embedded_shaders_count; i++)
        list_add(&list, irb_embedded_shaders[i].path);
    if (shader_dir)
        list_add_folder(&list, shader_dir);
    size_t kept = 0;
    if (list.count)
        qsort(list.paths, list.count, sizeof *list.paths, compare_paths);
    for (size_t i = 0; i < list.count; i++) {
        if (kept && strcmp(list.paths[kept - 1], list.paths[i]) == 0)
            free(list.paths[i]);
        else
            list.paths[kept++] = list.paths[i];
    }
    if (list.count)
        list.paths[kept] = NULL;
    *count = kept;
    return list.paths;
}

void irb_shader_list_free(char **paths)
{
    for (size_t i = 0; paths && paths[i]; i++)
        free(paths[i]);
    free(paths);
}

static const char *find_embedded(const char *path)
{
    for (size_t i = 0; i < irb_embedded_shaders_count; i++)
        if (strcmp(irb_embedded_shaders[i].path, path) == 0)
            return irb_embedded_shaders[i].text;
    return NULL;
}

/* Paths stay below shaders/. */
static bool is_inside(const char *path)
{
    size_t length = strlen(path);
    return length && path[0] != '/' && strncmp(path, "../", 3) != 0 && !strstr(path, "/../");
}

static void fail_unknown(const char *shader_dir, const char *path, struct irb_error *err)
{
    size_t count;
    char **paths = irb_shader_list(shader_dir, &count);
    const char *near = irb_nearest(path, (const char *const *)paths, count);
    if (near)
        irb_fail(err, IRB_E_INPUT, "%s: no such shader; did you mean \"%s\"?", path, near);
    else
        irb_fail(err, IRB_E_INPUT, "%s: no such shader", path);
    irb_shader_list_free(paths);
}

char *irb_shader_load(const char *shader_dir, const char *path, struct irb_error *err)
{
    if (shader_dir && is_inside(path)) {
        char *file = irb_asprintf("%s/%s", shader_dir, path);
        char *text = NULL;
        size_t size = 0;
        bool exists = irb_fs_exists(file);
        bool ok = exists && irb_fs_read(file, max_shader_bytes, &text, &size, err);
        if (ok && strlen(text) != size) {
            irb_fail(err, IRB_E_INPUT, "%s: expected GLSL text, found a zero byte", file);
            free(text);
            text = NULL;
        }
        free(file);
        if (exists)
            return text;
    }
    const char *embedded = find_embedded(path);
    if (embedded)
        return irb_strdup(embedded);
    fail_unknown(shader_dir, path, err);
    return NULL;
}

void irb_shader_hash(const struct irb_gl *gl, char hex[33])
{
    size_t count;
    char **paths = irb_shader_list(gl->shader_dir, &count);
    struct irb_hash *hash = irb_hash_create();
    for (size_t i = 0; i < count; i++) {
        char *text = irb_shader_load(gl->shader_dir, paths[i], NULL);
        irb_hash_string(hash, paths[i]);
        irb_hash_string(hash, text); /* a file that cannot be read counts as empty */
        free(text);
    }
    struct irb_key key = irb_hash_finish(hash);
    memcpy(hex, key.hex, sizeof key.hex);
    irb_shader_list_free(paths);
}
