/* SPDX-License-Identifier: Apache-2.0
 *
 * How programs that measure end when something fails: with its message, behind PROGRAM, which they
 * define first, and with its exit code.
 */
#ifndef HS_TEST_QUIT_H
#define HS_TEST_QUIT_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "definitions.h"
#include "error.h"

static inline void quit_on(bool good, const hs_error *err) {
    if (good) return;
    fprintf(stderr, "%s: %s\n", PROGRAM, err->text);
    exit(err->code ? err->code : HS_EXIT_INTERNAL);
}

#endif
