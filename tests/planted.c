/* SPDX-License-Identifier: Apache-2.0
 *
 * Faults that HS_FAULT plants in a program at its linker's seams (--wrap): in engines, and in the
 * comparisons of them. The tests of the harness show that each is noticed.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare.h"
#include "model.h"
#include "reference.h"
#include "rtl.h"

static bool is(const char *fault) {
    const char *planted = getenv("HS_FAULT");
    return planted && strcmp(planted, fault) == 0;
}

/* With its CRC right again, so that the comparison alone can find it. */
static void seal(hs_packet *packet) {
    packet->word[packet->words - 1] = hs_packet_crc(packet);
}

static void spoil(hs_packet *out, const char *engine) {
    char fault[40];
    const size_t half = out->words / 2;
    const struct {
        const char *name;
        int kind;
    } all[] = {{"word", 0}, {"swap", 1}, {"cut", 2}, {"silent", 3}};
    for (int i = 0; i < 4; i++) {
        snprintf(fault, sizeof fault, "%s-%s", engine, all[i].name);
        if (!is(fault)) continue;
        if (i == 0) out->word[half] ^= 1u << 7;
        if (i == 1) { /* two neighbours that differ */
            size_t w = half;
            while (out->word[w] == out->word[w + 1])
                w++;
            const uint32_t first = out->word[w];
            out->word[w] = out->word[w + 1];
            out->word[w + 1] = first;
        }
        if (i < 2) seal(out);
        if (i == 2) out->words -= 8; /* trailer and end */
        if (i == 3) out->words = 0;
    }
}

bool __real_hs_golden_run(hs_golden *golden, const hs_packet *in, hs_packet *out,
                          hs_golden_report *report, hs_error *err);
bool __wrap_hs_golden_run(hs_golden *golden, const hs_packet *in, hs_packet *out,
                          hs_golden_report *report, hs_error *err);
bool __wrap_hs_golden_run(hs_golden *golden, const hs_packet *in, hs_packet *out,
                          hs_golden_report *report, hs_error *err) {
    const bool good = __real_hs_golden_run(golden, in, out, report, err);
    if (good) spoil(out, "golden");
    return good;
}

bool __real_hs_model_run(hs_model *m, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                         hs_golden_report *report, hs_cycle_report *cycles, hs_log *log,
                         hs_error *err);
bool __wrap_hs_model_run(hs_model *m, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                         hs_golden_report *report, hs_cycle_report *cycles, hs_log *log,
                         hs_error *err);
bool __wrap_hs_model_run(hs_model *m, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                         hs_golden_report *report, hs_cycle_report *cycles, hs_log *log,
                         hs_error *err) {
    const bool good = __real_hs_model_run(m, in, stalls, out, report, cycles, log, err);
    if (!good) return false;
    spoil(out, "model");
    if (is("model-cycles")) cycles->cycles++;
    if (is("model-late") && log) log->probe[HS_PROBE_op].transaction[1].cycle++;
    if (is("model-lost") && log) log->probe[HS_PROBE_op].count--;
    return true;
}

bool __real_hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                       hs_cycle_report *report, hs_error *err);
bool __wrap_hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                       hs_cycle_report *report, hs_error *err);
bool __wrap_hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                       hs_cycle_report *report, hs_error *err) {
    const bool good = __real_hs_rtl_run(rtl, in, stalls, out, report, err);
    if (!good) return false;
    spoil(out, "rtl");
    if (is("rtl-cycles")) report->cycles++;
    return true;
}

/* --- Comparisons that compare nothing -----------------------------------------------------------
 */

hs_word_comparison __real_hs_compare_words(const hs_packet *expected, const hs_packet *actual);
hs_word_comparison __wrap_hs_compare_words(const hs_packet *expected, const hs_packet *actual);
hs_word_comparison __wrap_hs_compare_words(const hs_packet *expected, const hs_packet *actual) {
    return is("words-skipped") ? (hs_word_comparison){0}
                               : __real_hs_compare_words(expected, actual);
}

hs_log_comparison __real_hs_log_compare(const hs_log *a, const char *a_name, const hs_log *b,
                                        const char *b_name, uint64_t skip);
hs_log_comparison __wrap_hs_log_compare(const hs_log *a, const char *a_name, const hs_log *b,
                                        const char *b_name, uint64_t skip);
hs_log_comparison __wrap_hs_log_compare(const hs_log *a, const char *a_name, const hs_log *b,
                                        const char *b_name, uint64_t skip) {
    return is("transactions-skipped") ? (hs_log_comparison){0}
                                      : __real_hs_log_compare(a, a_name, b, b_name, skip);
}

bool __real_hs_reference_compare(const hs_reference *r, const hs_output *o,
                                 hs_reference_comparison *c);
bool __wrap_hs_reference_compare(const hs_reference *r, const hs_output *o,
                                 hs_reference_comparison *c);
bool __wrap_hs_reference_compare(const hs_reference *r, const hs_output *o,
                                 hs_reference_comparison *c) {
    if (!is("reference-skipped")) return __real_hs_reference_compare(r, o, c);
    *c = (hs_reference_comparison){0};
    return true;
}
