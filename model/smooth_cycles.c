/* SPDX-License-Identifier: Apache-2.0
 *
 * When smooth works: rtl/smooth.sv with send_groups.
 *
 *   rows of marks -> pick -> position and sum -> division -> write, FIFO (ops) -> emit
 *   wide:            pick up to four of a row -> lanes -> groups of four (ops) -> emit
 */
#include "model_parts.h"

enum {
    TO_WRITE = 6, /* from pick to write: read, weighted sum, division */
    TO_GROUP = 2, /* from pick to the FIFO of groups: read, lanes */
    WIDTH = 4     /* vertices that are picked at once */
};

typedef struct walk {
    hs_model *m;
    const hs_state *s;
    bool wide, odd;
    hs_time t;         /* the next cycle in which something may be picked */
    hs_time last_pick; /* 0: none yet */
    hs_time sent;      /* emit took the latest op */
    uint64_t busy, blocked;
    uint32_t rest[WIDTH], rest_count; /* wide: vertices that wait for a group */
} walk;

static bool leaves(const walk *w, uint32_t v) {
    const hs_state *s = w->s;
    return !w->m->sent[v] && (s->last || s->finish || s->mark[v] & (MARK_HELD | MARK_BORDER));
}

static void send(walk *w, hs_time t, uint32_t kind, uint32_t vertex) {
    const hs_op op = {.kind = kind, .generation = w->s->generation, .number = vertex, .mask = 0};
    w->sent = hs_emit_op(w->m, hs_later(t, w->sent + 1), &op);
    hs_queue_out(&w->m->ops, w->sent);
}

/* The next pick: when. */
static hs_time pick(walk *w) {
    const hs_time t = hs_queue_wait(&w->m->ops, w->t);
    w->busy++;
    w->blocked += t - w->t;
    w->t = t + 1;
    w->last_pick = t;
    return t;
}

/* One vertex: read, divided, written if it is an old one, sent if it leaves. */
static void pick_one(walk *w, uint32_t v, bool is_new) {
    const hs_time t = pick(w);
    hs_log_words(w->m, HS_PROBE_smooth_in, t, v, 0, 0, 0, 0);
    const bool leaving = is_new || leaves(w, v);
    const bool moved = !is_new && w->odd && hs_may_move(w->s, w->m->sent, v);
    if (!is_new)
        hs_log_words(w->m, HS_PROBE_smooth_out, t + TO_WRITE, v, (uint32_t)leaving << 1 | moved, 0,
                     0, 0);
    if (!leaving) return;
    hs_queue_in(&w->m->ops, t + TO_WRITE);
    send(w, t + TO_WRITE + 1, HS_OP_VERTEX, v);
}

/* Up to four of a row, which leave where they are. */
static void pick_four(walk *w, const uint32_t *vertex, uint32_t count) {
    const hs_time t = pick(w);
    const uint32_t banks = w->m->config.banks;
    uint32_t lanes = 0;
    for (uint32_t i = 0; i < count; i++)
        lanes |= 1u << vertex[i] % banks;
    hs_log_words(w->m, HS_PROBE_smooth_in, t, vertex[0] - vertex[0] % banks, lanes, 0, 0, 0);
    uint32_t all[2 * WIDTH] = {0}, total = w->rest_count + count;
    for (uint32_t i = 0; i < total; i++)
        all[i] = i < w->rest_count ? w->rest[i] : vertex[i - w->rest_count];
    uint32_t from = 0;
    if (total >= WIDTH) {
        from = WIDTH;
        hs_queue_in(&w->m->ops, t + TO_GROUP);
        send(w, t + TO_GROUP + 1, HS_OP_GROUP, all[0]);
    }
    w->rest_count = total - from;
    for (uint32_t i = from; i < total; i++)
        w->rest[i - from] = all[i];
}

/* A row of as many vertices as there are banks. */
static void walk_row(walk *w, uint32_t row, uint32_t banks) {
    const hs_state *s = w->s;
    uint32_t work[HS_MOST_BANKS], count = 0;
    for (uint32_t v = row; v < row + banks && v < s->vertices; v++)
        if (s->mark[v] & MARK_ACTIVE && ((w->odd && !w->wide) || leaves(w, v))) work[count++] = v;
    if (count == 0) w->t++;
    for (uint32_t i = 0; i < count; i += w->wide ? WIDTH : 1)
        if (w->wide)
            pick_four(w, work + i, count - i < WIDTH ? count - i : WIDTH);
        else
            pick_one(w, work[i], false);
}

/* The new vertices behind a last step, of a row at a time; from the face memory singly. */
static void walk_new(walk *w, uint32_t banks, bool from_face) {
    const hs_state *s = w->s;
    const uint32_t end = s->vertices + s->refined;
    for (uint32_t v = s->vertices; v < end;) {
        if (!w->wide) {
            pick_one(w, v++, true);
            continue;
        }
        uint32_t vertex[WIDTH], count = 0;
        do
            vertex[count++] = v++;
        while (count < (from_face ? 1 : WIDTH) && v % banks && v < end);
        pick_four(w, vertex, count);
    }
}

/* When smooth is at rest. */
static hs_time end_of(walk *w) {
    hs_time last = w->t - 1; /* the latest pick, or row without work */
    if (!w->wide)
        return hs_later(hs_later(last, w->last_pick ? w->last_pick + TO_WRITE : 0), w->sent);
    if (w->last_pick) last = hs_later(last, w->last_pick + TO_GROUP);
    /* What is left over leaves when nothing else is on its way. */
    hs_time single = hs_later(last, w->sent) + 1;
    for (uint32_t i = 0; i < w->rest_count; i++) {
        send(w, single, HS_OP_VERTEX, w->rest[i]);
        single = w->sent + 1;
    }
    return hs_later(last, w->sent);
}

hs_time hs_cycles_smooth(hs_model *m, const hs_state *s, hs_time kick) {
    const uint32_t banks = m->config.banks;
    walk w = {.m = m, .s = s, .odd = hs_odd_step(s), .t = kick + 1};
    w.wide = !s->settings.limit && (!w.odd || s->finish);
    /* Up to this level of the FIFO before emit vertices are picked. */
    hs_queue_clear(&m->ops, w.wide ? m->config.ops / 2 - 5 : m->config.ops - 8);
    for (uint32_t row = 0; row < s->vertices; row += banks)
        walk_row(&w, row, banks);
    if (s->last) walk_new(&w, banks, s->settings.uniform && s->generation);
    const hs_time last = end_of(&w);
    hs_account(m, HS_STAGE_smooth, kick, last, w.busy, w.blocked);
    return last + 1;
}
