/* SPDX-License-Identifier: Apache-2.0
 *
 * When receive, transform and quantize work: rtl/unpack.sv, receive.sv, transform.sv, quantize.sv,
 * and the sequencer's wait for all three.
 *
 *   beat -> record, one a cycle -> vertex -> transform -> position
 *                               '> corner                     '-> quantize, when all are there
 */
#include <string.h>

#include "model_parts.h"

enum {
    TRANSFORM = 9, /* from a vertex to its place in clip space */
    QUANTIZE = 2,  /* from a read to its write */
    FIRST_VERTEX = HS_HEADER_RECORDS + HS_MATRIX_RECORDS
};

/* The packet as it comes in. */
typedef struct arrival {
    hs_model *m;
    const hs_state *s;
    size_t records, stored; /* of the packet; before the first that is wrong */
    hs_time overflow;       /* nothing is stored behind this cycle */
    hs_time start, first;   /* the first beat is offered, the first record is there */
    hs_time end;            /* the packet's last cycle in unpack */
    hs_time last_vertex;    /* it goes to transform; 0: none did */
    bool all_vertices;
    uint64_t vertices, starved; /* transform's */
} arrival;

static uint32_t word_of(const arrival *a, size_t record, uint32_t k) {
    return a->m->in->word[4 * record + k];
}

static void vertex(arrival *a, hs_time t, size_t record) {
    hs_model *m = a->m;
    const uint32_t v = (uint32_t)(record - FIRST_VERTEX);
    /* transform is active, but has no vertex to take, while others are in flight. */
    if (a->last_vertex) {
        const hs_time flown = a->last_vertex + TRANSFORM + 1;
        a->starved += (t - 1 < flown ? t - 1 : flown) - a->last_vertex;
    }
    a->last_vertex = t;
    a->vertices++;
    if (!m->log) return;
    hs_log_words(m, HS_PROBE_vertex_in, t, v, word_of(a, record, 0), word_of(a, record, 1),
                 word_of(a, record, 2), word_of(a, record, 3));
    uint32_t clip[4];
    memcpy(clip, a->s->clip[v], sizeof clip);
    hs_log_add(m->log, HS_PROBE_clip, t + TRANSFORM, v, clip);
}

static void corner(const arrival *a, hs_time t, size_t record) {
    const hs_state *s = a->s;
    if (!a->m->log) return;
    const uint32_t h = (uint32_t)(record - FIRST_VERTEX) - s->vertices;
    const uint32_t twin = word_of(a, record, 1), face = word_of(a, record, 2);
    const uint32_t sharp = word_of(a, record, 3);
    const bool alone = twin == HS_BORDER, kept = s->settings.boundary == HS_BOUNDARY_KEPT;
    const uint32_t number = face >> 16 & 0xff, sides = face & 0xff;
    const uint32_t flags = (number + 1 == sides ? 8u : 0) | (number == 0 ? 4u : 0) |
                           (alone && !kept ? 2u : 0) | (alone && kept ? 1u : 0);
    hs_log_words(a->m, HS_PROBE_corner_in, t, h, word_of(a, record, 0), alone ? 0 : twin, flags,
                 (sharp >> 4 & 0xf) << 12 | (alone ? 0 : sharp & 0xf) << 8 | (face >> 8 & 0xff));
}

/* Behind a vertex that will overflow others may come until it does, or until one is no number. */
static void look_for_errors(arrival *a, hs_time t, size_t number) {
    if (a->s->status != HS_STATUS_OVERFLOW) return;
    if (number == a->s->error_position / 4) a->overflow = t + 1 + TRANSFORM;
    for (uint32_t k = 0; k < 4; k++)
        if ((word_of(a, number, k) >> 23 & 0xff) == 0xff && number < a->stored) a->stored = number;
}

static void record(arrival *a, hs_time t, size_t number) {
    const hs_state *s = a->s;
    if (number < FIRST_VERTEX) return;
    if (number < FIRST_VERTEX + (size_t)s->vertices) {
        look_for_errors(a, t, number);
        if (number >= a->stored || t > a->overflow) return;
        vertex(a, t + 1, number);
        a->all_vertices = number + 1 == FIRST_VERTEX + (size_t)s->vertices && t < a->overflow;
    } else if (number >= a->stored) {
        return;
    } else if (number < FIRST_VERTEX + (size_t)s->vertices + s->halfedges) {
        corner(a, t + 1, number);
    }
}

