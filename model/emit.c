/* SPDX-License-Identifier: Apache-2.0
 *
 * emit: the records of the output packet (docs/stream.md), in the order in which smooth and split
 * send vertices and faces. A position leaves as c = q 2^(E-30), rounded once to binary32.
 */
#include <math.h>
#include <string.h>

#include "golden_state.h"

static void append(hs_state *s, const uint32_t record[4]) {
    hs_error err;
    if (!hs_packet_append(s->out, record, 1, &err)) s->exhausted = true;
}

/* Up to four vertex numbers, 24 bits each, in the last three words of a record. */
static void pack_numbers(uint32_t record[4], const uint32_t *number, uint32_t count) {
    uint32_t n[4] = {0};
    for (uint32_t i = 0; i < count; i++)
        n[i] = number[i];
    record[1] = n[0] | n[1] << 24;
    record[2] = n[1] >> 8 | n[2] << 16;
    record[3] = n[2] >> 16 | n[3] << 8;
}

/* 32 bits fit a double, the scaling is exact or, for a subnormal result, deferred to the one
 * rounding of the conversion. */
static uint32_t float_bits(int32_t q, int32_t exponent) {
    float c = (float)ldexp((double)q, exponent - 30);
    uint32_t bits;
    memcpy(&bits, &c, sizeof bits);
    return bits;
}

void hs_emit_header(hs_state *s) {
    const uint32_t record[4] = {hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), s->out->view,
                                (uint32_t)s->exponent, 0};
    append(s, record);
}

/* Adds the vertex to the open group, or opens one: consecutive vertices of one generation go out
 * four at a time behind the record of their numbers. */
void hs_emit_vertex(hs_state *s, uint32_t vertex) {
    if (s->group) {
        uint32_t *open = s->out->word + s->group;
        uint32_t count = open[0] >> 16 & 0xf, number[4];
        if (count == 4 || (open[0] & 0xff) != s->generation) {
            s->group = 0;
        } else {
            number[0] = open[1] & 0xffffff;
            number[1] = open[1] >> 24 | (open[2] & 0xffff) << 8;
            number[2] = open[2] >> 16 | (open[3] & 0xff) << 16;
            number[count] = vertex;
            pack_numbers(open, number, count + 1);
            open[0] += 1 << 16;
        }
    }
    if (!s->group) {
        uint32_t record[4] = {hs_tag(HS_RECORD_VERTICES, 1 << 16 | s->generation)};
        pack_numbers(record, &vertex, 1);
        s->group = s->out->words;
        append(s, record);
    }
    uint32_t record[4];
    for (int k = 0; k < 4; k++)
        record[k] = float_bits(s->vertex[vertex].position[k], s->exponent);
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
    const uint32_t end[4] = {hs_tag(HS_RECORD_END, s->generation), s->triangles_sent, 0,
                             hs_crc(0, s->out->word, s->out->words)};
    append(s, end);
}
