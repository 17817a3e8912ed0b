/* SPDX-License-Identifier: Apache-2.0
 *
 * What the stages of the cycle-level model share. A time is the number of a cycle. A transaction
 * happens in the cycle in which valid and ready are set; what a register got in cycle t is seen
 * from t + 1 on. Each file X_cycles.c stands for rtl/X.sv and the modules below it, and computes
 * the times of its items in their order from the times of those before: docs/timing.md.
 */
#ifndef HS_MODEL_PARTS_H
#define HS_MODEL_PARTS_H

#include <string.h>

#include "golden_state.h"
#include "model.h"

typedef uint64_t hs_time;

static inline hs_time hs_later(hs_time a, hs_time b) {
    return a > b ? a : b;
}

/* --- fifo.sv, fold.sv: a stall by how full a queue is -------------------------------------------
 *
 * The level that a cycle sees counts what came in and went out in earlier cycles. Whoever asks does
 * so at times that never fall. Items that have not gone out yet, as far as is known, are inside.
 */
enum {
    HS_QUEUE_RING = 1024
}; /* a power of two, more than any queue and what is on its way to it */

typedef struct hs_queue {
    uint32_t most; /* the level up to which there is no stall */
    uint32_t ins, outs, ins_seen, outs_seen;
    hs_time in[HS_QUEUE_RING], out[HS_QUEUE_RING];
} hs_queue;

static inline void hs_queue_clear(hs_queue *q, uint32_t most) {
    q->most = most;
    q->ins = q->outs = q->ins_seen = q->outs_seen = 0;
}

static inline void hs_queue_in(hs_queue *q, hs_time t) {
    q->in[q->ins++ % HS_QUEUE_RING] = t;
}

static inline void hs_queue_out(hs_queue *q, hs_time t) {
    q->out[q->outs++ % HS_QUEUE_RING] = t;
}

/* The first cycle from t on that sees no more than `most` items inside. */
static inline hs_time hs_queue_wait(hs_queue *q, hs_time t) {
    for (;;) {
        while (q->ins_seen != q->ins && q->in[q->ins_seen % HS_QUEUE_RING] < t)
            q->ins_seen++;
        while (q->outs_seen != q->outs && q->out[q->outs_seen % HS_QUEUE_RING] < t)
            q->outs_seen++;
        if (q->ins_seen - q->outs_seen <= q->most || q->outs_seen == q->outs) return t;
        t = hs_later(t, q->out[q->outs_seen % HS_QUEUE_RING]) + 1;
    }
}

/* --- gather.sv, scatter.sv: a window of items before the banks of a memory ----------------------
 *
 * In each cycle a bank serves the oldest request that wants it, and items enter in order: so each
 * bank serves its requests in the order in which they entered, one a cycle. Where there are fewer
 * lanes than banks, the oldest requests get them: what is older never waits for what is younger.
 */
enum { HS_MOST_VIEWS = 8, HS_MOST_BANKS = 16, HS_MOST_WINDOW = 32, HS_LANES = 4 };

typedef struct hs_conflicts {
    hs_time until;  /* cycles before this one are counted */
    uint64_t count; /* cycles in which a request waited */
} hs_conflicts;

enum { HS_GRANT_RING = 1024 }; /* a power of two, more than a window's requests take */

typedef struct hs_window {
    uint32_t bank_mask, slot_mask, next;
    uint32_t lanes;   /* requests served in a cycle at most, 0: as many as there are banks */
    uint32_t latency; /* gather: from a request to its word */
    struct {
        hs_time t;
        uint32_t count;
    } grants[HS_GRANT_RING];      /* if there are lanes: what a cycle served */
    hs_time bank[HS_MOST_BANKS];  /* its latest service */
    hs_time slot[HS_MOST_WINDOW]; /* the last cycle in which the item there keeps a new one out */
    hs_time last;                 /* gather: the latest item left; scatter: the latest service */
    uint64_t served;              /* requests */
    hs_conflicts own, *conflicts; /* windows that are counted as one share theirs */
} hs_window;

