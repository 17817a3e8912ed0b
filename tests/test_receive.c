/* SPDX-License-Identifier: Apache-2.0
 *
 * The receive stage (rtl/receive.sv): does it hand on exactly what a packet says, and does it name
 * the first offending word? Every check is made with 1, 2 and 4 records a beat; every bad packet is
 * followed by a good one.
 */
#include "receive_samples.h"

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
        {1, HS_STREAM_VERSION - 1, HS_STATUS_BAD_VERSION, 1},
        {1, HS_STREAM_VERSION + 1, HS_STATUS_BAD_VERSION, 1},
        {1, HS_STREAM_VERSION | 0x100, HS_STATUS_BAD_VERSION, 1},
        {1, 0xffffffff, HS_STATUS_BAD_VERSION, 1},
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
        cmocka_unit_test(a_limit_refuses_the_first_count_above_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
