/* SPDX-License-Identifier: Apache-2.0
 *
 * The cycle-level model: what golden sends, and when the RTL would send it. Not a clock that ticks:
 * every item's time at every stage boundary follows from the times of the items before it
 * (docs/timing.md has the recurrences), and is exact, so that a view costs little more than its
 * refinement by golden. The comparison of all transactions with the RTL's keeps it honest.
 */
#ifndef HS_MODEL_H
#define HS_MODEL_H

#include "cycles.h"
#include "golden.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The micro-architecture. Each is a parameter of rtl/halfstep.sv as well. */
typedef struct hs_model_config {
    uint32_t bank_bits;    /* banks of the memories, as a power of two: 1 to 4 */
    uint32_t window_bits;  /* items that compete for banks, as a power of two: 1 to 5 */
    uint32_t port_records; /* records of 128 bits in a beat: 1, 2 or 4 */
} hs_model_config;

#define HS_DEFAULT_CONFIG ((hs_model_config){.bank_bits = 3, .window_bits = 3, .port_records = 4})

typedef struct hs_model hs_model;

/* NULL and *err (HS_EXIT_USAGE) if a number of the configuration is out of range. */
hs_model *hs_model_new(hs_limits limits, hs_model_config config, hs_error *err);
void hs_model_free(hs_model *model);

/* Runs one view, as hs_golden_run does; what it costs is in *cycles, as hs_rtl_run tells it. The
 * pipeline is at rest when the first beat is offered. Transactions go to *log unless it is NULL:
 * that costs time. False only when memory is exhausted. */
bool hs_model_run(hs_model *model, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                  hs_golden_report *report, hs_cycle_report *cycles, hs_log *log, hs_error *err);

/* As hs_rtl_word_cycle: when a word of the last run's output was taken. */
uint64_t hs_model_word_cycle(const hs_model *model, size_t word);

#ifdef __cplusplus
}
#endif
#endif
