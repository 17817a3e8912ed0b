/* SPDX-License-Identifier: Apache-2.0 */
#include "progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

double hs_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void hs_progress_start(hs_progress *progress, bool quiet) {
    *progress = (hs_progress){.on = !quiet && isatty(STDERR_FILENO), .start = hs_seconds()};
}

void hs_progress_show(hs_progress *progress, const char *format, ...) {
    if (!progress->on) return;
    const double now = hs_seconds();
    if (progress->shown && now - progress->latest < 0.1) return;
    char text[80];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fflush(stdout);
    fprintf(stderr, "\r%-79s\r%s", "", text);
    fflush(stderr);
    progress->shown = true;
    progress->latest = now;
}

void hs_progress_count(hs_progress *progress, uint64_t done, uint64_t fresh, uint64_t all,
                       const char *things) {
    const double seconds = hs_seconds() - progress->start;
    const double rate = seconds > 0 ? (double)fresh / seconds : 0;
    if (rate > 0)
        hs_progress_show(progress, "%llu of %llu %s, %.3g a second, %.0f s left",
                         (unsigned long long)done, (unsigned long long)all, things, rate,
                         (double)(all - done) / rate);
    else
        hs_progress_show(progress, "%llu of %llu %s", (unsigned long long)done,
                         (unsigned long long)all, things);
}

void hs_progress_clear(hs_progress *progress) {
    if (!progress->shown) return;
    fprintf(stderr, "\r%-79s\r", "");
    fflush(stderr);
    progress->shown = false;
}
