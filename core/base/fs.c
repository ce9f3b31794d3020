/* SPDX-License-Identifier: MIT */
#include "core/base/fs.h"
#include "core/base/hash.h"
#include "core/base/str.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool irb_fs_exists(const char *path)
{
    return access(path, F_OK) == 0;
}

bool irb_fs_make_dirs(const char *path, struct irb_error *err)
{
    char *copy = irb_strdup(path);
    bool ok = true;
    for (char *slash = copy + 1; ok && *copy; slash++) {
        if (*slash && *slash != '/')
            continue;
        char end = *slash;
        *slash = 0;
        struct stat info;
        if (mkdir(copy, 0777) && (errno != EEXIST || stat(copy, &info) || !S_ISDIR(info.st_mode)))
            ok = irb_fail(err, IRB_E_IO, "%s: cannot create the folder: %s", copy,
                          errno == EEXIST ? "a file of that name is in the way" : strerror(errno));
        *slash = end;
        if (!end)
            break;
    }
    free(copy);
    return ok;
}

bool irb_fs_read(const char *path, size_t max_size, char **out, size_t *size, struct irb_error *err)
{
    FILE *file = fopen(path, "rb");
    struct stat info;
    if (!file || fstat(fileno(file), &info)) {
        int cause = errno;
        if (file)
            fclose(file);
        return irb_fail(err, IRB_E_INPUT, "%s: cannot open: %s", path, strerror(cause));
    }
    if (!S_ISREG(info.st_mode) || (size_t)info.st_size > max_size) {
        fclose(file);
        if (!S_ISREG(info.st_mode))
            return irb_fail(err, IRB_E_INPUT, "%s: expected a file, found something else", path);
        return irb_fail(err, IRB_E_INPUT, "%s: expected at most %zu bytes, found %lld", path,
                        max_size, (long long)info.st_size);
    }
    char *data = malloc((size_t)info.st_size + 1);
    size_t n = data ? fread(data, 1, (size_t)info.st_size, file) : 0;
    fclose(file);
    if (!data || n != (size_t)info.st_size) {
        free(data);
        return irb_fail(err, data ? IRB_E_INPUT : IRB_E_MEMORY, "%s: cannot read %lld bytes", path,
                        (long long)info.st_size);
    }
    data[n] = 0;
    *out = data;
    if (size)
        *size = n;
    return true;
}

char *irb_fs_temp_name(const char *path)
{
    return irb_asprintf("%s.tmp.%ld", path, (long)getpid());
}

void irb_fs_remove_stale(const char *folder)
{
    static const char mark[] = ".tmp.";
    DIR *dir = opendir(folder);
    if (!dir)
        return;
    for (struct dirent *entry; (entry = readdir(dir));) {
        const char *at = strstr(entry->d_name, mark);
        long pid = at ? strtol(at + strlen(mark), NULL, 10) : 0;
        if (pid <= 0 || kill((pid_t)pid, 0) == 0 || errno != ESRCH)
            continue;
        char *path = irb_asprintf("%s/%s", folder, entry->d_name);
        unlink(path);
        free(path);
    }
    closedir(dir);
}

bool irb_fs_commit(const char *temp, const char *path, struct irb_error *err)
{
    if (rename(temp, path) == 0)
        return true;
    irb_fail(err, IRB_E_IO, "%s: cannot write: %s", path, strerror(errno));
    unlink(temp);
    return false;
}

bool irb_fs_write(const char *path, const void *data, size_t size, struct irb_error *err)
{
    char *temp = irb_fs_temp_name(path);
    FILE *file = fopen(temp, "wb");
    bool ok = file && fwrite(data, 1, size, file) == size;
    int cause = errno;
    if (file && fclose(file)) {
        ok = false;
        cause = errno;
    }
    if (!ok) {
        unlink(temp);
        irb_fail(err, IRB_E_IO, "%s: cannot write: %s", path, strerror(cause));
    }
    ok = ok && irb_fs_commit(temp, path, err);
    free(temp);
    return ok;
}

char *irb_fs_short_name(const char *name)
{
    enum { LONGEST = 200, KEPT = 160 };
    if (strlen(name) <= LONGEST)
        return irb_strdup(name);
    struct irb_hash *hash = irb_hash_create();
    irb_hash_string(hash, name);
    struct irb_key key = irb_hash_finish(hash);
    return irb_asprintf("%.*s-%.8s", KEPT, name, key.hex);
}
