/* SPDX-License-Identifier: Apache-2.0
 *
 * The floating-point modules of rtl/, and golden's functions, against the arithmetic of the machine
 * that runs this test. References: float operations (IEEE-754, no contraction) for fp_add, fp_mul
 * and transform; double, which holds every number concerned exactly, and one final rounding, for
 * to_fixed and to_float.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "arithmetic.h"
#include "cases.h"
#include "fp_operands.h"
#include "fp_shim.h"

/* --- Bits and floats ---------------------------------------------------------------------------
 */

/* The contract of fp_add and fp_mul: the host's bits, but every NaN is 7fc00000. */
static uint32_t canonical(float value) {
    uint32_t bits = bits_of(value);
    return is_nan(bits) ? 0x7fc00000 : bits;
}

static uint32_t host_add(uint32_t a, uint32_t b) {
    volatile float sum = float_of(a) + float_of(b);
    return canonical(sum);
}

static uint32_t host_mul(uint32_t a, uint32_t b) {
    volatile float product = float_of(a) * float_of(b);
    return canonical(product);
}

/* --- fp_add and fp_mul -------------------------------------------------------------------------
 */

/* Streams n pairs through a unit and counts where it differs from the host. */
static size_t differences(enum fp_operation operation, size_t n, const uint32_t *a,
                          const uint32_t *b, uint32_t gaps) {
    fp_shim *shim = fp_new();
    uint32_t *y = calloc(n, sizeof *y);
    assert_non_null(y);
    assert_true(fp_binary(shim, operation, n, a, b, y, gaps));
    size_t different = 0;
    for (size_t i = 0; i < n; i++) {
        uint32_t expected = operation == FP_ADD ? host_add(a[i], b[i]) : host_mul(a[i], b[i]);
        if (y[i] != expected && different++ < 5)
            printf("%08x %s %08x: %08x, expected %08x\n", a[i], operation == FP_ADD ? "+" : "*",
                   b[i], y[i], expected);
    }
    free(y);
    fp_free(shim);
    return different;
}

static void check_random_pairs(enum fp_operation operation, uint32_t gaps) {
    const size_t n = cases(1000000);
    uint32_t *a = calloc(n, sizeof *a), *b = calloc(n, sizeof *b);
    assert_non_null(a);
    assert_non_null(b);
    uint64_t state = 0x9e3779b97f4a7c15ull;
    for (size_t i = 0; i < n; i++)
        random_pair(&state, i % OPERAND_KINDS, &a[i], &b[i]);
    assert_int_equal(differences(operation, n, a, b, gaps), 0);
    free(a);
    free(b);
}

static void addition_of_random_operands_equals_the_host(void **state) {
    (void)state;
    check_random_pairs(FP_ADD, 0);
}

static void multiplication_of_random_operands_equals_the_host(void **state) {
    (void)state;
    check_random_pairs(FP_MUL, 0);
}

static void idle_cycles_between_operands_change_no_result(void **state) {
    (void)state;
    check_random_pairs(FP_ADD, 1);
    check_random_pairs(FP_MUL, 2);
}

static void all_pairs_of_special_operands_equal_the_host(void **state) {
    (void)state;
    static uint32_t a[SPECIALS * SPECIALS], b[SPECIALS * SPECIALS];
    for (uint32_t i = 0; i < SPECIALS; i++)
        for (uint32_t j = 0; j < SPECIALS; j++) {
            a[i * SPECIALS + j] = SPECIAL[i / 2] | i << 31;
            b[i * SPECIALS + j] = SPECIAL[j / 2] | j << 31;
        }
    assert_int_equal(differences(FP_ADD, SPECIALS * SPECIALS, a, b, 0), 0);
    assert_int_equal(differences(FP_MUL, SPECIALS * SPECIALS, a, b, 0), 0);
}

/* --- to_fixed and to_float ----------------------------------------------------------------------
 */

/* RNE(c * 2^(30-E)). Exact in double but for rint, which rounds to nearest even. */
static int32_t fixed_reference(uint32_t c, int exponent) {
    return (int32_t)rint(ldexp((double)float_of(c), 30 - exponent));
}

/* q * 2^(E-30). Exact in double but for the conversion to float. */
static uint32_t float_reference(int32_t q, int exponent) {
    volatile float c = (float)ldexp((double)q, exponent - 30);
    return bits_of(c);
}

