/* SPDX-License-Identifier: Apache-2.0
 *
 * A thread takes what is run together, a point or all views of an architecture that has several in
 * flight, runs it, and adds its rows to the journal.
 */
#include "explore_work.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "progress.h"

typedef struct workers {
    hs_exploration *e;
    pthread_mutex_t lock;  /* of what follows, of rows and journal */
    uint64_t next, number; /* of the next run: its point, and itself */
    uint64_t done, done_before;
    hs_progress progress;
    bool failed;
    hs_error err;
} workers;

/* What a thread keeps from run to run. */
typedef struct engine {
    hs_model_config config;
    hs_model *model;
    hs_packet out;
} engine;

/* --- What is to be done -------------------------------------------------------------------------
 */

/* Points that are run together: the first one, and how many. */
typedef struct run {
    uint64_t first;
    uint32_t count;
} run;

static run run_at(const hs_exploration *e, uint64_t point) {
    const bool together = hs_explore_config(&e->space, point).views > 1;
    return (run){point, together ? e->space.views : 1};
}

static bool all_done(const hs_exploration *e, run r) {
    for (uint32_t i = 0; i < r.count; i++)
        if (!e->row[r.first + i].done) return false;
    return true;
}

/* Runs are dealt to the shards in turn. */
static bool is_mine(const hs_exploration *e, uint64_t number) {
    return number % e->shards == e->shard - 1;
}

static void count_points(workers *w) {
    hs_exploration *e = w->e;
    uint64_t number = 0;
    run r;
    e->mine = 0;
    for (uint64_t point = 0; point < e->points; point += r.count) {
        r = run_at(e, point);
        if (!is_mine(e, number++)) continue;
        e->mine += r.count;
        for (uint32_t i = 0; i < r.count; i++)
            w->done += e->row[point + i].done;
    }
    w->done_before = w->done;
}

/* The next run that is not done; false if there is none. Under the lock. */
static bool take_run(workers *w, run *r) {
    const hs_exploration *e = w->e;
    bool found = false;
    while (!w->failed && !found && w->next < e->points) {
        *r = run_at(e, w->next);
        w->next += r->count;
        found = is_mine(e, w->number++) && !all_done(e, *r);
    }
    return found;
}

/* --- A run --------------------------------------------------------------------------------------
 */
static uint64_t latency(const hs_model *model, const hs_cycle_report *c, const hs_packet *out,
                        uint32_t kind) {
    const size_t at = hs_packet_find(out, kind);
    return at == SIZE_MAX ? HS_NO_CYCLE : c->begin + hs_model_word_cycle(model, at) - c->start;
}

static void fill_row(const hs_exploration *e, uint64_t point, const hs_model *model,
                     const hs_packet *out, const hs_golden_report *report, const hs_cycle_report *c,
                     hs_explore_row *row) {
    const hs_packet *in = &e->packet[hs_explore_view(&e->space, point)];
    const hs_bound bound =
        hs_bound_of(e->settings, e->depth, report->generation, report->generations,
                    e->mesh.vertices, in->words, out->words);
    const hs_model_traffic traffic = hs_model_traffic_of(model);
    uint64_t *v = row->value;
    row->done = true;
    v[HS_EXPLORE_POINT] = point;
    v[HS_EXPLORE_STATUS] = report->status;
    v[HS_EXPLORE_FACES] = report->faces;
    v[HS_EXPLORE_VERTICES] = report->vertices;
    v[HS_EXPLORE_CYCLES] = c->cycles;
    v[HS_EXPLORE_BOUND] = bound.total;
    v[HS_EXPLORE_FIRST_FACE] = latency(model, c, out, HS_RECORD_FACE);
    v[HS_EXPLORE_TRAILER] = latency(model, c, out, HS_RECORD_TRAILER);
    v[HS_EXPLORE_CONFLICTS] = c->conflicts;
    v[HS_EXPLORE_READ] = traffic.read;
    v[HS_EXPLORE_WRITTEN] = traffic.written;
    for (uint32_t s = 0; s < HS_STAGES; s++)
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++)
            v[HS_EXPLORE_ACTIVITY + s * HS_ACTIVITIES + a] = c->activity[s][a];
}

/* A view alone. */
static bool run_point(const hs_exploration *e, engine *n, uint64_t point, hs_explore_row *row,
                      hs_error *err) {
    const hs_model_config wanted = hs_explore_config(&e->space, point);
    if (!n->model || memcmp(&wanted, &n->config, sizeof wanted) != 0) {
        hs_model_free(n->model);
        n->config = wanted;
        n->model = hs_model_new(e->limits, wanted, err);
    }
    const hs_stalls none = {0};
    hs_golden_report report;
    hs_cycle_report c;
    if (!n->model || !hs_model_run(n->model, &e->packet[hs_explore_view(&e->space, point)], none,
                                   &n->out, &report, &c, NULL, err))
        return false;
    fill_row(e, point, n->model, &n->out, &report, &c, row);
    return true;
}

