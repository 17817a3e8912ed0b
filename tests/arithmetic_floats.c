/* SPDX-License-Identifier: Apache-2.0
 *
 * binary32 and the ways into a block and out of it: RTL and golden against Berkeley SoftFloat, on
 * random operands of fp_operands.h.
 */
#include <inttypes.h>
#include <stdio.h>

#include "arithmetic.h"
#include "arithmetic_parts.h"
#include "fp_shim.h"
#include "fp_softfloat.h"

enum { BLOCK = 1 << 16 };

typedef struct tally {
    const char *operation;
    uint64_t seed, operands, golden, different, overflows, subnormals;
    bool timely;
} tally;

static void compare(tally *t, const char *who, uint32_t a, uint32_t b, uint32_t y,
                    uint32_t expected) {
    if (y != expected && t->different++ < SHOWN)
        printf("%s of %s: %08" PRIx32 " %08" PRIx32 ": %08" PRIx32 ", expected %08" PRIx32 "\n",
               t->operation, who, a, b, y, expected);
}

static void count(tally *t, uint32_t result) {
    t->operands++;
    t->overflows += (result & 0x7fffffff) == 0x7f800000;
    t->subnormals += (result & 0x7f800000) == 0 && (result & 0x7fffffff) != 0;
}

static bool conclude(const tally *t, uint64_t wanted) {
    printf("result: %s: %" PRIu64 " operands by SoftFloat (%" PRIu64 " overflow, %" PRIu64
           " subnormal), golden %" PRIu64 ", seed %" PRIu64 ": %" PRIu64 " differ%s\n",
           t->operation, t->operands, t->overflows, t->subnormals, t->golden, t->seed, t->different,
           t->timely ? "" : ", valid_o came in a wrong cycle");
    return t->operands >= wanted && t->golden > 0 && t->different == 0 && t->timely;
}

/* --- fp_add and fp_mul --------------------------------------------------------------------------
 */

/* Golden adds and multiplies in a row of the matrix, with finite operands; +0 is added to both. */
static void compare_golden(tally *t, bool add, uint32_t a, uint32_t b, uint32_t expected) {
    if (!is_finite(a) || !is_finite(b)) return;
    const float m[4] = {add ? 1 : float_of(a), add ? 1 : 0},
                p[4] = {add ? float_of(a) : float_of(b), add ? float_of(b) : 0};
    t->golden++;
    compare(t, "golden", a, b, bits_of(hs_row_times(m, p)), soft_add(expected, 0));
}

static bool campaign_binary(const char *name, bool add, uint64_t operands, uint64_t seed) {
    static uint32_t a[BLOCK], b[BLOCK], y[BLOCK];
    tally t = {.operation = name, .seed = seed, .timely = true};
    fp_shim *shim = fp_new();
    uint64_t state = random_state(seed);
    while (t.operands < operands) {
        for (uint32_t i = 0; i < BLOCK; i++) {
            random_pair(&state, i % OPERAND_KINDS, &a[i], &b[i]);
            if (i % 64 == 0) a[i] = random_special(&state);
            if (i % 128 < 2) b[i] = random_special(&state);
        }
        /* Back to back, and every eighth time with idle cycles. */
        t.timely &= fp_binary(shim, add ? FP_ADD : FP_MUL, BLOCK, a, b, y,
                              t.operands / BLOCK % 8 ? 0 : random_bits(&state));
        for (uint32_t i = 0; i < BLOCK; i++) {
            const uint32_t expected = add ? soft_add(a[i], b[i]) : soft_mul(a[i], b[i]);
            compare(&t, "the RTL", a[i], b[i], y[i], expected);
            compare_golden(&t, add, a[i], b[i], expected);
            count(&t, expected);
        }
    }
    fp_free(shim);
    return conclude(&t, operands);
}

bool campaign_add(uint64_t operands, uint64_t seed) {
    return campaign_binary("add", true, operands, seed);
}

bool campaign_mul(uint64_t operands, uint64_t seed) {
    return campaign_binary("mul", false, operands, seed);
}

/* --- transform ----------------------------------------------------------------------------------
 */

/* Exponents spread around 1 or over everything; or such that products are about 2^128, or about
 * 2^-130. */
enum { FACTOR_KINDS = 6 };
static uint32_t random_factor(uint64_t *state, uint32_t kind) {
    static const struct {
        int middle, range;
    } exponents[FACTOR_KINDS] = {{127, 2}, {127, 12}, {127, 60}, {127, 127}, {190, 2}, {62, 2}};
    const int range = exponents[kind].range;
    const int off = (int)random_below(state, 2 * (uint32_t)range + 1) - range;
    if (random_below(state, 16) == 0) return random_below(state, 2) << 31; /* a zero */
    return assemble(random_bits(state), exponents[kind].middle + off, random_fraction(state));
}

