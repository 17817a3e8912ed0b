/* SPDX-License-Identifier: Apache-2.0
 *
 * The cycle-level model: golden works, and whenever it has done a stage's work, the stage's file
 * says when the RTL does it. What starts when is rtl/sequencer.sv's order.
 */
#include <stdlib.h>
#include <string.h>

#include "model_parts.h"

void hs_account(hs_model *m, uint32_t stage, hs_time kick, hs_time last, uint64_t busy,
                uint64_t blocked) {
    hs_cycle_report *r = m->report;
    r->activity[stage][HS_ACTIVITY_busy] += busy;
    r->activity[stage][HS_ACTIVITY_blocked] += blocked;
    r->activity[stage][HS_ACTIVITY_starved] += last - kick - busy - blocked;
    r->items_in[stage] += busy;
    r->items_out[stage] += busy;
}

void hs_log_item(hs_model *m, uint32_t probe, hs_time t, const hs_state *s, uint32_t item) {
    if (!m->log) return;
    const uint32_t *origin = hs_item_origins(s, item), lanes = hs_item_lanes(s, item);
    uint32_t word[4];
    for (int i = 0; i < HS_LANES; i++)
        word[i] = lanes >> i & 1 ? origin[i] : UINT32_MAX;
    hs_log_add(m->log, probe, t, item, word);
}

/* --- The sequencer ------------------------------------------------------------------------------
 */

/* A stage that works now; the next one starts in the cycle behind the one in which it is seen at
 * rest. also: stages that start with it. */
static void run_stage(hs_model *m, uint32_t stage, uint32_t also, const hs_state *s,
                      hs_time (*cycles)(hs_model *, const hs_state *, hs_time)) {
    hs_log_words(m, HS_PROBE_kick, m->now, stage, s->generation, hs_items(s), s->vertices,
                 1u << (stage - HS_STAGE_classify) | also);
    m->now = cycles(m, s, m->now) + 1;
}

static void send_control(hs_model *m, uint32_t kind) {
    const hs_op op = {.kind = kind};
    m->now = hs_emit_op(m, m->now, &op) + 1;
}

/* Runs without borders whose every step refines all there is. */
static bool is_borderless(const hs_state *s) {
    return s->settings.uniform && (s->closed || s->settings.boundary != HS_BOUNDARY_KEPT);
}

/* Of these, those in which vertices leave in the last step alone. */
static bool is_whole(const hs_state *s) {
    return is_borderless(s) && !s->settings.limit;
}

/* Whether smooth is left out: an even step of a run without borders, but the last ones. */
static bool smooth_idle(const hs_model *m, const hs_state *s) {
    const bool last = !s->settings.limit && s->generation + 1 == s->depth;
    return is_borderless(s) && !hs_odd_step(s) && !last && !m->ends;
}

static void entered(void *context, const hs_state *s) {
    hs_model *m = context;
    if (s->generation) return;
    m->entered = true;
    m->now = hs_cycles_receive(m, s) + 1;
}

static bool keep_sent(hs_model *m, const hs_state *s) {
    if (s->vertices > m->sent_room) {
        const size_t room = s->vertices + (size_t)s->vertices / 2;
        uint8_t *more = realloc(m->sent, room);
        if (!more) return false;
        m->sent = more;
        m->sent_room = room;
    }
    memcpy(m->sent, s->sent, s->vertices);
    return true;
}

static void decided(void *context, const hs_state *s) {
    hs_model *m = context;
    const bool first = s->generation == 0, uniform = s->settings.uniform;
    m->ends = s->generation >= s->depth;
    m->generation_cycle[s->generation] = m->report->begin + m->now - m->report->start;
    m->generations = s->generation + 1;
    if (!keep_sent(m, s)) {
        m->exhausted = true;
        return;
    }
    const bool whole = is_whole(s);
    m->has_smooth = first || !uniform || !smooth_idle(m, s) || s->status == HS_STATUS_STOPPED;
    m->pass = whole && hs_odd_step(s) && !first && !s->last && !s->finish;
    m->edges = whole && !hs_odd_step(s) && s->generation >= 3;
    if (m->pass) return; /* split goes along: when golden has done its work */
    if (m->edges)
        m->now += 2; /* no classify: the sequencer passes by */
    else
        run_stage(m, HS_STAGE_classify, 0, s, hs_cycles_classify);
    if (first) send_control(m, HS_OP_HEADER);
    if (!m->ends && !uniform) run_stage(m, HS_STAGE_select, 0, s, hs_cycles_select);
    if (!m->ends && (first || !uniform) && s->selected)
        run_stage(m, HS_STAGE_guard, 0, s, hs_cycles_guard);
    if (m->has_smooth) run_stage(m, HS_STAGE_smooth, 0, s, hs_cycles_smooth);
}

