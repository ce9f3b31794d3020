/* SPDX-License-Identifier: MIT
 *
 * Files. A file that others may read is written beside its final name and renamed into place, so
 * that a reader (or a resumed run) sees it whole or not at all.
 */
#ifndef IRB_BASE_FS_H
#define IRB_BASE_FS_H

#include "core/base/error.h"

#include <stddef.h>

/* Creates the folder and its parents. */
bool irb_fs_make_dirs(const char *path, struct irb_error *err);
bool irb_fs_exists(const char *path);
/* Reads a whole file; *out is malloc'ed, zero-terminated, the caller's. Refuses above max_size. */
bool irb_fs_read(const char *path, size_t max_size, char **out, size_t *size,
                 struct irb_error *err);
/* Writes through path.tmp.PID and renames. */
bool irb_fs_write(const char *path, const void *data, size_t size, struct irb_error *err);
/* The temporary name for `path` (malloc'ed), and the rename that ends such a write. On failure
 * irb_fs_commit removes the temporary file. */
char *irb_fs_temp_name(const char *path);
bool irb_fs_commit(const char *temp, const char *path, struct irb_error *err);
/* The name itself, or, where it is longer than a file's may be, its beginning and a hash of it. The
 * folder of a trial with many parameters or keys has this name. Malloc'ed. */
char *irb_fs_short_name(const char *name);
/* Removes temporary files in the folder whose process is gone: what a killed run left behind. */
void irb_fs_remove_stale(const char *folder);

#endif
