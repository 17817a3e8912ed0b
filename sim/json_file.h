/* SPDX-License-Identifier: Apache-2.0
 *
 * JSON, and JSON in files.
 */
#ifndef HS_JSON_FILE_H
#define HS_JSON_FILE_H

#include <jansson.h>

#include "file.h"

/* Take value over, as json_object_set_new and json_array_append_new do. *good becomes false if they
 * cannot, or if value is NULL, which is what jansson's makers give without memory: so one flag
 * tells whether a whole document could be made. */
void hs_json_set(json_t *object, const char *key, json_t *value, bool *good);
void hs_json_append(json_t *array, json_t *value, bool *good);

/* Writes a value and a line's end, and ends the file: false, and the target is as it was, unless
 * all of it was written. flags are json_dumpf's. */
bool hs_json_commit(const json_t *value, size_t flags, hs_file *file, hs_error *err);

#endif
