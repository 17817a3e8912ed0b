/* SPDX-License-Identifier: Apache-2.0
 *
 * What the files of sim/rtl*.c share: the driver of the Verilated pipeline. rtl_pins.h is below it,
 * rtl.h above.
 */
#ifndef HS_RTL_PARTS_H
#define HS_RTL_PARTS_H

#include "rtl.h"
#include "rtl_pins.h"

enum {
    RTL_IN = HS_ACTIVITIES, /* a stage's counters: its activities, then its items */
    RTL_OUT,
    RTL_COUNTERS
};

/* One access to the registers at a time, over AXI4-Lite. The slave sees it from its start on. */
typedef struct rtl_access {
    bool reading, writing, address_open, data_open; /* open: not yet taken */
    uint32_t address, data, response;
    uint64_t when; /* cycle in which a read's address was taken */
} rtl_access;

static inline bool rtl_access_ended(const rtl_access *access) {
    return !access->reading && !access->writing;
}

static inline void rtl_access_read(rtl_access *access, uint32_t address) {
    access->reading = access->address_open = true;
    access->address = address;
}

static inline void rtl_access_write(rtl_access *access, uint32_t address, uint32_t value) {
    access->writing = access->address_open = access->data_open = true;
    access->address = address;
    access->data = value;
}

/* The counters, and the fate of the last view, read while no stage works. */
typedef struct rtl_counters {
    uint64_t when; /* cycle to which they refer */
    uint32_t cycles, conflicts, views;
    uint32_t status, position; /* of the view that ended last */
    uint32_t stage[HS_STAGES][RTL_COUNTERS];
} rtl_counters;

struct hs_rtl {
    hs_rtl_top *top;
    hs_pins pins;
    uint64_t cycle; /* since hs_rtl_new */
    uint64_t begin; /* of the last run */
    uint64_t limit; /* of a run's cycles */
    hs_limits limits, capacity;
    uint32_t architecture;
    rtl_access bus;
    rtl_counters before;  /* the last run */
    uint32_t *beat_cycle; /* of the last run: when each beat was taken, counted from its begin */
    size_t beats, beats_held;
    bool broken; /* the last run failed: reset before the next */
    hs_log *log;
    hs_log *logs; /* of hs_rtl_stream: one a pipeline */
    hs_rtl_strike *strike;
    void *strike_context;
};

/* --- rtl.c ------------------------------------------------------------------------------------ */

/* The halves of a cycle (rtl_pins.h), with the bus access that is under way. */
bool rtl_settle(hs_rtl *rtl, hs_error *err);
bool rtl_edge(hs_rtl *rtl, hs_error *err);

/* While the streams rest. */
bool rtl_read_register(hs_rtl *rtl, uint32_t address, uint32_t *value, hs_error *err);
bool rtl_read_counters(hs_rtl *rtl, rtl_counters *counters, hs_error *err);
uint32_t rtl_counter_address(uint32_t stage, uint32_t counter);

/* The beginning of a run: resets the pipeline if the last one failed. The run counts as failed
 * until rtl_end. */
bool rtl_begin(hs_rtl *rtl, hs_error *err);
void rtl_end(hs_rtl *rtl);

/* --- rtl_life.c ------------------------------------------------------------------------------- */

/* Cycles that a view takes at most, and between two signs of life. */
uint64_t rtl_most_cycles(const hs_rtl *rtl, const hs_packet *in, hs_stalls stalls);
uint64_t rtl_most_silence(const hs_rtl *rtl);

/* Looks at the stages' items, one bus access after the other, while nothing goes in or out. */
typedef struct rtl_life {
    uint64_t moved; /* cycle of the last sign of life */
    uint32_t next;
    bool polling, changed;
    uint32_t items[HS_STAGES][2];
} rtl_life;

void rtl_life_look(rtl_life *life, hs_rtl *rtl);

/* "; held: classify 3, split 1": the stages that have taken more items than they gave. */
typedef struct rtl_held {
    char text[400];
} rtl_held;
rtl_held rtl_life_held(const rtl_life *life);

/* --- rtl_beats.c ------------------------------------------------------------------------------ */

/* A packet on its way into the pipeline, a beat after the other. */
typedef struct rtl_sender {
    hs_pauses pauses;
    size_t at; /* words sent */
    bool offered;
} rtl_sender;

/* Puts the packet's next beat on the input, unless there is a pause. True if it is the first one's
 * first cycle. */
bool rtl_offer(rtl_sender *sender, hs_rtl *rtl, const hs_packet *in);

/* After rtl_settle: whether the beat is taken at the coming edge. */
bool rtl_sent(rtl_sender *sender, const hs_rtl *rtl);

/* False, with the rule in *err, if what the output shows is no beat of the output format or is not
 * what it showed before and nobody took. *shown: the beat that still stands, from call to call. */
bool rtl_check_beat(const hs_rtl *rtl, const hs_packet *in, hs_axis *shown, hs_error *err);
bool rtl_break_of_rule(const hs_rtl *rtl, const hs_packet *in, const char *what, hs_error *err);

/* Appends the beat that is taken at the coming edge. */
bool rtl_take_beat(const hs_rtl *rtl, hs_packet *out, hs_error *err);

/* Behind a view: nothing may come any more, the pipeline comes to rest. */
bool rtl_rest(hs_rtl *rtl, const hs_packet *in, hs_error *err);

#endif
