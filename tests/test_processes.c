/* SPDX-License-Identifier: Apache-2.0
 *
 * Whatever happens to a process, it leaves whole files or none, and a rerun completes: full disks,
 * folders that may not be written, kills at any time, two at once, little memory.
 *
 * `make test` runs a bounded form; with HS_PROCESSES=full (`make processes`) everything is done,
 * and figures are printed.
 */
#include "command.h"

#include "definitions.h"

#include <sys/mount.h>

static bool full;
static int kill_points = 2;                         /* of a run */
static unsigned long kills, refused, limits, disks; /* what was tried, for the figures */

/* Commands that write, all files into @/o. What they print may tell times; what they write may not:
 * the report's seconds are cut out before comparing. */
static const struct writer {
    const char *name, *line;
} writers[] = {
    {"run",
     "exec ~/build/halfstep run shape:cube --orbit 2 --front 2 --silhouette 4 --engine golden,rtl "
     "--size 32x32 --levels 1 --quiet --out @/o --json @/o/run.json"},
    {"wave",
     "exec ~/build/halfstep run shape:cube --front 1 --silhouette 2 --quiet --wave @/o/w.fst"},
    {"explore",
     "exec ~/build/halfstep explore shape:torus --front 1 --silhouette 2 --set banks=2,4,8 "
     "--jobs 2 --quiet --out @/o"},
    {"render", "exec ~/build/halfstep render shape:cube --size 64x64 --quiet -o @/o/cube.png"},
    {"trace", "cp ~/traces/cube-4-8/trace.txt @/o && exec ~/build/halfstep trace make @/o"},
    {"mesh", "exec ~/build/halfstep mesh make random --size 2000 -o @/o/random.obj"},
    {"convert", "exec ~/build/halfstep convert shape:torus --quiet -o @/o/torus.gltf"},
    {"timeline", "exec ~/build/halfstep run shape:cube --orbit 2 --engine model --quiet "
                 "--timeline @/o/t.json --kanata @/o/t.log"},
};
enum { WRITERS = sizeof writers / sizeof *writers };

/* The bounded form takes every other one. */
static int next_writer(int i) {
    return full ? i + 1 : i + 2;
}

/* What of the folders of two runs must be equal: everything; a waveform has a date in it, a report
 * the seconds, and a journal's lines come as the threads end. */
static const char same_folders[] =
    "for d in @/o @/whole; do find $d -name '*.json' -exec sed -i '/\"seconds\"/d' {} +; done; "
    "diff -rq -x '*.fst' -x 'shard-*' @/o @/whole && ls @/o >@/a && ls @/whole >@/b && cmp @/a @/b";

static void run_whole(const struct writer *w) {
    expect_line(0, "rm -rf @/o @/whole && mkdir @/o", "");
    expect_line(0, w->line, "");
    expect_line(0, "mv @/o @/whole && mkdir @/o", "");
}

/* Each file that has its final name is as the undisturbed run wrote it; a journal may be shorter.
 */
static const char only_whole_files[] =
    "cd @/o && find . -type f ! -name '*.partial-*' ! -name 'shard-*' ! -name '*.fst' | "
    "while read -r f; do sed '/\"seconds\"/d' $f | cmp -s - @/cut/$f || echo \"torn: $f\"; done; "
    "find . -name '*.fst' | while read -r f; do "
    "test $(tail -c +2 $f | wc -c) -gt 1000 || echo \"torn: $f\"; done";

static void cut_seconds(void) {
    expect_line(0,
                "rm -rf @/cut && cp -r @/whole @/cut && cd @/cut && find . -type f | "
                "while read -r f; do sed -i '/\"seconds\"/d' $f; done",
                "");
}

static void assert_only_whole_files(const char *what) {
    const outcome *o = run_line(only_whole_files);
    if (strstr(o->text, "torn")) fail_msg("%s: %s", what, o->text);
}

/* --- Killed -------------------------------------------------------------------------------------
 */

