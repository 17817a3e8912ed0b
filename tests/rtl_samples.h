/* SPDX-License-Identifier: Apache-2.0
 *
 * What the tests of the whole RTL share: a bench that streams a packet through the RTL, golden and
 * the cycle-level model and compares every word, every transaction at every stage boundary and
 * every counter; sixteen views of a mesh, and small meshes.
 */
#ifndef HS_TESTS_RTL_SAMPLES_H
#define HS_TESTS_RTL_SAMPLES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "compare.h"
#include "mesh.h"
#include "model.h"
#include "rtl.h"
#include "shape.h"
#include "view.h"

#define FAILED_PACKET "build/rtl-difference.stream" /* the input of the last difference */

static const hs_stalls no_stalls = {0};

/* --- The bench ----------------------------------------------------------------------------------
 */
typedef struct bench {
    hs_limits limits;
    hs_rtl *rtl;
    hs_golden *golden;
    hs_model *model; /* NULL: words alone are compared */
    hs_packet in, expected, actual, modelled;
    hs_golden_report golden_report, modelled_report;
    hs_cycle_report rtl_report, model_report;
    hs_log rtl_log, model_log;
    uint64_t views, words, transactions, cycles; /* compared so far; cycles of the RTL */
    uint64_t passed[HS_PROBES];                  /* transactions, by boundary */
    bool keeps_packet;                           /* of the last difference: FAILED_PACKET */
    /* What the last comparison found: "words", "transactions", "counters"; or the engine that broke
     * down: "golden", "rtl", "model". NULL: no difference. */
    const char *failed;
    /* NULL, or what spoils the RTL's results before they are compared: tests of the comparison. */
    void (*spoil)(struct bench *b, const hs_packet *in, hs_stalls stalls);
} bench;

static inline bench *new_bench(hs_limits limits, uint32_t seed) {
    hs_error err = {0};
    bench *b = calloc(1, sizeof *b);
    assert_non_null(b);
    b->limits = limits;
    b->keeps_packet = true;
    b->golden = hs_golden_new(limits);
    assert_non_null(b->golden);
    b->rtl = hs_rtl_new(limits, seed, &err);
    if (!b->rtl) fail_msg("%s", err.text);
    b->model = hs_model_new(limits, hs_rtl_config(b->rtl), &err);
    if (!b->model) fail_msg("%s", err.text);
    hs_rtl_log(b->rtl, &b->rtl_log);
    return b;
}

/* Gives all engines other limits. */
static inline void limit_bench(bench *b, hs_limits limits) {
    hs_error err = {0};
    b->limits = limits;
    hs_golden_free(b->golden);
    hs_model_free(b->model);
    b->golden = hs_golden_new(limits);
    assert_non_null(b->golden);
    b->model = hs_model_new(limits, hs_rtl_config(b->rtl), &err);
    if (!b->model || !hs_rtl_limit(b->rtl, limits, &err)) fail_msg("%s", err.text);
}

static inline void free_bench(bench *b) {
    hs_rtl_free(b->rtl);
    hs_golden_free(b->golden);
    hs_model_free(b->model);
    hs_packet_free(&b->in);
    hs_packet_free(&b->expected);
    hs_packet_free(&b->actual);
    hs_packet_free(&b->modelled);
    hs_log_free(&b->rtl_log);
    hs_log_free(&b->model_log);
    free(b);
}

/* For tests that share one: cmocka hands *state on. */
static inline int set_up_bench(void **state) {
    *state = new_bench(HS_DEFAULT_LIMITS, 1);
    return 0;
}
static inline int tear_down_bench(void **state) {
    free_bench(*state);
    return 0;
}

/* The generation in which a word of an output packet left: that of the record it stands behind. */
static inline uint32_t generation_of_word(const hs_packet *packet, size_t word) {
    uint32_t generation = 0, positions = 0;
    for (size_t at = 0; at <= word && at + 4 <= packet->words; at += 4) {
        const uint32_t w0 = packet->word[at], kind = w0 >> 20 & 7;
        if (positions > 0) {
            positions--;
        } else if (kind == HS_RECORD_VERTICES || kind == HS_RECORD_FACE || kind == HS_RECORD_MORE ||
                   kind == HS_RECORD_END) {
            generation = w0 & 0xff;
            if (kind == HS_RECORD_VERTICES) positions = w0 >> 16 & 7;
        }
    }
    return generation;
}

