/* SPDX-License-Identifier: Apache-2.0
 *
 * When classify works: rtl/classify.sv with fetch, gather, face_geometry, contributions and
 * accumulate.
 *
 *   fetch -> gather (read) -> v -> fold (items) -> at work -> accumulate's scatter (write)
 *                             '-> face's result, 5 cycles behind its last item --^
 */
#include "model_parts.h"

enum { CHECK_BEHIND = 3 }; /* check_twins: cycles behind its last corner */

void hs_log_face(hs_model *m, hs_time t, const hs_state *s, uint32_t f) {
    if (!m->log) return;
    uint32_t word[4];
    for (int k = 0; k < 4; k++)
        word[k] = (uint32_t)s->point[f][k];
    const uint32_t item = f | (s->face_mark[f] & MARK_FRONT ? 1u << 30 : 0) |
                          (s->face_mark[f] & MARK_STOP ? 1u << 31 : 0);
    hs_log_add(m->log, HS_PROBE_classify_face, t, item, word);
}

/* One side of an item is on the border of the active mesh: its ends are marked. */
static bool on_border(const hs_state *s, uint32_t f, uint32_t i, uint32_t sides) {
    const uint32_t h0 = hs_face_first(s, f), prior = i ? i - 1 : sides - 1;
    return s->twin[h0 + i] == HS_BORDER || s->twin[h0 + prior] == HS_BORDER;
}

void hs_log_contribution(hs_model *m, hs_time t, const hs_state *s, uint32_t f, uint32_t item,
                         uint32_t lanes) {
    if (!m->log) return;
    const uint32_t sides = hs_face_sides(s, f), first = hs_face_first(s, f);
    uint32_t marks = 0;
    for (uint32_t i = 0; i < HS_LANES; i++)
        if (lanes >> i & 1) {
            const uint32_t corner = s->generation ? i : item - first;
            marks |= ((s->face_mark[f] & 7u) | (on_border(s, f, corner, sides) ? 8u : 0)) << 4 * i;
        }
    hs_log_words(m, HS_PROBE_classify_out, t, item, marks, 0, 0, 0);
}

hs_time hs_cycles_classify(hs_model *m, const hs_state *s, hs_time kick) {
    hs_window *read = &m->read, *write = &m->write;
    hs_queue *fold = &m->items;
    hs_front front = hs_front_start(m, read, write, fold, kick);
    hs_time at_work = 0;
    uint32_t item = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t count = s->generation ? 1 : hs_face_sides(s, f), first = item;
        hs_time in[HS_MAX_SIDES], point = 0;
        for (uint32_t i = 0; i < count; i++, item++) {
            in[i] = hs_front_take(m, &front, read, fold, s, item, HS_PROBE_classify_in) + 1;
            hs_queue_in(fold, in[i]);
            point = in[i] + HS_GEOMETRY;
        }
        hs_log_face(m, point, s, f);
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t lanes = hs_item_lanes(s, first + i);
            const hs_time begins = hs_later(hs_later(in[i], point) + 1, at_work);
            hs_queue_out(fold, begins);
            /* A corner waits for the next one of its face. */
            hs_time t = begins + 1;
            if (i + 1 < count) t = hs_later(t, hs_later(in[i + 1], point) + 1);
            at_work = hs_scatter_wait(write, t);
            hs_scatter(write, at_work, hs_item_origins(s, first + i), lanes);
            hs_log_contribution(m, at_work, s, f, first + i, lanes);
        }
    }
    const hs_time last =
        front.busy ? write->last + 1 : kick; /* accumulate writes behind its read */
    hs_account(m, HS_STAGE_classify, kick, last, front.busy, front.blocked);
    const bool odd = hs_odd_step(s);
    const uint64_t vertex = HS_POSITION_WORD + HS_SHARP_WORD + (odd ? 0 : HS_POSITION_WORD);
    const uint64_t added =
        HS_MARK_WORD + (odd ? HS_SUM_WORD : 0u) + (s->settings.limit ? HS_RING_WORD : 0u);
    m->traffic.read +=
        front.busy * hs_record_bits(s) + read->served * vertex + write->served * added;
    m->traffic.written += write->served * (added + 2) + (uint64_t)s->faces * HS_POINT_WORD;
    m->report->conflicts += read->own.count + write->own.count;
    const hs_time checked = s->generation ? 0 : kick + front.busy + CHECK_BEHIND;
    return hs_later(last + 1, hs_later(kick + 1, checked));
}
