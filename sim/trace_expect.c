/* SPDX-License-Identifier: Apache-2.0
 *
 * From packets to what is expected of the engines: expected.json.
 */
#include "compare.h"
#include "trace.h"

static json_t *expect_view(const hs_packet *packet, const hs_golden_report *golden,
                           const hs_cycle_report *rtl) {
    char digest[11];
    snprintf(digest, sizeof digest, "0x%08x", hs_packet_crc(packet));
    return json_pack(
        "{s:i, s:s, s:o, s:I, s:s, s:i, s:i, s:i, s:i, s:I}", "view", (int)packet->view, "status",
        hs_status_name(golden->status), "position",
        golden->error_position == HS_NO_POSITION ? json_null()
                                                 : json_integer((json_int_t)golden->error_position),
        "words", (json_int_t)packet->words, "digest", digest, "vertices", (int)golden->vertices,
        "faces", (int)golden->faces, "triangles", (int)golden->triangles, "generations",
        (int)golden->generations, "cycles", (json_int_t)rtl->cycles);
}

/* One view through both engines; its expectation goes into views. */
static bool expect_one(const hs_trace *trace, const char *folder, hs_golden *golden, hs_rtl *rtl,
                       const hs_packet *in, json_t *views, hs_error *err) {
    hs_packet wanted = {0}, sent = {0};
    hs_golden_report golden_report;
    hs_cycle_report rtl_report;
    bool good = hs_golden_run(golden, in, &wanted, &golden_report, err) &&
                hs_rtl_run(rtl, in, trace->stalls, &sent, &rtl_report, err);
    if (good) {
        const hs_word_comparison words = hs_compare_words(&wanted, &sent);
        if (words.compared == 0) {
            good = hs_fail(err, HS_EXIT_DIFFERENT, "%.100s, view %u: no word was compared", folder,
                           in->view);
        } else if (words.different) {
            char text[400];
            hs_compare_describe(&wanted, &sent, words.first, "rtl", text, sizeof text);
            good = hs_fail(err, HS_EXIT_DIFFERENT, "%.100s, view %u: %s", folder, in->view, text);
        } else if (json_array_append_new(views,
                                         expect_view(&wanted, &golden_report, &rtl_report)) != 0) {
            good = hs_fail(err, HS_EXIT_INTERNAL, "no memory for what is expected");
        }
    }
    hs_packet_free(&wanted);
    hs_packet_free(&sent);
    return good;
}

json_t *hs_trace_expect(const hs_trace *trace, const char *folder, hs_error *err) {
    json_t *views = json_array();
    hs_golden *golden = hs_golden_new(trace->limits);
    hs_rtl *rtl = golden ? hs_rtl_new(trace->limits, trace->stalls.seed, err) : NULL;
    bool good = rtl && views;
    if (!golden || !views) hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    for (uint32_t i = 0; good && i < trace->input.packets; i++)
        good = expect_one(trace, folder, golden, rtl, &trace->input.packet[i], views, err);
    hs_rtl_free(rtl);
    hs_golden_free(golden);
    if (!good) {
        json_decref(views);
        return NULL;
    }
    json_t *expected = json_pack("{s:i, s:o}", "stream", HS_STREAM_VERSION, "views", views);
    if (!expected) hs_fail(err, HS_EXIT_INTERNAL, "no memory for what is expected");
    return expected;
}
