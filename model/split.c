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
 *
 * A boundary edge, unless its mode is `kept`, is replaced alone: an odd step makes the half-quad
 * (w, F, v) of it, slot 2 of which is the edge itself; in the even step that slot has no children,
 * and what would be twinned with them is boundary. Sharpness goes along with the halves of the old
 * edge. docs/refinement.md, section 9, has the pictures.
 *
 * child[h] is c0(h); c1(h) is behind it.
 */
#include "split.h"

void hs_send_quad(hs_state *s, uint32_t f, uint32_t h, uint32_t next) {
    const uint32_t g = hs_face_of(s, s->twin[h]);
    const uint32_t quad[4] = {s->origin[next], s->number[f], s->origin[h], s->number[g]};
    hs_emit_face(s, quad, 4, s->generation + 1, s->decision[f] & s->decision[g] & FACE_SELECTED);
}

void hs_send_triangle(hs_state *s, uint32_t f, uint32_t h, uint32_t next) {
    const uint32_t triangle[3] = {s->origin[h], s->origin[next], s->number[f]};
    const uint32_t v = s->number[f];
    if (!s->sent[v]) {
        hs_emit_vertex(s, v, s->position[v]);
        s->sent[v] = 1;
        if (s->settings.limit) s->at_level++;
    }
    hs_emit_face(s, triangle, 3, s->generation, false);
    s->count.final++;
}

void hs_send_face(hs_state *s, uint32_t f) {
    hs_emit_face(s, s->origin + hs_face_first(s, f), hs_face_sides(s, f), s->generation,
                 s->candidate[f]);
    s->count.final++;
}

/* A half-quad that is final at once. */
static void send_half(hs_state *s, uint32_t f, uint32_t h, uint32_t next) {
    const uint32_t half[3] = {s->origin[next], s->number[f], s->origin[h]};
    hs_emit_face(s, half, 3, s->generation + 1, s->decision[f] & FACE_SELECTED);
}

static bool is_refined(const hs_state *s, uint32_t f) {
    return s->decision[f] & FACE_REFINED;
}

/* The first child of h, a new one if h is the lower half-edge of its edge, or HS_BORDER if the edge
 * is kept, or BOUNDARY_TWIN if it is the boundary edge of a half-quad. */
static uint32_t child_of(hs_state *s, uint32_t h) {
    const uint32_t t = s->twin[h];
    if (t == BOUNDARY_TWIN) return hs_odd_step(s) ? 4 * s->next_faces++ : BOUNDARY_TWIN;
    if (t == HS_BORDER || !is_refined(s, hs_face_of(s, t))) return HS_BORDER;
    return h < t ? 4 * s->next_faces++ : s->child[t] + 2;
}

/* What the quad of half-edge h of face f inherits, from each of its parents. */
static void inherit(hs_state *s, uint32_t f, uint32_t h) {
    const uint32_t t = s->twin[h], quad = s->child[h] / 4;
    const uint32_t g = t == BOUNDARY_TWIN ? f : hs_face_of(s, t);
    s->next_candidate[quad] = s->decision[f] & s->decision[g] & FACE_SELECTED;
    s->next_forced[quad] = s->forced[f] < s->forced[g] ? s->forced[f] : s->forced[g];
}

/* The sharpness of the children of the half-edge in slot i of its face. In an even step they are
 * half-edges of Catmull-Clark faces: c1 of the even slots and c0 of the odd ones lie on the old
 * edge. In an odd step both only carry the sharpness of their edge on. */
static void hand_on_sharpness(hs_state *s, uint32_t h, uint32_t i) {
    uint8_t *children = s->next_sharp + s->child[h];
    const uint8_t sharp = s->sharp[h];
    children[0] = hs_odd_step(s) || i % 2 == 1 ? sharp : 0;
    children[1] = hs_odd_step(s) || i % 2 == 0 ? sharp : 0;
}

/* The half-edges that h, between next and prev, is replaced by. */
static void write_children(hs_state *s, uint32_t f, uint32_t h, uint32_t next, uint32_t prev) {
    const uint32_t c0 = s->child[h], c1 = c0 + 1, beside = s->child[next];
    s->next_origin[c0] = s->origin[next];
    s->next_origin[c1] = s->number[f];
    s->next_twin[c0] = beside == HS_BORDER || beside == BOUNDARY_TWIN ? beside : beside + 1;
    s->next_twin[c1] = s->child[prev];
    if (s->twin[h] == BOUNDARY_TWIN) { /* the half-quad's boundary edge, and the void slot */
        s->next_origin[c0 + 2] = s->next_origin[c0 + 3] = s->origin[h];
        s->next_twin[c0 + 2] = s->next_twin[c0 + 3] = BOUNDARY_TWIN;
        s->next_sharp[c0 + 2] = s->next_sharp[c0 + 3] = 0;
        s->next_boundary++;
    } else {
        if (s->next_twin[c0] == BOUNDARY_TWIN) s->next_boundary++;
        if (s->next_twin[c1] == BOUNDARY_TWIN) s->next_boundary++;
    }
}

static void split_face(hs_state *s, uint32_t f) {
    const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t h = h0 + i;
        s->child[h] = child_of(s, h);
        if (s->last || s->child[h] == HS_BORDER || s->child[h] == BOUNDARY_TWIN) continue;
        inherit(s, f, h);
        hand_on_sharpness(s, h, i);
    }
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t h = h0 + i, t = s->twin[h];
        const uint32_t next = h0 + (i + 1 < n ? i + 1 : 0), prev = h0 + (i ? i - 1 : n - 1);
        if (s->child[h] == HS_BORDER)
            hs_send_triangle(s, f, h, next);
        else if (s->child[h] == BOUNDARY_TWIN)
            continue;
        else if (!s->last)
            write_children(s, f, h, next, prev);
        else if (t == BOUNDARY_TWIN)
            send_half(s, f, h, next);
        else if (h < t)
            hs_send_quad(s, f, h, next);
    }
}

void hs_stage_split(hs_state *s) {
    s->next_faces = s->next_boundary = 0;
    if (!s->finish && s->plain) {
        hs_split_plain(s);
        return;
    }
    for (uint32_t f = 0; f < s->faces; f++)
        if (!s->finish && is_refined(s, f))
            split_face(s, f);
        else
            hs_send_face(s, f);
}
