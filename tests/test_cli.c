/* SPDX-License-Identifier: Apache-2.0
 *
 * build/halfstep as its users meet it: exit codes, messages, and what it leaves behind.
 */
#include "cli.h"

/* --- Asking for help, and getting things wrong ---------------------------------------------------
 */

static void help_teaches_by_example_and_exits_with_0(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "--help", "halfstep run shape:hand");
    expect(HS_EXIT_OK, "--version", "stream format 2");
    expect(HS_EXIT_OK, "run --help", "Examples:");
    expect(HS_EXIT_OK, "mesh --help", "mesh convert");
    expect(HS_EXIT_OK, "mesh info --help", "halfstep mesh info shape:hand");
    expect(HS_EXIT_OK, "mesh list", "monster");
    expect(HS_EXIT_OK, "trace --help", "--output FILE");
    expect(HS_EXIT_OK, "trace check --help", "judges");
}

static void an_unknown_word_names_the_nearest_one(void **state) {
    (void)state;
    expect(HS_EXIT_USAGE, "", "halfstep --help");
    expect(HS_EXIT_USAGE, "rnu", "did you mean \"run\"?");
    expect(HS_EXIT_USAGE, "frobnicate", "halfstep --help");
    expect(HS_EXIT_USAGE, "mesh inof", "did you mean \"info\"?");
    expect(HS_EXIT_USAGE, "trace", "which of make, check, show, build?");
    expect(HS_EXIT_USAGE, "run shape:cube --sillhouette 3", "did you mean --silhouette?");
    expect(HS_EXIT_USAGE, "run shape:cube -x", "no option \"-x\"");
    expect(HS_EXIT_USAGE, "run shape:cuub", "did you mean \"cube\"?");
    expect(HS_EXIT_USAGE, "run shape:cube --engine goldn", "did you mean \"golden\"?");
}

static void a_wrong_value_says_what_would_be_right(void **state) {
    (void)state;
    expect(HS_EXIT_USAGE, "run", "MESH is missing");
    expect(HS_EXIT_USAGE, "run shape:cube more", "\"more\" is one too many");
    expect(HS_EXIT_USAGE, "run shape:cube --front 251", "a number from 0 to 250");
    expect(HS_EXIT_USAGE, "run shape:cube --front -1", "a number from 0 to 250");
    expect(HS_EXIT_USAGE, "run shape:cube --guard 2", "a number from 0 to 1");
    expect(HS_EXIT_USAGE, "run shape:cube --orbit", "--orbit needs a value");
    expect(HS_EXIT_USAGE, "run shape:cube --quiet=1", "--quiet takes no value");
    expect(HS_EXIT_USAGE, "run shape:cube --size 640", "WIDTHxHEIGHT");
    expect(HS_EXIT_USAGE, "run shape:cube --size 0x0", "16 to 8192");
    expect(HS_EXIT_USAGE, "run shape:cube --stalls 96,0", "0 to 95 per cent");
    expect(HS_EXIT_USAGE, "run shape:cube --uniform 2 --front 3", "drop it");
    expect(HS_EXIT_USAGE, "run shape:cube --orbit 2 --views x", "exclude each other");
    expect(HS_EXIT_USAGE, "run shape:cube --orbit 2 --view 2", "there are views 0 to 1");
    expect(HS_EXIT_USAGE, "run shape:cube --orbit 2 --wave @/w.fst", "choose it with --view");
    expect(HS_EXIT_USAGE, "run shape:cube --orbit 2 --timeline-svg @/t", "choose it with --view");
    expect(HS_EXIT_USAGE, "run shape:cube --max-quads 16777216", "exceed the RTL's capacity");
    expect(HS_EXIT_USAGE, "run shape:grid:99999", "grid");
    expect(HS_EXIT_USAGE, "run shape:grid:4:1:1", "shape:NAME[:SIZE[:SEED]]");
}

