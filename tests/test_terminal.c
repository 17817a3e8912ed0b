/* SPDX-License-Identifier: Apache-2.0
 *
 * What a terminal gets and a file does not; lines that fit; completion and man page, which leave
 * out no command and no option. script(1) gives a command a terminal.
 */
#include "command.h"

/* Runs a shell's line on a terminal; the environment's words stand before it. */
#define TERMINAL(line) "env -u NO_COLOR TERM=xterm script -qec '" line "' /dev/null"
#define RUN            "build/halfstep run shape:cube --engine golden,model --orbit 3"

static const char *const COLOUR = "\033[";

static void expect_colours(bool wanted, const char *line) {
    const outcome *o = run_line(line);
    if ((strstr(o->text, COLOUR) != NULL) != wanted)
        fail_msg("%s\nhas %scolours:\n%.2000s", line, wanted ? "no " : "", o->text);
}

/* --- Colours ------------------------------------------------------------------------------------
 */

static void colours_are_for_terminals_that_want_them(void **state) {
    (void)state;
    expect_colours(true, TERMINAL(RUN));
    expect_colours(true, TERMINAL("NO_COLOR= " RUN));
    expect_colours(false, TERMINAL("NO_COLOR=1 " RUN));
    expect_colours(false, TERMINAL("TERM=dumb " RUN));
    expect_colours(false, TERMINAL("env -u TERM " RUN));
    expect_colours(false, TERMINAL(RUN " -q | cat"));
    expect_colours(false, "TERM=xterm " RUN);
    expect_line(0, TERMINAL(RUN), "\033[32mequal\033[0m");
}

static void errors_are_coloured_alike(void **state) {
    (void)state;
    expect_line(2, TERMINAL("build/halfstep rnu"), "\033[31mhalfstep:\033[0m no command");
    expect_line(6, TERMINAL("build/halfstep mesh info nowhere.obj"), "\033[31mhalfstep:\033[0m");
    expect_colours(false, TERMINAL("NO_COLOR=1 build/halfstep rnu"));
    expect_colours(false, "build/halfstep rnu");
}

/* --- Progress -----------------------------------------------------------------------------------
 */

static void a_progress_line_tells_rate_and_rest(void **state) {
    (void)state;
    const char *said = run_line(TERMINAL("build/halfstep run shape:hand --engine golden,model "
                                         "--orbit 3"))
                           ->text;
    const char *line = strstr(said, "2 of 3 views, ");
    if (!line) fail_msg("no line of the third view in\n%s", said);
    assert_non_null(strstr(line, " a second, "));
    assert_non_null(strstr(line, " s left"));
    const char *space = TERMINAL("build/halfstep explore shape:hand --set banks=2,4,8 --out @/e");
    expect_line(0, space, " of 3 points, ");
    assert_null(strstr(run_line(TERMINAL("build/halfstep run shape:hand --engine golden "
                                         "--orbit 3 --quiet"))
                           ->text,
                       " of 3 views"));
    assert_null(strstr(run_line("build/halfstep run shape:hand --engine golden --orbit 3")->text,
                       " of 3 views"));
}

/* --- Lines that fit -----------------------------------------------------------------------------
 */

/* awk prints the lines that are too long, and fails if there was no line at all. */
#define FITS " | awk 'length > 80 { print \"TOO LONG: \" $0 } END { exit NR == 0 }'"
#define EVERY_HELP                                                                                 \
    "for c in $(build/halfstep completion bash | sed -n \"s/.*compgen -W '\\([a-z ]*\\) "          \
    "--help --version.*/\\1/p\"); do "                                                             \
    "build/halfstep $c --help; for p in $(build/halfstep $c --help | "                             \
    "sed -n \"s/^  halfstep $c \\([a-z]*\\) .*/\\1/p\"); do build/halfstep $c $p --help; done; "   \
    "done"

static void expect_fit(const char *line) {
    const outcome *o = run_line(line);
    if (o->code != 0 || strstr(o->text, "TOO LONG"))
        fail_msg("%s\nended with %d:\n%.3000s", line, o->code, o->text);
}

