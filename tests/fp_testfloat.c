/* SPDX-License-Identifier: Apache-2.0
 *
 * Plays Berkeley TestFloat's vectors through the floating-point modules and through golden:
 *
 *     testfloat_gen -level 2 f32_add | build/fp_testfloat add 7496192
 *
 * A line is hexadecimal: one or two operands, the expected result, exception flags.
 *
 *   add, mul   f32_add, f32_mul: fp_add or fp_mul, every vector. Then transform and golden's stage
 * of that name, with matrices that make a row the sum, or the product, of two finite operands:
 * result, and overflow, the one flag that is kept. to_fixed   f32_to_i32, to nearest even: its
 * result is q for c at E = 30, and for c 2^(E-30) at any E. And c itself at every E above it; there
 * the result is SoftFloat's. to_float   i32_to_f32: its result is c for q at E = 30, and times
 * 2^(E-30) at any E; if that is subnormal, or there is no such vector, it is SoftFloat's.
 *
 * The last argument is the number of vectors that must come, so that a generator that fails does
 * not pass. Prints how many results were compared and the first few that differ; exits 0 only if
 * all vectors came and nothing differs.
 */
#include <stdio.h>
#include <stdlib.h>

#include "arithmetic.h"
#include "fp_shim.h"
#include "fp_softfloat.h"
#include "golden_state.h"

enum { BLOCK = 65536 }; /* vectors at a time */

typedef struct vectors {
    uint32_t n, a[BLOCK], b[BLOCK], expected[BLOCK], flags[BLOCK];
} vectors;

static fp_shim *shim;
static uint64_t compared, different;
static bool timely = true;

static void compare(const char *what, uint32_t a, uint32_t b, uint32_t y, uint32_t expected) {
    compared++;
    if (y != expected && different++ < 10)
        printf("%s %08x %08x: %08x, expected %08x\n", what, a, b, y, expected);
}

/* --- Operations ------------------------------------------------------------------------------- */

enum { ONE = 0x3f800000 };

/* The vectors of one record: for add two, (a0, b0, a1, b1); for mul four, b0 to b3. */
typedef struct group {
    uint32_t count, vector[4];
} group;

static uint32_t without_sign_of_zero(uint32_t bits) {
    return bits == 0x80000000u ? 0 : bits;
}

/* A row adds +0 to what it is to compute, which makes -0 +0. */
static void compare_group(const vectors *v, const group *g, const fp_vertex *rtl,
                          const float clip[4], uint32_t golden_row) {
    uint32_t first = 4;
    for (uint32_t k = g->count; k-- > 0;)
        if (v->flags[g->vector[k]] & softfloat_flag_overflow) first = k;
    const uint32_t i = g->vector[first & 3];
    compare("transform, overflow", v->a[i], v->b[i], rtl->overflow ? rtl->overflow_row : 4, first);
    compare("golden, overflow", v->a[i], v->b[i], golden_row, first);
    for (uint32_t k = 0; k < g->count; k++) {
        const uint32_t j = g->vector[k], expected = without_sign_of_zero(v->expected[j]);
        compare("transform", v->a[j], v->b[j], without_sign_of_zero(rtl->clip[k]), expected);
        if (k < golden_row)
            compare("golden", v->a[j], v->b[j], without_sign_of_zero(bits_of(clip[k])), expected);
    }
}

static void transform_groups(const vectors *v, const uint32_t matrix[16], uint32_t groups,
                             const group *g, const uint32_t *record) {
    static fp_vertex rtl[BLOCK];
    static hs_state golden;
    float clip[1][4] = {{0}}, p[4];
    uint32_t magnitude;
    timely &= fp_transform(shim, matrix, groups, record, rtl, &magnitude, 0);
    memcpy(golden.matrix, matrix, sizeof golden.matrix);
    golden.clip = clip;
    for (uint32_t i = 0; i < groups; i++) {
        uint32_t row = 4;
        memcpy(p, record + 4 * i, sizeof p);
        hs_stage_transform(&golden, 0, p, &row);
        compare_group(v, &g[i], &rtl[i], clip[0], row);
    }
    golden.clip = NULL;
}

static void check_operation(const vectors *v, bool add) {
    static uint32_t y[BLOCK], record[4 * BLOCK];
    static group g[BLOCK];
    timely &= fp_binary(shim, add ? FP_ADD : FP_MUL, v->n, v->a, v->b, y, 0);
    for (uint32_t i = 0; i < v->n; i++)
        compare(add ? "fp_add" : "fp_mul", v->a[i], v->b[i], y[i],
                is_nan(v->expected[i]) ? QUIET_NAN : v->expected[i]);

    const uint32_t sums[16] = {ONE, ONE, 0, 0, 0, 0, ONE, ONE};
    uint32_t matrix[16] = {0}, groups = 0, wide = add ? 2 : 4;
    g[0].count = 0;
    for (uint32_t i = 0; i < v->n; i++) {
        if (is_finite(v->a[i]) && is_finite(v->b[i])) {
            const uint32_t k = g[groups].count++;
            uint32_t *p = record + 4 * groups;
            if (k == 0) memset(p, 0, 4 * sizeof *p);
            if (add) p[2 * k] = v->a[i];
            p[add ? 2 * k + 1 : k] = v->b[i];
            matrix[5 * k] = v->a[i];
            g[groups].vector[k] = i;
        }
        const bool full = g[groups].count == wide || (i + 1 == v->n && g[groups].count > 0);
        if (full && !add) transform_groups(v, matrix, 1, g, record);
        if (full) g[groups += add].count = 0;
    }
    if (add) transform_groups(v, sums, groups, g, record);
}

