/* SPDX-License-Identifier: Apache-2.0
 *
 * One line on stderr that says how far long work is. It shows on terminals alone, and not more
 * than ten times a second.
 */
#ifndef HS_PROGRESS_H
#define HS_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct hs_progress {
    bool on;
    bool shown;    /* a line stands on the terminal */
    double start;  /* of the work, in seconds */
    double latest; /* when it was written, in seconds */
} hs_progress;

/* Starts; nothing is shown if quiet, or if stderr is no terminal. */
void hs_progress_start(hs_progress *progress, bool quiet);

/* Replaces the line. */
void hs_progress_show(hs_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Replaces the line by how much is done, at what rate, and how long the rest will take at it:
 * "3 of 8 views, 1.5 a second, 3 s left". fresh of the done were done since the start. */
void hs_progress_count(hs_progress *progress, uint64_t done, uint64_t fresh, uint64_t all,
                       const char *things);

/* Takes the line away: before anything else is printed, and at the end. */
void hs_progress_clear(hs_progress *progress);

/* Seconds of a clock that never jumps. */
double hs_seconds(void);

#endif
