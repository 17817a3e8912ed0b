/* SPDX-License-Identifier: Apache-2.0
 *
 * What `make waves` gives to GTKWave: the window of a generation, markers where it begins, signals
 * that the waveform has, numbers.
 */
#include "command.h"

#include <inttypes.h>
#include <jansson.h>

#include "definitions.h"

#define RUN "build/halfstep run shape:cube --orbit 4 --view 3 --quiet "

static void make_timeline(void) {
    expect_line(0, RUN "--engine model --timeline @/t.json --json @/run.json >@/out", "");
}

/* Begin and end of a generation, from the timeline. */
static void find_generation(int number, json_int_t at[2]) {
    char name[40];
    size_t i;
    json_t *event, *root = json_load_file(inside(&place, "t.json"), 0, NULL);
    assert_non_null(root);
    snprintf(name, sizeof name, "generation %d", number);
    at[0] = at[1] = -1;
    json_array_foreach(json_object_get(root, "traceEvents"), i, event) {
        const char *is = json_string_value(json_object_get(event, "name"));
        if (strcmp(is, name) != 0) continue;
        at[0] = json_integer_value(json_object_get(event, "ts"));
        at[1] = at[0] + json_integer_value(json_object_get(event, "dur"));
    }
    json_decref(root);
    assert_true(at[0] > 0 && at[1] > at[0]);
}

static void the_window_is_that_of_the_generation(void **state) {
    (void)state;
    json_int_t at[2];
    char text[100];
    make_timeline();
    find_generation(2, at);
    snprintf(text, sizeof text, "%lld:%lld\n", (long long)at[0] - 36, (long long)at[1] + 36);
    expect_line(0, "build/waves window @/t.json 2", text);
    snprintf(text, sizeof text, "%lld:%lld\n", (long long)at[0] - 36, (long long)at[0] + 36);
    expect_line(0, "build/waves begin @/t.json 2", text);
}

static void what_makes_no_window_is_said(void **state) {
    (void)state;
    make_timeline();
    expect_line(HS_EXIT_USAGE, "build/waves window @/t.json 99", "the view has generations 0 to 7");
    expect_line(HS_EXIT_USAGE, "build/waves window @/t.json two", "\"two\" is no generation");
    expect_line(HS_EXIT_FILE, "build/waves window @/none.json 2", "none.json");
    expect_line(HS_EXIT_FILE, "echo 1 >@/one.json; build/waves window @/one.json 2", "one.json");
    expect_line(HS_EXIT_USAGE, "build/waves", "waves window");
    expect_line(HS_EXIT_USAGE, "build/waves save @ @/t.json @/run.json @/run.json 9:1", "no FIRST");
    expect_line(HS_EXIT_FILE, "build/waves save @ @/t.json @/run.json @/run.json 1:9",
                "no FST file");
    expect_line(HS_EXIT_FILE, "build/waves save @ @/t.json @/t.json @/run.json 1:9", "no report");
}

static void the_filters_make_numbers(void **state) {
    (void)state;
    expect_line(0,
                "ln -s ~/build/waves_filter @/binary32; ln -s ~/build/waves_filter @/fixed_e3; "
                "ln -s ~/build/waves_filter @/fixed_e-4",
                "");
    /* x is the lowest word: the last digits. */
    expect_line(0, "echo 3f800000c0000000000000003dcccccd | @/binary32", "0.1 0 -2 1\n");
    expect_line(0, "printf '3F800000\\n7f800000\\nxxxx\\n\\n4\\n' | @/binary32",
                "1\ninf\nxxxx\n\n5.60519e-45\n");
    expect_line(0, "echo 20000000e0000000000000017fffffff | @/fixed_e3", "16 7.45058e-09 -4 4\n");
    expect_line(0, "echo 40000000 | @/fixed_e-4", "0.0625\n");
}

/* One signal of a VCD file. */
typedef struct change {
    uint64_t time;
    unsigned value;
} change;

/* The changes of a signal that is named below a module. Returns how many; *first: the file's first
 * time. */
static uint32_t read_changes(const char *path, const char *module, const char *name, change *all,
                             uint32_t most, uint64_t *first) {
    char line[4000], code[20] = "", scope[30][60], word[60], id[20];
    uint64_t time = 0;
    uint32_t count = 0;
    int depth = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    *first = UINT64_MAX;
    while (fgets(line, sizeof line, file) && count < most) {
        if (sscanf(line, "$scope %*s %59s", word) == 1) {
            assert_true(depth < 30);
            strcpy(scope[depth++], word);
        } else if (strncmp(line, "$upscope", 8) == 0) {
            depth--;
        } else if (sscanf(line, "$var %*s %*u %19s %59s", id, word) == 2) {
            if (strcmp(word, name) == 0 && strcmp(scope[depth - 1], module) == 0) strcpy(code, id);
        } else if (line[0] == '#') {
            time = strtoull(line + 1, NULL, 10);
            if (*first == UINT64_MAX) *first = time;
        } else if (sscanf(line, "b%59s %19s", word, id) == 2 && *code && strcmp(id, code) == 0) {
            all[count++] = (change){time, (unsigned)strtoul(word, NULL, 2)};
        }
    }
    fclose(file);
    assert_true(*code);
    return count;
}

static unsigned value_at(const change *all, uint32_t count, uint64_t time) {
    unsigned value = 0;
    for (uint32_t i = 0; i < count && all[i].time <= time; i++)
        value = all[i].value;
    return value;
}

