/* SPDX-License-Identifier: Apache-2.0
 *
 * What waits between two boundaries, cycle by cycle: what passed the first one less what passed the
 * second. The FIFO before emit has no boundary at its mouth, but what enters it is known: vertices
 * from what smooth picks and writes, items of split from what comes out behind them.
 */
#include "timeline_parts.h"

#include <stdlib.h>

#include "memory.h"

const char *hs_timeline_fill_name(uint32_t fill) {
    static const char *const name[HS_FILLS] = {
        [HS_FILL_transform] = "vertices in transform",
        [HS_FILL_quantize] = "vertices before quantize",
        [HS_FILL_classify] = "items in classify",
        [HS_FILL_select] = "items in select",
        [HS_FILL_guard] = "items in guard",
        [HS_FILL_smooth] = "vertices in smooth",
        [HS_FILL_number] = "items in split, not numbered",
        [HS_FILL_split] = "items in split, numbered",
        [HS_FILL_ops] = "FIFO before emit",
        [HS_FILL_pack] = "records before the port",
    };
    return name[fill];
}

uint32_t hs_timeline_fill_stage(uint32_t fill) {
    static const uint32_t stage[HS_FILLS] = {
        [HS_FILL_transform] = HS_STAGE_transform,
        [HS_FILL_quantize] = HS_STAGE_quantize,
        [HS_FILL_classify] = HS_STAGE_classify,
        [HS_FILL_select] = HS_STAGE_select,
        [HS_FILL_guard] = HS_STAGE_guard,
        [HS_FILL_smooth] = HS_STAGE_smooth,
        [HS_FILL_number] = HS_STAGE_split,
        [HS_FILL_split] = HS_STAGE_split,
        [HS_FILL_ops] = HS_STAGE_emit,
        [HS_FILL_pack] = HS_STAGE_emit,
    };
    return stage[fill];
}

/* --- Steps of a fill ----------------------------------------------------------------------------
 */

typedef struct step {
    uint64_t cycle; /* the change is seen behind it */
    int32_t by;
} step;

typedef struct steps {
    step *at;
    size_t count, room;
    bool exhausted;
} steps;

static void add(steps *s, uint64_t cycle, int32_t by) {
    if (s->count == s->room) {
        const size_t room = s->room ? 2 * s->room : 1024;
        step *more = hs_reallocate(s->at, room * sizeof *more);
        if (!more) {
            s->exhausted = true;
            return;
        }
        s->at = more;
        s->room = room;
    }
    s->at[s->count++] = (step){cycle, by};
}

static void add_all(steps *s, hs_passed p, int32_t by) {
    for (size_t i = 0; i < p.count; i++)
        add(s, p.t[i].cycle, by);
}

static int by_cycle(const void *a, const void *b) {
    const step *x = a, *y = b;
    return x->cycle < y->cycle ? -1 : x->cycle > y->cycle;
}

/* The level that lasts from behind a cycle to the end of another one. */
static void keep_most(hs_timeline *t, uint32_t fill, uint64_t behind, uint64_t until,
                      uint32_t level) {
    if (level > t->most[fill]) t->most[fill] = level;
    for (uint64_t b = (behind + 1) / t->bucket; b < t->buckets && b * t->bucket <= until; b++)
        if (level > t->fill[fill][b]) t->fill[fill][b] = level;
}

/* Orders the steps, and takes the most of each bucket. False if memory is exhausted. */
static bool fill_from(hs_timeline *t, uint32_t fill, steps *s) {
    if (s->exhausted) return false;
    if (s->count) qsort(s->at, s->count, sizeof *s->at, by_cycle);
    int64_t level = 0;
    for (size_t i = 0; i < s->count; i++) {
        level += s->at[i].by;
        if (i + 1 < s->count && s->at[i + 1].cycle == s->at[i].cycle) continue;
        const uint64_t until = i + 1 < s->count ? s->at[i + 1].cycle : s->at[i].cycle;
        if (level > 0) keep_most(t, fill, s->at[i].cycle, until, (uint32_t)level);
    }
    return true;
}

