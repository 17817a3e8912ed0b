/* SPDX-License-Identifier: Apache-2.0
 *
 * emit: the records of the output packet (docs/stream.md), in the order in which smooth and split
 * send vertices and faces. A position leaves as c = q 2^(E-30), rounded once to binary32.
 */
#include <string.h>

#include "arithmetic.h"
#include "golden_state.h"

static void append(hs_state *s, const uint32_t record[4]) {
    hs_packet *out = s->out;
    hs_error err;
    if (out->words + 4 <= out->capacity) { /* without a call */
        memcpy(out->word + out->words, record, 16);
        out->words += 4;
    } else if (!hs_packet_append(out, record, 1, &err)) {
        s->group = 0; /* none is open: its record is missing */
        s->exhausted = true;
    }
}

/* Adds vertex number k, 0 to 3, to the last three words of a record: 24 bits each. */
static void pack_number(uint32_t record[4], uint32_t k, uint32_t number) {
    record[1 + 3 * k / 4] |= number << 24 * k % 32;
    if (k == 1 || k == 2) record[2 + k / 2] |= number >> (k == 1 ? 8 : 16);
}

static void pack_numbers(uint32_t record[4], const uint32_t *number, uint32_t count) {
    record[1] = record[2] = record[3] = 0;
    for (uint32_t k = 0; k < count; k++)
        pack_number(record, k, number[k]);
}

static uint32_t float_bits(int32_t q, double unit) {
    const float c = hs_to_float(q, unit);
    uint32_t bits;
    memcpy(&bits, &c, sizeof bits);
    return bits;
}

void hs_emit_header(hs_state *s) {
    const uint32_t record[4] = {hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), s->out->view,
                                (uint32_t)s->exponent, 0};
    append(s, record);
    s->unit = hs_unit(s->exponent);
}

/* Adds the vertex to the open group, or opens one: consecutive vertices of one generation go out
 * four at a time behind the record of their numbers. */
void hs_emit_vertex(hs_state *s, uint32_t vertex, const int32_t position[4]) {
    if (s->group && s->group_count < 4 && (s->out->word[s->group] & 0xff) == s->generation) {
        uint32_t *open = s->out->word + s->group;
        pack_number(open, s->group_count++, vertex);
        open[0] += 1 << 16;
    } else {
        const uint32_t record[4] = {hs_tag(HS_RECORD_VERTICES, 1 << 16 | s->generation), vertex};
        s->group = s->out->words;
        s->group_count = 1;
        append(s, record);
    }
    uint32_t record[4];
    for (int k = 0; k < 4; k++)
        record[k] = float_bits(position[k], s->unit);
    append(s, record);
    s->vertices_sent++;
}

void hs_emit_face(hs_state *s, const uint32_t *vertex, uint32_t sides, uint32_t generation,
                  bool candidate) {
    uint32_t count = sides < 4 ? sides : 4;
    uint32_t record[4] = {
        hs_tag(HS_RECORD_FACE, (uint32_t)candidate << 16 | sides << 8 | generation)};
    pack_numbers(record, vertex, count);
    append(s, record);
    for (uint32_t i = count; i < sides; i += count) {
        count = sides - i < 4 ? sides - i : 4;
        record[0] = hs_tag(HS_RECORD_MORE, count << 8 | generation);
        pack_numbers(record, vertex + i, count);
        append(s, record);
    }
    s->group = 0;
    s->faces_sent++;
    s->triangles_sent += sides == 3;
}

void hs_emit_trailer(hs_state *s) {
    const uint32_t trailer[4] = {hs_tag(HS_RECORD_TRAILER, s->status), s->error_position,
                                 s->vertices_sent, s->faces_sent};
    append(s, trailer);
    if (s->exhausted) return;
    uint32_t end[4] = {hs_tag(HS_RECORD_END, s->generation), s->triangles_sent, s->at_level, 0};
    end[3] = hs_crc(hs_crc(0, s->out->word, s->out->words), end, 3);
    append(s, end);
}
