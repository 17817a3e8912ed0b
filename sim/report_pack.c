/* SPDX-License-Identifier: Apache-2.0 */
#include "report_pack.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

void hs_bytes_add(hs_bytes *bytes, uint8_t byte) {
    if (bytes->exhausted) return;
    if (bytes->count == bytes->room) {
        const size_t room = bytes->room ? 2 * bytes->room : 4096;
        uint8_t *more = realloc(bytes->byte, room);
        bytes->exhausted = !more;
        if (!more) return;
        bytes->byte = more;
        bytes->room = room;
    }
    bytes->byte[bytes->count++] = byte;
}

void hs_bytes_number(hs_bytes *bytes, uint32_t number) {
    for (; number >= 0x80; number >>= 7)
        hs_bytes_add(bytes, (uint8_t)(number | 0x80));
    hs_bytes_add(bytes, (uint8_t)number);
}

void hs_bytes_difference(hs_bytes *bytes, int32_t difference) {
    const uint32_t twice = (uint32_t)difference << 1;
    hs_bytes_number(bytes, difference < 0 ? ~twice : twice);
}

void hs_bytes_free(hs_bytes *bytes) {
    free(bytes->byte);
    *bytes = (hs_bytes){0};
}

json_t *hs_base64_json(const char *prefix, const uint8_t *byte, size_t count) {
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t at = strlen(prefix);
    char *text = malloc(at + (count + 2) / 3 * 4 + 1);
    if (!text) return NULL;
    memcpy(text, prefix, at);
    for (size_t i = 0; i < count; i += 3) {
        const size_t rest = count - i;
        const uint32_t three = (uint32_t)byte[i] << 16 |
                               (rest > 1 ? (uint32_t)byte[i + 1] << 8 : 0) |
                               (rest > 2 ? byte[i + 2] : 0);
        text[at++] = digit[three >> 18];
        text[at++] = digit[three >> 12 & 63];
        text[at++] = rest > 1 ? digit[three >> 6 & 63] : '=';
        text[at++] = rest > 2 ? digit[three & 63] : '=';
    }
    text[at] = 0;
    json_t *json = json_stringn_nocheck(text, at);
    free(text);
    return json;
}

json_t *hs_bytes_json(const hs_bytes *bytes) {
    if (bytes->exhausted) return NULL;
    uLongf size = compressBound(bytes->count);
    uint8_t *packed = malloc(size);
    json_t *json = NULL;
    if (packed && compress2(packed, &size, bytes->byte, bytes->count, 9) == Z_OK)
        json = hs_base64_json("", packed, size);
    free(packed);
    return json;
}
