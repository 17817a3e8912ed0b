/* SPDX-License-Identifier: Apache-2.0
 *
 * tests/fifo_top.sv under Verilator, a cycle at a time. Lane i holds 2, 4, 16 words.
 */
#ifndef FIFO_SHIM_H
#define FIFO_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { FIFO_LANES = 3 };

/* Both sides of a FIFO in one cycle. */
typedef struct fifo_wires {
    bool in_valid, out_ready; /* set by the caller */
    uint32_t in_data;
    bool in_ready, out_valid; /* filled in */
    uint32_t out_data, level;
} fifo_wires;

typedef struct fifo_shim fifo_shim;

/* Builds and resets them; seed randomizes what reset leaves alone. */
fifo_shim *fifo_new(uint32_t seed);
void fifo_free(fifo_shim *shim);
/* Sets the inputs, samples the outputs, then lets the clock rise. */
void fifo_cycle(fifo_shim *shim, bool reset, fifo_wires wires[FIFO_LANES]);

#ifdef __cplusplus
}
#endif
#endif
