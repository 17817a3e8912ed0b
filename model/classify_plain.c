/* SPDX-License-Identifier: Apache-2.0
 *
 * classify for meshes of quads on which nothing is sharp and nothing ends but at a kept border:
 * what classify.c says, for nearly all faces of nearly all views, as fast as the memory allows.
 */
#include "classify.h"

/* The determinants of the four corners share two cross products. */
static uint8_t marks_of_quad(const int32_t *a, const int32_t *b, const int32_t *c,
                             const int32_t *d) {
    const hs_cross bc = hs_cross_of(b, c), da = hs_cross_of(d, a);
    uint8_t mark = facing(a, bc) | facing(d, bc) | facing(c, da) | facing(b, da);
    if (!(outside(a) & outside(b) & outside(c) & outside(d))) mark |= MARK_HITS;
    return mark;
}

/* Inlined for each kind of step and run. The arrays have local names because a store to an array of
 * bytes might, for all the compiler knows, change *s. */
static inline __attribute__((always_inline)) void classify_quads(hs_state *s, bool odd,
                                                                 bool unmarked) {
    int32_t(*const position)[4] = s->position, (*const from)[4] = odd ? s->position : s->old;
    int64_t(*sum)[4] = s->sum;
    int32_t(*point)[4] = s->point;
    uint8_t *mark = s->mark, *face_mark = s->face_mark;
    const uint32_t *corner = s->origin, *twin = s->twin, *end = corner + s->halfedges;

    for (; corner < end; corner += 4, twin += 4) {
        hs_int4 p[4];
#pragma GCC unroll 4
        for (int i = 0; i < 4; i++)
            p[i] = hs_load(from[corner[i]]);
        const hs_int4 new_point = hs_quad_mask(p[0], p[1], p[2], p[3]);
        memcpy(*point++, &new_point, sizeof new_point);
        const uint8_t m = unmarked ? 0
                                   : marks_of_quad(position[corner[0]], position[corner[1]],
                                                   position[corner[2]], position[corner[3]]);
        *face_mark++ = m;
#pragma GCC unroll 4
        for (uint32_t i = 0; i < 4; i++) {
            const uint32_t next = (i + 1) % 4;
            if (odd) add_to_sum(sum[corner[i]], p[next], new_point);
            add_mark(mark, corner[i], corner[next], m, twin[i] == HS_BORDER);
        }
    }
}

void hs_classify_plain_quads(hs_state *s) {
    const bool odd = hs_odd_step(s), unmarked = s->unmarked;
    if (odd && unmarked)
        classify_quads(s, true, true);
    else if (odd)
        classify_quads(s, true, false);
    else if (unmarked)
        classify_quads(s, false, true);
    else
        classify_quads(s, false, false);
}