/* Takes the packet apart, beat by beat. */
static void arrive(arrival *a) {
    const uint32_t port = a->m->config.port;
    hs_time free = a->m->free, offered = a->m->offered; /* unpack has room; a beat is offered */
    size_t at = 0, beat = 0;
    do {
        const size_t left = a->records - at;
        const uint32_t count = left < port ? (uint32_t)left : port;
        if (at == 0)
            a->start = offered;
        else
            while (hs_pauses_next(a->m->input))
                offered++;
        const hs_time taken = hs_later(offered, free);
        hs_log_words(a->m, HS_PROBE_beat_in, taken, (uint32_t)beat++, count, 0, 0, 0);
        for (uint32_t k = 0; k < count; k++)
            record(a, taken + 1 + k, at + k);
        if (at == 0) a->first = taken + 1;
        free = taken + (count ? count : 1);
        offered = taken + 1;
        a->m->received = taken;
        at += count;
        a->end = free;
    } while (at < a->records);
}

/* Behind an error nothing is stored; but an overflow is found when the vertex leaves transform. */
static size_t stored_records(const hs_state *s, size_t records) {
    if (s->status == HS_STATUS_OK || s->status == HS_STATUS_TRUNCATED ||
        s->status == HS_STATUS_OVERFLOW || s->parsed)
        return records;
    return s->error_position / 4;
}

static void quantized(hs_model *m, const hs_state *s, hs_time kick) {
    if (!m->log || !m->entered) return;
    for (uint32_t v = 0; v < s->vertices; v++) {
        uint32_t word[4];
        for (int k = 0; k < 4; k++)
            word[k] = (uint32_t)s->position[v][k];
        hs_log_add(m->log, HS_PROBE_quantized, kick + 1 + v + QUANTIZE, v, word);
    }
}

hs_time hs_cycles_receive(hs_model *m, const hs_state *s) {
    hs_cycle_report *r = m->report;
    arrival a = {.m = m, .s = s, .records = (m->in->words + 3) / 4, .overflow = UINT64_MAX};
    a.stored = stored_records(s, a.records);
    arrive(&a);
    r->start = a.start;
    r->activity[HS_STAGE_receive][HS_ACTIVITY_busy] = a.records;
    if (a.records)
        r->activity[HS_STAGE_receive][HS_ACTIVITY_starved] = a.end - a.first - (a.records - 1);
    r->items_in[HS_STAGE_receive] = r->items_out[HS_STAGE_receive] = a.records;

    /* Loaded, sharpness cleared; a corner is stored twice, and its vertex' sharpness updated. The
     * twins are checked beside classify. */
    const uint64_t corners = a.records > FIRST_VERTEX + a.vertices ? s->halfedges : 0;
    m->traffic.written += a.vertices * (HS_POSITION_WORD + HS_SHARP_WORD) +
                          corners * (4 * HS_HALF_WORD + HS_SHARP_WORD);
    m->traffic.read += corners * (HS_SHARP_WORD + 2 * HS_HALF_WORD);

    hs_time drained = a.end + 1, quantized_at = 0;
    if (a.last_vertex) {
        /* The magnitude is complete one cycle behind the last vertex. */
        const hs_time flown = a.last_vertex + TRANSFORM + 2;
        drained = hs_later(drained, flown);
        r->activity[HS_STAGE_transform][HS_ACTIVITY_busy] = a.vertices;
        r->activity[HS_STAGE_transform][HS_ACTIVITY_starved] = a.starved + TRANSFORM + 1;
        r->items_in[HS_STAGE_transform] = r->items_out[HS_STAGE_transform] = a.vertices;
        if (a.all_vertices) {
            quantized(m, s, flown);
            quantized_at = flown + s->vertices + QUANTIZE + 1;
            m->traffic.read += (uint64_t)s->vertices * HS_POSITION_WORD;
            m->traffic.written += (uint64_t)s->vertices * (HS_BIRTH_WORDS - HS_SHARP_WORD);
            r->activity[HS_STAGE_quantize][HS_ACTIVITY_busy] = s->vertices;
            r->activity[HS_STAGE_quantize][HS_ACTIVITY_starved] = QUANTIZE;
            r->items_in[HS_STAGE_quantize] = r->items_out[HS_STAGE_quantize] = s->vertices;
        }
    }
    /* done_o behind the drain, then the sequencer's register. */
    return hs_later(drained + 2, quantized_at);
}
