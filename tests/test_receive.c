/* SPDX-License-Identifier: Apache-2.0
 *
 * The receive stage (rtl/receive.sv): does it hand on exactly what a packet says, does it find the
 * first offending word, and is the packet after a bad one none the worse? Every check is made with
 * 1, 2 and 4 records a beat; every bad packet is followed by a good one.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "golden.h"
#include "mesh.h"
#include "receive_bench.h"

enum { INFINITE = 0x7f800000, NOT_A_NUMBER = 0xffc00001, HUGE = 0x7f000000 };

static const uint32_t ports[] = {1, 2, 4};
static const receive_send plainly = {
    .limit_vertices = RECEIVE_VERTICES, .limit_quads = RECEIVE_QUADS, .start_cycle = 3};

/* --- Packets ---------------------------------------------------------------------------------- */

/* Words: where the matrix and the vertices begin. */
enum { MATRIX = 12, VERTEX = 28 };

static void mend_crc(hs_packet *packet) {
    packet->word[packet->words - 1] = hs_crc(0, packet->word, packet->words - 4);
}

/* Sharpnesses of every kind: of each edge the same on both sides, of the vertices any. */
static void sharpen(hs_packet *packet) {
    static const uint32_t kinds[] = {0, 1, 5, 8, 9, 15};
    uint32_t *c = packet->word + VERTEX + 4 * (size_t)packet->word[3];
    for (uint32_t h = 0; h < packet->word[5]; h++, c += 4)
        c[3] = kinds[(c[1] < h ? c[1] : h) % 6] | kinds[h / 2 % 6] << 4;
    mend_crc(packet);
}

/* The half-edge structure of a face list with made-up positions and sharpnesses, and a forced depth
 * on face 1. */
