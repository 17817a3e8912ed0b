/* SPDX-License-Identifier: Apache-2.0
 *
 * Marks, point, sum and the verdict on the edges of a face (rtl/face_geometry.sv, with marks.sv,
 * short_edges.sv and divide.sv in it), against the definitions of docs/refinement.md, sections 2, 4
 * and 9, in integers of 128 bits: quads, half-quads, and n-gons a corner at a time.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "arithmetic.h"
#include "cases.h"
#include "facing_corners.h"
#include "geometry_shim.h"

enum { MOST = 1 << 30, MOST_SIDES = 255 };

static uint64_t stream;

static uint32_t below(uint32_t n) {
    return random_below(&stream, n);
}

/* --- The definitions -------------------------------------------------------------------------- */

/* n corners; the n sources of its new vertex, or four of a half-quad. */
typedef struct face {
    bool half, border;
    uint32_t n;
    int32_t position[MOST_SIDES][4], source[MOST_SIDES][4];
} face;

/* det[(x, y, w) of a, b, c] by the rule of Sarrus. */
static bool is_counter_clockwise(const int32_t *a, const int32_t *b, const int32_t *c) {
    const __int128 one = 1;
    return one * a[0] * b[1] * c[3] + one * a[1] * b[3] * c[0] + one * a[3] * b[0] * c[1] -
               one * a[3] * b[1] * c[0] - one * a[0] * b[3] * c[1] - one * a[1] * b[0] * c[3] >
           0;
}

/* x/w in pixels from the middle of the picture: x size / (2w), so that the distance in sixteenths
 * of a pixel is 8 size (v_x/v_w - w_x/w_w). */
static bool is_near(const int32_t *v, const int32_t *w, int k, uint32_t size, uint32_t min_edge) {
    if (v[3] <= 0 || w[3] <= 0) return false;
    const __int128 one = 1, product = one * v[3] * w[3];
    const __int128 distance = 8 * size * (one * v[k] * w[3] - one * w[k] * v[3]);
    return distance < min_edge * product && -distance < min_edge * product;
}

static bool is_short(const int32_t *v, const int32_t *w, const geometry_settings *s) {
    const bool across = is_near(v, w, 0, s->width, s->min_edge);
    const bool up = is_near(v, w, 1, s->height, s->min_edge);
    assert_int_equal(across, hs_is_short(v[0], v[3], w[0], w[3], s->width, s->min_edge));
    assert_int_equal(up, hs_is_short(v[1], v[3], w[1], w[3], s->height, s->min_edge));
    return across && up;
}

static bool edges_are_short(const face *f, const geometry_settings *s) {
    for (uint32_t i = 0; i < f->n; i++)
        if (!is_short(f->position[i], f->position[(i + 1) % f->n], s)) return false;
    return true;
}

static bool hits_view_volume(const face *f) {
    for (int half_space = 0; half_space < 6; half_space++) {
        bool all = true;
        for (uint32_t i = 0; i < f->n; i++) {
            const int32_t *p = f->position[i];
            all = all && (half_space % 2 ? p[half_space / 2] < -p[3] : p[half_space / 2] > p[3]);
        }
        if (all) return false;
    }
    return true;
}

/* RNE(sum / n): the floor of sum/n + 1/2, or one less if that is odd and was an integer before. */
static int32_t average_of(int64_t sum, int64_t n) {
    const int64_t x = 2 * sum + n, rest = (x % (2 * n) + 2 * n) % (2 * n);
    const int64_t floor = (x - rest) / (2 * n);
    return (int32_t)(rest == 0 && floor % 2 != 0 ? floor - 1 : floor);
}

static geometry_face by_definition(const face *f, const geometry_settings *s) {
    geometry_face out = {.hits = hits_view_volume(f),
                         .stop = edges_are_short(f, s),
                         .nonquad = !s->quads && f->n != 4,
                         .last_border = f->border};
    const uint32_t sources = f->half ? 4 : f->n;
    for (uint32_t i = 0; i < f->n; i++) {
        const bool front = is_counter_clockwise(f->position[i], f->position[(i + 1) % f->n],
                                                f->position[(i + 2) % f->n]);
        out.front = out.front || front;
        out.back = out.back || !front;
    }
    for (int k = 0; k < 4; k++) {
        for (uint32_t i = 0; i < sources; i++)
            out.sum[k] += f->source[i][k];
        out.point[k] = average_of(out.sum[k], sources);
    }
    memcpy(out.last_position, f->position[f->n - 1], sizeof out.last_position);
    return out;
}

