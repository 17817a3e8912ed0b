/* SPDX-License-Identifier: Apache-2.0
 *
 * The division of the masks (rtl/divide.sv) against the floor of C's 128-bit division, for every n
 * and both denominators, where it is most likely to fail: near the ties, near the integers, and at
 * the ends of the range.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "arithmetic.h"
#include "divide_proof.h"
#include "divide_shim.h"

enum { RANDOM_QUOTIENTS = 1000, TOP_QUOTIENTS = 8 };

static uint64_t random_state = 1;

static uint64_t random_bits(void) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state;
}

static int64_t denominator_of(const division *d) {
    const int64_t n = d->n;
    return d->limit ? n * n + 5 * n : n * n;
}

/* RNE(x / d) is the floor of x/d + 1/2, or one less if that is odd and was an integer before. */
static int32_t expected(const division *d) {
    const __int128 two_d = 2 * (__int128)denominator_of(d);
    const __int128 x = 2 * (__int128)d->x + two_d / 2;
    __int128 rest = x % two_d;
    if (rest < 0) rest += two_d;
    const __int128 floor = (x - rest) / two_d;
    return (int32_t)(rest == 0 && floor % 2 != 0 ? floor - 1 : floor);
}

/* A divider with what is inside; every quotient that comes out is compared. */
struct bench {
    divide_rtl *rtl;
    division inside[DIVIDE_LATENCY];
    bool valid[DIVIDE_LATENCY];
    uint64_t cycle, compared, ties;
};

static void clock_in(struct bench *b, const division *in) {
    const uint64_t slot = b->cycle++ % DIVIDE_LATENCY;
    const int32_t y = divide_rtl_cycle(b->rtl, in);
    if (b->valid[slot]) {
        const division *out = &b->inside[slot];
        const int64_t d = denominator_of(out);
        if (y != expected(out))
            fail_msg("%lld / %lld is %d, not %d", (long long)out->x, (long long)d, expected(out),
                     y);
        assert_int_equal(hs_rne_divide(out->x, d), y);
        b->compared++;
        b->ties += out->x % d * 2 == d || out->x % d * 2 == -d;
    }
    b->valid[slot] = in != NULL;
    if (in) b->inside[slot] = *in;
}

static void drain(struct bench *b) {
    for (int i = 0; i < DIVIDE_LATENCY; i++)
        clock_in(b, NULL);
}

static void divide_if_in_range(struct bench *b, division d, int64_t x) {
    const int64_t most = denominator_of(&d) << 30;
    if (x < -most || x > most) return;
    d.x = x;
    clock_in(b, &d);
}

/* quotient d, the tie above it, and their neighbours, of both signs. */
static void divide_around(struct bench *b, division d, int64_t quotient) {
    const int64_t below = quotient * denominator_of(&d), tie = below + denominator_of(&d) / 2;
    for (int64_t off = -1; off <= 1; off++) {
        divide_if_in_range(b, d, below + off);
        divide_if_in_range(b, d, -(below + off));
        divide_if_in_range(b, d, tie + off);
        divide_if_in_range(b, d, -(tie + off));
    }
}

static void every_quotient_is_rounded_once_to_nearest_even(void **state) {
    (void)state;
    struct bench b = {.rtl = divide_rtl_new(1)};
    for (int limit = 0; limit < 2; limit++)
        for (uint32_t n = 1; n <= 255; n++) {
            const division d = {.limit = limit == 1, .n = n};
            const uint64_t most = (uint64_t)denominator_of(&d) << 30;
            for (int64_t i = 0; i <= TOP_QUOTIENTS; i++) {
                divide_around(&b, d, i);
                divide_around(&b, d, (INT64_C(1) << 30) - i);
            }
            for (int i = 0; i < RANDOM_QUOTIENTS; i++) {
                divide_around(&b, d, (int64_t)(random_bits() >> (34 + i % 24)));
                divide_if_in_range(&b, d, (int64_t)(random_bits() % (2 * most + 1) - most));
            }
        }
    drain(&b);
    assert_true(b.compared > 510 * 13 * RANDOM_QUOTIENTS);
    assert_true(b.ties > (127 + 255) * 2 * RANDOM_QUOTIENTS); /* of even denominators */
    divide_rtl_free(b.rtl);
}

static void idle_cycles_do_not_disturb_it(void **state) {
    (void)state;
    struct bench b = {.rtl = divide_rtl_new(2)};
    for (int i = 0; i < 20000; i++) {
        division d = {.limit = random_bits() >> 63, .n = (uint32_t)(random_bits() % 255 + 1)};
        const uint64_t most = (uint64_t)denominator_of(&d) << 30;
        d.x = (int64_t)(random_bits() % (2 * most + 1) - most);
        clock_in(&b, &d);
        while (random_bits() >> 62 != 0)
            clock_in(&b, NULL);
    }
    drain(&b);
    assert_int_equal(b.compared, 20000);
    divide_rtl_free(b.rtl);
}

/* A narrower one: two bits less are too few for some n (docs/arithmetic.md, section 4). */
static void the_reciprocals_are_wide_enough_and_narrower_ones_would_be_seen(void **state) {
    (void)state;
    struct bench b = {.rtl = divide_rtl_new(3)};
    uint32_t too_narrow = 0;
    for (int limit = 0; limit < 2; limit++)
        for (uint32_t n = 1; n <= DIVIDE_MOST_N; n++) {
            const reciprocal exact = reciprocal_of(limit, n, DIVIDE_BITS);
            const reciprocal narrow = reciprocal_of(limit, n, DIVIDE_BITS - 2);
            const int64_t x = tightest_dividend(&exact), d = exact.denominator;
            assert_true(is_wide_enough(&exact));
            assert_true(is_rounded(x, d, divide_by_reciprocal(&exact, x)));
            clock_in(&b, &(division){.limit = limit, .n = n, .x = x});
            clock_in(&b, &(division){.limit = limit, .n = n, .x = -x});
            if (is_wide_enough(&narrow)) continue;
            assert_false(is_rounded(x, d, divide_by_reciprocal(&narrow, x)));
            too_narrow++;
        }
    drain(&b);
    assert_int_equal(b.compared, 4 * DIVIDE_MOST_N);
    assert_true(too_narrow > 0);
    divide_rtl_free(b.rtl);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_quotient_is_rounded_once_to_nearest_even),
        cmocka_unit_test(the_reciprocals_are_wide_enough_and_narrower_ones_would_be_seen),
        cmocka_unit_test(idle_cycles_do_not_disturb_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