static void a_run_becomes_a_page(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "report --help", "halfstep report out/hand --explore out/space");
    expect(HS_EXIT_USAGE, "report", "DIR is missing");
    expect(HS_EXIT_USAGE, "report @ --faces 1", "a number from 100 to 1000000");
    write_text("t.html", "<title>@HALFSTEP_TITLE@</title>@HALFSTEP_DATA@");
    expect(HS_EXIT_FILE, "report @/none --template @/t.html", "none: there is no such folder");
    expect(HS_EXIT_FILE, "report @ --template @/t.html", "halfstep run MESH --out DIR");
    expect(HS_EXIT_OK,
           "run shape:cube --orbit 2 --engine golden,model --size 32x32 --levels 1 --out @/o",
           "o/run.json");
    expect(HS_EXIT_OK, "report @/o --template @/t.html", "o/report.html");
    assert_true(exists("o/report.html"));
    expect(HS_EXIT_OK, "report @/o --template @/t.html -q -o - | head -c 40",
           "<title>shape:cube, 2 views</title>{");
    /* Beside a program that was not built here there is no page. */
    expect(HS_EXIT_FILE, "--version && cp build/halfstep @/h && @/h report @/o 2>&1; exit $?",
           "`make report` makes it");
}

static void an_option_that_does_nothing_is_refused(void **state) {
    (void)state;
    expect(HS_EXIT_USAGE, "run shape:cube --boundary smoth", "did you mean \"smooth\"?");
    expect(HS_EXIT_USAGE, "run shape:cube --boundary 7", "kept, smooth or edge-only");
    expect(HS_EXIT_USAGE, "run shape:cube --min-edge-px x", "0.0625 to 4095");
    expect(HS_EXIT_USAGE, "run shape:cube --engine golden --orbit 1 --wave @/w.fst", "add rtl");
    expect(HS_EXIT_USAGE, "run shape:cube --orbit 1 --wave-cycles 1:2", "needs --wave FILE");
    expect(HS_EXIT_USAGE, "run shape:cube --engine golden --timeline @/t", "add model or rtl");
    expect(HS_EXIT_USAGE, "run shape:cube --json - --kanata -", "only one of");
    expect(HS_EXIT_USAGE, "run shape:cube --orbit 1 --wave @/w.fst --wave-cycles 2:1",
           "FIRST:LAST");
    expect(HS_EXIT_USAGE, "run shape:cube --views=", "--views is empty; give it FILE");
    expect(HS_EXIT_USAGE, "explore shape:cube --size 3", "WIDTHxHEIGHT");
    expect(HS_EXIT_USAGE, "render shape:cube --size 3x3 -o @/x.png", "16 to 8192 each");
    expect(HS_EXIT_USAGE, "render shape:cube --what nothing -o @/x.png", "no figure \"nothing\"");
    expect(HS_EXIT_USAGE, "trace make", "name traces, or give --all");
    expect(HS_EXIT_USAGE, "trace make --all x", "not both");
    expect(HS_EXIT_USAGE, "trace run nowhere", "there are make, check, show, build");
    assert_false(exists("w.fst") || exists("x.png"));
}

static void a_mesh_is_described_with_its_creases_and_its_boundary(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "mesh info shape:die", "creases");
    expect(HS_EXIT_OK, "mesh info shape:spoon", "boundary");
}

static void a_standard_output_that_takes_nothing_is_an_error(void **state) {
    (void)state;
    expect(HS_EXIT_FILE, "mesh list 3>&1 >/dev/full 2>&3; exit $?",
           "cannot write to standard output");
}

static void the_model_counts_the_cycles_of_the_rtl(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "run shape:cube --engine model,rtl --stalls 30,40",
           "transactions of rtl equal model's");
    expect(HS_EXIT_OK, "run shape:cube --engine golden,model", "words of model equal golden's");
}

/* --- Bad meshes, views, files --------------------------------------------------------------------
 */

static void a_bad_mesh_is_named_by_file_and_line(void **state) {
    (void)state;
    write_text("two.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n");
    expect(HS_EXIT_MESH, "run @/two.obj", "two.obj:3");
    expect(HS_EXIT_MESH, "mesh info @/two.obj", "two.obj:3");
    expect(HS_EXIT_MESH, "mesh convert @/two.obj @/out.obj", "two.obj:3");
    assert_false(exists("out.obj"));
    write_text("empty.obj", "");
    expect(HS_EXIT_MESH, "run @/empty.obj", "empty.obj");
    expect(HS_EXIT_FILE, "run @/none.obj", "none.obj");
    /* A bad one does not keep the good ones from being shown. */
    expect(HS_EXIT_MESH, "mesh info @/two.obj shape:cube", "valence      3: 8");
}

