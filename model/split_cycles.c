/* SPDX-License-Identifier: Apache-2.0
 *
 * When split works: rtl/split.sv with fetch, gather, split_number, split_write and split_faces.
 *
 *   fetch -> gather verdicts (read) -> FIFO (waiting) -> gather numbers (look) -> fold (items)
 *   -> at work -> scatter lower (write), upper (write_upper) halves, FIFO of ops (ops) -> emit
 */
#include "split_cycles.h"

static hs_edges edges_of(const hs_state *s, uint32_t f, uint32_t item) {
    hs_edges e = {.lanes = hs_item_lanes(s, item),
                  .refined = !s->finish && (s->decision[f] & FACE_REFINED)};
    for (uint32_t i = 0; i < HS_LANES; i++) {
        if (!(e.lanes >> i & 1)) continue;
        const uint32_t h = s->generation ? 4 * item + i : item, twin = s->twin[h];
        const uint32_t bit = 1u << i;
        if (twin == HS_BORDER)
            e.border |= bit;
        else if (twin == BOUNDARY_TWIN)
            e.boundary |= bit;
        else
            e.beyond[i] = s->generation ? twin / 4 : twin;
        if (!e.refined) continue;
        const uint32_t child = s->child[h];
        if (child == HS_BORDER || child == BOUNDARY_TWIN) continue;
        e.replaced |= bit;
        e.quad[i] = child / 4;
        if (e.boundary & bit || h < twin) e.lower |= bit;
    }
    return e;
}

/* The ops of an item: a vertex, faces. */
typedef struct leaving {
    bool vertex, face;
    hs_op op;
} leaving;

static leaving leaving_of(const hs_state *s, uint32_t f, const hs_edges *e, uint32_t corner,
                          uint32_t sides, bool *vertex_sent) {
    leaving l = {.face = true};
    const bool quads = s->generation != 0;
    l.op = (hs_op){.kind = e->refined || quads ? HS_OP_FACES : HS_OP_CORNER,
                   .generation = s->generation,
                   .mask = 1,
                   .sides = sides,
                   .first = quads || corner == 0,
                   .last = quads || corner + 1 == sides};
    l.op.number = e->refined ? s->number[f] : s->origin[hs_face_first(s, f) + (quads ? 0 : corner)];
    if (!e->refined) return l;
    const uint32_t kept = e->lanes & ~e->replaced & ~e->boundary;
    const uint32_t leaves = s->last ? e->replaced & e->lower : 0;
    l.op.mask = kept | leaves;
    l.face = l.op.mask != 0;
    l.vertex = kept && !s->last && !*vertex_sent;
    *vertex_sent |= l.vertex;
    return l;
}

/* Sends an item's ops, which are there from cycle t on; *before: when the op before was taken. */
static void send(hs_model *m, hs_time t, const leaving *l, hs_time *before) {
    if (l->vertex) {
        hs_op vertex = l->op;
        vertex.kind = HS_OP_VERTEX;
        *before = hs_emit_op(m, hs_later(t, *before + 1), &vertex);
    }
    if (l->face) *before = hs_emit_op(m, hs_later(t, *before + 1), &l->op);
    hs_queue_out(&m->ops, *before);
}

static void log_halves(hs_model *m, uint32_t probe, hs_time t, uint32_t item, const hs_edges *e,
                       uint32_t mask) {
    if (!m->log || !mask) return;
    uint32_t word[4];
    for (int i = 0; i < HS_LANES; i++)
        word[i] = mask >> i & 1 ? e->quad[i] : UINT32_MAX;
    hs_log_add(m->log, probe, t, item, word);
}

/* Both scatters take their part of the item as soon as they have room; conflicts of both count as
 * one, so the earlier one goes first. The cycle in which the later one has taken it. */
static hs_time write_halves(hs_model *m, hs_time t, uint32_t item, const hs_edges *e,
                            uint32_t lower, uint32_t upper) {
    const hs_time at_lower = lower ? hs_scatter_wait(&m->write, t) : t;
    const hs_time at_upper = upper ? hs_scatter_wait(&m->write_upper, t) : t;
    if (upper && at_upper < at_lower) hs_scatter(&m->write_upper, at_upper, e->quad, upper);
    if (lower) hs_scatter(&m->write, at_lower, e->quad, lower);
    if (upper && at_upper >= at_lower) hs_scatter(&m->write_upper, at_upper, e->quad, upper);
    log_halves(m, HS_PROBE_split_lower, at_lower, item, e, lower);
    log_halves(m, HS_PROBE_split_upper, at_upper, item, e, upper);
    return hs_later(at_lower, at_upper);
}

