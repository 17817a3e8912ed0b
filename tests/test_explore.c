/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep explore: its figures are the model's, and whatever happens to it on the way, the reports
 * come out the same: interrupted, killed, torn, in parts.
 */
#include <fcntl.h>
#include <jansson.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>

#include "place.h"

#include "commands.h"
#include "explore.h"
#include "shape.h"
#include "view.h"

static hs_error last;

/* Runs a command line, single spaces, @ for the folder; its words go to a file in the folder. */
static int run(const char *format) {
    char line[1000], *rest = line, *word, *argument[40];
    int count = 0;
    const int length = snprintf(line, sizeof line, "%s", with_folder(&place, format));
    assert_in_range(length, 1, sizeof line - 1);
    while (count < 40 && (word = strsep(&rest, " ")) != NULL)
        argument[count++] = word;
    const int said = open(inside(&place, "said"), O_RDWR | O_CREAT | O_TRUNC, 0666), out = dup(1);
    fflush(stdout);
    dup2(said, 1);
    const int code = hs_command_explore(count, argument, &last);
    fflush(stdout);
    dup2(out, 1);
    close(said);
    close(out);
    return code;
}

static void run_well(const char *line) {
    const int code = run(line);
    if (code != HS_EXIT_OK) fail_msg("%s: %d, %s", line, code, last.text);
}

static void expect(int code, const char *line, const char *words) {
    assert_int_equal(run(line), code);
    if (!strstr(last.text, words)) fail_msg("%s: no \"%s\" in \"%s\"", line, words, last.text);
}

static char *text_of(const char *name) {
    uint8_t *bytes;
    size_t size;
    hs_error err;
    if (!hs_file_read(inside(&place, name), 1 << 24, &bytes, &size, &err)) fail_msg("%s", err.text);
    return (char *)bytes;
}

static void assert_same_file(const char *a, const char *b) {
    char *x = text_of(a), *y = text_of(b);
    assert_string_equal(x, y);
    free(x);
    free(y);
}

/* --- Figures ------------------------------------------------------------------------------------
 */
#define SPACE                                                                                      \
    "explore shape:torus --orbit 2 --silhouette 5 --set banks=4,8 --set window=2,8 --quiet"

/* Each point of the JSON against a run of the model of its own. */
static void every_point_is_what_the_model_says(void **state) {
    (void)state;
    hs_mesh mesh;
    hs_views views;
    hs_error err;
    run_well(SPACE " --clock 500 --out @/a");
    char *text = text_of("a/explore.json");
    json_t *root = json_loads(text, 0, NULL), *points = json_object_get(root, "points");
    assert_int_equal(json_array_size(points), 8);
    assert_true(hs_shape_make(&mesh, "torus", 0, 0, &err));
    assert_true(hs_views_orbit(&views, 2, &mesh, 1, &err));
    const hs_settings settings = {
        .front_depth = 4, .silhouette_depth = 5, .guard = true, .boundary = HS_BOUNDARY_SMOOTH};
    for (size_t i = 0; i < 8; i++) {
        json_t *point = json_array_get(points, i), *set = json_object_get(point, "set");
        hs_model_config config = HS_DEFAULT_CONFIG;
        config.banks = (uint32_t)json_integer_value(json_object_get(set, "banks"));
        config.window = (uint32_t)json_integer_value(json_object_get(set, "window"));
        assert_int_equal(config.banks, i < 4 ? 4 : 8);
        assert_int_equal(config.window, i / 2 % 2 ? 8 : 2);
        hs_model *model = hs_model_new(HS_DEFAULT_LIMITS, config, &err);
        hs_packet in = {0}, out = {0};
        hs_golden_report report;
        hs_cycle_report cycles;
        assert_non_null(model);
        assert_true(hs_packet_encode(&in, (uint32_t)i % 2, &mesh, views.view[i % 2].matrix,
                                     &settings, &err));
        assert_true(hs_model_run(model, &in, (hs_stalls){0}, &out, &report, &cycles, NULL, &err));
        assert_int_equal(json_integer_value(json_object_get(point, "cycles")), cycles.cycles);
        assert_int_equal(json_integer_value(json_object_get(point, "faces")), report.faces);
        assert_int_equal(json_integer_value(json_object_get(point, "memory_bits")),
                         hs_model_memory_bits(&config));
        const double views_per_second = json_real_value(json_object_get(point, "views_per_second"));
        assert_true(views_per_second * (double)cycles.cycles > 499e6 &&
                    views_per_second * (double)cycles.cycles < 501e6);
        json_int_t sum = 0;
        const char *name;
        json_t *value;
        json_object_foreach(json_object_get(json_object_get(point, "stages"), "split"), name, value)
            sum += json_integer_value(value);
        assert_int_equal(sum, cycles.cycles);
        hs_model_free(model);
        hs_packet_free(&in);
        hs_packet_free(&out);
    }
    json_decref(root);
    free(text);
    hs_views_free(&views);
    hs_mesh_free(&mesh);
}

