/* SPDX-License-Identifier: Apache-2.0
 *
 * Catmull-Clark refinement, directly: level by level, with face, edge and vertex points, in
 * golden's integers, each point one exact rational rounded once. It is there for invariant I4: two
 * steps of golden equal one level of this, bit for bit. It shares no code with golden's stages.
 *
 *   face point    RNE(sum of the face's vertices / n)
 *   edge point    RNE((v + w + F + G) / 4); sharp: RNE((v + w) / 2)
 *   vertex point  RNE((sum of the n neighbours w, and of the n face points F, + n(n-2) v) / n^2);
 *                 with two sharp edges, to a and b: RNE((a + 6v + b) / 8); with more, or if the
 *                 vertex itself is sharp: v
 *
 * Sharpness is what is left of it, and loses one with each level (Hoppe et al. 1994, DeRose, Kass
 * and Truong 1998, with whole numbers). Edges on the boundary are sharp for ever.
 *
 *         E'---- w       half-edge h: v -> w, its edge's point E, its face's point F, the point E'
 *         |      |       of prev(h)'s edge. The corner of v becomes the quad (v, E, F, E'), with
 *    F    |  f   E       half-edges 4h to 4h+3:
 *     ` .  |     |
 *         E'---- v         twin(4h)   = 4 next(twin(h)) + 3     twin(4h+2) = 4 prev(h) + 1
 *                          twin(4h+1) = 4 next(h) + 2           twin(4h+3) = 4 twin(prev(h))
 */
#ifndef HS_CATMULL_CLARK_H
#define HS_CATMULL_CLARK_H

#include "error.h"
#include "mesh.h"
#include "stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A surface at some level. Half-edges as in mesh.h. */
typedef struct hs_catmull_clark {
    uint32_t level;
    uint32_t vertices, faces, halfedges;
    int32_t (*position)[4]; /* x, y, z, w: S1.30 of the view's block */
    uint32_t *first;        /* faces + 1 */
    uint32_t *origin, *twin, *face;
    uint8_t *edge_sharpness;   /* halfedges: levels for which the edge is sharp from here on */
    uint8_t *vertex_sharpness; /* vertices */
} hs_catmull_clark;

/* Level 0: a mesh with its sharpness, and positions as quantize leaves them, |component| < 2^30.
 * In the mode `smooth` boundary vertices with one face only are sharp for ever. False, and *surface
 * empty, if the mesh has a boundary that is to be kept, which Catmull-Clark does not know
 * (HS_EXIT_MESH), or memory is exhausted. */
bool hs_catmull_clark_new(hs_catmull_clark *surface, const hs_mesh *mesh,
                          const int32_t (*position)[4], hs_boundary boundary, hs_error *err);

/* Replaces a level by the next one. Vertices are numbered: those of the level before, its face
 * points, its edge points in the order of their lower half-edges; level 1 has thereby the numbers
 * that two steps give. Faces lie in the order of the corners that they come from. False when memory
 * is exhausted or a number would exceed 32 bits; *surface is then as it was. */
bool hs_catmull_clark_refine(hs_catmull_clark *surface, hs_error *err);

/* Frees the arrays and empties *surface; an empty (zeroed) one may be freed. */
void hs_catmull_clark_free(hs_catmull_clark *surface);

#ifdef __cplusplus
}
#endif
#endif
