/* SPDX-License-Identifier: Apache-2.0
 *
 * The receive stage (rtl/receive.sv) and packets that are damaged anywhere: flipped, cut short, too
 * long, overflowing, mutated at random. It finds the first offending word, as golden does, and the
 * packet after a bad one is none the worse.
 */
#include "receive_samples.h"

#include "golden.h"

/* --- Bits and ends ------------------------------------------------------------------------------
 */

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
        cmocka_unit_test(a_flipped_bit_anywhere_is_found),
        cmocka_unit_test(nothing_is_stored_behind_an_error),
        cmocka_unit_test(a_packet_cut_short_anywhere_is_found),
        cmocka_unit_test(a_packet_that_goes_on_is_found),
        cmocka_unit_test(an_overflow_is_named_by_vertex_and_row),
        cmocka_unit_test(an_overflow_wins_over_errors_behind_it),
        cmocka_unit_test(the_first_of_two_overflows_wins),
        cmocka_unit_test(an_error_wins_over_overflows_behind_it),
        cmocka_unit_test(mutated_packets_get_goldens_verdict),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