/* --- Conversions ------------------------------------------------------------------------------ */

/* c 2^shift into *scaled, if it is normal as c is, or 0. */
static bool scales(uint32_t c, int shift, uint32_t *scaled) {
    const int field = (int)(c >> 23 & 255);
    *scaled = c + ((uint32_t)shift << 23);
    if ((c & 0x7fffffff) == 0) *scaled = c;
    return (c & 0x7fffffff) == 0 ||
           (field > 0 && field < 255 && field + shift > 0 && field + shift < 255);
}

static void compare_to_fixed(uint32_t c, int exponent, int32_t expected) {
    const uint32_t e = (uint32_t)exponent;
    compare("to_fixed", c, e, (uint32_t)fp_to_fixed(shim, c, exponent), (uint32_t)expected);
    compare("hs_to_fixed", c, e, (uint32_t)hs_to_fixed(float_of(c), exponent), (uint32_t)expected);
}

static void check_to_fixed(uint32_t c, int32_t expected) {
    for (int exponent = LEAST_EXPONENT; exponent <= LARGEST_EXPONENT; exponent++) {
        uint32_t scaled;
        if ((c & 0x7fffffff) <= largest_below(30) && scales(c, exponent - 30, &scaled))
            compare_to_fixed(scaled, exponent, expected);
        if ((c & 0x7fffffff) <= largest_below(exponent))
            compare_to_fixed(c, exponent, soft_to_fixed(c, exponent));
    }
}

static void check_to_float(int32_t q, uint32_t expected) {
    const uint32_t size = q < 0 ? 0 - (uint32_t)q : (uint32_t)q;
    for (int exponent = LEAST_EXPONENT; exponent <= LARGEST_EXPONENT; exponent++) {
        uint32_t c;
        if (!scales(expected, exponent - 30, &c)) {
            if (size > (uint32_t)largest_fixed(exponent)) continue; /* 2^128 or more */
            c = soft_to_float(q, exponent);
        }
        compare("to_float", (uint32_t)q, (uint32_t)exponent, fp_to_float(shim, q, exponent), c);
        compare("hs_to_float", (uint32_t)q, (uint32_t)exponent,
                bits_of(hs_to_float(q, hs_unit(exponent))), c);
    }
}

/* --- The vectors ------------------------------------------------------------------------------ */

/* False at the end of the input. */
static bool read_vector(vectors *v, uint32_t operands, uint64_t number) {
    char line[128], *at = line, *last = line;
    if (!fgets(line, sizeof line, stdin)) return false;
    v->a[v->n] = (uint32_t)strtoul(at, &at, 16);
    v->b[v->n] = operands == 2 ? (uint32_t)strtoul(at, &at, 16) : 0;
    v->expected[v->n] = (uint32_t)strtoul(at, &at, 16);
    last = at;
    v->flags[v->n] = (uint32_t)strtoul(at, &at, 16);
    if (at == last || *at != '\n') {
        fprintf(stderr, "fp_testfloat: vector %llu is malformed: %s", (unsigned long long)number,
                line);
        exit(EXIT_FAILURE);
    }
    v->n++;
    return true;
}

int main(int argc, char **argv) {
    static const char *const names[] = {"add", "mul", "to_fixed", "to_float"};
    static vectors v;
    uint32_t operation = 0;
    while (argc == 3 && operation < 4 && strcmp(argv[1], names[operation]) != 0)
        operation++;
    const uint64_t wanted = argc == 3 ? strtoull(argv[2], NULL, 10) : 0;
    if (operation == 4 || wanted == 0) {
        fprintf(stderr,
                "usage: testfloat_gen ... | fp_testfloat add|mul|to_fixed|to_float COUNT\n");
        return EXIT_FAILURE;
    }

    shim = fp_new();
    uint64_t vectors_read = 0;
    for (bool more = true; more;) {
        v.n = 0;
        while (v.n < BLOCK && more)
            more = read_vector(&v, operation < 2 ? 2 : 1, vectors_read + v.n + 1);
        vectors_read += v.n;
        if (operation < 2) check_operation(&v, operation == 0);
        for (uint32_t i = 0; operation >= 2 && i < v.n; i++)
            if (operation == 2)
                check_to_fixed(v.a[i], (int32_t)v.expected[i]);
            else
                check_to_float((int32_t)v.a[i], v.expected[i]);
    }
    fp_free(shim);
    printf("result: TestFloat, %s: %llu of %llu vectors, %llu results compared, %llu differ%s\n",
           argv[1], (unsigned long long)vectors_read, (unsigned long long)wanted,
           (unsigned long long)compared, (unsigned long long)different,
           timely ? "" : "; valid_o came in a wrong cycle");
    return vectors_read == wanted && compared > 0 && different == 0 && timely ? EXIT_SUCCESS
                                                                              : EXIT_FAILURE;
}
