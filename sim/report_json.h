/* SPDX-License-Identifier: Apache-2.0
 *
 * The report of a run as JSON; docs/command-line.md lists its keys.
 */
#ifndef HS_REPORT_JSON_H
#define HS_REPORT_JSON_H

#include "run.h"

/* Writes the report to run->request->json, whole or not at all. */
bool hs_report_write(const hs_run *run, hs_error *err);

#endif
