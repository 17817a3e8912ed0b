/* SPDX-License-Identifier: Apache-2.0 */
#include "json_file.h"

#include <errno.h>

void hs_json_set(json_t *object, const char *key, json_t *value, bool *good) {
    if (json_object_set_new(object, key, value) != 0) *good = false;
}

void hs_json_append(json_t *array, json_t *value, bool *good) {
    if (json_array_append_new(array, value) != 0) *good = false;
}

bool hs_json_commit(const json_t *value, size_t flags, hs_file *file, hs_error *err) {
    errno = 0;
    if (json_dumpf(value, file->stream, flags) == 0 && fputc('\n', file->stream) != EOF)
        return hs_file_commit(file, err);
    /* The stream took all that it was given: what failed is the making of it. */
    const int cause = ferror(file->stream) ? errno : ENOMEM;
    hs_file_unwritten(file->path, cause, err);
    hs_file_abandon(file);
    return false;
}
