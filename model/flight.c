/* SPDX-License-Identifier: Apache-2.0
 *
 * Views in flight: rtl/deal.sv, collect.sv and the pipelines between. A pipeline's times depend on
 * the others' only where packets are dealt and where beats are collected. So each pipeline is a
 * coroutine that works on its view until it has a beat to give; when all of them wait for that, or
 * for a packet, what happens first is known: a packet is dealt, or a beat is taken.
 */
#include <stdlib.h>
#include <ucontext.h>

#include "model_parts.h"

enum { STACK = 1 << 20, TO_READY = 3 }; /* bytes; cycles from a last beat to ready for a packet */

typedef struct pipeline {
    hs_flight *flight;
    hs_model *model;
    ucontext_t context;
    char *stack;
    bool running;        /* at work on a view: a beat waits, from cycle `beat` on */
    hs_time beat, ready; /* else: ready for a packet from this cycle on */
    hs_time taken;       /* answers: when the beat was taken */
    uint32_t view;       /* its number in the stream */
    hs_cycle_report cycles;
    bool good;
} pipeline;

struct hs_flight {
    hs_model_config config;
    pipeline pipeline[HS_MOST_VIEWS];
    ucontext_t main;
    hs_flight_observer *done;
    void *context;
    hs_output_port output;

    /* The stream */
    const hs_packet *in;
    hs_packet *out;
    hs_golden_report *report;
    hs_flight_view *at;
    uint32_t count, next; /* packets in all, and dealt */
    hs_pauses input;
    hs_time offered;           /* the next packet's first beat */
    hs_time free;              /* collect can take a beat */
    uint32_t dealt, collected; /* the pipelines of the latest turns */
    hs_error err;
};

/* --- A pipeline ---------------------------------------------------------------------------------
 */

/* Emit has a beat from cycle t on; the one in which it was taken. */
static hs_time give_beat(void *context, hs_time t) {
    pipeline *p = context;
    p->beat = t;
    swapcontext(&p->context, &p->flight->main);
    return p->taken;
}

static _Thread_local pipeline *starting;

static void work(void) {
    pipeline *p = starting;
    hs_flight *f = p->flight;
    p->good = hs_model_view(p->model, &f->in[p->view], &f->out[p->view], &f->report[p->view],
                            &p->cycles, &f->err);
    if (p->good && f->done) f->done(f->context, p->view, p->model, &p->cycles);
    p->running = false;
    p->ready = p->taken + TO_READY;
    swapcontext(&p->context, &f->main);
}

static void start(pipeline *p) {
    getcontext(&p->context);
    p->context.uc_stack.ss_sp = p->stack;
    p->context.uc_stack.ss_size = STACK;
    p->context.uc_link = NULL;
    makecontext(&p->context, work, 0);
    p->running = true;
    starting = p;
    swapcontext(&p->flight->main, &p->context);
}

/* --- Turns --------------------------------------------------------------------------------------
 */

/* The first pipeline behind the one of the latest turn that is at work, or at rest, and has been
 * waiting since cycle t or before. */
static uint32_t turn(const hs_flight *f, uint32_t latest, bool running, hs_time t) {
    for (uint32_t i = 1; i <= f->config.views; i++) {
        const uint32_t n = (latest + i) % f->config.views;
        const pipeline *p = &f->pipeline[n];
        if (p->running == running && (running ? p->beat : p->ready) <= t) return n;
    }
    return f->config.views;
}

/* When the first of those at work, or at rest, waits. */
static hs_time earliest(const hs_flight *f, bool running) {
    hs_time t = UINT64_MAX;
    for (uint32_t n = 0; n < f->config.views; n++) {
        const pipeline *p = &f->pipeline[n];
        const hs_time since = running ? p->beat : p->ready;
        if (p->running == running && since < t) t = since;
    }
    return t;
}

static void next_offer(hs_flight *f, hs_time t) {
    f->offered = t;
    if (f->next < f->count)
        while (hs_pauses_next(&f->input))
            f->offered++;
}

