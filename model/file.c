/* SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE
#include "file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
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

bool hs_file_unwritten(const char *path, int cause, hs_error *err) {
    if (cause == ENOMEM) return exhausted(err, path);
    if (cause == 0) cause = EIO;
    return hs_fail(err, HS_EXIT_FILE, PATH ": cannot write: %s; %s", path, strerror(cause),
                   remedy_of(cause));
}

/* The temporary files of this process, for hs_file_remove_all; one that finds no place is left to
 * the next writer of its path. */
enum { PENDING = 16 };
static char *_Atomic pending[PENDING];
static atomic_bool removed; /* the process ends: what another thread has just made goes as well */

static void note_pending(char *name) {
    for (int i = 0; i < PENDING; i++) {
        char *none = NULL;
        if (atomic_compare_exchange_strong(&pending[i], &none, name)) return;
    }
}

static void forget_pending(char *name) {
    for (int i = 0; i < PENDING; i++) {
        char *mine = name;
        if (atomic_compare_exchange_strong(&pending[i], &mine, NULL)) return;
    }
}

void hs_file_remove_all(void) {
    atomic_store(&removed, true);
    for (int i = 0; i < PENDING; i++) {
        const char *name = atomic_load(&pending[i]);
        if (name) unlink(name);
    }
}

/* Whether nobody writes this temporary file any more: its writer holds a lock on it. */
static bool is_stale(const char *name) {
    const int descriptor = open(name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return errno == ENOENT;
    const bool stale = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    close(descriptor);
    return stale;
}

#define PARTIAL ".partial-"

/* Removes what writers of path that were killed have left beside it: PATH.partial-PID-NUMBER, and
 * files whose names begin so. What cannot be removed stays. */
static void remove_stale(const char *path) {
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    const size_t folder = (size_t)(base - path), length = strlen(base);
    char name[PATH_MAX], stem[PATH_MAX];
    if (folder >= sizeof name - NAME_MAX - 1) return;
    memcpy(name, path, folder);
    name[folder] = 0;
    DIR *all = opendir(folder ? name : ".");
    if (!all) return;
    for (const struct dirent *entry; (entry = readdir(all)) != NULL;) {
        const char *own = entry->d_name + length + strlen(PARTIAL);
        if (strncmp(entry->d_name, base, length) != 0 ||
            strncmp(entry->d_name + length, PARTIAL, strlen(PARTIAL)) != 0)
            continue;
        const size_t numbers = strspn(own, "0123456789-");
        snprintf(name + folder, sizeof name - folder, "%s", entry->d_name);
        snprintf(stem, sizeof stem, "%.*s", (int)(folder + (size_t)(own - entry->d_name) + numbers),
                 name);
        if (numbers && is_stale(stem)) unlink(name);
    }
    closedir(all);
}

/* Locks an open temporary file; false if it was removed meanwhile as if it were stale. */
static bool hold(int descriptor) {
    struct stat status;
    flock(descriptor, LOCK_EX); /* where files have no locks, none is taken for stale either */
    return fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

/* Opens a file beside file->path that did not exist; its name says whose it is. */
static FILE *open_temporary(hs_file *file) {
    remove_stale(file->path);
    for (unsigned attempt = 0; attempt < 1000; attempt++) {
        char *name;
        if (asprintf(&name, "%s" PARTIAL "%ld-%u", file->path, (long)getpid(), attempt) < 0) {
            errno = ENOMEM;
            return NULL;
        }
        note_pending(name); /* before the file is there: a signal may come at any time */
        int descriptor = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        int cause = errno;
        if (descriptor >= 0) {
            if (atomic_load(&removed)) unlink(name);
            const bool held = hold(descriptor);
            FILE *stream = held ? fdopen(descriptor, "wb") : NULL;
            cause = held ? errno : EEXIST;
            if (stream != NULL) {
                file->temporary = name;
                return stream;
            }
            close(descriptor);
            unlink(name);
        }
        forget_pending(name);
        free(name);
        errno = cause;
        if (cause != EEXIST) return NULL;
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
    *file = (hs_file){0};
    struct stat status;
    const bool standard = strcmp(path, "-") == 0;
    bool exists = !standard && stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return hs_file_unwritten(path, EISDIR, err);

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
        return hs_file_unwritten(path, cause, err);
    }
    return true;
}

const char *hs_file_temporary(const hs_file *file) {
    return file->temporary;
}

bool hs_file_reopen(hs_file *file, hs_error *err) {
    fclose(file->stream); /* and with it the lock, which may be on the same file */
    file->stream = NULL;
    const int descriptor = open(file->temporary, O_RDWR | O_CLOEXEC);
    if (descriptor >= 0 && hold(descriptor)) file->stream = fdopen(descriptor, "r+b");
    if (file->stream != NULL) return true;
    hs_file_unwritten(file->path, errno, err);
    if (descriptor >= 0) close(descriptor);
    return false;
}

bool hs_file_beside(hs_file *file, const char *suffix, hs_error *err) {
    if (asprintf(&file->beside, "%s%s", file->temporary, suffix) < 0) {
        file->beside = NULL;
        return exhausted(err, file->path);
    }
    note_pending(file->beside);
    return true;
}

static void forget_temporary(hs_file *file) {
    if (file->beside != NULL) {
        unlink(file->beside);
        forget_pending(file->beside);
    }
    if (file->temporary != NULL) forget_pending(file->temporary);
    free(file->beside);
    free(file->temporary);
    file->beside = file->temporary = NULL;
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
        forget_temporary(file);
    } else {
        hs_file_unwritten(file->path, cause, err);
    }
    hs_file_abandon(file);
    return good;
}

void hs_file_abandon(hs_file *file) {
    if (file->stream != NULL) fclose(file->stream);
    if (file->temporary != NULL) unlink(file->temporary);
    forget_temporary(file);
    free(file->path);
    *file = (hs_file){0};
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
    if (stream == NULL && errno == ENOMEM) return exhausted(err, path);
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

bool hs_folder_lock(const char *path, int *lock, hs_error *err) {
    *lock = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (*lock < 0 || flock(*lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return true;
    hs_folder_unlock(lock);
    return hs_fail(
        err, HS_EXIT_FILE,
        PATH ": another process is at work in this folder; wait for it, or choose another", path);
}

void hs_folder_unlock(int *lock) {
    if (*lock >= 0) close(*lock);
    *lock = -1;
}

bool hs_text_check(const char *text, size_t size, const char *name, int code, hs_error *err) {
    const char *zero = size ? memchr(text, 0, size) : NULL;
    if (!zero) return true;
    uint32_t line = 1;
    for (const char *c = text; c < zero; c++)
        line += *c == '\n';
    return hs_fail(err, code, PATH ":%u: a zero byte; it should be text", name, line);
}
