/* SPDX-License-Identifier: Apache-2.0
 *
 * The Verilated pipeline's pins, half a cycle at a time: all that C needs of the C++ that Verilator
 * writes. sim/rtl.c drives them by the rules of the buses; rtl.h is what others use.
 *
 * A cycle has two halves. In the first the inputs are set and settle, and what the pins show is
 * what both sides see at the coming edge; the second is the edge. In a waveform, cycle c lasts from
 * time 10c (its state) to 10c + 10, and its inputs come at 10c + 5.
 */
#ifndef HS_RTL_PINS_H
#define HS_RTL_PINS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The widest port's. */
#define HS_MOST_BEAT_WORDS 16

/* One side of an AXI4-Stream: what its sender drives. The words beyond a narrower port's are not
 * looked at, and stay as they were. */
typedef struct hs_axis {
    bool valid, last;
    uint16_t id;
    uint64_t keep; /* a bit a byte */
    uint32_t data[HS_MOST_BEAT_WORDS];
} hs_axis;

typedef struct hs_pins {
    /* Driven by the caller. */
    bool rst;
    hs_axis s_axis;
    bool m_axis_ready;
    bool arvalid, rready, awvalid, wvalid, bready;
    uint16_t araddr, awaddr;
    uint32_t wdata; /* all four bytes are written */
    /* Shown by the RTL. m_axis holds what it showed last while it is valid. */
    bool s_axis_ready;
    hs_axis m_axis;
    bool arready, rvalid, awready, wready, bvalid;
    uint32_t rdata;
    uint8_t rresp, bresp;
} hs_pins;

typedef struct hs_rtl_top hs_rtl_top;

/* Called at the clock's edge for every transaction, while a probe is set: definitions.def (PROBE)
 * says what item and word are. */
typedef void hs_rtl_probe(void *context, uint32_t pipeline, uint32_t probe, uint32_t item,
                          const uint32_t word[4]);

/* Registers and memories start with contents of a random sequence, a seed each. NULL and *err
 * (HS_EXIT_INTERNAL) without memory. The caller resets it. */
hs_rtl_top *hs_rtl_top_new(uint32_t seed, hs_error *err);
void hs_rtl_top_free(hs_rtl_top *top);

/* Before other calls, in a thread that built or used another one in between. */
void hs_rtl_top_enter(hs_rtl_top *top);

/* Words of a beat of either stream. */
size_t hs_rtl_top_beat_words(void);

/* The first half of a cycle: drives the pins and reads what the RTL shows. False (HS_EXIT_INTERNAL)
 * without memory. */
bool hs_rtl_top_settle(hs_rtl_top *top, hs_pins *pins, uint64_t cycle, hs_error *err);

/* The second half. False (HS_EXIT_INTERNAL) if one of the RTL's assertions has failed, which has
 * printed itself, or without memory. */
bool hs_rtl_top_edge(hs_rtl_top *top, uint64_t cycle, hs_error *err);

/* Forgets failed assertions. */
void hs_rtl_top_forgive(hs_rtl_top *top);

/* Whether assertions are looked at. */
void hs_rtl_top_assert(hs_rtl_top *top, bool on);

/* NULL: nobody looks, and nothing is spent on it. */
void hs_rtl_top_probe(hs_rtl_top *top, hs_rtl_probe *probe, void *context);

/* Opens (path) or closes (NULL) an FST waveform of the cycles from first to last. False:
 * HS_EXIT_FILE, or HS_EXIT_INTERNAL without memory. */
bool hs_rtl_top_trace(hs_rtl_top *top, const char *path, uint64_t first, uint64_t last,
                      hs_error *err);

/* The Vhalfstep itself, for those who change its memories (hs_rtl_strike). */
void *hs_rtl_top_model(hs_rtl_top *top);

#ifdef __cplusplus
}
#endif
#endif
