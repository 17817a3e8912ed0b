/* SPDX-License-Identifier: Apache-2.0 */
#include "strikes.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "golden.h"
#include "memories.h"
#include "rtl.h"
#include "shape.h"
#include "view.h"

#define PROGRAM "strikes"
#include "quit.h"

/* Aimed at are memories of up to so many bits: their words are compared in every cycle. */
enum { MOST_AIMED = 1 << 19 };

enum { CASES = 10, CAPACITY = 1024 };

/* Views that use all there is: refinement by marks, with and without the guard ring, boundaries,
 * creases, n-gons, limit positions, and uniform runs in one pass. */
static const struct {
    const char *shape;
    uint32_t size;
    uint8_t front, silhouette, uniform;
    uint32_t flags;
} CASE[CASES] = {
    {"tetrahedron", 0, 2, 4, 0, 0},
    {"cube", 1, 3, 3, 0, HS_FLAG_GUARD},
    {"mixed", 0, 1, 2, 0, HS_FLAG_SMOOTH},
    {"grid", 2, 2, 3, 0, HS_FLAG_GUARD | HS_FLAG_SMOOTH},
    {"grid", 3, 2, 2, 0, HS_FLAG_LIMIT | HS_FLAG_EDGE_ONLY},
    {"cube", 1, 0, 0, 5, HS_FLAG_UNIFORM},
    {"torus", 5, 0, 0, 4, HS_FLAG_UNIFORM},
    {"cube", 1, 0, 0, 3, HS_FLAG_UNIFORM | HS_FLAG_LIMIT},
    {"grid", 2, 0, 0, 3, HS_FLAG_UNIFORM | HS_FLAG_SMOOTH},
    {"icosahedron", 0, 1, 4, 0, HS_FLAG_GUARD},
};

typedef struct view_case {
    hs_packet in, out;
    uint64_t cycles; /* of the view */
    uint64_t end[2]; /* of the run, to the last beat, without and with stalls */
    uint32_t faces;  /* of the output */
} view_case;

static const hs_stalls STALLS[2] = {{0}, {.output = 70, .seed = 5}};

typedef struct strike {
    uint64_t cycle;
    uint32_t memory, row, bit;
    uint32_t rows;  /* of the memory */
    bool aimed;     /* at what is written next, not at row */
    uint32_t delay; /* cycles behind that */
    bool written, done;
    unsigned char *before; /* aimed: the memory's words a cycle ago */
} strike;

/* The row that was written in the last cycle, if one was. */
static bool find_written(strike *s, void *top) {
    uint32_t bytes;
    const unsigned char *words = hs_memory_words(top, s->memory, &bytes);
    const size_t size = (size_t)bytes * s->rows;
    bool found = false;
    if (!s->before) {
        s->before = malloc(size);
        if (!s->before) exit(1);
    } else if (memcmp(s->before, words, size) != 0) {
        for (uint32_t row = 0; row < s->rows && !found; row++)
            if (memcmp(s->before + (size_t)row * bytes, words + (size_t)row * bytes, bytes) != 0) {
                s->row = row;
                found = true;
            }
    }
    memcpy(s->before, words, size);
    return found;
}

static void hit(void *context, void *top, uint64_t cycle) {
    strike *s = context;
    if (s->done || cycle < s->cycle) return;
    if (s->aimed && !s->written) s->written = find_written(s, top);
    if (s->aimed && (!s->written || s->delay-- > 0)) return;
    hs_memory_flip(top, s->memory, s->row, s->bit);
    s->done = true;
}

static bool equal(const hs_packet *expected, const hs_packet *actual) {
    return expected->words == actual->words &&
           memcmp(expected->word, actual->word, 4 * actual->words) == 0;
}

static uint32_t draw(uint64_t *state, uint64_t below) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 33) % below);
}

/* Banks of one memory are one: their names differ behind ".bank". */
static uint32_t find_memories(hs_struck struck[HS_MOST_MEMORIES]) {
    uint32_t count = 0;
    for (uint32_t m = 0; m < hs_memory_count(); m++) {
        const char *name = hs_memory_at(m).name;
        const char *bank = strstr(name, ".bank");
        const size_t length = bank ? (size_t)(bank - name) : strlen(name);
        uint32_t k = 0;
        while (k < count &&
               (strlen(struck[k].name) != length || strncmp(struck[k].name, name, length) != 0))
            k++;
        if (k == count) {
            if (count == HS_MOST_MEMORIES || length >= sizeof struck[k].name) {
                fprintf(stderr, "%s: too many kinds of memories, or too long a name\n", name);
                exit(1);
            }
            struck[count++] = (hs_struck){.first = m};
            memcpy(struck[k].name, name, length);
        }
        struck[k].banks++;
    }
    return count;
}