/* What comes through a pipe can be read once. */
static void views_may_come_through_a_pipe(void **state) {
    (void)state;
    static const char *const command[] = {"run", "render", "convert", "explain"};
    static const char *const how[] = {"--engine golden --json @/run.json", "-w refined --json @/r",
                                      "-o @/c.ply", "--face 0 --json @/e"};
    write_text("views.txt", "look eye 0 0 5 at 0 0 0 up 0 1 0 fov 40 near 1 far 9\n");
    for (size_t i = 0; i < sizeof command / sizeof *command; i++) {
        char line[400];
        snprintf(
            line, sizeof line,
            "cat @/views.txt | build/halfstep %s shape:cube --views /dev/stdin %s >@/said 2>&1",
            command[i], how[i]);
        if (system(with_folder(&place, line)) != 0) fail_msg("%s", line);
    }
}

static void a_bad_views_file_is_named_by_line(void **state) {
    (void)state;
    write_text("bad.txt", "# one\nmatrix 1 2 3\n");
    expect(HS_EXIT_VIEWS, "run shape:cube --views @/bad.txt", "bad.txt:2");
    write_text("eye.txt", "look eye 0 0 0 at 0 0 0 up 0 1 0 fov 60 near 1 far 2\n");
    expect(HS_EXIT_VIEWS, "run shape:cube --views @/eye.txt", "eye.txt:1");
    write_text("none.txt", "# nothing\n");
    expect(HS_EXIT_VIEWS, "run shape:cube --views @/none.txt", "none.txt");
    expect(HS_EXIT_FILE, "run shape:cube --views @/missing.txt", "missing.txt");
}

static void a_bad_force_file_is_named_by_line(void **state) {
    (void)state;
    const char *const bad[] = {"1-2\n",   "0 3\n",   "7 3\n",  "2-1 3\n",
                               "1 251\n", "one 3\n", "1 2 3\n"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[100];
        snprintf(text, sizeof text, "# faces\n%s", bad[i]);
        write_text("force.txt", text);
        expect(HS_EXIT_MESH, "run shape:cube --force @/force.txt", "force.txt:2");
    }
}

static void an_unwritable_place_is_named_before_the_work_begins(void **state) {
    (void)state;
    write_text("file", "");
    expect(HS_EXIT_FILE, "run shape:cube --out @/file", "/file");
    assert_null(strstr(output, "view "));
    expect(HS_EXIT_FILE, "run shape:cube --out @/file/below", "/file");
    assert_null(strstr(output, "view "));
    expect(HS_EXIT_FILE, "run shape:cube --json @/none/x.json", "none/x.json");
    assert_null(strstr(output, "view "));
    expect(HS_EXIT_FILE, "run shape:cube --wave @/none/x.fst", "none/x.fst");
    expect(HS_EXIT_FILE, "run shape:cube --kanata @/none/x.log", "none/x.log");
    expect(HS_EXIT_FILE, "mesh make cube -o @/none/x.obj", "none/x.obj");
    assert_int_equal(count_entries(&place), 1);
}

static void a_report_on_standard_output_is_json_and_nothing_else(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "run shape:cube --json - >@/x.json 2>@/table && cat @/table", " equal\n");
    json_t *report = read_json("x.json");
    assert_true(json_is_true(at(report, "equal")));
    json_decref(report);
    assert_false(exists("-"));
}

/* --- Views that have to work ---------------------------------------------------------------------
 */

static void a_singular_matrix_works(void **state) {
    (void)state;
    write_text("views.txt", "matrix 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
                            "matrix 1 0 0 0 1 0 0 0 0 0 1 0 0 0 0 2\n");
    expect(HS_EXIT_OK,
           "run shape:mixed --views @/views.txt --engine reference,golden,rtl --out @/out",
           "equal");
    assert_true(exists("out/view-001/mesh.obj"));
}

static void the_eye_may_be_inside_the_mesh(void **state) {
    (void)state;
    write_text("views.txt", "look eye 0.1 0 0 at 1 0.5 0 up 0 1 0 fov 90 near 0.1 far 10\n");
    expect(HS_EXIT_OK, "run shape:cube:2 --views @/views.txt --engine reference,golden,rtl",
           "equal");
}

