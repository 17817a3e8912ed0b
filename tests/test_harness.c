/* SPDX-License-Identifier: Apache-2.0
 *
 * The harness notices: engines that are wrong, comparisons that compare nothing, wrong
 * expectations, test programs that fail in every way, runs without a case. Each fault is planted,
 * and the command that should find it has to fail and to say why. build/halfstep-faulty and
 * build/parity-faulty are the real programs with the faults of tests/planted.c.
 */
#include "command.h"

#include "definitions.h"

#include <sys/stat.h>

static void write_script(const char *name, const char *text) {
    char whole[2000];
    snprintf(whole, sizeof whole, "#!/bin/sh\n%s\n", text);
    write_text(name, whole);
    assert_int_equal(chmod(inside(&place, name), 0755), 0);
}

/* --- halfstep run -------------------------------------------------------------------------------
 */

static void run_finds_wrong_engines_and_comparisons_of_nothing(void **state) {
    (void)state;
    static const struct {
        const char *fault;
        int code;
        const char *says;
    } planted[] = {{"none", HS_EXIT_OK, "are equal"},
                   {"golden-word", HS_EXIT_DIFFERENT, "rtl and golden differ in 2 of"},
                   {"golden-swap", HS_EXIT_DIFFERENT, "rtl and golden differ in 3 of"},
                   {"golden-cut", HS_EXIT_STREAM, "golden sent is no output packet"},
                   {"golden-silent", HS_EXIT_STREAM, "golden sent is no output packet"},
                   {"model-word", HS_EXIT_DIFFERENT, "model and golden differ in 2 of"},
                   {"model-cycles", HS_EXIT_DIFFERENT, "rtl and model count differently: cycles"},
                   {"model-late", HS_EXIT_DIFFERENT, "rtl and model differ in 1 of"},
                   {"model-lost", HS_EXIT_DIFFERENT, "rtl and model differ in 1 of"},
                   {"rtl-word", HS_EXIT_DIFFERENT, "rtl and golden differ in 2 of"},
                   {"rtl-swap", HS_EXIT_DIFFERENT, "rtl and golden differ in 3 of"},
                   {"rtl-cut", HS_EXIT_DIFFERENT, "rtl sent nothing: it ends here"},
                   {"rtl-silent", HS_EXIT_DIFFERENT, "rtl sent nothing: it ends here"},
                   {"rtl-cycles", HS_EXIT_DIFFERENT, "rtl and model count differently: cycles"},
                   {"words-skipped", HS_EXIT_DIFFERENT, "no words were compared"},
                   {"transactions-skipped", HS_EXIT_DIFFERENT, "no transactions were compared"},
                   {"reference-skipped", HS_EXIT_DIFFERENT, "no faces were compared"}};
    for (size_t i = 0; i < sizeof planted / sizeof *planted; i++) {
        char line[300];
        snprintf(line, sizeof line,
                 "HS_FAULT=%s build/halfstep-faulty run shape:cube --front 1 --silhouette 2 "
                 "--engine reference,golden,model,rtl",
                 planted[i].fault);
        expect_line(planted[i].code, line, planted[i].says);
    }
}

/* --- halfstep trace check -----------------------------------------------------------------------
 */

static void a_trace_finds_wrong_engines_and_wrong_expectations(void **state) {
    (void)state;
    static const struct {
        const char *change, *fault; /* of a copy of a trace; in the engines */
        int code;
        const char *says;
    } planted[] = {
        {"true", "none", HS_EXIT_OK, "good, 3 views"},
        {"true", "golden-word", HS_EXIT_DIFFERENT, "rtl sent 0x"},
        {"true", "rtl-swap", HS_EXIT_DIFFERENT, "rtl sent 0x"},
        {"true", "rtl-cut", HS_EXIT_DIFFERENT, "rtl sent nothing"},
        {"true", "rtl-cycles", HS_EXIT_DIFFERENT, "view 0: cycles should be"},
        {"true", "words-skipped", HS_EXIT_DIFFERENT, "no word was compared"},
        {"sed -i 's/\"digest\": \"0x./&f/' expected.json", "none", HS_EXIT_DIFFERENT, "digest"},
        {"sed -i '/\"cycles\"/d; s/\\(\"generations\": [0-9]*\\),/\\1/' expected.json", "none",
         HS_EXIT_DIFFERENT, "cycles should be nothing"},
        {"sed -i 's/\"stream\": 2/\"stream\": 1/' expected.json", "none", HS_EXIT_DIFFERENT,
         "stream should be 1, but is 2"},
        {"echo '{\"stream\": 2, \"views\": []}' >expected.json", "none", HS_EXIT_DIFFERENT,
         "expected.json has 0 views, input.hss 3"},
        {"echo '[]' >expected.json", "none", HS_EXIT_DIFFERENT, "expected.json"},
        {": >expected.json", "none", HS_EXIT_STREAM, "expected.json:"},
        {"rm expected.json", "none", HS_EXIT_FILE, "expected.json: cannot read"},
        {"rm input.hss", "none", HS_EXIT_FILE, "input.hss: cannot read"},
        {": >input.hss", "none", HS_EXIT_STREAM, "empty"},
        {"truncate -s -16 input.hss", "none", HS_EXIT_STREAM, "ends inside"},
        {"printf x | dd of=input.hss bs=1 seek=300 conv=notrunc status=none", "none",
         HS_EXIT_STREAM, "packet 0 of input.hss is not what trace.txt makes"},
        {"sed -i '/^matrix/d' trace.txt", "none", HS_EXIT_STREAM, "no views"}};
    for (size_t i = 0; i < sizeof planted / sizeof *planted; i++) {
        char line[600];
        snprintf(line, sizeof line,
                 "rm -rf @/t; cp -r traces/cube-4-8 @/t && (cd @/t && %s) && "
                 "HS_FAULT=%s build/halfstep-faulty trace check @/t",
                 planted[i].change, planted[i].fault);
        expect_line(planted[i].code, line, planted[i].says);
    }
    expect_line(HS_EXIT_FILE, "cd @ && ~/build/halfstep-faulty trace check", "no traces here");
}

