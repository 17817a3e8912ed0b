/* SPDX-License-Identifier: Apache-2.0 */
#include "wave_file.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "definitions.h"

/* --- A full disk --------------------------------------------------------------------------------
 *
 * The library maps its files into memory: where one cannot grow, it meets SIGBUS. Nothing can go on
 * from there, but it can be said.
 */
static char full[400]; /* what is said */

static void on_bus_error(int number) {
    (void)number;
    if (write(STDERR_FILENO, full, strlen(full)) < 0) _exit(HS_EXIT_INTERNAL);
    hs_file_remove_all();
    _exit(HS_EXIT_FILE);
}

static void expect_full_disk(const char *path) {
    snprintf(full, sizeof full,
             "halfstep: %.300s: cannot write: no space for the waveform; free some\n", path);
    signal(SIGBUS, on_bus_error);
}

/* --- The file -----------------------------------------------------------------------------------
 */

bool hs_wave_start(hs_file *file, const char *path, hs_rtl *rtl, uint64_t first, uint64_t last,
                   hs_error *err) {
    if (!hs_file_create(file, path, err)) return false;
    if (!hs_file_temporary(file)) {
        hs_file_abandon(file);
        return hs_fail(err, HS_EXIT_FILE, "%.300s: a waveform needs a regular file; choose another",
                       path);
    }
    expect_full_disk(path);
    if (hs_file_beside(file, ".hier", err) &&
        hs_rtl_trace(rtl, hs_file_temporary(file), first, last, err) && hs_file_reopen(file, err))
        return true;
    hs_error ignored;
    hs_rtl_trace(rtl, NULL, 0, 0, &ignored);
    signal(SIGBUS, SIG_DFL);
    hs_file_abandon(file);
    return false;
}

/* --- Whether an FST file is whole ---------------------------------------------------------------
 *
 * It is a row of blocks: a byte that says which kind, eight with the length that follows, itself
 * included. While the library is at work, a block that is not complete is a BLOCK_SKIP.
 */
enum { BLOCK_HEADER = 0, BLOCK_GEOMETRY = 3, BLOCK_HIERARCHY = 4, BLOCK_HIERARCHY_LZ4 = 6 };
enum { BLOCK_HIERARCHY_LZ4_TWICE = 7, BLOCK_CHANGES = 8 };

static bool is_whole(FILE *stream) {
    bool header = false, geometry = false, hierarchy = false;
    if (fseek(stream, 0, SEEK_END) != 0) return false;
    const long size = ftell(stream);
    for (long at = 0; at < size;) {
        uint64_t length = 0;
        if (fseek(stream, at, SEEK_SET) != 0) return false;
        const int kind = getc(stream);
        for (int i = 0; i < 8; i++)
            length = length << 8 | (uint64_t)(getc(stream) & 255);
        if (feof(stream) || ferror(stream) || kind > BLOCK_CHANGES || length < 8 ||
            length > (uint64_t)(size - at - 1))
            return false;
        header = header || (kind == BLOCK_HEADER && at == 0);
        geometry = geometry || kind == BLOCK_GEOMETRY;
        hierarchy = hierarchy || kind == BLOCK_HIERARCHY || kind == BLOCK_HIERARCHY_LZ4 ||
                    kind == BLOCK_HIERARCHY_LZ4_TWICE;
        at += 1 + (long)length;
    }
    return header && geometry && hierarchy;
}

bool hs_wave_end(hs_file *file, hs_rtl *rtl, hs_error *err) {
    if (!file->stream) return true;
    errno = 0;
    const bool closed = hs_rtl_trace(rtl, NULL, 0, 0, err);
    signal(SIGBUS, SIG_DFL);
    if (closed && is_whole(file->stream)) return hs_file_commit(file, err);
    hs_file_unwritten(file->path, errno, err);
    hs_file_abandon(file);
    return false;
}