/* Says what failed, keeps the packet if that is wanted, and tells where: " (packet in ...)". */
static inline const char *fail_bench(bench *b, const char *failed, const hs_packet *in) {
    hs_error err;
    b->failed = failed;
    FILE *file = b->keeps_packet ? fopen(FAILED_PACKET, "wb") : NULL;
    if (!file) return "";
    hs_frame_write(file, in, FAILED_PACKET, &err);
    fclose(file);
    return " (packet in " FAILED_PACKET ")";
}

/* Compares what the model makes of the packet with what the RTL just did. */
static inline bool same_cycles(bench *b, const hs_packet *in, hs_stalls stalls, const char *what,
                               char *text, size_t size) {
    hs_error err;
    if (!hs_model_run(b->model, in, stalls, &b->modelled, &b->modelled_report, &b->model_report,
                      &b->model_log, &err)) {
        snprintf(text, size, "%s: model: %s%s", what, err.text, fail_bench(b, "model", in));
        return false;
    }
    const bool refused = b->golden_report.status > HS_STATUS_STOPPED;
    const hs_log_comparison c = hs_log_compare(&b->rtl_log, "rtl", &b->model_log, "model",
                                               refused ? HS_LOG_DATA_OF_REFUSED : 0);
    b->transactions += c.compared;
    b->cycles += b->rtl_report.cycles;
    for (uint32_t i = 0; i < HS_PROBES; i++)
        b->passed[i] += b->rtl_log.probe[i].count;
    if (c.different) {
        snprintf(text, size, "%s: %llu of %llu transactions differ; the earliest: %s%s", what,
                 (unsigned long long)c.different, (unsigned long long)c.compared, c.text,
                 fail_bench(b, "transactions", in));
        return false;
    }
    char counter[200];
    if (!hs_cycle_report_equal(&b->rtl_report, &b->model_report, counter, sizeof counter)) {
        snprintf(text, size, "%s: rtl and model count differently: %s%s", what, counter,
                 fail_bench(b, "counters", in));
        return false;
    }
    if (hs_compare_words(&b->actual, &b->modelled).different == 0) return true;
    snprintf(text, size, "%s: the words of the model are not the RTL's%s", what,
             fail_bench(b, "words", in));
    return false;
}

/* Streams a packet through all engines. False, with the place and both words, on a difference. */
static inline bool same_words(bench *b, const hs_packet *in, hs_stalls stalls, const char *what,
                              char *text, size_t size) {
    hs_error err;
    b->failed = NULL;
    if (!hs_golden_run(b->golden, in, &b->expected, &b->golden_report, &err)) {
        snprintf(text, size, "%s: golden: %s%s", what, err.text, fail_bench(b, "golden", in));
        return false;
    }
    if (!hs_rtl_run(b->rtl, in, stalls, &b->actual, &b->rtl_report, &err)) {
        snprintf(text, size, "%s: rtl: %s (golden: %s)%s", what, err.text,
                 hs_status_name(b->golden_report.status), fail_bench(b, "rtl", in));
        return false;
    }
    if (b->spoil) b->spoil(b, in, stalls);
    const hs_word_comparison c = hs_compare_words(&b->expected, &b->actual);
    b->views++;
    b->words += c.compared;
    if (c.different == 0) return !b->model || same_cycles(b, in, stalls, what, text, size);
    char place[500];
    hs_compare_describe(&b->expected, &b->actual, c.first, "rtl", place, sizeof place);
    snprintf(text, size, "%s: view %u, generation %u, %s; %llu of %llu words differ%s", what,
             in->view, generation_of_word(&b->expected, c.first), place,
             (unsigned long long)c.different, (unsigned long long)c.compared,
             fail_bench(b, "words", in));
    return false;
}

static inline void assert_same_words(bench *b, const hs_packet *in, hs_stalls stalls,
                                     const char *what) {
    char text[2000];
    if (!same_words(b, in, stalls, what, text, sizeof text)) fail_msg("%s", text);
}

/* The same for a view of a mesh, whose packet stays in b->in. */
static inline void assert_same_view(bench *b, uint32_t view, const hs_mesh *mesh,
                                    const float matrix[16], const hs_settings *settings,
                                    hs_stalls stalls, const char *what) {
    hs_error err;
    if (!hs_packet_encode(&b->in, view, mesh, matrix, settings, &err)) fail_msg("%s", err.text);
    assert_same_words(b, &b->in, stalls, what);
}