static void an_output_of_ones_own_has_to_be_all_there(void **state) {
    (void)state;
    expect_line(HS_EXIT_OK,
                "build/halfstep run shape:cube --orbit 3 --engine golden --size 32x32 --out @/o && "
                "cat @/o/view-00?/output.hss >@/all && "
                "build/halfstep trace check cube-4-8 --output @/all",
                "good for traces/cube-4-8");
    expect_line(HS_EXIT_DIFFERENT,
                "cat @/o/view-000/output.hss @/o/view-002/output.hss @/o/view-001/output.hss >@/x; "
                "build/halfstep trace check cube-4-8 --output @/x",
                "packet 1 is of view 2; it should be of view 1");
    expect_line(HS_EXIT_DIFFERENT,
                "cat @/o/view-000/output.hss @/o/view-001/output.hss >@/x; "
                "build/halfstep trace check cube-4-8 --output @/x",
                "asks for 3 views");
    expect_line(HS_EXIT_STREAM, ": >@/x; build/halfstep trace check cube-4-8 --output @/x",
                "empty");
    expect_line(HS_EXIT_DIFFERENT,
                "build/halfstep trace show @/all | grep -v -e '# trailer' -e '# .* end: ' >@/text; "
                "build/halfstep trace build @/text @/x; "
                "build/halfstep trace check cube-4-8 --output @/x",
                "it ends here");
    expect_line(HS_EXIT_DIFFERENT,
                "HS_FAULT=words-skipped build/halfstep-faulty trace check cube-4-8 --output @/all",
                "no word");
}

/* --- tests/run ----------------------------------------------------------------------------------
 */

static void tests_run_finds_programs_that_do_not_test(void **state) {
    (void)state;
    static const struct {
        const char *name, *script;
        bool good;
        const char *says;
    } program[] = {
        {"good", "echo '[  PASSED  ] 3 test(s).'", true, "3 passed, 0 failed, 0 skipped"},
        {"fails", "echo '[  PASSED  ] 2 test(s).'; echo '[  FAILED  ] 1 test(s), listed'; exit 1",
         false, "2 passed, 1 failed"},
        {"fails_with_0", "echo '[  FAILED  ] 1 test(s), listed'", false, "0 passed, 1 failed"},
        {"ends_early", "echo '[  PASSED  ] 2 test(s).'; exit 3", false, "ended with code 3"},
        {"none", "true", false, "none ran no test"},
        {"zero", "echo '[  PASSED  ] 0 test(s).'", false, "zero ran no test"},
        {"skips", "echo '[  SKIPPED ] 4 test(s), listed'", false, "0 passed, 1 failed, 4 skipped"},
        {"crashes", "echo '[  PASSED  ] 2 test(s).'; kill -SEGV $$", false, "ended with code 139"},
        {"hangs", "echo '[  PASSED  ] 2 test(s).'; exec sleep 60", false, "ended with code 124"},
    };
    for (size_t i = 0; i < sizeof program / sizeof *program; i++) {
        char line[300], text[1000];
        snprintf(text, sizeof text, "%s", program[i].script);
        write_script(program[i].name, text);
        snprintf(line, sizeof line, "cd @ && TEST_SECONDS=1 ~/tests/run @/%s", program[i].name);
        expect_line(!program[i].good, line, program[i].says);
    }
    expect_line(1, "cd @ && TEST_SECONDS=1 ~/tests/run @/good @/none", "3 passed, 1 failed");
    expect_line(1, "cd @ && ~/tests/run @/good @/not_there", "3 passed, 1 failed");
    expect_line(1, "cd @ && ~/tests/run", "0 passed, 1 failed");
    /* One program's result is missing: another of the same name took its place. */
    expect_line(1, "mkdir @/two && cp @/good @/two/ && cd @ && ~/tests/run @/good @/two/good",
                "1 failed");
    /* The logs cannot be written. */
    expect_line(1, "mkdir @/full && cd @/full && : >build && ~/tests/run @/good", "failed");
}

