/* SPDX-License-Identifier: Apache-2.0
 *
 * When smooth works: rtl/smooth.sv with smooth_walk and send_groups.
 *
 *   rows of marks -> pick one -> position and sum -> division -> write, lanes
 *   rows of marks, new vertices -> pick up to four ----------------------> lanes
 *   lanes -> groups of four (ops) -> emit;   with limit: one by one (ops) -> emit
 */
#include "model_parts.h"

enum {
    TO_WRITE = 6, /* from a single pick to its write: read, weighted sum, division */
    TO_LANES = 1, /* from a pick of several to the lanes */
    TO_GROUP = 1, /* from the lanes to the FIFO of groups */
    WIDTH = 4     /* vertices that are picked, or leave, at once */
};

typedef struct walk {
    hs_model *m;
    const hs_state *s;
    bool odd, leaves_only, mixed;          /* as in rtl/smooth_walk.sv */
    hs_time t;                             /* the next cycle in which something may be picked */
    hs_time last_single, last_wide;        /* the latest pick of either kind; 0: none yet */
    hs_time grouped;                       /* the latest vertices came into their lanes */
    hs_time sent;                          /* emit took the latest op */
    uint64_t busy, blocked, read, written; /* cycles; bits */
    uint32_t rest[WIDTH], rest_count;      /* vertices that wait for a group */
} walk;

static bool leaves(const walk *w, uint32_t v) {
    const hs_state *s = w->s;
    return !w->m->sent[v] && (s->last || s->finish || s->mark[v] & (MARK_HELD | MARK_BORDER));
}

/* It may move, as far as the marks tell. */
static bool moves(const walk *w, uint32_t v) {
    const hs_state *s = w->s;
    return w->odd && !s->finish && !w->m->sent[v] && !(s->mark[v] & (MARK_HELD | MARK_BORDER));
}

static void send(walk *w, hs_time t, uint32_t kind, uint32_t vertex) {
    const hs_op op = {.kind = kind, .generation = w->s->generation, .number = vertex};
    w->sent = hs_emit_op(w->m, hs_later(t, w->sent + 1), &op);
}

/* Vertices are in their lanes in cycle t. */
static void group(walk *w, hs_time t, const uint32_t *vertex, uint32_t count) {
    uint32_t all[2 * WIDTH] = {0}, from = 0;
    const uint32_t total = w->rest_count + count;
    if (count == 0) return;
    w->grouped = t;
    for (uint32_t i = 0; i < total; i++)
        all[i] = i < w->rest_count ? w->rest[i] : vertex[i - w->rest_count];
    if (total >= WIDTH) {
        from = WIDTH;
        hs_queue_in(&w->m->ops, t + TO_GROUP);
        send(w, t + TO_GROUP + 1, HS_OP_GROUP, all[0]);
        hs_queue_out(&w->m->ops, w->sent);
    }
    w->rest_count = total - from;
    for (uint32_t i = from; i < total; i++)
        w->rest[i - from] = all[i];
}

/* The next pick: when. What moves and does not leave needs no room. */
static hs_time pick(walk *w, bool needs_room) {
    const hs_time t = needs_room ? hs_queue_wait(&w->m->ops, w->t) : w->t;
    w->busy++;
    w->blocked += t - w->t;
    w->t = t + 1;
    return t;
}

/* One vertex: read, divided, written, sent if it leaves. */
static void pick_one(walk *w, uint32_t v) {
    const hs_time t = pick(w, !w->mixed), written = t + TO_WRITE;
    const bool leaving = leaves(w, v), moved = w->odd && hs_may_move(w->s, w->m->sent, v);
    w->last_single = t;
    w->read +=
        HS_POSITION_WORD + HS_SUM_WORD + HS_SHARP_WORD + (w->s->settings.limit ? HS_RING_WORD : 0u);
    w->written += (w->odd ? HS_SUM_WORD : 0u) + (moved ? HS_POSITION_WORD : 0u) +
                  (leaving ? HS_MARK_WORD : 0u);
    hs_log_words(w->m, HS_PROBE_smooth_in, t, v, 0, 0, 0, 0);
    hs_log_words(w->m, HS_PROBE_smooth_out, written, v, (uint32_t)leaving << 1 | moved, 0, 0, 0);
    if (!leaving) return;
    if (!w->s->settings.limit) {
        group(w, written, &v, 1);
        return;
    }
    hs_queue_in(&w->m->ops, written);
    send(w, written + 1, HS_OP_VERTEX, v);
    hs_queue_out(&w->m->ops, w->sent);
}