static void kill_and_rerun(const struct writer *w, double after, int with) {
    char said[100], what[200];
    static outcome o;
    expect_line(0, "rm -rf @/o && mkdir @/o", "");
    snprintf(said, sizeof said, "%s.said", place.path);
    snprintf(what, sizeof what, "%s, signal %d after %.3f s", w->name, with, after);
    const pid_t child = start_line(w->line, said);
    usleep((useconds_t)(1e6 * after));
    kill(-child, with);
    end_line(child, said, &o);
    kills++;
    assert_only_whole_files(what);
    if (with != SIGKILL && strstr(run_line("ls -R @/o")->text, ".partial"))
        fail_msg("%s: left %s", what, run_line("ls -R @/o")->text);
    expect_line(0, w->line, "");
    const outcome *same = run_line(same_folders);
    if (same->code) fail_msg("%s, rerun: %s", what, same->text);
}

static void a_killed_process_leaves_whole_files_and_a_rerun_completes(void **state) {
    (void)state;
    static const int with[] = {SIGKILL, SIGINT, SIGTERM};
    for (int i = 0; i < WRITERS; i = next_writer(i)) {
        run_whole(&writers[i]);
        cut_seconds();
        const int points = full && i > 0 ? kill_points / 2 : kill_points;
        const double start = seconds_now();
        expect_line(0, writers[i].line, "");
        const double length = seconds_now() - start;
        for (int p = 0; p < points; p++)
            kill_and_rerun(&writers[i], length * (p + 0.5) / points, with[(p + i) % 3]);
    }
}

/* The library that writes FST has a second file while it is at work. */
static void an_interrupted_waveform_leaves_nothing(void **state) {
    (void)state;
    const outcome *o =
        run_line("mkdir @/o; build/halfstep run shape:torus --uniform 8 --engine rtl --quiet "
                 "--wave @/o/w.fst >/dev/null & for n in $(seq 600); do "
                 "test -e @/o/w.fst.partial-$!-0.hier && break; sleep 0.05; done; "
                 "ls @/o | wc -l; kill $!; wait $!; ls @/o | sed 's/^/left /'");
    if (strncmp(o->text, "2\n", 2) != 0 || strstr(o->text, "left")) fail_msg("%s", o->text);
}

/* --- Full disks ---------------------------------------------------------------------------------
 */

/* A limit on the size of files stands for a full disk. */
static void a_write_that_fails_is_said_and_leaves_nothing_torn(void **state) {
    (void)state;
    for (int i = 0; i < WRITERS; i = next_writer(i)) {
        run_whole(&writers[i]);
        cut_seconds();
        for (int blocks = 0; blocks <= 64; blocks = full ? 2 * blocks + 1 : 60 * blocks + 8) {
            char line[1000];
            expect_line(0, "rm -rf @/o && mkdir @/o", "");
            snprintf(line, sizeof line,
                     "trap '' XFSZ; { (ulimit -f %d; %s); echo \"ended with $?.\"; } 2>&1 | cat",
                     blocks, writers[i].line);
            const outcome *o = run_line(line);
            disks++;
            /* The copy of trace.txt may be what fails. */
            if (!strstr(o->text, "ended with 0.") && !strstr(o->text, "cp: ") &&
                !(strstr(o->text, "ended with 6.") && strstr(o->text, place.path) &&
                  strstr(o->text, "cannot ")))
                fail_msg("%s with %d blocks: %s", writers[i].name, blocks, o->text);
            if (i != 4) assert_only_whole_files(writers[i].name);
        }
        expect_line(0, "rm -rf @/o && mkdir @/o", "");
        expect_line(0, writers[i].line, "");
        expect_line(0, same_folders, "");
    }
    expect_line(HS_EXIT_FILE, "build/halfstep mesh make cube -o /dev/full", "No space left");
    expect_line(HS_EXIT_FILE, "build/halfstep mesh make cube >/dev/full", "No space left");
    expect_line(HS_EXIT_FILE, "build/halfstep mesh list >/dev/full", "cannot write");
    expect_line(HS_EXIT_FILE, "build/halfstep run shape:cube --engine golden --json /dev/full",
                "/dev/full: cannot write: No space left");
    expect_line(HS_EXIT_FILE, "build/halfstep render shape:cube --size 32x32 -o /dev/full",
                "No space left");
    expect_line(HS_EXIT_FILE, "build/halfstep run shape:cube --wave /dev/full", "no regular file");
}

/* A real one, where a file system may be mounted. */
static void a_full_file_system_is_said(void **state) {
    (void)state;
    expect_line(0, "mkdir @/o @/whole", "");
    if (mount("none", inside(&place, "o"), "tmpfs", 0, "size=64k") != 0) skip();
    const int code = run_line(writers[0].line)->code;
    const bool said = strstr(run_line(writers[0].line)->text, "No space left") != NULL;
    const int kinds = run_line("ls -R @/o | grep partial")->code;
    umount(inside(&place, "o"));
    assert_int_equal(code, HS_EXIT_FILE);
    assert_true(said);
    assert_int_equal(kinds, 1);
}

