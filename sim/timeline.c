/* SPDX-License-Identifier: Apache-2.0
 *
 * Runs of the stages, generations, and the waits between what a stage took:
 *
 *     kick ─┬─ take ── take ─────── take ─┬─────────── next start
 *           │   busy   busy  blocked busy │  starved
 *
 * The sequencer starts stages one after the other (PROBE kick) and sends two ops of its own, the
 * header and the trailer. So a stage's run ends where the next start is.
 */
#include "timeline_parts.h"

#include <stdlib.h>
#include <string.h>

#include "memory.h"

hs_passed hs_timeline_passed(const hs_timeline *t, uint32_t probe) {
    const hs_log *log = t->source.log;
    if (t->refused && HS_LOG_DATA_OF_REFUSED >> probe & 1) return (hs_passed){0};
    return (hs_passed){log->probe[probe].transaction, log->probe[probe].count};
}

size_t hs_passed_from(hs_passed p, uint64_t cycle) {
    size_t low = 0, high = p.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (p.t[middle].cycle < cycle)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

size_t hs_passed_between(hs_passed p, uint64_t begin, uint64_t end) {
    const size_t from = hs_passed_from(p, begin), to = hs_passed_from(p, end);
    return to > from ? to - from : 0;
}

/* --- Cycles into buckets ------------------------------------------------------------------------
 */

void hs_timeline_spend(hs_timeline *t, hs_timeline_run *run, uint32_t stage,
                       enum hs_activity activity, uint64_t begin, uint64_t end) {
    if (end <= begin) return;
    if (run) run->activity[activity] += end - begin;
    for (uint64_t b = begin / t->bucket; b < t->buckets && b * t->bucket < end; b++) {
        const uint64_t from = b * t->bucket, to = from + t->bucket;
        t->activity[stage][activity][b] +=
            (uint32_t)((end < to ? end : to) - (begin > from ? begin : from));
    }
}

bool hs_timeline_wait_add(hs_timeline *t, uint32_t stage, enum hs_activity activity, uint64_t begin,
                          uint64_t end) {
    if (end < begin + HS_TIMELINE_LEAST_WAIT) {
        t->shorter_waits += end > begin;
        return true;
    }
    if ((t->waits & (t->waits - 1)) == 0) { /* a power of two: full */
        const size_t room = t->waits ? 2 * (size_t)t->waits : 1;
        hs_timeline_wait *more = hs_reallocate(t->wait, room * sizeof *more);
        if (!more) return false;
        t->wait = more;
    }
    t->wait[t->waits++] = (hs_timeline_wait){stage, activity, begin, end};
    return true;
}

/* A stage took nothing from begin to end. */
static bool idle_away(hs_timeline *t, hs_timeline_run *run, enum hs_activity activity,
                      uint64_t begin, uint64_t end) {
    if (end <= begin) return true;
    hs_timeline_spend(t, run, run->stage, activity, begin, end);
    return hs_timeline_wait_add(t, run->stage, activity, begin, end);
}

/* --- A stage's takes ----------------------------------------------------------------------------
 */

static uint32_t probe_of_takes(uint32_t stage) {
    switch (stage) {
    case HS_STAGE_classify:
        return HS_PROBE_classify_in;
    case HS_STAGE_select:
        return HS_PROBE_select_in;
    case HS_STAGE_guard:
        return HS_PROBE_guard_in;
    case HS_STAGE_smooth:
        return HS_PROBE_smooth_in;
    default:
        return HS_PROBE_split_in;
    }
}

/* Rows of marks that smooth passes by before a pick, a cycle each: those between the row of the
 * pick before and its own. next: the first row that has not been looked at. */
static uint64_t rows_before(const hs_timeline_run *run, const hs_transaction *pick, uint32_t banks,
                            uint64_t *next) {
    const uint64_t all = ((uint64_t)run->vertices + banks - 1) / banks;
    const bool fresh = pick->word[2] != 0; /* new vertices are behind all rows */
    const uint64_t row = fresh ? all : pick->item / banks;
    const uint64_t passed = row > *next ? row - *next : 0;
    const uint64_t behind = fresh ? all : row + 1;
    if (behind > *next) *next = behind;
    return passed;
}

/* Fetch shows an item from the cycle behind the one before on: until it is taken it is blocked.
 * In one pass split has none to take until classify hands one on. Smooth looks for vertices. */
static bool take_all(hs_timeline *t, hs_timeline_run *run) {
    const hs_passed takes = hs_timeline_passed(t, probe_of_takes(run->stage));
    const bool follows = run->pass && run->stage == HS_STAGE_split;
    const uint32_t banks = t->source.config.banks ? t->source.config.banks : 1;
    uint64_t at = run->begin + 1, next_row = 0;
    if (t->refused) return true; /* what classify took is not known */
    for (size_t i = hs_passed_from(takes, at); i < takes.count && takes.t[i].cycle < run->end;
         i++) {
        const uint64_t cycle = takes.t[i].cycle;
        uint64_t looked = at;
        if (run->stage == HS_STAGE_smooth)
            looked += rows_before(run, &takes.t[i], banks, &next_row);
        if (looked > cycle || follows) looked = cycle;
        if (follows && !run->activity[HS_ACTIVITY_busy]) at = cycle; /* it was at rest before */
        if (!idle_away(t, run, HS_ACTIVITY_starved, at, looked) ||
            !idle_away(t, run, HS_ACTIVITY_blocked, looked, cycle))
            return false;
        hs_timeline_spend(t, run, run->stage, HS_ACTIVITY_busy, cycle, cycle + 1);
        at = cycle + 1;
    }
    return idle_away(t, run, HS_ACTIVITY_starved, at, run->end);
}

/* --- Runs ---------------------------------------------------------------------------------------
 */

static bool add_run(hs_timeline *t, const hs_timeline_run *run) {
    if ((t->runs & (t->runs - 1)) == 0) {
        const size_t room = t->runs ? 2 * (size_t)t->runs : 1;
        hs_timeline_run *more = hs_reallocate(t->run, room * sizeof *more);
        if (!more) return false;
        t->run = more;
    }
    t->run[t->runs++] = *run;
    return true;
}

/* The sequencer's next start behind a kick. */
static uint64_t next_start(const hs_timeline *t, size_t kick) {
    const hs_passed kicks = hs_timeline_passed(t, HS_PROBE_kick);
    const hs_passed ops = hs_timeline_passed(t, HS_PROBE_op);
    const uint64_t begin = kicks.t[kick].cycle;
    uint64_t next = t->end;
    for (size_t i = kick + 1; i < kicks.count; i++)
        if (kicks.t[i].cycle > begin) {
            if (kicks.t[i].cycle < next) next = kicks.t[i].cycle;
            break;
        }
    /* Its own ops are the first one and the last one. */
    for (size_t i = 0; i<ops.count; i += ops.count> 1 ? ops.count - 1 : 1) {
        const uint32_t kind = ops.t[i].word[0];
        if ((kind == HS_OP_HEADER || kind == HS_OP_TRAILER) && ops.t[i].cycle > begin &&
            ops.t[i].cycle < next)
            next = ops.t[i].cycle;
    }
    return next > begin ? next : begin + 1;
}

/* The stages of the generations: each kick starts one, or classify and split. */
static bool run_stages(hs_timeline *t) {
    const hs_passed kicks = hs_timeline_passed(t, HS_PROBE_kick);
    for (size_t i = 0; i < kicks.count; i++) {
        const hs_transaction *kick = &kicks.t[i];
        const uint32_t started = kick->word[3] & ((1u << (HS_STAGE_emit - HS_STAGE_classify)) - 1);
        for (uint32_t bit = 0; started >> bit; bit++) {
            if (!(started >> bit & 1)) continue;
            const hs_timeline_run run = {.stage = HS_STAGE_classify + bit,
                                         .generation = kick->word[0],
                                         .begin = kick->cycle,
                                         .end = next_start(t, i),
                                         .items = kick->word[1],
                                         .vertices = kick->word[2],
                                         .pass = (started & (started - 1)) != 0};
            if (!add_run(t, &run) || !take_all(t, &t->run[t->runs - 1])) return false;
        }
    }
    return true;
}

/* Receive takes a record a cycle, from the cycle behind its beat on. */
static bool run_receive(hs_timeline *t) {
    const hs_passed beats = hs_timeline_passed(t, HS_PROBE_beat_in);
    if (!beats.count) return true;
    if (!add_run(t, &(hs_timeline_run){.stage = HS_STAGE_receive,
                                       .begin = beats.t[0].cycle,
                                       .items = (uint32_t)beats.count}))
        return false;
    hs_timeline_run *run = &t->run[t->runs - 1];
    uint64_t at = run->begin + 1;
    for (size_t i = 0; i < beats.count; i++) {
        const uint64_t from = beats.t[i].cycle + 1, to = from + beats.t[i].word[0] % 64;
        if (!idle_away(t, run, HS_ACTIVITY_starved, at, from)) return false;
        hs_timeline_spend(t, run, HS_STAGE_receive, HS_ACTIVITY_busy, from, to);
        at = to;
    }
    run->end = at > run->begin ? at : run->begin + 1;
    return true;
}

/* Transform is at work while vertices fly in it. */
static bool run_transform(hs_timeline *t) {
    const hs_passed in = hs_timeline_passed(t, HS_PROBE_vertex_in);
    const hs_passed out = hs_timeline_passed(t, HS_PROBE_clip);
    if (!in.count) return true;
    if (!add_run(t, &(hs_timeline_run){.stage = HS_STAGE_transform,
                                       .begin = in.t[0].cycle,
                                       .items = (uint32_t)in.count}))
        return false;
    hs_timeline_run *run = &t->run[t->runs - 1];
    uint64_t at = run->begin, flown = at;
    for (size_t i = 0; i < in.count; i++) {
        const uint64_t cycle = in.t[i].cycle, landed = i < out.count ? out.t[i].cycle + 2 : cycle;
        if (!idle_away(t, run, HS_ACTIVITY_starved, at, flown < cycle ? flown : cycle))
            return false;
        hs_timeline_spend(t, run, HS_STAGE_transform, HS_ACTIVITY_busy, cycle, cycle + 1);
        at = cycle + 1;
        flown = landed > at ? landed : at;
    }
    run->end = flown;
    return idle_away(t, run, HS_ACTIVITY_starved, at, flown);
}

/* Quantize is seen where it writes. */
static bool run_quantize(hs_timeline *t) {
    const hs_passed out = hs_timeline_passed(t, HS_PROBE_quantized);
    if (!out.count) return true;
    if (!add_run(t, &(hs_timeline_run){.stage = HS_STAGE_quantize,
                                       .begin = out.t[0].cycle,
                                       .end = out.t[out.count - 1].cycle + 1,
                                       .items = (uint32_t)out.count}))
        return false;
    for (size_t i = 0; i < out.count; i++)
        hs_timeline_spend(t, &t->run[t->runs - 1], HS_STAGE_quantize, HS_ACTIVITY_busy,
                          out.t[i].cycle, out.t[i].cycle + 1);
    return true;
}

/* What emit takes: the sequencer's header and trailer, and what smooth and split send, each an
 * interval from its first op to the one behind its last; behind the trailer to the last beat. */
static bool run_emit(hs_timeline *t) {
    const hs_passed ops = hs_timeline_passed(t, HS_PROBE_op);
    const uint32_t others = t->runs;
    for (size_t i = 0; i < ops.count;) {
        const bool trailer = ops.t[i].word[0] == HS_OP_TRAILER;
        hs_timeline_run run = {
            .stage = HS_STAGE_emit, .begin = ops.t[i].cycle, .end = ops.t[i].cycle + 1};
        uint64_t until = run.end;
        for (uint32_t k = 0; k < others; k++)
            if (t->run[k].begin <= run.begin && run.begin < t->run[k].end) {
                if (t->run[k].stage != HS_STAGE_smooth && t->run[k].stage != HS_STAGE_split)
                    continue;
                until = t->run[k].end;
                run.generation = t->run[k].generation;
            }
        for (; i < ops.count && (run.items == 0 || ops.t[i].cycle < until); i++, run.items++)
            run.end = ops.t[i].cycle + 1;
        if (trailer && t->end > run.end) run.end = t->end;
        if (!add_run(t, &run)) return false;
    }
    return true;
}

/* --- Generations --------------------------------------------------------------------------------
 */

static uint32_t count_set(hs_passed p, uint64_t begin, uint64_t end) {
    uint32_t count = 0;
    for (size_t i = hs_passed_from(p, begin); i < p.count && p.t[i].cycle < end; i++)
        count += p.t[i].word[0] & 1;
    return count;
}

bool hs_timeline_stopped_in(const hs_timeline *t, uint32_t generation) {
    return t->source.status == HS_STATUS_STOPPED && generation + 1 == t->generations;
}

/* Where guard has no say, all items are refined or none: those that have children. */
static uint32_t count_replaced(const hs_timeline *t, uint64_t begin, uint64_t end) {
    const hs_passed p = hs_timeline_passed(t, HS_PROBE_split_out);
    uint32_t count = 0;
    for (size_t i = hs_passed_from(p, begin); i < p.count && p.t[i].cycle < end; i++)
        count += p.t[i].word[0] != 0;
    return count;
}

static bool find_generations(hs_timeline *t) {
    for (uint32_t r = 0; r < t->runs; r++) {
        const hs_timeline_run *run = &t->run[r];
        if (run->stage < HS_STAGE_classify || run->stage == HS_STAGE_emit) continue;
        hs_timeline_generation *last = t->generations ? &t->generation[t->generations - 1] : NULL;
        if (last && last->number == run->generation) {
            if (run->end > last->end) last->end = run->end;
            continue;
        }
        hs_timeline_generation *more =
            hs_reallocate(t->generation, (t->generations + (size_t)1) * sizeof *more);
        if (!more) return false;
        t->generation = more;
        more[t->generations++] = (hs_timeline_generation){.number = run->generation,
                                                          .begin = run->begin,
                                                          .end = run->end,
                                                          .items = run->items,
                                                          .vertices = run->vertices};
    }
    for (uint32_t g = 0; g < t->generations; g++) {
        hs_timeline_generation *of = &t->generation[g];
        if (g + 1 < t->generations) of->end = t->generation[g + 1].begin;
        of->selected = count_set(hs_timeline_passed(t, HS_PROBE_select_face), of->begin, of->end);
        of->refined = (uint32_t)hs_passed_between(hs_timeline_passed(t, HS_PROBE_guard_new),
                                                  of->begin, of->end);
        if (!of->refined || hs_timeline_stopped_in(t, g))
            of->refined = count_replaced(t, of->begin, of->end);
        of->ops =
            (uint32_t)hs_passed_between(hs_timeline_passed(t, HS_PROBE_op), of->begin, of->end);
    }
    return true;
}

/* --- The whole ----------------------------------------------------------------------------------
 */

static int by_begin(const void *a, const void *b) {
    const hs_timeline_run *x = a, *y = b;
    if (x->begin != y->begin) return x->begin < y->begin ? -1 : 1;
    return x->stage < y->stage ? -1 : x->stage > y->stage;
}

static int wait_by_begin(const void *a, const void *b) {
    const hs_timeline_wait *x = a, *y = b;
    if (x->begin != y->begin) return x->begin < y->begin ? -1 : 1;
    return x->stage < y->stage ? -1 : x->stage > y->stage;
}

/* Leaves out the shorter waits, until there are few enough. */
static void thin_waits(hs_timeline *t) {
    t->least_wait = HS_TIMELINE_LEAST_WAIT;
    while (t->waits > HS_TIMELINE_WAITS) {
        uint32_t kept = 0;
        t->least_wait *= 2;
        for (uint32_t i = 0; i < t->waits; i++)
            if (t->wait[i].end - t->wait[i].begin >= t->least_wait) t->wait[kept++] = t->wait[i];
        t->shorter_waits += t->waits - kept;
        t->waits = kept;
    }
}

static bool make_buckets(hs_timeline *t) {
    t->bucket = 1;
    while (t->end / t->bucket >= HS_TIMELINE_BUCKETS)
        t->bucket *= 2;
    t->buckets = (uint32_t)(t->end / t->bucket + 1);
    for (uint32_t s = 0; s < HS_STAGES; s++)
        for (uint32_t a = 0; a < HS_ACTIVITY_idle; a++) {
            t->activity[s][a] = calloc(t->buckets, sizeof *t->activity[s][a]);
            if (!t->activity[s][a]) return false;
        }
    for (uint32_t f = 0; f < HS_FILLS; f++) {
        t->fill[f] = calloc(t->buckets, sizeof *t->fill[f]);
        if (!t->fill[f]) return false;
    }
    return true;
}

bool hs_timeline_make(hs_timeline *t, const hs_timeline_source *source, hs_error *err) {
    const hs_cycle_report *c = source->cycles;
    *t = (hs_timeline){.source = *source, .refused = source->status > HS_STATUS_STOPPED};
    t->start = c->start > c->begin ? c->start - c->begin : 0;
    t->end = c->end > c->begin ? c->end - c->begin + 1 : 1;
    if (source->log->exhausted || !make_buckets(t) || !run_receive(t) || !run_transform(t) ||
        !run_quantize(t) || !run_stages(t) || !find_generations(t) || !run_emit(t) ||
        !hs_timeline_fill_all(t))
        return hs_fail(err, HS_EXIT_INTERNAL, "view %u: no memory for its timeline", source->view);
    if (t->runs) qsort(t->run, t->runs, sizeof *t->run, by_begin);
    if (t->waits) qsort(t->wait, t->waits, sizeof *t->wait, wait_by_begin);
    thin_waits(t);
    return true;
}

void hs_timeline_free(hs_timeline *t) {
    for (uint32_t s = 0; s < HS_STAGES; s++)
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++)
            free(t->activity[s][a]);
    for (uint32_t f = 0; f < HS_FILLS; f++)
        free(t->fill[f]);
    free(t->generation);
    free(t->run);
    free(t->wait);
    free(t->sent);
    *t = (hs_timeline){0};
}

uint64_t hs_timeline_length(const hs_timeline *t) {
    return t->end + HS_TIMELINE_GAP;
}