static void what_is_out_of_view_comes_back_as_it_went_in(void **state) {
    (void)state;
    write_text("views.txt", "look eye 0 0 5 at 0 0 9 up 0 1 0 fov 60 near 0.1 far 10\n"
                            "look eye 0 0 5 at 50 0 5 up 0 1 0 fov 20 near 0.1 far 10\n");
    expect(HS_EXIT_OK, "run shape:mixed --views @/views.txt --json @/x.json", "equal");
    json_t *report = read_json("x.json");
    for (int v = 0; v < 2; v++) {
        json_t *view = at(report, v ? "views/1" : "views/0");
        assert_int_equal(number_at(view, "engines/rtl/faces"), number_at(report, "mesh/faces"));
        assert_int_equal(number_at(view, "engines/rtl/vertices"),
                         number_at(report, "mesh/vertices"));
        assert_int_equal(number_at(view, "generations/0/selected"), 0);
    }
    json_decref(report);
}

/* --- Refused, stopped
 * ----------------------------------------------------------------------------- */

static void a_refused_view_is_reported_and_the_next_one_runs(void **state) {
    (void)state;
    write_text("views.txt", "matrix 3e38 3e38 3e38 0 0 1 0 0 0 0 1 0 0 0 0 1\n"
                            "matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 4\n");
    expect(HS_EXIT_REFUSED,
           "run shape:cube --views @/views.txt --engine reference,golden,rtl --json @/x.json "
           "--out @/out",
           "OVERFLOW");
    json_t *report = read_json("x.json");
    assert_string_equal(json_string_value(at(report, "views/0/engines/rtl/status")), "OVERFLOW");
    assert_string_equal(json_string_value(at(report, "views/1/engines/rtl/status")), "OK");
    assert_true(number_at(report, "views/1/engines/rtl/faces") > 6);
    json_decref(report);
    expect(HS_EXIT_REFUSED, "run shape:cube --max-vertices 7", "CAPACITY_VERTICES");
    expect(HS_EXIT_REFUSED, "run shape:cube --max-quads 23", "CAPACITY_CORNERS");
}

static void a_view_that_stops_early_is_no_error(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "run shape:cube --max-quads 100", "STOPPED");
    expect(HS_EXIT_OK, "run shape:cube --max-vertices 50 --engine reference,golden,rtl", "STOPPED");
}

/* --- What a run leaves
 * ---------------------------------------------------------------------------- */

static void a_run_leaves_views_meshes_streams_and_a_report(void **state) {
    (void)state;
    expect(HS_EXIT_OK,
           "run shape:tetrahedron --orbit 2 --engine reference,golden,rtl --size 64x48 "
           "--out @/new/out --json @/new/report.json",
           "equal");
    assert_true(exists("new/out/views.txt"));
    assert_true(exists("new/out/view-000/input.hss"));
    assert_true(exists("new/out/view-001/output.hss"));
    assert_true(exists("new/out/view-001/sheet.png"));
    json_t *report = read_json("new/report.json");
    assert_true(json_is_true(at(report, "equal")));
    json_t *view = at(report, "views/1");
    assert_int_equal(number_at(view, "engines/rtl/faces"), number_at(view, "engines/golden/faces"));
    assert_int_equal(number_at(view, "engines/reference/faces"),
                     number_at(view, "engines/golden/faces"));
    assert_int_equal(number_at(view, "engines/reference/vertices"),
                     number_at(view, "engines/golden/vertices"));
    const json_int_t cycles = number_at(view, "engines/rtl/cycles");
    assert_true(cycles >= number_at(view, "bound"));
    json_int_t final = 0;
    for (size_t g = 0; g < json_array_size(at(view, "generations")); g++) {
        char path[60];
        snprintf(path, sizeof path, "generations/%zu/final", g);
        final += number_at(view, path);
    }
    assert_int_equal(final, number_at(view, "engines/golden/faces"));
    const char *stage;
    json_t *value;
    json_object_foreach(at(view, "engines/rtl/stages"), stage, value) {
        assert_int_equal(number_at(value, "busy") + number_at(value, "starved") +
                             number_at(value, "blocked") + number_at(value, "idle"),
                         cycles);
    }
    bool words = false;
    for (size_t i = 0; i < json_array_size(at(view, "comparisons")); i++) {
        json_t *c = json_array_get(at(view, "comparisons"), i);
        assert_int_equal(number_at(c, "different"), 0);
        words |= strcmp(json_string_value(at(c, "what")), "words") == 0 &&
                 number_at(c, "compared") == number_at(view, "engines/rtl/words");
    }
    assert_true(words);
    json_decref(report);

    /* The views that were used give the same run again. */
    expect(HS_EXIT_OK, "run shape:tetrahedron --views @/new/out/views.txt --json @/again.json -q",
           "equal");
    json_t *again = read_json("again.json");
    report = read_json("new/report.json");
    assert_string_equal(json_string_value(at(again, "views/1/engines/rtl/digest")),
                        json_string_value(at(report, "views/1/engines/rtl/digest")));
    json_decref(again);
    json_decref(report);
    expect(HS_EXIT_OK, "mesh info @/new/out/view-000/mesh.obj", "closed");
}