/* The points of an architecture with several views in flight against a stream of its own. */
static void views_in_a_row_are_what_the_model_says(void **state) {
    (void)state;
    enum { VIEWS = 5 };
    hs_mesh mesh;
    hs_views views;
    hs_error err;
    run_well("explore shape:torus --orbit 5 --set views=2 --clock 500 --quiet --out @/row");
    char *text = text_of("row/explore.json");
    json_t *root = json_loads(text, 0, NULL), *points = json_object_get(root, "points");
    assert_int_equal(json_array_size(points), VIEWS);
    assert_true(hs_shape_make(&mesh, "torus", 0, 0, &err));
    assert_true(hs_views_orbit(&views, VIEWS, &mesh, 1, &err));
    const hs_settings settings = {
        .front_depth = 4, .silhouette_depth = 8, .guard = true, .boundary = HS_BOUNDARY_SMOOTH};
    hs_packet in[VIEWS] = {0}, out[VIEWS] = {0};
    hs_golden_report report[VIEWS];
    hs_flight_view view[VIEWS];
    hs_model_config config = HS_DEFAULT_CONFIG;
    uint64_t cycles;
    config.views = 2;
    for (uint32_t v = 0; v < VIEWS; v++)
        assert_true(hs_packet_encode(&in[v], v, &mesh, views.view[v].matrix, &settings, &err));
    hs_flight *flight = hs_flight_new(HS_DEFAULT_LIMITS, config, &err);
    assert_non_null(flight);
    assert_true(
        hs_flight_run(flight, in, VIEWS, (hs_stalls){0}, out, report, view, &cycles, NULL, &err));
    for (uint32_t v = 0; v < VIEWS; v++) {
        json_t *point = json_array_get(points, v);
        const json_int_t own = json_integer_value(json_object_get(point, "cycles"));
        assert_int_equal(json_integer_value(json_object_get(point, "view")), v);
        assert_int_equal(json_integer_value(json_object_get(point, "stream_cycles")), cycles);
        assert_int_equal(json_integer_value(json_object_get(point, "faces")), report[v].faces);
        assert_int_equal(own + 1, view[v].end - view[v].start + 1); /* collect adds a cycle */
        const json_int_t trailer = json_integer_value(json_object_get(point, "trailer"));
        assert_in_range(trailer, own - 2, own - 1); /* it may end in a beat of its own */
        hs_packet_free(&in[v]);
        hs_packet_free(&out[v]);
    }
    const double row = (double)cycles / VIEWS, rate = json_real_value(json_object_get(
                                                   json_array_get(points, 0), "views_per_second"));
    assert_true(rate * row > 499e6 && rate * row < 501e6);
    hs_flight_free(flight);
    json_decref(root);
    free(text);
    hs_views_free(&views);
    hs_mesh_free(&mesh);
}

/* Depths that are not given: 24 with a least edge. */
static void options_mean_what_they_mean_to_run(void **state) {
    (void)state;
    run_well("explore shape:torus --min-edge-px 8 --quiet --out @/edge");
    run_well("explore shape:torus --min-edge-px 8 --front 24 --silhouette 24 --quiet --out @/deep");
    assert_same_file("edge/explore.csv", "deep/explore.csv");
    expect(HS_EXIT_USAGE, "explore shape:torus --uniform 2 --silhouette 3 --out @/x", "drop it");
    expect(HS_EXIT_USAGE, "explore shape:torus --uniform 2 --force @/depths --out @/x", "drop it");
    expect(HS_EXIT_USAGE, "explore shape:torus --views a --orbit 2 --out @/x",
           "exclude each other");
}