/* --- Settings ----------------------------------------------------------------------------------
 */
static inline hs_settings adaptive(uint8_t front, uint8_t silhouette, bool guard) {
    return (hs_settings){.front_depth = front, .silhouette_depth = silhouette, .guard = guard};
}

static inline hs_settings uniform(uint8_t depth) {
    return (hs_settings){.uniform = true, .uniform_depth = depth};
}

/* --- Random numbers: a linear congruence's upper bits, the same everywhere -----------------------
 */
static inline uint32_t random_below(uint64_t *state, uint32_t limit) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((*state >> 32) * limit >> 32);
}

static const hs_boundary modes[] = {HS_BOUNDARY_KEPT, HS_BOUNDARY_SMOOTH, HS_BOUNDARY_EDGE_ONLY};

/* Any combination of boundary mode, limit, guard, least edge, uniform or not. */
static inline hs_settings any_settings(uint64_t *random) {
    hs_settings s = random_below(random, 3) == 0
                        ? uniform((uint8_t)random_below(random, 6))
                        : adaptive((uint8_t)random_below(random, 5),
                                   (uint8_t)random_below(random, 8), random_below(random, 3) != 0);
    s.boundary = modes[random_below(random, 3)];
    s.limit = random_below(random, 2);
    if (random_below(random, 3) == 0) s.min_edge = (uint16_t)(1 + random_below(random, 2000));
    s.width = (uint16_t)(1 + random_below(random, 2000));
    s.height = (uint16_t)(1 + random_below(random, 2000));
    return s;
}

/* --- Sixteen views of a mesh ---------------------------------------------------------------------
 */
enum { VIEWS = 16 };
static const char *const view_name[VIEWS] = {"orbit 0",  "orbit 1",    "orbit 2",     "orbit 3",
                                             "orbit 4",  "orbit 5",    "orbit 6",     "orbit 7",
                                             "close-up", "very close", "from inside", "grazing",
                                             "far away", "behind us",  "beside",      "singular"};

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* A view of the mesh's bounding box from center + size * eye, towards center + size * at. */
static inline hs_view look(const double center[3], double size, const double eye[3],
                           const double at[3], double fov) {
    hs_view view;
    hs_error err;
    const double up[3] = {0.1, 1, 0.05};
    double from[3], to[3];
    for (int i = 0; i < 3; i++) {
        from[i] = center[i] + size * eye[i];
        to[i] = center[i] + size * at[i];
    }
    if (!hs_view_look(&view, from, to, up, fov, 1.5, size * 0.01, size * 1000, &err))
        fail_msg("%s", err.text);
    return view;
}

static inline void make_views(const hs_mesh *mesh, hs_view view[VIEWS]) {
    hs_views orbit;
    hs_error err;
    if (!hs_views_orbit(&orbit, 8, mesh, 1.5, &err)) fail_msg("%s", err.text);
    memcpy(view, orbit.view, 8 * sizeof *view);
    hs_views_free(&orbit);

    double least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < mesh->vertices; v++)
        for (int i = 0; i < 3; i++) {
            least[i] = fmin(least[i], (double)mesh->position[4 * v + (uint32_t)i]);
            most[i] = fmax(most[i], (double)mesh->position[4 * v + (uint32_t)i]);
        }
    double center[3], size = 0;
    for (int i = 0; i < 3; i++) {
        center[i] = (least[i] + most[i]) / 2;
        size = fmax(size, (most[i] - least[i]) / 2);
    }
    const double close[3] = {0.5, 0.6, 1.3}, closer[3] = {0.3, 0.9, 1.02},
                 inside[3] = {0.1, 0, 0.2}, level[3] = {2.5, 0.02, 0.03}, far[3] = {200, 100, 300},
                 eye[3] = {0.4, 0.3, 4}, middle[3] = {0, 0, 0}, tip[3] = {0.3, 0.9, 0.4},
                 away[3] = {0.4, 0.3, 9}, beside[3] = {9, 0.3, 3};
    view[8] = look(center, size, close, middle, 40);
    view[9] = look(center, size, closer, tip, 60);
    view[10] = look(center, size, inside, tip, 90);
    view[11] = look(center, size, level, middle, 50);
    view[12] = look(center, size, far, middle, 30);
    view[13] = look(center, size, eye, away, 45);
    view[14] = look(center, size, eye, beside, 45);
    view[15] = view[0];
    memcpy(&view[15].matrix[4], &view[15].matrix[0], 4 * sizeof(float)); /* y = x: all edge-on */
}

