/* SPDX-License-Identifier: Apache-2.0
 *
 * What halfstep run does when rtl is wrong. The rtl of this test is golden itself with one word
 * damaged, so that there is something to find.
 */
#include "folder.h"

#include <fcntl.h>

#include "bound.h"
#include "commands.h"
#include "definitions.h"
#include "model.h"
#include "rtl.h"

/* --- An rtl with a defect
 * ------------------------------------------------------------------------- */

enum { CYCLES_PER_WORD = 10 };

static struct {
    uint32_t view; /* the one that comes out wrong */
    size_t word;   /* of it; SIZE_MAX: none */
    bool cut;      /* it ends there instead */
    uint32_t runs;
    hs_stalls stalls;
    uint64_t wave_first, wave_last;
    uint64_t late; /* cycles by which a transaction of the view is late */
} defect;

struct hs_rtl {
    hs_golden *golden;
    hs_model *model; /* plays the RTL when transactions are compared */
    hs_log *log;
    size_t words;
};

hs_rtl *hs_rtl_new(hs_limits limits, uint32_t seed, hs_error *err) {
    (void)seed;
    (void)err;
    hs_rtl *rtl = calloc(1, sizeof *rtl);
    assert_non_null(rtl);
    rtl->golden = hs_golden_new(limits);
    return rtl;
}

void hs_rtl_free(hs_rtl *rtl) {
    if (!rtl) return;
    hs_golden_free(rtl->golden);
    hs_model_free(rtl->model);
    free(rtl);
}

uint32_t hs_rtl_architecture(const hs_rtl *rtl) {
    (void)rtl;
    return 0;
}

hs_limits hs_rtl_capacity(const hs_rtl *rtl) {
    (void)rtl;
    return HS_DEFAULT_LIMITS;
}

void hs_rtl_log(hs_rtl *rtl, hs_log *log) {
    rtl->log = log;
}

/* The model with a transaction that comes late, or with a cycle more in a counter. */
static bool run_logged(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                       hs_cycle_report *report, hs_error *err) {
    hs_golden_report golden;
    if (!rtl->model) rtl->model = hs_model_new(HS_DEFAULT_LIMITS, HS_DEFAULT_CONFIG, err);
    if (!hs_model_run(rtl->model, in, stalls, out, &golden, report, rtl->log, err)) return false;
    rtl->words = out->words;
    if (in->view != defect.view) return true;
    if (defect.late)
        rtl->log->probe[HS_PROBE_split_out].transaction[3].cycle += defect.late;
    else
        report->activity[HS_STAGE_guard][HS_ACTIVITY_busy]++;
    return true;
}

bool hs_rtl_trace(hs_rtl *rtl, const char *path, uint64_t first, uint64_t last, hs_error *err) {
    (void)rtl;
    (void)err;
    if (!path) return true;
    defect.wave_first = first;
    defect.wave_last = last;
    /* An FST file's least: header, geometry and hierarchy, all empty. */
    static const char blocks[3][9] = {
        {0, 0, 0, 0, 0, 0, 0, 0, 8}, {3, 0, 0, 0, 0, 0, 0, 0, 8}, {4, 0, 0, 0, 0, 0, 0, 0, 8}};
    FILE *file = fopen(path, "w");
    return file && fwrite(blocks, sizeof blocks, 1, file) == 1 && fclose(file) == 0;
}

bool hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                hs_cycle_report *report, hs_error *err) {
    hs_golden_report golden;
    if (rtl->log) return run_logged(rtl, in, stalls, out, report, err);
    *report = (hs_cycle_report){.begin = 1000, .start = 1100, .cycles = 1000};
    defect.runs++;
    defect.stalls = stalls;
    if (!hs_golden_run(rtl->golden, in, out, &golden, err)) return false;
    if (in->view == defect.view && defect.word < out->words) {
        out->word[defect.word] ^= 1;
        if (defect.cut) out->words = defect.word;
    }
    rtl->words = out->words;
    return true;
}

uint64_t hs_rtl_cycle(const hs_rtl *rtl) {
    (void)rtl;
    return 0;
}

uint64_t hs_rtl_word_cycle(const hs_rtl *rtl, size_t word) {
    return word < rtl->words ? CYCLES_PER_WORD * word : UINT64_MAX;
}

/* --- Running with what it says caught
 * -------------------------------------------------------------- */

static char said[20000]; /* stdout and stderr of the latest run */