static void every_line_of_the_csv_has_every_column(void **state) {
    (void)state;
    run_well(SPACE " --out @/csv");
    char *text = text_of("csv/explore.csv"), *rest = text, *line;
    uint32_t lines = 0, columns = 0;
    while ((line = strsep(&rest, "\n")) != NULL && *line) {
        uint32_t commas = 0;
        for (const char *c = line; *c; c++)
            commas += *c == ',';
        if (lines++ == 0) columns = commas;
        assert_int_equal(commas, columns);
    }
    assert_int_equal(lines, 1 + 8);
    assert_int_equal(columns + 1, HS_EXPLORE_NAMES + 15 + HS_STAGES * HS_ACTIVITIES);
    free(text);
}

/* --- Interruptions -------------------------------------------------------------------------------
 */
/* Cuts a folder's journal off every so many bytes; the same command makes the same of it as is in
 * another folder. */
static void tear(const char *line, const char *torn, const char *whole, size_t step) {
    char journal[60], report[60], expected[60];
    snprintf(journal, sizeof journal, "%s/shard-1-of-1.csv", torn);
    snprintf(report, sizeof report, "%s/explore.csv", torn);
    snprintf(expected, sizeof expected, "%s/explore.csv", whole);
    char *text = text_of(journal);
    for (size_t cut = strlen(text); cut > 0; cut = cut > step ? cut - step : 0) {
        FILE *file = fopen(inside(&place, journal), "w");
        assert_non_null(file);
        fwrite(text, 1, cut, file);
        fclose(file);
        run_well(line);
        assert_same_file(report, expected);
    }
    free(text);
}

static void a_torn_journal_is_mended_and_continued(void **state) {
    (void)state;
    run_well(SPACE " --out @/whole");
    run_well(SPACE " --out @/torn");
    tear(SPACE " --out @/torn", "torn", "whole", 97);
}

static void killed_at_any_time_it_goes_on_where_it_was(void **state) {
    (void)state;
    run_well(SPACE " --out @/uncut");
    uint32_t killed = 0;
    for (uint32_t i = 0; i < 12; i++) {
        fflush(stdout);
        const pid_t child = fork();
        if (child == 0) _exit(run(SPACE " --jobs 1 --out @/cut") == HS_EXIT_OK ? 0 : 1);
        usleep(1000 + 1500 * i);
        kill(child, SIGKILL);
        int status;
        waitpid(child, &status, 0);
        killed += WIFSIGNALED(status);
    }
    run_well(SPACE " --out @/cut");
    assert_same_file("cut/explore.csv", "uncut/explore.csv");
    print_message("killed %u times\n", killed);
}

/* Views in flight keep an architecture's points together, in whichever part. */
static void parts_of_streams_are_the_whole(void **state) {
    (void)state;
#define STREAMS "explore shape:torus --orbit 3 --silhouette 5 --set views=1,2,3 --set banks=4,8 -q"
    run_well(STREAMS " --out @/streams");
    /* Runs in turn: of views 1, three points; of 2 and 3, one of three points; twice. */
    static const uint32_t points[] = {1 + 3 + 1 + 3, 1 + 3 + 1, 1 + 1 + 3};
    for (uint32_t part = 1; part <= 3; part++) {
        uint32_t lines = 0;
        char line[200];
        snprintf(line, sizeof line, STREAMS " --out @/stream-parts --shard %u/3", part);
        run_well(line);
        char name[60];
        snprintf(name, sizeof name, "stream-parts/shard-%u-of-3.csv", part);
        char *text = text_of(name);
        for (const char *c = text; *c; c++)
            lines += *c == '\n';
        assert_int_equal(lines, 1 + points[part - 1]);
        free(text);
    }
    run_well(STREAMS " --out @/stream-parts");
    assert_same_file("stream-parts/explore.csv", "streams/explore.csv");
    /* A row that was cut off takes its stream along. */
    tear(STREAMS " --out @/streams", "streams", "stream-parts", 397);
}

