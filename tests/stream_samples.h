/* SPDX-License-Identifier: Apache-2.0
 *
 * What tests of packets share: a cube, output packets made by hand.
 */
#ifndef HS_TESTS_STREAM_SAMPLES_H
#define HS_TESTS_STREAM_SAMPLES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "golden.h"
#include "stream.h"

static const float cube_position[8][4] = {{-1, -1, -1, 1}, {1, -1, -1, 1}, {-1, 1, -1, 1},
                                          {1, 1, -1, 1},   {-1, -1, 1, 1}, {1, -1, 1, 1},
                                          {-1, 1, 1, 1},   {1, 1, 1, 1}};
static const uint32_t cube_sides[6] = {4, 4, 4, 4, 4, 4};
static const uint32_t cube_corner[24] = {4, 5, 7, 6, 1, 0, 2, 3, 5, 1, 3, 7,
                                         0, 4, 6, 2, 6, 7, 3, 2, 0, 1, 5, 4};
static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static inline void make_cube(hs_mesh *mesh) {
    hs_error err;
    hs_soup soup = {.name = "cube",
                    .vertices = 8,
                    .position = cube_position[0],
                    .faces = 6,
                    .sides = cube_sides,
                    .corner = cube_corner};
    assert_true(hs_mesh_build(mesh, &soup, NULL, &err));
}

static inline void put(hs_packet *packet, uint32_t w0, uint32_t w1, uint32_t w2, uint32_t w3) {
    hs_error err;
    const uint32_t record[4] = {w0, w1, w2, w3};
    assert_true(hs_packet_append(packet, record, 1, &err));
}

/* A record with up to four vertex numbers. */
static inline void put_numbers(hs_packet *packet, uint32_t w0, uint32_t a, uint32_t b, uint32_t c,
                               uint32_t d) {
    put(packet, w0, a | b << 24, b >> 8 | c << 16, c >> 16 | d << 8);
}

static inline void put_positions(hs_packet *packet, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        put(packet, 0x3f000000 + i, 0xbf000000, 0x3e800000, 0x3f800000);
}

static inline void fix_crc(hs_packet *packet) {
    packet->word[packet->words - 1] = hs_packet_crc(packet);
}

static inline void put_end(hs_packet *packet, uint32_t generation, uint32_t triangles) {
    put(packet, hs_tag(HS_RECORD_END, generation), triangles, 0, 0);
    fix_crc(packet);
}

/* Every kind of record: a triangle and a 9-gon of generation 0, a cut triangle and a quad of
 * generation 1, a quad of the last step between two faces of the step before.
 * Words where the records begin are in the comments. */
static inline void make_sample(hs_packet *packet) {
    *packet = (hs_packet){.view = 7};
    put(packet, hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), 7, 1, 0);                   /* 0 */
    put_numbers(packet, hs_tag(HS_RECORD_VERTICES, 4 << 16), 0, 0xabcdef, 0xffffff, 17); /* 4 */
    put_positions(packet, 4);                                                            /* 8 */
    put_numbers(packet, hs_tag(HS_RECORD_VERTICES, 4 << 16), 21, 22, 23, 24);            /* 24 */
    put_positions(packet, 4);                                                            /* 28 */
    put_numbers(packet, hs_tag(HS_RECORD_VERTICES, 1 << 16), 25, 0, 0, 0);               /* 44 */
    put_positions(packet, 1);                                                            /* 48 */
    put_numbers(packet, hs_tag(HS_RECORD_FACE, 1 << 16 | 3 << 8), 17, 0xffffff, 0, 0);   /* 52 */
    put_numbers(packet, hs_tag(HS_RECORD_FACE, 1 << 16 | 9 << 8), 0, 0xabcdef, 0xffffff, 17);
    put_numbers(packet, hs_tag(HS_RECORD_MORE, 4 << 8), 21, 22, 23, 24);              /* 60 */
    put_numbers(packet, hs_tag(HS_RECORD_MORE, 1 << 8), 25, 0, 0, 0);                 /* 64 */
    put_numbers(packet, hs_tag(HS_RECORD_VERTICES, 2 << 16 | 1), 26, 27, 0, 0);       /* 68 */
    put_positions(packet, 2);                                                         /* 72 */
    put_numbers(packet, hs_tag(HS_RECORD_FACE, 3 << 8 | 1), 25, 26, 27, 0);           /* 80 */
    put_numbers(packet, hs_tag(HS_RECORD_FACE, 4 << 8 | 2), 21, 26, 22, 27);          /* 84 */
    put_numbers(packet, hs_tag(HS_RECORD_FACE, 1 << 16 | 4 << 8 | 1), 21, 22, 23, 0); /* 88 */
    put(packet, hs_tag(HS_RECORD_TRAILER, HS_STATUS_OK), HS_NO_POSITION, 11, 5);      /* 92 */
    put_end(packet, 2, 2);                                                            /* 96 */
}

static inline void make_refused(hs_packet *packet) {
    *packet = (hs_packet){.view = 7};
    put(packet, hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), 7, 0, 0);
    put(packet, hs_tag(HS_RECORD_TRAILER, HS_STATUS_BAD_CRC), 123, 0, 0);
    put_end(packet, 0, 0);
}

#endif
