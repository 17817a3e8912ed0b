/* SPDX-License-Identifier: Apache-2.0
 *
 * The cycle-level model against the RTL where the other tests of the RTL do not go: random stalls,
 * and faults of the model itself. Those tests compare all transactions of their views too
 * (rtl_samples.h). HS_CASES=10 makes the random parts ten times as long.
 */
#include "rtl_samples.h"

#include "reference_shapes.h"

static void print_total(const bench *b) {
    print_message("%llu views, %llu transactions, %llu cycles: 0 differences\n",
                  (unsigned long long)b->views, (unsigned long long)b->transactions,
                  (unsigned long long)b->cycles);
}

/* Every seed pauses input and output anew, from never to nearly always. */
static void stalls_on_either_side_are_modelled(void **state) {
    bench *b = *state;
    static const char *const name[] = {"cube", "grid", "torus", "mixed", "random", "die"};
    uint64_t random = 11;
    for (uint32_t seed = 0; seed < cases(60); seed++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_shape(&mesh, name[seed % 6], seed % 6 == 4 ? 40 : 0, seed);
        make_views(&mesh, view);
        hs_settings s = seed % 3 == 2
                            ? uniform((uint8_t)(1 + seed % 5))
                            : adaptive((uint8_t)(seed % 4), (uint8_t)(seed % 7), seed & 1);
        s.boundary = modes[seed % 3];
        s.limit = seed % 4 == 3;
        const hs_stalls stalls = {.seed = seed + 1,
                                  .input = (uint8_t)random_below(&random, 96),
                                  .output = (uint8_t)random_below(&random, 96)};
        char what[100];
        snprintf(what, sizeof what, "%s, stalls %u,%u, seed %u", name[seed % 6], stalls.input,
                 stalls.output, stalls.seed);
        assert_same_view(b, 1, &mesh, view[seed % VIEWS].matrix, &s, stalls, what);
        hs_mesh_free(&mesh);
    }
    print_total(b);
}

/* Faces of 3 to 255 sides, vertices of as many faces: the folds of generation 0 fill up. */
static void large_faces_and_valences_are_modelled(void **state) {
    bench *b = *state;
    for (uint32_t n = 3; n <= HS_MAX_SIDES; n += 12)
        for (uint32_t k = 0; k < 4; k++) {
            hs_mesh mesh;
            hs_view view[VIEWS];
            if (k & 1)
                make_pillow(&mesh, n);
            else
                make_bicone(&mesh, n);
            make_views(&mesh, view);
            const hs_settings s = k & 2 ? uniform(3) : adaptive(2, 4, true);
            const hs_stalls stalls = {.seed = n, .output = k == 3 ? 80 : 0};
            char what[100];
            snprintf(what, sizeof what, "%s of %u", k & 1 ? "pillow" : "bicone", n);
            assert_same_view(b, 1, &mesh, view[n % VIEWS].matrix, &s, stalls, what);
            hs_mesh_free(&mesh);
        }
    print_total(b);
}

/* One behind the other, so that the pipeline is not at rest when a packet comes; the last one is
 * refused. On an architecture of one pipeline. */
static void views_in_a_row_are_modelled(void **state) {
    bench *b = *state;
    enum { ROW = 7 };
    const hs_model_config config = hs_rtl_config(b->rtl);
    static hs_packet in[ROW], rtl_out[ROW], model_out[ROW];
    static hs_log rtl_log, model_log;
    hs_golden_report report[ROW];
    hs_flight_view rtl_view[ROW], model_view[ROW];
    hs_error err = {0};
    hs_flight *flight = hs_flight_new(HS_DEFAULT_LIMITS, config, &err);
    assert_non_null(flight);
    hs_rtl_logs(b->rtl, &rtl_log);
    for (uint32_t seed = 0; seed < 6; seed++) {
        uint64_t rtl_cycles, model_cycles;
        const hs_stalls stalls = {
            .seed = seed, .input = (uint8_t)(seed % 3 * 30), .output = (uint8_t)(seed % 2 * 60)};
        for (uint32_t i = 0; i < ROW; i++) {
            static const char *const name[] = {"cube", "torus", "mixed"};
            hs_mesh mesh;
            hs_view view[VIEWS];
            const hs_settings s = i % 3 == 1 ? uniform((uint8_t)seed) : adaptive(2, 4, true);
            make_shape(&mesh, name[(i + seed) % 3], 0, 0);
            make_views(&mesh, view);
            assert_true(hs_packet_encode(&in[i], i, &mesh, view[i].matrix, &s, &err));
            hs_mesh_free(&mesh);
        }
        in[ROW - 1].word[0] ^= 1;
        hs_log_clear(&rtl_log);
        assert_true(hs_rtl_stream(b->rtl, in, ROW, stalls, rtl_out, rtl_view, &rtl_cycles, &err));
        assert_true(hs_flight_run(flight, in, ROW, stalls, model_out, report, model_view,
                                  &model_cycles, &model_log, &err));
        assert_int_equal(report[ROW - 1].status, HS_STATUS_BAD_MAGIC);
        assert_int_equal(rtl_cycles, model_cycles);
        for (uint32_t i = 0; i < ROW; i++) {
            assert_int_equal(rtl_view[i].start, model_view[i].start);
            assert_int_equal(rtl_view[i].end, model_view[i].end);
            assert_int_equal(hs_compare_words(&model_out[i], &rtl_out[i]).different, 0);
        }
        const hs_log_comparison c =
            hs_log_compare(&rtl_log, "rtl", &model_log, "model", HS_LOG_DATA_OF_REFUSED);
        if (c.different) fail_msg("seed %u: %s", seed, c.text);
        assert_true(c.compared > 10000);
    }
    hs_rtl_logs(b->rtl, NULL);
    hs_flight_free(flight);
    hs_log_free(&rtl_log);
    hs_log_free(&model_log);
    for (uint32_t i = 0; i < ROW; i++) {
        hs_packet_free(&in[i]);
        hs_packet_free(&rtl_out[i]);
        hs_packet_free(&model_out[i]);
    }
}