static void tables_and_help_fit_80_columns(void **state) {
    (void)state;
    expect_fit("build/halfstep run shape:hand --engine reference,golden,model --orbit 2" FITS);
    expect_fit("build/halfstep run shape:cube --boundary edge-only --limit --min-edge-px 4 "
               "--size 1024x1024 --engine reference,golden,model,rtl" FITS);
    expect_fit("build/halfstep run shape:hand --uniform 9 --engine golden,model "
               "--max-vertices 70000" FITS);
    expect_fit("build/halfstep run shape:random:5000 --max-vertices 100 --engine golden" FITS);
    expect_fit("build/halfstep mesh info shape:random:20000 shape:die:4 shape:spoon" FITS);
    expect_fit("build/halfstep mesh list" FITS);
    expect_fit("build/halfstep trace check refused-packets torus-stalls" FITS);
    expect_fit("build/halfstep explore shape:cube --set banks=2,4 --set window=2,4 --set lanes=2 "
               "--clock 800 --out @/some" FITS);
    expect_fit("build/halfstep explore shape:cube --set port=4 --set banks=2,4 --set window=2 "
               "--set lanes=2 --set latency=2 --set ops=64 --set views=1 --set parity=0,1 "
               "--clock 800 --out @/all" FITS);
    expect_fit("build/halfstep --help" FITS);
    expect_fit("{ " EVERY_HELP "; }" FITS);
    assert_non_null(strstr(run_line(EVERY_HELP)->text, "halfstep trace build TEXT FILE"));
}

/* --- Completion and man page --------------------------------------------------------------------
 */

/* A program's own completion, asked as bash asks it. words are the line's, the last one is begun.
 */
static const char *complete(const char *words) {
    static char line[1000];
    snprintf(line, sizeof line,
             "bash -c 'shopt -s extglob; . <(build/halfstep completion bash); COMP_WORDS=(%s); "
             "COMP_CWORD=$((${#COMP_WORDS[*]} - 1)); _halfstep 2>/dev/null; "
             "echo \" ${COMPREPLY[*]} \"'",
             words);
    return run_line(line)->text;
}

static void expect_completion(const char *words, const char *wanted) {
    char word[60];
    snprintf(word, sizeof word, " %s ", wanted);
    if (!strstr(complete(words), word))
        fail_msg("halfstep %s: no \"%s\" among\n%s", words, wanted, complete(words));
}

/* Calls what with every option that a command's help has, and gives how many there were. */
static int each_option(const char *command, void (*what)(const char *command, const char *option)) {
    char line[200], option[60], help[20000];
    int count = 0, used;
    snprintf(line, sizeof line, "build/halfstep %s --help", command);
    snprintf(help, sizeof help, "%.19999s", run_line(line)->text);
    for (const char *row = help; row; row = strchr(row, '\n')) {
        row += *row == '\n';
        if (strncmp(row, "      --", 8) != 0 &&
            !(strncmp(row, "  -", 3) == 0 && strncmp(row + 4, ", --", 4) == 0))
            continue;
        if (sscanf(row + 6, "%59[a-z-]%n", option, &used) != 1) continue;
        what(command, option);
        count++;
    }
    return count;
}

/* Every command that the program's help lists, and every part of them. */
static int each_command(void (*what)(const char *command, const char *option)) {
    char help[20000], parts[20000], name[40], part[40], line[200];
    int options = 0;
    snprintf(help, sizeof help, "%.19999s", run_line("build/halfstep --help")->text);
    const char *row = strstr(help, "options]\n\n");
    assert_non_null(row);
    for (row += strlen("options]\n\n"); *row != '\n'; row = strchr(row, '\n') + 1) {
        if (sscanf(row, "  %39[a-z]", name) != 1) continue;
        what(name, NULL);
        snprintf(line, sizeof line, "build/halfstep %s --help", name);
        snprintf(parts, sizeof parts, "%.19999s", run_line(line)->text);
        if (strncmp(parts, "  halfstep ", 11) != 0) {
            options += each_option(name, what);
            continue;
        }
        for (const char *p = parts; p && *p; p = strchr(p, '\n') ? strchr(p, '\n') + 1 : NULL) {
            char whole[90];
            if (sscanf(p, "  halfstep %*s %39[a-z]", part) != 1) continue;
            snprintf(whole, sizeof whole, "%s %s", name, part);
            expect_completion(name[0] == 'm' ? "halfstep mesh \"\"" : "halfstep trace \"\"", part);
            options += each_option(whole, what);
        }
    }
    return options;
}

