/* SPDX-License-Identifier: Apache-2.0
 *
 * classify: reads the positions of every active face; leaves its marks and its new vertex's
 * position, and adds to its vertices' sums and marks.
 *
 * In an odd step the new vertex is the face point, RNE(sum / n), and every half-edge v -> w adds
 * w + F to the sum T of v. In an even step it is the edge point that the quad inherits: the quad
 * (w, F, v, G) came from the edge v-w between the face points F and G, so the edge point
 * (v + w + F + G)/4 is the average of the quad's own corners, where they stood before that odd
 * step moved them. Nothing needs to be kept with the quad.
 *
 * The valence of a vertex was counted when the mesh came in, or is the number of sides of the face
 * that it was made for. Every step keeps it, as long as all faces around the vertex are refined;
 * when one is not, the vertex never moves again, and needs no valence.
 *
 * Generation 0 has faces of any number of sides, the others quads, which have code of their own.
 */
#include <string.h>

#include "arithmetic.h"
#include "golden_state.h"

/* The six half-spaces that a position lies in, a bit each: x>w, x<-w, y>w, y<-w, z>w, z<-w. */
static uint32_t outside(const int32_t p[4]) {
    uint32_t bits = 0;
    for (int k = 0; k < 3; k++)
        bits |= (uint32_t)(p[k] > p[3]) << 2 * k | (uint32_t)(p[k] < -p[3]) << (2 * k + 1);
    return bits;
}

static uint8_t facing(const int32_t p[4], hs_cross cross) {
    return hs_corner_front(p, cross) ? MARK_FRONT : MARK_BACK;
}

static inline void add_mark(uint8_t *mark, uint32_t v, uint32_t w, uint8_t of_face, bool border) {
    mark[v] |= of_face | MARK_ACTIVE;
    if (border) {
        mark[v] |= MARK_BORDER;
        mark[w] |= MARK_BORDER;
    }
}

/* Adds w + F to a sum. Both are below 2^30: their own sum does not overflow. */
static inline void add_to_sum(int64_t t[4], hs_int4 w, hs_int4 point) {
    hs_long4 sum;
    memcpy(&sum, t, sizeof sum);
    sum += __builtin_convertvector(w + point, hs_long4);
    memcpy(t, &sum, sizeof sum);
}

/* --- Any number of sides: generation 0, whose step is odd ------------------------------------- */

static uint8_t marks_of_face(const hs_state *s, const uint32_t *corner, uint32_t n) {
    uint32_t all_outside = 0x3f;
    uint8_t mark = 0;
    for (uint32_t i = 0, a = n - 2, b = n - 1; i < n; a = b, b = i++) {
        const int32_t *p = s->position[corner[i]];
        all_outside &= outside(p);
        mark |= facing(p, hs_cross_of(s->position[corner[a]], s->position[corner[b]]));
    }
    if (!all_outside) mark |= MARK_HITS;
    return mark;
}

static void face_point(const hs_state *s, const uint32_t *corner, uint32_t n, int32_t point[4]) {
    int64_t sum[4] = {0};
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 4; k++)
            sum[k] += s->position[corner[i]][k];
    for (int k = 0; k < 4; k++)
        point[k] = hs_face_mask(sum[k], n);
}

static void classify_face(hs_state *s, uint32_t f) {
    const uint32_t h0 = s->first[f], n = s->first[f + 1] - h0;
    const uint32_t *corner = s->origin + h0;
    const uint8_t mark = s->settings.uniform ? 0 : marks_of_face(s, corner, n);
    face_point(s, corner, n, s->point[f]);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t v = corner[i], w = corner[i + 1 < n ? i + 1 : 0];
        add_to_sum(s->sum[v], hs_load(s->position[w]), hs_load(s->point[f]));
        add_mark(s->mark, v, w, mark, s->twin[h0 + i] == HS_BORDER);
    }
    s->face_mark[f] = mark;
}

/* --- Quads: the generations behind it --------------------------------------------------------- */

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
                                                                 bool uniform) {
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
        const uint8_t m = uniform ? 0
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

void hs_stage_classify(hs_state *s) {
    const bool odd = hs_odd_step(s), uniform = s->settings.uniform;
    memset(s->mark, 0, s->vertices);
    if (odd) memset(s->sum, 0, s->vertices * sizeof *s->sum);
    if (s->generation == 0)
        for (uint32_t f = 0; f < s->faces; f++)
            classify_face(s, f);
    else if (odd && uniform)
        classify_quads(s, true, true);
    else if (odd)
        classify_quads(s, true, false);
    else if (uniform)
        classify_quads(s, false, true);
    else
        classify_quads(s, false, false);
}
