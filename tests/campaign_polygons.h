/* SPDX-License-Identifier: Apache-2.0
 *
 * Meshes that the campaign makes and cuts down: plain lists of faces, with their tags and forced
 * depths, which are changed piece by piece and become half-edges when they are done. Of fixed size,
 * so that a copy is an assignment. All are small: what does not fit is refused.
 */
#ifndef HS_TESTS_CAMPAIGN_POLYGONS_H
#define HS_TESTS_CAMPAIGN_POLYGONS_H

#include "mesh.h"

enum {
    POLYGONS_VERTICES = 1024,
    POLYGONS_FACES = 1024,
    POLYGONS_CORNERS = 4096,
    POLYGONS_TAGS = 2048
};

typedef struct polygons {
    uint32_t vertices, faces, corners, tags;
    float position[POLYGONS_VERTICES][4];
    uint32_t sides[POLYGONS_FACES];
    uint8_t forced[POLYGONS_FACES];
    uint32_t corner[POLYGONS_CORNERS]; /* the faces' vertices, one face behind the other */
    hs_sharp_tag tag[POLYGONS_TAGS];
} polygons;

/* Takes over a mesh; false if it is too large. */
bool polygons_of_mesh(polygons *p, const hs_mesh *mesh);

/* Builds the half-edges. False, and *mesh empty, if the faces are no mesh (hs_mesh_build). */
bool polygons_build(const polygons *p, hs_mesh *mesh, hs_error *err);

/* Whether polygons_build would succeed. */
bool polygons_good(const polygons *p);

/* Place of a face's first corner. */
uint32_t polygons_first(const polygons *p, uint32_t face);

/* Each of these changes *p, in O(its size), and returns true; or, if the result would be no mesh or
 * too large, leaves it as it was and returns false. */
bool polygons_poke(polygons *p, uint32_t face, float height); /* a triangle at every side */
bool polygons_split(polygons *p, uint32_t face, uint32_t i, uint32_t j); /* by a diagonal */
bool polygons_merge(polygons *p, uint32_t face, uint32_t side);          /* with the face beyond */
bool polygons_cut_edge(polygons *p, uint32_t face, uint32_t side);       /* by a new vertex */
bool polygons_extrude(polygons *p, uint32_t face, float height); /* away, with quads around */
bool polygons_append(polygons *p, const polygons *other, const float offset[3]);
bool polygons_keep(polygons *p, const bool *keep); /* faces: those that are false go */
/* Vertices, out of their faces; what has fewer than three goes. */
bool polygons_drop_vertices(polygons *p, uint32_t first, uint32_t count);
bool polygons_collapse(polygons *p, uint32_t v, uint32_t w); /* v becomes w; lunes go */

#endif
