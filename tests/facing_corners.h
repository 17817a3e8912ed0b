/* SPDX-License-Identifier: Apache-2.0
 *
 * Corners whose determinants are hard to tell from zero: three vectors of x, y, w, |component| at
 * most 2^30. Most of them have a determinant that is known because of how they were made.
 */
#ifndef HS_TESTS_FACING_CORNERS_H
#define HS_TESTS_FACING_CORNERS_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "random.h"

enum { FACING_MOST = 1 << 30 };

typedef struct corners {
    int32_t at[3][3];
    bool known; /* that it is determinant */
    int64_t determinant;
} corners;

enum corner_kind {
    CORNERS_SMALL_DETERMINANT, /* -2 to 2, however large the components */
    CORNERS_AT_THE_DIGIT,      /* about 2^31 or -2^31, where rtl/marks.sv parts its digits */
    CORNERS_IN_A_PLANE,        /* 0: on a line in the picture */
    CORNERS_BESIDE_A_PLANE,    /* the same, but one component is one off */
    CORNERS_COINCIDENT,        /* 0: two are the same, or one is a multiple of the other */
    CORNERS_AT_THE_ENDS,       /* components about 0, 2^30 and -2^30 */
    CORNERS_AT_THE_EYE,        /* w from -1 to 1 */
    CORNERS_ANYWHERE,
    CORNER_KINDS
};

static inline int32_t corner_anywhere(uint64_t *state) {
    return (int32_t)random_below(state, 2u * FACING_MOST + 1) - FACING_MOST;
}

static inline int32_t corner_at_the_ends(uint64_t *state) {
    static const int32_t ends[] = {-FACING_MOST,    1 - FACING_MOST, -1, 0, 1,
                                   FACING_MOST - 1, FACING_MOST};
    return ends[random_below(state, sizeof ends / sizeof *ends)];
}

/* Adds multiples of rows to rows and of columns to columns, which leaves the determinant alone,
 * until components are about as large as most. */
static inline void grow_corners(uint64_t *state, int32_t m[3][3], int64_t most) {
    for (int full = 0, step = 0; full < 4 && step < 200; step++) {
        const uint32_t to = random_below(state, 3), from = (to + 1 + random_below(state, 2)) % 3;
        const int64_t factor = (int64_t)random_below(state, 7) - 3;
        const bool rows = random_below(state, 2);
        int32_t grown[3];
        bool fits = true;
        for (int k = 0; k < 3; k++) {
            const int64_t x =
                rows ? m[to][k] + factor * m[from][k] : m[k][to] + factor * m[k][from];
            fits = fits && x <= most && x >= -most;
            grown[k] = (int32_t)(fits ? x : 0);
        }
        full += !fits;
        for (int k = 0; fits && k < 3; k++)
            *(rows ? &m[to][k] : &m[k][to]) = grown[k];
    }
}

/* Exchanges two of them, every second time. */
static inline void exchange_corners(uint64_t *state, corners *c) {
    if (random_below(state, 2)) return;
    const uint32_t i = random_below(state, 3), j = (i + 1) % 3;
    int32_t kept[3];
    memcpy(kept, c->at[i], sizeof kept);
    memcpy(c->at[i], c->at[j], sizeof kept);
    memcpy(c->at[j], kept, sizeof kept);
    c->determinant = -c->determinant;
}

static inline corners random_corners(uint64_t *state, enum corner_kind kind) {
    corners c = {.known = kind <= CORNERS_COINCIDENT && kind != CORNERS_BESIDE_A_PLANE};
    const int64_t most = random_below(state, 4) ? FACING_MOST : 1 << (2 + random_below(state, 28));
    const int32_t small = (int32_t)random_below(state, 5) - 2;
    switch (kind) {
    case CORNERS_SMALL_DETERMINANT:
    case CORNERS_IN_A_PLANE:
        c.determinant = kind == CORNERS_IN_A_PLANE ? 0 : small;
        c.at[0][0] = c.at[1][1] = 1;
        c.at[2][2] = (int32_t)c.determinant;
        grow_corners(state, c.at, most);
        break;
    case CORNERS_AT_THE_DIGIT:
        c.determinant = (INT64_C(1) << 31) - small;
        c.at[0][0] = 1 << 16;
        c.at[0][1] = small;
        c.at[1][0] = c.at[2][2] = 1;
        c.at[1][1] = 1 << 15;
        grow_corners(state, c.at, FACING_MOST);
        break;
    case CORNERS_BESIDE_A_PLANE:
        c.at[0][0] = c.at[1][1] = 1;
        grow_corners(state, c.at, FACING_MOST - 1);
        c.at[random_below(state, 3)][random_below(state, 3)] += random_below(state, 2) ? 1 : -1;
        break;
    case CORNERS_COINCIDENT:
        for (int k = 0; k < 3; k++) {
            c.at[0][k] = corner_anywhere(state) / 4;
            c.at[1][k] = c.at[0][k] * small;
            c.at[2][k] = corner_anywhere(state);
        }
        break;
    default:
        for (int i = 0; i < 9; i++)
            c.at[i / 3][i % 3] =
                kind == CORNERS_AT_THE_ENDS ? corner_at_the_ends(state) : corner_anywhere(state);
        for (int i = 0; i < 3 && kind == CORNERS_AT_THE_EYE; i++)
            c.at[i][2] = (int32_t)random_below(state, 3) - 1;
        break;
    }
    exchange_corners(state, &c);
    return c;
}

#endif
