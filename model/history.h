/* SPDX-License-Identifier: Apache-2.0
 *
 * Everything that golden knew and decided in one view, generation by generation, and which face of
 * the output each active face became: for those who ask why. Nothing here decides: an observer of
 * the run copies the marks, terms, decisions and children that golden's stages left, and
 * hs_history_record has the result checked against the output packet, face by face.
 *
 *   hs_golden_run -- hs_observer --> hs_history: generation g: face f -- half-edge h --> child
 *                                                           |                              |
 *                                                           '--> output                    '--> ...
 */
#ifndef HS_HISTORY_H
#define HS_HISTORY_H

#include "golden.h"
#include "select.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HS_HISTORY_NONE = 0xffffffff };

/* The active mesh of one generation. Half-edges of face f are first[f] .. first[f] + sides[f] - 1,
 * numbered as in golden_state.h. */
typedef struct hs_past {
    uint32_t faces, halfedges, vertices;
    /* False for generation D where the faces of the last step leave at once: they were never
     * looked at, and have parents, corners and a place in the output alone. */
    bool decided;
    bool finish;  /* all faces leave, whatever was selected */
    bool stopped; /* ... because a capacity would have been exceeded */
    uint32_t selected, refined;
    uint32_t *first;       /* faces */
    uint8_t *sides;        /* faces */
    uint32_t *origin;      /* halfedges: the vertex that it leaves, by its number in the pipeline */
    uint32_t *twin;        /* halfedges: HS_BORDER, BOUNDARY_TWIN, or a half-edge */
    uint32_t *child;       /* halfedges of refined faces: its first child in the next generation, or
                              HS_BORDER (the edge is kept), or BOUNDARY_TWIN */
    uint32_t *parent;      /* faces: the lower half-edge, in the generation before, that it was made
                              of; NONE in generation 0 */
    uint32_t (*within)[2]; /* faces: the initial faces that it lies in: in odd generations that of
                              its first two corners and that of its last two; else twice the same */
    uint16_t *term;        /* faces: hs_terms */
    uint8_t *face_mark, *decision, *forced; /* faces: as in hs_state */
    uint32_t *number;                       /* faces: the new vertex, if it is refined */
    uint8_t *mark;                          /* vertices, as behind guard */
    uint8_t *free;      /* vertices of active faces: 1 if all around goes on, hs_is_free */
    uint32_t *output;   /* faces: its place in the output; NONE if it was refined */
    uint32_t *triangle; /* halfedges: place in the output of the triangle at its kept edge; NONE */
} hs_past;

/* Where a face of the output comes from. */
typedef struct hs_origin {
    uint8_t generation; /* of the active face */
    uint32_t face;      /* the active face */
    uint32_t halfedge;  /* NONE: it is that face; else the triangle at this kept edge of it */
} hs_origin;

typedef struct hs_history {
    hs_settings settings;
    uint32_t depth; /* the generation at which everything is final */
    uint32_t status;
    uint32_t generations; /* the last one reached, plus one */
    hs_past past[HS_MAX_DEPTH + 2];
    uint32_t outputs;
    hs_origin *origin; /* per face of the output */
    uint32_t sent;     /* faces that have left so far, while the run goes on */
    bool exhausted;
} hs_history;

/* Has the next run of golden recorded: *history, which must be empty, fills. The context must not
 * outlive it but for hs_golden_observe(golden, NULL). */
void hs_history_watch(hs_history *history, hs_golden *golden);

/* Checks the record of a run that was accepted against what came out, and completes it. False:
 * memory, or a record that is not what came out, which would be a defect (HS_EXIT_INTERNAL). */
bool hs_history_check(hs_history *history, const hs_output *output, hs_error *err);

/* Runs a mesh through golden for a view and records it; *output is what came out. Nothing either
 * held is freed. False, with both empty: the pipeline refuses the view (HS_EXIT_REFUSED), memory,
 * or, which would be a defect, the record is not what came out (HS_EXIT_INTERNAL). */
bool hs_history_record(hs_history *history, hs_output *output, const hs_mesh *mesh,
                       const float matrix[16], const hs_settings *settings, hs_limits limits,
                       hs_error *err);

void hs_history_free(hs_history *history);

/* The one or two faces of the generation before that a face was made of (the same one twice: a
 * half-quad of one face). False in generation 0. */
bool hs_history_parents(const hs_history *history, uint32_t generation, uint32_t face,
                        uint32_t parent[2]);

/* The face of a half-edge. */
uint32_t hs_history_face_of(const hs_history *history, uint32_t generation, uint32_t halfedge);

#ifdef __cplusplus
}
#endif
#endif