static void a_folder_that_may_not_be_written_is_said(void **state) {
    (void)state;
    /* Root may write anywhere: a file where a folder should be stops root too. */
    expect_line(0, ": >@/file", "");
    static const char *const line[] = {
        "build/halfstep run shape:cube --engine golden --out @/file/o",
        "build/halfstep run shape:cube --engine golden --json @/file/o",
        "build/halfstep run shape:cube --wave @/file/o",
        "build/halfstep explore shape:cube --out @/file/o",
        "build/halfstep render shape:cube --size 32x32 -o @/file/o",
        "build/halfstep mesh make cube -o @/file/o",
    };
    for (size_t i = 0; i < sizeof line / sizeof *line; i++)
        expect_line(HS_EXIT_FILE, line[i], "Not a directory");
    if (geteuid() == 0) return;
    expect_line(HS_EXIT_FILE, "mkdir @/r; chmod 500 @/r; build/halfstep mesh make cube -o @/r/c",
                "Permission denied");
}

/* --- Two at once --------------------------------------------------------------------------------
 */

static void two_at_once_are_refused_or_both_whole(void **state) {
    (void)state;
    const int rounds = full ? 10 : 1;
    for (int i = 0; i < WRITERS; i = next_writer(i)) {
        run_whole(&writers[i]);
        for (int r = 0; r < rounds; r++) {
            char line[2000];
            expect_line(0, "rm -rf @/o && mkdir @/o", "");
            snprintf(line, sizeof line, "(%s) & (%s) & wait", writers[i].line, writers[i].line);
            run_line(line);
            const outcome *same = run_line(same_folders);
            if (same->code) fail_msg("%s, two at once: %s", writers[i].name, same->text);
        }
    }
    expect_line(HS_EXIT_FILE,
                "mkdir -p @/o; flock @/o sleep 5 & sleep 0.5; "
                "build/halfstep run shape:cube --engine golden --out @/o",
                "another process is at work in this folder");
}

/* --- Memory -------------------------------------------------------------------------------------
 */

/* Ends in success, or in an error with a message. */
static void assert_clean_end(const outcome *o, const char *what, bool loads) {
    if (loads && o->code == 127) return; /* the loader had no room for the libraries */
    if (o->code < 0 || o->code > HS_EXIT_INTERNAL || (o->code && !strstr(o->text, "halfstep: ")))
        fail_msg("%s: ended with %d: %s", what, o->code, o->text);
}

static void a_refused_allocation_is_said(void **state) {
    (void)state;
    static const char *const line[] = {
        "exec ~/build/halfstep run @/m.obj --engine golden,reference,model --front 1 "
        "--silhouette 2 --views @/v.txt --json @/r.json --quiet",
        "exec ~/build/halfstep mesh info @/m.obj",
        "exec ~/build/halfstep explore @/m.obj --front 1 --silhouette 1 --jobs 1 --quiet --out @/e",
        "exec ~/build/halfstep trace show @/i.hss",
        "~/build/halfstep convert @/m.obj -f 1 -s 2 --quiet -o @/g.glb && unset LD_PRELOAD && "
        "cmp @/g.glb @/w.glb",
    };
    expect_line(0,
                "build/halfstep mesh make mixed -o @/m.obj && build/halfstep run @/m.obj "
                "--engine golden --quiet --size 16x16 --levels 0 --out @/o && "
                "cp @/o/views.txt @/v.txt && cp @/o/view-000/input.hss @/i.hss && "
                "build/halfstep convert @/m.obj -f 1 -s 2 --quiet -o @/w.glb",
                "");
    for (size_t i = 0; i < sizeof line / sizeof *line; i++) {
        char text[1000], what[100];
        snprintf(text, sizeof text,
                 "export FAIL_ALLOC_COUNT=@/n LD_PRELOAD=~/build/fail_alloc.so; %s", line[i]);
        expect_line(0, text, "");
        const unsigned long all = strtoul(run_line("cat @/n")->text, NULL, 10);
        assert_true(all > 3);
        const unsigned long step = full ? 1 : all / 5 + 1;
        for (unsigned long n = 1; n <= all; n += step)
            for (int later = 0; later < 2; later++) {
                snprintf(text, sizeof text,
                         "rm -rf @/e; export FAIL_ALLOC=%lu%s LD_PRELOAD=~/build/fail_alloc.so; %s",
                         n, later ? "+" : "", line[i]);
                snprintf(what, sizeof what, "%zu, allocation %lu%s", i, n, later ? "+" : "");
                assert_clean_end(run_line(text), what, false);
                refused++;
            }
    }
}

