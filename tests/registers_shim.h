/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/registers.sv with rtl/counters.sv behind it, as a C object. 1000 vertices, 2000 quads.
 */
#ifndef HS_REGISTERS_SHIM_H
#define HS_REGISTERS_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { REGISTERS_VERTICES = 1000, REGISTERS_QUADS = 2000, OKAY = 0, SLVERR = 2 };

/* What the pipeline does in a cycle. Bit s of the activities and 3 bits at 3*s of the items are
 * stage s. */
typedef struct pipeline_cycle {
    uint32_t busy, starved, blocked, in, out, conflicts;
    bool view_busy, view_done;
    uint32_t status, position;
} pipeline_cycle;

typedef struct registers_rtl registers_rtl;

/* seed: what registers hold before reset, and how long the master hesitates in bus accesses. */
registers_rtl *registers_rtl_new(uint32_t seed);
void registers_rtl_free(registers_rtl *rtl);

/* One cycle without bus access. */
void registers_rtl_cycle(registers_rtl *rtl, const pipeline_cycle *cycle);
/* Cycles since reset. */
uint64_t registers_rtl_cycles(const registers_rtl *rtl);
/* The limits that the pipeline sees. */
void registers_rtl_limits(const registers_rtl *rtl, uint32_t *vertices, uint32_t *quads);

/* A bus access while the pipeline is idle. Returns the response, or -1 if there
 * is none in 100 cycles, or one that changes before it is taken. *taken is the cycle in which the
 * address was taken. */
int registers_rtl_read(registers_rtl *rtl, uint32_t address, uint32_t *data, uint64_t *taken);
int registers_rtl_write(registers_rtl *rtl, uint32_t address, uint32_t data, uint32_t strobe);

#ifdef __cplusplus
}
#endif
#endif
