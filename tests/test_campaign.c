/* SPDX-License-Identifier: Apache-2.0
 *
 * The differential campaign, bounded, and what it is worth: faults planted in the RTL's results are
 * found, their cases are cut down to the smallest that show them, and the traces of these show them
 * too. HS_CASES=10 makes ten times as many cases.
 */
#include "campaign_coverage.h"
#include "campaign_shrink.h"

#include "file.h"
#include "trace.h"

#define FOLDER "build/test-campaign"

static int set_up(void **state) {
    checker *c = malloc(sizeof *c);
    assert_non_null(c);
    checker_begin(c);
    *state = c;
    return 0;
}

static int tear_down(void **state) {
    checker_end(*state);
    free(*state);
    return 0;
}

/* --- A short campaign ---------------------------------------------------------------------------
 */

static void random_cases_hold_in_all_engines(void **state) {
    checker *c = *state;
    static campaign_case which;
    static coverage seen;
    const uint32_t count = cases(63);
    for (uint64_t seed = 1; seed <= count; seed++) {
        campaign_make(&which, seed);
        if (!campaign_check(c, &which)) fail_msg("seed %u: %s", (unsigned)seed, c->text);
        coverage_add(&seen, &which, c);
    }
    const tally *t = &c->tally;
    print_message("%llu cases, %llu words, %llu transactions, %llu cycles\n",
                  (unsigned long long)t->cases, (unsigned long long)t->words,
                  (unsigned long long)t->transactions, (unsigned long long)t->cycles);
    for (uint32_t v = 0; v < VIEW_TYPES; v++)
        assert_true(seen.view[v] > 0);
    assert_true(seen.status[HS_STATUS_OK] > 30 && seen.status[HS_STATUS_BAD_MAGIC] == 1);
    assert_true(t->words > 100000 && t->transactions > 100000 && t->reference_vertices > 10000 &&
                t->edges > 10000 && t->rings > 1000 && t->positions > 1000 && t->corners > 1000 &&
                t->poisoned > 100000);
}

/* What never occurred is named: a campaign that leaves a kind out fails by it. */
static void kinds_without_a_case_are_counted(void **state) {
    (void)state;
    static coverage none, all;
    for (size_t i = 0; i < sizeof all / sizeof(uint64_t); i++)
        ((uint64_t *)&all)[i] = 1;
    assert_int_equal(coverage_print(&all), 0);
    assert_int_equal(coverage_print(&none),
                     MESHES + COORDINATES + VIEW_TYPES + FAULTS + 2 + TRAIT_COUNT);
    all.view[VIEW_zero] = 0;
    assert_int_equal(coverage_print(&all), 1);
}

static void limits_beyond_the_capacity_are_refused(void **state) {
    checker *c = *state;
    hs_error err = {0};
    assert_false(hs_rtl_limit(c->bench->rtl, (hs_limits){1 << 24, 100}, &err));
    assert_int_equal(err.code, HS_EXIT_USAGE);
    assert_false(hs_rtl_limit(c->bench->rtl, (hs_limits){100, 1 << 24}, &err));
    assert_int_equal(err.code, HS_EXIT_USAGE);
}

/* A case is its seed's, whatever came before. */
static void a_seed_makes_the_same_case_again(void **state) {
    (void)state;
    static campaign_case one, other;
    for (uint64_t seed = 1; seed < 50; seed++) {
        campaign_make(&one, seed);
        campaign_make(&other, seed + 1);
        assert_memory_not_equal(&one.shape, &other.shape, sizeof one.shape);
        campaign_make(&other, seed);
        assert_memory_equal(&one, &other, sizeof one);
    }
}

/* --- Planted faults -----------------------------------------------------------------------------
 */

/* Corner h of a packet. */
static const uint32_t *corner_of(const hs_packet *in, uint32_t h) {
    return in->word + 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS + (size_t)in->word[3] + h);
}