static void parts_put_together_are_the_whole(void **state) {
    (void)state;
    run_well(SPACE " --out @/one");
    run_well(SPACE " --out @/parts --shard 1/3");
    run_well(SPACE " --out @/parts --shard 3/3");
    assert_int_not_equal(access(inside(&place, "parts/explore.csv"), F_OK), 0);
    run_well(SPACE " --out @/parts --shard 2/3");
    run_well(SPACE " --out @/parts");
    assert_same_file("parts/explore.csv", "one/explore.csv");
    assert_same_file("parts/explore.json", "one/explore.json");
    /* With a part missing the rest is done. */
    assert_int_equal(unlink(inside(&place, "parts/shard-2-of-3.csv")), 0);
    assert_int_equal(unlink(inside(&place, "parts/shard-1-of-1.csv")), 0);
    run_well(SPACE " --out @/parts");
    assert_same_file("parts/explore.csv", "one/explore.csv");
}

/* --- What is refused
 * ------------------------------------------------------------------------------
 */
static void journals_of_something_else_or_in_use_are_left_alone(void **state) {
    (void)state;
    run_well(SPACE " --out @/used");
    expect(HS_EXIT_USAGE, SPACE " --front 3 --out @/used", "another exploration");
    expect(HS_EXIT_USAGE, SPACE " --set lanes=4 --out @/used", "another exploration");
    const int file = open(inside(&place, "used/shard-1-of-1.csv"), O_RDONLY);
    assert_int_equal(flock(file, LOCK_EX), 0);
    expect(HS_EXIT_USAGE, SPACE " --out @/used", "another process");
    close(file);
    run_well(SPACE " --out @/used");
}

static void a_wrong_setting_says_what_would_be_right(void **state) {
    (void)state;
    expect(HS_EXIT_USAGE, "explore shape:cube --set bank=4 --out @/x", "did you mean \"banks\"?");
    expect(HS_EXIT_USAGE, "explore shape:cube --set banks --out @/x", "NAME=VALUE");
    expect(HS_EXIT_USAGE, "explore shape:cube --set banks= --out @/x", "no number");
    expect(HS_EXIT_USAGE, "explore shape:cube --set banks=4,,8 --out @/x", "no number");
    expect(HS_EXIT_USAGE, "explore shape:cube --set banks=3 --out @/x", "2, 4, 8 or 16");
    expect(HS_EXIT_USAGE, "explore shape:cube --set banks=4,4 --out @/x", "there twice");
    expect(HS_EXIT_USAGE, "explore shape:cube --set banks=4 --set banks=8 --out @/x",
           "given twice");
    expect(HS_EXIT_USAGE, "explore shape:cube --shard 4/3 --out @/x", "--shard");
    expect(HS_EXIT_USAGE, "explore shape:cube --shard 0/3 --out @/x", "--shard");
    expect(HS_EXIT_USAGE, "explore shape:cube --clock fast --out @/x", "megahertz");
    expect(HS_EXIT_FILE, "explore shape:cube --out /dev/null/x", "cannot");
    expect(HS_EXIT_FILE, "explore @/none.obj --out @/x", "none.obj");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_point_is_what_the_model_says),
        cmocka_unit_test(views_in_a_row_are_what_the_model_says),
        cmocka_unit_test(options_mean_what_they_mean_to_run),
        cmocka_unit_test(every_line_of_the_csv_has_every_column),
        cmocka_unit_test(a_torn_journal_is_mended_and_continued),
        cmocka_unit_test(killed_at_any_time_it_goes_on_where_it_was),
        cmocka_unit_test(parts_of_streams_are_the_whole),
        cmocka_unit_test(parts_put_together_are_the_whole),
        cmocka_unit_test(journals_of_something_else_or_in_use_are_left_alone),
        cmocka_unit_test(a_wrong_setting_says_what_would_be_right),
    };
    return cmocka_run_group_tests_name("explore", tests, new_place, leave_place);
}