static void check_to_fixed(fp_shim *shim, uint32_t c, int exponent) {
    int32_t q = fp_to_fixed(shim, c, exponent), expected = fixed_reference(c, exponent);
    if (q != expected)
        fail_msg("to_fixed(%08x, E = %d) is %d, expected %d", c, exponent, q, expected);
    assert_int_equal(hs_to_fixed(float_of(c), exponent), expected);
}

static void check_to_float(fp_shim *shim, int32_t q, int exponent) {
    uint32_t c = fp_to_float(shim, q, exponent), expected = float_reference(q, exponent);
    if (c != expected)
        fail_msg("to_float(%d, E = %d) is %08x, expected %08x", q, exponent, c, expected);
    assert_int_equal(bits_of(hs_to_float(q, hs_unit(exponent))), expected);
}

static void fixed_point_is_the_nearest_to_every_float(void **unused) {
    (void)unused;
    fp_shim *shim = fp_new();
    for (int exponent = LEAST_EXPONENT; exponent <= LARGEST_EXPONENT; exponent++) {
        uint32_t top = largest_below(exponent);
        assert_true(ldexp((double)float_of(top), -exponent) < 1.0);
        for (uint32_t i = 0; i < SPECIALS; i++)
            if (SPECIAL[i / 2] <= top) check_to_fixed(shim, SPECIAL[i / 2] | i << 31, exponent);
        for (uint32_t back = 0; back < 4 && back <= top; back++) {
            check_to_fixed(shim, top - back, exponent);
            check_to_fixed(shim, (top - back) | 0x80000000u, exponent);
        }
    }
    uint64_t state = 1;
    const uint32_t rounds = cases(1000000);
    for (uint32_t i = 0; i < rounds; i++) {
        int exponent = random_exponent(&state);
        check_to_fixed(shim, random_component(&state, exponent), exponent);
    }
    fp_free(shim);
}

static void floats_are_the_nearest_to_every_fixed_point_number(void **unused) {
    (void)unused;
    fp_shim *shim = fp_new();
    for (int exponent = LEAST_EXPONENT; exponent <= LARGEST_EXPONENT; exponent++) {
        int32_t top = largest_fixed(exponent);
        for (int32_t k = 0; k < 3; k++) {
            check_to_float(shim, k, exponent);
            check_to_float(shim, -k, exponent);
            check_to_float(shim, top - k, exponent);
            check_to_float(shim, k - top, exponent);
        }
        for (int bit = 0; bit < 30; bit++)
            for (int32_t beside = -1; beside <= 1; beside++)
                check_to_float(shim, (1 << bit) + beside, exponent);
    }
    uint64_t state = 2;
    const uint32_t rounds = cases(1000000);
    for (uint32_t i = 0; i < rounds; i++) {
        int exponent = random_exponent(&state);
        int32_t q = random_fixed(&state, exponent);
        check_to_float(shim, q, exponent);
        assert_true(is_finite(fp_to_float(shim, q, exponent)));
    }
    fp_free(shim);
}

/* Where the target has a place for every bit, conversion there and back changes nothing. */
static void conversion_there_and_back_is_exact(void **unused) {
    (void)unused;
    fp_shim *shim = fp_new();
    uint64_t state = 3;
    uint32_t floats = 0, fixed = 0;
    const uint32_t rounds = cases(300000);
    for (uint32_t i = 0; i < rounds; i++) {
        int exponent = random_exponent(&state);
        uint32_t c = random_component(&state, exponent);
        int32_t q = fp_to_fixed(shim, c, exponent);
        if (ldexp((double)q, exponent - 30) == (double)float_of(c)) {
            floats++;
            uint32_t expected = c == 0x80000000u ? 0 : c; /* -0 leaves as +0 */
            assert_int_equal(fp_to_float(shim, q, exponent), expected);
        }
        q = random_fixed(&state, exponent);
        if (abs(q) <= 1 << 24 && exponent >= 30 - 149) {
            fixed++;
            assert_int_equal(fp_to_fixed(shim, fp_to_float(shim, q, exponent), exponent), q);
        }
    }
    assert_true(floats > cases(50000) && fixed > cases(50000));
    fp_free(shim);
}

