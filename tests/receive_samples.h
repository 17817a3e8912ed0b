/* SPDX-License-Identifier: Apache-2.0
 *
 * What the tests of the receive stage share: small packets, how they are sent, and what a good or a
 * bad one is expected to become.
 */
#ifndef HS_TESTS_RECEIVE_SAMPLES_H
#define HS_TESTS_RECEIVE_SAMPLES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "receive_bench.h"

enum { INFINITE = 0x7f800000, NOT_A_NUMBER = 0xffc00001, HUGE = 0x7f000000 };

static const uint32_t ports[] = {1, 2, 4};
static const receive_send plainly = {
    .limit_vertices = RECEIVE_VERTICES, .limit_quads = RECEIVE_QUADS, .start_cycle = 3};

/* --- Packets ---------------------------------------------------------------------------------- */

/* Words: where the matrix and the vertices begin. */
enum { MATRIX = 12, VERTEX = 28 };

static inline void mend_crc(hs_packet *packet) {
    packet->word[packet->words - 1] = hs_packet_crc(packet);
}

/* Sharpnesses of every kind: of each edge the same on both sides, of the vertices any. */
static inline void sharpen(hs_packet *packet) {
    static const uint32_t kinds[] = {0, 1, 5, 8, 9, 15};
    uint32_t *c = packet->word + VERTEX + 4 * (size_t)packet->word[3];
    for (uint32_t h = 0; h < packet->word[5]; h++, c += 4)
        c[3] = kinds[(c[1] < h ? c[1] : h) % 6] | kinds[h / 2 % 6] << 4;
    mend_crc(packet);
}

/* The half-edge structure of a face list with made-up positions and sharpnesses, and a forced depth
 * on face 1. */
static inline hs_packet packet_of(uint32_t vertices, uint32_t faces, const uint32_t *sides,
                                  const uint32_t *corner) {
    float *position = calloc((size_t)vertices * 4, sizeof *position);
    assert_non_null(position);
    for (uint32_t i = 0; i < vertices * 4; i++)
        position[i] = (float)((i * 37 + 11) % 64) / 8 - 3;
    hs_soup soup = {.name = "test",
                    .vertices = vertices,
                    .position = position,
                    .faces = faces,
                    .sides = sides,
                    .corner = corner};
    hs_error err = {0};
    hs_mesh mesh;
    if (!hs_mesh_build(&mesh, &soup, NULL, &err)) fail_msg("%s", err.text);
    if (faces > 1) mesh.forced[1] = 7;
    float matrix[16];
    for (int i = 0; i < 16; i++)
        matrix[i] = (float)(i % 5) - 1.5f;
    hs_settings settings = {.front_depth = 4,
                            .silhouette_depth = 8,
                            .uniform_depth = 250,
                            .guard = true,
                            .min_edge = 24,
                            .width = 0xfedc,
                            .height = 480};
    hs_packet packet = {0};
    assert_true(hs_packet_encode(&packet, 0xabcd, &mesh, matrix, &settings, &err));
    hs_mesh_free(&mesh);
    free(position);
    sharpen(&packet);
    return packet;
}

