/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/emit.sv (with pack) as a C object that is clocked cycle by cycle.
 */
#ifndef HS_EMIT_SHIM_H
#define HS_EMIT_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An op, as the ports of rtl/emit.sv describe it. */
typedef struct emit_op {
    uint32_t kind, generation, number;
    uint32_t position[4];
    uint32_t
        group[12]; /* GROUP: positions of vertices 1 to 3; their numbers are vertex[0] to [2] */
    uint32_t at_level;
    uint32_t mask, triangle, child, candidate;
    uint32_t vertex[16]; /* vertex k of slot s at 4*s+k */
    uint32_t sides, first, last;
} emit_op;

/* Inputs that stand still during a packet. */
typedef struct emit_view {
    uint32_t view, status, position;
    int32_t exponent;
} emit_view;

/* What the ports show in a cycle, before its clock edge. */
typedef struct emit_wires {
    bool op_ready, tvalid, tlast, done, busy, starved, blocked;
    uint32_t tdata[16];
    uint64_t tkeep;
    uint32_t tid, items_in, items_out;
} emit_wires;

typedef struct emit_rtl emit_rtl;

/* port: records a beat, 1, 2 or 4. seed: what registers hold before reset. */
emit_rtl *emit_rtl_new(uint32_t port, uint32_t seed);
void emit_rtl_free(emit_rtl *rtl);

/* One cycle: sets the inputs (op NULL: none is offered), reads the wires, then clocks. */
void emit_rtl_cycle(emit_rtl *rtl, const emit_op *op, const emit_view *view, bool tready,
                    emit_wires *wires);

#ifdef __cplusplus
}
#endif
#endif
