/* SPDX-License-Identifier: Apache-2.0
 *
 * What the files that make a timeline share: timeline.c (runs, waits, generations) and
 * timeline_fill.c (what waits where).
 */
#ifndef HS_TIMELINE_PARTS_H
#define HS_TIMELINE_PARTS_H

#include "timeline.h"

/* The transactions of a boundary that are of use: of a view that was refused, the data behind
 * receive are not. */
typedef struct hs_passed {
    const hs_transaction *t;
    size_t count;
} hs_passed;
hs_passed hs_timeline_passed(const hs_timeline *timeline, uint32_t probe);

/* The first of them from a cycle on. */
size_t hs_passed_from(hs_passed passed, uint64_t cycle);

/* How many of them are from one cycle up to another one; 0 if that is none. */
size_t hs_passed_between(hs_passed passed, uint64_t begin, uint64_t end);

/* Whether what guard decided in a generation came to nothing: the view stopped there. */
bool hs_timeline_stopped_in(const hs_timeline *timeline, uint32_t generation);

/* Adds the cycles of an interval to the buckets, and to a run unless it is NULL. */
void hs_timeline_spend(hs_timeline *timeline, hs_timeline_run *run, uint32_t stage,
                       enum hs_activity activity, uint64_t begin, uint64_t end);

/* Fills, what split sent and when, and emit's waits; behind the runs of the other stages. False if
 * memory is exhausted. */
bool hs_timeline_fill_all(hs_timeline *timeline);

/* Lists a wait; false if memory is exhausted. */
bool hs_timeline_wait_add(hs_timeline *timeline, uint32_t stage, enum hs_activity activity,
                          uint64_t begin, uint64_t end);

#endif