static void forced_faces_are_refined_where_the_view_sees_nothing(void **state) {
    (void)state;
    write_text("views.txt", "look eye 0 0 5 at 0 0 9 up 0 1 0 fov 60 near 0.1 far 10\n");
    write_text("force.txt", "1-16 2 # the first row\n\n3 1\n");
    expect(HS_EXIT_OK,
           "run shape:cube:4 --views @/views.txt --front 0 --silhouette 1 --force @/force.txt "
           "--json @/x.json",
           "equal");
    json_t *report = read_json("x.json");
    assert_int_equal(number_at(report, "views/0/generations/0/selected"), 16);
    assert_int_equal(number_at(report, "settings/depth"), 2);
    json_decref(report);
}

static void stalls_change_the_cycles_and_not_a_word(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "run shape:cube --json @/a.json", "equal");
    expect(HS_EXIT_OK, "run shape:cube --stalls 60,80 --seed 5 --json @/b.json", "equal");
    json_t *a = read_json("a.json"), *b = read_json("b.json");
    assert_string_equal(json_string_value(at(a, "views/0/engines/rtl/digest")),
                        json_string_value(at(b, "views/0/engines/rtl/digest")));
    assert_true(number_at(a, "views/0/engines/rtl/cycles") <
                number_at(b, "views/0/engines/rtl/cycles"));
    json_decref(a);
    json_decref(b);
}

static void a_waveform_is_written_for_the_cycles_asked_for(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "run shape:cube --orbit 2 --view 1 --wave @/w.fst --wave-cycles 10:50",
           "waveform");
    assert_true(exists("w.fst"));
    assert_int_equal(count_entries(&place), 1);
}

/* --- Meshes
 * --------------------------------------------------------------------------------------- */

static void timelines_are_the_same_from_either_engine(void **state) {
    (void)state;
    static const char *const engine[] = {"rtl", "model", "golden,model,rtl"};
    char line[400];
    for (int i = 0; i < 3; i++) {
        snprintf(
            line, sizeof line,
            "run shape:cube --orbit 3 --front 2 --silhouette 4 --engine %s --timeline @/%d.json "
            "--kanata @/%d.log",
            engine[i], i, i);
        expect(HS_EXIT_OK, line, "timeline: ");
    }
    snprintf(
        line, sizeof line,
        "cd %s && cmp 0.json 1.json && cmp 0.log 1.log && cmp 1.json 2.json && cmp 1.log 2.log",
        place.path);
    assert_int_equal(system(line), 0);
    json_t *trace = read_json("0.json");
    assert_true(json_array_size(at(trace, "traceEvents")) > 100);
    json_decref(trace);
    expect(HS_EXIT_OK,
           "run shape:cube --engine model --timeline - >@/t.json 2>@/table && cat @/table",
           " done\n");
    json_decref(read_json("t.json"));
    expect(HS_EXIT_OK,
           "run shape:cube --orbit 2 --view 1 --engine model --timeline-svg @/t.svg && head -1 "
           "@/t.svg",
           "<svg ");
}

