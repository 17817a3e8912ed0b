/* SPDX-License-Identifier: Apache-2.0
 *
 * Beats in and out of the Verilated pipeline, and the rules of its output stream.
 */
#include <string.h>

#include "rtl_parts.h"

bool rtl_offer(rtl_sender *sender, hs_rtl *rtl, const hs_packet *in) {
    hs_axis *axis = &rtl->pins.s_axis;
    const size_t beat = hs_rtl_top_beat_words();
    if (!sender->offered && !hs_pauses_next(&sender->pauses)) {
        const size_t left = in->words - sender->at, words = left < beat ? left : beat;
        memset(axis->data, 0, sizeof axis->data);
        if (words) memcpy(axis->data, in->word + sender->at, 4 * words);
        axis->keep = words == 16 ? ~UINT64_C(0) : (UINT64_C(1) << 4 * words) - 1;
        axis->last = left <= beat;
        axis->id = (uint16_t)in->view;
        axis->valid = sender->offered = true;
        return sender->at == 0;
    }
    axis->valid = sender->offered;
    return false;
}

bool rtl_sent(rtl_sender *sender, const hs_rtl *rtl) {
    if (!sender->offered || !rtl->pins.s_axis_ready) return false;
    sender->offered = false;
    sender->at += hs_rtl_top_beat_words();
    return true;
}

bool rtl_break_of_rule(const hs_rtl *rtl, const hs_packet *in, const char *what, hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL,
                   "view %u, cycle %llu: the RTL breaks a rule of its output stream: %s", in->view,
                   (unsigned long long)rtl->cycle, what);
}

bool rtl_check_beat(const hs_rtl *rtl, const hs_packet *in, hs_axis *shown, hs_error *err) {
    const hs_axis *axis = &rtl->pins.m_axis;
    const size_t beat = hs_rtl_top_beat_words();
    const bool stood = shown->valid;
    if (stood && !axis->valid)
        return rtl_break_of_rule(rtl, in, "tvalid fell before the beat was taken", err);
    shown->valid = axis->valid && !rtl->pins.m_axis_ready;
    if (!axis->valid) return true;
    if (stood && (shown->last != axis->last || shown->id != axis->id || shown->keep != axis->keep ||
                  memcmp(shown->data, axis->data, 4 * beat) != 0))
        return rtl_break_of_rule(rtl, in, "a beat changed before it was taken", err);
    if (shown->valid) *shown = *axis;
    /* Whole records, from the lowest up; fewer than a beat holds only at the end. */
    uint64_t full = 0;
    for (size_t records = 1; records <= beat / 4; records++) {
        full = full << 16 | 0xffff;
        if (axis->keep == full && (axis->last || records == beat / 4)) return true;
    }
    return rtl_break_of_rule(rtl, in, "tkeep is not a row of whole records, or has gaps", err);
}

bool rtl_take_beat(const hs_rtl *rtl, hs_packet *out, hs_error *err) {
    const hs_axis *axis = &rtl->pins.m_axis;
    return hs_packet_append(out, axis->data, (size_t)__builtin_popcountll(axis->keep) / 16, err);
}

bool rtl_rest(hs_rtl *rtl, const hs_packet *in, hs_error *err) {
    const uint64_t begin = rtl->cycle;
    for (uint32_t busy = 1; busy;) {
        if (!rtl_read_register(rtl, HS_REG_BUSY, &busy, err)) return false;
        if (rtl->pins.m_axis.valid)
            return rtl_break_of_rule(rtl, in, "a beat behind the packet's last one", err);
        if (rtl->cycle - begin > rtl_most_silence(rtl))
            return hs_fail(err, HS_EXIT_INTERNAL, "view %u: the RTL stays busy behind it",
                           in->view);
    }
    return true;
}
