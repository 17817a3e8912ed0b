/* SPDX-License-Identifier: Apache-2.0
 *
 * The division of the masks: rtl/divide.sv and golden against the definition of RNE in exact
 * integers, |2 (x - y D)| < D, or = D and y even. Nothing is divided for the comparison.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "arithmetic.h"
#include "arithmetic_parts.h"
#include "divide_proof.h"
#include "divide_shim.h"
#include "random.h"

typedef struct bench {
    divide_rtl *rtl;
    division inside[DIVIDE_LATENCY];
    bool valid[DIVIDE_LATENCY];
    uint64_t cycle, compared, ties, different;
} bench;

static void differ(bench *b, const char *who, const division *in, int32_t y) {
    if (b->different++ < SHOWN)
        printf("%" PRId64 " over %s, n = %" PRIu32 ", of %s: %" PRId32 "\n", in->x,
               in->limit ? "n^2 + 5n" : "n^2", in->n, who, y);
}

/* Two positions with that sum, and four; t sets them apart. */
static bool middle_agrees(int64_t sum, int32_t t, int32_t y) {
    const int32_t half = (int32_t)(sum >> 1);
    return hs_middle_mask(half + t, (int32_t)(sum - half) - t) == y;
}

static bool quad_agrees(int64_t sum, int32_t t, int32_t y) {
    const int64_t low = sum >> 2, rest = sum & 3;
    const int32_t a = (int32_t)low + t, b = (int32_t)low - t;
    const int32_t c = (int32_t)(low + (rest > 0)), d = (int32_t)(low + (rest > 1)), e = rest > 2;
    const hs_int4 point =
        hs_quad_mask((hs_int4){a, b, c, d}, (hs_int4){c, d, b, a}, (hs_int4){b, a, d, c},
                     (hs_int4){d + e, c + e, a + e, b + e});
    return point[0] == y && point[1] == y && point[2] == y && point[3] == y;
}

/* Golden's masks that are shifts, where x / 16 is what they round. */
static bool shifts_agree(int64_t x, int32_t s, int32_t y) {
    const int64_t size = x < 0 ? -x : x, room = (INT64_C(1) << 30) - (size >> 4) - 2;
    const int32_t t = room > 0 ? (int32_t)(s % room) : 0;
    return (x % 2 != 0 || hs_crease_mask(x / 2 - 6 * (int64_t)s, s) == y) &&
           (x % 4 != 0 || quad_agrees(x / 4, t, y)) && (x % 8 != 0 || middle_agrees(x / 8, t, y));
}

/* The masks whose dividend is x, with some vertex position s; y is the quotient. */
static bool golden_agrees(const division *in, int64_t denominator, int32_t s, int32_t y) {
    const int64_t n = in->n;
    if (hs_rne_divide(in->x, denominator) != y) return false;
    if (in->limit && n == 1 && hs_crease_limit_mask(in->x - 4 * (int64_t)s, s) != y) return false;
    if (!in->limit && n == 4 && !shifts_agree(in->x, s, y)) return false;
    if (in->limit) return hs_limit_mask(in->x - n * n * s, s, in->n) == y;
    if (in->x % n == 0 && hs_face_mask(in->x / n, in->n) != y) return false;
    return hs_vertex_mask(in->x - n * (n - 2) * s, s, in->n) == y;
}

static void compare(bench *b, const division *out, int32_t y) {
    const int64_t n = out->n, denominator = n * n + (out->limit ? 5 * n : 0);
    const int64_t off = 2 * (out->x - y * denominator);
    b->compared++;
    b->ties += off == denominator || off == -denominator;
    if (!is_rounded(out->x, denominator, y))
        differ(b, "the RTL", out, y);
    else if (!golden_agrees(out, denominator, (int32_t)(b->compared * 0x9e3779b1u), y))
        differ(b, "golden (the RTL's is right)", out, y);
}

static void clock_in(bench *b, const division *in) {
    const uint64_t slot = b->cycle++ % DIVIDE_LATENCY;
    const int32_t y = divide_rtl_cycle(b->rtl, in);
    if (b->valid[slot]) compare(b, &b->inside[slot], y);
    b->valid[slot] = in != NULL;
    if (in) b->inside[slot] = *in;
}

static void drain(bench *b) {
    for (int i = 0; i < DIVIDE_LATENCY; i++)
        clock_in(b, NULL);
    divide_rtl_free(b->rtl);
}

static void divide(bench *b, bool limit, uint32_t n, int64_t x) {
    clock_in(b, &(division){.limit = limit, .n = n, .x = x});
}

/* --- Random dividends
 * ----------------------------------------------------------------------------- */

/* 0 to 2^30 - 1: uniform, or about as long as any other, or beside a power of two. */
static int64_t random_quotient(uint64_t *state) {
    const uint32_t bits = random_below(state, 31), kind = random_below(state, 4);
    int64_t q = (int64_t)(random_bits(state) >> 2) >> (kind == 0 ? 0 : bits);
    if (kind == 1) q = (INT64_C(1) << bits) - random_below(state, 3);
    return q < 0 ? 0 : q >= 1 << 30 ? (1 << 30) - 1 : q;
}