/* line: words with single spaces. */
static int run(char *line) {
    char *argument[40];
    int count = 0;
    for (char *rest = line, *word; count < 40 && (word = strsep(&rest, " ")) != NULL;)
        argument[count++] = word;
    char path[] = "/tmp/halfstep-test-said-XXXXXX";
    const int file = mkstemp(path), out = dup(1), errors = dup(2);
    assert_true(file >= 0 && out >= 0 && errors >= 0);
    fflush(stdout);
    fflush(stderr);
    dup2(file, 1);
    dup2(file, 2);
    hs_error err = {0};
    defect.runs = 0;
    const int code = hs_command_run(count, argument, &err);
    fflush(stdout);
    fflush(stderr);
    dup2(out, 1);
    dup2(errors, 2);
    const ssize_t size = pread(file, said, sizeof said - 1, 0);
    said[size < 0 ? 0 : size] = 0;
    close(file);
    close(out);
    close(errors);
    unlink(path);
    return code;
}

static void assert_said(const char *text) {
    if (!strstr(said, text)) fail_msg("no \"%s\" in\n%s", text, said);
}

/* --- Tests
 * ------------------------------------------------------------------------------------------ */

/* Eight vertices in two groups come before the first of six faces. */
static void latencies_count_from_the_first_beat_in(void **state) {
    (void)state;
    defect.view = UINT32_MAX;
    char line[] = "run shape:cube --engine golden,rtl --uniform 0 --json -", text[80];
    assert_int_equal(run(line), HS_EXIT_OK);
    const unsigned first_face = 4 + 2 * 20, trailer = first_face + 6 * 4;
    snprintf(text, sizeof text, "\"first_face\": %d,", CYCLES_PER_WORD * (int)first_face - 100);
    assert_said(text);
    snprintf(text, sizeof text, "\"trailer\": %d,", CYCLES_PER_WORD * (int)trailer - 100);
    assert_said(text);
    snprintf(text, sizeof text, " %d ", CYCLES_PER_WORD * (int)first_face - 100); /* the table */
    assert_said(text);
}

static void a_difference_names_view_place_word_and_both_values(void **state) {
    (void)state;
    defect.view = 1;
    defect.word = 501;
    char line[] = "run shape:cube --engine golden,rtl --orbit 3 --stalls 10,20 --seed 9";
    assert_int_equal(run(line), HS_EXIT_DIFFERENT);
    assert_said("view 1: rtl and golden differ in 1 of 7024 words");
    assert_said("word 501, face ");
    assert_said(" of generation ");
    assert_said(": expected 0x");
    assert_said("cycle 5010 of the view");
    assert_said("DIFFER");
    assert_int_equal(defect.runs, 2); /* the third view was not run */
}

static void the_printed_command_runs_just_that_view_again(void **state) {
    (void)state;
    folder place = make_folder();
    defect.view = 1;
    defect.word = 501;
    char line[] =
        "run shape:cube --engine golden,rtl --orbit 3 --stalls 10,20 --seed 9 --front 3 --guard 0";
    assert_int_equal(run(line), HS_EXIT_DIFFERENT);
    char *command = strstr(said, "halfstep run ");
    assert_non_null(command);
    char again[2000];
    snprintf(again, sizeof again, "%s", command + strlen("halfstep "));
    again[strcspn(again, "\n")] = 0;
    char *wave = strstr(again, "view-001.fst");
    assert_non_null(wave);
    char named[2200]; /* with the waveform in the test's folder */
    snprintf(named, sizeof named, "%.*s%s/%s", (int)(wave - again), again, place.path, wave);
    defect.stalls = (hs_stalls){0};
    assert_int_equal(run(named), HS_EXIT_DIFFERENT);
    assert_int_equal(defect.runs, 1);
    assert_said("view 1: rtl and golden differ in 1 of ");
    assert_said("word 501, ");
    assert_int_equal(defect.stalls.input, 10);
    assert_int_equal(defect.stalls.output, 20);
    assert_int_equal(defect.stalls.seed, 9);
    assert_true(defect.wave_first <= 5010 && defect.wave_last >= 5010);
    assert_int_equal(unlink(inside(&place, "view-001.fst")), 0);
    assert_int_equal(rmdir(place.path), 0);
}

static void a_packet_that_ends_early_differs_where_it_ends(void **state) {
    (void)state;
    defect.view = 0;
    defect.word = 400;
    defect.cut = true;
    char line[] = "run shape:cube --engine golden,rtl";
    assert_int_equal(run(line), HS_EXIT_DIFFERENT);
    assert_said("word 400, ");
    assert_said("rtl sent nothing");
    defect.cut = false;
}