/* What smooth's writes hold is known when golden's smooth is done. */
static void smoothed(void *context, const hs_state *s) {
    hs_model *m = context;
    hs_log *log = m->log;
    if (!log) return;
    hs_transaction *t = log->probe[HS_PROBE_smooth_out].transaction;
    for (size_t i = m->smooth_logged; i < log->probe[HS_PROBE_smooth_out].count; i++)
        if (t[i].word[0] & 1)
            for (int k = 0; k < 3; k++)
                t[i].word[1 + k] = (uint32_t)s->position[t[i].item][k];
    m->smooth_logged = log->probe[HS_PROBE_smooth_out].count;
}

static void divided(void *context, const hs_state *s) {
    hs_model *m = context;
    if (m->pass) {
        const uint32_t split = 1u << (HS_STAGE_split - HS_STAGE_classify);
        run_stage(m, HS_STAGE_classify, split, s, hs_cycles_pass);
        run_stage(m, HS_STAGE_smooth, 0, s, hs_cycles_smooth);
        smoothed(m, s);
    } else {
        run_stage(m, HS_STAGE_split, 0, s, hs_cycles_split);
    }
    if (!s->finish && !s->last) m->now++; /* the sequencer's NEXT */
}

/* A packet that golden refused: the RTL finds an error of its topology while it classifies. */
static void refused(hs_model *m, const hs_state *s) {
    m->now = hs_cycles_receive(m, s) + 1;
    if (s->parsed) {
        hs_log *log = m->log;
        hs_log_words(m, HS_PROBE_kick, m->now, HS_STAGE_classify, 0, hs_items(s), s->vertices, 1);
        m->log = NULL; /* golden has not computed what passes */
        m->now = hs_cycles_classify(m, s, m->now) + 1;
        m->log = log;
    }
    send_control(m, HS_OP_HEADER);
}

/* --- The interface ------------------------------------------------------------------------------
 */

hs_model_config hs_model_config_decode(uint32_t architecture) {
    const hs_model_config config = {.port = 1u << (architecture & 0xf),
                                    .banks = 1u << (architecture >> 4 & 0xf),
                                    .window = 1u << (architecture >> 8 & 0xf),
                                    .lanes = 1u << (architecture >> 12 & 0xf),
                                    .latency = architecture >> 16 & 0xf,
                                    .ops = 1u << (architecture >> 20 & 0xf),
                                    .views = architecture >> 24 & 0xf,
                                    .parity = architecture >> 28 & 1,
                                    .capacity = HS_DEFAULT_LIMITS};
    return config;
}

static bool power_of_two(uint32_t number, uint32_t least, uint32_t most) {
    return number >= least && number <= most && (number & (number - 1)) == 0;
}

enum { MOST_CAPACITY = 1 << 24 };

bool hs_model_config_good(const hs_model_config *c, hs_error *err) {
    if (!power_of_two(c->port, 1, 4))
        return hs_fail(err, HS_EXIT_USAGE, "port is %u; it should be 1, 2 or 4 records", c->port);
    if (!power_of_two(c->banks, 2, HS_MOST_BANKS))
        return hs_fail(err, HS_EXIT_USAGE, "banks is %u; it should be 2, 4, 8 or 16", c->banks);
    if (!power_of_two(c->window, 2, HS_MOST_WINDOW))
        return hs_fail(err, HS_EXIT_USAGE, "window is %u; it should be 2, 4, 8, 16 or 32 items",
                       c->window);
    if (!power_of_two(c->lanes, 1, HS_MOST_BANKS))
        return hs_fail(err, HS_EXIT_USAGE, "lanes is %u; it should be 1, 2, 4, 8 or 16", c->lanes);
    if (c->latency < 1 || c->latency > 8)
        return hs_fail(err, HS_EXIT_USAGE, "latency is %u; it should be 1 to 8 cycles", c->latency);
    if (c->views < 1 || c->views > HS_MOST_VIEWS)
        return hs_fail(err, HS_EXIT_USAGE, "views is %u; it should be 1 to 8", c->views);
    if (c->parity > 1)
        return hs_fail(err, HS_EXIT_USAGE, "parity is %u; it should be 0 or 1", c->parity);
    if (!power_of_two(c->capacity.vertices, 8, MOST_CAPACITY) ||
        !power_of_two(c->capacity.quads, 8, MOST_CAPACITY))
        return hs_fail(
            err, HS_EXIT_USAGE,
            "the capacity is %u vertices and %u quads; both should be powers of two from 8 to %u",
            c->capacity.vertices, c->capacity.quads, (uint32_t)MOST_CAPACITY);
    if (!power_of_two(c->ops, 16, 256))
        return hs_fail(err, HS_EXIT_USAGE, "ops is %u; it should be 16, 32, 64, 128 or 256",
                       c->ops);
    return true;
}

