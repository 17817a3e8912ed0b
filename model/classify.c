/* SPDX-License-Identifier: Apache-2.0
 *
 * classify: reads the positions of every active face; leaves its marks and its new vertex's
 * position, and adds to its vertices' sums and marks.
 *
 * In an odd step the new vertex is the face point, RNE(sum / n), and every half-edge v -> w adds
 * w + F to the sum T of v. In an even step it is the edge point that the quad inherits: the quad
 * (w, F, v, G) came from the edge v-w between the face points F and G, so the edge point
 * (v + w + F + G)/4 is the average of the quad's own corners, where they stood before that odd
 * step moved them. Nothing needs to be kept with the quad.
 *
 * The valence of a vertex was counted when the mesh came in, or is the number of sides of the face
 * that it was made for. Every step keeps it, as long as all faces around the vertex are refined;
 * when one is not, the vertex never moves again, and needs no valence.
 *
 * Sharp edges (docs/refinement.md, section 9) have the middle of their ends for an edge point; a
 * vertex on a crease sums its two neighbours along it, a vertex that stays nothing.
 *
 * With the limit flag a vertex also gets the sum of its ring, in every generation (section 10).
 */
#include "classify.h"

/* A face and its corners: origins of half-edges h0 .. h0 + n - 1. */
typedef struct face {
    uint32_t number, h0, n;
    const uint32_t *corner;
    bool half;
} face;

static uint32_t next_of(const face *f, uint32_t i) {
    return i + 1 < f->n ? i + 1 : 0;
}

static uint32_t prev_of(const face *f, uint32_t i) {
    return i ? i - 1 : f->n - 1;
}

/* --- Marks ------------------------------------------------------------------------------------ */

static bool all_short(const hs_state *s, const face *f) {
    const hs_settings *settings = &s->settings;
    for (uint32_t i = 0; i < f->n; i++) {
        const int32_t *p = s->position[f->corner[i]], *q = s->position[f->corner[next_of(f, i)]];
        if (!hs_is_short(p[0], p[3], q[0], q[3], settings->width, settings->min_edge) ||
            !hs_is_short(p[1], p[3], q[1], q[3], settings->height, settings->min_edge))
            return false;
    }
    return true;
}

static uint8_t marks_of_face(const hs_state *s, const face *f) {
    uint32_t all_outside = 0x3f;
    uint8_t mark = 0;
    for (uint32_t i = 0; i < f->n; i++) {
        const uint32_t b = prev_of(f, i), a = prev_of(f, b);
        const int32_t *p = s->position[f->corner[i]];
        all_outside &= outside(p);
        mark |= facing(p, hs_cross_of(s->position[f->corner[a]], s->position[f->corner[b]]));
    }
    if (!all_outside) mark |= MARK_HITS;
    if (s->settings.min_edge && all_short(s, f)) mark |= MARK_STOP;
    return mark;
}

/* --- The new vertex --------------------------------------------------------------------------- */

/* Odd generations: true if the edge that the face was made of is sharp at a level. */
static bool made_of_sharp_edge(const hs_state *s, const face *f, uint32_t level) {
    return f->half || hs_is_sharp(s->sharp[f->h0], level);
}

static void new_point(const hs_state *s, const face *f, int32_t point[4]) {
    const bool odd = hs_odd_step(s);
    int32_t(*const from)[4] = odd ? s->position : s->old;
    if (!odd && made_of_sharp_edge(s, f, s->generation / 2)) {
        for (int k = 0; k < 4; k++)
            point[k] = hs_middle_mask(from[f->corner[0]][k], from[f->corner[2]][k]);
        return;
    }
    int64_t sum[4] = {0};
    for (uint32_t i = 0; i < f->n; i++)
        for (int k = 0; k < 4; k++)
            sum[k] += from[f->corner[i]][k];
    for (int k = 0; k < 4; k++)
        point[k] = hs_face_mask(sum[k], f->n);
}

