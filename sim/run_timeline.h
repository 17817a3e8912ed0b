/* SPDX-License-Identifier: Apache-2.0
 *
 * The timelines that a run writes: --timeline, --kanata, --timeline-svg. Of the engines that have a
 * clock it is the rtl's, or without it the model's: where their logs are equal, so are the files.
 */
#ifndef HS_RUN_TIMELINE_H
#define HS_RUN_TIMELINE_H

#include "run.h"

/* Whether any was asked for. */
bool hs_run_timelines_wanted(const hs_run_request *request);

/* Begins the files. They appear with hs_run_timelines_end alone, whole. */
bool hs_run_timelines_begin(hs_run *run, hs_error *err);

/* Writes a view. log and cycles are one engine's; status is that of the view's trailer. */
bool hs_run_timelines_view(hs_run *run, uint32_t number, uint32_t status, const hs_log *log,
                           const hs_cycle_report *cycles, hs_error *err);

/* Ends the files, or gives them up. */
bool hs_run_timelines_end(hs_run *run, hs_error *err);
void hs_run_timelines_abandon(hs_run *run);

#endif