static bool accepted(const bench *b) {
    return b->golden_report.status <= HS_STATUS_STOPPED;
}

/* A wrong word, where there is a face of five sides or more. */
static void spoil_words_of_n_gons(bench *b, const hs_packet *in, hs_stalls stalls) {
    (void)stalls;
    for (uint32_t h = 0; accepted(b) && h < in->word[5]; h++)
        if ((corner_of(in, h)[2] & 0xff) >= 5) {
            b->actual.word[b->actual.words - 1] ^= 1;
            return;
        }
}

/* A transaction in another cycle, where an edge inside is sharp for two levels or more. */
static void spoil_time_of_creases(bench *b, const hs_packet *in, hs_stalls stalls) {
    (void)stalls;
    for (uint32_t h = 0; accepted(b) && h < in->word[5]; h++) {
        const uint32_t *corner = corner_of(in, h);
        if (corner[1] == HS_BORDER || (corner[3] & 15) < 2) continue;
        b->rtl_log.probe[HS_PROBE_beat_out].transaction[0].cycle++;
        return;
    }
}

/* A wrong counter, at three steps and more without a guard, while the output pauses. */
static void spoil_counters_of_stalls(bench *b, const hs_packet *in, hs_stalls stalls) {
    const bool guard = in->word[2] & HS_FLAG_GUARD, uniform = in->word[2] & HS_FLAG_UNIFORM;
    if (accepted(b) && !guard && !uniform && (in->word[6] & 0xff) >= 3 && stalls.output)
        b->rtl_report.conflicts++;
}

/* A wrong word in closed meshes with a vertex of five faces, if vertices leave at their limits. */
static void spoil_words_of_closed_meshes(bench *b, const hs_packet *in, hs_stalls stalls) {
    (void)stalls;
    uint32_t valence[POLYGONS_VERTICES] = {0}, most = 0;
    if (!accepted(b) || !(in->word[2] & HS_FLAG_LIMIT)) return;
    for (uint32_t h = 0; h < in->word[5]; h++) {
        if (corner_of(in, h)[1] == HS_BORDER) return;
        if (++valence[corner_of(in, h)[0]] > most) most = valence[corner_of(in, h)[0]];
    }
    if (most >= 5) b->actual.word[1] ^= 1;
}

/* A wrong status of packets that end too early. */
static void spoil_cut_packets(bench *b, const hs_packet *in, hs_stalls stalls) {
    (void)in;
    (void)stalls;
    if (b->golden_report.status == HS_STATUS_TRUNCATED) b->actual.word[5] ^= 1;
}

/* What the smallest case of a fault looks like, at most: which of several it comes down to depends
 * on the order of what is tried. */
typedef struct planted {
    void (*spoil)(bench *b, const hs_packet *in, hs_stalls stalls);
    const char *failed;
    uint32_t faces, vertices, sides, tags; /* sides: of the largest face */
    hs_settings settings;
    uint32_t stall_out;
} planted;

static void assert_smallest(const campaign_case *c, const planted *p) {
    static const float identity_matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    uint32_t sides = 0;
    for (uint32_t f = 0; f < c->shape.faces; f++) {
        assert_int_equal(c->shape.forced[f], 0);
        if (c->shape.sides[f] > sides) sides = c->shape.sides[f];
    }
    assert_true(c->shape.faces <= p->faces);
    assert_true(c->shape.vertices <= p->vertices);
    assert_true(c->shape.tags <= p->tags);
    assert_true(sides <= p->sides);
    const hs_settings *a = &c->settings, *b = &p->settings;
    assert_int_equal(a->front_depth, b->front_depth);
    assert_int_equal(a->silhouette_depth, b->silhouette_depth);
    assert_int_equal(a->uniform, b->uniform);
    assert_int_equal(a->guard, b->guard);
    assert_int_equal(a->limit, b->limit);
    assert_int_equal(a->boundary, b->boundary);
    assert_int_equal(a->min_edge, b->min_edge);
    assert_int_equal(c->stalls.input, 0);
    assert_int_equal(c->stalls.output, p->stall_out);
    assert_int_equal(c->limits.vertices, HS_DEFAULT_LIMITS.vertices);
    assert_int_equal(c->limits.quads, HS_DEFAULT_LIMITS.quads);
    assert_memory_equal(c->matrix, identity_matrix, sizeof identity_matrix);
}