hs_model *hs_model_new(hs_limits limits, hs_model_config config, hs_error *err) {
    if (!hs_model_config_good(&config, err)) return NULL;
    /* No transaction tells how many quads the memories hold. */
    while (config.capacity.vertices < limits.vertices && config.capacity.vertices < MOST_CAPACITY)
        config.capacity.vertices *= 2;
    hs_model *m = calloc(1, sizeof *m);
    if (m) m->golden = hs_golden_new(limits);
    if (!m || !m->golden) {
        hs_model_free(m);
        hs_fail(err, HS_EXIT_INTERNAL, "no memory for the model");
        return NULL;
    }
    m->config = config;
    const hs_observer observer = {.context = m,
                                  .entered = entered,
                                  .decided = decided,
                                  .smoothed = smoothed,
                                  .divided = divided};
    hs_golden_observe(m->golden, &observer);
    return m;
}

void hs_model_free(hs_model *m) {
    if (!m) return;
    hs_golden_free(m->golden);
    free(m->sent);
    free(m->output.ready);
    free(m->emit.beat_cycle);
    free(m);
}

/* Idle is what the view's own cycles leave. */
static void complete(hs_cycle_report *r) {
    r->cycles = r->end - r->start + 1;
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        uint64_t *activity = r->activity[s];
        activity[HS_ACTIVITY_idle] = r->cycles - activity[HS_ACTIVITY_busy] -
                                     activity[HS_ACTIVITY_starved] - activity[HS_ACTIVITY_blocked];
    }
}

/* What the beats held is known when the packet is complete. */
static void log_beats(hs_model *m, const hs_packet *out) {
    const size_t beat_words = 4 * (size_t)m->config.port;
    if (!m->log) return;
    for (size_t b = 0; b < m->emit.beats; b++) {
        uint32_t word[4] = {0};
        for (size_t i = b * beat_words; i < (b + 1) * beat_words && i < out->words; i++)
            word[i % 4] ^= out->word[i];
        hs_log_add(m->log, HS_PROBE_beat_out, m->emit.beat_cycle[b], (uint32_t)b, word);
    }
}

bool hs_model_view(hs_model *m, const hs_packet *in, hs_packet *out, hs_golden_report *report,
                   hs_cycle_report *cycles, hs_error *err) {
    *cycles = (hs_cycle_report){0};
    m->in = in;
    m->report = cycles;
    m->entered = m->exhausted = false;
    m->generations = 0;
    m->smooth_logged = m->log ? m->log->probe[HS_PROBE_smooth_out].count : 0;
    m->traffic = (hs_model_traffic){0};
    hs_golden_mark_always(m->golden, m->log != NULL);
    hs_emit_begin(m);
    if (!hs_golden_run(m->golden, in, out, report, err)) return false;
    if (!m->entered) refused(m, hs_golden_state(m->golden));
    send_control(m, HS_OP_TRAILER);
    hs_emit_end(m);
    complete(cycles);
    log_beats(m, out);
    if (m->exhausted || m->emit.exhausted)
        return hs_fail(err, HS_EXIT_INTERNAL, "view %u: out of memory in the model", in->view);
    return true;
}

bool hs_model_run(hs_model *m, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                  hs_golden_report *report, hs_cycle_report *cycles, hs_log *log, hs_error *err) {
    m->own_input = hs_pauses_start(stalls.seed, HS_PAUSES_INPUT, stalls.input);
    m->input = &m->own_input;
    m->offered = m->free = 0;
    while (hs_pauses_next(m->input))
        m->offered++;
    m->log = log;
    if (log) hs_log_clear(log);
    hs_output_start(&m->output, stalls);
    m->emit.port = &m->output;
    return hs_model_view(m, in, out, report, cycles, err) &&
           (!m->output.exhausted ||
            hs_fail(err, HS_EXIT_INTERNAL, "view %u: out of memory in the model", in->view));
}

hs_model_traffic hs_model_traffic_of(const hs_model *m) {
    return m->traffic;
}

uint64_t hs_model_word_cycle(const hs_model *m, size_t word) {
    const size_t beat = word / (4 * (size_t)m->config.port);
    return beat < m->emit.beats ? m->emit.beat_cycle[beat] : HS_NO_CYCLE;
}

uint64_t hs_model_generation_cycle(const hs_model *m, uint32_t generation) {
    return generation < m->generations ? m->generation_cycle[generation] : HS_NO_CYCLE;
}
