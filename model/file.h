/* SPDX-License-Identifier: Apache-2.0
 *
 * Whole files. Reading takes a file into memory; writing makes it appear whole or not at all: what
 * is written goes to a temporary file beside the target, which takes the target's name at the end.
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
} hs_file;

/* Begins to write path; "-" is standard output. On failure *file is empty and nothing was created.
 */
bool hs_file_create(hs_file *file, const char *path, hs_error *err);

/* Ends the file: from here on path holds all that was written, in place of what it held. If
 * anything failed since hs_file_create, path is as it was. Either way *file is empty afterwards. */
bool hs_file_commit(hs_file *file, hs_error *err);

/* Gives up: removes the temporary file; path is as it was. An empty *file may be abandoned. */
void hs_file_abandon(hs_file *file);

/* Makes a folder, and those above it, where they are not there. */
bool hs_folder_make(const char *path, hs_error *err);

/* Reads a whole file, pipes included. *bytes, from malloc, belongs to the caller; a zero byte that
 * *size doesn't count stands behind the last one. A file of more than limit bytes is refused. On
 * failure *bytes is NULL and *size is 0. */
bool hs_file_read(const char *path, size_t limit, uint8_t **bytes, size_t *size, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
