/* SPDX-License-Identifier: Apache-2.0
 *
 * When classify and split work in one pass, in the odd steps of a uniform run: classify's items go
 * on into split's first gather in the cycle in which accumulate takes them, and their positions
 * into a FIFO until split has written their halves. Only quads, which are all refined; nothing
 * leaves.
 */
#include "split_cycles.h"

/* FIFO of positions in rtl/split.sv: its depth is eight windows. */
static uint32_t positions_most(const hs_model_config *config) {
    return 8 * config->window - 1;
}

hs_time hs_cycles_pass(hs_model *m, const hs_state *s, hs_time kick) {
    hs_window *read = &m->pass_read, *write = &m->pass_write;
    hs_split_run r;
    hs_split_begin(&r, m, s);
    hs_window_clear(read, &m->config);
    hs_window_clear(write, &m->config);
    hs_queue_clear(&m->pass_items, hs_fold_most(&m->config));
    hs_queue_clear(&m->positions, positions_most(&m->config));
    uint64_t blocked = 0, starved = 0;
    hs_time shown = kick + 1, taken = 0, active = 0; /* split is, so far, up to this cycle */
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t *origins = hs_item_origins(s, f), lanes = hs_item_lanes(s, f);
        hs_time t = hs_queue_wait(&m->pass_items, hs_gather_wait(read, shown));
        blocked += t - shown;
        shown = t + 1;
        hs_log_item(m, HS_PROBE_classify_in, t, s, f);
        const hs_time in = hs_gather(read, t, origins, lanes) + 1, point = in + HS_GEOMETRY;
        hs_queue_in(&m->pass_items, in);
        hs_log_face(m, point, s, f);
        const hs_time begins = hs_later(point + 1, taken);
        hs_queue_out(&m->pass_items, begins);
        /* Accumulate, split and the FIFO take the item in the same cycle. */
        taken = hs_split_wait(&r, hs_scatter_wait(write, begins + 1));
        taken = hs_queue_wait(&m->positions, taken);
        hs_scatter(write, taken, origins, lanes);
        hs_log_contribution(m, taken, s, f, f, lanes);
        hs_queue_in(&m->positions, taken);
        hs_edges e;
        const hs_time known = hs_split_enter(&r, f, f, taken, &e) + 1;
        hs_split_leave(&r, f, f, 0, known, &e);
        hs_queue_out(&m->positions, r.done);
        /* Split rests when nothing is inside; it is busy in the cycle in which an item enters. */
        const hs_time until = hs_split_until(&r);
        if (taken <= active) starved--;
        starved += until - hs_later(taken, active);
        active = until;
    }
    const hs_time classified = write->last + 1; /* accumulate writes behind its read */
    hs_account(m, HS_STAGE_classify, kick, classified, s->faces, blocked);
    m->report->conflicts += read->own.count + write->own.count;
    const uint64_t added = HS_MARK_WORD + HS_SUM_WORD;
    m->traffic.read += s->faces * hs_record_bits(s) + write->served * added +
                       read->served * (HS_POSITION_WORD + HS_SHARP_WORD);
    m->traffic.written += write->served * (added + 2) + (uint64_t)s->faces * HS_POINT_WORD;
    hs_split_end(&r);
    hs_cycle_report *report = m->report;
    report->activity[HS_STAGE_split][HS_ACTIVITY_busy] += s->faces;
    report->activity[HS_STAGE_split][HS_ACTIVITY_starved] += starved;
    report->items_in[HS_STAGE_split] += s->faces;
    report->items_out[HS_STAGE_split] += s->faces;
    return hs_later(classified, active) + 1;
}

hs_time hs_cycles_retag(const hs_model *m, const hs_state *s, hs_time kick) {
    const uint32_t banks = m->config.banks, first = s->vertices / banks;
    const uint32_t behind = (s->vertices + s->refined + banks - 1) / banks;
    return kick + (behind - first) + 1;
}
