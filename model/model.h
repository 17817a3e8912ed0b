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
    uint32_t port;    /* records of 128 bits in a beat: 1, 2 or 4 */
    uint32_t banks;   /* of the memories: a power of two, 2 to 16 */
    uint32_t window;  /* items of a stage that compete for banks: a power of two, 2 to 32 */
    uint32_t lanes;   /* words that a stage reads or writes in a cycle, of one memory, at most: a
                         power of two, 1 to 16 */
    uint32_t latency; /* cycles from a request of a window to its word: 1 to 8 */
    uint32_t ops;     /* that wait for emit: a power of two, 16 to 256 */
    uint32_t views;   /* in flight, each in a pipeline of its own: 1 to 8 (hs_flight) */
    uint32_t parity;  /* 1: memories and FIFOs have a bit more a word; costs no cycle */
    /* Vertices and active quads that the memories hold: powers of two, 8 to 2^24. A limit of
     * vertices above the first enlarges it; on the second no run depends. */
    hs_limits capacity;
} hs_model_config;

#define HS_DEFAULT_CONFIG                                                                          \
    ((hs_model_config){.port = 4,                                                                  \
                       .banks = 8,                                                                 \
                       .window = 8,                                                                \
                       .lanes = 8,                                                                 \
                       .latency = 1,                                                               \
                       .ops = 16,                                                                  \
                       .views = 1,                                                                 \
                       .parity = 1,                                                                \
                       .capacity = HS_DEFAULT_LIMITS})

/* What the register ARCHITECTURE says, with the default capacity: registers of their own tell
 * another. */
hs_model_config hs_model_config_decode(uint32_t architecture);

/* HS_EXIT_USAGE, with the parameter, its value and what it may be, if one is out of range. */
bool hs_model_config_good(const hs_model_config *config, hs_error *err);

/* Bits of all memories, windows and FIFOs of all pipelines; numbers of vertices and quads are as
 * wide as the default capacity needs them. */
uint64_t hs_model_memory_bits(const hs_model_config *config);

/* Bits that a view read from the memories and wrote to them. */
typedef struct hs_model_traffic {
    uint64_t read, written;
} hs_model_traffic;

typedef struct hs_model hs_model;

/* NULL and *err (HS_EXIT_USAGE) if a number of the configuration is out of range. */
hs_model *hs_model_new(hs_limits limits, hs_model_config config, hs_error *err);
void hs_model_free(hs_model *model);

/* Runs one view, as hs_golden_run does; what it costs is in *cycles, as hs_rtl_run tells it. The
 * pipeline is at rest when the first beat is offered. Transactions go to *log unless it is NULL:
 * that costs time. False only when memory is exhausted. */
bool hs_model_run(hs_model *model, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                  hs_golden_report *report, hs_cycle_report *cycles, hs_log *log, hs_error *err);

/* Of the last run. */
hs_model_traffic hs_model_traffic_of(const hs_model *model);

/* As hs_rtl_word_cycle: when a word of the last run's output was taken. */
uint64_t hs_model_word_cycle(const hs_model *model, size_t word);

/* Cycles from the first beat in until the sequencer turned to a generation of the last run, 0 to
 * the last one reached; HS_NO_CYCLE: it did not reach that one. */
uint64_t hs_model_generation_cycle(const hs_model *model, uint32_t generation);

/* --- Views in flight ----------------------------------------------------------------------------
 *
 * config.views pipelines behind one input and before one output, as rtl/halfstep.sv has them.
 */
typedef struct hs_flight hs_flight;

/* When a view's first beat was offered and its last one out, from the start of the stream. */
typedef struct hs_flight_view {
    uint64_t start, end;
    uint32_t pipeline;
} hs_flight_view;

hs_flight *hs_flight_new(hs_limits limits, hs_model_config config, hs_error *err);
void hs_flight_free(hs_flight *flight);

/* Calls done(context, view, model, cycles) whenever a view is complete: view counts the packets
 * from 0; the model is the pipeline that it was in, whose traffic and words' cycles are the view's
 * until done returns; cycles are told as hs_model_run tells them, at the pipeline's ports: of
 * several in flight, collect adds a cycle to each beat. done may free the packet's answer. */
typedef void hs_flight_observer(void *context, uint32_t view, const hs_model *model,
                                const hs_cycle_report *cycles);
void hs_flight_observe(hs_flight *flight, hs_flight_observer *done, void *context);

/* Streams `count` packets in, one behind the other, and their answers out. log: one for each
 * pipeline, or NULL. *cycles: from the first beat offered to the last one out. */
bool hs_flight_run(hs_flight *flight, const hs_packet *in, uint32_t count, hs_stalls stalls,
                   hs_packet *out, hs_golden_report *report, hs_flight_view *view, uint64_t *cycles,
                   hs_log *log, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
