/* SPDX-License-Identifier: Apache-2.0
 *
 * The parts of the arithmetic campaign (tests/arithmetic.c). Each compares RTL and golden with a
 * source that shares no code with them, prints the first few differences and one or more lines
 * `result: ...`, and returns true if it compared as much as asked for and nothing differs.
 */
#ifndef HS_TESTS_ARITHMETIC_PARTS_H
#define HS_TESTS_ARITHMETIC_PARTS_H

#include <stdbool.h>
#include <stdint.h>

enum { SHOWN = 10 }; /* differences */

/* That many random operands of one operation; a seed other than 0. */
typedef bool campaign(uint64_t operands, uint64_t seed);

/* By Berkeley SoftFloat: arithmetic_floats.c. */
campaign campaign_add, campaign_mul, campaign_transform, campaign_exponent, campaign_to_fixed,
    campaign_to_float;

/* In exact integers: arithmetic_divide.c. */
campaign campaign_divide;
/* The proof for every n and width, and every remainder of every denominator: operands do not count.
 */
campaign campaign_remainders;

/* By GMP: arithmetic_facing.c. */
campaign campaign_facing;

#endif
