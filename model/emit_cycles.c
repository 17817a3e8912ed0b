/* SPDX-License-Identifier: Apache-2.0
 *
 * When emit works: rtl/emit.sv with vertex_records, face_records and pack.
 *
 *   op -> next -> this (its records are made) -> records -> pack: rest, rows -> beat -> m_axis
 */
#include <stdlib.h>
#include <string.h>

#include "model_parts.h"

enum { ROWS = 2, ROW_RECORDS = 4, GROUP_VERTICES = 4 };

/* --- The output's pauses ------------------------------------------------------------------------
 */

void hs_output_start(hs_output_port *o, hs_stalls stalls) {
    o->pauses = hs_pauses_start(stalls.seed, HS_PAUSES_OUTPUT, stalls.output);
    o->known = 0;
    o->exhausted = false;
}

hs_time hs_output_ready(hs_output_port *o, hs_time t) {
    if (o->pauses.percent == 0) return t;
    for (;; t++) {
        while (o->known <= t) {
            const size_t word = o->known / 64;
            if (word >= o->room) {
                const size_t room = o->room ? 2 * o->room : 1024;
                uint64_t *more = realloc(o->ready, room * sizeof *more);
                if (!more) {
                    o->exhausted = true;
                    return t;
                }
                o->ready = more;
                o->room = room;
            }
            const uint64_t bit = UINT64_C(1) << o->known % 64;
            if (o->known % 64 == 0) o->ready[word] = 0;
            if (!hs_pauses_next(&o->pauses)) o->ready[word] |= bit;
            o->known++;
        }
        if (o->ready[t / 64] >> t % 64 & 1) return t;
    }
}

/* --- pack ---------------------------------------------------------------------------------------
 */

static void note_beat(hs_emit_cycles *e, hs_time t) {
    if (e->beats == e->beat_room) {
        const size_t room = e->beat_room ? 2 * e->beat_room : 4096;
        uint32_t *more = realloc(e->beat_cycle, room * sizeof *more);
        if (!more) {
            e->exhausted = true;
            return;
        }
        e->beat_cycle = more;
        e->beat_room = room;
    }
    e->beat_cycle[e->beats++] = (uint32_t)t;
    if (e->beats == 1) e->first_out = t;
}

/* The first cycle from t on in which the queue of rows has room. */
static hs_time row_room(const hs_emit_cycles *e, hs_time t) {
    return e->rows < ROWS ? t : hs_later(t, e->row_left[e->rows % ROWS] + 1);
}

/* A row of records enters the queue in cycle t, and is cut into beats. */
static void push_row(hs_model *m, hs_time t, uint32_t records) {
    hs_emit_cycles *e = &m->emit;
    for (uint32_t at = 0; at < records; at += m->config.port) {
        /* A beat is loaded when the one before it was, or is being, taken. */
        e->beat_loaded = hs_later(hs_later(t, e->beat_loaded) + 1, e->beat_taken);
        e->beat_taken = e->port ? hs_output_ready(e->port, e->beat_loaded + 1)
                                : e->take_beat(e->context, e->beat_loaded + 1);
        note_beat(e, e->beat_taken);
    }
    e->row_left[e->rows++ % ROWS] = e->beat_loaded;
}

/* Records that are offered from cycle t on: the cycle in which pack takes them. */
static hs_time pack(hs_model *m, hs_time t, uint32_t count, bool last) {
    hs_emit_cycles *e = &m->emit;
    t = row_room(e, t);
    hs_log_words(m, HS_PROBE_records, t, 0, count, last, 0, 0);
    e->rest += count;
    if (e->rest >= ROW_RECORDS) {
        push_row(m, t, ROW_RECORDS);
        e->rest -= ROW_RECORDS;
        if (!last || !e->rest) return t;
        push_row(m, row_room(e, t + 1), e->rest); /* the end spills into one more row */
    } else if (last) {
        push_row(m, t, e->rest);
    }
    if (last) e->rest = 0;
    return t;
}

/* --- Records ------------------------------------------------------------------------------------
 */

/* Whether the pending vertex can tell what becomes of it only from what comes next. */
static bool looks_ahead(const hs_emit_cycles *e) {
    return e->kind == HS_OP_VERTEX && e->grouped != GROUP_VERTICES - 1;
}

