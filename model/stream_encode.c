/* SPDX-License-Identifier: Apache-2.0
 *
 * Packets on their way in: a growing row of words, its CRC-32, the input packet of a view, and the
 * frames in which files keep packets. docs/stream.md defines every bit.
 *
 *   header 3 | matrix 4 | vertices V | corners H | trailer 1     (records of 4 words)
 */
#include "stream.h"

#include <assert.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "file.h"
#include "memory.h"

/* --- Words ------------------------------------------------------------------------------------ */

/* Makes room for words, at least doubling what there was: appending n words costs O(n). */
static bool reserve(hs_packet *packet, size_t words, hs_error *err) {
    if (words <= packet->capacity) return true;
    size_t capacity = packet->capacity > SIZE_MAX / 2 ? words : 2 * packet->capacity;
    if (capacity < words) capacity = words;
    if (capacity < 64) capacity = 64;
    uint32_t *word = capacity > SIZE_MAX / sizeof *word
                         ? NULL
                         : hs_reallocate(packet->word, capacity * sizeof *word);
    if (!word) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for a packet of %zu words", words);
    packet->word = word;
    packet->capacity = capacity;
    return true;
}

bool hs_packet_append(hs_packet *packet, const uint32_t *record, size_t records, hs_error *err) {
    if (records == 0) return true;
    if (records > (SIZE_MAX - packet->words) / 4)
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for a packet of %zu more records",
                       records);
    if (!reserve(packet, packet->words + 4 * records, err)) return false;
    memcpy(packet->word + packet->words, record, 4 * records * sizeof *record);
    packet->words += 4 * records;
    return true;
}

void hs_packet_free(hs_packet *packet) {
    free(packet->word);
    *packet = (hs_packet){0};
}

static void store_little_endian(uint8_t bytes[4], uint32_t word) {
    for (int i = 0; i < 4; i++)
        bytes[i] = (uint8_t)(word >> 8 * i);
}