/* --- transform ----------------------------------------------------------------------------------
 */

/* What transform should say of n records. */
static uint32_t transform_reference(const uint32_t matrix[16], size_t n, const uint32_t *record,
                                    fp_vertex *vertex) {
    uint32_t magnitude = 0;
    for (size_t i = 0; i < n; i++) {
        const uint32_t *p = record + 4 * i;
        vertex[i] = (fp_vertex){.index = (uint32_t)i};
        for (uint32_t row = 4; row-- > 0;) {
            const uint32_t *m = matrix + 4 * row;
            uint32_t xy = host_add(host_mul(m[0], p[0]), host_mul(m[1], p[1]));
            uint32_t zw = host_add(host_mul(m[2], p[2]), host_mul(m[3], p[3]));
            uint32_t c = host_add(xy, zw);
            float m_float[4], p_float[4];
            memcpy(m_float, m, sizeof m_float);
            memcpy(p_float, p, sizeof p_float);
            assert_int_equal(canonical(hs_row_times(m_float, p_float)), c);
            vertex[i].clip[row] = c;
            if (!is_finite(c)) {
                vertex[i].overflow = true;
                vertex[i].overflow_row = row;
            } else if ((c & 0x7fffffff) > magnitude)
                magnitude = c & 0x7fffffff;
        }
    }
    return magnitude;
}

/* Batches of vertices under matrices of their own; spread is the range of the exponents. Returns
 * how many of them overflowed. */
static uint32_t check_transform(uint32_t batches, int spread, uint32_t gaps) {
    enum { BATCH = 1000 };
    static uint32_t record[4 * BATCH];
    static fp_vertex got[BATCH], expected[BATCH];
    fp_shim *shim = fp_new();
    uint64_t state = 4;
    uint32_t overflows = 0;
    for (uint32_t batch = 0; batch < batches; batch++) {
        uint32_t matrix[16];
        for (uint32_t k = 0; k < 16; k++)
            matrix[k] = assemble(random_bits(&state), 127 + (int)random_below(&state, 3) - 1,
                                 random_fraction(&state));
        for (uint32_t k = 0; k < 4 * BATCH; k++)
            record[k] = assemble(random_bits(&state),
                                 127 + (int)random_below(&state, 2 * (uint32_t)spread) - spread,
                                 random_fraction(&state));
        uint32_t expected_magnitude = transform_reference(matrix, BATCH, record, expected),
                 magnitude;
        assert_true(
            fp_transform(shim, matrix, BATCH, record, got, &magnitude, gaps ? batch + 1 : 0));
        for (uint32_t i = 0; i < BATCH; i++) {
            assert_int_equal(got[i].index, i);
            assert_memory_equal(got[i].clip, expected[i].clip, sizeof got[i].clip);
            assert_int_equal(got[i].overflow, expected[i].overflow);
            if (got[i].overflow) assert_int_equal(got[i].overflow_row, expected[i].overflow_row);
            overflows += got[i].overflow;
        }
        assert_int_equal(magnitude, expected_magnitude);
    }
    fp_free(shim);
    return overflows;
}

static void transform_equals_floats_in_the_order_of_the_contract(void **state) {
    (void)state;
    assert_int_equal(check_transform(cases(80), 12, 0), 0);
    assert_int_equal(check_transform(cases(20), 12, 1), 0);
}

static void transform_reports_the_first_row_that_overflows(void **state) {
    (void)state;
    uint32_t overflows = check_transform(cases(20), 128, 1);
    assert_in_range(overflows, cases(100), cases(19900));
}

static void transform_clears_its_magnitude_between_views(void **state) {
    (void)state;
    fp_shim *shim = fp_new();
    uint32_t identity[16] = {0}, magnitude;
    for (uint32_t k = 0; k < 4; k++)
        identity[5 * k] = bits_of(1.0f);
    uint32_t large[4] = {bits_of(-8.0f), 0, 0, 0}, small[4] = {0, 0, 0x80000001u, 0};
    fp_vertex vertex;
    assert_true(fp_transform(shim, identity, 1, large, &vertex, &magnitude, 0));
    assert_int_equal(magnitude, bits_of(8.0f));
    assert_true(fp_transform(shim, identity, 1, small, &vertex, &magnitude, 0));
    assert_int_equal(magnitude, 1);
    assert_true(fp_transform(shim, identity, 0, small, &vertex, &magnitude, 0));
    assert_int_equal(magnitude, 0);
    fp_free(shim);
}