/* Beside 0, beside half the denominator, beside the denominator, or uniform. */
static int64_t random_remainder(uint64_t *state, int64_t denominator) {
    const int64_t near = (int64_t)random_below(state, 5) - 2;
    const uint32_t kind = random_below(state, 4);
    const int64_t m = kind == 0   ? near
                      : kind == 1 ? denominator / 2 + near
                      : kind == 2 ? denominator + near
                                  : (int64_t)random_below(state, (uint32_t)denominator);
    return m < 0 ? 0 : m;
}

bool campaign_divide(uint64_t operands, uint64_t seed) {
    bench b = {.rtl = divide_rtl_new((uint32_t)seed)};
    uint64_t state = random_state(seed);
    for (uint64_t i = 0; i < operands; i++) {
        const bool limit = random_below(&state, 2);
        const uint32_t n = random_below(&state, 4) ? 1 + random_below(&state, DIVIDE_MOST_N)
                                                   : 1 + random_below(&state, 12);
        const int64_t denominator = n * n + (limit ? 5 * n : 0), most = denominator << 30;
        int64_t x = random_quotient(&state) * denominator + random_remainder(&state, denominator);
        if (x > most) x = most;
        divide(&b, limit, n, random_below(&state, 2) ? x : -x);
        if (random_below(&state, 16) == 0) clock_in(&b, NULL);
    }
    drain(&b);
    printf("result: divide: %" PRIu64 " dividends in exact integers (%" PRIu64
           " ties), RTL and golden, seed %" PRIu64 ": %" PRIu64 " differ\n",
           b.compared, b.ties, seed, b.different);
    return b.compared == operands && b.ties > 0 && b.different == 0;
}

/* --- The proof, and every remainder
 * --------------------------------------------------------------- */

/* How many of the denominators a reciprocal of 2^bits is wide enough for. Where it is not, the
 * tightest dividend must show it. How much of the room the tightest of them all takes: *most_used,
 * of 1. */
static uint32_t count_wide_enough(uint32_t bits, uint32_t *shown, double *most_used) {
    uint32_t enough = 0;
    *shown = 0;
    *most_used = 0;
    for (uint32_t i = 0; i < 2 * DIVIDE_MOST_N; i++) {
        const reciprocal r = reciprocal_of(i >= DIVIDE_MOST_N, i % DIVIDE_MOST_N + 1, bits);
        const int64_t x = tightest_dividend(&r);
        const double used = (double)x * (double)r.e / (double)((unsigned __int128)1 << bits);
        if (used > *most_used) *most_used = used;
        if (is_wide_enough(&r))
            enough++;
        else
            *shown += !is_rounded(x, r.denominator, divide_by_reciprocal(&r, x));
    }
    return enough;
}

/* True if the width of divide.sv is enough, and there is one that is not, seen at every denominator
 * that it is not enough for. */
static bool prove_widths(void) {
    const uint32_t all = 2 * DIVIDE_MOST_N;
    uint32_t enough = all, shown = 0;
    double used;
    bool good = true;
    for (uint32_t bits = DIVIDE_BITS; enough == all; bits--) {
        enough = count_wide_enough(bits, &shown, &used);
        printf("result: remainders: ceil(2^%" PRIu32 " / d) is wide enough for %" PRIu32
               " of %" PRIu32 " denominators; %.1f %% of the room used at most",
               bits, enough, all, 100 * used);
        if (enough < all) printf("; wrong at the tightest dividend of %" PRIu32, shown);
        printf("\n");
        if (bits == DIVIDE_BITS) good = enough == all;
    }
    return good && shown > 0 && shown == all - enough;
}

bool campaign_remainders(uint64_t operands, uint64_t seed) {
    (void)operands;
    bench b = {.rtl = divide_rtl_new((uint32_t)seed)};
    uint64_t state = random_state(seed), expected = 0;
    for (uint32_t i = 0; i < 2 * DIVIDE_MOST_N; i++) {
        const bool limit = i >= DIVIDE_MOST_N;
        const uint32_t n = i % DIVIDE_MOST_N + 1;
        const int64_t denominator = reciprocal_of(limit, n, DIVIDE_BITS).denominator;
        expected += 8 * (uint64_t)denominator;
        for (int64_t m = 0; m < denominator; m++) {
            const int64_t any = random_bits(&state) >> 3; /* below 2^29 */
            const int64_t q[] = {0, (1 << 30) - 1, 2 * any, 2 * any + 1};
            for (int k = 0; k < 4; k++) {
                divide(&b, limit, n, q[k] * denominator + m);
                divide(&b, limit, n, -(q[k] * denominator + m));
            }
        }
    }
    drain(&b);
    const bool proven = prove_widths();
    printf("result: remainders: %" PRIu64
           " dividends, every remainder of every denominator, at the least, the "
           "largest, an even and an odd quotient (%" PRIu64 " ties), RTL and golden, seed %" PRIu64
           ": %" PRIu64 " differ\n",
           b.compared, b.ties, seed, b.different);
    return proven && b.compared == expected && b.different == 0;
}
