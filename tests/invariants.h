/* SPDX-License-Identifier: Apache-2.0
 *
 * Checkers for the invariants of docs/refinement.md, on any mesh and view:
 *
 *   I1  the output is conforming                              invariant_conforming
 *   I2  every face around a vertex of a selected face is refined      } invariant_watch
 *   I3  such a vertex lies where uniform refinement puts it, bit for bit  }
 *   I4  two steps are one level of direct Catmull-Clark, bit for bit  invariant_same_surface
 *   I5  the output depends on the packet alone                invariant_poisoner
 *
 * They return false and say what is wrong in *err (HS_EXIT_DIFFERENT), and add to a counter what
 * they compared, so that a run that compared nothing can be told from one that passed.
 */
#ifndef HS_TESTS_INVARIANTS_H
#define HS_TESTS_INVARIANTS_H

#include "catmull_clark.h"
#include "golden_state.h"
#include "mesh.h"
#include "stream.h"

/* I1. Every directed edge occurs once; its opposite occurs too, unless the edge is on the boundary:
 * in the mode `kept` one of the initial mesh's boundary edges, all of which are still there; in the
 * others one of a chain of edges that leads from its first vertex to its second, and there are no
 * more than these chains. Adds the edges to *compared. */
bool invariant_conforming(const hs_output *output, const hs_mesh *mesh, hs_boundary boundary,
                          uint64_t *compared, hs_error *err);

/* What a uniform run of a view looked like, generation by generation: the yardstick for I2, I3. */
enum { UNIFORM_GENERATIONS = 9 };
typedef struct uniform_generation {
    uint32_t vertices, faces, halfedges;
    uint32_t *origin;       /* per half-edge */
    uint32_t *quad;         /* per half-edge: its child in the next generation, or HS_BORDER */
    uint32_t *first;        /* faces + 1 */
    int32_t (*position)[4]; /* per vertex */
    uint16_t *faces_around; /* per vertex: active faces */
} uniform_generation;
typedef struct uniform_record {
    uint32_t generations;
    uniform_generation generation[UNIFORM_GENERATIONS];
} uniform_record;

/* Records the uniform run with the boundary of these settings, all generations in which they may
 * refine. Replaces what *record, zeroed at first, held. */
bool uniform_record_make(uniform_record *record, hs_golden *golden, const hs_mesh *mesh,
                         const float matrix[16], const hs_settings *settings, hs_error *err);
void uniform_record_free(uniform_record *record);

/* Watches a run of the same view, guard on, and checks somewhat more than the invariants ask for:
 * I2 with the faces of the uniform run's active mesh, so that on a mesh with a boundary no vertex
 * needs to be exempt, and I3 at the vertices of the guard ring's faces, too. */
typedef struct invariant_watch {
    const uniform_record *uniform;
    uint32_t *vertex, *face, *next_face; /* the uniform run's numbers of this run's */
    size_t vertex_room, face_room;
    uint64_t rings, positions; /* vertices compared for I2, for I3 */
    bool good;                 /* false: error says what was wrong first */
    hs_error error;
} invariant_watch;

/* Begins to watch, with counters at 0; free the arrays at the end. The pointers of the observer
 * lead to *watch. */
hs_observer invariant_watch_begin(invariant_watch *watch, const uniform_record *uniform);
void invariant_watch_free(invariant_watch *watch);

/* I4. Two surfaces of quads are the same: the same number of faces, the same positions around each,
 * and vertices that correspond one to one. Adds the corners to *compared. */
bool invariant_same_surface(uint32_t faces, const int32_t (*position_a)[4],
                            const uint32_t *corner_a, const int32_t (*position_b)[4],
                            const uint32_t *corner_b, uint32_t vertices, uint64_t *compared,
                            hs_error *err);

/* I4, as a run goes: refines by Catmull-Clark, level by level, what a uniform run had at generation
 * 0, and compares at every even generation. Not for a boundary that is kept. */
typedef struct invariant_levels {
    const hs_mesh *mesh;
    hs_boundary boundary;
    hs_catmull_clark surface;
    uint64_t corners; /* compared */
    bool good;        /* false: error says what was wrong first */
    hs_error error;
} invariant_levels;

/* Begins to compare; free the surface at the end. The observer's pointers lead to *levels. */
hs_observer invariant_levels_begin(invariant_levels *levels, const hs_mesh *mesh,
                                   hs_boundary boundary);
void invariant_levels_free(invariant_levels *levels);

/* I5. An observer that overwrites, whenever a generation begins, everything in golden's memory that
 * the stages have not made for this generation. *poison, any number, should differ from run to run.
 */
hs_observer invariant_poisoner(uint8_t *poison);

#endif