/* --- Small meshes --------------------------------------------------------------------------------
 */
static inline void make_shape(hs_mesh *mesh, const char *name, uint32_t size, uint32_t seed) {
    hs_error err;
    if (!hs_shape_make(mesh, name, size, seed, &err)) fail_msg("%s", err.text);
}

static inline void make_soup(hs_mesh *mesh, uint32_t vertices, const float *position,
                             uint32_t faces, const uint32_t *sides, const uint32_t *corner) {
    const hs_soup soup = {.name = "soup",
                          .vertices = vertices,
                          .position = position,
                          .faces = faces,
                          .sides = sides,
                          .corner = corner};
    hs_error err;
    if (!hs_mesh_build(mesh, &soup, NULL, &err)) fail_msg("%s", err.text);
}

/* A ring of n points around the y axis, and one above and one below if poles. */
static inline void make_ring(float *position, uint32_t n, bool poles) {
    for (uint32_t i = 0; i < n; i++) {
        const double at = 2 * M_PI * i / n;
        const float point[4] = {(float)cos(at), 0, (float)sin(at), 1};
        memcpy(&position[4 * i], point, sizeof point);
    }
    const float pole[8] = {0, 1, 0, 1, 0, -1, 0, 1};
    if (poles) memcpy(&position[4 * n], pole, sizeof pole);
}

/* Two n-gons back to back. */
static inline void make_pillow(hs_mesh *mesh, uint32_t n) {
    float position[4 * HS_MAX_SIDES];
    uint32_t corner[2 * HS_MAX_SIDES];
    const uint32_t sides[2] = {n, n};
    make_ring(position, n, false);
    for (uint32_t i = 0; i < n; i++) {
        position[4 * i + 1] = i % 3 ? 0.1f : -0.2f;
        corner[i] = i;
        corner[n + i] = n - 1 - i;
    }
    make_soup(mesh, n, position, 2, sides, corner);
}

/* Two cones of n triangles, base to base: both tips have valence n. */
static inline void make_bicone(hs_mesh *mesh, uint32_t n) {
    float position[4 * (HS_MAX_VALENCE + 2)];
    uint32_t sides[2 * HS_MAX_VALENCE], corner[6 * HS_MAX_VALENCE];
    make_ring(position, n, true);
    for (uint32_t i = 0; i < 2 * n; i++) {
        const uint32_t a = i % n, b = (a + 1) % n;
        const uint32_t above[3] = {b, a, n}, below[3] = {a, b, n + 1};
        sides[i] = 3;
        memcpy(&corner[3 * i], i < n ? above : below, sizeof above);
    }
    make_soup(mesh, n + 2, position, 2 * n, sides, corner);
}

/* A cube and a tetrahedron, apart. */
static inline void make_two_bodies(hs_mesh *mesh) {
    float position[4 * 12];
    for (uint32_t i = 0; i < 8; i++) {
        const float point[4] = {i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f,
                                1};
        memcpy(&position[4 * i], point, sizeof point);
    }
    const float tetrahedron[16] = {4, 1, 1, 1, 2, -1, 1, 1, 2, 1, -1, 1, 4, -1, -1, 1};
    memcpy(&position[32], tetrahedron, sizeof tetrahedron);
    const uint32_t sides[10] = {4, 4, 3, 4, 3, 4, 4, 3, 4, 3};
    const uint32_t corner[36] = {4, 5, 7, 6, 0, 2, 3, 1, 8, 10, 9,  1, 3, 7, 5, 8, 9,  11,
                                 0, 4, 6, 2, 2, 6, 7, 3, 8, 11, 10, 0, 1, 5, 4, 9, 10, 11};
    make_soup(mesh, 12, position, 10, sides, corner);
}

static inline void mend_crc(hs_packet *packet) {
    if (packet->words) packet->word[packet->words - 1] = hs_packet_crc(packet);
}

#endif