static bool between(hs_timeline *t, uint32_t fill, uint32_t first, uint32_t second) {
    steps s = {0};
    add_all(&s, hs_timeline_passed(t, first), 1);
    add_all(&s, hs_timeline_passed(t, second), -1);
    const bool good = fill_from(t, fill, &s);
    free(s.at);
    return good;
}

/* Vertices that smooth picks singly are read, divided, written. */
static bool in_smooth(hs_timeline *t) {
    const hs_passed in = hs_timeline_passed(t, HS_PROBE_smooth_in);
    steps s = {0};
    for (size_t i = 0; i < in.count; i++)
        if (in.t[i].word[0] == 0 && in.t[i].word[2] == 0) add(&s, in.t[i].cycle, 1);
    add_all(&s, hs_timeline_passed(t, HS_PROBE_smooth_out), -1);
    const bool good = fill_from(t, HS_FILL_smooth, &s);
    free(s.at);
    return good;
}

/* Pack takes records and gives beats of as many as the port is wide; only the last may be less. */
static bool in_pack(hs_timeline *t) {
    const hs_passed in = hs_timeline_passed(t, HS_PROBE_records);
    const hs_passed out = hs_timeline_passed(t, HS_PROBE_beat_out);
    steps s = {0};
    uint64_t records = 0;
    for (size_t i = 0; i < in.count; i++) {
        const uint32_t count = in.t[i].word[0] % 64;
        add(&s, in.t[i].cycle, (int32_t)count);
        records += count;
    }
    for (size_t i = 0; i < out.count; i++) {
        const uint64_t beat = records < t->source.config.port ? records : t->source.config.port;
        add(&s, out.t[i].cycle, -(int32_t)beat);
        records -= beat;
    }
    const bool good = fill_from(t, HS_FILL_pack, &s);
    free(s.at);
    return good;
}

/* --- The FIFO before emit -----------------------------------------------------------------------
 */

static bool of_faces(const hs_transaction *op) {
    return op->word[0] == HS_OP_FACES || op->word[0] == HS_OP_CORNER;
}

/* Smooth's vertices, in the order in which they come into its lanes. Four of them are a group,
 * which enters a cycle later; at their limits each enters by itself. */
static void vertices_enter(const hs_timeline *t, const hs_timeline_run *run, steps *s) {
    const hs_passed in = hs_timeline_passed(t, HS_PROBE_smooth_in);
    const hs_passed out = hs_timeline_passed(t, HS_PROBE_smooth_out);
    size_t i = hs_passed_from(in, run->begin), o = hs_passed_from(out, run->begin);
    uint32_t waiting = 0;
    for (;;) {
        while (i < in.count && in.t[i].word[0] == 0 && in.t[i].word[2] == 0)
            i++;
        const uint64_t wide = i < in.count ? in.t[i].cycle + 1 : UINT64_MAX;
        const uint64_t single = o < out.count ? out.t[o].cycle : UINT64_MAX;
        const uint64_t cycle = wide < single ? wide : single;
        if (cycle >= run->end) return;
        uint32_t count;
        if (wide <= single) {
            count = in.t[i].word[2] ? in.t[i].word[2] % 8
                                    : (uint32_t)__builtin_popcount(in.t[i].word[1]);
            i++;
        } else {
            count = out.t[o++].word[0] >> 1 & 1;
        }
        waiting += count;
        if (t->source.limit) {
            for (; waiting; waiting--)
                add(s, cycle, 1);
        } else if (waiting >= 4) {
            waiting -= 4;
            add(s, cycle + 1, 1);
        }
    }
}

