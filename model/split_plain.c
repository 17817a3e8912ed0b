/* SPDX-License-Identifier: Apache-2.0
 *
 * split for meshes on which nothing is sharp and nothing ends but at a kept border: what split.c
 * says, for nearly all faces of nearly all views, as fast as the memory allows.
 */
#include <string.h>

#include "split.h"

/* Inlined for generation 0, where a face has first[f+1] - first[f] sides, and for quads; for
 * uniform runs, which refine all faces, and for others. The arrays have local names because a store
 * to an array of bytes might, for all the compiler knows, change *s. */
static inline __attribute__((always_inline)) void split_faces(hs_state *s, bool quads,
                                                              bool uniform) {
    const uint32_t faces = s->faces, *first = s->first, *face = s->face;
    const uint32_t *origin = s->origin, *twin = s->twin, *number = s->number;
    const uint8_t *decision = s->decision, *forced = s->forced;
    uint32_t *child = s->child, *next_origin = s->next_origin, *next_twin = s->next_twin;
    uint8_t *next_candidate = s->next_candidate, *next_forced = s->next_forced;
    const bool last = s->last;
    uint32_t next_faces = 0;

    for (uint32_t f = 0; f < faces; f++) {
        const uint32_t h0 = quads ? 4 * f : first[f], n = quads ? 4 : first[f + 1] - h0;
        if (!uniform && !(decision[f] & FACE_REFINED)) {
            hs_send_face(s, f);
            continue;
        }
        /* Number the children. Where the twin is the lower half-edge, it has its own already; which
         * one is the lower is as good as random, so no branch hangs on it. */
#pragma GCC unroll 4
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t h = h0 + i, t = twin[h];
            const uint32_t g = t == HS_BORDER ? f : quads ? t >> 2 : face[t];
            if (t == HS_BORDER || (!uniform && !(decision[g] & FACE_REFINED))) {
                child[h] = HS_BORDER;
                continue;
            }
            const uint32_t lower = h < t, fresh = 4 * next_faces, known = child[t] + 2;
            const uint32_t c0 = known ^ ((known ^ fresh) & -lower);
            child[h] = c0;
            next_faces += lower;
            if (uniform || last) continue;
            /* The quad inherits from both its parents. */
            next_candidate[c0 >> 2] = decision[f] & decision[g] & FACE_SELECTED;
            next_forced[c0 >> 2] = forced[f] < forced[g] ? forced[f] : forced[g];
        }
#pragma GCC unroll 4
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t h = h0 + i, c0 = child[h], c1 = c0 + 1;
            const uint32_t next = h0 + (i + 1 < n ? i + 1 : 0), prev = h0 + (i ? i - 1 : n - 1);
            if (c0 == HS_BORDER) {
                hs_send_triangle(s, f, h, next);
            } else if (!last) {
                next_origin[c0] = origin[next];
                next_origin[c1] = number[f];
                next_twin[c0] = child[next] == HS_BORDER ? HS_BORDER : child[next] + 1;
                next_twin[c1] = child[prev];
            } else if (h < twin[h]) {
                hs_send_quad(s, f, h, next);
            }
        }
    }
    s->next_faces = next_faces;
    if (uniform && !last) memset(next_candidate, 1, next_faces);
}

void hs_split_plain(hs_state *s) {
    s->next_boundary = 0;
    if (s->generation == 0)
        split_faces(s, false, s->settings.uniform);
    else if (s->settings.uniform)
        split_faces(s, true, true);
    else
        split_faces(s, true, false);
}
