/* SPDX-License-Identifier: Apache-2.0
 *
 * Memory that is exhausted, at each allocation in turn: who asked for it says so, and once there is
 * memory again, the same contexts answer as if nothing had been.
 */
#include "allocations.h"
#include "rtl_samples.h"

/* --- Packets ------------------------------------------------------------------------------------
 */
enum { PACKETS = 3 };
typedef struct {
    hs_packet in[PACKETS], out[PACKETS];
    hs_mesh mesh;
} samples_of_all;

/* Decisions, the limit surface, and whole levels at once. */
static int set_up(void **state) {
    static const hs_settings settings[PACKETS] = {
        {.front_depth = 2, .silhouette_depth = 4, .guard = true},
        {.front_depth = 2, .silhouette_depth = 2, .limit = true, .boundary = HS_BOUNDARY_SMOOTH},
        {.uniform = true, .uniform_depth = 6, .boundary = HS_BOUNDARY_SMOOTH}};
    static samples_of_all all;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    hs_golden_report report;
    hs_view view[VIEWS];
    hs_error err;
    for (uint32_t i = 0; i < PACKETS; i++) {
        hs_mesh_free(&all.mesh);
        make_shape(&all.mesh, i == 2 ? "tetrahedron" : "cube", 0, 0);
        make_views(&all.mesh, view);
        assert_true(hs_packet_encode(&all.in[i], i, &all.mesh, view[i].matrix, &settings[i], &err));
        assert_true(hs_golden_run(golden, &all.in[i], &all.out[i], &report, &err));
        assert_int_equal(report.status, HS_STATUS_OK);
    }
    hs_golden_free(golden);
    *state = &all;
    return 0;
}

static int tear_down(void **state) {
    samples_of_all *all = *state;
    for (uint32_t i = 0; i < PACKETS; i++) {
        hs_packet_free(&all->in[i]);
        hs_packet_free(&all->out[i]);
    }
    hs_mesh_free(&all->mesh);
    return 0;
}

/* --- Claims -------------------------------------------------------------------------------------
 */
/* The packet of that number first. */
static uint32_t exhaust_golden(const samples_of_all *all, uint32_t first) {
    hs_golden_report report;
    hs_error err = {0};
    bool failed = true;
    uint32_t n = 0;
    for (; failed; n++) {
        start_failing(n + 1, false);
        hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
        hs_packet out = {0};
        bool good = golden != NULL;
        for (uint32_t i = 0; good && i < PACKETS; i++) {
            err.code = HS_EXIT_OK;
            good = hs_golden_run(golden, &all->in[(first + i) % PACKETS], &out, &report, &err);
        }
        failed = stop_failing();
        assert_int_equal(good, !failed);
        if (golden && failed) assert_int_equal(err.code, HS_EXIT_INTERNAL);
        for (uint32_t i = 0; golden && i < PACKETS; i++) {
            assert_true(hs_golden_run(golden, &all->in[i], &out, &report, &err));
            assert_int_equal(hs_compare_words(&all->out[i], &out).different, 0);
        }
        hs_packet_free(&out);
        hs_golden_free(golden);
    }
    return n - 1;
}

static void golden_says_so_and_goes_on(void **state) {
    for (uint32_t first = 0; first < PACKETS; first++) {
        const uint32_t n = exhaust_golden(*state, first);
        print_message("%u allocations\n", n);
        assert_true(n > 30);
    }
}

static void the_model_says_so_and_goes_on(void **state) {
    const samples_of_all *all = *state;
    hs_golden_report report;
    hs_cycle_report cycles, expected = {0};
    hs_error err = {0};
    bool failed = true;
    uint32_t n = 0;
    const size_t before = allocations.held;
    hs_model *other = hs_model_new(HS_DEFAULT_LIMITS, HS_DEFAULT_CONFIG, &err);
    hs_packet out = {0};
    assert_true(hs_model_run(other, &all->in[1], no_stalls, &out, &report, &expected, NULL, &err));
    hs_model_free(other);
    hs_packet_free(&out);
    for (; failed; n++) {
        hs_log log = {0};
        start_failing(n + 1, false);
        hs_model *model = hs_model_new(HS_DEFAULT_LIMITS, HS_DEFAULT_CONFIG, &err);
        bool good = model != NULL;
        if (good)
            good = hs_model_run(model, &all->in[1], no_stalls, &out, &report, &cycles, &log, &err);
        failed = stop_failing();
        assert_int_equal(good && !log.exhausted, !failed);
        if (model) {
            assert_true(
                hs_model_run(model, &all->in[1], no_stalls, &out, &report, &cycles, NULL, &err));
            assert_int_equal(hs_compare_words(&all->out[1], &out).different, 0);
            assert_int_equal(cycles.cycles, expected.cycles);
        }
        hs_packet_free(&out);
        hs_log_free(&log);
        hs_model_free(model);
    }
    print_message("%u allocations\n", n - 1);
    assert_true(n > 30);
    assert_int_equal(allocations.held, before);
}

