/* SPDX-License-Identifier: Apache-2.0
 *
 * Operands for the floating-point modules, weighted towards where they go wrong. Floats travel as
 * their bit patterns; a state is any number but 0.
 */
#ifndef HS_TESTS_FP_OPERANDS_H
#define HS_TESTS_FP_OPERANDS_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "random.h"

static inline float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline bool is_nan(uint32_t bits) {
    return (bits & 0x7fffffff) > 0x7f800000;
}

static inline bool is_finite(uint32_t bits) {
    return (bits & 0x7f800000) != 0x7f800000;
}

/* --- Random operands ---------------------------------------------------------------------------
 */

static inline uint32_t assemble(uint32_t sign, int exponent, uint32_t fraction) {
    int clamped = exponent < 0 ? 0 : exponent > 254 ? 254 : exponent;
    return (sign & 1) << 31 | (uint32_t)clamped << 23 | (fraction & 0x7fffff);
}

/* A fraction whose low bits are often all zeros or all ones, which is where rounding is decided. */
static inline uint32_t random_fraction(uint64_t *state) {
    uint32_t fraction = random_bits(state) & 0x7fffff, low = random_below(state, 24);
    switch (random_below(state, 4)) {
    case 0:
        return fraction & ~((1u << low) - 1);
    case 1:
        return fraction | ((1u << low) - 1);
    default:
        return fraction;
    }
}

/* A pair of operands, from the kind'th of the places where adders and multipliers go wrong. */
enum { OPERAND_KINDS = 8 };
static inline void random_pair(uint64_t *state, uint32_t kind, uint32_t *a, uint32_t *b) {
    uint32_t r = random_bits(state);
    int e = (int)random_below(state, 255), offset = (int)random_below(state, 61) - 30;
    uint32_t x = random_fraction(state), y = random_fraction(state);
    switch (kind) {
    case 0: /* anything */
        *a = r;
        *b = random_bits(state);
        break;
    case 1: /* exponents near each other */
        *a = assemble(r, e, x);
        *b = assemble(r >> 1, e + offset, y);
        break;
    case 2: /* subnormal, or nearly */
        *a = assemble(r, (int)random_below(state, 3), x);
        *b = assemble(r >> 1, (int)random_below(state, 30), y);
        break;
    case 3: /* massive cancellation */
        *a = assemble(r, e, x);
        *b = (*a ^ 0x80000000u) + (uint32_t)offset;
        break;
    case 4: /* a sum halfway between two floats, or one step beside: b is a power of two, near
             * a's half ulp */
        *a = assemble(r, e, x);
        *b = assemble(r >> 1, e - 24 + (int)(r >> 2 & 1), 0) + (uint32_t)((int)(r >> 3 & 3) - 1);
        break;
    case 5: /* a product of about 25 bits: halfway between two floats every second time */
        *a = assemble(r, e, x << 11);
        *b = assemble(r >> 1, 127 + offset, y << 11);
        break;
    case 6: /* a product around the least normal number */
        *a = assemble(r, e, x);
        *b = assemble(r >> 1, 127 - e + offset, y);
        break;
    default: /* around overflow */
        *a = assemble(r, 254 - (int)random_below(state, 2), x);
        *b = assemble(r >> 1, r >> 2 & 1 ? 254 : 126 + (int)random_below(state, 3), y);
        break;
    }
}

/* Magnitudes; each is used with both signs. */
static const uint32_t SPECIAL[] = {
    0x00000000, 0x00000001, 0x00000002, 0x00000003, 0x00000004, 0x003fffff, 0x00400000, 0x00400001,
    0x007ffffe, 0x007fffff, 0x00800000, 0x00800001, 0x00ffffff, 0x01000000, 0x01000001, 0x017fffff,
    0x0b800000, 0x1f800000, 0x20000000, 0x33000000, 0x33800000, 0x33800001, 0x34000000, 0x34000001,
    0x3effffff, 0x3f000000, 0x3f000001, 0x3f7fffff, 0x3f800000, 0x3f800001, 0x3fbfffff, 0x3fc00000,
    0x3fffffff, 0x40000000, 0x40400000, 0x4b000000, 0x4b7fffff, 0x4b800000, 0x5f000000, 0x5f7fffff,
    0x5f800000, 0x7e7fffff, 0x7e800000, 0x7effffff, 0x7f000000, 0x7f000001, 0x7f7ffffe, 0x7f7fffff,
    0x7f800000, 0x7f800001, 0x7fbfffff, 0x7fc00000, 0x7fffffff,
};
enum { SPECIALS = 2 * sizeof SPECIAL / sizeof SPECIAL[0] };

static inline uint32_t random_special(uint64_t *state) {
    const uint32_t i = random_below(state, SPECIALS);
    return SPECIAL[i / 2] | i << 31;
}

/* --- Blocks --------------------------------------------------------------------------------------
 */

enum { LEAST_EXPONENT = -148, LARGEST_EXPONENT = 128 };

/* The bits of the largest float below 2^E. */
static inline uint32_t largest_below(int exponent) {
    return bits_of((float)ldexp(1.0, exponent - 1)) + (exponent > -126 ? 0x7fffff : 0) +
           (exponent <= -126 ? (1u << (exponent + 148)) - 1 : 0);
}

/* A finite float with |c| < 2^E, often one whose last bits land around the rounding point. */
static inline uint32_t random_component(uint64_t *state, int exponent) {
    uint32_t top = largest_below(exponent), r = random_bits(state), magnitude;
    int field = (int)(top >> 23);
    switch (r & 3) {
    case 0:
        magnitude = random_below(state, top + 1);
        break;
    case 1:
        magnitude = top - random_below(state, top < 100 ? top + 1 : 100);
        break;
    default:
        magnitude = assemble(0, field - (int)random_below(state, 36), random_fraction(state));
        break;
    }
    return (magnitude > top ? top : magnitude) | (r & 0x80000000u);
}

static inline int random_exponent(uint64_t *state) {
    return LEAST_EXPONENT + (int)random_below(state, LARGEST_EXPONENT - LEAST_EXPONENT + 1);
}

/* At E = 128 the pipeline's numbers reach 2^30 - 2^6 only. */
static inline int32_t largest_fixed(int exponent) {
    return exponent == LARGEST_EXPONENT ? (1 << 30) - (1 << 6) : 1 << 30;
}

static inline int32_t random_fixed(uint64_t *state, int exponent) {
    int32_t top = largest_fixed(exponent), q;
    uint32_t r = random_bits(state), width = random_below(state, 31);
    switch (r & 3) {
    case 0:
        q = (int32_t)random_below(state, (uint32_t)top + 1);
        break;
    case 1:
        q = (int32_t)(random_fraction(state) << 7 | random_below(state, 128));
        break;
    case 2:
        q = (int32_t)((1u << width) + random_below(state, 5)) - 2;
        break;
    default:
        q = (int32_t)(random_bits(state) & ((1u << width) - 1));
        break;
    }
    q = q > top ? top : q < 0 ? 0 : q;
    return r >> 31 ? -q : q;
}

#endif
