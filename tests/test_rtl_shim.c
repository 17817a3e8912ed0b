/* SPDX-License-Identifier: Apache-2.0
 *
 * The harness that runs the RTL, and the comparison of its words, must fail where something is
 * wrong: sim/rtl.h runs a pipeline that only sends its packets back (broken_rtl/), with one
 * fault at a time.
 */
#include "broken_rtl/faults.h"
#include "rtl_samples.h"

enum fault planted_fault;

static const hs_limits small = {.vertices = 64, .quads = 64};

/* 26 records: six full beats and a half one. */
static void make_packet(hs_packet *packet) {
    hs_error err;
    packet->view = 7;
    packet->words = 0;
    for (uint32_t i = 0; i < 26; i++) {
        const uint32_t record[4] = {i, i + 1, 5 * i, ~i};
        assert_true(hs_packet_append(packet, record, 1, &err));
    }
    packet->word[5] = 3;
    packet->word[6] = 0;
}

static hs_rtl *new_sound_rtl(void) {
    hs_error err;
    planted_fault = FAULT_NONE;
    hs_rtl *rtl = hs_rtl_new(small, 1, &err);
    if (!rtl) fail_msg("%s", err.text);
    return rtl;
}

static void a_sound_pipeline_passes_with_any_stalls(void **state) {
    (void)state;
    hs_rtl *rtl = new_sound_rtl();
    hs_packet in = {0}, out = {0};
    hs_cycle_report report;
    hs_error err;
    make_packet(&in);
    for (uint32_t i = 0; i < 20; i++) {
        const hs_stalls stalls = {
            .seed = i, .input = (uint8_t)(i * 5 % 96), .output = (uint8_t)(i * 15 % 96)};
        const uint64_t before = hs_rtl_cycle(rtl);
        if (!hs_rtl_run(rtl, &in, stalls, &out, &report, &err)) fail_msg("%s", err.text);
        assert_int_equal(out.view, in.view);
        assert_int_equal(out.words, in.words);
        assert_memory_equal(out.word, in.word, 4 * in.words);
        assert_true(report.start >= before && report.first_out > report.start);
        assert_int_equal(report.cycles, report.end - report.start + 1);
        if (i == 0) assert_int_equal(report.cycles, 14); /* seven beats in, seven out */
        if (i > 0) assert_true(report.cycles > 14);
        for (uint32_t s = 0; s < HS_STAGES; s++) {
            assert_int_equal(report.items_in[s], 7);
            assert_int_equal(report.activity[s][HS_ACTIVITY_busy], 7);
            assert_int_equal(report.activity[s][HS_ACTIVITY_idle], report.cycles - 7);
        }
    }
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_rtl_free(rtl);
}

/* Faults that only a run shows, and a part of what the error says of each. */
static const struct {
    enum fault fault;
    const char *says;
} run_faults[] = {
    {FAULT_SILENT_BUS, "does not answer"},
    {FAULT_BUS_ERROR, "answers with an error"},
    {FAULT_ASSERTION, "an assertion of the RTL failed"},
    {FAULT_VALID_FALLS, "tvalid fell"},
    {FAULT_DATA_CHANGES, "a beat changed"},
    {FAULT_LAST_CHANGES, "a beat changed"},
    {FAULT_KEEP_CHANGES, "a beat changed"},
    {FAULT_OTHER_ID, "tid is not"},
    {FAULT_KEEP_GAP, "tkeep is not"},
    {FAULT_KEEP_PART, "tkeep is not"},
    {FAULT_KEEP_EARLY, "tkeep is not"},
    {FAULT_BEAT_BEHIND, "behind the packet's last one"},
    {FAULT_LATE_BEAT, "behind the packet's last one"},
    {FAULT_DEAF, "nothing has moved"},
    {FAULT_MUTE, "nothing has moved"},
    {FAULT_ENDLESS, "does not come to an end"},
    {FAULT_STAYS_BUSY, "stays busy"},
    {FAULT_CYCLES, "cycles instead of"},
    {FAULT_ACTIVITY, "stage split was busy"},
    {FAULT_ACTIVE_OUTSIDE, "stage emit was busy"},
    {FAULT_ITEM_LOST, "stage select took"},
    {FAULT_STATUS, "registers tell of status"},
    {FAULT_POSITION, "registers tell of status"},
    {FAULT_VIEWS, "counts 0 views instead of 1"},
};
enum { RUN_FAULTS = sizeof run_faults / sizeof *run_faults };

