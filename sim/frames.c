/* SPDX-License-Identifier: Apache-2.0 */
#include "frames.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { GAP = 1000 }; /* so far behind the last file one more is looked for */

/* The next %d, %4d or %04d of a text; NULL if there is none. Of a width, *digits. */
static const char *find_number(const char *text, size_t *length, int *digits) {
    for (const char *at = strchr(text, '%'); at; at = strchr(at + 1, '%')) {
        size_t n = 1;
        *digits = 0;
        while (n < 4 && isdigit((unsigned char)at[n]))
            *digits = 10 * *digits + (at[n++] - '0');
        *length = n + 1;
        if (at[n] == 'd') return at;
    }
    return NULL;
}

bool hs_frames_name(const hs_frames *frames, uint32_t index, char *name, size_t size,
                    hs_error *err) {
    const int length =
        snprintf(name, size, "%.*s%0*u%s", (int)frames->before, frames->source, frames->digits,
                 frames->first + index, frames->source + frames->behind);
    return (length >= 0 && (size_t)length < size) ||
           hs_fail(err, HS_EXIT_FILE, "%.200s: the files' names are too long; use shorter ones",
                   frames->source);
}

static bool is_there(const hs_frames *frames, uint32_t index) {
    char name[4096];
    hs_error ignored;
    return hs_frames_name(frames, index, name, sizeof name, &ignored) && access(name, F_OK) == 0;
}

static bool no_files(const hs_frames *frames, hs_error *err) {
    char zero[300];
    snprintf(zero, sizeof zero, "%.*s%0*d%s", (int)(frames->before < 200 ? frames->before : 200),
             frames->source, frames->digits, 0, frames->source + frames->behind);
    return hs_fail(err, HS_EXIT_FILE,
                   "%.200s: there is neither %.250s nor the one with 1; number the files from 0 "
                   "or 1, without a gap",
                   frames->source, zero);
}

bool hs_frames_find(hs_frames *frames, const char *source, hs_error *err) {
    *frames = (hs_frames){0};
    size_t length, other;
    int digits, ignored;
    if (strncmp(source, "shape:", 6) == 0 || access(source, F_OK) == 0) return true;
    const char *number = find_number(source, &length, &digits);
    if (!number) return true;
    if (find_number(number + length, &other, &ignored))
        return hs_fail(err, HS_EXIT_USAGE,
                       "%.200s: two numbers in it; a deforming mesh has one, as in frame_%%04d.obj",
                       source);
    hs_frames f = {.source = source,
                   .before = (size_t)(number - source),
                   .behind = (size_t)(number - source) + length,
                   .digits = digits};
    if (!is_there(&f, 0)) f.first = 1;
    while (f.count < HS_FRAMES_MOST && is_there(&f, f.count))
        f.count++;
    if (f.count == 0) return no_files(&f, err);
    for (uint32_t i = f.count + 1; i < f.count + GAP; i++)
        if (is_there(&f, i))
            return hs_fail(err, HS_EXIT_FILE,
                           "%.200s: there is number %u, but not %u; number the files without a gap",
                           source, f.first + i, f.first + f.count);
    *frames = f;
    return true;
}
