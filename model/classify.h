/* SPDX-License-Identifier: Apache-2.0
 *
 * What the two files of classify share: marks of positions, corners and vertices.
 */
#ifndef HS_CLASSIFY_H
#define HS_CLASSIFY_H

#include <string.h>

#include "arithmetic.h"
#include "golden_state.h"

/* The six half-spaces that a position lies in, a bit each: x>w, x<-w, y>w, y<-w, z>w, z<-w. */
static inline uint32_t outside(const int32_t p[4]) {
    uint32_t bits = 0;
    for (int k = 0; k < 3; k++)
        bits |= (uint32_t)(p[k] > p[3]) << 2 * k | (uint32_t)(p[k] < -p[3]) << (2 * k + 1);
    return bits;
}

static inline uint8_t facing(const int32_t p[4], hs_cross cross) {
    return hs_corner_front(p, cross) ? MARK_FRONT : MARK_BACK;
}

/* v collects the marks of its face; border: the edge v-w has no active face beyond. */
static inline void add_mark(uint8_t *mark, uint32_t v, uint32_t w, uint8_t of_face, bool border) {
    mark[v] |= (of_face & (MARK_FRONT | MARK_BACK | MARK_HITS)) | MARK_ACTIVE;
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

#endif