/* --- quantize -----------------------------------------------------------------------------------
 */

static void check_quantize(fp_shim *shim, uint64_t *state, uint32_t count, int exponent) {
    static uint32_t memory[4 * FP_VERTICES], before[4 * FP_VERTICES];
    uint32_t magnitude = 0;
    for (uint32_t k = 0; k < 4 * FP_VERTICES; k++)
        memory[k] = 0x7fc12345;
    for (uint32_t k = 0; k < 4 * count; k++) {
        memory[k] = random_component(state, exponent);
        uint32_t size = memory[k] & 0x7fffffff;
        magnitude = size > magnitude ? size : magnitude;
    }
    memcpy(before, memory, sizeof before);

    int expected_exponent = 0;
    if (magnitude) frexp((double)float_of(magnitude), &expected_exponent);
    fp_quantize_report report = fp_quantize(shim, count, magnitude, memory);
    assert_int_equal(report.exponent, expected_exponent);
    assert_int_equal(hs_block_exponent(float_of(magnitude)), expected_exponent);
    for (uint32_t k = 0; k < 4 * count; k++)
        assert_int_equal((int32_t)memory[k], fixed_reference(before[k], expected_exponent));
    for (uint32_t k = 4 * count; k < 4 * FP_VERTICES; k++)
        assert_int_equal(memory[k], before[k]);

    assert_int_equal(report.done_cycle, count + 2);
    assert_int_equal(report.busy, count);
    assert_int_equal(report.starved, 2);
    assert_int_equal(report.blocked, 0);
    assert_int_equal(report.idle, 1);
    assert_int_equal(report.items_in, count);
    assert_int_equal(report.items_out, count);
    assert_int_equal(report.confused, 0);
    assert_int_equal(report.unordered, 0);
}

static void quantize_converts_the_whole_memory_and_nothing_else(void **unused) {
    (void)unused;
    fp_shim *shim = fp_new();
    uint64_t state = 5;
    const uint32_t counts[] = {0, 1, 2, 3, 0, 1000, FP_VERTICES - 1, FP_VERTICES, 7};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        check_quantize(shim, &state, counts[i], random_exponent(&state));
    check_quantize(shim, &state, 100, LEAST_EXPONENT);
    check_quantize(shim, &state, 100, LARGEST_EXPONENT);
    fp_free(shim);
}

static void the_exponent_of_a_block_is_the_least_above_its_magnitude(void **unused) {
    (void)unused;
    fp_shim *shim = fp_new();
    static uint32_t memory[4 * FP_VERTICES];
    assert_int_equal(fp_quantize(shim, 0, 0, memory).exponent, 0);
    for (int exponent = LEAST_EXPONENT; exponent <= LARGEST_EXPONENT; exponent++) {
        uint32_t least = bits_of((float)ldexp(1.0, exponent - 1)), most = largest_below(exponent);
        assert_int_equal(fp_quantize(shim, 0, least, memory).exponent, exponent);
        assert_int_equal(fp_quantize(shim, 0, most, memory).exponent, exponent);
    }
    fp_free(shim);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_pairs_of_special_operands_equal_the_host),
        cmocka_unit_test(addition_of_random_operands_equals_the_host),
        cmocka_unit_test(multiplication_of_random_operands_equals_the_host),
        cmocka_unit_test(idle_cycles_between_operands_change_no_result),
        cmocka_unit_test(fixed_point_is_the_nearest_to_every_float),
        cmocka_unit_test(floats_are_the_nearest_to_every_fixed_point_number),
        cmocka_unit_test(conversion_there_and_back_is_exact),
        cmocka_unit_test(transform_equals_floats_in_the_order_of_the_contract),
        cmocka_unit_test(transform_reports_the_first_row_that_overflows),
        cmocka_unit_test(transform_clears_its_magnitude_between_views),
        cmocka_unit_test(the_exponent_of_a_block_is_the_least_above_its_magnitude),
        cmocka_unit_test(quantize_converts_the_whole_memory_and_nothing_else),
    };
    return cmocka_run_group_tests_name("fp", tests, NULL, NULL);
}
