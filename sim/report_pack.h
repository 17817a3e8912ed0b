/* SPDX-License-Identifier: Apache-2.0
 *
 * Binary data inside JSON, for the page of halfstep report: numbers as variable-length bytes, then
 * deflate (zlib's format), then base64. sim/report/unpack.js reads it.
 */
#ifndef HS_REPORT_PACK_H
#define HS_REPORT_PACK_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Bytes that grow; {0} to begin with. exhausted: memory was, and what came later is missing. */
typedef struct hs_bytes {
    uint8_t *byte;
    size_t count, room;
    bool exhausted;
} hs_bytes;

void hs_bytes_add(hs_bytes *bytes, uint8_t byte);

/* A number in groups of seven bits, the lowest first; all groups but the last have bit 7 set. */
void hs_bytes_number(hs_bytes *bytes, uint32_t number);

/* A difference as a number: 0, -1, 1, -2, 2, ... are 0, 1, 2, 3, 4, ... */
void hs_bytes_difference(hs_bytes *bytes, int32_t difference);

void hs_bytes_free(hs_bytes *bytes);

/* The bytes as a JSON string: deflated, in base64. NULL if memory is exhausted, or was before. */
json_t *hs_bytes_json(const hs_bytes *bytes);

/* Bytes as they are as a JSON string: prefix, then base64. NULL if memory is exhausted. */
json_t *hs_base64_json(const char *prefix, const uint8_t *byte, size_t count);

#endif
