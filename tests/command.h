/* SPDX-License-Identifier: Apache-2.0
 *
 * Commands as children of a test: what they say, how they end, what they need.
 */
#ifndef HS_TEST_COMMAND_H
#define HS_TEST_COMMAND_H

#include "place.h"

#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

typedef struct outcome {
    int code;         /* exit status; -SIGNAL if it was killed */
    long kilobytes;   /* of memory at most */
    char text[30000]; /* both streams */
} outcome;

/* Starts a shell's line, the output to a file in the test's folder. @ stands for that folder, ~ for
 * the project's. The child is its own group's leader, so that a signal reaches all of it. */
static inline pid_t start_line(const char *line, const char *said) {
    static char root[PATH_MAX];
    if (!root[0]) assert_non_null(getcwd(root, sizeof root));
    char text[8000] = "";
    size_t at = 0;
    for (const char *c = line; *c && at < sizeof text - PATH_MAX; c++)
        at += (size_t)snprintf(text + at, sizeof text - at, *c == '@' || *c == '~' ? "%s" : "%.1s",
                               *c == '@'   ? place.path
                               : *c == '~' ? root
                                           : c);
    /* Here, since the child may be killed before it does anything. */
    const int output = open(said, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    assert_true(output >= 0);
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        setpgid(0, 0);
        dup2(output, STDOUT_FILENO);
        dup2(output, STDERR_FILENO);
        execl("/bin/sh", "sh", "-c", text, (char *)NULL);
        _exit(126);
    }
    close(output);
    setpgid(child, child);
    return child;
}

static inline void end_line(pid_t child, const char *said, outcome *o) {
    int status;
    struct rusage usage;
    assert_int_equal(wait4(child, &status, 0, &usage), child);
    o->code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    o->kilobytes = usage.ru_maxrss;
    FILE *file = fopen(said, "rb");
    assert_non_null(file);
    o->text[fread(o->text, 1, sizeof o->text - 1, file)] = 0;
    fclose(file);
}

/* Runs a line to its end; the result stays until the next one. */
static inline outcome *run_line(const char *line) {
    static outcome o;
    char said[100];
    snprintf(said, sizeof said, "%s.said", place.path);
    end_line(start_line(line, said), said, &o);
    unlink(said);
    return &o;
}

static inline void expect_line(int code, const char *line, const char *text) {
    const outcome *o = run_line(line);
    if (o->code != code || !strstr(o->text, text))
        fail_msg("%s\nended with %d instead of %d, or without \"%s\":\n%.3000s", line, o->code,
                 code, text, o->text);
}

static inline double seconds_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
