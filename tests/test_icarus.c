/* SPDX-License-Identifier: Apache-2.0
 *
 * The second simulator, and other initial contents, on the smallest architecture and two small
 * traces: the bounded form of `make icarus`.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define DESIGN "build/icarus/smallest.vvp"

static char text[2][200000]; /* what commands wrote */

/* Runs a shell's line; its output, both streams, goes to text[i]. */
static const char *run(int i, const char *line) {
    FILE *pipe = popen(line, "r");
    assert_non_null(pipe);
    const size_t size = fread(text[i], 1, sizeof text[i] - 1, pipe);
    text[i][size] = 0;
    pclose(pipe);
    return text[i];
}

static void skip_without_icarus(void) {
    if (access(DESIGN, R_OK) == 0) return;
    print_message("skipped: no " DESIGN "; iverilog is missing\n");
    skip();
}

static void assert_same(const char *arguments) {
    char line[300];
    snprintf(line, sizeof line, "tests/icarus/campaign --one 1 same smallest %s 2>&1", arguments);
    if (strncmp(run(0, line), "same ", 5) != 0) fail_msg("%s", text[0]);
    print_message("%s", text[0]);
}

static void icarus_sends_the_words_of_verilator_in_the_same_cycles(void **state) {
    (void)state;
    skip_without_icarus();
    assert_same("0 0 tests/icarus/house");
}

static void likewise_with_pauses_refused_packets_and_good_ones_behind_them(void **state) {
    (void)state;
    skip_without_icarus();
    assert_same("40 60 tests/icarus/refused");
}

static void an_x_on_an_output_is_seen(void **state) {
    (void)state;
    skip_without_icarus();
    run(0, "v=build/icarus/no-reset; "
           "sed \"s/= rst_i ?/= 1'b0 ?/\" build/icarus/smallest.v >$v.v && "
           "tests/icarus/build 1 $v.v $v.vvp && "
           "HS_ICARUS=$v.vvp build/icarus/words-smallest-icarus 1 0 0 tests/icarus/refused 2>&1");
    if (!strstr(text[0], "icarus: unknown")) fail_msg("no X: %s", text[0]);
}

static void initial_contents_do_not_matter(void **state) {
    (void)state;
    const char *line =
        "build/icarus/words-smallest %d 0 0 tests/icarus/house tests/icarus/refused 2>&1";
    char command[200];
    snprintf(command, sizeof command, line, 1);
    assert_non_null(strstr(run(0, command), "12 views, "));
    for (int seed = 2; seed <= 5; seed++) {
        snprintf(command, sizeof command, line, seed);
        if (strcmp(run(1, command), text[0]) != 0) fail_msg("other words with seed %d", seed);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(icarus_sends_the_words_of_verilator_in_the_same_cycles),
        cmocka_unit_test(likewise_with_pauses_refused_packets_and_good_ones_behind_them),
        cmocka_unit_test(an_x_on_an_output_is_seen),
        cmocka_unit_test(initial_contents_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
