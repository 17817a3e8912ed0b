/* SPDX-License-Identifier: Apache-2.0
 *
 * tests/window_top.sv under Verilator: rtl/scatter.sv and rtl/gather.sv before one memory.
 */
#ifndef WINDOW_SHIM_H
#define WINDOW_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { WINDOW_WORDS = 64, WINDOW_BANKS = 8, GATHER_WINDOW = 8 };

/* An item on offer: lanes in use, the word of each, what is written there. */
typedef struct window_item {
    bool valid;
    uint8_t mask, index[4], data[4];
    uint16_t number; /* of a reading item: goes along */
} window_item;

/* What is seen in a cycle. */
typedef struct window_wires {
    bool write_ready, write_active, write_conflict;
    bool read_ready, read_active, read_conflict;
    bool out; /* an item comes out, with its words */
    uint16_t number;
    uint8_t data[4];
} window_wires;

typedef struct window_shim window_shim;

/* Builds and resets it; seed randomizes what reset leaves alone. */
window_shim *window_new(uint32_t seed);
void window_free(window_shim *shim);
/* One cycle: what is offered, and what is seen in it. */
window_wires window_cycle(window_shim *shim, const window_item *write, const window_item *read,
                          bool stall);

#ifdef __cplusplus
}
#endif
#endif
