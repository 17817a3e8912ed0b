/* SPDX-License-Identifier: Apache-2.0
 *
 * The proof of docs/arithmetic.md, section 4, in exact integers, for a reciprocal of any width: so
 * that a test can show that the width of rtl/divide.sv is enough, and that a smaller one is not.
 */
#ifndef HS_TESTS_DIVIDE_PROOF_H
#define HS_TESTS_DIVIDE_PROOF_H

#include <stdbool.h>
#include <stdint.h>

enum { DIVIDE_BITS = 64, DIVIDE_MOST_N = 255 };

/* denominator = n^2, or n^2 + 5n; d = denominator 2^s with 2^16 < d <= 2^17;
 * r = ceil(2^bits / d) = (2^bits + e) / d. */
typedef struct reciprocal {
    int64_t denominator;
    uint64_t d, r, e;
    uint32_t s, bits;
} reciprocal;

/* n from 1 to DIVIDE_MOST_N, bits from 18 to DIVIDE_BITS. */
static inline reciprocal reciprocal_of(bool limit, uint32_t n, uint32_t bits) {
    const unsigned __int128 one = (unsigned __int128)1 << bits;
    reciprocal out = {.denominator = n * n + (limit ? 5 * n : 0), .bits = bits};
    while ((uint64_t)out.denominator << out.s <= 1 << 16)
        out.s++;
    out.d = (uint64_t)out.denominator << out.s;
    out.r = (uint64_t)((one + out.d - 1) / out.d);
    out.e = (uint64_t)(out.r * (unsigned __int128)out.d - one);
    return out;
}

/* The largest |x| that is one less than a multiple of the denominator, where the floor is tightest.
 */
static inline int64_t tightest_dividend(const reciprocal *r) {
    return (r->denominator << 30) - 1;
}

/* True if floor(a r / 2^bits) = floor(a / d) for every |x| <= denominator 2^30, a = |x| 2^s. With
 * |x| = q denominator + m, a r / 2^bits is q + (m + |x| e / 2^bits) / denominator; so its floor is
 * q exactly if |x| e < (denominator - m) 2^bits. What is largest on the left and least on the right
 * is the tightest dividend, m = denominator - 1; another m has twice as much room at least, and |x|
 * is larger by at most 1. (Denominator 1 has no other m, and e = 0.) */
static inline bool is_wide_enough(const reciprocal *r) {
    return ((unsigned __int128)tightest_dividend(r) * r->e) >> r->bits == 0;
}

/* What divide.sv would give with this reciprocal: floor by multiplication, remainder of 18 bits. */
static inline int32_t divide_by_reciprocal(const reciprocal *r, int64_t x) {
    const uint64_t a = (uint64_t)(x < 0 ? -x : x) << r->s;
    const uint64_t q = (uint64_t)(((unsigned __int128)a * r->r) >> r->bits);
    const uint64_t twice = 2 * ((a - q * r->d) & 0x3ffff);
    const uint64_t y = q + (twice > r->d || (twice == r->d && (q & 1)));
    return (int32_t)(x < 0 ? 0 - y : y);
}

/* True if y = RNE(x / denominator): without a division. */
static inline bool is_rounded(int64_t x, int64_t denominator, int32_t y) {
    const int64_t off = 2 * (x - y * denominator), distance = off < 0 ? -off : off;
    return distance < denominator || (distance == denominator && y % 2 == 0);
}

#endif
