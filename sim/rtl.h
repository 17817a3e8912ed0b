/* SPDX-License-Identifier: Apache-2.0
 *
 * The Verilated RTL behind a C interface: packets in, packets out, cycles. One binary serves all
 * meshes, views, depths and stalls.
 */
#ifndef HS_RTL_H
#define HS_RTL_H

#include "cycles.h"
#include "golden.h"
#include "model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hs_rtl hs_rtl;

/* Builds the simulation, resets it, writes the run-time limits. seed randomizes the initial
 * contents of registers and memories. NULL and *err if a limit exceeds the RTL's capacity. */
hs_rtl *hs_rtl_new(hs_limits limits, uint32_t seed, hs_error *err);
void hs_rtl_free(hs_rtl *rtl);

/* Other limits, for the views that follow. False (HS_EXIT_USAGE), the limits as they were, if one
 * exceeds the RTL's capacity. */
bool hs_rtl_limit(hs_rtl *rtl, hs_limits limits, hs_error *err);

/* Opens (path) or closes (NULL) an FST waveform; it records the cycles from first to last. */
bool hs_rtl_trace(hs_rtl *rtl, const char *path, uint64_t first, uint64_t last, hs_error *err);

/* Streams one packet in, and everything up to TLAST out. False (HS_EXIT_INTERNAL) if the pipeline
 * breaks a handshake rule, a counter's sum is not the cycles, its registers tell of another fate of
 * the view than its trailer, or it does not answer within a bound derived from the packet. */
bool hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                hs_cycle_report *report, hs_error *err);

/* Streams `count` packets in, one behind the other, and all answers out, which may interleave if
 * several views are in flight: out[i] is in[i]'s. Their views' numbers must differ in their low 16
 * bits. view[i], *cycles: as hs_flight_run's. The pipeline is at rest before. False as hs_rtl_run,
 * but that of the registers the count of views alone is looked at. Logs go to the array of
 * hs_rtl_logs, a log a pipeline. */
bool hs_rtl_stream(hs_rtl *rtl, const hs_packet *in, uint32_t count, hs_stalls stalls,
                   hs_packet *out, hs_flight_view *view, uint64_t *cycles, hs_error *err);
void hs_rtl_logs(hs_rtl *rtl, hs_log *logs);

/* Has later runs write all their transactions to *log, which each clears first; NULL: none. */
void hs_rtl_log(hs_rtl *rtl, hs_log *log);

/* For the injection of faults: later runs call `strike` before every clock's edge, with the
 * Verilated model (Vhalfstep) and the cycle from the start of the run. The RTL's
 * assertions are off then: they hold for memories that keep what they are given. NULL: none. */
typedef void hs_rtl_strike(void *context, void *top, uint64_t cycle);
void hs_rtl_on_cycle(hs_rtl *rtl, hs_rtl_strike *strike, void *context);

/* Has later runs fail that take more cycles than this; UINT64_MAX, as at first: more than the bound
 * that is derived from their packets. */
void hs_rtl_cycle_limit(hs_rtl *rtl, uint64_t cycles);

/* The RTL's parameters, as its register ARCHITECTURE gives them. */
uint32_t hs_rtl_architecture(const hs_rtl *rtl);

/* What its memories hold, as its registers give it. */
hs_limits hs_rtl_capacity(const hs_rtl *rtl);

/* The configuration of a model that is this RTL's twin. */
static inline hs_model_config hs_rtl_config(const hs_rtl *rtl) {
    hs_model_config config = hs_model_config_decode(hs_rtl_architecture(rtl));
    config.capacity = hs_rtl_capacity(rtl);
    return config;
}

/* Cycles simulated since hs_rtl_new. */
uint64_t hs_rtl_cycle(const hs_rtl *rtl);

/* The cycle, from the start of the last hs_rtl_run, in which a word of its output was taken;
 * HS_NO_CYCLE if it did not send so many. */
uint64_t hs_rtl_word_cycle(const hs_rtl *rtl, size_t word);

#ifdef __cplusplus
}
#endif
#endif