/* --- The module, compared with them ----------------------------------------------------------- */

struct bench {
    geometry_rtl *rtl;
    geometry_settings settings;
    uint32_t idle; /* per cent of the cycles */
    geometry_face expected[8];
    uint64_t due[8], cycle, in, out; /* faces in and out */
    uint64_t stops, fronts, backs, hits;
};

static void assert_same(const geometry_face *rtl, const geometry_face *c, bool quads) {
    for (int k = 0; k < 4; k++) {
        assert_int_equal(rtl->point[k], c->point[k]);
        assert_int_equal(rtl->sum[k], c->sum[k]);
        if (!quads) assert_int_equal(rtl->last_position[k], c->last_position[k]);
    }
    assert_int_equal(rtl->front, c->front);
    assert_int_equal(rtl->back, c->back);
    assert_int_equal(rtl->hits, c->hits);
    assert_int_equal(rtl->stop, c->stop);
    assert_int_equal(rtl->nonquad, c->nonquad);
    if (!quads) assert_int_equal(rtl->last_border, c->last_border);
}

static void clock_in(struct bench *b, const geometry_item *in) {
    geometry_face out;
    const bool due = b->out < b->in && b->due[b->out % 8] == b->cycle;
    assert_int_equal(geometry_rtl_cycle(b->rtl, &b->settings, in, &out), due);
    b->cycle++;
    if (!due) return;
    assert_same(&out, &b->expected[b->out++ % 8], b->settings.quads);
    b->stops += out.stop;
    b->fronts += out.front;
    b->backs += out.back;
    b->hits += out.hits;
}

/* Every lane that is not to be looked at holds something. */
static void put_in(struct bench *b, const face *f, uint32_t first, uint32_t items) {
    const uint32_t lanes = b->settings.quads ? f->n : 1;
    const uint32_t sources = b->settings.quads ? 4 : 1;
    for (uint32_t i = first; i < first + items; i++) {
        while (below(100) < b->idle)
            clock_in(b, NULL);
        geometry_item item = {.half = b->settings.quads ? f->half : below(2),
                              .last = b->settings.quads || i + 1 == f->n,
                              .border = b->settings.quads || i + 1 == f->n ? f->border : below(2)};
        for (uint32_t lane = 0; lane < 4; lane++)
            for (uint32_t k = 0; k < 4; k++) {
                item.position[lane][k] =
                    lane < lanes ? f->position[i + lane][k] : (int32_t)below(MOST);
                item.source[lane][k] =
                    lane < sources ? f->source[i + lane][k] : (int32_t)below(MOST);
            }
        if (item.last) {
            b->expected[b->in % 8] = by_definition(f, &b->settings);
            b->due[b->in++ % 8] = b->cycle + GEOMETRY_LATENCY;
        }
        clock_in(b, &item);
    }
}

static void put(struct bench *b, const face *f) {
    put_in(b, f, 0, b->settings.quads ? 1 : f->n);
}

static void drain(struct bench *b) {
    for (int i = 0; i < GEOMETRY_LATENCY; i++)
        clock_in(b, NULL);
    assert_int_equal(b->in, b->out);
}

/* --- Faces ------------------------------------------------------------------------------------ */

static int32_t clamped(int64_t x) {
    return (int32_t)(x > MOST ? MOST : x < -MOST ? -MOST : x);
}

static int32_t anywhere(void) {
    return (int32_t)below(2u * MOST + 1) - MOST;
}

static int32_t at_the_ends(void) {
    static const int32_t ends[] = {-MOST, -MOST + 1, -1, 0, 1, MOST - 1, MOST};
    return ends[below(sizeof ends / sizeof *ends)];
}

/* About the least edge from first, across, up, both or not at all: longer the more slack is below
 * 0. */
