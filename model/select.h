/* SPDX-License-Identifier: Apache-2.0
 *
 * The terms of the formula by which select decides, a bit each, and the formula. select.c takes
 * every decision by them; who wants to know why a face was selected, or was not, asks the same two
 * functions once its marks are known.
 */
#ifndef HS_SELECT_H
#define HS_SELECT_H

#include "golden_state.h"

enum {
    TERM_UNIFORM = 1,          /* the run refines everything to its depth */
    TERM_CANDIDATE = 2,        /* both faces that it comes from were selected, or it is initial */
    TERM_IN_VIEW = 4,          /* a vertex collected hits */
    TERM_STOP = 8,             /* all its edges are shorter than the least edge */
    TERM_FRONT = 16,           /* a corner is seen counter-clockwise */
    TERM_FRONT_DUE = 32,       /* g < front_depth */
    TERM_SILHOUETTE = 64,      /* a vertex collected both front and back */
    TERM_SILHOUETTE_DUE = 128, /* g < silhouette_depth */
    TERM_FORCED = 256          /* g < forced */
};

/* The terms of an active face, of which classify left the marks. */
static inline uint32_t hs_terms(const hs_state *s, uint32_t f) {
    const uint32_t g = s->generation;
    if (s->settings.uniform) return TERM_UNIFORM;
    const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
    uint8_t hits = 0;
    bool silhouette = false;
    for (uint32_t i = 0; i < n; i++) {
        const uint8_t mark = s->mark[s->origin[h0 + i]];
        hits |= mark & MARK_HITS;
        silhouette |= (mark & MARK_FRONT) && (mark & MARK_BACK);
    }
    return (s->candidate[f] ? TERM_CANDIDATE : 0u) | (hits ? TERM_IN_VIEW : 0u) |
           (s->face_mark[f] & MARK_STOP ? TERM_STOP : 0u) |
           (s->face_mark[f] & MARK_FRONT ? TERM_FRONT : 0u) |
           (g < s->settings.front_depth ? TERM_FRONT_DUE : 0u) |
           (silhouette ? TERM_SILHOUETTE : 0u) |
           (g < s->settings.silhouette_depth ? TERM_SILHOUETTE_DUE : 0u) |
           (g < s->forced[f] ? TERM_FORCED : 0u);
}

/* Whether all bits are among the terms. */
static inline bool hs_all_terms(uint32_t terms, uint32_t bits) {
    return (terms & bits) == bits;
}

/* wanted = in_view and not stop and (front and g < front_depth
 *                                    or a silhouette vertex and g < silhouette_depth) */
static inline bool hs_is_wanted(uint32_t terms) {
    return (terms & (TERM_IN_VIEW | TERM_STOP)) == TERM_IN_VIEW &&
           (hs_all_terms(terms, TERM_FRONT | TERM_FRONT_DUE) ||
            hs_all_terms(terms, TERM_SILHOUETTE | TERM_SILHOUETTE_DUE));
}

/* selected = candidate and (wanted or g < forced); in a uniform run, everything */
static inline bool hs_is_selected(uint32_t terms) {
    return (terms & TERM_UNIFORM) ||
           ((terms & TERM_CANDIDATE) && (hs_is_wanted(terms) || (terms & TERM_FORCED)));
}

#endif