static inline void hs_window_clear(hs_window *w, const hs_model_config *config) {
    memset(w, 0, sizeof *w);
    w->bank_mask = config->banks - 1;
    w->slot_mask = config->window - 1;
    w->lanes = config->lanes < config->banks ? config->lanes : 0;
    w->latency = config->latency;
    w->conflicts = &w->own;
}

/* The first cycle from t on in which a lane is free, which it takes. */
static inline hs_time hs_window_lane(hs_window *w, hs_time t) {
    while (w->grants[t % HS_GRANT_RING].t == t && w->grants[t % HS_GRANT_RING].count == w->lanes)
        t++;
    if (w->grants[t % HS_GRANT_RING].t != t) {
        w->grants[t % HS_GRANT_RING].t = t;
        w->grants[t % HS_GRANT_RING].count = 0;
    }
    w->grants[t % HS_GRANT_RING].count++;
    return t;
}

/* The requests of an item that entered in cycle t: when the last of them is served, or 0. */
static inline hs_time hs_window_serve(hs_window *w, hs_time t, const uint32_t index[HS_LANES],
                                      uint32_t lanes) {
    hs_time last = 0;
    w->served += (uint64_t)__builtin_popcount(lanes);
    for (uint32_t i = 0; i < HS_LANES; i++) {
        if (!(lanes >> i & 1)) continue;
        hs_time *bank = &w->bank[index[i] & w->bank_mask];
        *bank = hs_later(t, *bank) + 1;
        if (w->lanes) *bank = hs_window_lane(w, *bank);
        last = hs_later(last, *bank);
    }
    if (last > t + 1) {
        hs_conflicts *c = w->conflicts;
        const hs_time from = hs_later(t + 1, c->until);
        if (last > from) c->count += last - from;
        c->until = hs_later(last, c->until);
    }
    return last;
}

/* The first cycle from t on in which an item can enter. */
static inline hs_time hs_gather_wait(const hs_window *w, hs_time t) {
    return hs_later(t, w->slot[w->next & w->slot_mask] + 1);
}

/* An item enters in cycle t; the cycle in which it leaves with its words. */
static inline hs_time hs_gather(hs_window *w, hs_time t, const uint32_t index[HS_LANES],
                                uint32_t lanes) {
    const hs_time served = hs_window_serve(w, t, index, lanes);
    w->last = hs_later(w->last + 1, served ? served + 1 + w->latency : t + 1);
    w->slot[w->next++ & w->slot_mask] = w->last;
    return w->last;
}

static inline hs_time hs_scatter_wait(const hs_window *w, hs_time t) {
    return hs_later(t, w->slot[w->next & w->slot_mask]);
}

/* An item enters in cycle t. */
static inline void hs_scatter(hs_window *w, hs_time t, const uint32_t index[HS_LANES],
                              uint32_t lanes) {
    const hs_time served = hs_window_serve(w, t, index, lanes);
    w->slot[w->next++ & w->slot_mask] = served;
    w->last = hs_later(w->last, served);
}

/* --- Words of the memories, in bits (docs/architecture.md), at the default capacities -----------
 */
enum {
    HS_VERTEX_BITS = 19, /* of a vertex' number, a quad's, a half-edge's */
    HS_QUAD_BITS = 19,
    HS_HALFEDGE_BITS = HS_QUAD_BITS + 2,
    HS_POSITION_WORD = 128,
    HS_SUM_WORD = 168,
    HS_SHARP_WORD = 18,
    HS_RING_WORD = 177,
    HS_MARK_WORD = 13,
    HS_HALF_WORD = 2 * HS_VERTEX_BITS + 2 * HS_HALFEDGE_BITS + 19,
    HS_EDGE_WORD = 132,
    HS_POINT_WORD = 130,
    HS_VERDICT_WORD = HS_VERTEX_BITS + 2,
    HS_NUMBER_WORD = HS_QUAD_BITS + 4,
    HS_BIRTH_WORDS = HS_POSITION_WORD + HS_SUM_WORD + HS_SHARP_WORD + HS_MARK_WORD
};