static void set_neighbour(int32_t p[4], const int32_t first[4], const geometry_settings *s,
                          int64_t slack) {
    const int64_t w = first[3] + (int64_t)below(1000), t = s->min_edge;
    p[3] = clamped(w);
    for (int k = 0; k < 2; k++) {
        const int64_t size = k ? s->height : s->width;
        const int64_t edge = below(2) ? t * w / (8 * size) - slack : 0;
        p[k] = clamped((int64_t)((__int128)first[k] * w / first[3]) + edge);
    }
}

enum kind { SPREAD, ENDS, FLAT, THIN, SMALL, KINDS };

static void set_corners(face *f, const geometry_settings *s) {
    const uint32_t kind = below(KINDS);
    const int64_t slack = (int64_t)below(6) - 2;
    const corners thin = random_corners(&stream, below(CORNER_KINDS));
    int32_t first[4] = {anywhere() / 2, anywhere() / 2, anywhere() / 2,
                        MOST / 4 + (int32_t)below(MOST / 2)};
    for (uint32_t i = 0; i < f->n; i++) {
        int32_t *p = f->position[i];
        for (int k = 0; k < 4; k++)
            p[k] = kind == ENDS ? at_the_ends() : kind == SPREAD ? anywhere() : first[k];
        if (kind == FLAT) { /* determinants near zero */
            const int32_t by = (int32_t)below(9) - 4;
            for (int k = 0; k < 4; k++)
                p[k] = clamped(((int64_t)first[k] / 8 + (below(8) == 0)) * by);
        }
        for (int k = 0; k < 4 && kind == THIN; k++) /* three places, or one off them */
            if (k != 2) p[k] = clamped((int64_t)thin.at[i % 3][k == 3 ? 2 : k] + (below(16) == 0));
        if (kind == SMALL && i > 0) set_neighbour(p, f->position[0], s, slack);
    }
}

static face random_face(const geometry_settings *s) {
    face f = {.half = s->quads && below(3) == 0, .border = below(2)};
    f.n = f.half ? 3 : s->quads ? 4 : below(4) ? 3 + below(4) : 3 + below(MOST_SIDES - 2);
    set_corners(&f, s);
    for (uint32_t i = 0; i < (f.half ? 4 : f.n); i++)
        for (int k = 0; k < 4; k++)
            f.source[i][k] = below(2) ? anywhere() : at_the_ends();
    return f;
}

static geometry_settings random_settings(bool quads) {
    static const uint32_t edges[] = {1, 16, 1000, 65535};
    return (geometry_settings){.quads = quads,
                               .min_edge = edges[below(4)],
                               .width = below(4) ? 16 + below(4096) : 65535,
                               .height = below(4) ? 16 + below(4096) : 65535};
}

/* --- The claims ------------------------------------------------------------------------------- */

static void faces_agree(bool quads, uint32_t batches) {
    static const uint32_t idle[] = {0, 0, 20, 80};
    stream = random_state(3);
    struct bench b = {.rtl = geometry_rtl_new(1)};
    for (uint32_t batch = 0; batch < batches; batch++) {
        b.settings = random_settings(quads);
        b.idle = idle[batch % 4];
        for (int i = 0; i < 100; i++) {
            const face f = random_face(&b.settings);
            put(&b, &f);
        }
        drain(&b);
    }
    assert_int_equal(b.out, 100 * batches);
    for (int i = 0; i < 4; i++) { /* each mark says something */
        const uint64_t n = i == 0 ? b.stops : i == 1 ? b.fronts : i == 2 ? b.backs : b.hits;
        assert_in_range(n, 5 * batches, 98 * batches);
    }
    geometry_rtl_free(b.rtl);
}

static void quads_and_half_quads_have_the_marks_of_their_corners(void **state) {
    (void)state;
    faces_agree(true, 400);
}

static void faces_of_3_to_255_corners_have_theirs_a_corner_a_cycle(void **state) {
    (void)state;
    faces_agree(false, 60);
}

