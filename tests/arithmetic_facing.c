/* SPDX-License-Identifier: Apache-2.0
 *
 * Which way corners face: the sign that rtl/marks.sv and golden give a determinant, against GMP's
 * integers, on corners that are degenerate or nearly so (facing_corners.h). Each of the module's
 * four determinants has its turn.
 */
#include <gmp.h>
#include <inttypes.h>
#include <stdio.h>

#include "arithmetic.h"
#include "arithmetic_parts.h"
#include "facing_corners.h"
#include "geometry_shim.h"

typedef struct bench {
    geometry_rtl *rtl;
    bool front[MARKS_LATENCY], valid[MARKS_LATENCY];
    corners inside[MARKS_LATENCY];
    uint64_t cycle, compared, zeros, ones, different;
    uint64_t rounded; /* signs that doubles get wrong */
    mpz_t determinant, product;
} bench;

static void differ(bench *b, const char *who, const corners *c) {
    if (b->different++ >= SHOWN) return;
    printf("%s:", who);
    for (int i = 0; i < 9; i++)
        printf(" %" PRId32, c->at[i / 3][i % 3]);
    gmp_printf(", determinant %Zd\n", b->determinant);
}

/* The rule of Sarrus into b->determinant. */
static void expand(bench *b, const corners *c) {
    mpz_set_si(b->determinant, 0);
    for (int k = 0; k < 6; k++) {
        const int step = k < 3 ? 1 : 2, column = k % 3;
        mpz_set_si(b->product, c->at[0][column]);
        mpz_mul_si(b->product, b->product, c->at[1][(column + step) % 3]);
        mpz_mul_si(b->product, b->product, c->at[2][(column + 2 * step) % 3]);
        (k < 3 ? mpz_add : mpz_sub)(b->determinant, b->determinant, b->product);
    }
}

static double determinant_in_doubles(const corners *c) {
    double a[3][3];
    for (int i = 0; i < 9; i++)
        a[i / 3][i % 3] = c->at[i / 3][i % 3];
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) +
           a[0][1] * (a[1][2] * a[2][0] - a[1][0] * a[2][2]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

static bool golden_front(const corners *c) {
    int32_t p[3][4] = {{0}};
    for (int i = 0; i < 3; i++) {
        p[i][0] = c->at[i][0];
        p[i][1] = c->at[i][1];
        p[i][2] = 0x5a5a5a5a; /* z has no say */
        p[i][3] = c->at[i][2];
    }
    return hs_corner_front(p[0], hs_cross_of(p[1], p[2]));
}

/* The corner in slot 0 to 3 of the module, and corners that do not count in the others. */
static void clock_in(bench *b, uint64_t *state, const corners *c, bool is_front, uint32_t slot) {
    const uint32_t pair = slot < 2 ? MARKS_A : MARKS_C;
    const uint32_t at = (uint32_t)(b->cycle++ % MARKS_LATENCY);
    geometry_marks in = {.use = 1u << slot};
    bool front, back;
    if (c) {
        for (int i = 0; i < 24; i++)
            in.vector[i / 3][i % 3] = corner_anywhere(state);
        memcpy(in.vector[MARKS_P + slot], c->at[0], sizeof c->at[0]);
        memcpy(in.vector[pair], c->at[1], sizeof c->at[1]);
        memcpy(in.vector[pair + 1], c->at[2], sizeof c->at[2]);
    }
    geometry_rtl_marks(b->rtl, c ? &in : NULL, &front, &back);
    if (b->valid[at] && (front != b->front[at] || back == front))
        differ(b, "the RTL", &b->inside[at]);
    b->valid[at] = c != NULL;
    b->front[at] = is_front;
    if (c) b->inside[at] = *c;
}

static void compare(bench *b, uint64_t *state, const corners *c) {
    expand(b, c);
    const int sign = mpz_sgn(b->determinant);
    const double rounded = determinant_in_doubles(c);
    b->compared++;
    b->zeros += sign == 0;
    b->ones += mpz_cmpabs_ui(b->determinant, 1) == 0;
    b->rounded += (rounded > 0) - (rounded < 0) != sign;
    if (c->known && mpz_cmp_si(b->determinant, c->determinant) != 0)
        differ(b, "GMP and the construction", c);
    if (golden_front(c) != (sign > 0)) differ(b, "golden", c);
    clock_in(b, state, c, sign > 0, random_below(state, 4));
}

bool campaign_facing(uint64_t operands, uint64_t seed) {
    bench b = {.rtl = geometry_rtl_new((uint32_t)seed)};
    uint64_t state = random_state(seed);
    mpz_inits(b.determinant, b.product, NULL);
    for (uint64_t i = 0; i < operands; i++) {
        const corners c = random_corners(&state, i % CORNER_KINDS);
        compare(&b, &state, &c);
    }
    for (int i = 0; i < MARKS_LATENCY; i++)
        clock_in(&b, &state, NULL, false, 0);
    mpz_clears(b.determinant, b.product, NULL);
    geometry_rtl_free(b.rtl);
    printf("result: facing: %" PRIu64 " determinants by GMP (%" PRIu64 " are 0, %" PRIu64
           " are 1 or -1, %" PRIu64 " have another sign in doubles), RTL and golden, seed %" PRIu64
           ": %" PRIu64 " differ\n",
           b.compared, b.zeros, b.ones, b.rounded, seed, b.different);
    return b.compared == operands && b.rounded > 0 && b.different == 0;
}
