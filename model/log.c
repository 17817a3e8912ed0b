/* SPDX-License-Identifier: Apache-2.0
 *
 * The log of transactions, and the comparison of two.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cycles.h"
#include "memory.h"

void hs_log_clear(hs_log *log) {
    for (uint32_t p = 0; p < HS_PROBES; p++)
        log->probe[p].count = 0;
    log->exhausted = false;
}

void hs_log_free(hs_log *log) {
    for (uint32_t p = 0; p < HS_PROBES; p++)
        free(log->probe[p].transaction);
    *log = (hs_log){0};
}

void hs_log_add(hs_log *log, uint32_t probe, uint64_t cycle, uint32_t item,
                const uint32_t word[4]) {
    if (log->probe[probe].count == log->probe[probe].room) {
        const size_t room = log->probe[probe].room ? 2 * log->probe[probe].room : 4096;
        hs_transaction *more = hs_reallocate(log->probe[probe].transaction,
                                             room * sizeof *log->probe[probe].transaction);
        if (!more) {
            log->exhausted = true;
            return;
        }
        log->probe[probe].transaction = more;
        log->probe[probe].room = room;
    }
    hs_transaction *t = &log->probe[probe].transaction[log->probe[probe].count++];
    t->cycle = cycle;
    t->item = item;
    memcpy(t->word, word, sizeof t->word);
}

static bool equal(const hs_transaction *a, const hs_transaction *b) {
    return a->cycle == b->cycle && a->item == b->item &&
           memcmp(a->word, b->word, sizeof a->word) == 0;
}

static void describe_one(char *text, size_t size, const char *name, const hs_transaction *t) {
    const size_t used = strlen(text);
    if (t)
        snprintf(text + used, size - used,
                 "; %s: cycle %" PRIu64 ", item %" PRIu32 ", %08" PRIx32 " %08" PRIx32 " %08" PRIx32
                 " %08" PRIx32,
                 name, t->cycle, t->item, t->word[0], t->word[1], t->word[2], t->word[3]);
    else
        snprintf(text + used, size - used, "; %s: none", name);
}

/* The first difference of a boundary, which becomes the comparison's if it is the earliest. */
static void note(hs_log_comparison *c, uint32_t probe, size_t at, const hs_transaction *a,
                 const char *a_name, const hs_transaction *b, const char *b_name) {
    const uint64_t cycle = !a                    ? b->cycle
                           : !b                  ? a->cycle
                           : a->cycle < b->cycle ? a->cycle
                                                 : b->cycle;
    if (c->probe != HS_PROBES && c->cycle <= cycle) return;
    c->probe = probe;
    c->cycle = cycle;
    snprintf(c->text, sizeof c->text, "stage %s, %s, transaction %zu",
             hs_stage_name(hs_probe_stage(probe)), hs_probe_name(probe), at);
    describe_one(c->text, sizeof c->text, a_name, a);
    describe_one(c->text, sizeof c->text, b_name, b);
}

hs_log_comparison hs_log_compare(const hs_log *a, const char *a_name, const hs_log *b,
                                 const char *b_name, uint64_t skip) {
    hs_log_comparison c = {.probe = HS_PROBES};
    for (uint32_t p = 0; p < HS_PROBES; p++) {
        if (skip >> p & 1) continue;
        const size_t a_count = a->probe[p].count, b_count = b->probe[p].count;
        const size_t count = a_count > b_count ? a_count : b_count;
        bool noted = false;
        for (size_t i = 0; i < count; i++) {
            const hs_transaction *x = i < a_count ? &a->probe[p].transaction[i] : NULL;
            const hs_transaction *y = i < b_count ? &b->probe[p].transaction[i] : NULL;
            c.compared++;
            if (x && y && equal(x, y)) continue;
            c.different++;
            if (!noted) note(&c, p, i, x, a_name, y, b_name);
            noted = true;
        }
    }
    if (a->exhausted || b->exhausted) {
        c.different++;
        snprintf(c.text, sizeof c.text, "the log is not complete: memory is exhausted");
    }
    return c;
}

static bool same(const char *what, uint64_t a, uint64_t b, char *text, size_t size) {
    if (a == b) return true;
    snprintf(text, size, "%s: %" PRIu64 " and %" PRIu64, what, a, b);
    return false;
}

bool hs_cycle_report_equal(const hs_cycle_report *a, const hs_cycle_report *b, char *text,
                           size_t size) {
    if (!same("cycles", a->cycles, b->cycles, text, size) ||
        !same("start", a->start - a->begin, b->start - b->begin, text, size) ||
        !same("first beat out", a->first_out - a->begin, b->first_out - b->begin, text, size))
        return false;
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        char what[60];
        for (uint32_t k = 0; k < HS_ACTIVITIES; k++) {
            snprintf(what, sizeof what, "%s %s", hs_stage_name(s), hs_activity_name(k));
            if (!same(what, a->activity[s][k], b->activity[s][k], text, size)) return false;
        }
        snprintf(what, sizeof what, "%s items in", hs_stage_name(s));
        if (!same(what, a->items_in[s], b->items_in[s], text, size)) return false;
        snprintf(what, sizeof what, "%s items out", hs_stage_name(s));
        if (!same(what, a->items_out[s], b->items_out[s], text, size)) return false;
    }
    return same("conflicts", a->conflicts, b->conflicts, text, size);
}