static void little_memory_is_said(void **state) {
    (void)state;
    static const char *const line[] = {
        "run shape:torus --uniform 8 --engine golden,model,rtl --quiet",
        "run shape:random:10000 --engine golden,reference --quiet",
        "explore shape:torus --jobs 1 --quiet --out @/e",
        "mesh info shape:random:10000",
    };
    for (size_t i = 0; i < sizeof line / sizeof *line; i++)
        for (int megabytes = 150; megabytes < 600; megabytes += full ? 15 : 150) {
            char text[400], what[100];
            snprintf(text, sizeof text, "ulimit -v %d; exec ~/build/halfstep %s", 1024 * megabytes,
                     line[i]);
            snprintf(what, sizeof what, "%s in %d MB", line[i], megabytes);
            assert_clean_end(run_line(text), what, true);
            limits++;
        }
}

/* Faces in a grid of side * side, as OBJ. */
static void write_grid(const char *name, uint32_t side) {
    FILE *file = fopen(inside(&place, name), "wb");
    assert_non_null(file);
    for (uint32_t i = 0; i <= side; i++)
        for (uint32_t j = 0; j <= side; j++)
            fprintf(file, "v %g %g %g\n", j / (double)side, i / (double)side, i % 7 * 0.001);
    for (uint32_t i = 0; i < side; i++)
        for (uint32_t j = 0; j < side; j++) {
            const uint32_t v = i * (side + 1) + j + 1;
            fprintf(file, "f %u %u %u %u\n", v, v + 1, v + side + 2, v + side + 1);
        }
    assert_int_equal(fclose(file), 0);
}

/* At most 512 bytes a face that goes out; beside it, 64 MB. */
static void large_meshes_need_no_more_memory_than_is_stated(void **state) {
    (void)state;
    const uint32_t side = full ? 1415 : 354;
    const double faces = (double)side * side;
    write_grid("grid.obj", side);
    for (uint32_t depth = 0; depth <= (full ? 2 : 1); depth++) {
        char line[300];
        snprintf(line, sizeof line,
                 "exec ~/build/halfstep run @/grid.obj --engine golden --quiet --uniform %u "
                 "--max-vertices 16777216 --max-quads 16777216",
                 depth);
        const outcome *o = run_line(line);
        const double most = 64e6 + 512 * faces * (1 << depth);
        assert_int_equal(o->code, 0);
        printf("%sgolden, %.0f faces, %.0f out: %.0f MB, stated are %.0f\n", full ? "result: " : "",
               faces, faces * (1 << depth), 1.024e-3 * (double)o->kilobytes, 1e-6 * most);
        assert_true(1024.0 * (double)o->kilobytes <= most);
    }
    if (full)
        expect_line(HS_EXIT_REFUSED, "build/halfstep run @/grid.obj --engine golden --quiet",
                    "more vertices than this pipeline holds");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_killed_process_leaves_whole_files_and_a_rerun_completes),
        TEST(an_interrupted_waveform_leaves_nothing),
        TEST(a_write_that_fails_is_said_and_leaves_nothing_torn),
        TEST(a_full_file_system_is_said),
        TEST(a_folder_that_may_not_be_written_is_said),
        TEST(two_at_once_are_refused_or_both_whole),
        TEST(a_refused_allocation_is_said),
        TEST(little_memory_is_said),
        TEST(large_meshes_need_no_more_memory_than_is_stated),
    };
    const char *points = getenv("HS_PROCESSES");
    full = points != NULL;
    if (full && (kill_points = atoi(points)) < 2) return HS_EXIT_USAGE;
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    if (full)
        printf("result: %lu kills and reruns, %lu runs on full disks, %lu refused allocations, %lu "
               "limits of memory; %d tests failed\n",
               kills, disks, refused, limits, failed);
    return failed;
}
