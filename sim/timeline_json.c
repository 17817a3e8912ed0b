/* SPDX-License-Identifier: Apache-2.0
 *
 * A timeline in the trace-event format: one process, a thread a track.
 *
 *   views        one slice a view
 *   generations  one a generation
 *   receive ...  a slice a run of the stage; within it, waits of some cycles
 *
 * Counters: what waits at each boundary, and what each stage did, in per cent of the cycles of a
 * bucket. Events of a file are in the order of time; of those that begin together, that of the
 * longer slice is first, since runs are made before their waits: slices nest as they are read.
 */
#include <jansson.h>
#include <stdlib.h>

#include "memory.h"
#include "timeline.h"

enum { PROCESS = 1, TRACK_VIEWS = 10, TRACK_GENERATIONS = 11, TRACK_STAGES = 12 };

/* --- Events -------------------------------------------------------------------------------------
 */

typedef struct event {
    uint64_t at;
    uint32_t number; /* in the order in which they were made */
    json_t *json;
} event;

typedef struct events {
    event *event;
    size_t count, room;
    bool exhausted;
} events;

static void add(events *e, uint64_t at, json_t *json) {
    if (e->count == e->room) {
        const size_t room = e->room ? 2 * e->room : 1024;
        event *more = hs_reallocate(e->event, room * sizeof *more);
        if (more) {
            e->event = more;
            e->room = room;
        }
    }
    if (!json || e->count == e->room) {
        json_decref(json);
        e->exhausted = true;
        return;
    }
    e->event[e->count] = (event){at, (uint32_t)e->count, json};
    e->count++;
}

/* args is taken over. */
static void add_slice(events *e, uint32_t track, const char *name, uint64_t begin, uint64_t end,
                      uint64_t offset, json_t *args) {
    const uint64_t length = end > begin ? end - begin : 0;
    if (!length) {
        json_decref(args);
        return;
    }
    add(e, begin + offset,
        json_pack("{s:s,s:s,s:i,s:i,s:I,s:I,s:o}", "name", name, "ph", "X", "pid", PROCESS, "tid",
                  (int)track, "ts", (json_int_t)(begin + offset), "dur", (json_int_t)length, "args",
                  args));
}

static void add_counter(events *e, const char *name, uint64_t at, json_t *args) {
    add(e, at,
        json_pack("{s:s,s:s,s:i,s:I,s:o}", "name", name, "ph", "C", "pid", PROCESS, "ts",
                  (json_int_t)at, "args", args));
}

static int by_time(const void *a, const void *b) {
    const event *x = a, *y = b;
    if (x->at != y->at) return x->at < y->at ? -1 : 1;
    return x->number < y->number ? -1 : 1;
}

/* Writes all, and frees them. */
static bool write(events *e, FILE *file, hs_error *err) {
    bool good = !e->exhausted;
    if (good && e->count) qsort(e->event, e->count, sizeof *e->event, by_time);
    for (size_t i = 0; i < e->count; i++) {
        good = good && fputs(",\n", file) >= 0 &&
               (json_dumpf(e->event[i].json, file, JSON_COMPACT) == 0 || ferror(file));
        json_decref(e->event[i].json);
    }
    free(e->event);
    return good || ferror(file) || hs_fail(err, HS_EXIT_INTERNAL, "no memory for the timeline");
}

/* --- Slices -------------------------------------------------------------------------------------
 */

static void add_view(events *e, const hs_timeline *t, uint64_t offset) {
    char name[40];
    snprintf(name, sizeof name, "view %u", t->source.view);
    add_slice(e, TRACK_VIEWS, name, t->start, t->end, offset,
              json_pack("{s:s,s:I,s:i,s:I,s:I}", "status", hs_status_name(t->source.status),
                        "cycles", (json_int_t)(t->end - t->start), "generations",
                        (int)t->generations, "shortest wait shown", (json_int_t)t->least_wait,
                        "shorter waits", (json_int_t)t->shorter_waits));
}

static void add_generations(events *e, const hs_timeline *t, uint64_t offset) {
    for (uint32_t i = 0; i < t->generations; i++) {
        const hs_timeline_generation *g = &t->generation[i];
        char name[40];
        snprintf(name, sizeof name, "generation %u", g->number);
        add_slice(e, TRACK_GENERATIONS, name, g->begin, g->end, offset,
                  json_pack("{s:I,s:I,s:I,s:I,s:I}", g->number ? "quads" : "corners",
                            (json_int_t)g->items, "vertices", (json_int_t)g->vertices,
                            "faces selected", (json_int_t)g->selected, "faces refined",
                            (json_int_t)g->refined, "ops sent", (json_int_t)g->ops));
    }
}

static const char *things(const hs_timeline_run *r) {
    return r->stage == HS_STAGE_receive    ? "beats"
           : r->stage <= HS_STAGE_quantize ? "vertices"
           : r->stage == HS_STAGE_emit     ? "ops"
           : r->generation                 ? "quads"
                                           : "corners";
}

static void add_runs(events *e, const hs_timeline *t, uint64_t offset) {
    for (uint32_t i = 0; i < t->runs; i++) {
        const hs_timeline_run *r = &t->run[i];
        char name[40];
        if (r->stage <= HS_STAGE_quantize)
            snprintf(name, sizeof name, "%s", hs_stage_name(r->stage));
        else
            snprintf(name, sizeof name, "%s %u", hs_stage_name(r->stage), r->generation);
        add_slice(e, TRACK_STAGES + r->stage, name, r->begin, r->end, offset,
                  json_pack("{s:I,s:I,s:I,s:I}", things(r), (json_int_t)r->items, "busy",
                            (json_int_t)r->activity[HS_ACTIVITY_busy], "starved",
                            (json_int_t)r->activity[HS_ACTIVITY_starved], "blocked",
                            (json_int_t)r->activity[HS_ACTIVITY_blocked]));
    }
}