/* A face whose corners are all in one place, at w = 8 size i and x = y = 0, but for one of them. */
static face in_one_place(uint32_t n, bool half, int32_t w) {
    face f = {.n = n, .half = half};
    for (uint32_t i = 0; i < n; i++)
        f.position[i][3] = w;
    return f;
}

static bool stops(struct bench *b, const face *f) {
    const uint64_t before = b->stops;
    put(b, f);
    drain(b);
    return b->stops > before;
}

/* At w = 8 size scale, x = t scale is t sixteenths of a pixel from x = 0. */
/* The sign from slot 0 to 3 of marks, with something in the others. */
static bool is_front_in_marks(geometry_rtl *rtl, const corners *c, uint32_t slot) {
    const uint32_t pair = slot < 2 ? MARKS_A : MARKS_C;
    geometry_marks in = {.use = 1u << slot};
    bool front, back;
    for (int i = 0; i < MARKS_VECTORS * 3; i++)
        in.vector[i / 3][i % 3] = anywhere();
    memcpy(in.vector[MARKS_P + slot], c->at[0], sizeof c->at[0]);
    memcpy(in.vector[pair], c->at[1], sizeof c->at[1]);
    memcpy(in.vector[pair + 1], c->at[2], sizeof c->at[2]);
    for (int i = 0; i <= MARKS_LATENCY; i++)
        geometry_rtl_marks(rtl, i == 0 ? &in : NULL, &front, &back);
    assert_int_equal(front, !back);
    return front;
}

static void every_determinant_has_its_sign_however_close_to_zero(void **state) {
    (void)state;
    stream = random_state(9);
    geometry_rtl *rtl = geometry_rtl_new(7);
    uint32_t known[3] = {0};
    const uint32_t rounds = cases(100000);
    for (uint32_t i = 0; i < rounds; i++) {
        const corners c = random_corners(&stream, i % CORNER_KINDS);
        int32_t p[3][4] = {{0}};
        for (int k = 0; k < 12; k++)
            p[k / 4][k % 4] = k % 4 == 2 ? anywhere() : c.at[k / 4][k % 4 == 3 ? 2 : k % 4];
        const bool front = is_counter_clockwise(p[0], p[1], p[2]);
        if (c.known) assert_int_equal(front, c.determinant > 0);
        assert_int_equal(hs_corner_front(p[0], hs_cross_of(p[1], p[2])), front);
        assert_int_equal(is_front_in_marks(rtl, &c, below(4)), front);
        known[c.known ? front : 2]++;
    }
    for (int i = 0; i < 3; i++)
        assert_true(known[i] > cases(10000));
    geometry_rtl_free(rtl);
}

static void an_edge_as_long_as_the_least_one_is_not_short(void **state) {
    (void)state;
    enum { EDGE = 40, SCALE = 1000, WIDTH = 1280, HEIGHT = 720 };
    static const struct {
        bool quads, half;
        uint32_t n;
    } faces[] = {
        {true, false, 4}, {true, true, 3}, {false, false, 3}, {false, false, 4}, {false, false, 7}};
    stream = random_state(4);
    struct bench b = {.rtl = geometry_rtl_new(2)};
    for (size_t i = 0; i < sizeof faces / sizeof *faces; i++)
        for (int k = 0; k < 2; k++)
            for (uint32_t corner = 0; corner < faces[i].n; corner++)
                for (int sign = -1; sign <= 1; sign += 2) {
                    b.settings = (geometry_settings){faces[i].quads, EDGE, WIDTH, HEIGHT};
                    face f =
                        in_one_place(faces[i].n, faces[i].half, 8 * (k ? HEIGHT : WIDTH) * SCALE);
                    f.position[corner][k] = sign * (EDGE * SCALE - 1);
                    assert_true(stops(&b, &f));
                    f.position[corner][k] = sign * EDGE * SCALE;
                    assert_false(stops(&b, &f));
                    b.settings.min_edge = EDGE + 1;
                    assert_true(stops(&b, &f));
                }
    geometry_rtl_free(b.rtl);
}

