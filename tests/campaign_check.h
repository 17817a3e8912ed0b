/* SPDX-License-Identifier: Apache-2.0
 *
 * What must hold of one packet, whatever it is:
 *
 *   words         golden, RTL and model send the same ones
 *   transactions  RTL and model agree on each, cycle, item and payload, at every stage boundary
 *   counters      and on all counters
 *   row           and the same again of three packets one behind the other: it, its first half, and
 *                 it; of views of up to ROW_CYCLES
 *   rtl, golden, model    the engine broke down: a rule of a stream, an assertion, a hang
 *   status        what was spoiled is refused with the status that it was spoiled for
 *
 * and of one that is not refused:
 *
 *   output        the output decodes
 *   reference     the reference, which replays golden's decisions, has the same faces, and the same
 *                 positions within the documented bound
 *   I1 .. I5      the invariants (tests/invariants.h): I2, I3 of views with guard, I4 of uniform
 * runs
 */
#ifndef HS_TESTS_CAMPAIGN_CHECK_H
#define HS_TESTS_CAMPAIGN_CHECK_H

#include "campaign_case.h"
#include "invariants.h"
#include "rtl_samples.h"

enum { ROW_CYCLES = 10000 };

/* How much was compared. */
typedef struct tally {
    uint64_t cases, words, transactions, cycles, faces_in, faces_out;
    uint64_t rows, row_transactions, row_cycles;
    uint64_t edges, rings, positions, corners, poisoned; /* I1, I2, I3, I4, I5 */
    uint64_t reference_faces, reference_vertices;
    uint64_t decisions, decided_otherwise; /* of the reference, in doubles */
} tally;

typedef struct checker {
    bench *bench;
    hs_golden *other, *wide; /* looked into; with room for whatever a uniform run makes */
    uniform_record uniform;
    invariant_watch watch;
    hs_packet again;
    uint8_t poison;
    tally tally;
    /* Of the latest check: what did not hold, NULL if all did, and why. */
    const char *failed;
    char text[2400];
    uint32_t status;
    uint32_t generations, largest_generation; /* its last one; most active faces in one */
} checker;

/* RTL and all. *c need not be zeroed. */
void checker_begin(checker *c);
void checker_end(checker *c);

/* Runs everything on a packet. wanted: the status that it was spoiled for, or HS_STATUS_OK. True if
 * all holds. */
#define CHECK_ANY_STATUS UINT32_MAX
bool checker_check(checker *c, const hs_packet *packet, hs_limits limits, hs_stalls stalls,
                   uint32_t wanted);

/* The mesh of a packet that is not refused; belongs to the caller. */
void checker_mesh(hs_mesh *mesh, const hs_packet *packet);
hs_settings checker_settings(const hs_packet *packet);

#endif
