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

static uint8_t marks_of(const hs_state *s, uint32_t h0, uint32_t n) {
    const hs_vertex *vertex = s->vertex;
    uint32_t all_outside = 0x3f;
    uint8_t mark = 0;
    const int32_t *a = vertex[s->origin[h0 + n - 2]].position;
    const int32_t *b = vertex[s->origin[h0 + n - 1]].position;
    for (uint32_t i = 0; i < n; i++) {
        const int32_t *c = vertex[s->origin[h0 + i]].position;
        all_outside &= outside(c);
        mark |= hs_corner_front(a, b, c) ? MARK_FRONT : MARK_BACK;
        a = b;
        b = c;
    }
    if (!all_outside) mark |= MARK_HITS;
    return mark;
}

/* The position of the vertex that the face gets if it is refined. */
static void new_vertex(const hs_state *s, uint32_t h0, uint32_t n, int32_t point[4]) {
    int64_t sum[4] = {0};
    for (uint32_t i = 0; i < n; i++) {
        const hs_vertex *v = &s->vertex[s->origin[h0 + i]];
        const int32_t *p = hs_odd_step(s) ? v->position : v->old;
        for (int k = 0; k < 4; k++)
            sum[k] += p[k];
    }
    for (int k = 0; k < 4; k++)
        point[k] = hs_face_mask(sum[k], n);
}

static void add_to_sums(hs_state *s, uint32_t h0, uint32_t n, const int32_t point[4]) {
    for (uint32_t i = 0; i < n; i++) {
        hs_sum *sum = &s->sum[s->origin[h0 + i]];
        const int32_t *w = s->vertex[s->origin[h0 + (i + 1 < n ? i + 1 : 0)]].position;
        for (int k = 0; k < 4; k++)
            sum->t[k] += (int64_t)w[k] + point[k];
        sum->valence++;
    }
}

static void add_to_marks(hs_state *s, uint32_t h0, uint32_t n, uint8_t mark) {
    for (uint32_t i = 0; i < n; i++) {
        uint32_t v = s->origin[h0 + i], w = s->origin[h0 + (i + 1 < n ? i + 1 : 0)];
        s->mark[v] |= mark | MARK_ACTIVE;
        if (s->twin[h0 + i] == HS_BORDER) {
            s->mark[v] |= MARK_BORDER;
            s->mark[w] |= MARK_BORDER;
        }
    }
}

void hs_stage_classify(hs_state *s) {
    memset(s->mark, 0, s->vertices);
    if (hs_odd_step(s)) memset(s->sum, 0, s->vertices * sizeof *s->sum);
    for (uint32_t f = 0; f < s->faces; f++) {
        uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
        s->face_mark[f] = s->settings.uniform ? 0 : marks_of(s, h0, n);
        new_vertex(s, h0, n, s->point[f]);
        if (hs_odd_step(s)) add_to_sums(s, h0, n, s->point[f]);
        add_to_marks(s, h0, n, s->face_mark[f]);
    }
}