static void deal(hs_flight *f, hs_time t) {
    f->dealt = turn(f, f->dealt, false, t);
    pipeline *p = &f->pipeline[f->dealt];
    p->view = f->next++;
    p->model->input = &f->input;
    p->model->offered = f->offered;
    p->model->free = t;
    f->at[p->view].start = f->offered;
    f->at[p->view].pipeline = f->dealt;
    start(p);
    next_offer(f, p->model->received + 1);
}

static void collect(hs_flight *f, hs_time t) {
    f->collected = turn(f, f->collected, true, t);
    pipeline *p = &f->pipeline[f->collected];
    if (f->config.views == 1) { /* a wire */
        p->taken = f->free = hs_output_ready(&f->output, t);
    } else {
        p->taken = t;
        f->free = hs_output_ready(&f->output, t + 1);
    }
    f->at[p->view].end = f->free;
    swapcontext(&f->main, &p->context);
}

/* --- The interface ------------------------------------------------------------------------------
 */

hs_flight *hs_flight_new(hs_limits limits, hs_model_config config, hs_error *err) {
    hs_flight *f = calloc(1, sizeof *f);
    if (!f) {
        hs_fail(err, HS_EXIT_INTERNAL, "no memory for the model");
        return NULL;
    }
    f->config = config;
    f->dealt = f->collected = config.views - 1; /* turns go on from stream to stream */
    for (uint32_t n = 0; n < (config.views < HS_MOST_VIEWS ? config.views : HS_MOST_VIEWS); n++) {
        pipeline *p = &f->pipeline[n];
        p->flight = f;
        p->model = hs_model_new(limits, config, err);
        p->stack = malloc(STACK);
        if (!p->model || !p->stack) {
            if (p->model) hs_fail(err, HS_EXIT_INTERNAL, "no memory for the model");
            hs_flight_free(f);
            return NULL;
        }
        p->model->emit.take_beat = give_beat;
        p->model->emit.context = p;
    }
    return f;
}

void hs_flight_free(hs_flight *f) {
    if (!f) return;
    for (uint32_t n = 0; n < HS_MOST_VIEWS; n++) {
        hs_model_free(f->pipeline[n].model);
        free(f->pipeline[n].stack);
    }
    free(f->output.ready);
    free(f);
}

void hs_flight_observe(hs_flight *f, hs_flight_observer *done, void *context) {
    f->done = done;
    f->context = context;
}

bool hs_flight_run(hs_flight *f, const hs_packet *in, uint32_t count, hs_stalls stalls,
                   hs_packet *out, hs_golden_report *report, hs_flight_view *view, uint64_t *cycles,
                   hs_log *log, hs_error *err) {
    f->in = in;
    f->out = out;
    f->report = report;
    f->at = view;
    f->count = count;
    f->next = 0;
    f->free = 0;
    f->input = hs_pauses_start(stalls.seed, HS_PAUSES_INPUT, stalls.input);
    hs_output_start(&f->output, stalls);
    next_offer(f, 0);
    for (uint32_t n = 0; n < f->config.views; n++) {
        f->pipeline[n].running = false;
        f->pipeline[n].good = true;
        f->pipeline[n].ready = 0;
        f->pipeline[n].model->log = log ? &log[n] : NULL;
        if (log) hs_log_clear(&log[n]);
    }
    bool good = true;
    while (good) {
        const hs_time beat = hs_later(earliest(f, true), f->free);
        const hs_time packet =
            f->next < count ? hs_later(earliest(f, false), f->offered) : UINT64_MAX;
        if (beat == UINT64_MAX && packet == UINT64_MAX) break;
        if (packet <= beat)
            deal(f, packet);
        else
            collect(f, beat);
        for (uint32_t n = 0; n < f->config.views; n++)
            good = good && f->pipeline[n].good;
    }
    uint64_t end = 0;
    for (uint32_t v = 0; v < count; v++)
        end = hs_later(end, view[v].end);
    *cycles = count ? end - view[0].start + 1 : 0;
    if (!good) *err = f->err;
    return good;
}
