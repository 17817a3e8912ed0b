/* SPDX-License-Identifier: Apache-2.0
 *
 * smooth: goes over the vertices in the order of their numbers. In an odd step it moves those that
 * may move: RNE((T + n(n-2)S) / n^2), on a crease RNE((a + 6S + b) / 8). It gives the refined
 * faces' new vertices their positions, and sends the vertices that this generation's final faces
 * will name: those that are held or on the border of the active mesh; all of them, if nothing
 * active remains after this step. With the limit flag they leave at their limit positions, which
 * nobody else gets to see.
 */
#include <string.h>

#include "arithmetic.h"
#include "golden_state.h"

static void move(hs_state *s, uint32_t v) {
    const int32_t *from = s->old[v];
    const int64_t *sum = s->sum[v];
    const uint32_t n = s->valence[v];
    int32_t to[4];
    if (hs_vertex_kind(s, v) == KIND_CREASE)
        for (int k = 0; k < 4; k++)
            to[k] = hs_crease_mask(sum[k], from[k]);
    else if (n == 4) /* nearly all: the case is decided once, not per coordinate */
        for (int k = 0; k < 4; k++)
            to[k] = hs_vertex_mask(sum[k], from[k], 4);
    else
        for (int k = 0; k < 4; k++)
            to[k] = hs_vertex_mask(sum[k], from[k], n);
    memcpy(s->position[v], to, sizeof to);
}

static void stay(hs_state *s, uint32_t v) {
    memcpy(s->position[v], s->old[v], sizeof s->position[v]);
}

/* What an even step's edge points are made of is where vertices stood before the odd step. */
static void remember_positions(hs_state *s) {
    int32_t(*position)[4] = s->position;
    s->position = s->old;
    s->old = position;
}

/* Where a vertex leaves. Its ring is complete unless it is on the border; in generation 0 the
 * masks want quads. A crease's ring are the two neighbours along it. */
static void send_limit(hs_state *s, uint32_t v) {
    const int32_t *from = s->position[v];
    const hs_kind kind = hs_vertex_kind(s, v);
    int32_t to[4];
    memcpy(to, from, sizeof to);
    if (s->mark[v] & (MARK_BORDER | MARK_NONQUAD))
        s->at_level++;
    else if (kind == KIND_SMOOTH)
        for (int k = 0; k < 4; k++)
            to[k] = hs_limit_mask(s->ring[v][k], from[k], s->valence[v]);
    else if (kind == KIND_CREASE)
        for (int k = 0; k < 4; k++)
            to[k] = hs_crease_limit_mask(s->ring[v][k], from[k]);
    hs_emit_vertex(s, v, to);
}

static void send(hs_state *s, uint32_t v) {
    if (s->sent[v]) return;
    if (s->settings.limit)
        send_limit(s, v);
    else
        hs_emit_vertex(s, v, s->position[v]);
    s->sent[v] = 1;
}

static void append_new_vertices(hs_state *s, bool odd) {
    for (uint32_t f = 0; f < s->faces; f++) {
        if (!(s->decision[f] & FACE_REFINED)) continue;
        const uint32_t v = s->number[f];
        memcpy(s->position[v], s->point[f], sizeof s->point[f]);
        if (odd) memcpy(s->old[v], s->point[f], sizeof s->point[f]);
        s->valence[v] = (uint8_t)hs_face_sides(s, f);
        s->stays[v] = 0;
        s->crease[v] = 0;
        if (!odd && !s->plain)
            s->crease[v] = hs_is_half(s, f) ? HS_SHARP_INFINITE : s->sharp[4 * f];
    }
    memset(s->sent + s->vertices, 0, s->refined);
}

void hs_stage_smooth(hs_state *s) {
    const bool odd = hs_odd_step(s) && !s->finish;
    const uint8_t leaving = s->last || s->finish ? MARK_ACTIVE : MARK_HELD | MARK_BORDER;
    if (odd) remember_positions(s);
    for (uint32_t v = 0; v < s->vertices; v++) {
        if (!(s->mark[v] & MARK_ACTIVE)) continue;
        if (odd && hs_may_move(s, s->sent, v)) {
            move(s, v);
            s->count.moved++;
        } else if (odd) {
            stay(s, v);
        }
        if (s->mark[v] & leaving) send(s, v);
    }
    if (s->finish) return;
    append_new_vertices(s, odd);
    if (s->last)
        for (uint32_t v = s->vertices; v < s->vertices + s->refined; v++)
            send(s, v);
}