/* The folder's trace fails in the same way as long as the fault is there, and holds without it. */
static void assert_trace_shows(checker *c, const char *folder, const planted *p) {
    hs_error err;
    assert_false(campaign_replay(c, folder, &err));
    if (!c->failed) fail_msg("%s", err.text);
    assert_string_equal(c->failed, p->failed);
    c->bench->spoil = NULL;
    if (!campaign_replay(c, folder, &err)) fail_msg("%s", c->failed ? c->text : err.text);
}

static void planted_faults_shrink_to_the_smallest_case_and_its_trace(void **state) {
    checker *c = *state;
    static campaign_case which;
    const hs_settings least = {.guard = true};
    const planted all[] = {
        {spoil_words_of_n_gons, "words", 1, 5, 5, 0, least, 0},
        {spoil_time_of_creases, "transactions", 2, 4, 3, 1, least, 0},
        {spoil_counters_of_stalls, "counters", 1, 3, 3, 0, {.front_depth = 3}, 50},
        {spoil_words_of_closed_meshes, "words", 5, 6, 6, 0, {.guard = true, .limit = true}, 0},
        {spoil_cut_packets, "words", 1, 3, 3, 0, least, 0},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const planted *p = &all[i];
        char folder[100];
        hs_error err;
        uint64_t seed = 1000 * (i + 1);
        c->bench->spoil = p->spoil;
        do
            campaign_make(&which, ++seed);
        while (which.shape.faces > 50 || campaign_check(c, &which));
        assert_string_equal(c->failed, p->failed);
        const uint32_t faces = which.shape.faces, tried = campaign_shrink(c, &which, 60);
        assert_string_equal(c->failed, p->failed);
        print_message("fault %zu: seed %u, from %u faces to %u in %u steps: %s\n", i,
                      (unsigned)seed, faces, which.shape.faces, tried, c->text);
        assert_smallest(&which, p);
        snprintf(folder, sizeof folder, FOLDER "/fault-%zu", i);
        if (!campaign_write(&which, folder, "planted", &err)) fail_msg("%s", err.text);
        assert_trace_shows(c, folder, p);
    }
    c->bench->spoil = NULL;
}

/* --- Traces -------------------------------------------------------------------------------------
 */

/* campaign_write compares the packets. Two turns of the faults, and what is between them. */
static void any_case_can_be_written_as_a_trace(void **state) {
    (void)state;
    static campaign_case which;
    uint32_t spoiled = 0;
    for (uint64_t seed = 9; seed < 409; seed += seed % 10 == 9 ? 3 : 7) {
        hs_error err;
        campaign_make(&which, seed);
        if (!campaign_write(&which, FOLDER "/any", "any", &err))
            fail_msg("seed %u: %s", (unsigned)seed, err.text);
        spoiled += which.fault != HS_STATUS_OK;
    }
    assert_int_equal(spoiled, 40);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_cases_hold_in_all_engines),
        cmocka_unit_test(kinds_without_a_case_are_counted),
        cmocka_unit_test(limits_beyond_the_capacity_are_refused),
        cmocka_unit_test(a_seed_makes_the_same_case_again),
        cmocka_unit_test(planted_faults_shrink_to_the_smallest_case_and_its_trace),
        cmocka_unit_test(any_case_can_be_written_as_a_trace),
    };
    return cmocka_run_group_tests_name("campaign", tests, set_up, tear_down);
}
