/* SPDX-License-Identifier: Apache-2.0
 *
 * A timeline for Konata: each quad of a generation is an instruction, in generation 0 each corner.
 *
 *   Wr        Cl        Se        Gu        Sp  Nu   Em
 *   written   classify  select    guard     split    FIFO before emit
 *
 * Wr is from its first half's write to behind its second one's. Between two stages its record lies
 * in the memory, and the line is empty. Smooth works on vertices: it is not in a quad's line.
 *
 * All that happens is collected as marks, ordered by cycle, and told.
 */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "timeline_parts.h"

enum { WRITTEN, CLASSIFY, SELECT, GUARD, SPLIT, NUMBERED, EMIT, PARTS };
static const char *const PART_NAME[PARTS] = {"Wr", "Cl", "Se", "Gu", "Sp", "Nu", "Em"};

/* One instruction: when it was in each part of the way; begin HS_NO_CYCLE: never. */
typedef struct quad {
    uint64_t begin[PARTS], end[PARTS];
    uint32_t generation, number;
    uint32_t vertex[4];
    bool known, refined, selected, verdict;
    uint64_t born, gone;
} quad;

typedef struct quads {
    quad *of; /* generation by generation */
    size_t count;
} quads;

/* --- A generation's quads -----------------------------------------------------------------------
 */

static void begin_all(quads *q, size_t first, hs_passed p, uint64_t from, uint64_t to, int part) {
    for (size_t i = hs_passed_from(p, from); i < p.count && p.t[i].cycle < to; i++)
        if (p.t[i].item < q->count - first) q->of[first + p.t[i].item].begin[part] = p.t[i].cycle;
}

static void end_all(quads *q, size_t first, hs_passed p, uint64_t from, uint64_t to, int part) {
    for (size_t i = hs_passed_from(p, from); i < p.count && p.t[i].cycle < to; i++)
        if (p.t[i].item < q->count - first) q->of[first + p.t[i].item].end[part] = p.t[i].cycle;
}

static void name_all(quads *q, size_t first, hs_passed p, uint64_t from, uint64_t to) {
    for (size_t i = hs_passed_from(p, from); i < p.count && p.t[i].cycle < to; i++) {
        if (p.t[i].item >= q->count - first) continue;
        quad *of = &q->of[first + p.t[i].item];
        memcpy(of->vertex, p.t[i].word, sizeof of->vertex);
        of->known = true;
    }
}

/* Both halves of a quad are written by the split of the generation before; half-quads have one. */
static void born_of(quads *q, size_t first, hs_passed p, uint64_t from, uint64_t to) {
    for (size_t i = hs_passed_from(p, from); i < p.count && p.t[i].cycle < to; i++)
        for (int k = 0; k < 4; k++) {
            const uint32_t number = p.t[i].word[k];
            if (number >= q->count - first) continue;
            quad *of = &q->of[first + number];
            const uint64_t cycle = p.t[i].cycle;
            if (of->begin[WRITTEN] == HS_NO_CYCLE || cycle < of->begin[WRITTEN])
                of->begin[WRITTEN] = cycle;
            if (of->end[WRITTEN] == HS_NO_CYCLE || cycle >= of->end[WRITTEN])
                of->end[WRITTEN] = cycle + 1;
        }
}

static void judge_all(quads *q, size_t first, const hs_timeline *t, uint32_t g) {
    const uint64_t from = t->generation[g].begin, to = t->generation[g].end;
    const hs_passed verdict = hs_timeline_passed(t, HS_PROBE_guard_out);
    for (size_t i = hs_passed_from(verdict, from); i < verdict.count && verdict.t[i].cycle < to;
         i++) {
        if (verdict.t[i].item >= q->count - first) continue;
        quad *of = &q->of[first + verdict.t[i].item];
        of->verdict = true;
        of->refined = verdict.t[i].word[0] & 1 && !hs_timeline_stopped_in(t, g);
        of->selected = verdict.t[i].word[1] & 1;
    }
    const hs_passed out = hs_timeline_passed(t, HS_PROBE_split_out);
    for (size_t i = hs_passed_from(out, from); i < out.count && out.t[i].cycle < to; i++) {
        if (out.t[i].item >= q->count - first) continue;
        quad *of = &q->of[first + out.t[i].item];
        of->refined = of->refined || out.t[i].word[0];
        if (t->sent[i] == HS_NO_CYCLE) continue;
        of->begin[EMIT] = out.t[i].cycle;
        of->end[EMIT] = t->sent[i];
    }
}