/* --- What a corner adds to its vertex' sums --------------------------------------------------- */

static void add(int64_t sum[4], int weight, const int32_t p[4]) {
    for (int k = 0; k < 4; k++)
        sum[k] += (int64_t)weight * p[k];
}

/* Even generations, v on a crease: the neighbours along it. An edge inside adds the end that it
 * comes from; a boundary edge has one half-edge only, which adds each of its ends to the other. */
static void add_crease_ends(const hs_state *s, const face *f, uint32_t i, int64_t sum[4]) {
    const uint32_t in = f->h0 + prev_of(f, i), out = f->h0 + i;
    if (s->twin[in] == BOUNDARY_TWIN || hs_is_sharp(s->sharp[in], hs_level(s)))
        add(sum, 1, s->position[f->corner[prev_of(f, i)]]);
    if (s->twin[out] == BOUNDARY_TWIN) add(sum, 1, s->position[f->corner[next_of(f, i)]]);
}

/* 4a + b: in even generations a is the next vertex and b the one opposite in a quad; in odd ones a
 * is the new vertex of the face, which is to be the middle of the edge at v, and b is the next. */
static void add_to_ring(hs_state *s, const face *f, uint32_t i, hs_kind kind) {
    int64_t *ring = s->ring[f->corner[i]];
    const int32_t *next = s->position[f->corner[next_of(f, i)]];
    if (hs_odd_step(s)) {
        if (kind == KIND_CREASE) {
            add_crease_ends(s, f, i, ring);
        } else if (kind == KIND_SMOOTH && f->n == 4) {
            add(ring, 4, next);
            add(ring, 1, s->position[f->corner[(i + 2) % 4]]);
        }
    } else if (kind == KIND_SMOOTH) {
        add(ring, 4, s->point[f->number]);
        add(ring, 1, next);
    } else if (kind == KIND_CREASE && i % 2 == 0 && made_of_sharp_edge(s, f, hs_level(s))) {
        add(ring, 1, s->point[f->number]);
    }
}

static void add_to_vertex(hs_state *s, const face *f, uint32_t i) {
    const uint32_t v = f->corner[i], w = f->corner[next_of(f, i)];
    const hs_kind kind = hs_vertex_kind(s, v);
    if (hs_odd_step(s)) {
        if (kind == KIND_SMOOTH)
            add_to_sum(s->sum[v], hs_load(s->position[w]), hs_load(s->point[f->number]));
        else if (kind == KIND_CREASE)
            add_crease_ends(s, f, i, s->sum[v]);
    }
    if (s->settings.limit) add_to_ring(s, f, i, kind);
    add_mark(s->mark, v, w, s->face_mark[f->number], s->twin[f->h0 + i] == HS_BORDER);
    if (f->n != 4 && s->generation == 0) s->mark[v] |= MARK_NONQUAD;
}

/* ---------------------------------------------------------------------------------------------- */

static void classify_face(hs_state *s, uint32_t number) {
    const uint32_t h0 = hs_face_first(s, number);
    const face f = {.number = number,
                    .h0 = h0,
                    .n = hs_face_sides(s, number),
                    .corner = s->origin + h0,
                    .half = s->generation && hs_is_half(s, number)};
    s->face_mark[number] = s->unmarked ? 0 : marks_of_face(s, &f);
    new_point(s, &f, s->point[number]);
    for (uint32_t i = 0; i < f.n; i++)
        add_to_vertex(s, &f, i);
}

void hs_stage_classify(hs_state *s) {
    s->unmarked = s->settings.uniform && !s->mark_always;
    memset(s->mark, 0, s->vertices);
    if (hs_odd_step(s)) memset(s->sum, 0, s->vertices * sizeof *s->sum);
    if (s->settings.limit) memset(s->ring, 0, s->vertices * sizeof *s->ring);
    if (s->plain && s->generation)
        hs_classify_plain_quads(s);
    else
        for (uint32_t f = 0; f < s->faces; f++)
            classify_face(s, f);
}
