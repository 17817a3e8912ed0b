/* SPDX-License-Identifier: Apache-2.0
 *
 * guard: which faces are refined: with guard, those with a vertex of a selected face; without,
 * the selected ones. A refined face gets the number of its new vertex, in the order of the faces;
 * the vertices of a face that is not refined are held: they never move again. If the refined
 * faces would exceed a capacity, nothing is refined any more.
 */
#include "golden_state.h"

static void mark_corners(hs_state *s, uint32_t f, uint8_t mark) {
    const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
    for (uint32_t i = 0; i < n; i++)
        s->mark[s->origin[h0 + i]] |= mark;
}

static bool touches_selected(const hs_state *s, uint32_t f) {
    const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
    for (uint32_t i = 0; i < n; i++)
        if (s->mark[s->origin[h0 + i]] & MARK_CHOSEN) return true;
    return false;
}

/* Twice the children that a refined face gives, its neighbours being refined too. A boundary side
 * makes a child alone in an odd step, and none in an even one. */
static uint32_t counted_sides(const hs_state *s, uint32_t f) {
    const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
    if (s->boundary == 0) return n;
    if (!hs_odd_step(s)) return hs_is_half(s, f) ? 2 : 4;
    uint32_t sides = n;
    for (uint32_t i = 0; i < n; i++)
        sides += s->twin[h0 + i] == BOUNDARY_TWIN;
    return sides;
}

void hs_stage_guard(hs_state *s) {
    const bool ring = s->settings.guard && !s->settings.uniform;
    s->refined = 0;
    s->refined_sides = 0;
    if (ring)
        for (uint32_t f = 0; f < s->faces; f++)
            if (s->decision[f] & FACE_SELECTED) mark_corners(s, f, MARK_CHOSEN);
    for (uint32_t f = 0; f < s->faces; f++) {
        if (ring ? touches_selected(s, f) : s->decision[f] & FACE_SELECTED) {
            s->decision[f] |= FACE_REFINED;
            s->number[f] = s->vertices + s->refined++;
            s->refined_sides += counted_sides(s, f);
        } else {
            mark_corners(s, f, MARK_HELD);
        }
    }
    if ((uint64_t)s->vertices + s->refined > s->limits.vertices ||
        (s->refined_sides + 1) / 2 > s->limits.quads) {
        s->status = HS_STATUS_STOPPED;
        s->finish = true;
    }
    /* For limit positions every vertex needs its ring: no generation is skipped. */
    s->last = !s->finish && !s->settings.limit && s->generation + 1 == s->depth;
}
