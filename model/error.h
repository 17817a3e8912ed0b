/* SPDX-License-Identifier: Apache-2.0
 *
 * Errors are values: a place, a cause and a remedy in one sentence, and the exit code that the
 * tool ends with. Whoever finds the error fills it in and returns false; callers pass it up; it is
 * printed once, by main.
 */
#ifndef HS_ERROR_H
#define HS_ERROR_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hs_error {
    int code;       /* HS_EXIT_...; 0: no error */
    char text[600]; /* "cube.obj:12: face has 2 corners; a face needs 3 to 255" */
} hs_error;

/* Fills *err (printf style; cut at the end of text) and returns false. */
bool hs_fail(hs_error *err, int code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#ifdef __cplusplus
}
#endif
#endif
