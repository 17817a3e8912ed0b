/* SPDX-License-Identifier: Apache-2.0
 *
 * build/figures_page PAGE: draws the pictures of a page (sim/page.h) and renews the numbers in it.
 * `make figures` runs it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "definitions.h"
#include "file.h"
#include "page.h"

static bool renew(const char *path, hs_error *err) {
    uint8_t *text;
    size_t size;
    char *updated, scratch[] = "/tmp/halfstep-page-XXXXXX";
    hs_file file;
    if (!hs_file_read(path, 1 << 20, &text, &size, err)) return false;
    const int handle = mkstemp(scratch);
    bool done = handle >= 0 || hs_fail(err, HS_EXIT_FILE, "%s: cannot be made", scratch);
    done = done && hs_page_update(&updated, path, (char *)text, true, scratch, err);
    if (handle >= 0) {
        close(handle);
        remove(scratch);
    }
    free(text);
    if (!done) return false;
    done = hs_file_create(&file, path, err);
    if (done) {
        fputs(updated, file.stream);
        done = hs_file_commit(&file, err);
    }
    free(updated);
    return done;
}

int main(int argc, char **argv) {
    hs_error err = {0};
    if (argc != 2) {
        fprintf(stderr, "usage: %s PAGE\n", argv[0]);
        return HS_EXIT_USAGE;
    }
    if (renew(argv[1], &err)) return HS_EXIT_OK;
    fprintf(stderr, "%s\n", err.text);
    return err.code;
}
