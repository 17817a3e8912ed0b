/* SPDX-License-Identifier: Apache-2.0
 *
 * Logs of transactions without an RTL: what their comparison counts and says, that the model
 * writes none of what is beyond its memories, and when it says that a generation begins.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "model.h"
#include "shape.h"
#include "view.h"

static void fill(hs_log *log, uint32_t count) {
    for (uint32_t p = 0; p < HS_PROBES; p++)
        for (uint32_t i = 0; i < count; i++)
            hs_log_add(log, p, 100 * i + p, i, (const uint32_t[4]){i, 2 * i, 3 * i, p});
}

static void all_transactions_are_compared(void **state) {
    (void)state;
    hs_log a = {0}, b = {0};
    fill(&a, 5000); /* more than a log has room for at first */
    fill(&b, 5000);
    hs_log_comparison c = hs_log_compare(&a, "a", &b, "b", 0);
    assert_int_equal(c.compared, 5000 * HS_PROBES);
    assert_int_equal(c.different, 0);
    hs_log_add(&b, 3, 1, 2, (const uint32_t[4]){0});
    c = hs_log_compare(&a, "a", &b, "b", 0);
    assert_int_equal(c.compared, 5000 * HS_PROBES + 1);
    assert_int_equal(c.different, 1);
    c = hs_log_compare(&a, "a", &b, "b", UINT64_C(1) << 3);
    assert_int_equal(c.compared, 5000 * (HS_PROBES - 1));
    assert_int_equal(c.different, 0);
    hs_log_free(&a);
    hs_log_free(&b);
}

static void the_earliest_difference_is_told(void **state) {
    (void)state;
    hs_log a = {0}, b = {0};
    char expected[400];
    fill(&a, 20);
    fill(&b, 20);
    b.probe[2].transaction[9].word[3] = 0xabcdef01;
    b.probe[5].transaction[8].cycle--;
    b.probe[7].transaction[17].item = 99;
    const hs_log_comparison c = hs_log_compare(&a, "one", &b, "other", 0);
    assert_int_equal(c.different, 3);
    assert_int_equal(c.probe, 5);
    assert_int_equal(c.cycle, 804);
    snprintf(expected, sizeof expected,
             "stage %s, %s, transaction 8; one: cycle 805, item 8, 00000008 00000010 00000018 "
             "00000005; other: cycle 804, item 8, 00000008 00000010 00000018 00000005",
             hs_stage_name(hs_probe_stage(5)), hs_probe_name(5));
    assert_string_equal(c.text, expected);
    hs_log_free(&a);
    hs_log_free(&b);
}

/* --- The model's --------------------------------------------------------------------------------
 */

/* A shape from in front, by the model, with its log. */
typedef struct modelled {
    hs_model *model;
    hs_packet in, out;
    hs_golden_report report;
    hs_cycle_report cycles;
    hs_log log;
    uint32_t vertices;
} modelled;

static void run_model(modelled *m, hs_stalls stalls, hs_log *log) {
    hs_error err;
    assert_true(hs_model_run(m->model, &m->in, stalls, &m->out, &m->report, &m->cycles, log, &err));
}

static void take_view(modelled *m, const char *shape, uint32_t size, const hs_settings *settings,
                      hs_limits capacity, hs_stalls stalls) {
    hs_mesh mesh;
    hs_views views;
    hs_error err;
    hs_model_config config = HS_DEFAULT_CONFIG;
    config.capacity = capacity;
    *m = (modelled){0};
    assert_true(hs_shape_make(&mesh, shape, size, 1, &err));
    assert_true(hs_views_orbit(&views, 1, &mesh, 1, &err));
    assert_true(hs_packet_encode(&m->in, 0, &mesh, views.view[0].matrix, settings, &err));
    m->vertices = mesh.vertices;
    hs_views_free(&views);
    hs_mesh_free(&mesh);
    m->model = hs_model_new(capacity, config, &err);
    assert_non_null(m->model);
    run_model(m, stalls, &m->log);
}

static void leave_view(modelled *m) {
    hs_model_free(m->model);
    hs_log_free(&m->log);
    hs_packet_free(&m->in);
    hs_packet_free(&m->out);
}

/* A cube of 26 vertices whose 48 quads would each get one more: the view stops, and of the new
 * vertices only those that the memories hold are written. */
static void what_is_beyond_the_memories_is_not_written(void **state) {
    (void)state;
    const hs_settings settings = {.front_depth = 4, .silhouette_depth = 4, .guard = true};
    const hs_limits capacity = {32, 256};
    modelled m;
    take_view(&m, "cube", 2, &settings, capacity, (hs_stalls){0});
    const size_t written = m.log.probe[HS_PROBE_guard_new].count;
    assert_int_equal(written, capacity.vertices - m.vertices);
    for (size_t i = 0; i < written; i++)
        assert_int_equal(m.log.probe[HS_PROBE_guard_new].transaction[i].item, m.vertices + i);
    for (size_t i = 0; i < m.log.probe[HS_PROBE_guard_out].count; i++)
        assert_true(m.log.probe[HS_PROBE_guard_out].transaction[i].word[2] < capacity.vertices);
    assert_true(m.log.probe[HS_PROBE_guard_out].count > capacity.vertices);
    leave_view(&m);
}

/* The kicks of classify, which begins each generation. */
static void a_generation_begins_where_its_first_stage_starts(void **state) {
    (void)state;
    const hs_settings settings = {.front_depth = 2, .silhouette_depth = 4, .guard = true};
    const hs_stalls stalls = {.seed = 1, .input = 20, .output = 20};
    modelled m;
    take_view(&m, "hand", 0, &settings, HS_DEFAULT_LIMITS, stalls);
    uint32_t found = 0;
    for (size_t i = 0; i < m.log.probe[HS_PROBE_kick].count; i++) {
        const hs_transaction *t = &m.log.probe[HS_PROBE_kick].transaction[i];
        if (t->item != HS_STAGE_classify) continue;
        assert_int_equal(t->word[0], found);
        assert_int_equal(hs_model_generation_cycle(m.model, found),
                         m.cycles.begin + t->cycle - m.cycles.start);
        found++;
    }
    assert_int_equal(found, 4); /* the last step, 3 to 4, leaves nothing to classify */
    assert_true(hs_model_generation_cycle(m.model, found) == HS_NO_CYCLE);
    m.in.word[0] = 0;
    run_model(&m, stalls, NULL);
    assert_true(hs_model_generation_cycle(m.model, 0) == HS_NO_CYCLE);
    leave_view(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_transactions_are_compared),
        cmocka_unit_test(the_earliest_difference_is_told),
        cmocka_unit_test(what_is_beyond_the_memories_is_not_written),
        cmocka_unit_test(a_generation_begins_where_its_first_stage_starts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