/* Up to four of a row, which stay where they are. */
static void pick_four(walk *w, const uint32_t *vertex, uint32_t count) {
    const hs_time t = pick(w, true);
    const uint32_t banks = w->m->config.banks;
    uint32_t leaving[WIDTH], leaving_count = 0, mask = 0, leave = 0;
    for (uint32_t i = 0; i < count; i++) {
        mask |= 1u << vertex[i] % banks;
        if (!leaves(w, vertex[i])) continue;
        leave |= 1u << vertex[i] % banks;
        leaving[leaving_count++] = vertex[i];
    }
    w->last_wide = t;
    w->read += (uint64_t)count * HS_POSITION_WORD;
    w->written +=
        (uint64_t)(w->odd ? count : 0) * HS_SUM_WORD + (uint64_t)leaving_count * HS_MARK_WORD;
    hs_log_words(w->m, HS_PROBE_smooth_in, t, vertex[0] - vertex[0] % banks, mask, leave, 0, 0);
    group(w, t + TO_LANES, leaving, leaving_count);
}

/* A row of as many vertices as there are banks: first those that stay, then those that move. */
static void walk_row(walk *w, uint32_t row, uint32_t banks) {
    const hs_state *s = w->s;
    uint32_t together[HS_MOST_BANKS], single[HS_MOST_BANKS], together_count = 0, single_count = 0;
    for (uint32_t v = row; v < row + banks && v < s->vertices; v++) {
        if (!(s->mark[v] & MARK_ACTIVE)) continue;
        if ((w->leaves_only || !w->odd) && !leaves(w, v)) continue;
        if (w->leaves_only || (w->mixed && !moves(w, v)))
            together[together_count++] = v;
        else
            single[single_count++] = v;
    }
    if (together_count + single_count == 0) w->t++;
    for (uint32_t i = 0; i < together_count; i += WIDTH)
        pick_four(w, together + i, together_count - i < WIDTH ? together_count - i : WIDTH);
    for (uint32_t i = 0; i < single_count; i++)
        pick_one(w, single[i]);
}

/* The new vertices behind a last step, when nothing is on its way singly any more: of a row of the
 * vertex memory, or of four faces in line. */
static void walk_new(walk *w, uint32_t banks, bool from_face) {
    const hs_state *s = w->s;
    const uint32_t first = s->vertices, end = s->vertices + s->refined;
    if (w->last_single && first < end) {
        const hs_time free = hs_later(w->t, w->last_single + TO_WRITE + 1);
        w->blocked += free - w->t;
        w->t = free;
    }
    for (uint32_t v = first; v < end;) {
        const hs_time t = pick(w, true);
        uint32_t vertex[WIDTH], count = 0;
        do
            vertex[count++] = v++;
        while (count < WIDTH &&
               (from_face ? (v - first) % (banks < WIDTH ? banks : WIDTH) : v % banks) && v < end);
        w->last_wide = t;
        w->read += (uint64_t)count * (w->m->edges ? 2 * HS_EDGE_WORD : HS_POSITION_WORD);
        hs_log_words(w->m, HS_PROBE_smooth_in, t, vertex[0], 0, 0, count, 0);
        group(w, t + TO_LANES, vertex, count);
    }
}

/* When smooth is at rest. */
static hs_time end_of(walk *w) {
    hs_time last = w->t - 1; /* the latest pick, or row without work */
    if (w->last_single) last = hs_later(last, w->last_single + TO_WRITE);
    if (w->last_wide) last = hs_later(last, w->last_wide + TO_LANES);
    if (w->grouped) last = hs_later(last, w->grouped + TO_GROUP);
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
    const bool limit = s->settings.limit, odd = hs_odd_step(s);
    walk w = {.m = m, .s = s, .odd = odd, .t = kick + 1};
    w.leaves_only = !limit && (!odd || s->finish);
    w.mixed = !limit && odd && !s->finish && !s->last;
    /* Up to this level of the FIFO before emit vertices are picked. */
    hs_queue_clear(&m->ops, limit ? m->config.ops - 8 : m->config.ops / 2 - 5);
    for (uint32_t row = 0; row < s->vertices; row += banks)
        walk_row(&w, row, banks);
    if (s->last) walk_new(&w, banks, s->settings.uniform && s->generation);
    const hs_time last = end_of(&w);
    m->traffic.read +=
        w.read + (uint64_t)(s->vertices + banks - 1) / banks * banks * (HS_MARK_WORD + 1);
    m->traffic.written += w.written;
    hs_account(m, HS_STAGE_smooth, kick, last, w.busy, w.blocked);
    return m->pass ? hs_later(last + 1, hs_cycles_retag(m, s, kick)) : last + 1;
}
