/* SPDX-License-Identifier: Apache-2.0
 *
 * The folder of each test: new when it begins, gone when it ends.
 */
#ifndef HS_TEST_PLACE_H
#define HS_TEST_PLACE_H

#include "folder.h"

static folder place;

static inline int new_place(void **state) {
    (void)state;
    place = make_folder();
    return 0;
}

static inline int leave_place(void **state) {
    (void)state;
    return remove_folder(&place);
}

/* Writes a text to a file in it. */
static inline void write_text(const char *name, const char *text) {
    FILE *file = fopen(inside(&place, name), "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

#endif
