/* SPDX-License-Identifier: Apache-2.0
 *
 * The Verilated RTL behind a C interface: packets in, packets out, cycles. One binary serves all
 * meshes, views, depths and stalls.
 */
#ifndef HS_RTL_H
#define HS_RTL_H

#include "golden.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Stalls on either side, per cycle, from a seeded generator; 0 and 0: none. */
typedef struct hs_stalls {
    uint32_t seed;
    uint8_t input, output; /* per cent of the cycles in which the side pauses, 0 to 95 */
} hs_stalls;

/* What one view cost. Counters are differences over the view. */
typedef struct hs_rtl_report {
    uint64_t begin;      /* cycle from which hs_rtl_word_cycle and waveforms count */
    uint64_t start, end; /* cycle of the first beat in, of the last beat out (TLAST) */
    uint64_t first_out;  /* cycle of the first beat out */
    uint64_t cycles;     /* end - start + 1 */
    uint64_t activity[HS_STAGES][HS_ACTIVITIES];
    uint64_t items_in[HS_STAGES], items_out[HS_STAGES];
    uint64_t conflicts;
} hs_rtl_report;

typedef struct hs_rtl hs_rtl;

/* Builds the simulation, resets it, writes the run-time limits. seed randomizes the initial
 * contents of registers and memories. NULL and *err if a limit exceeds the RTL's capacity. */
hs_rtl *hs_rtl_new(hs_limits limits, uint32_t seed, hs_error *err);
void hs_rtl_free(hs_rtl *rtl);

/* Opens (path) or closes (NULL) an FST waveform; it records the cycles from first to last. */
bool hs_rtl_trace(hs_rtl *rtl, const char *path, uint64_t first, uint64_t last, hs_error *err);

/* Streams one packet in, and everything up to TLAST out. False (HS_EXIT_INTERNAL) if the pipeline
 * breaks a handshake rule, a counter's sum is not the cycles, or it does not answer within a bound
 * derived from the packet. */
bool hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                hs_rtl_report *report, hs_error *err);

/* Cycles simulated since hs_rtl_new. */
uint64_t hs_rtl_cycle(const hs_rtl *rtl);

/* The cycle, from the start of the last hs_rtl_run, in which a word of its output was taken;
 * UINT64_MAX if it did not send so many. */
uint64_t hs_rtl_word_cycle(const hs_rtl *rtl, size_t word);

#ifdef __cplusplus
}
#endif
#endif
