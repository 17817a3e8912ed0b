/* SPDX-License-Identifier: Apache-2.0
 *
 * JSON in files.
 */
#ifndef HS_JSON_FILE_H
#define HS_JSON_FILE_H

#include <jansson.h>

#include "file.h"

/* Writes a value and a line's end, and ends the file: false, and the target is as it was, unless
 * all of it was written. flags are json_dumpf's. */
bool hs_json_commit(const json_t *value, size_t flags, hs_file *file, hs_error *err);

#endif