/* Closed, with faces of 4 and 3 sides: V = 5, F = 5, H = 16, 29 records. */
static inline hs_packet pyramid(void) {
    static const uint32_t sides[] = {4, 3, 3, 3, 3};
    static const uint32_t corner[] = {0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    return packet_of(5, 5, sides, corner);
}
/* Where its parts begin, in words. */
enum { PYRAMID_CORNER = 48, PYRAMID_END = 112, PYRAMID_WORDS = 116 };
#define CORNER(h, k) (PYRAMID_CORNER + 4 * (h) + (k)) /* word k of half-edge h */

/* Closed, V = 8, F = 6, H = 24: room for a face count that is too high. */
static inline hs_packet cube(void) {
    static const uint32_t sides[] = {4, 4, 4, 4, 4, 4};
    static const uint32_t corner[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4,
                                      1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
    return packet_of(8, 6, sides, corner);
}

/* The least mesh: one triangle, all border. */
static inline hs_packet triangle(void) {
    static const uint32_t sides[] = {3}, corner[] = {0, 1, 2};
    return packet_of(3, 1, sides, corner);
}

/* Two faces of 255 sides, back to back. */
static inline hs_packet pillow(void) {
    static const uint32_t sides[] = {255, 255};
    uint32_t corner[510];
    for (uint32_t i = 0; i < 255; i++) {
        corner[i] = i;
        corner[255 + i] = 254 - i;
    }
    return packet_of(255, 2, sides, corner);
}

/* Of an edge or a vertex. */
static inline bool good_sharpness(uint32_t s) {
    return s <= 9 || s == 15;
}

/* --- Expectations ----------------------------------------------------------------------------- */

static receive_result result; /* large; filled anew by every run */

/* The header, every vertex and every corner are what the packet's words say. */
static inline void assert_taken_apart(const hs_packet *packet, const receive_result *r) {
    const uint32_t *w = packet->word;
    assert_true(r->finished);
    assert_int_equal(r->wrong_cycles, 0);
    assert_int_equal(r->status, HS_STATUS_OK);
    assert_int_equal(r->position, HS_NO_POSITION);
    assert_int_equal(r->view, packet->view);
    assert_int_equal(r->uniform, w[2] & 1);
    assert_int_equal(r->guard, w[2] >> 1 & 1);
    assert_int_equal(r->limit, w[2] >> 2 & 1);
    assert_int_equal(r->corners_stay, w[2] >> 3 & 1);
    assert_int_equal(r->kept, (w[2] >> 3 & 3) == 0);
    assert_int_equal(r->vertices, w[3]);
    assert_int_equal(r->faces, w[4]);
    assert_int_equal(r->halfedges, w[5]);
    assert_int_equal(r->front_depth, w[6] & 0xff);
    assert_int_equal(r->silhouette_depth, w[6] >> 8 & 0xff);
    assert_int_equal(r->uniform_depth, w[6] >> 16 & 0xff);
    assert_int_equal(r->min_edge, w[8]);
    assert_int_equal(r->width, w[9] & 0xffff);
    assert_int_equal(r->height, w[9] >> 16);
    assert_memory_equal(r->matrix, w + MATRIX, sizeof r->matrix);
    assert_int_equal(r->not_in_order, 0);
    assert_int_equal(r->vertices_done, 1);
    assert_int_equal(r->vertices_stored, w[3]);
    assert_memory_equal(r->vertex, w + VERTEX, (size_t)w[3] * 16);
    assert_int_equal(r->corners_stored, w[5]);

    uint32_t face = 0, forced_max = 0, twinless = 0;
    const uint32_t *c = w + VERTEX + 4 * (size_t)w[3];
    for (uint32_t h = 0; h < w[5]; h++, c += 4) {
        const receive_corner *corner = &r->corner[h];
        uint32_t sides = c[2] & 0xff, forced = c[2] >> 8 & 0xff, number = c[2] >> 16;
        assert_int_equal(corner->origin, c[0]);
        assert_int_equal(corner->twin, c[1]);
        assert_int_equal(corner->face, face);
        assert_int_equal(corner->forced, forced);
        assert_int_equal(corner->first, number == 0);
        assert_int_equal(corner->last, number + 1 == sides);
        assert_int_equal(corner->border, c[1] == HS_BORDER && r->kept);
        assert_int_equal(corner->boundary, c[1] == HS_BORDER && !r->kept);
        assert_int_equal(corner->sharpness, c[1] == HS_BORDER ? 0 : c[3] & 15);
        assert_int_equal(corner->own, c[3] >> 4);
        face += number + 1 == sides;
        if (forced > forced_max) forced_max = forced;
        twinless += c[1] == HS_BORDER;
    }
    assert_int_equal(r->forced_max, forced_max);
    assert_int_equal(r->closed, twinless == 0);
    assert_int_equal(r->boundary_count, r->kept ? 0 : twinless);
}

/* Every cycle has one activity at most, and every record goes in and out once. */
static inline void assert_counted(const receive_result *r, size_t records) {
    assert_int_equal(r->busy, records);
    assert_int_equal(r->items_in, records);
    assert_int_equal(r->items_out, records);
    assert_int_equal(r->blocked, 0);
    assert_true(r->busy + r->starved <= r->cycles);
}

/* The packet is refused with this status at this word; a good one behind it is taken apart. */
static inline void assert_refused_by(receive_bench *bench, const hs_packet *packet, uint32_t status,
                                     size_t position, const receive_send *send) {
    receive_bench_run(bench, packet, send, &result);
    assert_true(result.finished);
    assert_int_equal(result.wrong_cycles, 0);
    assert_string_equal(hs_status_name(result.status), hs_status_name(status));
    assert_int_equal(result.position, position);
    assert_int_equal(result.view, packet->view);
    assert_counted(&result, packet->words / 4);

    hs_packet good = pyramid();
    receive_bench_run(bench, &good, &plainly, &result);
    assert_taken_apart(&good, &result);
    hs_packet_free(&good);
}

static inline void assert_refused(const hs_packet *packet, uint32_t status, size_t position) {
    for (size_t p = 0; p < 3; p++) {
        receive_bench *bench = receive_bench_new(ports[p], 1);
        assert_non_null(bench);
        receive_send send = plainly;
        assert_refused_by(bench, packet, status, position, &send);
        send.pause = 60;
        send.seed = (uint32_t)position;
        send.start_cycle = 0;
        assert_refused_by(bench, packet, status, position, &send);
        receive_bench_free(bench);
    }
}

#endif
