/* SPDX-License-Identifier: Apache-2.0
 *
 * When guard works: rtl/guard.sv with fetch, gather, fold and scatter.
 */
#include "model_parts.h"

/* What is beyond the memories is not written; its number has no more bits than theirs. */
static void log_new(hs_model *m, hs_time t, const hs_state *s, uint32_t f) {
    if (!m->log || s->number[f] >= m->config.capacity.vertices) return;
    uint32_t word[4];
    for (int k = 0; k < 4; k++)
        word[k] = (uint32_t)s->point[f][k];
    hs_log_add(m->log, HS_PROBE_guard_new, t, s->number[f], word);
}

hs_time hs_cycles_guard(hs_model *m, const hs_state *s, hs_time kick) {
    hs_window *read = &m->read, *write = &m->write;
    hs_queue *fold = &m->items;
    hs_front front = hs_front_start(m, read, write, fold, kick);
    hs_time out = 0;
    uint32_t item = 0, number = s->vertices;
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t count = s->generation ? 1 : hs_face_sides(s, f), first = item;
        const bool refined = s->decision[f] & FACE_REFINED;
        const bool selected = s->decision[f] & FACE_SELECTED;
        hs_time verdict = 0;
        for (uint32_t i = 0; i < count; i++, item++) {
            verdict = hs_front_take(m, &front, read, fold, s, item, HS_PROBE_guard_in);
            hs_queue_in(fold, verdict);
        }
        if (refined) log_new(m, verdict, s, f);
        for (uint32_t i = 0; i < count; i++) {
            out = hs_scatter_wait(write, hs_later(verdict, out) + 1);
            hs_queue_out(fold, out);
            hs_scatter(write, out, hs_item_origins(s, first + i),
                       refined ? 0 : hs_item_lanes(s, first + i));
            hs_log_words(m, HS_PROBE_guard_out, out, first + i, refined, selected,
                         number & (m->config.capacity.vertices - 1), 0);
        }
        number += refined;
    }
    const hs_time last = front.busy ? hs_later(out, write->last) : kick;
    hs_account(m, HS_STAGE_guard, kick, last, front.busy, front.blocked);
    m->traffic.read += front.busy * (hs_record_bits(s) + HS_POINT_WORD + 1) + read->served;
    m->traffic.written += write->served + front.busy * 2 * HS_VERDICT_WORD +
                          (uint64_t)(number - s->vertices) * HS_BIRTH_WORDS;
    m->report->conflicts += read->own.count + write->own.count;
    return hs_later(kick, last) + 1;
}
