/* SPDX-License-Identifier: Apache-2.0
 *
 * Views in flight: the model against an RTL of several pipelines, every transaction in each of
 * them, every word, and when each view began and ended; and each view's words against golden's.
 *
 *   parity-flight [PER CENT]
 */
#define PROGRAM "parity"

#include "quit.h"
#include "rtl_samples.h"

enum { STREAMS = 40, MOST = 24, PIPELINES = 8 };

typedef struct stream {
    hs_packet in[MOST], rtl[MOST], model[MOST];
    hs_golden_report report[MOST];
    hs_flight_view rtl_view[MOST], model_view[MOST];
    uint32_t count;
} stream;

static void differ(uint32_t number, const char *what) {
    fprintf(stderr, "parity: stream %u: %s\n", number, what);
    exit(HS_EXIT_DIFFERENT);
}

/* Views of different meshes, settings and lengths, some of them refused. */
static void fill(stream *s, uint32_t number, uint64_t *random) {
    static const char *const name[] = {"cube", "grid", "torus", "mixed", "random", "die"};
    hs_error err;
    s->count = 1 + random_below(random, MOST);
    for (uint32_t i = 0; i < s->count; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        const uint32_t k = random_below(random, 6);
        make_shape(&mesh, name[k], k == 4 ? 30 : 0, number);
        make_views(&mesh, view);
        hs_settings settings = random_below(random, 3) == 0
                                   ? uniform((uint8_t)random_below(random, 6))
                                   : adaptive((uint8_t)random_below(random, 4),
                                              (uint8_t)random_below(random, 7), true);
        settings.boundary = HS_BOUNDARY_SMOOTH;
        settings.limit = random_below(random, 4) == 0;
        quit_on(hs_packet_encode(&s->in[i], i, &mesh, view[random_below(random, VIEWS)].matrix,
                                 &settings, &err),
                &err);
        if (random_below(random, 9) == 0) s->in[i].word[random_below(random, 30)] ^= 1u << 30;
        hs_mesh_free(&mesh);
    }
}

static void compare(stream *s, uint32_t number, hs_golden *golden, const hs_log *rtl,
                    const hs_log *model, uint32_t pipelines, uint64_t *compared) {
    hs_packet expected = {0};
    hs_golden_report report;
    hs_error err;
    bool refused = false;
    for (uint32_t i = 0; i < s->count; i++) {
        char what[200];
        quit_on(hs_golden_run(golden, &s->in[i], &expected, &report, &err), &err);
        refused = refused || report.status > HS_STATUS_STOPPED;
        snprintf(what, sizeof what, "view %u: the words are not golden's", i);
        if (hs_compare_words(&expected, &s->rtl[i]).different ||
            hs_compare_words(&expected, &s->model[i]).different)
            differ(number, what);
        snprintf(what, sizeof what, "view %u: rtl from %llu to %llu, model from %llu to %llu", i,
                 (unsigned long long)s->rtl_view[i].start, (unsigned long long)s->rtl_view[i].end,
                 (unsigned long long)s->model_view[i].start,
                 (unsigned long long)s->model_view[i].end);
        if (s->rtl_view[i].start != s->model_view[i].start ||
            s->rtl_view[i].end != s->model_view[i].end)
            differ(number, what);
    }
    for (uint32_t p = 0; p < pipelines; p++) {
        const hs_log_comparison c = hs_log_compare(&rtl[p], "rtl", &model[p], "model",
                                                   refused ? HS_LOG_DATA_OF_REFUSED : 0);
        char what[500];
        snprintf(what, sizeof what, "pipeline %u: %llu of %llu transactions differ; %s", p,
                 (unsigned long long)c.different, (unsigned long long)c.compared, c.text);
        if (c.different) differ(number, what);
        *compared += c.compared;
    }
    hs_packet_free(&expected);
}

int main(int argc, char **argv) {
    static stream s;
    static hs_log rtl_log[PIPELINES], model_log[PIPELINES];
    const double percent = argc > 1 ? atof(argv[1]) : 100;
    const uint32_t streams = percent < 100 ? 1 + (uint32_t)(STREAMS * percent / 100) : STREAMS;
    hs_error err = {0};
    uint64_t random = 17, transactions = 0, simulated = 0, views = 0;
    hs_rtl *rtl = hs_rtl_new(HS_DEFAULT_LIMITS, 1, &err);
    quit_on(rtl != NULL, &err);
    const hs_model_config c = hs_rtl_config(rtl);
    hs_flight *flight = hs_flight_new(HS_DEFAULT_LIMITS, c, &err);
    quit_on(flight != NULL, &err);
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    hs_rtl_logs(rtl, rtl_log);
    printf("%u views in flight, port %u, banks %u, window %u, lanes %u, latency %u, ops %u\n",
           c.views, c.port, c.banks, c.window, c.lanes, c.latency, c.ops);
    for (uint32_t i = 0; i < streams; i++) {
        uint64_t rtl_cycles, model_cycles;
        fill(&s, i, &random);
        const hs_stalls stalls = {.seed = i + 1,
                                  .input = i % 3 ? 0 : (uint8_t)random_below(&random, 90),
                                  .output = i % 2 ? 0 : (uint8_t)random_below(&random, 90)};
        for (uint32_t p = 0; p < PIPELINES; p++)
            hs_log_clear(&rtl_log[p]);
        quit_on(hs_rtl_stream(rtl, s.in, s.count, stalls, s.rtl, s.rtl_view, &rtl_cycles, &err),
                &err);
        quit_on(hs_flight_run(flight, s.in, s.count, stalls, s.model, s.report, s.model_view,
                              &model_cycles, model_log, &err),
                &err);
        compare(&s, i, golden, rtl_log, model_log, c.views, &transactions);
        if (rtl_cycles != model_cycles) differ(i, "rtl and model end in different cycles");
        views += s.count;
        simulated += rtl_cycles;
    }
    printf("%-34s %6llu views %12llu transactions %12llu cycles  0 differences\n",
           "streams of views", (unsigned long long)views, (unsigned long long)transactions,
           (unsigned long long)simulated);
    hs_flight_free(flight);
    hs_golden_free(golden);
    hs_rtl_free(rtl);
    return transactions ? HS_EXIT_OK : HS_EXIT_DIFFERENT;
}