static uint32_t load_little_endian(const uint8_t bytes[4]) {
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

/* Little-endian copy of as many words as fit a small buffer; returns how many. */
enum { CHUNK_WORDS = 1024, MOST_AT_ONCE = 1 << 28 };
static size_t chunk_of_words(uint8_t bytes[4 * CHUNK_WORDS], const uint32_t *word, size_t words) {
    size_t count = words < CHUNK_WORDS ? words : CHUNK_WORDS;
    for (size_t i = 0; i < count; i++)
        store_little_endian(bytes + 4 * i, word[i]);
    return count;
}

uint32_t hs_crc(uint32_t crc, const uint32_t *word, size_t words) {
    uint8_t buffer[4 * CHUNK_WORDS];
    const bool little = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__; /* words lie as they are sent */
    for (size_t done = 0; done < words;) {
        const uint8_t *bytes = buffer;
        size_t count = words - done;
        if (little) {
            bytes = (const uint8_t *)(word + done);
            if (count > MOST_AT_ONCE) count = MOST_AT_ONCE;
        } else {
            count = chunk_of_words(buffer, word + done, count);
        }
        crc = (uint32_t)crc32(crc, bytes, (uInt)(4 * count));
        done += count;
    }
    return crc;
}

uint32_t hs_packet_crc(const hs_packet *packet) {
    return packet->words ? hs_crc(0, packet->word, packet->words - 1) : 0;
}

size_t hs_packet_find(const hs_packet *packet, uint32_t kind) {
    for (size_t at = 0; at + 4 <= packet->words; at += 4)
        if (packet->word[at] >> 20 == hs_tag(kind, 0) >> 20) return at;
    return SIZE_MAX;
}

/* --- The input packet of a view --------------------------------------------------------------- */

static uint32_t *put_record(uint32_t *at, uint32_t w0, uint32_t w1, uint32_t w2, uint32_t w3) {
    at[0] = w0, at[1] = w1, at[2] = w2, at[3] = w3;
    return at + 4;
}

bool hs_packet_encode(hs_packet *packet, uint32_t view, const hs_mesh *mesh, const float matrix[16],
                      const hs_settings *settings, hs_error *err) {
    /* Below 2^35 words, whatever the mesh. */
    uint64_t records = (uint64_t)HS_HEADER_RECORDS + HS_MATRIX_RECORDS + mesh->vertices +
                       (uint64_t)mesh->halfedges + 1;
    packet->words = 0;
    packet->view = view;
    if (records > SIZE_MAX / 16 || !reserve(packet, 4 * (size_t)records, err))
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the input packet of view %u", view);

    const uint32_t flags = (settings->uniform ? HS_FLAG_UNIFORM : 0u) |
                           (settings->guard ? HS_FLAG_GUARD : 0u) |
                           (settings->limit ? HS_FLAG_LIMIT : 0u) |
                           (settings->boundary == HS_BOUNDARY_SMOOTH      ? HS_FLAG_SMOOTH
                            : settings->boundary == HS_BOUNDARY_EDGE_ONLY ? HS_FLAG_EDGE_ONLY
                                                                          : 0u);
    uint32_t depths = settings->front_depth | (uint32_t)settings->silhouette_depth << 8 |
                      (uint32_t)settings->uniform_depth << 16;
    uint32_t *at = packet->word;
    at = put_record(at, HS_MAGIC_VIEW, HS_STREAM_VERSION, flags, mesh->vertices);
    at = put_record(at, mesh->faces, mesh->halfedges, depths, 0);
    at = put_record(at, settings->min_edge, settings->width | (uint32_t)settings->height << 16, 0,
                    0);

    memcpy(at, matrix, 4 * 4 * HS_MATRIX_RECORDS);
    at += 4 * HS_MATRIX_RECORDS;
    if (mesh->vertices) memcpy(at, mesh->position, 16 * (size_t)mesh->vertices);
    at += 4 * (size_t)mesh->vertices;

    for (uint32_t f = 0; f < mesh->faces; f++) {
        uint32_t sides = hs_sides(mesh, f), forced = mesh->forced ? mesh->forced[f] : 0;
        for (uint32_t h = mesh->first[f]; h < mesh->first[f + 1]; h++) {
            uint32_t corner = h - mesh->first[f];
            uint32_t sharpness = mesh->sharpness ? mesh->sharpness[h] : 0;
            if (mesh->vertex_sharpness)
                sharpness |= (uint32_t)mesh->vertex_sharpness[mesh->origin[h]] << 4;
            at = put_record(at, mesh->origin[h], mesh->twin[h],
                            (sides & 0xff) | forced << 8 | (corner & 0xff) << 16, sharpness);
        }
    }

    at = put_record(at, HS_MAGIC_END, 0, 0, 0);
    at[-1] = hs_crc(0, packet->word, (size_t)(at - packet->word) - 1);
    packet->words = (size_t)(at - packet->word);
    assert(packet->words == 4 * records);
    return true;
}

/* --- Frames: packets in a file ---------------------------------------------------------------- */

bool hs_frame_read(hs_packet *packet, const uint8_t *bytes, size_t size, size_t *offset,
                   const char *name, hs_error *err) {
    packet->words = 0;
    size_t at = *offset, left = at < size ? size - at : 0;
    if (left < 16)
        return hs_fail(err, HS_EXIT_STREAM,
                       "%s: byte %zu: the file ends inside a frame record, %zu of 16 bytes are "
                       "left; write the file again",
                       name, at, left);
    uint32_t frame[4];
    for (size_t i = 0; i < 4; i++)
        frame[i] = load_little_endian(bytes + at + 4 * i);
    if (frame[0] != HS_MAGIC_FRAME)
        return hs_fail(err, HS_EXIT_STREAM,
                       "%s: byte %zu: 0x%08x is not the frame's magic word (the bytes HS2F); give "
                       "a halfstep stream file",
                       name, at, frame[0]);
    if (frame[1] > 0xffff)
        return hs_fail(err, HS_EXIT_STREAM,
                       "%s: byte %zu: view %u; a view's number has 16 bits, correct the frame",
                       name, at + 4, frame[1]);
    if (frame[2] == 0 || frame[2] % 4)
        return hs_fail(err, HS_EXIT_STREAM,
                       "%s: byte %zu: a packet of %u words; a packet is one or more records of 4 "
                       "words, correct the frame",
                       name, at + 8, frame[2]);
    if (frame[3])
        return hs_fail(err, HS_EXIT_STREAM,
                       "%s: byte %zu: the frame's last word is 0x%08x; set it to zero", name,
                       at + 12, frame[3]);
    at += 16, left -= 16;
    if (frame[2] > left / 4)
        return hs_fail(err, HS_EXIT_STREAM,
                       "%s: byte %zu: the file ends inside a packet of %u words, %zu bytes are "
                       "left; write the file again",
                       name, at, frame[2], left);
    if (!reserve(packet, frame[2], err)) return false;
    for (size_t i = 0; i < frame[2]; i++)
        packet->word[i] = load_little_endian(bytes + at + 4 * i);
    packet->view = frame[1];
    packet->words = frame[2];
    *offset = at + 4 * (size_t)frame[2];
    return true;
}

bool hs_frame_write(FILE *file, const hs_packet *packet, const char *name, hs_error *err) {
    if (packet->view > 0xffff || packet->words == 0 || packet->words % 4 ||
        packet->words > UINT32_MAX)
        return hs_fail(err, HS_EXIT_STREAM,
                       "%s: view %u with a packet of %zu words does not fit a frame; a view's "
                       "number has 16 bits, a packet is one or more records of 4 words",
                       name, packet->view, packet->words);
    uint32_t frame[4] = {HS_MAGIC_FRAME, packet->view, (uint32_t)packet->words, 0};
    uint8_t bytes[4 * CHUNK_WORDS];
    size_t count = chunk_of_words(bytes, frame, 4);
    bool written = fwrite(bytes, 4, count, file) == count;
    for (size_t done = 0; written && done < packet->words; done += count) {
        count = chunk_of_words(bytes, packet->word + done, packet->words - done);
        written = fwrite(bytes, 4, count, file) == count;
    }
    return written || hs_file_unwritten(name, errno, err);
}
