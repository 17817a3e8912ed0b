/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep explain in parts: why golden refined a face, or did not. The facts are those of a
 * hs_history; here they become words, a table and JSON.
 *
 *   face, output face or pixel -> hs_subject -> hs_ancestors -> text, JSON
 */
#ifndef HS_EXPLAIN_H
#define HS_EXPLAIN_H

#include <stdio.h>

#include "history.h"

/* What was asked about: an active face of a generation, or the triangle at a kept edge of it. */
typedef struct hs_subject {
    char asked[80]; /* in the words of the command line */
    uint32_t generation, face;
    uint32_t halfedge; /* of the triangle's edge; HS_HISTORY_NONE: it is the face itself */
    uint32_t output;   /* its place in the output; HS_HISTORY_NONE: it was refined */
} hs_subject;

/* What became of an active face. */
typedef enum hs_outcome {
    HS_OUTCOME_SELECTED, /* the view, a forced depth or a uniform run wanted it: refined */
    HS_OUTCOME_GUARD,    /* refined, as a corner of it is a corner of a selected face */
    HS_OUTCOME_FINAL,    /* it left as it is */
    HS_OUTCOME_STOPPED,  /* it left as it is, because a capacity would have been exceeded */
    HS_OUTCOME_LAST      /* it left as it was made, by the last step */
} hs_outcome;
const char *hs_outcome_name(hs_outcome outcome);
hs_outcome hs_outcome_of(const hs_history *history, uint32_t generation, uint32_t face);

/* "front", "back" or "both": the signs that the face's corners have. "-": not looked at. */
const char *hs_facing_of(const hs_history *history, uint32_t generation, uint32_t face);

/* How many of its vertices are silhouette vertices. */
uint32_t hs_silhouette_vertices(const hs_history *history, uint32_t generation, uint32_t face);

/* A corner of a face on the guard ring, and the selected face that it is a corner of too. False if
 * there is none. */
bool hs_guard_witness(const hs_history *history, uint32_t generation, uint32_t face,
                      uint32_t *vertex, uint32_t *selected);

/* Why a face was selected, or was not, as in "back-facing, no silhouette vertex": of its terms
 * alone, so that faces can be counted by it. */
void hs_explain_terms(const hs_history *history, uint32_t generation, uint32_t face, char *text,
                      size_t size);

/* All of it, as in "guard ring: vertex 12 is a corner of selected face 9; itself not selected:
 * ...". */
void hs_explain_why(const hs_history *history, uint32_t generation, uint32_t face, char *text,
                    size_t size);

/* How the half-edge rule made it, as in "quad of edge 4-7 between faces 1 and 2". "initial face"
 * in generation 0. */
void hs_explain_rule(const hs_history *history, uint32_t generation, uint32_t face, char *text,
                     size_t size);

/* The faces that a face comes from, itself included, generation by generation, in their order. */
typedef struct hs_ancestors {
    uint32_t count[HS_MAX_DEPTH + 2];
    uint32_t *face[HS_MAX_DEPTH + 2];
    uint32_t line[HS_MAX_DEPTH + 2]; /* the one of them that it lies in; of two, the first */
} hs_ancestors;
bool hs_ancestors_find(hs_ancestors *ancestors, const hs_history *history, uint32_t generation,
                       uint32_t face, hs_error *err);
void hs_ancestors_free(hs_ancestors *ancestors);

/* Of the faces of a generation that lie in an initial face, wholly or by half. */
typedef struct hs_inside {
    uint32_t faces, selected, guard, final, triangles;
} hs_inside;
hs_inside hs_inside_of(const hs_history *history, uint32_t generation, uint32_t initial);
bool hs_lies_in(const hs_history *history, uint32_t generation, uint32_t face, uint32_t initial);

/* Those of them that were not selected, by their reason. */
typedef struct hs_reason {
    uint32_t count, face; /* how many, the first of them */
} hs_reason;
enum { HS_REASONS_MOST = 64 };
uint32_t hs_reasons_of(const hs_history *history, uint32_t generation, uint32_t initial,
                       hs_reason reason[HS_REASONS_MOST]);

/* The explanation on a stream, at most 80 columns wide; mesh and view are for its title. */
bool hs_explain_print(FILE *stream, const hs_history *history, const hs_subject *subject,
                      const char *mesh, uint32_t view, hs_error *err);

/* The same as JSON, with all ancestors (docs/command-line.md). "-" is standard output. */
bool hs_explain_write(const char *path, const hs_history *history, const hs_subject *subject,
                      const char *mesh, uint32_t view, hs_error *err);

#endif