static void a_mesh_goes_out_and_comes_back_bit_for_bit(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "mesh make random --size 60 --seed 3 -o @/a.obj", "faces");
    expect(HS_EXIT_OK, "mesh convert @/a.obj @/b.obj", "faces");
    char line[300];
    snprintf(line, sizeof line, "cmp %s/a.obj %s/b.obj", place.path, place.path);
    assert_int_equal(system(line), 0);
    expect(HS_EXIT_OK, "mesh make cube", "v -1 -1 -1");
}

/* --- Traces
 * --------------------------------------------------------------------------------------- */

static void every_trace_is_what_it_was_and_can_be_made_again(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "trace check", "good");
    char line[300];
    snprintf(line, sizeof line, "cp -r traces/refused-packets traces/torus-stalls %s", place.path);
    assert_int_equal(system(line), 0);
    expect(HS_EXIT_OK, "trace make @/refused-packets @/torus-stalls", "made");
    for (int i = 0; i < 2; i++) {
        const char *name = i ? "torus-stalls" : "refused-packets";
        snprintf(line, sizeof line, "diff -r traces/%s %s/%s", name, place.path, name);
        assert_int_equal(system(line), 0);
    }
}

static void a_trace_that_is_not_as_expected_says_what_differs(void **state) {
    (void)state;
    char line[400];
    snprintf(line, sizeof line,
             "cp -r traces/cube-4-8 %s/t && sed -i '0,/\"faces\": /s//&1/' "
             "%s/t/expected.json",
             place.path, place.path);
    assert_int_equal(system(line), 0);
    expect(HS_EXIT_DIFFERENT, "trace check @/t", "view 0: faces should be 1");
    snprintf(line, sizeof line, "sed -i 's/^silhouette 8/silhouette 6/' %s/t/trace.txt",
             place.path);
    assert_int_equal(system(line), 0);
    expect(HS_EXIT_STREAM, "trace check @/t", "packet 0 of input.hss is not what trace.txt makes");
    expect(HS_EXIT_FILE, "trace check nowhere", "nowhere/trace.txt");
}

static void a_wrong_statement_of_a_trace_is_named_by_line(void **state) {
    (void)state;
    mkdir(inside(&place, "t"), 0777);
    const struct {
        const char *line, *message;
    } bad[] = {{"forn 3", "did you mean \"front\"?"}, {"front 251", "should be a number up to 250"},
               {"front", "a number is missing"},      {"matrix 1 2", "a matrix has 16 numbers"},
               {"word 3 4", "no view before it"},     {"mesh shape:cube", "a second mesh"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[200];
        snprintf(text, sizeof text, "mesh shape:cube\n%s\n", bad[i].line);
        write_text("t/trace.txt", text);
        expect(HS_EXIT_STREAM, "trace make @/t", bad[i].message);
        assert_non_null(strstr(output, "trace.txt:2"));
    }
    assert_false(exists("t/input.hss"));
}

static void a_stream_shown_as_text_builds_the_same_stream(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "run shape:mixed --engine golden --size 32x32 --out @/out", "done");
    const char *const name[] = {"out/view-000/input.hss", "out/view-000/output.hss"};
    for (int i = 0; i < 2; i++) {
        char line[600];
        snprintf(line, sizeof line, "trace show @/%s >@/text.txt", name[i]);
        expect(HS_EXIT_OK, line, "");
        expect(HS_EXIT_OK, "trace build @/text.txt @/again.hss", "");
        snprintf(line, sizeof line, "cmp %s/%s %s/again.hss", place.path, name[i], place.path);
        assert_int_equal(system(line), 0);
    }
    write_text("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
                             "t crease 2/1/0 0 1 3\nt corner 1/1/0 2 10\n");
    expect(HS_EXIT_OK,
           "run @/square.obj --limit --boundary edge-only --min-edge-px 2.5 --front 2 "
           "--silhouette 2 --engine golden --size 48x32 --out @/square",
           "edge-only, limit, edges of 2.5 px");
    const char *const shown[] = {
        "flags: guard limit edge-only; 4 vertices", "least edge 2.5 pixels of 48 x 32",
        "matrix row 0:", "border, edge sharp for 3", "vertex sharp for ever"};
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        expect(HS_EXIT_OK, "trace show @/square/view-000/input.hss", shown[i]);
    expect(HS_EXIT_OK, "trace show @/square/view-000/output.hss",
           "0 triangles, 0 vertices at their level");
    write_text("text.txt", "packet 7\n1.5 0 0 ff # numbers\n0 0 0 crc\n");
    expect(HS_EXIT_OK, "trace build @/text.txt @/small.hss", "");
    expect(HS_EXIT_OK, "trace show @/small.hss", "3fc00000 00000000 00000000 000000ff");
    write_text("text.txt", "packet 7\n1 2 3\n");
    expect(HS_EXIT_STREAM, "trace build @/text.txt @/x.hss", "text.txt:2");
    write_text("text.txt", "packet 7\n1 2 3 123456789\n");
    expect(HS_EXIT_STREAM, "trace build @/text.txt @/x.hss", "\"123456789\" is no word");
    assert_false(exists("x.hss"));
    write_text("cut.hss", "HS2F");
    expect(HS_EXIT_STREAM, "trace show @/cut.hss", "cut.hss");
}

