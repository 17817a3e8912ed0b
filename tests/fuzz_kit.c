/* SPDX-License-Identifier: Apache-2.0
 *
 * What the targets share, and their list.
 */
#include "fuzz.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const fuzz_target *const fuzz_targets[] = {
    &fuzz_obj,      &fuzz_views, &fuzz_trace,  &fuzz_text,    &fuzz_journal,
    &fuzz_expected, &fuzz_input, &fuzz_output, &fuzz_surface, NULL};

void fuzz_claim(bool holds, const char *format, ...) {
    if (holds) return;
    va_list arguments;
    va_start(arguments, format);
    fputs("fuzz: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    abort();
}

void fuzz_claim_error(const hs_error *err, int code, const char *place) {
    fuzz_claim(err->code == code, "code %d: %s", err->code, err->text);
    fuzz_claim(strncmp(err->text, place, strlen(place)) == 0, "no place: %s", err->text);
    for (const char *c = err->text; *c; c++)
        fuzz_claim(!iscntrl((unsigned char)*c), "0x%02x in: %s", (unsigned)*c & 0xff, err->text);
}

char *fuzz_copy(const uint8_t *bytes, size_t size) {
    char *copy = malloc(size + 1);
    fuzz_claim(copy != NULL, "no memory");
    if (size) memcpy(copy, bytes, size);
    copy[size] = 0;
    return copy;
}

static char folder[64];

static void remove_folder(void) {
    char line[100];
    snprintf(line, sizeof line, "rm -r %s", folder);
    if (system(line)) fprintf(stderr, "fuzz: %s is left\n", folder);
}

const char *fuzz_path(const char *name) {
    static char path[4][160];
    static unsigned turn;
    if (!*folder) {
        snprintf(folder, sizeof folder, "/tmp/halfstep-fuzz-XXXXXX");
        fuzz_claim(mkdtemp(folder) != NULL, "%s: cannot be made", folder);
        atexit(remove_folder);
    }
    char *text = path[turn++ % 4];
    snprintf(text, sizeof path[0], "%s%s%s", folder, *name ? "/" : "", name);
    return text;
}
