/* SPDX-License-Identifier: Apache-2.0
 *
 * Streams the packets of traces through the rtl and writes everything that came of them: each word
 * with its cycle, when the view began and ended, all counters. Two simulators, or one with other
 * initial contents, have to write the same text.
 *
 *   words SEED INPUT OUTPUT TRACE...
 *
 * SEED is that of the initial contents; INPUT and OUTPUT are pauses of the streams in per cent, 0
 * and 0: those of the trace. The last line adds up.
 */
#include <stdio.h>
#include <stdlib.h>

#include "trace.h"

static struct { uint64_t views, words, cycles; } sum;

static void write_view(const hs_rtl *rtl, const hs_packet *out, const hs_cycle_report *r) {
    printf("view %u: begin %llu, start %llu, first %llu, end %llu, conflicts %llu\n", out->view,
           (unsigned long long)r->begin, (unsigned long long)r->start,
           (unsigned long long)r->first_out, (unsigned long long)r->end,
           (unsigned long long)r->conflicts);
    for (size_t w = 0; w < out->words; w++)
        printf("%08x %llu\n", out->word[w], (unsigned long long)hs_rtl_word_cycle(rtl, w));
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        printf("%s:", hs_stage_name(s));
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++)
            printf(" %llu", (unsigned long long)r->activity[s][a]);
        printf(" %llu %llu\n", (unsigned long long)r->items_in[s],
               (unsigned long long)r->items_out[s]);
    }
}

static bool stream_trace(const char *folder, uint32_t seed, uint8_t input, uint8_t output,
                         hs_error *err) {
    hs_trace trace;
    hs_packet out = {0};
    hs_cycle_report report;
    if (!hs_trace_compile(&trace, folder, err)) return false;
    if (input || output) trace.stalls = (hs_stalls){.seed = 1, .input = input, .output = output};
    printf("%s, stalls %u %u %u\n", folder, trace.stalls.input, trace.stalls.output,
           trace.stalls.seed);
    hs_rtl *rtl = hs_rtl_new(trace.limits, seed, err);
    bool good = rtl != NULL;
    for (uint32_t i = 0; good && i < trace.input.packets; i++) {
        good = hs_rtl_run(rtl, &trace.input.packet[i], trace.stalls, &out, &report, err);
        if (!good) break;
        write_view(rtl, &out, &report);
        sum.views++;
        sum.words += out.words;
    }
    if (rtl) sum.cycles += hs_rtl_cycle(rtl);
    hs_rtl_free(rtl);
    hs_packet_free(&out);
    hs_trace_free(&trace);
    return good;
}

int main(int argc, char **argv) {
    if (argc < 5) {
        fprintf(stderr, "usage: words SEED INPUT OUTPUT TRACE...\n");
        return HS_EXIT_USAGE;
    }
    hs_error err;
    for (int i = 4; i < argc; i++)
        if (!stream_trace(argv[i], (uint32_t)strtoul(argv[1], NULL, 0), (uint8_t)atoi(argv[2]),
                          (uint8_t)atoi(argv[3]), &err)) {
            fprintf(stderr, "words: %s: %s\n", argv[i], err.text);
            return err.code;
        }
    printf("%llu views, %llu words, %llu cycles\n", (unsigned long long)sum.views,
           (unsigned long long)sum.words, (unsigned long long)sum.cycles);
    return HS_EXIT_OK;
}
