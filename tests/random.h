/* SPDX-License-Identifier: Apache-2.0
 *
 * Random numbers of tests: the same on every machine. A state is any number but 0:
 * random_state spreads small seeds over all its bits.
 */
#ifndef HS_TESTS_RANDOM_H
#define HS_TESTS_RANDOM_H

#include <stdint.h>

/* seed is not 0. */
static inline uint64_t random_state(uint64_t seed) {
    return seed * 0x9e3779b97f4a7c15ull;
}

/* xorshift64*, high half. */
static inline uint32_t random_bits(uint64_t *state) {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (uint32_t)((*state * 0x2545f4914f6cdd1dull) >> 32);
}

/* 0 to n-1. */
static inline uint32_t random_below(uint64_t *state, uint32_t n) {
    return (uint32_t)(((uint64_t)random_bits(state) * n) >> 32);
}

#endif