static void views_in_flight_say_so_and_go_on(void **state) {
    const samples_of_all *all = *state;
    hs_model_config config = HS_DEFAULT_CONFIG;
    hs_golden_report report[2];
    hs_flight_view view[2];
    hs_error err = {0};
    uint64_t cycles;
    bool failed = true;
    uint32_t n = 0;
    const size_t before = allocations.held;
    config.views = 2;
    for (; failed; n++) {
        hs_packet out[2] = {{0}, {0}};
        hs_flight *flight = hs_flight_new(HS_DEFAULT_LIMITS, config, &err);
        assert_non_null(flight);
        err.code = HS_EXIT_OK;
        start_failing(n + 1, false);
        const bool good = hs_flight_run(flight, &all->in[1], 2, no_stalls, out, report, view,
                                        &cycles, NULL, &err);
        failed = stop_failing();
        assert_int_equal(good, !failed);
        if (failed) assert_int_equal(err.code, HS_EXIT_INTERNAL);
        assert_true(hs_flight_run(flight, &all->in[1], 2, no_stalls, out, report, view, &cycles,
                                  NULL, &err));
        for (uint32_t v = 0; v < 2; v++) {
            assert_int_equal(hs_compare_words(&all->out[1 + v], &out[v]).different, 0);
            hs_packet_free(&out[v]);
        }
        hs_flight_free(flight);
    }
    print_message("%u allocations\n", n - 1);
    assert_true(n > 30);
    assert_int_equal(allocations.held, before);
}

static void packets_say_so(void **state) {
    const samples_of_all *all = *state;
    const hs_settings settings = uniform(1);
    hs_error err = {0};
    bool failed = true;
    uint32_t n = 0;
    for (; failed; n++) {
        hs_packet packet = {0};
        err.code = HS_EXIT_OK;
        start_failing(n + 1, false);
        const bool good = hs_packet_encode(&packet, 1, &all->mesh, identity, &settings, &err);
        failed = stop_failing();
        assert_int_equal(good, !failed);
        if (failed) assert_int_equal(err.code, HS_EXIT_INTERNAL);
        hs_packet_free(&packet);
    }
    assert_true(n > 1);
    const uint32_t record[4] = {0};
    hs_packet empty = {0};
    err.code = HS_EXIT_OK;
    start_failing(1, false);
    const bool appended = hs_packet_append(&empty, record, 1, &err);
    failed = stop_failing();
    assert_true(failed && !appended);
    assert_int_equal(err.code, HS_EXIT_INTERNAL);
    assert_null(empty.word);
    for (n = 0; failed; n++) {
        hs_output output;
        err.code = HS_EXIT_OK;
        start_failing(n + 1, false);
        const bool good = hs_output_decode(&output, &all->out[0], &err);
        failed = stop_failing();
        assert_int_equal(good, !failed);
        if (failed) assert_int_equal(err.code, HS_EXIT_INTERNAL);
        if (failed) assert_null(output.position);
        hs_output_free(&output);
    }
    assert_true(n > 1);
}

/* But for what malloc and each array put in front. */
static void golden_knows_what_it_holds(void **state) {
    const samples_of_all *all = *state;
    hs_golden_report report;
    hs_error err;
    const size_t before = allocations.held;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    hs_packet out = {0};
    for (uint32_t i = 0; i < PACKETS; i++) {
        assert_true(hs_golden_run(golden, &all->in[i], &out, &report, &err));
        const size_t bytes = allocations.held - before - malloc_usable_size(out.word);
        assert_true(hs_golden_bytes(golden) <= bytes);
        assert_true(hs_golden_bytes(golden) >= bytes - 60 * 64);
    }
    hs_packet_free(&out);
    hs_golden_free(golden);
    assert_int_equal(allocations.held, before);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(golden_knows_what_it_holds),
        cmocka_unit_test(golden_says_so_and_goes_on),
        cmocka_unit_test(the_model_says_so_and_goes_on),
        cmocka_unit_test(views_in_flight_say_so_and_go_on),
        cmocka_unit_test(packets_say_so),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