/* --- emit.sv, pack.sv ---------------------------------------------------------------------------
 */
/* The output's pauses: the generator's bits, a cycle each, as far as it has run. */
typedef struct hs_output_port {
    hs_pauses pauses;
    uint64_t *ready;
    size_t room;
    hs_time known;
    bool exhausted;
} hs_output_port;

void hs_output_start(hs_output_port *o, hs_stalls stalls);
/* The first cycle from t on in which the output takes a beat. */
hs_time hs_output_ready(hs_output_port *o, hs_time t);

typedef struct hs_emit_cycles {
    hs_output_port *port; /* where beats go; NULL: to take_beat */
    hs_time (*take_beat)(void *context, hs_time t);
    void *context;

    /* The op that was taken last: its records are made as soon as it is known what follows. */
    uint32_t kind, generation, mask;
    hs_time moved;                      /* when it went to where records are made */
    bool pending;                       /* there is one: not before the first */
    hs_time made, handed;               /* the latest op's records: made, and taken by pack */
    uint32_t grouped, carried, corners; /* vertices, records, corners that wait for more */

    uint32_t rest, rows; /* pack: records that wait; rows so far */
    hs_time row_left[2]; /* when the latest rows left their queue */
    hs_time beat_loaded, beat_taken;
    uint32_t *beat_cycle; /* when each beat was taken */
    size_t beats, beat_room;
    hs_time first_out;

    hs_time begin; /* the header op was taken */
    uint64_t ops, blocked, waited;
    uint64_t vertices, faces;
    bool exhausted;
} hs_emit_cycles;

/* An op for emit: the kind, the vertex' number, slots in use, whether a polygon's corner is the
 * last one. */
typedef struct hs_op {
    uint32_t kind, generation, number, mask, sides;
    bool first, last;
} hs_op;

/* --- The model ----------------------------------------------------------------------------------
 */
struct hs_model {
    hs_model_config config;
    hs_output_port output; /* of a model alone, and */
    hs_pauses own_input;   /* its input's pauses */
    hs_golden *golden;

    /* The view */
    const hs_packet *in;
    hs_pauses *input;      /* the input's pauses */
    hs_time offered, free; /* its first beat is offered; the pipeline is ready for it */
    hs_time received;      /* its last beat was taken */
    hs_cycle_report *report;
    hs_model_traffic traffic;
    hs_log *log;          /* or NULL */
    bool entered;         /* golden has accepted the packet */
    bool ends;            /* this generation is the last one */
    bool has_smooth;      /* smooth is not left out in this step */
    bool pass;            /* classify and split work in one pass */
    bool edges;           /* no classify: the pass before left what new vertices are made of */
    size_t smooth_logged; /* transactions of smooth_out that are complete */
    hs_time now;          /* when the sequencer starts the next stage */
    /* Generations begun, and cycles from the first beat in to the beginning of each. */
    uint32_t generations;
    uint64_t generation_cycle[HS_MAX_DEPTH + 1];
    hs_emit_cycles emit;
    uint8_t *sent; /* per vertex: before this generation's smooth */
    size_t sent_room;
    bool exhausted;

    hs_window read, look, write, write_upper; /* of the stage at work */
    hs_window pass_read, pass_write;          /* of classify, in one pass with split */
    hs_queue items, waiting, ops, pass_items, positions;
};

/* Items that a fold before which a window stands holds before it asks to stop. */
static inline uint32_t hs_fold_most(const hs_model_config *config) {
    return 512 - 24 - config->window;
}

/* The item of an active mesh, as fetch shows it: a quad, or in generation 0 a corner. */
static inline const uint32_t *hs_item_origins(const hs_state *s, uint32_t item) {
    return s->generation ? s->origin + 4 * (size_t)item : s->origin + item;
}

static inline uint32_t hs_item_lanes(const hs_state *s, uint32_t item) {
    return !s->generation ? 1 : hs_is_half(s, item) ? 7 : 15;
}

static inline uint32_t hs_items(const hs_state *s) {
    return s->generation ? s->faces : s->halfedges;
}