static void every_fault_of_a_run_is_named_and_the_next_run_is_sound(void **state) {
    (void)state;
    hs_rtl *rtl = new_sound_rtl();
    hs_packet in = {0}, out = {0};
    hs_cycle_report report;
    hs_error err;
    make_packet(&in);
    const hs_stalls stalls = {.seed = 3, .input = 20, .output = 90}; /* so that beats wait */
    for (uint32_t i = 0; i < RUN_FAULTS; i++) {
        planted_fault = run_faults[i].fault;
        err = (hs_error){0};
        if (hs_rtl_run(rtl, &in, stalls, &out, &report, &err))
            fail_msg("fault %u, '%s', was not found", run_faults[i].fault, run_faults[i].says);
        if (!strstr(err.text, run_faults[i].says))
            fail_msg("'%s' does not say '%s'", err.text, run_faults[i].says);
        assert_int_equal(err.code, HS_EXIT_INTERNAL);
        planted_fault = FAULT_NONE;
        if (!hs_rtl_run(rtl, &in, stalls, &out, &report, &err))
            fail_msg("behind fault %u: %s", run_faults[i].fault, err.text);
        assert_memory_equal(out.word, in.word, 4 * in.words);
    }
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_rtl_free(rtl);
}

/* Packets in a row: their views are counted. */
static void a_view_of_a_row_that_is_not_counted_is_found(void **state) {
    (void)state;
    enum { ROW = 3 };
    hs_rtl *rtl = new_sound_rtl();
    hs_packet in[ROW] = {0}, out[ROW] = {0};
    hs_flight_view view[ROW];
    hs_error err = {0};
    uint64_t cycles;
    for (uint32_t i = 0; i < ROW; i++) {
        make_packet(&in[i]);
        in[i].view = i;
    }
    for (uint32_t i = 0; i < 3; i++) {
        planted_fault = i == 1 ? FAULT_VIEWS : FAULT_NONE;
        const bool good = hs_rtl_stream(rtl, in, ROW, no_stalls, out, view, &cycles, &err);
        if (good != (i != 1)) fail_msg("run %u: %s", i, good ? "nothing was found" : err.text);
        if (i == 1) assert_non_null(strstr(err.text, "counts 0 views instead of 3"));
    }
    for (uint32_t i = 0; i < ROW; i++) {
        assert_memory_equal(out[i].word, in[i].word, 4 * in[i].words);
        hs_packet_free(&in[i]);
        hs_packet_free(&out[i]);
    }
    hs_rtl_free(rtl);
}

static void a_foreign_or_too_small_pipeline_is_not_built(void **state) {
    (void)state;
    hs_error err = {0};
    planted_fault = FAULT_IDENTITY;
    assert_null(hs_rtl_new(small, 1, &err));
    assert_non_null(strstr(err.text, "identity"));
    planted_fault = FAULT_VERSION;
    assert_null(hs_rtl_new(small, 1, &err));
    assert_non_null(strstr(err.text, "version"));
    planted_fault = FAULT_NONE;
    assert_null(hs_rtl_new((hs_limits){65, 64}, 1, &err));
    assert_int_equal(err.code, HS_EXIT_USAGE);
    assert_null(hs_rtl_new((hs_limits){64, 65}, 1, &err));
    assert_non_null(strstr(err.text, "capacity of 64 and 64"));
}

