/* SPDX-License-Identifier: Apache-2.0
 *
 * The timeline of a view: which stage was at work when, on what, and where it waited. It follows
 * from the log of transactions (model/cycles.h) and from nothing else, so that the RTL's and the
 * model's are one and the same, byte for byte, as long as their logs are. Three writers tell it:
 *
 *   log -> hs_timeline --> hs_timeline_json    a trace for Perfetto or chrome://tracing
 *                      +-> hs_timeline_kanata  a log for Konata, a line a quad
 *                      '-> hs_timeline_svg     a picture
 *
 * docs/timeline.md says what is in them. Cycles count from the view's begin (hs_cycle_report); an
 * interval is from its begin up to, but without, its end.
 */
#ifndef HS_TIMELINE_H
#define HS_TIMELINE_H

#include <stdio.h>

#include "model.h"

/* --- What it is made of -------------------------------------------------------------------------
 */

/* One engine's account of one view. Log and report must outlive the timeline. */
typedef struct hs_timeline_source {
    const hs_log *log;
    const hs_cycle_report *cycles;
    hs_model_config config; /* of the pipeline */
    uint32_t view;          /* its number */
    uint32_t status;        /* of its trailer */
    bool limit;             /* vertices leave at their limits (hs_settings) */
} hs_timeline_source;

/* A stage at work: from the cycle in which the sequencer starts it up to the one in which it goes
 * on. Receive, transform, quantize: the packet; emit: what one run of smooth or split, or the
 * sequencer, sends. */
typedef struct hs_timeline_run {
    uint32_t stage, generation;
    uint64_t begin, end;
    uint32_t items, vertices; /* of the generation at its start; of receive, transform, quantize and
                                 emit: items are the beats, vertices and ops taken */
    bool pass;                /* classify and split in one pass */
    uint64_t activity[HS_ACTIVITIES]; /* cycles; idle is 0 */
} hs_timeline_run;

/* Cycles in a row in which a stage at work took nothing. */
typedef struct hs_timeline_wait {
    uint32_t stage;
    enum hs_activity activity; /* starved or blocked */
    uint64_t begin, end;
} hs_timeline_wait;

/* A generation, from the start of its first stage on. */
typedef struct hs_timeline_generation {
    uint32_t number;
    uint64_t begin, end;
    uint32_t items, vertices;   /* at its start; items are quads, or in generation 0 corners */
    uint32_t selected, refined; /* faces, as far as select and guard ran */
    uint32_t ops;               /* that emit took */
} hs_timeline_generation;

/* What waits between two boundaries: what passed the first and has not passed the second. */
enum hs_timeline_fill {
    HS_FILL_transform, /* vertices, from receive to clip space */
    HS_FILL_quantize,  /* vertices, from clip space to the block's exponent: all of them */
    HS_FILL_classify,  /* items, from its fetch to accumulate */
    HS_FILL_select,    /* items, from its fetch to its scatter */
    HS_FILL_guard,     /* items, from its fetch to its scatter */
    HS_FILL_smooth,    /* vertices, from their pick to their write; those picked singly */
    HS_FILL_number,    /* items, from split's fetch to their children's numbers */
    HS_FILL_split,     /* items, from there until they are done */
    HS_FILL_ops,       /* the FIFO before emit: items of split, groups or vertices of smooth */
    HS_FILL_pack,      /* records, from emit to the output port */
    HS_FILLS
};
/* "items in classify" and the like; the stage that a fill belongs to. */
const char *hs_timeline_fill_name(uint32_t fill);
uint32_t hs_timeline_fill_stage(uint32_t fill);

/* Figures over time come in buckets of a power of two of cycles, at most as many as this. */
enum { HS_TIMELINE_BUCKETS = 1024 };
/* Waits in a row that are listed, at most; shorter ones are in the figures alone. */
enum { HS_TIMELINE_WAITS = 2000, HS_TIMELINE_LEAST_WAIT = 4 };

typedef struct hs_timeline {
    hs_timeline_source source;
    uint64_t start, end; /* first beat in; behind the last beat out */
    bool refused;        /* there is nothing behind receive but the answer */

    hs_timeline_generation *generation;
    uint32_t generations;
    hs_timeline_run *run; /* in the order of their begins */
    uint32_t runs;
    hs_timeline_wait *wait; /* by begin */
    uint32_t waits;
    uint64_t least_wait,
        shorter_waits; /* cycles of the shortest that is listed; how many are not */

    uint64_t bucket; /* cycles */
    uint32_t buckets;
    uint32_t *activity[HS_STAGES][HS_ACTIVITIES]; /* cycles in each bucket; idle: NULL */
    uint32_t *fill[HS_FILLS];                     /* the most in each bucket */
    uint32_t most[HS_FILLS];                      /* of all */

    /* For each transaction of split_out: the cycle in which emit took the item's faces, or
     * HS_NO_CYCLE if it had none. */
    uint64_t *sent;
} hs_timeline;

/* Works out a view's timeline. Any log will do, even one that makes no sense: what does not fit is
 * left out. False only when memory is exhausted; *timeline is to be freed either way. */
bool hs_timeline_make(hs_timeline *timeline, const hs_timeline_source *source, hs_error *err);
void hs_timeline_free(hs_timeline *timeline);

/* The pipeline is at rest for so many cycles of the file between two views. */
enum { HS_TIMELINE_GAP = 16 };
/* Cycles that a view takes in a file of several, the gap behind it included. */
uint64_t hs_timeline_length(const hs_timeline *timeline);

/* --- Perfetto and chrome://tracing ---------------------------------------------------------------
 *
 * Trace-event JSON; a cycle is a microsecond of its time.
 */
typedef struct hs_timeline_json {
    FILE *file;
    uint64_t offset; /* where the next view begins */
} hs_timeline_json;

/* Begins a file: its head, with a title, and the names of the tracks. Views follow, then the end.
 * False, *err filled, if memory is exhausted; whether all could be written the stream knows. */
bool hs_timeline_json_begin(hs_timeline_json *json, FILE *file, const char *title,
                            const hs_model_config *config, hs_error *err);
bool hs_timeline_json_view(hs_timeline_json *json, const hs_timeline *timeline, hs_error *err);
void hs_timeline_json_end(hs_timeline_json *json);

/* --- Konata -------------------------------------------------------------------------------------
 *
 * A Kanata 0004 log. Instructions are quads, and in generation 0 corners.
 */
typedef struct hs_timeline_kanata {
    FILE *file;
    uint64_t offset, at; /* where the next view begins; the cycle that the file has come to */
    uint64_t quads;      /* so far */
} hs_timeline_kanata;

void hs_timeline_kanata_begin(hs_timeline_kanata *kanata, FILE *file);
/* False, *err filled, if memory is exhausted. */
bool hs_timeline_kanata_view(hs_timeline_kanata *kanata, const hs_timeline *timeline,
                             hs_error *err);

/* --- SVG ----------------------------------------------------------------------------------------
 */

/* Draws one view as an SVG element of its own, 1000 units wide, which a page may hold as it is: no
 * network, no script, no style outside of itself, and colours that do on light and on dark. */
void hs_timeline_svg(FILE *file, const hs_timeline *timeline, const char *title);

#endif
