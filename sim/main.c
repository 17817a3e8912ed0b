/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep, the program: finds the command, runs it, prints its error, exits with its code.
 */
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "build_info.h"
#include "commands.h"
#include "definitions.h"
#include "file.h"
#include "machine.h"
#include "options.h"
#include "terminal.h"

static int run_completion(int argc, char **argv, hs_error *err);
static int run_man(int argc, char **argv, hs_error *err);

static const hs_part COMMANDS[] = {
    {"run", hs_command_run, "a mesh and viewpoints through the engines: compare, time, show"},
    {"explore", hs_command_explore, "cycles over a space of micro-architectures, by the model"},
    {"mesh", hs_command_mesh, "look at meshes, make built-in ones, write OBJ"},
    {"trace", hs_command_trace, "packets in files: make, check, show as text, build from text"},
    {"render", hs_command_render, "figures of meshes and streams, as PNG"},
    {"convert", hs_command_convert, "refined meshes for other programs: PLY, glTF, POV-Ray, OBJ"},
    {"explain", hs_command_explain, "why a face was refined in a view, or was not"},
    {"report", hs_command_report, "a run as one HTML file: tables, plots, meshes to turn"},
    {"completion", run_completion, "what completes all this in bash and zsh"},
    {"man", run_man, "the manual page"},
    {0},
};
enum { COMMAND_COUNT = sizeof COMMANDS / sizeof *COMMANDS - 1 };

static int run_completion(int argc, char **argv, hs_error *err) {
    return hs_command_completion(COMMANDS, argc, argv, err);
}

static int run_man(int argc, char **argv, hs_error *err) {
    return hs_command_man(COMMANDS, argc, argv, err);
}

static int fail_command(const char *word, hs_error *err) {
    const char *name[COMMAND_COUNT + 1] = {NULL};
    for (int i = 0; i < COMMAND_COUNT; i++)
        name[i] = COMMANDS[i].name;
    const char *nearest = hs_nearest(word, name);
    if (nearest)
        hs_fail(err, HS_EXIT_USAGE, "no command \"%.40s\"; did you mean \"%s\"?", word, nearest);
    else
        hs_fail(err, HS_EXIT_USAGE, "no command \"%.40s\"; `halfstep --help` lists them", word);
    return err->code;
}

static int run(int argc, char **argv, hs_error *err) {
    if (argc < 2) {
        hs_fail(err, HS_EXIT_USAGE, "which command? `halfstep --help` lists them");
        return err->code;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        strcmp(argv[1], "help") == 0) {
        hs_print_help(COMMANDS);
        return HS_EXIT_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("halfstep %s, stream format %d\n", HS_VERSION, HS_STREAM_VERSION);
        return HS_EXIT_OK;
    }
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(argv[1], COMMANDS[i].name) == 0) return COMMANDS[i].run(argc - 1, argv + 1, err);
    return fail_command(argv[1], err);
}

/* Leaves nothing half-done behind, and ends as the signal would have it. */
static void interrupted(int number) {
    hs_file_remove_all();
    signal(number, SIG_DFL);
    raise(number);
}

static void watch_signals(void) {
    static const int ends[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
        if (signal(ends[i], SIG_IGN) != SIG_IGN) signal(ends[i], interrupted);
}

int main(int argc, char **argv) {
    hs_error err = {0};
    watch_signals();
    if (argc > 0) hs_program.name = argv[0];
    hs_program.commit = HS_BUILD_COMMIT;
    hs_program.simulator = HS_BUILD_SIMULATOR;
    int code = run(argc, argv, &err);
    if (err.text[0]) hs_print_error(&err);
    /* A table that nobody could read is not done. */
    if ((fflush(stdout) != 0 || ferror(stdout)) && code == HS_EXIT_OK) {
        code = HS_EXIT_FILE;
        hs_fail(&err, code,
                "cannot write to standard output; make room, or send it to another place");
        hs_print_error(&err);
    }
    return code;
}