static void a_late_transaction_is_named_with_the_command_that_shows_it(void **state) {
    (void)state;
    defect.view = 1;
    defect.late = 2;
    char line[] = "run shape:cube --orbit 2 --engine model,rtl";
    assert_int_equal(run(line), HS_EXIT_DIFFERENT);
    assert_said("view 1: rtl and model differ in 1 of ");
    assert_said("stage split, split_out, transaction 3; rtl: cycle ");
    assert_said("--view 1 ");
    assert_said("--wave view-001.fst --wave-cycles ");
    defect.late = 0;
    char again[] = "run shape:cube --orbit 2 --engine golden,model,rtl";
    assert_int_equal(run(again), HS_EXIT_DIFFERENT);
    assert_said("view 1: rtl and model count differently: guard busy: ");
    defect.view = UINT32_MAX;
    char good[] = "run shape:cube --orbit 2 --engine golden,model,rtl";
    assert_int_equal(run(good), HS_EXIT_OK);
    assert_said("transactions of rtl equal model's");
}

static void golden_alone_finds_nothing_wrong(void **state) {
    (void)state;
    defect.view = 0;
    defect.word = 500;
    char alone[] = "run shape:cube --engine golden,reference";
    assert_int_equal(run(alone), HS_EXIT_OK);
    assert_int_equal(defect.runs, 0);
}

static void rtl_alone_has_to_send_a_packet_in_order(void **state) {
    (void)state;
    defect.view = 0;
    defect.word = 500;
    char line[] = "run shape:cube --engine rtl";
    assert_int_equal(run(line), HS_EXIT_STREAM);
    defect.word = SIZE_MAX;
    char good[] = "run shape:cube --engine rtl";
    assert_int_equal(run(good), HS_EXIT_OK);
    assert_int_equal(defect.runs, 1);
}

/* --- The bound
 * --------------------------------------------------------------------------------------- */

/* A closed mesh of quads, uniformly refined, in generations by the book. */
static hs_bound uniform_bound(uint32_t depth, uint64_t *faces) {
    hs_generation generation[20];
    const hs_settings settings = {.uniform = true, .uniform_depth = (uint8_t)depth};
    uint32_t active = 1000, vertices = 1002;
    for (uint32_t g = 0; g <= depth; g++) {
        const bool step = g < depth;
        generation[g] = (hs_generation){.active = active,
                                        .corners = 4 * active,
                                        .refined = step ? active : 0,
                                        .moved = step && g % 2 == 0 ? vertices : 0,
                                        .final = step ? 0 : active};
        *faces = active;
        vertices += active;
        active *= 2;
    }
    return hs_bound_of(&settings, depth, generation, depth + 1, 1002, 1600, 160000);
}

static void the_bound_of_uniform_runs_tends_to_5_3_and_7_3(void **state) {
    (void)state;
    for (uint32_t depth = 11; depth <= 14; depth++) {
        uint64_t faces;
        const hs_bound bound = uniform_bound(depth, &faces);
        const double limit = depth % 2 ? 7.0 / 3 : 5.0 / 3,
                     ratio = (double)bound.total / (double)faces;
        if (ratio < limit || ratio > limit + 0.01)
            fail_msg("depth %u: %f cycles per face, not %f", depth, ratio, limit);
        assert_int_equal(bound.stage[HS_STAGE_select] + bound.stage[HS_STAGE_guard], 0);
        assert_int_equal(bound.stage[HS_STAGE_emit], 10000);
        assert_int_equal(bound.stage[HS_STAGE_receive], 100);
    }
}

static void a_view_that_selects_nothing_costs_three_passes(void **state) {
    (void)state;
    const hs_generation generation = {.active = 6, .corners = 24, .final = 6, .vertices = 8};
    const hs_settings settings = {.front_depth = 4, .silhouette_depth = 8, .guard = true};
    const hs_bound bound = hs_bound_of(&settings, 8, &generation, 1, 8, 160, 100);
    assert_int_equal(bound.total, 3 * 24); /* classify, select, split */
    assert_int_equal(bound.stage[HS_STAGE_guard], 0);
    /* Nothing is asked for: the faces are sent. */
    const hs_settings none = {.uniform = true};
    assert_int_equal(hs_bound_of(&none, 0, &generation, 1, 8, 160, 100).total, 24);
    /* At their limit positions: classify sums the rings. */
    const hs_settings limit = {.uniform = true, .limit = true};
    assert_int_equal(hs_bound_of(&limit, 0, &generation, 1, 8, 160, 100).total, 2 * 24);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(latencies_count_from_the_first_beat_in),
        cmocka_unit_test(a_difference_names_view_place_word_and_both_values),
        cmocka_unit_test(the_printed_command_runs_just_that_view_again),
        cmocka_unit_test(a_packet_that_ends_early_differs_where_it_ends),
        cmocka_unit_test(a_late_transaction_is_named_with_the_command_that_shows_it),
        cmocka_unit_test(golden_alone_finds_nothing_wrong),
        cmocka_unit_test(rtl_alone_has_to_send_a_packet_in_order),
        cmocka_unit_test(the_bound_of_uniform_runs_tends_to_5_3_and_7_3),
        cmocka_unit_test(a_view_that_selects_nothing_costs_three_passes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
