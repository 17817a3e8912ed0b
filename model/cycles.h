/* SPDX-License-Identifier: Apache-2.0
 *
 * What simulations of the pipeline have in common, be they the Verilated RTL (sim/rtl.h) or the
 * cycle-level model (model/model.h): stalls on the streams, what a view cost, and the log of every
 * transaction, by which the two are compared.
 */
#ifndef HS_CYCLES_H
#define HS_CYCLES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "definitions.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- Stalls -------------------------------------------------------------------------------------
 */

/* Stalls on either side, per cycle, from a seeded generator; 0 and 0: none. */
typedef struct hs_stalls {
    uint32_t seed;
    uint8_t input, output; /* per cent of the cycles in which the side pauses, 0 to 95 */
} hs_stalls;

/* The generator of one side's pauses: asked once for every cycle. */
typedef struct hs_pauses {
    uint64_t state;
    uint32_t percent;
} hs_pauses;

enum { HS_PAUSES_INPUT = 1, HS_PAUSES_OUTPUT = 2 };
static inline hs_pauses hs_pauses_start(uint32_t seed, uint32_t side, uint32_t percent) {
    const hs_pauses pauses = {((uint64_t)seed << 8 | side) * 0x9e3779b97f4a7c15u | 1,
                              percent < 95 ? percent : 95};
    return pauses;
}

/* xorshift64, its upper half as a fraction of 100. */
static inline bool hs_pauses_next(hs_pauses *pauses) {
    if (pauses->percent == 0) return false;
    pauses->state ^= pauses->state << 13;
    pauses->state ^= pauses->state >> 7;
    pauses->state ^= pauses->state << 17;
    return (pauses->state >> 32) * 100 >> 32 < pauses->percent;
}

/* --- What one view cost -------------------------------------------------------------------------
 */

/* Where a cycle or a latency is told, but there is none. */
#define HS_NO_CYCLE UINT64_MAX

/* Counters are differences over the view. */
typedef struct hs_cycle_report {
    uint64_t begin;      /* cycle from which words, transactions and waveforms count */
    uint64_t start, end; /* cycle of the first beat in, of the last beat out (TLAST) */
    uint64_t first_out;  /* cycle of the first beat out */
    uint64_t cycles;     /* end - start + 1 */
    uint64_t activity[HS_STAGES][HS_ACTIVITIES];
    uint64_t items_in[HS_STAGES], items_out[HS_STAGES];
    uint64_t conflicts;
} hs_cycle_report;

/* --- Transactions -------------------------------------------------------------------------------
 */

/* One item that passed a stage boundary (definitions.def, PROBE): when, which one, what it was. */
typedef struct hs_transaction {
    uint64_t cycle; /* from the report's begin */
    uint32_t item;  /* its number, as the boundary has it */
    uint32_t word[4];
} hs_transaction;

/* All transactions of a view, boundary by boundary, each in the order of time. */
typedef struct hs_log {
    struct {
        hs_transaction *transaction;
        size_t count, room;
    } probe[HS_PROBES];
    bool exhausted; /* memory: what came later is not in it */
} hs_log;

void hs_log_clear(hs_log *log); /* keeps the memory */
void hs_log_free(hs_log *log);
void hs_log_add(hs_log *log, uint32_t probe, uint64_t cycle, uint32_t item, const uint32_t word[4]);

/* What the model does not know of a packet that it refuses, for hs_log_compare: data behind
 * receive. */
#define HS_LOG_DATA_OF_REFUSED                                                                     \
    (UINT64_C(1) << HS_PROBE_clip | UINT64_C(1) << HS_PROBE_quantized |                            \
     UINT64_C(1) << HS_PROBE_corner_in | UINT64_C(1) << HS_PROBE_classify_in |                     \
     UINT64_C(1) << HS_PROBE_classify_face | UINT64_C(1) << HS_PROBE_classify_out)

/* Two logs of one view compared. */
typedef struct hs_log_comparison {
    uint64_t compared;  /* transactions, of all boundaries */
    uint64_t different; /* in cycle, item or words, or only in one log */
    uint32_t probe;     /* of the earliest difference */
    uint64_t cycle;     /* and the earlier of its two cycles */
    char text[400];     /* it, in words: boundary, item, both cycles, both payloads */
} hs_log_comparison;
/* Leaves out the boundaries in `skip`, bits 1 << probe. */
hs_log_comparison hs_log_compare(const hs_log *a, const char *a_name, const hs_log *b,
                                 const char *b_name, uint64_t skip);

/* Compares all counters and the cycles: HS_REPORT_COUNTERS numbers. False, with the first
 * difference in words. */
enum { HS_REPORT_COUNTERS = HS_STAGES * (HS_ACTIVITIES + 2) + 4 };
bool hs_cycle_report_equal(const hs_cycle_report *a, const hs_cycle_report *b, char *text,
                           size_t size);

#ifdef __cplusplus
}
#endif
#endif
