/* SPDX-License-Identifier: Apache-2.0
 *
 * Catmull-Clark refinement by an independent library, Pixar's OpenSubdiv (Debian: libosd-dev), in
 * plain arrays that C can read: for tests, and to have somebody to race against. A program that
 * uses it links build/tests/osd.o and -losdCPU.
 */
#ifndef HS_TESTS_OSD_H
#define HS_TESTS_OSD_H

#include <stdint.h>

#include "error.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { OSD_MAX_LEVELS = 10 };

/* What happens at a boundary: OpenSubdiv's VTX_BOUNDARY_... No difference on closed meshes. */
enum osd_boundary { OSD_BOUNDARY_NONE, OSD_BOUNDARY_EDGE_ONLY, OSD_BOUNDARY_EDGE_AND_CORNER };

/* One level, in OpenSubdiv's own numbers. The children are numbers of vertices in the next level;
 * the last level has neither edges nor children (NULL, edges 0). */
typedef struct osd_level {
    uint32_t vertices, edges, faces;
    double *position;       /* 4 per vertex */
    uint32_t *first;        /* faces + 1: where a face's corners begin */
    uint32_t *corner;       /* vertices */
    uint32_t *edge;         /* 2 per edge: its end vertices, any order */
    uint32_t *vertex_child; /* per vertex */
    uint32_t *edge_child;   /* per edge */
    uint32_t *face_child;   /* per face */
} osd_level;

typedef struct osd_surface {
    uint32_t levels; /* of refinement; level[0] is the mesh itself */
    osd_level level[OSD_MAX_LEVELS + 1];
    /* Of the last level, 4 per vertex: PrimvarRefinerReal<double>::Limit, the position and the two
     * tangents. */
    double *limit, *tangent1, *tangent2;
} osd_surface;

/* Refines a mesh uniformly, position by position in doubles (all four components alike), with its
 * sharp edges as creases and its sharp vertices as corners. matrix:
 * row-major, the positions become M p, evaluated in doubles; NULL leaves them as they are. False,
 * and *surface empty, if OpenSubdiv refuses the mesh, levels exceed OSD_MAX_LEVELS or memory is
 * exhausted. */
bool osd_refine(osd_surface *surface, const hs_mesh *mesh, const double matrix[16], uint32_t levels,
                enum osd_boundary boundary, hs_error *err);
void osd_free(osd_surface *surface);

/* What uniform refinement takes OpenSubdiv, on one thread, by the wall clock. */
typedef struct osd_timing {
    double topology;          /* seconds: RefineUniform; the base mesh's topology is made before */
    double position;          /* seconds: PrimvarRefiner, all levels, four floats a vertex */
    uint64_t faces, vertices; /* of the last level */
} osd_timing;

/* Times one refinement of a mesh to a level (1 to OSD_MAX_LEVELS), with the topology of the last
 * level reduced to its faces' vertices, as is OpenSubdiv's default and fastest. Allocation of the
 * position arrays is not counted. Repeat it and take the least. */
bool osd_time(osd_timing *timing, const hs_mesh *mesh, uint32_t levels, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
