/* SPDX-License-Identifier: Apache-2.0
 *
 * Every memory and FIFO of the Verilated RTL, for the injection of faults: found by name in the
 * header that Verilator writes (tests/protection/list), so that none is forgotten.
 */
#ifndef HS_TESTS_MEMORIES_H
#define HS_TESTS_MEMORIES_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hs_memory {
    const char *name; /* its path below the pipeline: "u_refine.u_vertices.u_mark", then the bank */
    uint32_t bits, rows;
} hs_memory;

uint32_t hs_memory_count(void);
hs_memory hs_memory_at(uint32_t memory);

/* The words of a memory, row after row, each in *bytes bytes. */
const void *hs_memory_words(void *top, uint32_t memory, uint32_t *bytes);

/* Flips a bit of a row. top is what hs_rtl_strike is given. */
void hs_memory_flip(void *top, uint32_t memory, uint32_t row, uint32_t bit);

#ifdef __cplusplus
}
#endif
#endif
