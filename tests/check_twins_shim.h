/* SPDX-License-Identifier: Apache-2.0
 *
 * tests/check_twins_top.sv under Verilator: rtl/check_twins.sv with the corners of a mesh in a
 * memory.
 */
#ifndef CHECK_TWINS_SHIM_H
#define CHECK_TWINS_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { CHECK_VERTICES = 64, CHECK_CORNERS = 128 };

typedef struct check_corner {
    uint8_t origin, twin; /* twin: anything if border */
    bool border, first, last;
    uint8_t sharpness;
} check_corner;

typedef struct check_verdict {
    bool error, of_sharpness;
    uint32_t corner;
    uint32_t cycles; /* at work; 0: it did not come to an end */
} check_verdict;

typedef struct check_twins_shim check_twins_shim;

/* Builds and resets it; seed randomizes what reset leaves alone. */
check_twins_shim *check_twins_new(uint32_t seed);
void check_twins_free(check_twins_shim *shim);
/* Writes the corners into the memory and has them checked. */
check_verdict check_twins_run(check_twins_shim *shim, const check_corner *corner, uint32_t corners);

#ifdef __cplusplus
}
#endif
#endif