typedef struct stream {
    const hs_exploration *e;
    uint64_t first; /* point */
    hs_packet *out;
    hs_golden_report *report;
    hs_flight_view *at;
    hs_explore_row *row;
} stream;

static void view_done(void *context, uint32_t view, const hs_model *model,
                      const hs_cycle_report *cycles) {
    const stream *s = context;
    fill_row(s->e, s->first + view, model, &s->out[view], &s->report[view], cycles, &s->row[view]);
    hs_packet_free(&s->out[view]); /* of many views, few are held at a time */
}

/* All views in a row. */
static bool run_stream(const hs_exploration *e, uint64_t first, hs_explore_row *row,
                       hs_error *err) {
    const uint32_t views = e->space.views;
    const hs_stalls none = {0};
    stream s = {.e = e,
                .first = first,
                .out = calloc(views, sizeof *s.out),
                .report = calloc(views, sizeof *s.report),
                .at = calloc(views, sizeof *s.at),
                .row = row};
    uint64_t cycles = 0;
    hs_flight *flight = NULL;
    bool good = false;
    if (s.out && s.report && s.at)
        flight = hs_flight_new(e->limits, hs_explore_config(&e->space, first), err);
    else
        hs_fail(err, HS_EXIT_INTERNAL, "no memory for %u views in a row", views);
    if (flight) {
        hs_flight_observe(flight, view_done, &s);
        good = hs_flight_run(flight, e->packet, views, none, s.out, s.report, s.at, &cycles, NULL,
                             err);
    }
    for (uint32_t v = 0; v < views; v++) {
        row[v].value[HS_EXPLORE_STREAM] = cycles;
        if (s.out) hs_packet_free(&s.out[v]);
    }
    hs_flight_free(flight);
    free(s.out);
    free(s.report);
    free(s.at);
    return good;
}

/* --- Workers ------------------------------------------------------------------------------------
 */
static void show_progress(workers *w) {
    hs_progress_count(&w->progress, w->done, w->done - w->done_before, w->e->mine, "points");
}

/* Behind a run. Under the lock. */
static void keep_rows(workers *w, const run *r, const hs_explore_row *row, bool good,
                      const hs_error *why) {
    hs_exploration *e = w->e;
    if (!good && !w->failed) {
        w->failed = true;
        w->err = *why;
    }
    for (uint32_t i = 0; i < r->count && !w->failed; i++) {
        if (e->row[r->first + i].done) continue;
        if (!hs_explore_journal_add(&e->journal, &row[i], &w->err)) {
            w->failed = true;
            return;
        }
        e->row[r->first + i] = row[i];
        w->done++;
    }
    if (!w->failed) show_progress(w);
}

static void *work(void *context) {
    workers *w = context;
    engine n = {0};
    run r;
    pthread_mutex_lock(&w->lock);
    while (take_run(w, &r)) {
        pthread_mutex_unlock(&w->lock);
        hs_error err = {0};
        hs_explore_row *row = calloc(r.count, sizeof *row);
        const bool good = row ? (hs_explore_config(&w->e->space, r.first).views == 1
                                     ? run_point(w->e, &n, r.first, row, &err)
                                     : run_stream(w->e, r.first, row, &err))
                              : hs_fail(&err, HS_EXIT_INTERNAL, "no memory for %u points", r.count);
        pthread_mutex_lock(&w->lock);
        keep_rows(w, &r, row, good, &err);
        free(row);
    }
    pthread_mutex_unlock(&w->lock);
    hs_model_free(n.model);
    hs_packet_free(&n.out);
    return NULL;
}

bool hs_explore_work(hs_exploration *e, uint32_t jobs, bool quiet, hs_error *err) {
    enum { MOST = 1024 };
    pthread_t thread[MOST];
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    workers w = {.e = e, .lock = PTHREAD_MUTEX_INITIALIZER};
    uint32_t started = 0;
    if (!jobs) jobs = cores > 0 ? (uint32_t)cores : 1;
    if (jobs > MOST) jobs = MOST;
    count_points(&w);
    if (jobs > e->mine - w.done) jobs = (uint32_t)(e->mine - w.done);
    hs_progress_start(&w.progress, quiet);
    while (started < jobs && pthread_create(&thread[started], NULL, work, &w) == 0)
        started++;
    if (jobs && !started) work(&w);
    for (uint32_t i = 0; i < started; i++)
        pthread_join(thread[i], NULL);
    hs_progress_clear(&w.progress);
    if (w.failed) *err = w.err;
    return !w.failed;
}
