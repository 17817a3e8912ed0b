/* SPDX-License-Identifier: Apache-2.0
 *
 * What `make install` leaves is complete: others compile against it, link with it, lint it, and
 * `make uninstall` takes all of it away. And the lists that say what the project is agree.
 */
#include "command.h"

#include "options.h"

/* All of it under the test's folder; the page for reports comes from npm, and is tested elsewhere.
 */
#define MAKE    "MAKEFLAGS= MAKELEVEL= make -s REPORT_PAGE= DESTDIR=@/root PREFIX=/opt/half "
#define INSTALL MAKE "install && "
#define ROOT    "@/root/opt/half"
#define PKG_CONFIG                                                                                 \
    "PKG_CONFIG_SYSROOT_DIR=@/root PKG_CONFIG_PATH=" ROOT "/lib/pkgconfig pkg-config "

static void a_program_is_built_with_what_pkg_config_says(void **state) {
    (void)state;
    expect_line(0,
                INSTALL "gcc -std=c17 -Wall -Werror tests/install/refine.c -o @/refine "
                        "$(" PKG_CONFIG "--cflags --libs halfstep) && "
                        "LD_LIBRARY_PATH=" ROOT "/lib @/refine cube",
                "6 faces in, 24 out, OK");
    expect_line(0, "ldd @/refine; readelf -d @/refine", "[libhalfstep.so.0.1]");
    expect_line(0,
                "gcc -std=c17 tests/install/refine.c -o @/static $(" PKG_CONFIG
                "--cflags halfstep) " ROOT "/lib/libhalfstep.a $(" PKG_CONFIG
                "--static --libs-only-l halfstep | sed s/-lhalfstep//) && @/static torus",
                "out, OK");
    expect_line(0, PKG_CONFIG "--modversion halfstep", HS_VERSION);
}

/* Each by itself, as C and as C++: it includes what it needs, and all of that is installed. */
static void every_installed_header_stands_alone(void **state) {
    (void)state;
    expect_line(0,
                INSTALL "for h in " ROOT "/include/halfstep/*.h; do "
                        "echo \"#include <halfstep/$(basename $h)>\" >@/one.c && "
                        "gcc -std=c17 -fsyntax-only -I" ROOT "/include @/one.c && "
                        "g++ -x c++ -std=c++17 -fsyntax-only -I" ROOT "/include @/one.c && "
                        "echo $(basename $h) stands; done",
                "golden.h stands");
    assert_null(strstr(run_line("ls " ROOT "/include/halfstep")->text, "_parts"));
}

static void the_shared_library_gives_its_own_names_alone(void **state) {
    (void)state;
    expect_line(1,
                INSTALL "nm -D --defined-only " ROOT "/lib/libhalfstep.so | awk '{ print $3 }' | "
                        "grep -v '^hs_'",
                "");
}

static void the_installed_program_runs_elsewhere(void **state) {
    (void)state;
    expect_line(0, INSTALL "cd @ && " ROOT "/bin/halfstep run shape:cube", "equal");
    expect_line(0, "cp build/halfstep-faulty " ROOT "/bin/odd", "");
    expect_line(1,
                "cd / && HS_FAULT=model-word " ROOT "/bin/odd run shape:cube --engine golden,model",
                "opt/half/bin/odd run shape:cube --orbit 1");
    expect_line(0, ROOT "/bin/halfstep man | cmp - " ROOT "/share/man/man1/halfstep.1", "");
    expect_line(0, "bash -n " ROOT "/share/bash-completion/completions/halfstep", "");
    expect_line(0, "head -1 " ROOT "/share/zsh/site-functions/_halfstep", "#compdef halfstep");
}

/* Any page will do to see that it is found. */
static void the_installed_program_finds_the_page_of_reports(void **state) {
    (void)state;
    expect_line(0,
                "echo '<html>' >@/page && " MAKE "REPORT_PAGE=@/page install && "
                "ls " ROOT "/share/halfstep/report",
                "template.html");
    expect_line(0, "cd @ && " ROOT "/bin/halfstep run shape:cube --engine golden --out out -q", "");
    assert_null(strstr(run_line(ROOT "/bin/halfstep report @/out")->text, "no page to fill"));
}

static void the_installed_rtl_is_complete(void **state) {
    (void)state;
    expect_line(0,
                INSTALL "cd / && verilator --lint-only -Wall --top-module halfstep -F " ROOT
                        "/share/halfstep/rtl/files.f && echo clean",
                "clean");
    expect_line(0, "test -d \"$(" PKG_CONFIG "--variable=rtl halfstep)\" && echo there", "there");
    expect_line(1,
                "rm " ROOT "/share/halfstep/rtl/fifo.sv; verilator --lint-only -Wall "
                "--top-module halfstep -F " ROOT "/share/halfstep/rtl/files.f",
                "fifo");
}

static void uninstalling_leaves_nothing(void **state) {
    (void)state;
    expect_line(0, INSTALL "find @/root -type f | wc -l", "1");
    expect_line(0,
                "touch " ROOT "/share/halfstep/of-somebody-else; " MAKE "uninstall && "
                "find @/root ! -type d",
                "of-somebody-else");
    expect_line(0,
                "rm " ROOT "/share/halfstep/of-somebody-else; " MAKE "uninstall && "
                "find @/root ! -type d | wc -l; find @/root -name '*halfstep*' | wc -l",
                "0\n0\n");
}

/* --- Lists that agree ----------------------------------------------------------------------------
 */

static void the_fusesoc_core_lists_the_rtl(void **state) {
    (void)state;
    expect_line(0,
                "sed -n 's/^ *- \\(rtl\\/.*\\)$/\\1/p' halfstep.core >@/core; "
                "test -s @/core && diff rtl/files.f @/core && echo agree",
                "agree");
    expect_line(0, "grep ^name: halfstep.core", "name: ::halfstep:" HS_VERSION "\n");
    expect_line(0, "head -1 halfstep.core", "CAPI=2:\n");
}

static void the_citation_names_this_version(void **state) {
    (void)state;
    expect_line(0, "grep ^version: CITATION.cff", "version: " HS_VERSION "\n");
    expect_line(0, "grep ^cff-version: CITATION.cff", "cff-version: 1.2.0\n");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)
    const struct CMUnitTest tests[] = {
        TEST(a_program_is_built_with_what_pkg_config_says),
        TEST(every_installed_header_stands_alone),
        TEST(the_shared_library_gives_its_own_names_alone),
        TEST(the_installed_program_runs_elsewhere),
        TEST(the_installed_program_finds_the_page_of_reports),
        TEST(the_installed_rtl_is_complete),
        TEST(uninstalling_leaves_nothing),
        TEST(the_fusesoc_core_lists_the_rtl),
        TEST(the_citation_names_this_version),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