static void an_end_that_is_not_before_the_eye_makes_an_edge_long(void **state) {
    (void)state;
    stream = random_state(5);
    struct bench b = {.rtl = geometry_rtl_new(3)};
    b.settings = (geometry_settings){true, 65535, 1, 1};
    for (int half = 0; half < 2; half++)
        for (uint32_t corner = 0; corner < 4u - (uint32_t)half; corner++) {
            face f = in_one_place(half ? 3 : 4, half, 1000);
            assert_true(stops(&b, &f));
            f.position[corner][3] = 0;
            assert_false(stops(&b, &f));
            f.position[corner][3] = -1000;
            assert_false(stops(&b, &f));
        }
    face f = in_one_place(4, false, -1000);
    assert_false(stops(&b, &f));
    geometry_rtl_free(b.rtl);
}

/* v anywhere, w at about the least edge from it, with a w of its own. */
static void set_edge(int32_t v[4], int32_t w[4], const geometry_settings *s) {
    for (int k = 0; k < 4; k++)
        v[k] = below(8) ? anywhere() : at_the_ends();
    if (v[3] > 0) {
        set_neighbour(w, v, s, (int64_t)below(5) - 1);
    } else {
        memcpy(w, v, 4 * sizeof *w);
        w[3] = below(2) ? w[3] : anywhere();
    }
}

static void every_edge_that_is_used_has_its_say_and_no_other(void **state) {
    (void)state;
    stream = random_state(8);
    geometry_rtl *rtl = geometry_rtl_new(6);
    uint32_t seen[2] = {0};
    const uint32_t rounds = cases(100000);
    for (uint32_t i = 0; i < rounds; i++) {
        const geometry_settings s = random_settings(true);
        int32_t v[4][4], w[4][4];
        bool expected = true;
        const uint32_t use = below(2) ? 1u << below(4) : below(16);
        for (uint32_t edge = 0; edge < 4; edge++) {
            set_edge(v[edge], w[edge], &s);
            if (below(2))
                for (int k = 0; k < 4; k++) {
                    const int32_t p = v[edge][k];
                    v[edge][k] = w[edge][k];
                    w[edge][k] = p;
                }
            if (use >> edge & 1) expected = is_short(v[edge], w[edge], &s) && expected;
        }
        assert_int_equal(geometry_rtl_edges(rtl, &s, use, v, w), expected);
        seen[expected]++;
    }
    assert_true(seen[0] > cases(10000) && seen[1] > cases(10000));
    geometry_rtl_free(rtl);
}

static void without_a_least_edge_nothing_is_short(void **state) {
    (void)state;
    stream = random_state(6);
    struct bench b = {.rtl = geometry_rtl_new(4)};
    for (int quads = 0; quads < 2; quads++) {
        const face f = in_one_place(4, false, 1000);
        b.settings = (geometry_settings){quads, 1, 640, 480};
        assert_true(stops(&b, &f));
        b.settings.min_edge = 0;
        assert_false(stops(&b, &f));
    }
    geometry_rtl_free(b.rtl);
}

static void reset_forgets_a_face_that_has_begun(void **state) {
    (void)state;
    stream = random_state(7);
    struct bench b = {.rtl = geometry_rtl_new(5), .settings = random_settings(false)};
    for (uint32_t corners = 1; corners < 6; corners++) {
        face f = random_face(&b.settings);
        f.n = 7;
        set_corners(&f, &b.settings);
        put_in(&b, &f, 0, corners);
        geometry_rtl_reset(b.rtl);
        b.cycle++;
        put(&b, &f);
        drain(&b);
    }
    assert_int_equal(b.out, 5);
    geometry_rtl_free(b.rtl);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quads_and_half_quads_have_the_marks_of_their_corners),
        cmocka_unit_test(faces_of_3_to_255_corners_have_theirs_a_corner_a_cycle),
        cmocka_unit_test(every_determinant_has_its_sign_however_close_to_zero),
        cmocka_unit_test(an_edge_as_long_as_the_least_one_is_not_short),
        cmocka_unit_test(an_end_that_is_not_before_the_eye_makes_an_edge_long),
        cmocka_unit_test(every_edge_that_is_used_has_its_say_and_no_other),
        cmocka_unit_test(without_a_least_edge_nothing_is_short),
        cmocka_unit_test(reset_forgets_a_face_that_has_begun),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
