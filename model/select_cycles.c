/* SPDX-License-Identifier: Apache-2.0
 *
 * When select works: rtl/select.sv with fetch, gather, fold and scatter.
 */
#include "model_parts.h"

hs_time hs_cycles_select(hs_model *m, const hs_state *s, hs_time kick) {
    hs_window *read = &m->read, *write = &m->write;
    hs_queue *fold = &m->items;
    hs_front front = hs_front_start(m, read, write, fold, kick);
    hs_time out = 0;
    uint32_t item = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t count = s->generation ? 1 : hs_face_sides(s, f), first = item;
        const bool selected = s->decision[f] & FACE_SELECTED;
        hs_time verdict = 0;
        for (uint32_t i = 0; i < count; i++, item++) {
            verdict = hs_front_take(m, &front, read, fold, s, item, HS_PROBE_select_in);
            hs_queue_in(fold, verdict);
        }
        hs_log_words(m, HS_PROBE_select_face, verdict, f, selected, 0, 0, 0);
        for (uint32_t i = 0; i < count; i++) {
            out = hs_scatter_wait(write, hs_later(verdict, out) + 1);
            hs_queue_out(fold, out);
            hs_scatter(write, out, hs_item_origins(s, first + i),
                       selected ? hs_item_lanes(s, first + i) : 0);
            hs_log_words(m, HS_PROBE_select_out, out, first + i, selected, 0, 0, 0);
        }
    }
    const hs_time last = front.busy ? hs_later(out, write->last) : kick;
    hs_account(m, HS_STAGE_select, kick, last, front.busy, front.blocked);
    m->traffic.read +=
        front.busy * (hs_record_bits(s) + HS_POINT_WORD) + read->served * HS_MARK_WORD;
    m->traffic.written += write->served + s->faces;
    m->report->conflicts += read->own.count + write->own.count;
    return hs_later(kick, last) + 1;
}
