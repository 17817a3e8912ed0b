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
 * select.h is the formula, term by term.
 */
#include "select.h"

void hs_stage_select(hs_state *s) {
    s->selected = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        const bool selected = hs_is_selected(hs_terms(s, f));
        s->decision[f] = selected ? FACE_SELECTED : 0;
        s->selected += selected;
    }
    s->finish = s->selected == 0 || s->generation >= s->depth;
}