/* Verilator's runtime knows one current simulation; the shim tells it which. */
static void two_simulations_keep_their_errors_apart(void **state) {
    (void)state;
    hs_rtl *first = new_sound_rtl(), *second = new_sound_rtl();
    hs_packet in = {0}, out = {0};
    hs_cycle_report report;
    hs_error err;
    make_packet(&in);
    planted_fault = FAULT_ASSERTION;
    assert_false(hs_rtl_run(first, &in, no_stalls, &out, &report, &err));
    planted_fault = FAULT_NONE;
    assert_true(hs_rtl_run(second, &in, no_stalls, &out, &report, &err));
    hs_rtl_free(second);
    assert_true(hs_rtl_run(first, &in, no_stalls, &out, &report, &err));
    hs_rtl_free(first);
    hs_packet_free(&in);
    hs_packet_free(&out);
}

/* --- The comparison
 * ---------------------------------------------------------------------------------
 */

static void a_wrong_word_is_found_and_described(void **state) {
    (void)state;
    hs_rtl *rtl = new_sound_rtl();
    hs_packet in = {0}, out = {0};
    hs_cycle_report report;
    hs_error err;
    make_packet(&in);
    planted_fault = FAULT_WORD;
    assert_true(hs_rtl_run(rtl, &in, no_stalls, &out, &report, &err));
    const hs_word_comparison c = hs_compare_words(&in, &out);
    assert_int_equal(c.compared, in.words);
    assert_int_equal(c.different, 1);
    assert_int_equal(c.first, 16 + 3);
    char text[500], expected[30], actual[30];
    hs_compare_describe(&in, &out, c.first, "rtl", text, sizeof text);
    snprintf(expected, sizeof expected, "expected 0x%08x", in.word[19]);
    snprintf(actual, sizeof actual, "rtl sent 0x%08x", in.word[19] ^ 1u << 9);
    assert_non_null(strstr(text, "word 19"));
    assert_non_null(strstr(text, expected));
    assert_non_null(strstr(text, actual));
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_rtl_free(rtl);
}

/* A real output packet of golden, any word of which is changed, or whose end is missing or behind.
 */
static void any_changed_missing_or_additional_word_is_found(void **state) {
    (void)state;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    assert_non_null(golden);
    hs_mesh mesh;
    hs_packet in = {0}, expected = {0}, actual = {0};
    hs_golden_report report;
    hs_error err;
    make_shape(&mesh, "tetrahedron", 0, 0);
    const hs_settings settings = uniform(2);
    assert_true(hs_packet_encode(&in, 1, &mesh, identity, &settings, &err));
    assert_true(hs_golden_run(golden, &in, &expected, &report, &err));
    assert_true(hs_golden_run(golden, &in, &actual, &report, &err));
    assert_int_equal(hs_compare_words(&expected, &actual).different, 0);
    for (size_t w = 0; w < expected.words; w++) {
        actual.word[w] ^= 1u << w % 32;
        const hs_word_comparison c = hs_compare_words(&expected, &actual);
        assert_int_equal(c.different, 1);
        assert_int_equal(c.first, w);
        actual.word[w] ^= 1u << w % 32;
    }
    actual.words -= 4;
    assert_int_equal(hs_compare_words(&expected, &actual).different, 4);
    assert_int_equal(hs_compare_words(&actual, &expected).different, 4);
    assert_int_equal(hs_compare_words(&actual, &expected).first, actual.words);
    assert_int_equal(generation_of_word(&expected, expected.words - 4), 2);
    hs_packet_free(&in);
    hs_packet_free(&expected);
    hs_packet_free(&actual);
    hs_mesh_free(&mesh);
    hs_golden_free(golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_pipeline_passes_with_any_stalls),
        cmocka_unit_test(every_fault_of_a_run_is_named_and_the_next_run_is_sound),
        cmocka_unit_test(a_view_of_a_row_that_is_not_counted_is_found),
        cmocka_unit_test(a_foreign_or_too_small_pipeline_is_not_built),
        cmocka_unit_test(two_simulations_keep_their_errors_apart),
        cmocka_unit_test(a_wrong_word_is_found_and_described),
        cmocka_unit_test(any_changed_missing_or_additional_word_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
