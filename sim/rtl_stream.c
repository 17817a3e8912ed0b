/* SPDX-License-Identifier: Apache-2.0
 *
 * hs_rtl_stream: several views, one behind the other, in a pipeline that may have more than one of
 * them in flight.
 */
#include <stdlib.h>

#include "rtl_parts.h"

static void note_transaction(void *context, uint32_t pipeline, uint32_t probe, uint32_t item,
                             const uint32_t word[4]) {
    const hs_rtl *rtl = context;
    hs_log_add(&rtl->logs[pipeline], probe, rtl->cycle - rtl->begin, item, word);
}

/* Which of the packets a beat of the output answers; count: none that has not ended. */
static uint32_t answered(const hs_rtl *rtl, const hs_packet *in, uint32_t count,
                         const bool *ended) {
    for (uint32_t i = 0; i < count; i++)
        if ((in[i].view & 0xffff) == rtl->pins.m_axis.id && !ended[i]) return i;
    return count;
}

static uint64_t most_cycles(const hs_rtl *rtl, const hs_packet *in, uint32_t count,
                            hs_stalls stalls) {
    uint64_t most = 0;
    for (uint32_t i = 0; i < count; i++)
        most += rtl_most_cycles(rtl, &in[i], stalls);
    return most < rtl->limit ? most : rtl->limit;
}

/* ended[i]: whether in[i] is answered; all false before. */
static bool stream_all(hs_rtl *rtl, const hs_packet *in, uint32_t count, hs_stalls stalls,
                       bool *ended, hs_packet *out, hs_flight_view *view, uint64_t *cycles,
                       hs_error *err) {
    hs_pins *pins = &rtl->pins;
    rtl_sender sender = {.pauses = hs_pauses_start(stalls.seed, HS_PAUSES_INPUT, stalls.input)};
    hs_pauses output = hs_pauses_start(stalls.seed, HS_PAUSES_OUTPUT, stalls.output);
    const uint64_t begin = rtl->begin = rtl->cycle;
    const uint64_t most = most_cycles(rtl, in, count, stalls);
    uint32_t next = 0, open = count; /* packets: on its way in; not yet answered */
    hs_axis shown = {0};
    while (open) {
        if (next == count)
            pins->s_axis.valid = false;
        else if (rtl_offer(&sender, rtl, &in[next]))
            view[next].start = rtl->cycle - begin;
        pins->m_axis_ready = !hs_pauses_next(&output);
        if (!rtl_settle(rtl, err)) return false;
        if (!rtl_check_beat(rtl, in, &shown, err)) return false;
        if (pins->m_axis.valid && pins->m_axis_ready) {
            const uint32_t i = answered(rtl, in, count, ended);
            if (i == count || i > next)
                return rtl_break_of_rule(rtl, in, "a beat of a view that is not in flight", err);
            if (!rtl_take_beat(rtl, &out[i], err)) return false;
            ended[i] = pins->m_axis.last;
            open -= pins->m_axis.last;
            view[i].end = rtl->cycle - begin;
            *cycles = view[i].end - view[0].start + 1;
        }
        if (next < count && rtl_sent(&sender, rtl) && sender.at >= in[next].words) {
            sender.at = 0;
            next++;
        }
        if (!rtl_edge(rtl, err)) return false;
        if (rtl->cycle - begin > most)
            return hs_fail(err, HS_EXIT_INTERNAL, "the RTL does not answer %u of %u views", open,
                           count);
    }
    pins->s_axis.valid = pins->m_axis_ready = false;
    return true;
}

bool hs_rtl_stream(hs_rtl *rtl, const hs_packet *in, uint32_t count, hs_stalls stalls,
                   hs_packet *out, hs_flight_view *view, uint64_t *cycles, hs_error *err) {
    for (uint32_t i = 0; i < count; i++) {
        out[i].view = in[i].view;
        out[i].words = 0;
    }
    *cycles = 0;
    bool *ended = calloc((size_t)count + 1, sizeof *ended);
    if (!ended)
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the simulation; free some memory");
    bool good = rtl_begin(rtl, err);
    if (good) {
        if (rtl->logs) hs_rtl_top_probe(rtl->top, note_transaction, rtl);
        good = stream_all(rtl, in, count, stalls, ended, out, view, cycles, err);
        hs_rtl_top_probe(rtl->top, NULL, NULL);
    }
    free(ended);
    const uint32_t before = rtl->before.views;
    if (!good || (count && !rtl_rest(rtl, in, err)) || !rtl_read_counters(rtl, &rtl->before, err))
        return false;
    if (rtl->before.views - before != count)
        return hs_fail(err, HS_EXIT_INTERNAL, "the RTL counts %u views instead of %u",
                       rtl->before.views - before, count);
    rtl_end(rtl);
    return true;
}