static void is_completed(const char *command, const char *option) {
    static char words[200], known[3000];
    char now[200], name[70];
    if (!option) {
        expect_completion("halfstep \"\"", command);
        return;
    }
    snprintf(now, sizeof now, "halfstep %s --", command);
    if (strcmp(now, words) != 0) { /* asked once for all its options */
        memcpy(words, now, sizeof words);
        snprintf(known, sizeof known, "%.2999s", complete(words));
    }
    snprintf(name, sizeof name, " %s ", option);
    if (!strstr(known, name)) fail_msg("%s: no \"%s\" among\n%s", words, option, known);
}

static void completion_has_every_command_and_option(void **state) {
    (void)state;
    const int options = each_command(is_completed);
    print_message("%d options\n", options);
    assert_true(options > 100);
}

static void completion_knows_values_files_and_shapes(void **state) {
    (void)state;
    expect_completion("halfstep run --guard \"\"", "0 1");
    expect_completion("halfstep completion \"\"", "bash zsh");
    expect_completion("halfstep run --views READ", "README.md");
    expect_completion("halfstep run shape : ha", "hand");
    expect_completion("halfstep run sh", "shape:");
    expect_completion("halfstep run README", "README.md");
    assert_string_equal(complete("halfstep run --front \"\""), "  \n");
    expect_line(2, "build/halfstep completion fish", "there are bash and zsh");
}

/* zsh's is made by the same walk; its syntax is zsh's to judge. */
static char zsh_text[30000];

static void is_in_zsh(const char *command, const char *option) {
    if (option && !strstr(zsh_text, option))
        fail_msg("zsh does not know halfstep %s %s", command, option);
}

static void zsh_has_every_option(void **state) {
    (void)state;
    snprintf(zsh_text, sizeof zsh_text, "%.29999s",
             run_line("build/halfstep completion zsh")->text);
    assert_true(each_command(is_in_zsh) > 100);
    if (run_line("command -v zsh")->code != 0) {
        print_message("zsh is missing: its syntax is not looked at\n");
        return;
    }
    expect_line(0, "build/halfstep completion zsh >@/z && zsh -n @/z && echo good", "good");
}

static char man_text[200000];

static void is_in_man(const char *command, const char *option) {
    char text[200];
    size_t used = 0;
    snprintf(text, sizeof text, ".SS halfstep %s", command);
    const char *section = strstr(man_text, text);
    if (!option || strcmp(option, "--help") == 0) return; /* said once, on top */
    if (!section) fail_msg("no section of the man page is about halfstep %s", command);
    for (const char *c = option; *c; c++)
        used += (size_t)snprintf(text + used, sizeof text - used, *c == '-' ? "\\-" : "%c", *c);
    if (!strstr(section, text)) fail_msg("man: no %s of halfstep %s", option, command);
}

static void the_man_page_has_every_command_and_option(void **state) {
    (void)state;
    FILE *pipe = popen("build/halfstep man", "r");
    assert_non_null(pipe);
    man_text[fread(man_text, 1, sizeof man_text - 1, pipe)] = 0;
    assert_int_equal(pclose(pipe), 0);
    assert_true(each_command(is_in_man) > 100);
    if (run_line("command -v groff")->code != 0) {
        print_message("groff is missing: the page is not set\n");
        return;
    }
    assert_string_equal(
        run_line("build/halfstep man | groff -man -Tutf8 -ww 2>&1 >/dev/null")->text, "");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)
    const struct CMUnitTest tests[] = {
        TEST(colours_are_for_terminals_that_want_them),
        TEST(errors_are_coloured_alike),
        TEST(a_progress_line_tells_rate_and_rest),
        TEST(tables_and_help_fit_80_columns),
        TEST(completion_has_every_command_and_option),
        TEST(completion_knows_values_files_and_shapes),
        TEST(zsh_has_every_option),
        TEST(the_man_page_has_every_command_and_option),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