/* ... and leave it. What is left over of a group goes past the FIFO. */
static void vertices_leave(const hs_timeline *t, const hs_timeline_run *run, steps *s) {
    const hs_passed ops = hs_timeline_passed(t, HS_PROBE_op);
    const uint32_t kind = t->source.limit ? HS_OP_VERTEX : HS_OP_GROUP;
    for (size_t i = hs_passed_from(ops, run->begin); i < ops.count && ops.t[i].cycle < run->end;
         i++)
        if (ops.t[i].word[0] == kind) add(s, ops.t[i].cycle, -1);
}

/* Which items of a split sent faces. An item without children did: itself, or the triangles along
 * its sides. One with children did where a side was kept, or in the last step: its op then has the
 * number of its face's new vertex. In generation 0 the corners of a face share that number; there
 * a corner's only side is kept or replaced, and in the last step sent if it is the lower one. */
typedef struct senders {
    const hs_timeline *t;
    const hs_timeline_run *run;
    hs_passed verdict; /* of guard, in this generation */
    size_t first_verdict;
    bool last; /* the last step, as far as generation 0 shows it */
} senders;

static bool without_children(const hs_transaction *out) {
    return out->word[0] == 0;
}

static bool sends(const senders *s, const hs_transaction *out, const hs_transaction *next_op) {
    if (without_children(out)) return true;
    if (s->run->generation == 0) return s->last && (out->word[0] & out->word[1]);
    if (!next_op) return false;
    const size_t v = s->first_verdict + out->item;
    const uint32_t number = v < s->verdict.count && s->verdict.t[v].cycle < s->run->begin
                                ? s->verdict.t[v].word[2]
                                : s->run->vertices + out->item;
    return next_op->item == number;
}

static const hs_transaction *next_face(hs_passed ops, size_t *at, uint64_t end) {
    while (*at < ops.count && ops.t[*at].cycle < end && !of_faces(&ops.t[*at]))
        (*at)++;
    return *at < ops.count && ops.t[*at].cycle < end ? &ops.t[*at] : NULL;
}

/* The generation that a run of split belongs to begins with its first kick. */
static uint64_t generation_begin(const hs_timeline *t, const hs_timeline_run *run) {
    for (uint32_t g = 0; g < t->generations; g++)
        if (t->generation[g].begin <= run->begin && run->begin < t->generation[g].end)
            return t->generation[g].begin;
    return run->begin;
}

static bool is_last_step(hs_passed out, hs_passed ops, const hs_timeline_run *run) {
    size_t whole = 0, faces = 0;
    for (size_t i = hs_passed_from(out, run->begin); i < out.count && out.t[i].cycle < run->end;
         i++)
        whole += without_children(&out.t[i]);
    for (size_t i = hs_passed_from(ops, run->begin); i < ops.count && ops.t[i].cycle < run->end;
         i++)
        faces += of_faces(&ops.t[i]);
    return faces > whole;
}

static void items_pass(hs_timeline *t, const hs_timeline_run *run, steps *s) {
    const hs_passed out = hs_timeline_passed(t, HS_PROBE_split_out);
    const hs_passed ops = hs_timeline_passed(t, HS_PROBE_op);
    senders w = {.t = t, .run = run, .verdict = hs_timeline_passed(t, HS_PROBE_guard_out)};
    w.first_verdict = hs_passed_from(w.verdict, generation_begin(t, run));
    w.last = run->generation == 0 && is_last_step(out, ops, run);
    size_t op = hs_passed_from(ops, run->begin);
    for (size_t i = hs_passed_from(out, run->begin); i < out.count && out.t[i].cycle < run->end;
         i++) {
        const hs_transaction *next = next_face(ops, &op, run->end);
        if (!next || next->cycle <= out.t[i].cycle || !sends(&w, &out.t[i], next)) continue;
        add(s, out.t[i].cycle, 1);
        add(s, next->cycle, -1);
        t->sent[i] = next->cycle;
        op++;
    }
}

/* Emit's cycles, told one after the other. */
typedef struct emit_walk {
    hs_timeline *t;
    uint32_t run;
    uint64_t blocked_since; /* HS_NO_CYCLE: it is not */
} emit_walk;

