/* SPDX-License-Identifier: Apache-2.0
 *
 * split: the half-edge rule. Let h: v -> w lie in face f and t = twin(h) in face g, both refined,
 * with new vertices F and G. The step replaces the pair by the quad (w, F, v, G), corner by corner
 * c0(h), c1(h), c0(t), c1(t) with h < t:
 *
 *          w                   c0(h): w -> F    next(c0(h)) = c1(h)    twin(c0(h)) = c1(next(h))
 *        / | \                 c1(h): F -> v    next(c1(h)) = c0(t)    twin(c1(h)) = c0(prev(h))
 *      F  h|t  G
 *        \ | /                 Each half-edge contributes two children, from its own record alone.
 *          v
 *
 * Quads are numbered by the lower of their two half-edges. An edge of one refined face only is
 * kept: it yields the triangle (v, w, F), which is final, as is a face that is not refined.
 */
#include "golden_state.h"

static bool refined(const hs_state *s, uint32_t f) {
    return s->decision[f] & FACE_REFINED;
}

/* True if the step replaces h's edge by a quad. */
static bool replaced(const hs_state *s, uint32_t h, uint32_t f) {
    uint32_t t = s->twin[h];
    return refined(s, f) && t != HS_BORDER && refined(s, hs_face_of(s, t));
}

/* The two corners of a half-edge's children begin at this half-edge of the next generation. */
static uint32_t children(const hs_state *s, uint32_t h) {
    return 4 * s->child[h] + (h < s->twin[h] ? 0 : 2);
}

static void number_children(hs_state *s) {
    s->next_faces = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
        for (uint32_t h = h0; h < h0 + n; h++) {
            if (!replaced(s, h, f))
                s->child[h] = HS_BORDER;
            else
                s->child[h] = h < s->twin[h] ? s->next_faces++ : s->child[s->twin[h]];
        }
    }
}

/* The children c0(h): w -> F and c1(h): F -> v. */
static void write_children(hs_state *s, uint32_t f, uint32_t h, uint32_t next, uint32_t prev) {
    const uint32_t c0 = children(s, h), c1 = c0 + 1;
    s->next_origin[c0] = s->origin[next];
    s->next_origin[c1] = s->number[f];
    s->next_twin[c0] = s->child[next] == HS_BORDER ? HS_BORDER : children(s, next) + 1;
    s->next_twin[c1] = s->child[prev] == HS_BORDER ? HS_BORDER : children(s, prev);

    /* The quad inherits from both its parents; the lower half-edge is always seen first. */
    const uint32_t quad = c0 / 4;
    const uint8_t candidate = (s->decision[f] & FACE_SELECTED) != 0;
    if (c0 % 4 == 0) {
        s->next_candidate[quad] = candidate;
        s->next_forced[quad] = s->forced[f];
    } else {
        s->next_candidate[quad] &= candidate;
        if (s->forced[f] < s->next_forced[quad]) s->next_forced[quad] = s->forced[f];
    }
}

/* The quad of h's edge, when it is final at once. */
static void send_quad(hs_state *s, uint32_t f, uint32_t h, uint32_t next) {
    const uint32_t g = hs_face_of(s, s->twin[h]);
    const uint32_t quad[4] = {s->origin[next], s->number[f], s->origin[h], s->number[g]};
    hs_emit_face(s, quad, 4, s->generation + 1, s->decision[f] & s->decision[g] & FACE_SELECTED);
}

static void send_triangle(hs_state *s, uint32_t f, uint32_t h, uint32_t next) {
    const uint32_t triangle[3] = {s->origin[h], s->origin[next], s->number[f]};
    if (!s->sent[s->number[f]]) {
        hs_emit_vertex(s, s->number[f]);
        s->sent[s->number[f]] = 1;
    }
    hs_emit_face(s, triangle, 3, s->generation, false);
    s->count.final++;
}

void hs_stage_split(hs_state *s) {
    if (!s->finish) number_children(s);
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
        if (s->finish || !refined(s, f)) {
            hs_emit_face(s, s->origin + h0, n, s->generation, s->candidate[f]);
            s->count.final++;
            continue;
        }
        for (uint32_t i = 0; i < n; i++) {
            uint32_t h = h0 + i;
            uint32_t next = h0 + (i + 1 < n ? i + 1 : 0), prev = h0 + (i ? i - 1 : n - 1);
            if (s->child[h] == HS_BORDER)
                send_triangle(s, f, h, next);
            else if (!s->last)
                write_children(s, f, h, next, prev);
            else if (h < s->twin[h])
                send_quad(s, f, h, next);
        }
    }
}