static bool add_generation(quads *q, const hs_timeline *t, uint32_t g) {
    const hs_timeline_generation *of = &t->generation[g];
    const uint64_t from = of->begin, to = of->end;
    const size_t first = q->count;
    /* No more than split takes: a log that makes no sense may claim any number. */
    const hs_passed takes = hs_timeline_passed(t, HS_PROBE_split_in);
    const size_t taken = hs_passed_between(takes, from, to);
    const size_t count = of->items < taken ? of->items : taken;
    if (!count) return true;
    quad *more = hs_reallocate(q->of, (first + count) * sizeof *more);
    if (!more) return false;
    q->of = more;
    q->count += count;
    for (size_t i = first; i < q->count; i++) {
        q->of[i] = (quad){.generation = of->number, .number = (uint32_t)(i - first)};
        for (int p = 0; p < PARTS; p++)
            q->of[i].begin[p] = q->of[i].end[p] = HS_NO_CYCLE;
    }
    static const struct {
        int part;
        uint32_t in, out;
    } part[] = {{CLASSIFY, HS_PROBE_classify_in, HS_PROBE_classify_out},
                {SELECT, HS_PROBE_select_in, HS_PROBE_select_out},
                {GUARD, HS_PROBE_guard_in, HS_PROBE_guard_out},
                {SPLIT, HS_PROBE_split_in, HS_PROBE_split_number},
                {NUMBERED, HS_PROBE_split_number, HS_PROBE_split_out}};
    for (size_t i = 0; i < sizeof part / sizeof *part; i++) {
        begin_all(q, first, hs_timeline_passed(t, part[i].in), from, to, part[i].part);
        end_all(q, first, hs_timeline_passed(t, part[i].out), from, to, part[i].part);
    }
    name_all(q, first, takes, from, to);
    judge_all(q, first, t, g);
    if (g == 0) {
        const hs_passed corners = hs_timeline_passed(t, HS_PROBE_corner_in);
        begin_all(q, first, corners, 0, from, WRITTEN);
        for (size_t i = first; i < q->count; i++)
            if (q->of[i].begin[WRITTEN] != HS_NO_CYCLE)
                q->of[i].end[WRITTEN] = q->of[i].begin[WRITTEN] + 1;
    } else {
        const uint64_t before = t->generation[g - 1].begin;
        born_of(q, first, hs_timeline_passed(t, HS_PROBE_split_lower), before, from);
        born_of(q, first, hs_timeline_passed(t, HS_PROBE_split_upper), before, from);
    }
    return true;
}

/* From the first to the last thing known of it; parts of which half is known are dropped. */
static void span(quad *q) {
    q->born = q->gone = HS_NO_CYCLE;
    for (int p = 0; p < PARTS; p++) {
        if (q->begin[p] == HS_NO_CYCLE || q->end[p] == HS_NO_CYCLE || q->end[p] < q->begin[p]) {
            q->begin[p] = HS_NO_CYCLE;
            continue;
        }
        if (q->born == HS_NO_CYCLE || q->begin[p] < q->born) q->born = q->begin[p];
        if (q->gone == HS_NO_CYCLE || q->end[p] > q->gone) q->gone = q->end[p];
    }
}

static int by_birth(const void *a, const void *b) {
    const quad *x = a, *y = b;
    if (x->born != y->born) return x->born < y->born ? -1 : 1;
    if (x->generation != y->generation) return x->generation < y->generation ? -1 : 1;
    return x->number < y->number ? -1 : x->number > y->number;
}

/* --- Marks --------------------------------------------------------------------------------------
 *
 * Within a cycle: a quad's own marks in the order of its way, each part's end before the next one's
 * begin; a begin before its own end.
 */
enum { APPEARS = 0, FIRST_PART = 1, LEAVES = FIRST_PART + 2 * PARTS };

typedef struct mark {
    uint64_t cycle;
    uint32_t quad, what;
} mark;

static int by_cycle(const void *a, const void *b) {
    const mark *x = a, *y = b;
    if (x->cycle != y->cycle) return x->cycle < y->cycle ? -1 : 1;
    if (x->quad != y->quad) return x->quad < y->quad ? -1 : 1;
    return x->what < y->what ? -1 : x->what > y->what;
}

