/* SPDX-License-Identifier: Apache-2.0
 *
 * A folder of a test's own under /tmp, and what lies in it.
 */
#ifndef HS_TEST_FOLDER_H
#define HS_TEST_FOLDER_H

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"

typedef struct folder {
    char path[64];
} folder;

static inline folder make_folder(void) {
    folder f;
    snprintf(f.path, sizeof f.path, "/tmp/halfstep-test-XXXXXX");
    assert_non_null(mkdtemp(f.path));
    return f;
}

static inline int remove_folder(const folder *f) {
    char line[100];
    snprintf(line, sizeof line, "rm -r %s", f->path);
    return system(line);
}

static inline char *inside(const folder *f, const char *name) {
    static char path[4][400];
    static unsigned turn;
    char *text = path[turn++ % 4];
    snprintf(text, 400, "%s/%s", f->path, name);
    return text;
}

/* A line with the folder in place of each @; it stays until the next one. */
static inline const char *with_folder(const folder *f, const char *line) {
    static char text[4000];
    size_t used = 0;
    for (const char *c = line; *c; c++) {
        assert_true(used + sizeof f->path < sizeof text);
        if (*c == '@')
            used += (size_t)snprintf(text + used, sizeof text - used, "%s", f->path);
        else
            text[used++] = *c;
    }
    text[used] = 0;
    return text;
}

static inline uint32_t count_entries(const folder *f) {
    uint32_t count = 0;
    DIR *all = opendir(f->path);
    assert_non_null(all);
    for (const struct dirent *entry; (entry = readdir(all)) != NULL;)
        count += entry->d_name[0] != '.';
    closedir(all);
    return count;
}

static inline void assert_content(const char *path, const char *wanted) {
    uint8_t *bytes;
    size_t size;
    hs_error err;
    if (!hs_file_read(path, 1000, &bytes, &size, &err)) fail_msg("%s", err.text);
    assert_string_equal((char *)bytes, wanted);
    assert_int_equal(size, strlen(wanted));
    free(bytes);
}

#endif
