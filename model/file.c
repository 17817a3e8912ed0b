/* SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE
#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "definitions.h"

/* Long paths are cut in messages, so that the cause isn't. */
#define PATH "%.300s"

static bool exhausted(hs_error *err, const char *path) {
    return hs_fail(err, HS_EXIT_INTERNAL, PATH ": out of memory; free some memory", path);
}

/* --- Writing --------------------------------------------------------------------------------- */

static const char *remedy_of(int cause) {
    switch (cause) {
    case ENOENT:
    case ENOTDIR:
        return "create the folder first, or name another";
    case EACCES:
    case EPERM:
    case EROFS:
        return "choose a place that you may write to";
    case ENOSPC:
    case EDQUOT:
        return "free some space, or choose another place";
    case EISDIR:
        return "name a file, not a folder";
    default:
        return "choose another place";
    }
}

static bool write_failed(const char *path, int cause, hs_error *err) {
    return hs_fail(err, HS_EXIT_FILE, PATH ": cannot write: %s; %s", path, strerror(cause),
                   remedy_of(cause));
}

/* Opens a file beside file->path that did not exist; its name says whose it is. */
static FILE *open_temporary(hs_file *file) {
    for (unsigned attempt = 0; attempt < 1000; attempt++) {
        char *name;
        if (asprintf(&name, "%s.partial-%ld-%u", file->path, (long)getpid(), attempt) < 0) {
            errno = ENOMEM;
            return NULL;
        }
        int descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            FILE *stream = fdopen(descriptor, "wb");
            if (stream != NULL) {
                file->temporary = name;
                return stream;
            }
            close(descriptor);
            unlink(name);
        }
        free(name);
        if (errno != EEXIST) return NULL;
    }
    return NULL;
}

/* A stream of its own, that may be closed. */
static FILE *open_standard_output(void) {
    const int descriptor = dup(STDOUT_FILENO);
    FILE *stream = descriptor < 0 ? NULL : fdopen(descriptor, "wb");
    if (stream == NULL && descriptor >= 0) close(descriptor);
    return stream;
}

bool hs_file_create(hs_file *file, const char *path, hs_error *err) {
    *file = (hs_file){NULL, NULL, NULL};
    struct stat status;
    const bool standard = strcmp(path, "-") == 0;
    bool exists = !standard && stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return write_failed(path, EISDIR, err);

    /* Renaming onto a link would replace the link, onto a device the device. */
    file->path = exists ? realpath(path, NULL) : NULL;
    if (file->path == NULL) file->path = strdup(path);
    if (file->path == NULL) return exhausted(err, path);
    if (standard)
        file->stream = open_standard_output();
    else if (exists && !S_ISREG(status.st_mode))
        file->stream = fopen(file->path, "wb");
    else
        file->stream = open_temporary(file);
    if (file->stream == NULL) {
        int cause = errno;
        hs_file_abandon(file);
        return cause == ENOMEM ? exhausted(err, path) : write_failed(path, cause, err);
    }
    return true;
}

bool hs_file_commit(hs_file *file, hs_error *err) {
    errno = 0;
    bool written = fflush(file->stream) == 0 && !ferror(file->stream);
    int cause = errno;
    bool closed = fclose(file->stream) == 0;
    if (written && !closed) cause = errno;
    file->stream = NULL;
    bool good = written && closed;
    if (good && file->temporary != NULL) {
        good = rename(file->temporary, file->path) == 0;
        cause = errno;
    }
    if (good) {
        free(file->temporary);
        file->temporary = NULL;
    } else {
        write_failed(file->path, cause != 0 ? cause : EIO, err);
    }
    hs_file_abandon(file);
    return good;
}

void hs_file_abandon(hs_file *file) {
    if (file->stream != NULL) fclose(file->stream);
    if (file->temporary != NULL) unlink(file->temporary);
    free(file->temporary);
    free(file->path);
    *file = (hs_file){NULL, NULL, NULL};
}

/* --- Reading --------------------------------------------------------------------------------- */

/* Reads to the end of the stream, at most limit bytes and one, so that the caller sees an excess.
 * The length isn't asked for beforehand: pipes have none. NULL with errno on failure. */
static uint8_t *read_all(FILE *stream, size_t limit, size_t *size) {
    size_t capacity = 0;
    uint8_t *bytes = NULL;
    *size = 0;
    for (;;) {
        if (*size + 1 >= capacity) {
            capacity = capacity == 0 ? 65536 : 2 * capacity;
            uint8_t *grown = realloc(bytes, capacity);
            if (grown == NULL) {
                free(bytes);
                errno = ENOMEM;
                return NULL;
            }
            bytes = grown;
        }
        size_t room = capacity - 1 - *size;
        size_t got = fread(bytes + *size, 1, room, stream);
        *size += got;
        if (*size > limit || (got < room && !ferror(stream))) break;
        if (got < room) {
            int cause = errno;
            free(bytes);
            errno = cause;
            return NULL;
        }
    }
    bytes[*size] = 0;
    return bytes;
}

bool hs_file_read(const char *path, size_t limit, uint8_t **bytes, size_t *size, hs_error *err) {
    *bytes = NULL;
    *size = 0;
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        return hs_fail(err, HS_EXIT_FILE, PATH ": cannot read: %s; check the name and permissions",
                       path, strerror(errno));
    uint8_t *all = read_all(stream, limit, size);
    int cause = errno;
    fclose(stream);
    if (all == NULL) {
        *size = 0;
        if (cause == ENOMEM) return exhausted(err, path);
        return hs_fail(err, HS_EXIT_FILE, PATH ": cannot read: %s; check the file", path,
                       strerror(cause));
    }
    if (*size > limit) {
        *size = 0;
        free(all);
        return hs_fail(err, HS_EXIT_FILE, PATH ": has more than %zu bytes; use a smaller file",
                       path, limit);
    }
    *bytes = all;
    return true;
}

bool hs_folder_make(const char *path, hs_error *err) {
    char part[4096];
    if (strlen(path) >= sizeof part - 100)
        return hs_fail(err, HS_EXIT_FILE, "%.100s...: too long a path", path);
    for (size_t i = 1; i <= strlen(path); i++)
        if (path[i] == '/' || path[i] == 0) {
            memcpy(part, path, i);
            part[i] = 0;
            struct stat status;
            if (mkdir(part, 0777) == 0) continue;
            const int cause = errno;
            if (stat(part, &status) == 0 && S_ISDIR(status.st_mode)) continue;
            return hs_fail(err, HS_EXIT_FILE,
                           "%.300s: cannot make this folder: %s; choose another with --out", part,
                           strerror(cause == EEXIST ? ENOTDIR : cause));
        }
    return true;
}