static void compare_vertex(tally *t, const uint32_t matrix[16], const uint32_t p[4],
                           const fp_vertex *rtl, uint32_t *magnitude) {
    uint32_t first = 4;
    float m_float[4], p_float[4];
    memcpy(p_float, p, sizeof p_float);
    for (uint32_t row = 4; row-- > 0;) {
        const uint32_t expected = soft_row(matrix + 4 * row, p);
        memcpy(m_float, matrix + 4 * row, sizeof m_float);
        const float c = hs_row_times(m_float, p_float);
        compare(t, "the RTL", p[0], row, rtl->clip[row], expected);
        compare(t, "golden", p[0], row, isfinite(c) ? bits_of(c) : QUIET_NAN,
                is_finite(expected) ? expected : QUIET_NAN);
        t->golden++;
        count(t, expected);
        if (!is_finite(expected))
            first = row;
        else if ((expected & 0x7fffffff) > *magnitude)
            *magnitude = expected & 0x7fffffff;
    }
    compare(t, "the RTL, overflow", p[0], p[1], rtl->overflow ? rtl->overflow_row : 4, first);
}

bool campaign_transform(uint64_t operands, uint64_t seed) {
    enum { BATCH = 1000 };
    static uint32_t record[4 * BATCH];
    static fp_vertex rtl[BATCH];
    tally t = {.operation = "transform", .seed = seed, .timely = true};
    fp_shim *shim = fp_new();
    uint64_t state = random_state(seed);
    for (uint32_t batch = 0; t.operands < operands; batch++) {
        uint32_t matrix[16], magnitude, expected = 0;
        for (uint32_t k = 0; k < 16; k++)
            matrix[k] = random_factor(&state, batch % FACTOR_KINDS);
        for (uint32_t k = 0; k < 4 * BATCH; k++)
            record[k] = random_factor(&state, batch / FACTOR_KINDS % FACTOR_KINDS);
        t.timely &= fp_transform(shim, matrix, BATCH, record, rtl, &magnitude,
                                 batch % 8 ? 0 : random_bits(&state));
        for (uint32_t i = 0; i < BATCH; i++)
            compare_vertex(&t, matrix, record + 4 * i, &rtl[i], &expected);
        compare(&t, "the RTL, magnitude", matrix[0], record[0], magnitude, expected);
    }
    fp_free(shim);
    return conclude(&t, operands);
}

/* --- quantize and to_fixed, to_float
 * -------------------------------------------------------------- */

bool campaign_exponent(uint64_t operands, uint64_t seed) {
    static uint32_t memory[4 * FP_VERTICES];
    tally t = {.operation = "exponent", .seed = seed, .timely = true};
    fp_shim *shim = fp_new();
    uint64_t state = random_state(seed);
    for (; t.operands < operands; t.golden++) {
        const uint32_t c = random_component(&state, random_exponent(&state)) & 0x7fffffff;
        const int exponent = fp_quantize(shim, 0, c, memory).exponent;
        if (c == 0 ? exponent != 0 : !soft_is_exponent(c, exponent))
            compare(&t, "the RTL", c, 0, (uint32_t)exponent, ~(uint32_t)exponent);
        compare(&t, "golden", c, 0, (uint32_t)hs_block_exponent(float_of(c)), (uint32_t)exponent);
        count(&t, c);
    }
    fp_free(shim);
    return conclude(&t, operands);
}

bool campaign_to_fixed(uint64_t operands, uint64_t seed) {
    tally t = {.operation = "to_fixed", .seed = seed, .timely = true};
    fp_shim *shim = fp_new();
    uint64_t state = random_state(seed);
    for (; t.operands < operands; t.golden++) {
        const int exponent = random_exponent(&state);
        const uint32_t e = (uint32_t)exponent, c = random_component(&state, exponent);
        const uint32_t expected = (uint32_t)soft_to_fixed(c, exponent);
        compare(&t, "the RTL", c, e, (uint32_t)fp_to_fixed(shim, c, exponent), expected);
        compare(&t, "golden", c, e, (uint32_t)hs_to_fixed(float_of(c), exponent), expected);
        count(&t, c);
    }
    fp_free(shim);
    return conclude(&t, operands);
}

bool campaign_to_float(uint64_t operands, uint64_t seed) {
    tally t = {.operation = "to_float", .seed = seed, .timely = true};
    fp_shim *shim = fp_new();
    uint64_t state = random_state(seed);
    for (; t.operands < operands; t.golden++) {
        const int exponent = random_exponent(&state);
        const int32_t q = random_fixed(&state, exponent);
        const uint32_t e = (uint32_t)exponent, expected = soft_to_float(q, exponent);
        compare(&t, "the RTL", (uint32_t)q, e, fp_to_float(shim, q, exponent), expected);
        compare(&t, "golden", (uint32_t)q, e, bits_of(hs_to_float(q, hs_unit(exponent))), expected);
        count(&t, expected);
    }
    fp_free(shim);
    return conclude(&t, operands);
}
