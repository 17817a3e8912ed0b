/* SPDX-License-Identifier: Apache-2.0
 *
 * Views in flight, in the model alone: whatever their number, each view's words are golden's; one
 * is what the model alone says; more are faster, and each pipeline gets its turn.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

#include "compare.h"
#include "model.h"
#include "shape.h"
#include "view.h"

enum { ROW = 12 };

static hs_packet in[ROW], out[ROW];
static hs_golden_report report[ROW];
static hs_flight_view at[ROW];
static const hs_stalls none = {0};

static int set_up(void **state) {
    (void)state;
    hs_mesh mesh;
    hs_views views;
    hs_error err;
    const hs_settings s = {.front_depth = 3, .silhouette_depth = 5, .guard = true};
    assert_true(hs_shape_make(&mesh, "torus", 0, 0, &err));
    assert_true(hs_views_orbit(&views, ROW, &mesh, 1, &err));
    for (uint32_t v = 0; v < ROW; v++)
        assert_true(hs_packet_encode(&in[v], v, &mesh, views.view[v].matrix, &s, &err));
    hs_views_free(&views);
    hs_mesh_free(&mesh);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    for (uint32_t v = 0; v < ROW; v++) {
        hs_packet_free(&in[v]);
        hs_packet_free(&out[v]);
    }
    return 0;
}

/* Streams all views; the cycles that they take. */
static uint64_t fly(uint32_t views, hs_stalls stalls) {
    hs_model_config config = HS_DEFAULT_CONFIG;
    hs_error err;
    uint64_t cycles = 0;
    config.views = views;
    hs_flight *flight = hs_flight_new(HS_DEFAULT_LIMITS, config, &err);
    assert_non_null(flight);
    assert_true(hs_flight_run(flight, in, ROW, stalls, out, report, at, &cycles, NULL, &err));
    hs_flight_free(flight);
    return cycles;
}

static void each_view_is_goldens_however_many_are_in_flight(void **state) {
    (void)state;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    hs_packet expected = {0};
    hs_golden_report ignored;
    hs_error err;
    for (uint32_t views = 1; views <= 8; views++) {
        const hs_stalls stalls = {.seed = views, .input = 20, .output = 30};
        fly(views, stalls);
        for (uint32_t v = 0; v < ROW; v++) {
            assert_true(hs_golden_run(golden, &in[v], &expected, &ignored, &err));
            const hs_word_comparison c = hs_compare_words(&expected, &out[v]);
            assert_true(c.compared > 1000);
            assert_int_equal(c.different, 0);
        }
    }
    hs_packet_free(&expected);
    hs_golden_free(golden);
}

static void one_in_flight_is_one_behind_the_other(void **state) {
    (void)state;
    hs_error err;
    hs_packet alone = {0};
    hs_golden_report ignored;
    hs_cycle_report cycles;
    hs_model *model = hs_model_new(HS_DEFAULT_LIMITS, HS_DEFAULT_CONFIG, &err);
    assert_non_null(model);
    const uint64_t all = fly(1, none);
    assert_int_equal(all, at[ROW - 1].end - at[0].start + 1);
    for (uint32_t v = 0; v < ROW; v++) {
        assert_true(hs_model_run(model, &in[v], none, &alone, &ignored, &cycles, NULL, &err));
        /* The first is alone; the others are offered while the one before is at work. */
        if (v == 0) assert_int_equal(at[v].end - at[v].start + 1, cycles.cycles);
        if (v > 0) assert_int_equal(at[v].end - at[v - 1].end, cycles.cycles + 2);
        assert_int_equal(at[v].pipeline, 0);
    }
    hs_packet_free(&alone);
    hs_model_free(model);
}

static void more_in_flight_are_faster_and_take_turns(void **state) {
    (void)state;
    uint64_t before = fly(1, none);
    for (uint32_t views = 2; views <= 6; views++) {
        uint32_t used = 0;
        const uint64_t cycles = fly(views, none);
        assert_true(cycles < before);
        assert_true(views > 3 || cycles * views < before * (views - 1) * 5 / 4);
        for (uint32_t v = 0; v < ROW; v++) {
            assert_true(at[v].pipeline < views);
            if (v < views) assert_int_equal(at[v].pipeline, v);
            used |= 1u << at[v].pipeline;
        }
        assert_int_equal(used, (1u << views) - 1);
        before = cycles;
    }
}

/* Each field of the register is a number of its own. */
static void the_register_says_what_the_architecture_is(void **state) {
    (void)state;
    for (uint32_t n = 0; n < 16; n++) {
        const uint32_t k[7] = {n,
                               (n + 1) & 15,
                               (n + 3) & 15,
                               (n + 4) & 15,
                               (n + 7) & 15,
                               (n + 10) & 15,
                               (n + 13) & 15};
        uint32_t architecture = 0;
        for (uint32_t i = 0; i < 7; i++)
            architecture |= k[i] << 4 * i;
        const hs_model_config c = hs_model_config_decode(architecture);
        assert_int_equal(c.port, 1u << k[0]);
        assert_int_equal(c.banks, 1u << k[1]);
        assert_int_equal(c.window, 1u << k[2]);
        assert_int_equal(c.lanes, 1u << k[3]);
        assert_int_equal(c.latency, k[4]);
        assert_int_equal(c.ops, 1u << k[5]);
        assert_int_equal(c.views, k[6]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_register_says_what_the_architecture_is),
        cmocka_unit_test(each_view_is_goldens_however_many_are_in_flight),
        cmocka_unit_test(one_in_flight_is_one_behind_the_other),
        cmocka_unit_test(more_in_flight_are_faster_and_take_turns),
    };
    return cmocka_run_group_tests_name("flight", tests, set_up, tear_down);
}
