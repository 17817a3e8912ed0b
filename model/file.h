/* SPDX-License-Identifier: Apache-2.0
 *
 * Whole files. Reading takes a file into memory; writing makes it appear whole or not at all: what
 * is written goes to a temporary file beside the target, PATH.partial-PID-NUMBER, which takes the
 * target's name at the end. Its writer holds a lock on it; if the writer was killed, the next one
 * of the same path removes it.
 *
 *     hs_file file;
 *     if (!hs_file_create(&file, path, err))
 *         return false;
 *     fprintf(file.stream, ...);                  failed writes are noticed by hs_file_commit
 *     return hs_file_commit(&file, err);          or hs_file_abandon(&file) if it isn't wanted
 *
 * All errors are HS_EXIT_FILE (HS_EXIT_INTERNAL if memory is exhausted) and name the path.
 */
#ifndef HS_FILE_H
#define HS_FILE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A file being written. stream is open from hs_file_create to hs_file_commit or hs_file_abandon;
 * the rest is private. */
typedef struct hs_file {
    FILE *stream;
    char *path;      /* the target, symbolic links followed */
    char *temporary; /* NULL if the target is written directly: a terminal, a pipe, a device */
    char *beside;    /* a library's own file, or NULL */
} hs_file;

/* Says that path cannot be written; cause is the errno, 0 if it is not known. Returns false. */
bool hs_file_unwritten(const char *path, int cause, hs_error *err);

/* Begins to write path; "-" is standard output. On failure *file is empty and nothing was created.
 */
bool hs_file_create(hs_file *file, const char *path, hs_error *err);

/* Ends the file: from here on path holds all that was written, in place of what it held. If
 * anything failed since hs_file_create, path is as it was. Either way *file is empty afterwards. */
bool hs_file_commit(hs_file *file, hs_error *err);

/* Gives up: removes the temporary file; path is as it was. An empty *file may be abandoned. */
void hs_file_abandon(hs_file *file);

/* For a writer that opens files by name: the name to give it, NULL if the target is written
 * directly. It may put a file of its own there; hs_file_reopen then holds on to that one, and
 * hs_file_commit makes it the target. */
const char *hs_file_temporary(const hs_file *file);
bool hs_file_reopen(hs_file *file, hs_error *err);

/* Says that such a writer makes a second file meanwhile, the temporary one's name with suffix
 * behind it; it is removed with the temporary one. For a file that has one, once. */
bool hs_file_beside(hs_file *file, const char *suffix, hs_error *err);

/* Removes the temporary files of all that this process writes; for the handler of a signal that
 * ends it. */
void hs_file_remove_all(void);

/* Makes a folder, and those above it, where they are not there. */
bool hs_folder_make(const char *path, hs_error *err);

/* Takes a folder for this process: false while another one has taken it. A folder that knows no
 * locks is taken by anybody. *lock is -1 when there is nothing to unlock. */
bool hs_folder_lock(const char *path, int *lock, hs_error *err);
void hs_folder_unlock(int *lock);

/* Reads a whole file, pipes included. *bytes, from malloc, belongs to the caller; a zero byte that
 * *size doesn't count stands behind the last one. A file of more than limit bytes is refused. On
 * failure *bytes is NULL and *size is 0. */
bool hs_file_read(const char *path, size_t limit, uint8_t **bytes, size_t *size, hs_error *err);

/* False, with its line and that exit code, if a zero byte is in a text: what is behind it would be
 * passed over. name is the file's. */
bool hs_text_check(const char *text, size_t size, const char *name, int code, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