static void a_users_output_stream_is_judged_word_for_word(void **state) {
    (void)state;
    char line[600];
    expect(HS_EXIT_OK, "run shape:cube --orbit 3 --engine golden --size 32x32 --out @/out", "done");
    snprintf(line, sizeof line, "cat %s/out/view-00?/output.hss >%s/all.hss", place.path,
             place.path);
    assert_int_equal(system(line), 0);
    expect(HS_EXIT_OK, "trace check cube-4-8 --output @/all.hss", "good for traces/cube-4-8");
    expect(HS_EXIT_DIFFERENT, "trace check cube-4-8 --output @/out/view-000/output.hss",
           "1 packets; traces/cube-4-8 asks for 3 views");

    expect(HS_EXIT_OK, "trace show @/all.hss >@/all.txt", "");
    snprintf(line, sizeof line,
             "sed -i '0,/position of 4: /{/position of 4: /s/^......../3f800000/}' "
             "%s/all.txt",
             place.path);
    assert_int_equal(system(line), 0);
    expect(HS_EXIT_OK, "trace build @/all.txt @/wrong.hss", "");
    expect(HS_EXIT_DIFFERENT, "trace check cube-4-8 --output @/wrong.hss",
           "position of vertex 4 (x)");
    assert_non_null(strstr(output, "yours sent 0x3f800000 (1)"));
    expect(HS_EXIT_USAGE, "trace check --output @/all.hss", "name it");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(help_teaches_by_example_and_exits_with_0),
        TEST(an_unknown_word_names_the_nearest_one),
        TEST(a_wrong_value_says_what_would_be_right),
        TEST(an_option_that_does_nothing_is_refused),
        TEST(a_run_becomes_a_page),
        TEST(a_mesh_is_described_with_its_creases_and_its_boundary),
        TEST(a_standard_output_that_takes_nothing_is_an_error),
        TEST(the_model_counts_the_cycles_of_the_rtl),
        TEST(a_bad_mesh_is_named_by_file_and_line),
        TEST(views_may_come_through_a_pipe),
        TEST(a_bad_views_file_is_named_by_line),
        TEST(a_bad_force_file_is_named_by_line),
        TEST(an_unwritable_place_is_named_before_the_work_begins),
        TEST(a_report_on_standard_output_is_json_and_nothing_else),
        TEST(a_singular_matrix_works),
        TEST(the_eye_may_be_inside_the_mesh),
        TEST(what_is_out_of_view_comes_back_as_it_went_in),
        TEST(a_refused_view_is_reported_and_the_next_one_runs),
        TEST(a_view_that_stops_early_is_no_error),
        TEST(a_run_leaves_views_meshes_streams_and_a_report),
        TEST(forced_faces_are_refined_where_the_view_sees_nothing),
        TEST(stalls_change_the_cycles_and_not_a_word),
        TEST(a_waveform_is_written_for_the_cycles_asked_for),
        TEST(timelines_are_the_same_from_either_engine),
        TEST(a_mesh_goes_out_and_comes_back_bit_for_bit),
        TEST(every_trace_is_what_it_was_and_can_be_made_again),
        TEST(a_trace_that_is_not_as_expected_says_what_differs),
        TEST(a_wrong_statement_of_a_trace_is_named_by_line),
        TEST(a_stream_shown_as_text_builds_the_same_stream),
        TEST(a_users_output_stream_is_judged_word_for_word),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
