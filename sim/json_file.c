/* SPDX-License-Identifier: Apache-2.0 */
#include "json_file.h"

#include <errno.h>

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
