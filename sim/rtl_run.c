/* SPDX-License-Identifier: Apache-2.0
 *
 * hs_rtl_run: a view alone in the Verilated pipeline, and its counters.
 */
#include <string.h>

#include "memory.h"
#include "rtl_parts.h"

static void note_transaction(void *context, uint32_t pipeline, uint32_t probe, uint32_t item,
                             const uint32_t word[4]) {
    (void)pipeline;
    const hs_rtl *rtl = context;
    hs_log_add(rtl->log, probe, rtl->cycle - rtl->begin, item, word);
}

/* The rules of a view's output: a beat's, and those of a view that is alone. */
static bool check_output(const hs_rtl *rtl, const hs_packet *in, hs_axis *shown, bool ended,
                         hs_error *err) {
    if (!rtl_check_beat(rtl, in, shown, err)) return false;
    const hs_axis *axis = &rtl->pins.m_axis;
    if (axis->valid && ended)
        return rtl_break_of_rule(rtl, in, "a beat behind the packet's last one", err);
    if (axis->valid && axis->id != (in->view & 0xffff))
        return rtl_break_of_rule(rtl, in, "tid is not the view's number", err);
    return true;
}

static bool note_beat(hs_rtl *rtl, hs_error *err) {
    if (rtl->beats == rtl->beats_held) {
        const size_t more = rtl->beats_held ? 2 * rtl->beats_held : 1024;
        uint32_t *grown = hs_reallocate(rtl->beat_cycle, more * sizeof *grown);
        if (!grown)
            return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the simulation; free some memory");
        rtl->beat_cycle = grown;
        rtl->beats_held = more;
    }
    rtl->beat_cycle[rtl->beats++] = (uint32_t)(rtl->cycle - rtl->begin);
    return true;
}

static bool lives(const hs_rtl *rtl, const hs_packet *in, const rtl_life *life, uint64_t most,
                  hs_error *err) {
    const uint64_t silence = rtl_most_silence(rtl);
    if (rtl->cycle - life->moved > silence)
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "view %u, cycle %llu: the RTL hangs: nothing has moved for %llu cycles%s",
                       in->view, (unsigned long long)rtl->cycle, (unsigned long long)silence,
                       rtl_life_held(life).text);
    if (rtl->cycle - rtl->begin > most)
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "view %u, cycle %llu: the RTL does not come to an end: more than %llu "
                       "cycles%s",
                       in->view, (unsigned long long)rtl->cycle, (unsigned long long)most,
                       rtl_life_held(life).text);
    return true;
}

/* Streams the packet in and the answer out. */
static bool stream(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                   hs_cycle_report *report, hs_error *err) {
    hs_pins *pins = &rtl->pins;
    rtl_sender sender = {.pauses = hs_pauses_start(stalls.seed, HS_PAUSES_INPUT, stalls.input)};
    hs_pauses output = hs_pauses_start(stalls.seed, HS_PAUSES_OUTPUT, stalls.output);
    const uint64_t begin = rtl->begin = rtl->cycle;
    const uint64_t derived = rtl_most_cycles(rtl, in, stalls);
    const uint64_t most = derived < rtl->limit ? derived : rtl->limit;
    rtl_life life = {.moved = begin};
    hs_axis shown = {0};
    bool taken = false, ended = false;
    rtl->beats = 0;
    report->begin = begin;
    report->first_out = 0;
    while (!ended || !taken || !rtl_access_ended(&rtl->bus)) {
        if (taken)
            pins->s_axis.valid = false;
        else if (rtl_offer(&sender, rtl, in))
            report->start = rtl->cycle;
        pins->m_axis_ready = !hs_pauses_next(&output);
        if (!ended) rtl_life_look(&life, rtl);
        if (!rtl_settle(rtl, err)) return false;

        if (!check_output(rtl, in, &shown, ended, err)) return false;
        if (pins->m_axis.valid && pins->m_axis_ready) {
            if (!rtl_take_beat(rtl, out, err) || !note_beat(rtl, err)) return false;
            if (rtl->beats == 1) report->first_out = rtl->cycle;
            ended = pins->m_axis.last;
            report->end = life.moved = rtl->cycle;
        }
        if (!taken && rtl_sent(&sender, rtl)) {
            taken = sender.at >= in->words;
            life.moved = rtl->cycle;
        }
        if (!rtl_edge(rtl, err) || !lives(rtl, in, &life, most, err)) return false;
    }
    pins->s_axis.valid = pins->m_axis_ready = false;
    report->cycles = report->end - report->start + 1;
    return true;
}

