/* SPDX-License-Identifier: Apache-2.0
 *
 * What a mesh is like: counts, sides, valences, boundary, topology, extent.
 */
#ifndef HS_MESH_INFO_H
#define HS_MESH_INFO_H

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HS_INFO_BINS = 256 }; /* sides and valences are at most 255 */

typedef struct hs_mesh_info {
    uint32_t vertices, faces, edges;
    uint32_t sides[HS_INFO_BINS];   /* faces, by their number of sides */
    uint32_t valence[HS_INFO_BINS]; /* vertices, by their number of faces */
    /* Those of valence[] that lie on the boundary. An interior vertex has as many edges as faces,
     * one on the boundary has one edge more. */
    uint32_t boundary_valence[HS_INFO_BINS];
    uint32_t boundary_edges, boundary_loops;
    /* Sharp edges and vertices, by their sharpness. Boundary edges count where they are tagged. */
    uint32_t creases[HS_SHARP_INFINITE + 1], corners[HS_SHARP_INFINITE + 1];
    uint32_t components;         /* parts that no edge connects */
    int32_t euler;               /* vertices - edges + faces */
    float lowest[4], highest[4]; /* bounding box of x, y, z and w as they are, not divided by w */
} hs_mesh_info;

/* Measures a mesh that hs_mesh_build made; an empty mesh gives zeroes. False only when memory is
 * exhausted (HS_EXIT_INTERNAL). Time O(half-edges). */
bool hs_mesh_measure(hs_mesh_info *info, const hs_mesh *mesh, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