/* --- tests/parity_run ---------------------------------------------------------------------------
 */

static void parity_finds_faults_and_runs_without_a_case(void **state) {
    (void)state;
    write_script("compares", "echo 'meshes 5 views 100 transactions 900 cycles  0 differences'");
    write_script("nothing", "echo 'meshes 0 views 0 transactions 0 cycles  0 differences'");
    write_script("quiet", "true");
    write_script("fails", "echo 'meshes 5 views 100 transactions 900 cycles'; exit 1");
    expect_line(0, "cd @ && ~/tests/parity_run 1 @/compares", "0 differences in 1 architectures");
    expect_line(1, "cd @ && ~/tests/parity_run 1 @/compares @/nothing", "not compared");
    expect_line(1, "cd @ && ~/tests/parity_run 1 @/compares @/quiet", "not compared");
    expect_line(1, "cd @ && ~/tests/parity_run 1 @/compares @/fails", "DIFFER");
    expect_line(1, "cd @ && ~/tests/parity_run 1 @/compares @/not_there", "DIFFER");
    expect_line(1, "cd @ && ~/tests/parity_run 1 @/nothing", "0 transactions");
    assert_int_not_equal(run_line("cd @ && ~/tests/parity_run 1")->code, 0);
    static const char *const fault[] = {"golden-word", "model-late", "rtl-swap"};
    for (size_t i = 0; i < sizeof fault / sizeof *fault; i++) {
        char line[200];
        snprintf(line, sizeof line, "HS_FAULT=%s build/parity-faulty 1", fault[i]);
        expect_line(1, line, "parity: ");
    }
    expect_line(1, "build/parity-faulty 0", "nothing was compared");
}

/* --- tests/throughput.txt -----------------------------------------------------------------------
 */

static void throughput_finds_wrong_baselines(void **state) {
    (void)state;
    const char *check = "cd @ && ~/build/test_rtl_throughput";
    mkdir(inside(&place, "tests"), 0777);
    write_text("tests/throughput.txt", "# cycles\nshape:cube 1/2 1\nshape:cube uniform:2 1\n");
    expect_line(1, check, "2 of 2 views cost another number of cycles");
    expect_line(0, "cd @ && HS_BASELINES=write ~/build/test_rtl_throughput", "PASSED");
    expect_line(0, check, "PASSED");
    expect_line(1,
                "cd @ && sed -i '2s/.$/x/; 2s/1x/2/; 2s/x/1/' tests/throughput.txt && "
                "~/build/test_rtl_throughput",
                "1 of 2 views cost another number of cycles");
    write_text("tests/throughput.txt", "# cycles\n");
    assert_int_not_equal(run_line(check)->code, 0);
    write_text("tests/throughput.txt", "nowhere.obj 1/2 100\n");
    assert_int_not_equal(run_line(check)->code, 0);
    write_text("tests/throughput.txt", "shape:cube 1/2\n");
    expect_line(1, check, "is no row");
    write_text("tests/throughput.txt", "shape:cube often 3\n");
    expect_line(1, check, "is no way to refine");
    expect_line(1, "cd @ && rm tests/throughput.txt && ~/build/test_rtl_throughput", "FAILED");
}

/* --- tests/formal/prove -------------------------------------------------------------------------
 */

/* The tools are replaced: one that does nothing, one that fails, one that proves everything, broken
 * designs too. */
static void prove_does_not_believe_its_tools(void **state) {
    (void)state;
    const char *line = "PATH=@:$PATH timeout 60 tests/formal/prove @/work fifo collect crc_bitwise";
    const char *tools[] = {"yosys", "yosys-smtbmc", "z3"};
    for (size_t i = 0; i < 3; i++)
        write_script(tools[i], "exit 0");
    expect_line(1, line, "FAILED");
    for (size_t i = 0; i < 3; i++)
        write_script(tools[i], "exit 1");
    expect_line(1, line, "FAILED");
    write_script("yosys",
                 "for a in \"$@\"; do for f in $(echo \"$a\" | grep -o '[^ ;]*\\.smt2'); do\n"
                 "printf '; yosys-smt2-assert 1\\n; yosys-smt2-cover 1\\n' >$f; done; done");
    write_script("yosys-smtbmc", "exit 0");
    expect_line(1, line, "not seen");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(run_finds_wrong_engines_and_comparisons_of_nothing),
        TEST(a_trace_finds_wrong_engines_and_wrong_expectations),
        TEST(an_output_of_ones_own_has_to_be_all_there),
        TEST(tests_run_finds_programs_that_do_not_test),
        TEST(parity_finds_faults_and_runs_without_a_case),
        TEST(throughput_finds_wrong_baselines),
        TEST(prove_does_not_believe_its_tools),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