static bool cannot_read_waves(void) {
    if (system("command -v fst2vcd >/dev/null") == 0) return false;
    print_message("skipped: GTKWave's fst2vcd is not here; make waves installs it\n");
    return true;
}

/* Whether a VCD file has a variable, by the path that the save file gives. */
static bool has_variable(const char *variables, const char *path) {
    char want[400];
    snprintf(want, sizeof want, "\n%s\n", path);
    return strstr(variables, want) != NULL;
}

static void the_save_file_shows_what_the_waveform_has(void **state) {
    (void)state;
    if (cannot_read_waves()) skip();
    uint8_t *save, *variables;
    size_t size;
    hs_error err;
    json_int_t at[2];
    make_timeline();
    find_generation(1, at);
    expect_line(
        0,
        "w=$(build/waves window @/t.json 1) && " RUN
        "--engine rtl --wave @/w.fst --wave-cycles $w >@/out && "
        "build/waves save @ @/t.json @/run.json @/w.fst $w && fst2vcd @/w.fst >@/w.vcd && "
        "awk '/\\$scope/ { p = p $3 \".\" } /\\$upscope/ { sub(/[^.]*\\.$/, \"\", p) } "
        "/\\$var/ { r = substr($6, 1, 1) == \"[\" ? $6 : \"\"; print p $5 r }' @/w.vcd >@/names",
        "");
    /* The sequencer enters CLASSIFY, the second of its states, where the first marker stands. */
    static change states[2000];
    uint64_t entered = 0, first;
    const uint32_t count =
        read_changes(inside(&place, "w.vcd"), "u_sequencer", "state_q", states, 2000, &first);
    for (uint32_t i = 1; i < count && !entered; i++)
        if (states[i].value == 1) entered = states[i].time;
    assert_true(entered > 0);
    assert_true(hs_file_read(inside(&place, "waves.gtkw"), 1 << 20, &save, &size, &err));
    assert_true(hs_file_read(inside(&place, "names"), 1 << 22, &variables, &size, &err));
    char marker[60];
    snprintf(marker, sizeof marker, " -1 %" PRIu64 " ", entered);
    if (!strstr((char *)save, marker)) fail_msg("no marker at %" PRIu64, entered);
    assert_non_null(strstr((char *)save, "[markername] Ageneration 1\n"));

    uint32_t signals = 0, groups = 0;
    char *rest = (char *)save, *line;
    while ((line = strsep(&rest, "\n")) != NULL) {
        groups += strncmp(line, "@800200", 7) == 0 || strncmp(line, "@c00200", 7) == 0;
        if (line[0] != '+' && line[0] != '#') continue;
        char *paths = strchr(line, '}') + 1, *path;
        while ((path = strsep(&paths, " ")) != NULL) {
            if (!*path) continue;
            if (!has_variable((char *)variables, path)) fail_msg("no signal %s", path);
            signals++;
        }
    }
    assert_int_equal(groups, 9);
    assert_true(signals > 80);
    free(save);
    free(variables);
}

/* A view of less than 1024 cycles: each bucket of the timeline is one. A cycle's registers are
 * those at its beginning, 10 units of time apart. */
static void the_fifo_before_emit_is_as_full_as_the_timeline_says(void **state) {
    (void)state;
    if (cannot_read_waves()) skip();
    expect_line(0,
                "build/halfstep run shape:grid:5 --boundary kept --front 1 --silhouette 2 --quiet "
                "--engine rtl --stalls 0,60 --wave @/w.fst --timeline @/t.json >@/out && "
                "fst2vcd @/w.fst >@/w.vcd",
                "");
    static change groups[2000], ops[2000];
    uint64_t first;
    const char *vcd = inside(&place, "w.vcd");
    const uint32_t group_count = read_changes(vcd, "u_groups", "level_o", groups, 2000, &first);
    const uint32_t op_count = read_changes(vcd, "u_ops", "level_o", ops, 2000, &first);
    unsigned told[1024] = {0}, most = 0;
    json_int_t from = 0, end = 0;
    size_t i;
    json_t *event, *root = json_load_file(inside(&place, "t.json"), 0, NULL);
    assert_non_null(root);
    json_array_foreach(json_object_get(root, "traceEvents"), i, event) {
        const json_int_t ts = json_integer_value(json_object_get(event, "ts"));
        const json_t *args = json_object_get(event, "args");
        const char *name = json_string_value(json_object_get(event, "name"));
        if (strcmp(name, "view 0") == 0)
            end = ts + json_integer_value(json_object_get(event, "dur"));
        if (strcmp(name, "fill: FIFO before emit") != 0) continue;
        for (from = ts; from < 1024; from++)
            told[from] = (unsigned)json_integer_value(json_object_get(args, "most"));
    }
    json_decref(root);
    assert_in_range(end, 100, 1023);
    for (uint64_t c = 0; c < (uint64_t)end; c++) {
        const uint64_t time = first - first % 10 + 10 * c + 5;
        const unsigned level = value_at(groups, group_count, time) + value_at(ops, op_count, time);
        if (told[c] != level) fail_msg("cycle %d: %u, told are %u", (int)c, level, told[c]);
        if (level > most) most = level;
    }
    assert_true(most > 2);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(the_window_is_that_of_the_generation),
        TEST(what_makes_no_window_is_said),
        TEST(the_filters_make_numbers),
        TEST(the_save_file_shows_what_the_waveform_has),
        TEST(the_fifo_before_emit_is_as_full_as_the_timeline_says),
    };
    return cmocka_run_group_tests_name("waves", tests, NULL, NULL);
}