static bool tell(emit_walk *w, enum hs_activity activity, uint64_t begin, uint64_t end) {
    hs_timeline *t = w->t;
    if (end <= begin) return true;
    while (w->run < t->runs &&
           (t->run[w->run].stage != HS_STAGE_emit || t->run[w->run].end <= begin))
        w->run++;
    hs_timeline_run *run =
        w->run < t->runs && t->run[w->run].begin <= begin ? &t->run[w->run] : NULL;
    hs_timeline_spend(t, run, HS_STAGE_emit, activity, begin, end);
    const uint64_t since = w->blocked_since;
    if (activity == HS_ACTIVITY_blocked) {
        if (since == HS_NO_CYCLE) w->blocked_since = begin;
        return true;
    }
    w->blocked_since = HS_NO_CYCLE;
    return since == HS_NO_CYCLE ||
           hs_timeline_wait_add(t, HS_STAGE_emit, HS_ACTIVITY_blocked, since, begin);
}

/* Emit is blocked in cycles that see something in the FIFO and in which no op is taken. */
static bool emit_waits(hs_timeline *t, const steps *s) {
    const hs_passed ops = hs_timeline_passed(t, HS_PROBE_op);
    emit_walk w = {.t = t, .blocked_since = HS_NO_CYCLE};
    int64_t level = 0;
    size_t at = 0;
    bool good = true;
    uint64_t seen = ops.count ? ops.t[0].cycle : t->end; /* cycles before it are told */
    for (size_t i = 0; good && i <= ops.count; i++) {
        const uint64_t until = i < ops.count ? ops.t[i].cycle : t->end;
        while (good && seen < until) {
            while (at < s->count && s->at[at].cycle < seen)
                level += s->at[at++].by;
            const uint64_t change = at < s->count ? s->at[at].cycle + 1 : until;
            const uint64_t next = change < until ? change : until;
            good = tell(&w, level > 0 ? HS_ACTIVITY_blocked : HS_ACTIVITY_starved, seen, next);
            seen = next;
        }
        if (i == ops.count || until < seen) continue;
        good = good && tell(&w, HS_ACTIVITY_busy, until, until + 1);
        seen = until + 1;
    }
    return good;
}

static bool before_emit(hs_timeline *t) {
    const hs_passed out = hs_timeline_passed(t, HS_PROBE_split_out);
    steps s = {0};
    t->sent = hs_reallocate(NULL, (out.count + 1) * sizeof *t->sent);
    if (!t->sent) return false;
    for (size_t i = 0; i < out.count; i++)
        t->sent[i] = HS_NO_CYCLE;
    for (uint32_t r = 0; r < t->runs; r++) {
        if (t->run[r].stage == HS_STAGE_smooth) {
            vertices_enter(t, &t->run[r], &s);
            vertices_leave(t, &t->run[r], &s);
        }
        if (t->run[r].stage == HS_STAGE_split) items_pass(t, &t->run[r], &s);
    }
    const bool good = fill_from(t, HS_FILL_ops, &s) && emit_waits(t, &s);
    free(s.at);
    return good;
}

bool hs_timeline_fill_all(hs_timeline *t) {
    return between(t, HS_FILL_transform, HS_PROBE_vertex_in, HS_PROBE_clip) &&
           between(t, HS_FILL_quantize, HS_PROBE_clip, HS_PROBE_quantized) &&
           between(t, HS_FILL_classify, HS_PROBE_classify_in, HS_PROBE_classify_out) &&
           between(t, HS_FILL_select, HS_PROBE_select_in, HS_PROBE_select_out) &&
           between(t, HS_FILL_guard, HS_PROBE_guard_in, HS_PROBE_guard_out) && in_smooth(t) &&
           between(t, HS_FILL_number, HS_PROBE_split_in, HS_PROBE_split_number) &&
           between(t, HS_FILL_split, HS_PROBE_split_number, HS_PROBE_split_out) && in_pack(t) &&
           before_emit(t);
}