/* A stage took items: busy cycles, blocked ones; it was active from behind `kick` to `last`. */
void hs_account(hs_model *m, uint32_t stage, hs_time kick, hs_time last, uint64_t busy,
                uint64_t blocked);

static inline void hs_log_words(hs_model *m, uint32_t probe, hs_time t, uint32_t item, uint32_t a,
                                uint32_t b, uint32_t c, uint32_t d) {
    if (m->log) hs_log_add(m->log, probe, t, item, (const uint32_t[4]){a, b, c, d});
}

/* From the last item of a face to its point: face_geometry.sv. */
enum { HS_GEOMETRY = 5 };
void hs_log_face(hs_model *m, hs_time t, const hs_state *s, uint32_t f);
void hs_log_contribution(hs_model *m, hs_time t, const hs_state *s, uint32_t f, uint32_t item,
                         uint32_t lanes);

void hs_log_item(hs_model *m, uint32_t probe, hs_time t, const hs_state *s, uint32_t item);

/* The record of an item: both halves, or in generation 0 one. */
static inline uint64_t hs_record_bits(const hs_state *s) {
    return s->generation ? 2 * HS_HALF_WORD : HS_HALF_WORD;
}

/* The front of classify, select and guard: fetch shows items in order, a gather takes them when it
 * has room and the fold behind it does not ask to stop. */
typedef struct hs_front {
    hs_time shown; /* the next item is, from this cycle on */
    uint64_t busy, blocked;
} hs_front;

static inline hs_front hs_front_start(hs_model *m, hs_window *read, hs_window *write,
                                      hs_queue *fold, hs_time kick) {
    hs_window_clear(read, &m->config);
    hs_window_clear(write, &m->config);
    hs_queue_clear(fold, hs_fold_most(&m->config));
    return (hs_front){.shown = kick + 1};
}

/* Takes the next item; the cycle in which the gather gives it. */
static inline hs_time hs_front_take(hs_model *m, hs_front *f, hs_window *read, hs_queue *fold,
                                    const hs_state *s, uint32_t item, uint32_t probe) {
    const hs_time t = hs_queue_wait(fold, hs_gather_wait(read, f->shown));
    f->busy++;
    f->blocked += t - f->shown;
    f->shown = t + 1;
    hs_log_item(m, probe, t, s, item);
    return hs_gather(read, t, hs_item_origins(s, item), hs_item_lanes(s, item));
}

/* The stages. kick: the cycle in which the sequencer starts it; the result: the one in which it
 * sees that the stage has come to rest. s: golden's state when the stage has done its work. */
hs_time hs_cycles_receive(hs_model *m, const hs_state *s);
hs_time hs_cycles_classify(hs_model *m, const hs_state *s, hs_time kick);
hs_time hs_cycles_select(hs_model *m, const hs_state *s, hs_time kick);
hs_time hs_cycles_guard(hs_model *m, const hs_state *s, hs_time kick);
hs_time hs_cycles_smooth(hs_model *m, const hs_state *s, hs_time kick);
hs_time hs_cycles_split(hs_model *m, const hs_state *s, hs_time kick);

/* Classify and split in one pass (rtl/split.sv, pass_i). */
hs_time hs_cycles_pass(hs_model *m, const hs_state *s, hs_time kick);
/* retag.sv, beside smooth: when it is at rest. */
hs_time hs_cycles_retag(const hs_model *m, const hs_state *s, hs_time kick);

/* Empties emit; where its beats go stays as it is. */
void hs_emit_begin(hs_model *m);
/* One view: hs_model_run without its log's, its input's and its output's start. */
bool hs_model_view(hs_model *m, const hs_packet *in, hs_packet *out, hs_golden_report *report,
                   hs_cycle_report *cycles, hs_error *err);
/* Offers an op from cycle t on; the cycle in which emit takes it. Ops come in order. */
hs_time hs_emit_op(hs_model *m, hs_time t, const hs_op *op);
/* Behind the trailer: the cycle in which the sequencer hears that the last beat was taken. */
hs_time hs_emit_end(hs_model *m);

#endif