static void make_case(view_case *c, uint32_t number, hs_rtl *rtl) {
    hs_error err = {0};
    hs_mesh mesh;
    hs_views views;
    const hs_settings settings = {
        .uniform = CASE[number].flags & HS_FLAG_UNIFORM,
        .guard = CASE[number].flags & HS_FLAG_GUARD,
        .limit = CASE[number].flags & HS_FLAG_LIMIT,
        .boundary = CASE[number].flags & HS_FLAG_SMOOTH      ? HS_BOUNDARY_SMOOTH
                    : CASE[number].flags & HS_FLAG_EDGE_ONLY ? HS_BOUNDARY_EDGE_ONLY
                                                             : HS_BOUNDARY_KEPT,
        .front_depth = CASE[number].front,
        .silhouette_depth = CASE[number].silhouette,
        .uniform_depth = CASE[number].uniform};
    hs_cycle_report report;
    quit_on(hs_shape_make(&mesh, CASE[number].shape, CASE[number].size, number, &err), &err);
    quit_on(hs_views_orbit(&views, 1, &mesh, 1, &err), &err);
    quit_on(hs_packet_encode(&c->in, number, &mesh, views.view[0].matrix, &settings, &err), &err);
    hs_golden *golden = hs_golden_new((hs_limits){CAPACITY, CAPACITY});
    hs_golden_report said;
    hs_packet actual = {0};
    if (!golden || !hs_golden_run(golden, &c->in, &c->out, &said, &err)) quit_on(false, &err);
    hs_golden_free(golden);
    for (int i = 0; i < 2; i++) {
        hs_output output = {0};
        quit_on(hs_rtl_run(rtl, &c->in, STALLS[i], &actual, &report, &err), &err);
        const bool decodes = hs_output_decode(&output, &actual, &err);
        if (!equal(&c->out, &actual)) {
            fprintf(stderr, "view %u: without a flip the RTL's words are not golden's: %s\n",
                    number, decodes ? hs_status_name(output.status) : err.text);
            exit(1);
        }
        if (i == 0) c->cycles = report.cycles;
        c->end[i] = report.end - report.begin;
        c->faces = output.faces;
        hs_output_free(&output);
    }
    hs_packet_free(&actual);
    hs_views_free(&views);
    hs_mesh_free(&mesh);
}

/* One flip, and the view behind it. False: nothing was written any more that it could have struck.
 */
static bool strike_once(hs_strikes *all, hs_rtl *rtl, const view_case cases[CASES],
                        uint64_t *random, bool loud) {
    const uint32_t number = draw(random, CASES), next = draw(random, CASES);
    const view_case *c = &cases[number];
    hs_struck *struck = &all->memory[draw(random, all->memories)];
    strike s = {.memory = struck->first + draw(random, struck->banks)};
    const hs_memory memory = hs_memory_at(s.memory);
    const uint32_t used = 1 + c->faces / struck->banks, stalled = draw(random, 2);
    s.rows = memory.rows;
    s.aimed = draw(random, 2) && (uint64_t)memory.rows * memory.bits < MOST_AIMED;
    s.delay = draw(random, 2) ? draw(random, 16) : 0;
    s.row = draw(random, draw(random, 4) && used < memory.rows ? used : memory.rows);
    s.bit = draw(random, memory.bits);
    s.cycle = draw(random, c->end[stalled]);

    hs_error err = {0};
    hs_cycle_report report;
    hs_packet actual = {0};
    hs_output output = {0};
    hs_rtl_on_cycle(rtl, hit, &s);
    const bool ran = hs_rtl_run(rtl, &c->in, STALLS[stalled], &actual, &report, &err);
    hs_rtl_on_cycle(rtl, NULL, NULL);
    free(s.before);
    if (ran && !s.done) {
        hs_packet_free(&actual);
        return false;
    }
    char where[160];
    snprintf(where, sizeof where,
             "flip %" PRIu64 ": view %u%s, from cycle %" PRIu64 " on, %s, row %u, bit %u",
             all->flips, number, stalled ? " with stalls" : "", s.cycle, memory.name, s.row, s.bit);
    all->flips++;
    struck->flips++;
    if (ran && equal(&c->out, &actual)) {
        struck->masked++;
    } else if (ran && hs_output_decode(&output, &actual, &err) &&
               output.status == HS_STATUS_MEMORY_FAULT) {
        struck->detected++;
    } else {
        if (loud) printf("%s: silent: %s\n", where, err.text);
        struck->silent++;
    }
    hs_output_free(&output);
    all->cycles += report.cycles;

    c = &cases[next];
    const bool good = hs_rtl_run(rtl, &c->in, (hs_stalls){0}, &actual, &report, &err);
    if (!good || !equal(&c->out, &actual) || report.cycles != c->cycles) {
        const bool decodes = good && hs_output_decode(&output, &actual, &err);
        printf("%s: the next view, %u: %s, %" PRIu64 " cycles instead of %" PRIu64 "\n", where,
               next, decodes ? hs_status_name(output.status) : err.text, report.cycles, c->cycles);
        hs_output_free(&output);
        all->wrong++;
    }
    all->cycles += report.cycles;
    hs_packet_free(&actual);
    return true;
}

hs_strikes hs_strike(uint64_t flips, uint64_t seed, bool loud) {
    static view_case cases[CASES];
    hs_strikes all = {0};
    hs_error err = {0};
    all.memories = find_memories(all.memory);
    hs_rtl *rtl = hs_rtl_new((hs_limits){CAPACITY, CAPACITY}, (uint32_t)seed, &err);
    quit_on(rtl != NULL, &err);
    for (uint32_t i = 0; i < CASES; i++)
        make_case(&cases[i], i, rtl);
    uint64_t random = seed * 977 + 1;
    for (uint64_t tries = 0; all.flips < flips && tries < 10 * flips; tries++)
        strike_once(&all, rtl, cases, &random, loud);
    hs_rtl_free(rtl);
    for (uint32_t i = 0; i < CASES; i++) {
        hs_packet_free(&cases[i].in);
        hs_packet_free(&cases[i].out);
    }
    for (uint32_t i = 0; i < all.memories; i++) {
        all.detected += all.memory[i].detected;
        all.masked += all.memory[i].masked;
        all.silent += all.memory[i].silent;
    }
    return all;
}