void hs_split_begin(hs_split_run *r, hs_model *m, const hs_state *s) {
    *r = (hs_split_run){.m = m, .s = s, .all = s->settings.uniform && s->generation};
    hs_window_clear(&m->read, &m->config);
    hs_window_clear(&m->look, &m->config);
    hs_window_clear(&m->write, &m->config);
    hs_window_clear(&m->write_upper, &m->config);
    m->write_upper.conflicts = &m->write.own;
    hs_queue_clear(&m->waiting, m->config.window);
    hs_queue_clear(&m->items, hs_fold_most(&m->config));
    hs_queue_clear(&m->ops, m->config.ops - 1);
}

hs_time hs_split_wait(hs_split_run *r, hs_time t) {
    return hs_queue_wait(&r->m->waiting, hs_gather_wait(&r->m->read, t));
}

hs_time hs_split_enter(hs_split_run *r, uint32_t f, uint32_t item, hs_time t, hs_edges *e) {
    hs_model *m = r->m;
    const hs_state *s = r->s;
    *e = edges_of(s, f, item);
    r->items++;
    hs_log_item(m, HS_PROBE_split_in, t, s, item);
    t = hs_gather(&m->read, t, e->beyond,
                  e->refined && !r->all ? e->lanes & ~e->border & ~e->boundary : 0);
    hs_queue_in(&m->waiting, t);
    hs_log_words(m, HS_PROBE_split_number, t, item, r->quads, e->lower, 0, 0);
    r->quads += (uint32_t)__builtin_popcount(e->lower);
    t = hs_gather_wait(&m->look, hs_later(r->looked, t) + 1);
    r->looked = hs_queue_wait(&m->items, t);
    hs_queue_out(&m->waiting, r->looked);
    t = hs_gather(&m->look, r->looked, e->beyond, s->last ? 0 : e->replaced & ~e->lower);
    hs_queue_in(&m->items, t);
    return t;
}

void hs_split_leave(hs_split_run *r, uint32_t f, uint32_t item, uint32_t corner, hs_time known,
                    const hs_edges *e) {
    hs_model *m = r->m;
    const hs_state *s = r->s;
    const hs_time begins = hs_later(known, r->done);
    hs_queue_out(&m->items, begins);
    if (corner == 0) r->vertex_sent = false;
    const uint32_t lower = s->last ? 0 : e->replaced & e->lower;
    const uint32_t upper = s->last ? 0 : e->replaced & (~e->lower | e->boundary);
    const leaving l = leaving_of(s, f, e, corner, hs_face_sides(s, f), &r->vertex_sent);
    r->done = write_halves(m, begins + 1, item, e, lower, upper);
    if (l.vertex || l.face) {
        r->done = hs_queue_wait(&m->ops, r->done);
        hs_queue_in(&m->ops, r->done);
        send(m, r->done + 1, &l, &r->sent);
    }
    hs_log_words(m, HS_PROBE_split_out, r->done, item, e->replaced, e->lower, 0, 0);
}

hs_time hs_split_until(const hs_split_run *r) {
    const hs_model *m = r->m;
    return hs_later(hs_later(r->done, r->sent), hs_later(m->write.last, m->write_upper.last));
}

void hs_split_end(hs_split_run *r) {
    hs_model *m = r->m;
    const bool edges = m->edges, births = r->all && !r->s->last && !r->s->finish;
    const uint64_t own = edges ? 2 * HS_EDGE_WORD : HS_POINT_WORD;
    const uint64_t half = HS_HALF_WORD + (m->pass ? HS_EDGE_WORD : 0);
    if (!m->pass) m->traffic.read += r->items * (hs_record_bits(r->s) + own + HS_VERDICT_WORD);
    m->traffic.read += m->read.served * HS_VERDICT_WORD + m->look.served * HS_NUMBER_WORD;
    m->traffic.written += r->items * HS_NUMBER_WORD +
                          (m->write.served + m->write_upper.served) * half +
                          (births ? r->items * HS_BIRTH_WORDS : 0);
    m->report->conflicts += m->read.own.count + m->look.own.count + m->write.own.count;
}

hs_time hs_cycles_split(hs_model *m, const hs_state *s, hs_time kick) {
    hs_split_run r;
    hs_split_begin(&r, m, s);
    uint64_t busy = 0, blocked = 0;
    hs_time shown = kick + 1;
    uint32_t item = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t count = s->generation ? 1 : hs_face_sides(s, f), first = item;
        hs_time known = 0; /* the face's last item is in the fold */
        hs_edges edge[HS_MAX_SIDES];
        for (uint32_t i = 0; i < count; i++, item++) {
            const hs_time t = hs_split_wait(&r, shown);
            busy++;
            blocked += t - shown;
            shown = t + 1;
            known = hs_split_enter(&r, f, item, t, &edge[i]) + 1;
        }
        for (uint32_t i = 0; i < count; i++)
            hs_split_leave(&r, f, first + i, i, known, &edge[i]);
    }
    const hs_time last = busy ? hs_split_until(&r) : kick;
    hs_split_end(&r);
    hs_account(m, HS_STAGE_split, kick, last, busy, blocked);
    return hs_later(kick, last) + 1;
}
