/* SPDX-License-Identifier: Apache-2.0
 *
 * From a case that fails to the smallest one that fails in the same way, and from that to a trace.
 */
#ifndef HS_TESTS_CAMPAIGN_SHRINK_H
#define HS_TESTS_CAMPAIGN_SHRINK_H

#include "campaign_check.h"

/* Checks a case (checker_check). True as well if its faces are no mesh. */
bool campaign_check(checker *c, const campaign_case *which);

/* Makes *which, which has just failed the check, smaller as long as the same check fails: drops the
 * fault, stalls, limits, settings, tags, faces, vertices; lowers depths; simplifies coordinates and
 * the view. Stops after so many seconds of processor time, at what it has then. Gives how many
 * cases it tried; what the last one that failed said is in c->failed and c->text. */
uint32_t campaign_shrink(checker *c, campaign_case *which, uint32_t seconds);

/* Writes a case as a trace, mesh included: trace.txt, mesh.obj and input.hss in the folder, which
 * is made. why: a line for the head of trace.txt. */
bool campaign_write(const campaign_case *which, const char *folder, const char *why, hs_error *err);

/* Checks every packet of a trace's folder. False, with c->text, at the first that fails, or with
 * *err, if there is no trace. */
bool campaign_replay(checker *c, const char *folder, hs_error *err);

#endif
