/* SPDX-License-Identifier: Apache-2.0
 *
 * How sharp a vertex is (rtl/sharpness.sv) and what kind of vertex that makes it
 * (rtl/vertex_kind.sv), against all edges around each vertex, kept in a list and sorted.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "definitions.h"
#include "sharpness_shim.h"

/* Everything that the corners of a vertex said. */
enum { MOST_EDGES = 256 };
typedef struct vertex {
    uint32_t corners, edges;
    uint8_t own, edge[MOST_EDGES];
} vertex;

static vertex surface[SHARPNESS_VERTICES];
static uint32_t random_state;

static uint32_t random_below(uint32_t n) {
    random_state = random_state * 1664525 + 1013904223;
    return (random_state >> 8) % n;
}

static uint8_t random_sharpness(void) {
    static const uint8_t kinds[] = {0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 15};
    return kinds[random_below(sizeof kinds)];
}

/* The k-th sharpest edge, from 0; 0 if there are fewer. */
static uint8_t sharpest(const vertex *v, uint32_t k) {
    for (uint8_t s = 15; s > 0; s--)
        for (uint32_t i = 0; i < v->edges; i++)
            if (v->edge[i] == s && k-- == 0) return s;
    return 0;
}

static uint32_t word_of(const vertex *v) {
    return sharpest(v, 0) | (uint32_t)sharpest(v, 1) << 4 | (uint32_t)sharpest(v, 2) << 8 |
           (uint32_t)v->own << 12 | (uint32_t)(v->corners > 0) << 16 |
           (uint32_t)(v->corners > 1) << 17;
}

static void note(sharpness_in in) {
    vertex *v = &surface[in.index];
    v->corners++;
    if (in.own > v->own) v->own = in.own;
    v->edge[v->edges++] = in.boundary ? HS_SHARP_INFINITE : in.sharpness;
    if (in.boundary) v->edge[v->edges++] = HS_SHARP_INFINITE;
}

/* A view: its vertices, then corners at `vertices` of them with pauses in per cent of the cycles.
 */
static void send_view(sharpness_shim *shim, uint32_t corners, uint32_t vertices, uint32_t pause,
                      uint32_t boundary) {
    memset(surface, 0, sizeof surface);
    for (uint8_t v = 0; v < SHARPNESS_VERTICES; v++)
        sharpness_cycle(shim, (sharpness_in){.vertex = true, .index = v});
    for (uint32_t sent = 0; sent < corners;) {
        sharpness_in in = {.corner = random_below(100) >= pause,
                           .index = (uint8_t)random_below(vertices),
                           .boundary = random_below(100) < boundary,
                           .sharpness = random_sharpness(),
                           .own = random_below(4) ? 0 : random_sharpness()};
        sharpness_cycle(shim, in);
        if (in.corner) note(in);
        sent += in.corner;
    }
    sharpness_cycle(shim, (sharpness_in){0}); /* the last corner is written */
}

static void every_word_says_the_three_sharpest_edges(void **state) {
    (void)state;
    static const uint32_t pauses[] = {0, 30, 80};
    sharpness_shim *shim = sharpness_new(5);
    random_state = 1;
    uint32_t seen[2] = {0};
    for (uint32_t view = 0; view < 300; view++) {
        const uint32_t vertices = 1 + view % SHARPNESS_VERTICES;
        send_view(shim, 1 + random_below(3 * vertices), vertices, pauses[view % 3],
                  view % 4 == 0 ? 20 : 0);
        for (uint8_t v = 0; v < SHARPNESS_VERTICES; v++) {
            assert_int_equal(sharpness_word(shim, v), word_of(&surface[v]));
            seen[0] += surface[v].corners == 1;
            seen[1] += sharpest(&surface[v], 2) > 0;
        }
    }
    assert_true(seen[0] > 100 && seen[1] > 100);
    sharpness_free(shim);
}

/* Corners of the same one, two or three vertices in a row: what was written last is not yet read.
 */
static void corners_of_a_vertex_may_follow_each_other_closely(void **state) {
    (void)state;
    sharpness_shim *shim = sharpness_new(6);
    random_state = 2;
    for (uint32_t view = 0; view < 400; view++) {
        const uint32_t vertices = 1 + view % 3;
        send_view(shim, 1 + random_below(8), vertices, view % 8 < 4 ? 0 : 40, view % 5 ? 0 : 30);
        for (uint8_t v = 0; v < SHARPNESS_VERTICES; v++)
            assert_int_equal(sharpness_word(shim, v), word_of(&surface[v]));
    }
    sharpness_free(shim);
}

/* Be it the first, second or third corner of its vertex; its own sharpness then has no meaning. */
static void a_boundary_half_edge_counts_as_two_edges(void **state) {
    (void)state;
    sharpness_shim *shim = sharpness_new(7);
    for (uint32_t at = 0; at < 3; at++) {
        sharpness_cycle(shim, (sharpness_in){.vertex = true, .index = 9});
        for (uint32_t i = 0; i < 3; i++)
            sharpness_cycle(shim, (sharpness_in){.corner = true,
                                                 .index = 9,
                                                 .boundary = i == at,
                                                 .sharpness = (uint8_t)(i == at ? 9 : 2 + i)});
        sharpness_cycle(shim, (sharpness_in){0});
        const uint32_t third = at == 2 ? 3 : 4;
        assert_int_equal(sharpness_word(shim, 9), 0x300ff | third << 8);
    }
    sharpness_free(shim);
}

/* By the sentences of docs/refinement.md, section 9, not by the hardware's. */
static vertex_kind kind_of(uint32_t word, uint32_t level, bool corners_stay) {
    uint32_t sharpness[3]; /* own, third, second; 1000 levels are for ever */
    for (uint32_t i = 0; i < 3; i++) {
        sharpness[i] = word >> (12 - 4 * i) & 15;
        if (sharpness[i] == 15) sharpness[i] = 1000;
    }
    const bool one_face = !(word >> 17);
    const uint32_t holds = sharpness[0] > sharpness[1] ? sharpness[0] : sharpness[1];
    if (level < holds || (corners_stay && one_face && sharpness[2] == 1000))
        return (vertex_kind){.stays = true};
    return (vertex_kind){.crease = level < sharpness[2]};
}

static void kinds_follow_from_word_and_level(void **state) {
    (void)state;
    static const uint8_t levels[] = {0, 1, 2, 8, 9, 10, 14, 15, 16, 125, 255};
    sharpness_shim *shim = sharpness_new(8);
    uint32_t counts[3] = {0};
    for (uint32_t word = 0; word < 1u << 18; word += 3) /* 3: every bit and digit changes */
        for (size_t i = 0; i < sizeof levels; i++) {
            const bool corners_stay = word & 2;
            const vertex_kind is = sharpness_kind(shim, word, levels[i], corners_stay);
            const vertex_kind should = kind_of(word, levels[i], corners_stay);
            if (is.stays != should.stays || is.crease != should.crease)
                fail_msg("word 0x%05x at level %d: stays %d, crease %d", word, levels[i], is.stays,
                         is.crease);
            counts[is.stays ? 0 : is.crease ? 1 : 2]++;
        }
    assert_true(counts[0] > 1000 && counts[1] > 1000 && counts[2] > 1000);
    sharpness_free(shim);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_word_says_the_three_sharpest_edges),
        cmocka_unit_test(corners_of_a_vertex_may_follow_each_other_closely),
        cmocka_unit_test(a_boundary_half_edge_counts_as_two_edges),
        cmocka_unit_test(kinds_follow_from_word_and_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