/* A bench of which nothing could be told would be a bench for nothing. */
static void every_boundary_was_passed(void **state) {
    const bench *b = *state;
    for (uint32_t p = 0; p < HS_PROBES; p++) {
        print_message("%-14s %-14s %9llu\n", hs_stage_name(hs_probe_stage(p)), hs_probe_name(p),
                      (unsigned long long)b->passed[p]);
        assert_true(b->passed[p] > 0);
    }
}

/* --- What is wrong is found
 * -----------------------------------------------------------------------
 */
static void run_one_view(bench *b) {
    hs_mesh mesh;
    hs_view view[VIEWS];
    const hs_settings s = adaptive(2, 4, true);
    make_shape(&mesh, "torus", 0, 0);
    make_views(&mesh, view);
    assert_same_view(b, 1, &mesh, view[1].matrix, &s, no_stalls, "torus");
    hs_mesh_free(&mesh);
}

static void a_cycle_or_a_word_off_is_found_and_named(void **state) {
    bench *b = *state;
    run_one_view(b);
    for (uint32_t p = 0; p < HS_PROBES; p++) {
        const size_t count = b->model_log.probe[p].count;
        assert_true(count > 0);
        hs_transaction *t = &b->model_log.probe[p].transaction[count / 2];
        for (uint32_t k = 0; k < 3; k++) {
            const hs_transaction before = *t;
            if (k == 0) t->cycle++;
            if (k == 1) t->item ^= 1;
            if (k == 2) t->word[3] ^= 1u << 31;
            const hs_log_comparison c =
                hs_log_compare(&b->rtl_log, "rtl", &b->model_log, "model", 0);
            assert_int_equal(c.different, 1);
            assert_int_equal(c.probe, p);
            assert_non_null(strstr(c.text, hs_probe_name(p)));
            *t = before;
        }
        b->model_log.probe[p].count--;
        assert_int_equal(hs_log_compare(&b->rtl_log, "rtl", &b->model_log, "model", 0).different,
                         1);
        b->model_log.probe[p].count++;
    }
}

static void a_counter_off_is_found_and_named(void **state) {
    bench *b = *state;
    char text[200];
    run_one_view(b);
    for (uint32_t s = 0; s < HS_STAGES; s++)
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++) {
            b->model_report.activity[s][a]++;
            assert_false(
                hs_cycle_report_equal(&b->rtl_report, &b->model_report, text, sizeof text));
            assert_non_null(strstr(text, hs_stage_name(s)));
            b->model_report.activity[s][a]--;
        }
    b->model_report.conflicts++;
    assert_false(hs_cycle_report_equal(&b->rtl_report, &b->model_report, text, sizeof text));
    b->model_report.conflicts--;
    assert_true(hs_cycle_report_equal(&b->rtl_report, &b->model_report, text, sizeof text));
}

static void another_architecture_is_another_model(void **state) {
    bench *b = *state;
    hs_error err;
    const hs_model_config own = hs_rtl_config(b->rtl);
    hs_model_config config[5];
    for (uint32_t i = 0; i < 5; i++)
        config[i] = own;
    config[0].banks = own.banks == 2 ? 4 : own.banks / 2;
    config[1].window = own.window == 2 ? 4 : own.window / 2;
    config[2].port = own.port == 1 ? 2 : own.port / 2;
    config[3].lanes = own.lanes == 1 ? 2 : own.lanes / 2;
    config[4].latency++;
    run_one_view(b);
    const uint64_t cycles = b->model_report.cycles;
    for (uint32_t i = 0; i < 5; i++) {
        hs_model *model = hs_model_new(HS_DEFAULT_LIMITS, config[i], &err);
        assert_non_null(model);
        assert_true(hs_model_run(model, &b->in, no_stalls, &b->modelled, &b->modelled_report,
                                 &b->model_report, NULL, &err));
        assert_int_equal(hs_compare_words(&b->expected, &b->modelled).different, 0);
        assert_true(b->model_report.cycles != cycles);
        hs_model_free(model);
    }
}

static void a_model_out_of_range_is_refused(void **state) {
    (void)state;
    hs_error err;
    for (uint32_t i = 0; i < 11; i++) {
        hs_model_config c = HS_DEFAULT_CONFIG;
        if (i == 0) c.port = 3;
        if (i == 1) c.port = 8;
        if (i == 2) c.banks = 1;
        if (i == 3) c.banks = 32;
        if (i == 4) c.window = 64;
        if (i == 5) c.lanes = 3;
        if (i == 6) c.latency = 0;
        if (i == 7) c.latency = 9;
        if (i == 8) c.ops = 8;
        if (i == 9) c.views = 0;
        if (i == 10) c.views = 9;
        assert_null(hs_model_new(HS_DEFAULT_LIMITS, c, &err));
        assert_int_equal(err.code, HS_EXIT_USAGE);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stalls_on_either_side_are_modelled),
        cmocka_unit_test(large_faces_and_valences_are_modelled),
        cmocka_unit_test(views_in_a_row_are_modelled),
        cmocka_unit_test(every_boundary_was_passed),
        cmocka_unit_test(a_cycle_or_a_word_off_is_found_and_named),
        cmocka_unit_test(a_counter_off_is_found_and_named),
        cmocka_unit_test(another_architecture_is_another_model),
        cmocka_unit_test(a_model_out_of_range_is_refused),
    };
    return cmocka_run_group_tests_name("model", tests, set_up_bench, tear_down_bench);
}
