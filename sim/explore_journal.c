/* SPDX-License-Identifier: Apache-2.0
 *
 * A journal is text: a line that says what it is of, then a line a point, its values in decimal.
 * Lines are appended by single writes; one that is not complete was interrupted.
 */
#include "explore.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "file.h"

enum { LINE = 22 * HS_EXPLORE_COLUMNS };

static void head_line(char *text, size_t size, uint32_t fingerprint) {
    snprintf(text, size, "halfstep explore 2 %08" PRIx32 "\n", fingerprint);
}

/* Takes a line of values; false if it is no such line. */
static bool take_line(const char *line, hs_explore_row *row, uint64_t points) {
    hs_explore_row read = {.done = true};
    const char *at = line;
    for (uint32_t c = 0; c < HS_EXPLORE_COLUMNS; c++) {
        char *end;
        errno = 0;
        /* strtoull takes signs as well, and blanks, line feeds among them. */
        if (*at < '0' || *at > '9') return false;
        read.value[c] = strtoull(at, &end, 10);
        if (errno || *end != (c + 1 < HS_EXPLORE_COLUMNS ? ',' : '\n')) return false;
        at = end + 1;
    }
    if (read.value[HS_EXPLORE_POINT] >= points) return false;
    row[read.value[HS_EXPLORE_POINT]] = read;
    return true;
}

/* Reads a journal; *good gets the bytes of its complete lines. */
static bool read_journal(const char *path, uint32_t fingerprint, hs_explore_row *row,
                         uint64_t points, size_t *good, hs_error *err) {
    uint8_t *bytes;
    size_t size;
    char head[80];
    *good = 0;
    if (!hs_file_read(path, (size_t)1 << 32, &bytes, &size, err)) return false;
    head_line(head, sizeof head, fingerprint);
    const char *text = (const char *)bytes, *end;
    bool right = size == 0 || strncmp(text, head, strlen(head)) == 0 || !memchr(text, '\n', size);
    for (const char *at = text; right && (end = memchr(at, '\n', size - (size_t)(at - text)));
         at = end + 1) {
        if (at != text && !take_line(at, row, points)) right = false;
        *good = (size_t)(end + 1 - text);
    }
    free(bytes);
    return right || hs_fail(err, HS_EXIT_USAGE,
                            "%.300s: a journal of another exploration; choose another --out, or "
                            "remove it",
                            path);
}

static bool is_journal(const char *name) {
    const size_t length = strlen(name);
    return strncmp(name, "shard-", 6) == 0 && length > 4 && strcmp(name + length - 4, ".csv") == 0;
}

static bool read_others(const char *folder, const char *own, uint32_t fingerprint,
                        hs_explore_row *row, uint64_t points, hs_error *err) {
    DIR *dir = opendir(folder);
    if (!dir)
        return hs_fail(err, HS_EXIT_FILE, "%.300s: cannot be read: %s", folder, strerror(errno));
    bool good = true;
    for (const struct dirent *entry; good && (entry = readdir(dir)) != NULL;) {
        char path[4600];
        size_t ignored;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (is_journal(entry->d_name) && strcmp(path, own) != 0)
            good = read_journal(path, fingerprint, row, points, &ignored, err);
    }
    closedir(dir);
    return good;
}

static bool write_all(hs_explore_journal *journal, const char *text, hs_error *err) {
    size_t left = strlen(text);
    while (left) {
        const ssize_t written = write(journal->file, text, left);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0)
            return hs_fail(err, HS_EXIT_FILE, "%.300s: cannot be written: %s", journal->path,
                           strerror(errno));
        text += written;
        left -= (size_t)written;
    }
    return true;
}

bool hs_explore_journal_open(hs_explore_journal *journal, const char *folder, uint32_t shard,
                             uint32_t shards, uint32_t fingerprint, hs_explore_row *row,
                             uint64_t points, hs_error *err) {
    char head[80];
    size_t good;
    snprintf(journal->path, sizeof journal->path, "%.4000s/shard-%u-of-%u.csv", folder, shard,
             shards);
    journal->file = open(journal->path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (journal->file < 0)
        return hs_fail(err, HS_EXIT_FILE, "%.300s: cannot be written: %s", journal->path,
                       strerror(errno));
    if (flock(journal->file, LOCK_EX | LOCK_NB) != 0) {
        hs_explore_journal_close(journal);
        return hs_fail(err, HS_EXIT_USAGE,
                       "%.300s: another process is at work on it; wait, or give it a --shard of "
                       "its own",
                       journal->path);
    }
    head_line(head, sizeof head, fingerprint);
    if (!read_journal(journal->path, fingerprint, row, points, &good, err) ||
        !read_others(folder, journal->path, fingerprint, row, points, err) ||
        (ftruncate(journal->file, (off_t)good) != 0 &&
         !hs_fail(err, HS_EXIT_FILE, "%.300s: cannot be cut: %s", journal->path,
                  strerror(errno))) ||
        (good == 0 && !write_all(journal, head, err))) {
        hs_explore_journal_close(journal);
        return false;
    }
    return true;
}

bool hs_explore_journal_add(hs_explore_journal *journal, const hs_explore_row *row, hs_error *err) {
    char line[LINE];
    size_t used = 0;
    for (uint32_t c = 0; c < HS_EXPLORE_COLUMNS; c++)
        used += (size_t)snprintf(line + used, sizeof line - used, "%" PRIu64 "%c", row->value[c],
                                 c + 1 < HS_EXPLORE_COLUMNS ? ',' : '\n');
    return write_all(journal, line, err);
}

void hs_explore_journal_close(hs_explore_journal *journal) {
    if (journal->file >= 0) close(journal->file);
    journal->file = -1;
}