/* How many records the pending op makes; next: the op behind it, NULL behind the trailer. */
static uint32_t records_of(hs_emit_cycles *e, const hs_op *next) {
    const bool joined = next && next->kind == HS_OP_VERTEX && next->generation == e->generation;
    uint32_t count;
    switch (e->kind) {
    case HS_OP_HEADER:
        return 1;
    case HS_OP_VERTEX:
        if (e->grouped == GROUP_VERTICES - 1) {
            e->grouped = 0;
            return 1;
        }
        count = !joined || e->grouped == 2 ? 2 + e->grouped : 0;
        e->grouped = joined ? e->grouped + 1 : 0;
        return count;
    case HS_OP_FACES:
        return (uint32_t)__builtin_popcount(e->mask);
    case HS_OP_CORNER: /* mask: 1 with the first corner, 2 with the last one */
        if (e->mask & 1) e->corners = 0;
        count = e->mask & 2 || e->corners == 3;
        e->corners = count ? 0 : e->corners + 1;
        return count;
    case HS_OP_GROUP:
        return ROW_RECORDS;
    default:
        return 2;
    }
}

static void hand_over(hs_model *m, uint32_t count, bool last) {
    hs_emit_cycles *e = &m->emit;
    if (count) e->handed = pack(m, e->made + 1, count, last);
}

/* Makes the records of the pending op; next was taken in cycle t. */
static void make_records(hs_model *m, const hs_op *next, hs_time t) {
    hs_emit_cycles *e = &m->emit;
    if (!e->pending) return;
    const bool group = e->kind == HS_OP_GROUP;
    e->made = hs_later(e->moved + 1, e->handed);
    if (e->carried == ROW_RECORDS || (e->carried && !group)) {
        hand_over(m, e->carried, false);
        e->carried = 0;
        e->made = hs_later(e->made + 1, e->handed);
    }
    if (looks_ahead(e)) e->made = hs_later(e->made, t + 1);
    const uint32_t count = records_of(e, next);
    e->carried += group;
    hand_over(m, count, e->kind == HS_OP_TRAILER);
}

/* --- Ops ----------------------------------------------------------------------------------------
 */

void hs_emit_begin(hs_model *m) {
    hs_emit_cycles *e = &m->emit;
    *e = (hs_emit_cycles){.port = e->port,
                          .take_beat = e->take_beat,
                          .context = e->context,
                          .beat_cycle = e->beat_cycle,
                          .beat_room = e->beat_room};
}

static void count_items(hs_emit_cycles *e, const hs_op *op) {
    if (op->kind == HS_OP_VERTEX) e->vertices++;
    if (op->kind == HS_OP_GROUP) e->vertices += GROUP_VERTICES;
    if (op->kind == HS_OP_FACES) e->faces += (uint32_t)__builtin_popcount(op->mask);
    if (op->kind == HS_OP_CORNER) e->faces += op->last;
}

hs_time hs_emit_op(hs_model *m, hs_time t, const hs_op *op) {
    hs_emit_cycles *e = &m->emit;
    const hs_time taken = e->ops ? hs_later(t, e->moved) : t;
    hs_log_words(m, HS_PROBE_op, taken, op->number, op->kind,
                 op->kind == HS_OP_FACES ? op->mask : 0, 0, 0);
    if (e->ops == 0) e->begin = taken;
    e->ops++;
    e->blocked += taken - t;
    count_items(e, op);
    make_records(m, op, taken);
    e->moved = hs_later(taken + 1, e->made);
    e->kind = op->kind;
    e->generation = op->generation;
    e->mask = op->kind == HS_OP_CORNER ? (uint32_t)op->first | (uint32_t)op->last << 1 : op->mask;
    e->pending = true;
    return taken;
}

hs_time hs_emit_end(hs_model *m) {
    hs_emit_cycles *e = &m->emit;
    make_records(m, NULL, 0);
    hs_cycle_report *r = m->report;
    uint64_t *activity = r->activity[HS_STAGE_emit];
    activity[HS_ACTIVITY_busy] = e->ops;
    activity[HS_ACTIVITY_blocked] = e->blocked;
    /* At work from behind the header op to the last beat. */
    activity[HS_ACTIVITY_starved] = e->beat_taken - e->begin - (e->ops - 1 + e->blocked);
    r->items_in[HS_STAGE_emit] = r->items_out[HS_STAGE_emit] = e->vertices + e->faces;
    r->first_out = e->first_out;
    r->end = e->beat_taken;
    return e->beat_taken + 1;
}
