/* SPDX-License-Identifier: Apache-2.0
 *
 * The timeline files of the RTL and of the model: the same, byte for byte. Each is made from its
 * own log, report and status.
 */
#include "rtl_samples.h"

#include "timeline.h"

typedef struct text {
    char *bytes;
    size_t size;
} text;

enum { JSON, KANATA, SVG, FILES };

static void write_one(FILE *file, int kind, const hs_timeline *t) {
    hs_error err;
    if (kind == JSON) {
        hs_timeline_json json;
        assert_true(hs_timeline_json_begin(&json, file, "title", &t->source.config, &err));
        assert_true(hs_timeline_json_view(&json, t, &err));
        hs_timeline_json_end(&json);
    } else if (kind == KANATA) {
        hs_timeline_kanata kanata;
        hs_timeline_kanata_begin(&kanata, file);
        assert_true(hs_timeline_kanata_view(&kanata, t, &err));
    } else {
        hs_timeline_svg(file, t, "title");
    }
}

static void write_all(text files[FILES], const hs_log *log, const hs_cycle_report *cycles,
                      const hs_packet *sent, hs_model_config config, bool limit) {
    hs_error err;
    hs_output output;
    hs_timeline t;
    if (!hs_output_decode(&output, sent, &err)) fail_msg("%s", err.text);
    const hs_timeline_source source = {.log = log,
                                       .cycles = cycles,
                                       .config = config,
                                       .view = 1,
                                       .status = output.status,
                                       .limit = limit};
    assert_true(hs_timeline_make(&t, &source, &err));
    for (int k = 0; k < FILES; k++) {
        FILE *file = open_memstream(&files[k].bytes, &files[k].size);
        assert_non_null(file);
        write_one(file, k, &t);
        assert_int_equal(fclose(file), 0);
    }
    hs_timeline_free(&t);
    hs_output_free(&output);
}

static void free_all(text files[FILES]) {
    for (int k = 0; k < FILES; k++)
        free(files[k].bytes);
}

/* Compares the files of the view that the bench has just run; the bytes of all. */
static size_t same_files(const bench *b, bool limit, const char *what) {
    static const char *const name[FILES] = {"JSON", "Kanata", "SVG"};
    const hs_model_config config = hs_rtl_config(b->rtl);
    text rtl[FILES], model[FILES];
    size_t size = 0;
    write_all(rtl, &b->rtl_log, &b->rtl_report, &b->actual, config, limit);
    write_all(model, &b->model_log, &b->model_report, &b->modelled, config, limit);
    for (int k = 0; k < FILES; k++) {
        if (rtl[k].size != model[k].size || memcmp(rtl[k].bytes, model[k].bytes, rtl[k].size) != 0)
            fail_msg("%s: the %s of rtl and model differ", what, name[k]);
        size += rtl[k].size;
    }
    free_all(rtl);
    free_all(model);
    return size;
}

static void the_files_of_rtl_and_model_are_the_same(void **state) {
    bench *b = *state;
    static const struct {
        const char *shape;
        uint32_t size;
        hs_settings settings;
        hs_stalls stalls;
    } sample[] = {
        {"cube", 0, {.front_depth = 4, .silhouette_depth = 8, .guard = true}, {0}},
        {"cube", 0, {.uniform = true, .uniform_depth = 5}, {.seed = 2, .input = 30, .output = 60}},
        {"grid", 8, {.front_depth = 2, .silhouette_depth = 4, .guard = true}, {0}},
        {"grid",
         8,
         {.front_depth = 3,
          .silhouette_depth = 5,
          .guard = true,
          .boundary = HS_BOUNDARY_SMOOTH,
          .limit = true},
         {0}},
        {"mixed", 0, {.front_depth = 2, .silhouette_depth = 5}, {.seed = 9, .output = 85}},
        {"monster", 0, {.front_depth = 4, .silhouette_depth = 8, .guard = true}, {0}},
    };
    for (size_t i = 0; i < sizeof sample / sizeof *sample; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_shape(&mesh, sample[i].shape, sample[i].size, 1);
        make_views(&mesh, view);
        assert_same_view(b, 1, &mesh, view[i % 8].matrix, &sample[i].settings, sample[i].stalls,
                         sample[i].shape);
        const size_t bytes = same_files(b, sample[i].settings.limit, sample[i].shape);
        print_message("%s: %zu bytes\n", sample[i].shape, bytes);
        assert_true(bytes > 10000);
        hs_mesh_free(&mesh);
    }
}

/* Of a packet that it refuses the model does not know all that the RTL does. */
static void so_are_those_of_refused_packets(void **state) {
    bench *b = *state;
    hs_mesh mesh;
    hs_view view[VIEWS];
    hs_error err;
    uint64_t random = 4;
    uint32_t refused = 0;
    const hs_settings s = adaptive(1, 2, true);
    make_shape(&mesh, "mixed", 0, 0);
    make_views(&mesh, view);
    for (uint32_t i = 0; i < 60; i++) {
        assert_true(hs_packet_encode(&b->in, 1, &mesh, view[0].matrix, &s, &err));
        b->in.word[random_below(&random, (uint32_t)b->in.words)] ^= 1u << random_below(&random, 32);
        if (i % 2) mend_crc(&b->in);
        assert_same_words(b, &b->in, no_stalls, "refused");
        refused += b->golden_report.status > HS_STATUS_STOPPED;
        assert_true(same_files(b, false, "refused") > 1000);
    }
    assert_true(refused > 30);
    hs_mesh_free(&mesh);
}

/* What the logs do not share, the files do not share. */
static void a_cycle_more_is_another_file(void **state) {
    bench *b = *state;
    hs_mesh mesh;
    hs_view view[VIEWS];
    const hs_settings s = adaptive(2, 4, true);
    make_shape(&mesh, "cube", 0, 0);
    make_views(&mesh, view);
    assert_same_view(b, 1, &mesh, view[0].matrix, &s, no_stalls, "cube");
    const hs_model_config config = hs_rtl_config(b->rtl);
    text before[FILES], behind[FILES];
    write_all(before, &b->model_log, &b->model_report, &b->modelled, config, false);
    const size_t last = b->model_log.probe[HS_PROBE_guard_in].count - 1;
    b->model_log.probe[HS_PROBE_guard_in].transaction[last].cycle++;
    write_all(behind, &b->model_log, &b->model_report, &b->modelled, config, false);
    for (int k = JSON; k <= KANATA; k++)
        assert_true(before[k].size != behind[k].size ||
                    memcmp(before[k].bytes, behind[k].bytes, before[k].size) != 0);
    free_all(before);
    free_all(behind);
    hs_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_files_of_rtl_and_model_are_the_same),
        cmocka_unit_test(so_are_those_of_refused_packets),
        cmocka_unit_test(a_cycle_more_is_another_file),
    };
    return cmocka_run_group_tests_name("rtl_timeline", tests, set_up_bench, tear_down_bench);
}
