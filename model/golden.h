/* SPDX-License-Identifier: Apache-2.0
 *
 * The golden model: the refinement of docs/refinement.md in the integer arithmetic of
 * docs/arithmetic.md, on flat arrays, untimed. Input packet in, output packet out, word for word
 * what the RTL sends. Each stage is a file of its own, named as the RTL module that it stands for.
 */
#ifndef HS_GOLDEN_H
#define HS_GOLDEN_H

#include "stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Capacities; a view that exceeds them is refused or stops early, as in the RTL. */
typedef struct hs_limits {
    uint32_t vertices; /* at most 2^24 */
    uint32_t quads;    /* active quads, and corners of the initial mesh; at most 2^24 */
} hs_limits;

/* The RTL's default capacities. */
#define HS_DEFAULT_LIMITS ((hs_limits){524288, 524288})

/* What happened in one generation. */
typedef struct hs_generation {
    uint32_t active;   /* faces that may still change */
    uint32_t corners;  /* their corners: 3 or 4 a face, but for generation 0 */
    uint32_t boundary; /* sides of active faces on the surface's boundary, unless they are kept */
    uint32_t selected; /* faces that the view wants refined */
    uint32_t refined;  /* faces that were refined: the selected ones and, with guard, their ring */
    uint32_t final;    /* faces that left the pipeline in this generation */
    uint32_t moved;    /* vertices that moved (odd steps only) */
    uint32_t vertices; /* vertices at the generation's start, dead and alive */
} hs_generation;

/* Everything known of one view's run. The pointers belong to the golden context and hold until
 * its next run. */
typedef struct hs_golden_report {
    uint32_t status, error_position;
    int32_t exponent;
    uint32_t generations; /* entries of generation: the last one reached, plus one */
    const hs_generation *generation;
    uint32_t vertices, faces, triangles; /* sent */
    uint32_t at_level; /* with settings.limit: vertices sent where their level has them */
    /* Per generation g, face by face of its active mesh in order: bit 0 selected, bit 1 refined.
     * decision[g] has generation[g].active bytes. For the reference, which replays it. */
    const uint8_t *const *decision;
} hs_golden_report;

typedef struct hs_golden hs_golden;

/* A context with room for the limits; memory grows with use. NULL if memory is exhausted or a
 * limit is above 2^24. */
hs_golden *hs_golden_new(hs_limits limits);
void hs_golden_free(hs_golden *golden);

/* Bytes that the context holds. */
size_t hs_golden_bytes(const hs_golden *golden);

/* Runs one view. Hostile packets are fine: they give an output packet with an error status. The
 * result depends on this packet and the limits alone. False only when memory is exhausted. */
bool hs_golden_run(hs_golden *golden, const hs_packet *in, hs_packet *out, hs_golden_report *report,
                   hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
