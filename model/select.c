/* SPDX-License-Identifier: Apache-2.0
 *
 * select: which active faces this view wants refined.
 *
 *   selected = candidate and (wanted or g < forced)
 *   wanted   = in_view and not stop and (front and g < front_depth
 *                                        or a silhouette vertex and g < silhouette_depth)
 *
 * A vertex that collected both front and back is a silhouette vertex; a face with a vertex that
 * collected hits is in view; a face stops where all its edges are shorter than the least edge.
 */
#include "golden_state.h"

static bool wanted(const hs_state *s, uint32_t f) {
    const uint32_t g = s->generation;
    const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
    bool in_view = false, silhouette = false;
    for (uint32_t i = 0; i < n; i++) {
        uint8_t mark = s->mark[s->origin[h0 + i]];
        in_view |= (mark & MARK_HITS) != 0;
        silhouette |= (mark & MARK_FRONT) && (mark & MARK_BACK);
    }
    return in_view && !(s->face_mark[f] & MARK_STOP) &&
           (((s->face_mark[f] & MARK_FRONT) && g < s->settings.front_depth) ||
            (silhouette && g < s->settings.silhouette_depth));
}

void hs_stage_select(hs_state *s) {
    s->selected = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        bool selected = s->settings.uniform ||
                        (s->candidate[f] && (wanted(s, f) || s->generation < s->forced[f]));
        s->decision[f] = selected ? FACE_SELECTED : 0;
        s->selected += selected;
    }
    s->finish = s->selected == 0 || s->generation >= s->depth;
}