static void add_waits(events *e, const hs_timeline *t, uint64_t offset) {
    for (uint32_t i = 0; i < t->waits; i++) {
        const hs_timeline_wait *w = &t->wait[i];
        add_slice(e, TRACK_STAGES + w->stage, hs_activity_name(w->activity), w->begin, w->end,
                  offset, json_object());
    }
}

/* --- Counters -----------------------------------------------------------------------------------
 *
 * Only where they change. A view begins and ends with zeros.
 */
static void add_fills(events *e, const hs_timeline *t, uint64_t offset) {
    for (uint32_t f = 0; f < HS_FILLS; f++) {
        char name[60];
        uint32_t before = 0;
        snprintf(name, sizeof name, "fill: %s", hs_timeline_fill_name(f));
        for (uint32_t b = 0; b <= t->buckets; b++) {
            const uint32_t now = b < t->buckets ? t->fill[f][b] : 0;
            const uint64_t at = b < t->buckets ? b * t->bucket : t->end;
            if (now == before) continue;
            add_counter(e, name, offset + at, json_pack("{s:I}", "most", (json_int_t)now));
            before = now;
        }
    }
}

static uint32_t per_cent(const hs_timeline *t, uint32_t stage, uint32_t activity, uint32_t bucket) {
    if (bucket == t->buckets) return 0;
    const uint64_t from = bucket * t->bucket;
    const uint64_t cycles = t->end - from < t->bucket ? t->end - from : t->bucket;
    return cycles ? (uint32_t)((100 * (uint64_t)t->activity[stage][activity][bucket] + cycles / 2) /
                               cycles)
                  : 0;
}

static void add_activities(events *e, const hs_timeline *t, uint64_t offset) {
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        char name[60];
        uint32_t before[2] = {0, 0};
        snprintf(name, sizeof name, "%s, %% of cycles", hs_stage_name(s));
        for (uint32_t b = 0; b <= t->buckets; b++) {
            const uint32_t busy = per_cent(t, s, HS_ACTIVITY_busy, b);
            const uint32_t blocked = per_cent(t, s, HS_ACTIVITY_blocked, b);
            const uint64_t at = b < t->buckets ? b * t->bucket : t->end;
            if (busy == before[0] && blocked == before[1]) continue;
            add_counter(e, name, offset + at,
                        json_pack("{s:i,s:i}", "busy", (int)busy, "blocked", (int)blocked));
            before[0] = busy;
            before[1] = blocked;
        }
    }
}

/* --- The file -----------------------------------------------------------------------------------
 */

static json_t *metadata(const char *what, uint32_t track, const char *key, json_t *value) {
    return json_pack("{s:s,s:s,s:i,s:i,s:{s:o}}", "name", what, "ph", "M", "pid", PROCESS, "tid",
                     (int)track, "args", key, value);
}

static void name_track(events *e, uint32_t track, const char *name) {
    add(e, 0, metadata("thread_name", track, "name", json_string(name)));
    add(e, 0, metadata("thread_sort_index", track, "sort_index", json_integer(track)));
}

bool hs_timeline_json_begin(hs_timeline_json *json, FILE *file, const char *title,
                            const hs_model_config *c, hs_error *err) {
    *json = (hs_timeline_json){.file = file};
    json_t *about = json_pack(
        "{s:s,s:s,s:s,s:{s:i,s:i,s:i,s:i,s:i,s:i}}", "title", title, "unit",
        "a microsecond stands for a cycle", "left out",
        "counters: the most, or the share, of a bucket of cycles, at most 1024 buckets a view; "
        "waits: those below the view's \"shortest wait shown\", at most 2000 a view",
        "architecture", "port", (int)c->port, "banks", (int)c->banks, "window", (int)c->window,
        "lanes", (int)c->lanes, "latency", (int)c->latency, "ops", (int)c->ops);
    if (!about) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the timeline");
    fputs("{\"displayTimeUnit\":\"ms\",\"otherData\":", file);
    const bool good = json_dumpf(about, file, JSON_COMPACT) == 0 || ferror(file);
    json_decref(about);
    if (!good) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the timeline");
    fputs(",\n\"traceEvents\":[\n", file);
    json_t *name = metadata("process_name", 0, "name", json_string(title));
    const bool named = name && (json_dumpf(name, file, JSON_COMPACT) == 0 || ferror(file));
    json_decref(name);
    if (!named) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the timeline");
    events e = {0};
    name_track(&e, TRACK_VIEWS, "views");
    name_track(&e, TRACK_GENERATIONS, "generations");
    for (uint32_t s = 0; s < HS_STAGES; s++)
        name_track(&e, TRACK_STAGES + s, hs_stage_name(s));
    return write(&e, file, err);
}

bool hs_timeline_json_view(hs_timeline_json *json, const hs_timeline *t, hs_error *err) {
    events e = {0};
    add_view(&e, t, json->offset);
    add_generations(&e, t, json->offset);
    add_runs(&e, t, json->offset);
    add_waits(&e, t, json->offset);
    add_fills(&e, t, json->offset);
    add_activities(&e, t, json->offset);
    json->offset += hs_timeline_length(t);
    return write(&e, json->file, err);
}

void hs_timeline_json_end(hs_timeline_json *json) {
    fputs("\n]}\n", json->file);
}
