/* SPDX-License-Identifier: Apache-2.0
 *
 * When split works: rtl/split.sv with fetch, gather, split_number, split_write and split_faces.
 *
 *   fetch -> gather verdicts (read) -> FIFO (waiting) -> gather numbers (look) -> fold (items)
 *   -> at work -> scatter lower (write), upper (write_upper) halves, FIFO of ops (ops) -> emit
 */
#include "model_parts.h"

/* What becomes of an item's edges, a bit a lane. */
typedef struct edges {
    uint32_t lanes, boundary, border, replaced, lower;
    uint32_t beyond[HS_LANES]; /* the items of the twins */
    uint32_t quad[HS_LANES];   /* that replaced edges become */
    bool refined;
} edges;

static edges edges_of(const hs_state *s, uint32_t f, uint32_t item) {
    edges e = {.lanes = hs_item_lanes(s, item),
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

static leaving leaving_of(const hs_state *s, uint32_t f, const edges *e, uint32_t corner,
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

static void log_halves(hs_model *m, uint32_t probe, hs_time t, uint32_t item, const edges *e,
                       uint32_t mask) {
    if (!m->log || !mask) return;
    uint32_t word[4];
    for (int i = 0; i < HS_LANES; i++)
        word[i] = mask >> i & 1 ? e->quad[i] : UINT32_MAX;
    hs_log_add(m->log, probe, t, item, word);
}

/* Both scatters take their part of the item as soon as they have room; conflicts of both count as
 * one, so the earlier one goes first. The cycle in which the later one has taken it. */
static hs_time write_halves(hs_model *m, hs_time t, uint32_t item, const edges *e, uint32_t lower,
                            uint32_t upper) {
    const hs_time at_lower = lower ? hs_scatter_wait(&m->write, t) : t;
    const hs_time at_upper = upper ? hs_scatter_wait(&m->write_upper, t) : t;
    if (upper && at_upper < at_lower) hs_scatter(&m->write_upper, at_upper, e->quad, upper);
    if (lower) hs_scatter(&m->write, at_lower, e->quad, lower);
    if (upper && at_upper >= at_lower) hs_scatter(&m->write_upper, at_upper, e->quad, upper);
    log_halves(m, HS_PROBE_split_lower, at_lower, item, e, lower);
    log_halves(m, HS_PROBE_split_upper, at_upper, item, e, upper);
    return hs_later(at_lower, at_upper);
}

hs_time hs_cycles_split(hs_model *m, const hs_state *s, hs_time kick) {
    hs_window *verdicts = &m->read, *numbers = &m->look;
    hs_window *write_lower = &m->write, *write_upper = &m->write_upper;
    hs_window_clear(verdicts, &m->config);
    hs_window_clear(numbers, &m->config);
    hs_window_clear(write_lower, &m->config);
    hs_window_clear(write_upper, &m->config);
    write_upper->conflicts = &write_lower->own;
    hs_queue_clear(&m->waiting, m->config.window);
    hs_queue_clear(&m->items, hs_fold_most(&m->config));
    hs_queue_clear(&m->ops, m->config.ops - 1);

    const bool all = s->settings.uniform && s->generation;
    uint64_t busy = 0, blocked = 0;
    hs_time shown = kick + 1, looked = 0, done = 0, sent = 0;
    uint32_t item = 0, quads = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t sides = hs_face_sides(s, f), count = s->generation ? 1 : sides;
        const uint32_t first = item;
        hs_time known = 0; /* the face's last item is in the fold */
        edges edge[HS_MAX_SIDES];
        for (uint32_t i = 0; i < count; i++, item++) {
            edges *e = &edge[i];
            *e = edges_of(s, f, item);
            hs_time t = hs_queue_wait(&m->waiting, hs_gather_wait(verdicts, shown));
            busy++;
            blocked += t - shown;
            shown = t + 1;
            hs_log_item(m, HS_PROBE_split_in, t, s, item);
            t = hs_gather(verdicts, t, e->beyond,
                          e->refined && !all ? e->lanes & ~e->border & ~e->boundary : 0);
            hs_queue_in(&m->waiting, t);
            hs_log_words(m, HS_PROBE_split_number, t, item, quads, e->lower, 0, 0);
            quads += (uint32_t)__builtin_popcount(e->lower);
            t = hs_gather_wait(numbers, hs_later(looked, t) + 1);
            looked = hs_queue_wait(&m->items, t);
            hs_queue_out(&m->waiting, looked);
            t = hs_gather(numbers, looked, e->beyond, s->last ? 0 : e->replaced & ~e->lower);
            hs_queue_in(&m->items, t);
            known = t + 1;
        }
        bool vertex_sent = false;
        for (uint32_t i = 0; i < count; i++) {
            const edges *e = &edge[i];
            /* Behind the face's last item; corners wait for the next one. */
            const hs_time begins = hs_later(known, done);
            hs_queue_out(&m->items, begins);
            const hs_time start = begins + 1;
            const uint32_t lower = s->last ? 0 : e->replaced & e->lower;
            const uint32_t upper = s->last ? 0 : e->replaced & (~e->lower | e->boundary);
            const leaving l = leaving_of(s, f, e, i, sides, &vertex_sent);
            done = write_halves(m, start, first + i, e, lower, upper);
            if (l.vertex || l.face) {
                done = hs_queue_wait(&m->ops, done);
                hs_queue_in(&m->ops, done);
                send(m, done + 1, &l, &sent);
            }
            hs_log_words(m, HS_PROBE_split_out, done, first + i, e->replaced, e->lower, 0, 0);
        }
    }
    const hs_time written = hs_later(write_lower->last, write_upper->last);
    const hs_time last = busy ? hs_later(hs_later(done, sent), written) : kick;
    hs_account(m, HS_STAGE_split, kick, last, busy, blocked);
    m->report->conflicts += verdicts->own.count + numbers->own.count + write_lower->own.count;
    return hs_later(kick, last) + 1;
}
