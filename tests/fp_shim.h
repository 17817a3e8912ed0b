/* SPDX-License-Identifier: Apache-2.0
 *
 * The floating-point modules of rtl/ (as tests/fp_top.sv lines them up, under Verilator) as C
 * functions. Floats travel as their bit patterns.
 *
 * Every function that streams items also checks the modules' timing: an output must be valid in
 * exactly the cycles that the contract names. gaps = 0 sends items back to back; any other value
 * seeds idle cycles at random, about every second one.
 */
#ifndef HS_TESTS_FP_SHIM_H
#define HS_TESTS_FP_SHIM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { FP_VERTICES = 1 << 17 }; /* vertices of the memory that quantize works on */

typedef struct fp_shim fp_shim;
fp_shim *fp_new(void);
void fp_free(fp_shim *shim);

/* What fp_binary computes. */
enum fp_operation { FP_ADD, FP_MUL };

/* y[i] = a[i] op b[i] for n pairs. False if valid_o was wrong in some cycle. */
bool fp_binary(fp_shim *shim, enum fp_operation operation, size_t n, const uint32_t *a,
               const uint32_t *b, uint32_t *y, uint32_t gaps);

/* One vertex out of transform. */
typedef struct fp_vertex {
    uint32_t clip[4];
    uint32_t index;
    bool overflow;
    uint32_t overflow_row; /* only if overflow */
} fp_vertex;

/* Transforms n records of 4 words; the vertex numbers sent are 0 to n-1. *magnitude is
 * magnitude_o in the first cycle in which busy_o is low. False if valid_o, or busy_o, was wrong in
 * some cycle. */
bool fp_transform(fp_shim *shim, const uint32_t matrix[16], size_t n, const uint32_t *record,
                  fp_vertex *vertex, uint32_t *magnitude, uint32_t gaps);

/* RNE(c * 2^(30-exponent)), and q * 2^(exponent-30). */
int32_t fp_to_fixed(fp_shim *shim, uint32_t c, int exponent);
uint32_t fp_to_float(fp_shim *shim, int32_t q, int exponent);

/* What quantize did, cycle by cycle from start_i (cycle 0) to done_o. */
typedef struct fp_quantize_report {
    int exponent;
    uint32_t done_cycle;
    uint32_t busy, starved, blocked, idle, items_in, items_out;
    uint32_t confused;  /* cycles with more than one of busy, starved, blocked */
    uint32_t unordered; /* reads and writes that were not of the next vertex */
} fp_quantize_report;

/* Runs quantize on memory, 4 * FP_VERTICES words. */
fp_quantize_report fp_quantize(fp_shim *shim, uint32_t count, uint32_t magnitude, uint32_t *memory);

#ifdef __cplusplus
}
#endif
#endif
