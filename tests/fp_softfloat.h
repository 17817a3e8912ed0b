/* SPDX-License-Identifier: Apache-2.0
 *
 * What the floating-point modules must give, by Berkeley SoftFloat: integer code that shares
 * nothing with rtl/, with golden or with the host's floating-point unit. Floats travel as their bit
 * patterns.
 */
#ifndef HS_TESTS_FP_SOFTFLOAT_H
#define HS_TESTS_FP_SOFTFLOAT_H

#include <softfloat.h>

#include "fp_operands.h"

/* Every NaN of the RTL is this one. */
#define QUIET_NAN 0x7fc00000u

static inline uint32_t soft_canonical(float32_t y) {
    return is_nan(y.v) ? QUIET_NAN : y.v;
}

static inline uint32_t soft_add(uint32_t a, uint32_t b) {
    return soft_canonical(f32_add((float32_t){a}, (float32_t){b}));
}

static inline uint32_t soft_mul(uint32_t a, uint32_t b) {
    return soft_canonical(f32_mul((float32_t){a}, (float32_t){b}));
}

/* (m0*x + m1*y) + (m2*z + m3*w). */
static inline uint32_t soft_row(const uint32_t m[4], const uint32_t p[4]) {
    return soft_add(soft_add(soft_mul(m[0], p[0]), soft_mul(m[1], p[1])),
                    soft_add(soft_mul(m[2], p[2]), soft_mul(m[3], p[3])));
}

/* 2^e, e from -1022 to 1023. */
static inline float64_t soft_power(int e) {
    return (float64_t){(uint64_t)(e + 1023) << 52};
}

/* RNE(c 2^(30-E)): exact in 64 bits, then rounded to an integer. */
static inline int32_t soft_to_fixed(uint32_t c, int exponent) {
    const float64_t scaled = f64_mul(f32_to_f64((float32_t){c}), soft_power(30 - exponent));
    return (int32_t)f64_to_i32(scaled, softfloat_round_near_even, false);
}

/* q 2^(E-30): exact in 64 bits, then rounded to 32. */
static inline uint32_t soft_to_float(int32_t q, int exponent) {
    return f64_to_f32(f64_mul(i32_to_f64(q), soft_power(exponent - 30))).v;
}

/* True if E is the smallest integer with |c| < 2^E. */
static inline bool soft_is_exponent(uint32_t magnitude, int exponent) {
    const float64_t c = f32_to_f64((float32_t){magnitude});
    return f64_lt(c, soft_power(exponent)) && !f64_lt(c, soft_power(exponent - 1));
}

#endif