static mark *marks_of(const quads *q, size_t *count) {
    mark *m = hs_reallocate(NULL, (q->count + 1) * (LEAVES + 1) * sizeof *m);
    *count = 0;
    if (!m) return NULL;
    for (uint32_t i = 0; i < q->count; i++) {
        const quad *of = &q->of[i];
        if (of->born == HS_NO_CYCLE) continue;
        m[(*count)++] = (mark){of->born, i, APPEARS};
        for (uint32_t p = 0; p < PARTS; p++) {
            if (of->begin[p] == HS_NO_CYCLE) continue;
            m[(*count)++] = (mark){of->begin[p], i, FIRST_PART + 2 * p};
            m[(*count)++] = (mark){of->end[p], i, FIRST_PART + 2 * p + 1};
        }
        m[(*count)++] = (mark){of->gone, i, LEAVES};
    }
    qsort(m, *count, sizeof *m, by_cycle);
    return m;
}

/* --- The file -----------------------------------------------------------------------------------
 */

static void tell_birth(hs_timeline_kanata *k, const quad *q, uint64_t id, uint32_t view) {
    const bool half = q->generation && q->vertex[3] == UINT32_MAX;
    fprintf(k->file,
            "I\t%" PRIu64 "\t%u\t%u\nL\t%" PRIu64 "\t0\tview %u, generation %u, %s %u:", id,
            q->number, view, id, view, q->generation,
            q->generation == 0 ? "corner"
            : half             ? "half-quad"
                               : "quad",
            q->number);
    for (int i = 0; q->known && i < 4; i++)
        if (q->vertex[i] != UINT32_MAX) fprintf(k->file, " %u", q->vertex[i]);
    fprintf(k->file, "\nL\t%" PRIu64 "\t1\t%s%s\n", id,
            !q->verdict   ? ""
            : q->selected ? "selected, "
                          : "not selected, ",
            q->refined ? "refined" : "final");
}

static void tell(hs_timeline_kanata *k, const quad *q, const mark *m, uint64_t id, uint32_t view,
                 uint64_t *retired) {
    if (m->what == APPEARS) {
        tell_birth(k, q, id, view);
    } else if (m->what == LEAVES) {
        fprintf(k->file, "R\t%" PRIu64 "\t%" PRIu64 "\t0\n", id, (*retired)++);
    } else {
        const uint32_t part = (m->what - FIRST_PART) / 2;
        fprintf(k->file, "%c\t%" PRIu64 "\t0\t%s\n", (m->what - FIRST_PART) % 2 ? 'E' : 'S', id,
                PART_NAME[part]);
    }
}

void hs_timeline_kanata_begin(hs_timeline_kanata *k, FILE *file) {
    *k = (hs_timeline_kanata){.file = file};
    fputs("Kanata\t0004\nC=\t0\n", file);
}

bool hs_timeline_kanata_view(hs_timeline_kanata *k, const hs_timeline *t, hs_error *err) {
    quads q = {0};
    bool good = true;
    size_t count = 0;
    for (uint32_t g = 0; good && g < t->generations; g++)
        good = add_generation(&q, t, g);
    size_t living = 0;
    for (size_t i = 0; i < q.count; i++) {
        span(&q.of[i]);
        living += q.of[i].born != HS_NO_CYCLE;
    }
    if (q.count) qsort(q.of, q.count, sizeof *q.of, by_birth);
    mark *mark = good ? marks_of(&q, &count) : NULL;
    uint64_t retired = k->quads;
    for (size_t i = 0; mark && i < count; i++) {
        const uint64_t cycle = k->offset + mark[i].cycle;
        if (cycle > k->at) fprintf(k->file, "C\t%" PRIu64 "\n", cycle - k->at);
        if (cycle > k->at) k->at = cycle;
        tell(k, &q.of[mark[i].quad], &mark[i], k->quads + mark[i].quad, t->source.view, &retired);
    }
    good = mark != NULL;
    k->quads += living;
    k->offset += hs_timeline_length(t);
    free(mark);
    free(q.of);
    return good || hs_fail(err, HS_EXIT_INTERNAL, "no memory for the timeline's quads");
}
