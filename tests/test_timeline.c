/* SPDX-License-Identifier: Apache-2.0
 *
 * Timelines, from the model's logs: what they say is what the pipeline's own counters and golden
 * say, and what its FIFOs have room for.
 */
#include "timeline_samples.h"

/* --- What it says -------------------------------------------------------------------------------
 */

static void assert_near(uint64_t a, uint64_t b, uint64_t most, const char *what, int i) {
    const uint64_t distance = a > b ? a - b : b - a;
    if (distance > most)
        fail_msg("sample %d, %s: %llu and %llu", i, what, (unsigned long long)a,
                 (unsigned long long)b);
}

/* The counters of the pipeline count each cycle where it happens; the timeline has transactions
 * alone. A stage's run lasts until the sequencer goes on, two cycles longer than the stage works,
 * and in generation 0 until the twins are checked. */
static void busy_and_blocked_are_what_the_counters_say(void **state) {
    (void)state;
    uint32_t refused_runs = 0;
    for (int i = 0; i < SAMPLES; i++) {
        taken v;
        take(&v, &samples[i], 3);
        uint64_t sum[HS_STAGES][HS_ACTIVITIES] = {{0}}, buckets[HS_STAGES][HS_ACTIVITIES] = {{0}};
        uint64_t runs[HS_STAGES] = {0};
        refused_runs += refused(&v) ? v.t.generations : 0;
        for (uint32_t r = 0; r < v.t.runs; r++) {
            runs[v.t.run[r].stage]++;
            for (uint32_t a = 0; a < HS_ACTIVITIES; a++)
                sum[v.t.run[r].stage][a] += v.t.run[r].activity[a];
        }
        for (uint32_t s = 0; s < HS_STAGES; s++) {
            for (uint32_t a = 0; a < HS_ACTIVITY_idle; a++)
                for (uint32_t b = 0; b < v.t.buckets; b++)
                    buckets[s][a] += v.t.activity[s][a][b];
            if (refused(&v) && s == HS_STAGE_classify) /* what it took is not known */
                assert_int_equal(sum[s][HS_ACTIVITY_busy] + sum[s][HS_ACTIVITY_starved], 0);
            if (refused(&v) && s != HS_STAGE_receive && s != HS_STAGE_emit) continue;
            const uint64_t *counted = v.cycles.activity[s];
            assert_near(sum[s][HS_ACTIVITY_busy], counted[HS_ACTIVITY_busy], 0, hs_stage_name(s),
                        i);
            if (s == HS_STAGE_emit) continue; /* below */
            assert_near(buckets[s][HS_ACTIVITY_busy], sum[s][HS_ACTIVITY_busy], 0, "buckets", i);
            assert_near(buckets[s][HS_ACTIVITY_blocked], sum[s][HS_ACTIVITY_blocked], 0, "buckets",
                        i);
            assert_near(sum[s][HS_ACTIVITY_blocked], counted[HS_ACTIVITY_blocked], 0,
                        hs_stage_name(s), i);
            assert_near(sum[s][HS_ACTIVITY_starved], counted[HS_ACTIVITY_starved], 4 * runs[s],
                        hs_stage_name(s), i);
        }
        /* What smooth sends singly, and the sequencer's ops, do not pass the FIFO. */
        const uint64_t *emit = v.cycles.activity[HS_STAGE_emit];
        assert_near(buckets[HS_STAGE_emit][HS_ACTIVITY_busy], emit[HS_ACTIVITY_busy], 0, "emit", i);
        assert_near(buckets[HS_STAGE_emit][HS_ACTIVITY_blocked], emit[HS_ACTIVITY_blocked],
                    8 * v.t.generations + 8 + emit[HS_ACTIVITY_blocked] / 10, "emit blocked", i);
        assert_near(buckets[HS_STAGE_emit][HS_ACTIVITY_busy] +
                        buckets[HS_STAGE_emit][HS_ACTIVITY_blocked] +
                        buckets[HS_STAGE_emit][HS_ACTIVITY_starved],
                    emit[HS_ACTIVITY_busy] + emit[HS_ACTIVITY_blocked] + emit[HS_ACTIVITY_starved],
                    1, "emit, all", i);
        give_back(&v);
    }
    assert_true(refused_runs > 0);
}

static void generations_are_goldens(void **state) {
    (void)state;
    uint32_t seen = 0;
    for (int i = 0; i < SAMPLES; i++) {
        taken v;
        take(&v, &samples[i], 3);
        for (uint32_t g = 0; g < v.t.generations && !refused(&v); g++, seen++) {
            const hs_timeline_generation *of = &v.t.generation[g];
            const hs_generation *golden = &v.report.generation[g];
            assert_int_equal(of->number, g);
            assert_int_equal(of->items, g ? golden->active : golden->corners);
            assert_int_equal(of->vertices, golden->vertices);
            assert_int_equal(of->refined, golden->refined);
            if (v.report.status == HS_STATUS_STOPPED && g + 1 == v.t.generations)
                assert_true(of->selected > 0 && golden->selected == 0); /* what select said */
            else if (!samples[i].settings.uniform)
                assert_int_equal(of->selected, golden->selected);
            assert_true(of->begin < of->end && of->end <= v.t.end);
            if (g) assert_int_equal(of->begin, v.t.generation[g - 1].end);
        }
        give_back(&v);
    }
    assert_true(seen > 50);
}

/* Levels that the hardware has room for; and between two runs of a stage there is nothing in it. */
static void fills_are_within_their_fifos_and_end_empty(void **state) {
    (void)state;
    uint32_t full = 0;
    for (int i = 0; i < SAMPLES; i++) {
        taken v;
        take(&v, &samples[i], 3);
        assert_true(v.t.most[HS_FILL_transform] <= 10);
        assert_true(v.t.most[HS_FILL_ops] <= v.config.ops);
        assert_true(v.t.most[HS_FILL_smooth] <= 7);
        assert_true(v.t.most[HS_FILL_pack] <= 4 * 4 + v.config.port);
        assert_true(v.t.most[HS_FILL_classify] <= 512 + 32 && v.t.most[HS_FILL_split] <= 512 + 32);
        full += v.t.most[HS_FILL_ops] == v.config.ops;
        for (uint32_t f = HS_FILL_classify; f <= HS_FILL_ops; f++)
            for (uint32_t b = 0; b < v.t.buckets; b++) {
                bool within = false;
                for (uint32_t r = 0; r < v.t.runs; r++)
                    within |= (f == HS_FILL_ops ? v.t.run[r].stage >= HS_STAGE_smooth
                                                : v.t.run[r].stage == hs_timeline_fill_stage(f)) &&
                              v.t.run[r].stage != HS_STAGE_emit &&
                              v.t.run[r].begin < (b + 1) * v.t.bucket &&
                              v.t.run[r].end > b * v.t.bucket;
                if (!within && v.t.fill[f][b])
                    fail_msg("sample %d: %s: %u in bucket %u", i, hs_timeline_fill_name(f),
                             v.t.fill[f][b], b);
            }
        give_back(&v);
    }
    assert_true(full > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(busy_and_blocked_are_what_the_counters_say),
        cmocka_unit_test(generations_are_goldens),
        cmocka_unit_test(fills_are_within_their_fifos_and_end_empty),
    };
    return cmocka_run_group_tests_name("timeline", tests, NULL, NULL);
}