/* The answer's trailer, the last record but one; NULL if it has not so many. */
static const uint32_t *trailer_of(const hs_packet *out) {
    return out->words >= 8 ? &out->word[out->words - 8] : NULL;
}

/* A view that a memory's fault ends leaves items behind. */
static bool faulty(const hs_packet *out) {
    const uint32_t *trailer = trailer_of(out);
    return trailer && (trailer[0] & 0xff) == HS_STATUS_MEMORY_FAULT;
}

/* The counters of the view: what they grew by. Idle is what the view's own cycles leave. */
static bool account(const hs_rtl *rtl, const hs_packet *in, const hs_packet *out,
                    const rtl_counters *after, hs_cycle_report *report, hs_error *err) {
    const rtl_counters *before = &rtl->before;
    const uint32_t cycles = after->cycles - before->cycles;
    if (cycles != (uint32_t)(after->when - before->when))
        return hs_fail(err, HS_EXIT_INTERNAL, "view %u: the RTL counts %u cycles instead of %u",
                       in->view, cycles, (uint32_t)(after->when - before->when));
    report->conflicts = after->conflicts - before->conflicts;
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        uint32_t grown[RTL_COUNTERS], sum = 0;
        for (uint32_t c = 0; c < RTL_COUNTERS; c++)
            grown[c] = after->stage[s][c] - before->stage[s][c];
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++) {
            report->activity[s][a] = grown[a];
            sum += grown[a];
        }
        report->items_in[s] = grown[RTL_IN];
        report->items_out[s] = grown[RTL_OUT];
        const uint64_t active = report->activity[s][HS_ACTIVITY_busy] +
                                report->activity[s][HS_ACTIVITY_starved] +
                                report->activity[s][HS_ACTIVITY_blocked];
        if (sum != cycles || active > report->cycles)
            return hs_fail(err, HS_EXIT_INTERNAL,
                           "view %u: stage %s was busy %u, starved %u, blocked %u and idle %u "
                           "cycles of %u, the view's own %llu among them",
                           in->view, hs_stage_name(s), grown[0], grown[1], grown[2], grown[3],
                           cycles, (unsigned long long)report->cycles);
        if (grown[RTL_IN] != grown[RTL_OUT] && !faulty(out))
            return hs_fail(err, HS_EXIT_INTERNAL, "view %u: stage %s took %u items and gave %u",
                           in->view, hs_stage_name(s), grown[RTL_IN], grown[RTL_OUT]);
        report->activity[s][HS_ACTIVITY_idle] = report->cycles - active;
    }
    return true;
}

/* The registers tell of the view what its trailer tells. */
static bool told(const hs_rtl *rtl, const hs_packet *in, const hs_packet *out,
                 const rtl_counters *after, hs_error *err) {
    const uint32_t *trailer = trailer_of(out);
    if (after->views - rtl->before.views != 1)
        return hs_fail(err, HS_EXIT_INTERNAL, "view %u: the RTL counts %u views instead of 1",
                       in->view, after->views - rtl->before.views);
    if (trailer && (after->status != (trailer[0] & 0xff) || after->position != trailer[1]))
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "view %u: the RTL's registers tell of status %u at word 0x%x, its trailer "
                       "of status %u at word 0x%x",
                       in->view, after->status, after->position, trailer[0] & 0xff, trailer[1]);
    return true;
}

bool hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                hs_cycle_report *report, hs_error *err) {
    memset(report, 0, sizeof *report);
    out->view = in->view;
    out->words = 0;
    if (!rtl_begin(rtl, err)) return false;
    if (rtl->log) {
        hs_log_clear(rtl->log);
        hs_rtl_top_probe(rtl->top, note_transaction, rtl);
    }
    const bool streamed = stream(rtl, in, stalls, out, report, err);
    hs_rtl_top_probe(rtl->top, NULL, NULL);
    rtl_counters after;
    if (!streamed || !rtl_rest(rtl, in, err) || !rtl_read_counters(rtl, &after, err)) return false;
    if (rtl->pins.m_axis.valid) /* late, when it was at rest already */
        return rtl_break_of_rule(rtl, in, "a beat behind the packet's last one", err);
    if (!account(rtl, in, out, &after, report, err) || !told(rtl, in, out, &after, err))
        return false;
    rtl->before = after;
    rtl_end(rtl);
    return true;
}
