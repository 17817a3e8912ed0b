/* SPDX-License-Identifier: Apache-2.0
 *
 * smooth: goes over the vertices in the order of their numbers. In an odd step it moves those that
 * may move: RNE((T + n(n-2)S) / n^2). It gives the refined faces' new vertices their positions,
 * and sends the vertices that this generation's final faces will name: those that are held or on
 * the border of the active mesh; all of them, if nothing active remains after this step.
 */
#include <string.h>

#include "arithmetic.h"
#include "golden_state.h"

static bool may_move(const hs_state *s, uint32_t v) {
    return (s->mark[v] & MARK_ACTIVE) && !(s->mark[v] & (MARK_HELD | MARK_BORDER));
}

static void move(hs_state *s, uint32_t v) {
    hs_vertex *vertex = &s->vertex[v];
    for (int k = 0; k < 4; k++)
        vertex->position[k] =
            hs_vertex_mask(s->sum[v].t[k], vertex->position[k], s->sum[v].valence);
}

/* What an even step's edge points are made of is where vertices stood before the odd step. */
static void remember(hs_state *s, uint32_t v) {
    memcpy(s->vertex[v].old, s->vertex[v].position, sizeof s->vertex[v].old);
}

static void append_new_vertices(hs_state *s) {
    for (uint32_t f = 0; f < s->faces; f++) {
        if (!(s->decision[f] & FACE_REFINED)) continue;
        uint32_t v = s->number[f];
        memcpy(s->vertex[v].position, s->point[f], sizeof s->point[f]);
        remember(s, v);
        s->sent[v] = 0;
    }
}

static void send(hs_state *s, uint32_t v) {
    if (s->sent[v]) return;
    hs_emit_vertex(s, v);
    s->sent[v] = 1;
}

void hs_stage_smooth(hs_state *s) {
    const bool move_some = hs_odd_step(s) && !s->finish;
    const uint8_t leaving = s->last || s->finish ? MARK_ACTIVE : MARK_HELD | MARK_BORDER;
    for (uint32_t v = 0; v < s->vertices; v++) {
        if (!(s->mark[v] & MARK_ACTIVE)) continue;
        if (hs_odd_step(s)) remember(s, v);
        if (move_some && may_move(s, v)) {
            move(s, v);
            s->count.moved++;
        }
        if (s->mark[v] & leaving) send(s, v);
    }
    if (s->finish) return;
    append_new_vertices(s);
    if (s->last)
        for (uint32_t v = s->vertices; v < s->vertices + s->refined; v++)
            send(s, v);
}