static hs_packet packet_of(uint32_t vertices, uint32_t faces, const uint32_t *sides,
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
static hs_packet pyramid(void) {
    static const uint32_t sides[] = {4, 3, 3, 3, 3};
    static const uint32_t corner[] = {0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    return packet_of(5, 5, sides, corner);
}
/* Where its parts begin, in words. */
enum { PYRAMID_CORNER = 48, PYRAMID_END = 112, PYRAMID_WORDS = 116 };

/* Closed, V = 8, F = 6, H = 24: room for a face count that is too high. */
static hs_packet cube(void) {
    static const uint32_t sides[] = {4, 4, 4, 4, 4, 4};
    static const uint32_t corner[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4,
                                      1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
    return packet_of(8, 6, sides, corner);
}

/* The least mesh: one triangle, all border. */
static hs_packet triangle(void) {
    static const uint32_t sides[] = {3}, corner[] = {0, 1, 2};
    return packet_of(3, 1, sides, corner);
}

/* Two faces of 255 sides, back to back. */
static hs_packet pillow(void) {
    static const uint32_t sides[] = {255, 255};
    uint32_t corner[510];
    for (uint32_t i = 0; i < 255; i++) {
        corner[i] = i;
        corner[255 + i] = 254 - i;
    }
    return packet_of(255, 2, sides, corner);
}

/* --- Expectations ----------------------------------------------------------------------------- */

static receive_result result; /* large; filled anew by every run */

/* The header, every vertex and every corner are what the packet's words say. */
static void assert_taken_apart(const hs_packet *packet, const receive_result *r) {
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
static void assert_counted(const receive_result *r, size_t records) {
    assert_int_equal(r->busy, records);
    assert_int_equal(r->items_in, records);
    assert_int_equal(r->items_out, records);
    assert_int_equal(r->blocked, 0);
    assert_true(r->busy + r->starved <= r->cycles);
}

/* The packet is refused with this status at this word; a good one behind it is taken apart. */
static void assert_refused_by(receive_bench *bench, const hs_packet *packet, uint32_t status,
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

static void assert_refused(const hs_packet *packet, uint32_t status, size_t position) {
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

/* --- Good packets ------------------------------------------------------------------------------
 */

static void a_good_packet_is_taken_apart_whatever_the_pauses(void **state) {
    (void)state;
    hs_packet packet[] = {pyramid(), triangle(), pillow(), cube()};
    for (size_t p = 0; p < 3; p++) {
        receive_bench *bench = receive_bench_new(ports[p], 7);
        for (uint32_t round = 0; round < 24; round++) {
            const hs_packet *one = &packet[round % 4];
            receive_send send = plainly;
            send.pause = (uint8_t)(round * 4);
            send.seed = round;
            send.start_cycle = round % 5;
            receive_bench_run(bench, one, &send, &result);
            assert_taken_apart(one, &result);
            assert_counted(&result, one->words / 4);
        }
        receive_bench_free(bench);
    }
    for (size_t i = 0; i < 4; i++)
        hs_packet_free(&packet[i]);
}

/* One cycle for the first beat, one a record, one to drain, done_o's. */
static void a_record_is_taken_in_every_cycle(void **state) {
    (void)state;
    hs_packet packet = pillow();
    for (size_t p = 0; p < 3; p++) {
        receive_bench *bench = receive_bench_new(ports[p], 3);
        receive_bench_run(bench, &packet, &plainly, &result);
        assert_int_equal(result.starved, 0);
        assert_int_equal(result.cycles, packet.words / 4 + 3);
        receive_bench_free(bench);
    }
    hs_packet_free(&packet);
}

/* Of a closed mesh and of one with a boundary only. */
static void flags_and_depths_come_through(void **state) {
    (void)state;
    hs_packet packet[] = {pyramid(), triangle()};
    receive_bench *bench = receive_bench_new(4, 3);
    for (uint32_t round = 0; round < 2 * 24; round++) {
        hs_packet *one = &packet[round % 2];
        uint32_t flags = round / 2; /* up to 23, so that not both modes are set */
        one->word[2] = flags;
        one->word[6] = 0xfa | flags << 8 | (250 - flags) << 16;
        mend_crc(one);
        receive_bench_run(bench, one, &plainly, &result);
        assert_taken_apart(one, &result);
    }
    receive_bench_free(bench);
    for (size_t i = 0; i < 2; i++)
        hs_packet_free(&packet[i]);
}

static void least_edge_and_picture_come_through(void **state) {
    (void)state;
    static const uint32_t words[][2] = {{0, 0},
                                        {0, 640},
                                        {0, 480u << 16},
                                        {1, 0x10001},
                                        {0xffff, 0xffffffff},
                                        {0x8001, 0x80010002}};
    hs_packet packet = pyramid();
    receive_bench *bench = receive_bench_new(1, 3);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        memcpy(packet.word + 8, words[i], sizeof *words);
        mend_crc(&packet);
        receive_bench_run(bench, &packet, &plainly, &result);
        assert_taken_apart(&packet, &result);
    }
    receive_bench_free(bench);
    hs_packet_free(&packet);
}

static bool good_sharpness(uint32_t s) {
    return s <= 9 || s == 15;
}

/* All 256 pairs of sharpnesses, on a corner with a twin and on one without. */
static void sharpnesses_are_0_to_9_or_15(void **state) {
    (void)state;
    hs_packet packet[] = {pyramid(), triangle()};
    const size_t w3[] = {PYRAMID_CORNER + 4 * 6 + 3, VERTEX + 4 * (3 + 1) + 3};
    receive_bench *bench = receive_bench_new(2, 3);
    uint32_t refused = 0;
    for (uint32_t i = 0; i < 2 * 256; i++) {
        hs_packet *one = &packet[i % 2];
        uint32_t value = i / 2;
        one->word[w3[i % 2]] = value;
        mend_crc(one);
        receive_bench_run(bench, one, &plainly, &result);
        if (good_sharpness(value & 15) && good_sharpness(value >> 4)) {
            assert_taken_apart(one, &result);
        } else {
            assert_string_equal(hs_status_name(result.status), "BAD_SHARPNESS");
            assert_int_equal(result.position, w3[i % 2]);
            refused++;
        }
    }
    assert_int_equal(refused, 2 * (256 - 11 * 11));
    receive_bench_free(bench);
    for (size_t i = 0; i < 2; i++)
        hs_packet_free(&packet[i]);
}

static void tlast_may_come_in_an_empty_beat(void **state) {
    (void)state;
    receive_send send = plainly;
    send.empty_beat = true;
    for (size_t p = 0; p < 3; p++) {
        receive_bench *bench = receive_bench_new(ports[p], 5);
        hs_packet packet = cube(); /* 40 records fill the beats of every width */
        receive_bench_run(bench, &packet, &send, &result);
        assert_taken_apart(&packet, &result);
        packet.words = 4 * 12;
        assert_refused_by(bench, &packet, HS_STATUS_TRUNCATED, 48, &send);
        packet.words = 0;
        assert_refused_by(bench, &packet, HS_STATUS_TRUNCATED, 0, &send);
        hs_packet_free(&packet);
        receive_bench_free(bench);
    }
}

/* --- Bad packets -------------------------------------------------------------------------------
 */

struct corruption {
    uint32_t word, value, status, position;
};

static void assert_corruptions(hs_packet (*make)(void), const struct corruption *c, size_t n) {
    for (size_t i = 0; i < n; i++) {
        hs_packet packet = make();
        assert_int_not_equal(packet.word[c[i].word], c[i].value);
        packet.word[c[i].word] = c[i].value;
        if (c[i].status != HS_STATUS_BAD_CRC) mend_crc(&packet);
        assert_refused(&packet, c[i].status, c[i].position);
        hs_packet_free(&packet);
    }
}
#define ASSERT_CORRUPTIONS(make, table)                                                            \
    assert_corruptions(make, table, sizeof table / sizeof *table)

static void a_bad_header_word_is_named(void **state) {
    (void)state;
    static const struct corruption table[] = {
        {0, 0x49325349, HS_STATUS_BAD_MAGIC, 0},
        {0, 0x45325348, HS_STATUS_BAD_MAGIC, 0},
        {1, 0, HS_STATUS_BAD_VERSION, 1},
        {1, 0x10001, HS_STATUS_BAD_VERSION, 1},
        {2, 32, HS_STATUS_BAD_FLAGS, 2},
        {2, 24, HS_STATUS_BAD_FLAGS, 2},
        {2, 31, HS_STATUS_BAD_FLAGS, 2},
        {2, 0x80000003, HS_STATUS_BAD_FLAGS, 2},
        {3, 0, HS_STATUS_BAD_COUNT, 3},
        {3, 2, HS_STATUS_BAD_COUNT, 3},
        {3, RECEIVE_VERTICES + 1, HS_STATUS_CAPACITY_VERTICES, 3},
        {3, 0x80000005, HS_STATUS_CAPACITY_VERTICES, 3},
        {4, 0, HS_STATUS_BAD_COUNT, 4},
        {4, 6, HS_STATUS_BAD_COUNT, 5},
        {4, 0x55555556, HS_STATUS_BAD_COUNT, 5}, /* three times this is 2^32 + 2 */
        {4, 0xffffffff, HS_STATUS_BAD_COUNT, 5},
        {5, 14, HS_STATUS_BAD_COUNT, 5},
        {5, RECEIVE_QUADS + 1, HS_STATUS_CAPACITY_CORNERS, 5},
        {5, 0xffffffff, HS_STATUS_CAPACITY_CORNERS, 5},
        {6, 251, HS_STATUS_BAD_DEPTH, 6},
        {6, 251 << 8, HS_STATUS_BAD_DEPTH, 6},
        {6, 251 << 16, HS_STATUS_BAD_DEPTH, 6},
        {6, 1 << 24, HS_STATUS_BAD_DEPTH, 6},
        {6, 1u << 31, HS_STATUS_BAD_DEPTH, 6},
        {7, 1, HS_STATUS_BAD_RESERVED, 7},
        {7, 0x80000000, HS_STATUS_BAD_RESERVED, 7},
        {8, 0x10000, HS_STATUS_BAD_PIXELS, 8},
        {8, 0x80000018, HS_STATUS_BAD_PIXELS, 8},
        {9, 0, HS_STATUS_BAD_PIXELS, 9},
        {9, 640, HS_STATUS_BAD_PIXELS, 9},
        {9, 480u << 16, HS_STATUS_BAD_PIXELS, 9},
        {10, 1, HS_STATUS_BAD_RESERVED, 10},
        {10, 0x80000000, HS_STATUS_BAD_RESERVED, 10},
        {11, 1, HS_STATUS_BAD_RESERVED, 11},
        {11, 0x80000000, HS_STATUS_BAD_RESERVED, 11},
    };
    ASSERT_CORRUPTIONS(pyramid, table);
}

static void a_number_that_is_not_finite_is_named(void **state) {
    (void)state;
    for (uint32_t word = MATRIX; word < PYRAMID_CORNER; word++) {
        const struct corruption table[] = {
            {word, INFINITE, HS_STATUS_BAD_NUMBER, word},
            {word, NOT_A_NUMBER, HS_STATUS_BAD_NUMBER, word},
        };
        ASSERT_CORRUPTIONS(pyramid, table);
    }
}

#define CORNER(h, k) (PYRAMID_CORNER + 4 * (h) + (k))

static void a_bad_corner_word_is_named(void **state) {
    (void)state;
    static const struct corruption table[] = {
        {CORNER(0, 0), 5, HS_STATUS_BAD_INDEX, CORNER(0, 0)},
        {CORNER(15, 0), 0xffffffff, HS_STATUS_BAD_INDEX, CORNER(15, 0)},
        {CORNER(3, 0), 0x10001, HS_STATUS_BAD_INDEX, CORNER(3, 0)},
        {CORNER(0, 1), 0, HS_STATUS_BAD_TWIN, CORNER(0, 1)},
        {CORNER(7, 1), 7, HS_STATUS_BAD_TWIN, CORNER(7, 1)},
        {CORNER(7, 1), 16, HS_STATUS_BAD_TWIN, CORNER(7, 1)},
        {CORNER(15, 1), 0xfffffffe, HS_STATUS_BAD_TWIN, CORNER(15, 1)},
        /* sides of a first corner: 2, none, more than are left */
        {CORNER(0, 2), 0x000002, HS_STATUS_BAD_FACE, CORNER(0, 2)},
        {CORNER(0, 2), 0x000000, HS_STATUS_BAD_FACE, CORNER(0, 2)},
        {CORNER(0, 2), 0x000011, HS_STATUS_BAD_FACE, CORNER(0, 2)},
        {CORNER(13, 2), 0x000004, HS_STATUS_BAD_FACE, CORNER(13, 2)},
        /* sides within what is left, but the next corner disagrees */
        {CORNER(0, 2), 0x000010, HS_STATUS_BAD_FACE, CORNER(1, 2)},
        {CORNER(0, 2), 0x000003, HS_STATUS_BAD_FACE, CORNER(1, 2)},
        /* forced depths: too large, or not its face's */
        {CORNER(0, 2), 0x00fb04, HS_STATUS_BAD_FACE, CORNER(0, 2)},
        {CORNER(0, 2), 0x000104, HS_STATUS_BAD_FACE, CORNER(1, 2)},
        {CORNER(5, 2), 0x010603, HS_STATUS_BAD_FACE, CORNER(5, 2)},
        /* corner numbers */
        {CORNER(0, 2), 0x010004, HS_STATUS_BAD_FACE, CORNER(0, 2)},
        {CORNER(3, 2), 0x040004, HS_STATUS_BAD_FACE, CORNER(3, 2)},
        {CORNER(3, 2), 0x000004, HS_STATUS_BAD_FACE, CORNER(3, 2)},
        {CORNER(15, 2), 0x000003, HS_STATUS_BAD_FACE, CORNER(15, 2)},
        /* the bits above */
        {CORNER(0, 2), 0x01000004, HS_STATUS_BAD_FACE, CORNER(0, 2)},
        {CORNER(3, 2), 0x80030004, HS_STATUS_BAD_FACE, CORNER(3, 2)},
        {CORNER(0, 3), 10, HS_STATUS_BAD_SHARPNESS, CORNER(0, 3)},
        {CORNER(7, 3), 0xe0, HS_STATUS_BAD_SHARPNESS, CORNER(7, 3)},
        {CORNER(0, 3), 0x100, HS_STATUS_BAD_SHARPNESS, CORNER(0, 3)},
        {CORNER(15, 3), 0x80000000, HS_STATUS_BAD_SHARPNESS, CORNER(15, 3)},
        /* one face less in the header: the fifth is one too many */
        {4, 4, HS_STATUS_BAD_FACE, CORNER(13, 2)},
        /* one half-edge less, or more */
        {5, 15, HS_STATUS_BAD_TWIN, CORNER(11, 1)}, /* the twin of 15 */
        {5, 17, HS_STATUS_BAD_INDEX, CORNER(16, 0)},
    };
    ASSERT_CORRUPTIONS(pyramid, table);
}

static void a_face_too_few_is_found_at_the_last_corner(void **state) {
    (void)state;
    static const struct corruption table[] = {
        {4, 7, HS_STATUS_BAD_FACE, VERTEX + 32 + 4 * 23 + 2},
        {4, 8, HS_STATUS_BAD_FACE, VERTEX + 32 + 4 * 23 + 2},
    };
    ASSERT_CORRUPTIONS(cube, table);
}

static void a_bad_trailer_word_is_named(void **state) {
    (void)state;
    static const struct corruption table[] = {
        {PYRAMID_END, 0, HS_STATUS_BAD_TRAILER, PYRAMID_END},
        {PYRAMID_END + 1, 1, HS_STATUS_BAD_RESERVED, PYRAMID_END + 1},
        {PYRAMID_END + 2, 1u << 31, HS_STATUS_BAD_RESERVED, PYRAMID_END + 2},
        {PYRAMID_END + 3, 0, HS_STATUS_BAD_CRC, PYRAMID_END + 3},
    };
    ASSERT_CORRUPTIONS(pyramid, table);
}

static void a_flipped_bit_anywhere_is_found(void **state) {
    (void)state;
    receive_bench *bench = receive_bench_new(2, 9);
    for (uint32_t bit = 0; bit < PYRAMID_WORDS * 32; bit += 5) {
        hs_packet packet = pyramid();
        packet.word[bit / 32] ^= 1u << bit % 32;
        receive_bench_run(bench, &packet, &plainly, &result);
        assert_true(result.finished);
        assert_int_not_equal(result.status, HS_STATUS_OK);
        hs_packet_free(&packet);
    }
    receive_bench_free(bench);
}

/* What was stored ends before the offending record. */
static void nothing_is_stored_behind_an_error(void **state) {
    (void)state;
    for (size_t p = 0; p < 3; p++) {
        receive_bench *bench = receive_bench_new(ports[p], 4);
        hs_packet packet = pyramid();
        packet.word[CORNER(9, 3)] = 0x100;
        receive_bench_run(bench, &packet, &plainly, &result);
        assert_int_equal(result.vertices_stored, 5);
        assert_int_equal(result.corners_stored, 9);
        packet.word[VERTEX + 4 * 2 + 3] = INFINITE;
        receive_bench_run(bench, &packet, &plainly, &result);
        assert_int_equal(result.vertices_stored, 2);
        assert_int_equal(result.vertices_done, 0);
        assert_int_equal(result.corners_stored, 0);
        hs_packet_free(&packet);
        receive_bench_free(bench);
    }
}

static void a_packet_cut_short_anywhere_is_found(void **state) {
    (void)state;
    for (size_t words = 4; words < PYRAMID_WORDS; words += 4) {
        hs_packet packet = pyramid();
        packet.words = words;
        assert_refused(&packet, HS_STATUS_TRUNCATED, words);
        hs_packet_free(&packet);
    }
}

static void a_packet_that_goes_on_is_found(void **state) {
    (void)state;
    for (size_t more = 1; more < 10; more++) {
        hs_packet packet = pyramid();
        hs_packet behind = pyramid(); /* what looks like a packet is none before TLAST */
        hs_error err = {0};
        assert_true(hs_packet_append(&packet, behind.word, more, &err));
        assert_refused(&packet, HS_STATUS_TOO_LONG, PYRAMID_WORDS);
        packet.word[PYRAMID_END + 3] ^= 1;
        assert_refused(&packet, HS_STATUS_BAD_CRC, PYRAMID_END + 3);
        hs_packet_free(&packet);
        hs_packet_free(&behind);
    }
}

/* --- Overflows, which are found late -----------------------------------------------------------
 */

/* A pyramid in which row `row` of vertex v overflows. */
static hs_packet overflowing(uint32_t v, uint32_t row) {
    hs_packet packet = pyramid();
    for (uint32_t i = 0; i < 16; i++)
        packet.word[MATRIX + i] = i == 5 * row ? HUGE : 0;
    for (uint32_t i = 0; i < 20; i++)
        packet.word[VERTEX + i] = i == 4 * v + row ? HUGE : 0x3f800000;
    mend_crc(&packet);
    return packet;
}

static void an_overflow_is_named_by_vertex_and_row(void **state) {
    (void)state;
    for (uint32_t v = 0; v < 5; v++)
        for (uint32_t row = 0; row < 4; row++) {
            hs_packet packet = overflowing(v, row);
            assert_refused(&packet, HS_STATUS_OVERFLOW, VERTEX + 4 * v + row);
            hs_packet_free(&packet);
        }
}

static void an_overflow_wins_over_errors_behind_it(void **state) {
    (void)state;
    hs_packet packet = overflowing(3, 1);
    const uint32_t position = VERTEX + 4 * 3 + 1;
    packet.word[CORNER(0, 0)] = 99; /* found 7 cycles earlier */
    assert_refused(&packet, HS_STATUS_OVERFLOW, position);
    packet.word[VERTEX + 4 * 4] = INFINITE;
    assert_refused(&packet, HS_STATUS_OVERFLOW, position);
    packet.words = VERTEX + 4 * 4; /* TLAST on the vertex itself */
    assert_refused(&packet, HS_STATUS_OVERFLOW, position);
    hs_packet_free(&packet);
}

static void the_first_of_two_overflows_wins(void **state) {
    (void)state;
    hs_packet packet = overflowing(1, 2);
    packet.word[VERTEX + 4 * 2 + 2] = HUGE;
    packet.word[VERTEX + 4 * 4 + 2] = HUGE;
    assert_refused(&packet, HS_STATUS_OVERFLOW, VERTEX + 4 * 1 + 2);
    hs_packet_free(&packet);
}

static void an_error_wins_over_overflows_behind_it(void **state) {
    (void)state;
    hs_packet packet = overflowing(3, 1);
    packet.word[VERTEX + 4 * 2 + 3] = NOT_A_NUMBER;
    assert_refused(&packet, HS_STATUS_BAD_NUMBER, VERTEX + 4 * 2 + 3);
    hs_packet_free(&packet);
}

/* --- Limits ------------------------------------------------------------------------------------
 */

static void a_limit_refuses_the_first_count_above_it(void **state) {
    (void)state;
    hs_packet packet = pyramid();
    for (size_t p = 0; p < 3; p++) {
        receive_bench *bench = receive_bench_new(ports[p], 2);
        receive_send send = plainly;
        send.limit_vertices = 5;
        send.limit_quads = 16;
        receive_bench_run(bench, &packet, &send, &result);
        assert_taken_apart(&packet, &result);
        send.limit_vertices = 4;
        assert_refused_by(bench, &packet, HS_STATUS_CAPACITY_VERTICES, 3, &send);
        send.limit_vertices = 5;
        send.limit_quads = 15;
        assert_refused_by(bench, &packet, HS_STATUS_CAPACITY_CORNERS, 5, &send);
        receive_bench_free(bench);
    }
    hs_packet_free(&packet);
}

/* --- Anything at all ---------------------------------------------------------------------------
 */

/* What receive should say of a packet of which golden says this: golden's later checks (twins
 * that do not point back or differ in sharpness, valence) and its refinement are not receive's. */
static uint32_t receive_status(const hs_packet *packet, const hs_golden_report *g) {
    if (g->status == HS_STATUS_STOPPED || g->status == HS_STATUS_BAD_VALENCE) return HS_STATUS_OK;
    if (g->status != HS_STATUS_BAD_TWIN && g->status != HS_STATUS_BAD_SHARPNESS) return g->status;
    const uint32_t word = packet->word[g->error_position], halfedges = packet->word[5];
    const uint32_t h = (g->error_position - VERTEX - 4 * packet->word[3]) / 4;
    bool local = g->status == HS_STATUS_BAD_TWIN
                     ? word != HS_BORDER && (word >= halfedges || word == h)
                     : word >> 8 || !good_sharpness(word & 15) || !good_sharpness(word >> 4);
    return local ? g->status : HS_STATUS_OK;
}

static void mutated_packets_get_goldens_verdict(void **state) {
    (void)state;
    static const uint32_t values[] = {0, 1, 2, 3, 4, 16, 250, 251, HUGE, INFINITE, 0xffffffff};
    hs_golden *golden = hs_golden_new((hs_limits){RECEIVE_VERTICES, RECEIVE_QUADS});
    assert_non_null(golden);
    hs_packet out = {0};
    uint32_t random = 12345, refused = 0;
    for (size_t p = 0; p < 3; p++) {
        receive_bench *bench = receive_bench_new(ports[p], 11);
        for (uint32_t round = 0; round < 1500; round++) {
            hs_packet packet = round % 3 == 0 ? cube() : pyramid();
            packet.word[6] = 0; /* golden need not refine */
            for (uint32_t i = 0; i <= round % 4; i++) {
                random = random * 1664525 + 1013904223;
                uint32_t word = (random >> 8) % (uint32_t)packet.words;
                random = random * 1664525 + 1013904223;
                if (random >> 31)
                    packet.word[word] = values[(random >> 8) % 11];
                else
                    packet.word[word] += (random >> 16 & 1 ? 1u : 0xffffffffu)
                                         << (random >> 8) % 32;
            }
            if (round % 5) mend_crc(&packet);
            if (round % 7 == 0) packet.words -= random >> 8 & 0x1c;
            hs_golden_report report;
            hs_error err = {0};
            assert_true(hs_golden_run(golden, &packet, &out, &report, &err));
            receive_send send = plainly;
            send.pause = round % 2 ? 50 : 0;
            send.seed = round;
            receive_bench_run(bench, &packet, &send, &result);
            const uint32_t status = receive_status(&packet, &report);
            assert_true(result.finished);
            assert_string_equal(hs_status_name(result.status), hs_status_name(status));
            if (status == HS_STATUS_OK) {
                assert_taken_apart(&packet, &result);
            } else {
                assert_int_equal(result.position, report.error_position);
                refused++;
            }
            hs_packet_free(&packet);
        }
        receive_bench_free(bench);
    }
    assert_true(refused > 1000 && refused < 4400);
    hs_packet_free(&out);
    hs_golden_free(golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_good_packet_is_taken_apart_whatever_the_pauses),
        cmocka_unit_test(a_record_is_taken_in_every_cycle),
        cmocka_unit_test(flags_and_depths_come_through),
        cmocka_unit_test(least_edge_and_picture_come_through),
        cmocka_unit_test(sharpnesses_are_0_to_9_or_15),
        cmocka_unit_test(tlast_may_come_in_an_empty_beat),
        cmocka_unit_test(a_bad_header_word_is_named),
        cmocka_unit_test(a_number_that_is_not_finite_is_named),
        cmocka_unit_test(a_bad_corner_word_is_named),
        cmocka_unit_test(a_face_too_few_is_found_at_the_last_corner),
        cmocka_unit_test(a_bad_trailer_word_is_named),
        cmocka_unit_test(a_flipped_bit_anywhere_is_found),
        cmocka_unit_test(nothing_is_stored_behind_an_error),
        cmocka_unit_test(a_packet_cut_short_anywhere_is_found),
        cmocka_unit_test(a_packet_that_goes_on_is_found),
        cmocka_unit_test(an_overflow_is_named_by_vertex_and_row),
        cmocka_unit_test(an_overflow_wins_over_errors_behind_it),
        cmocka_unit_test(the_first_of_two_overflows_wins),
        cmocka_unit_test(an_error_wins_over_overflows_behind_it),
        cmocka_unit_test(a_limit_refuses_the_first_count_above_it),
        cmocka_unit_test(mutated_packets_get_goldens_verdict),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
