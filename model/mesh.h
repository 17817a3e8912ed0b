/* SPDX-License-Identifier: Apache-2.0
 *
 * A polygon mesh as half-edges in flat arrays: an oriented 2-manifold, with or without boundary,
 * of faces with 3 to 255 sides and vertices of 1 to 255 faces. It is built, and checked, once per
 * mesh; nothing behind it ever searches for a twin.
 *
 * The half-edges of face f are first[f] .. first[f+1]-1, in the face's order. For half-edge h of f:
 *   origin[h]  the vertex that it leaves        face[h]  f
 *   next(h)    h+1, or first[f] for the last    twin[h]  the opposite half-edge, or HS_BORDER
 */
#ifndef HS_MESH_H
#define HS_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "definitions.h"
#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hs_mesh {
    uint32_t vertices, faces, halfedges;
    float *position;  /* 4 per vertex: x, y, z, w in object space, all finite */
    uint32_t *first;  /* faces + 1 */
    uint32_t *origin; /* halfedges */
    uint32_t *twin;   /* halfedges */
    uint32_t *face;   /* halfedges */
    uint8_t *forced; /* faces: refine to this depth whatever the view; 0 unless set by the caller */
    /* How sharp edges and vertices are: for how many Catmull-Clark levels, 0 (smooth) to
     * HS_MAX_SHARPNESS, or HS_SHARP_INFINITE. A boundary edge's own number is without meaning. */
    uint8_t *sharpness; /* halfedges: of the edge, so that twins have the same; NULL: all 0 */
    uint8_t *vertex_sharpness; /* vertices; NULL: all 0 */
} hs_mesh;

static inline uint32_t hs_next(const hs_mesh *m, uint32_t h) {
    uint32_t f = m->face[h];
    return h + 1 < m->first[f + 1] ? h + 1 : m->first[f];
}

static inline uint32_t hs_prev(const hs_mesh *m, uint32_t h) {
    uint32_t f = m->face[h];
    return h > m->first[f] ? h - 1 : m->first[f + 1] - 1;
}

static inline uint32_t hs_sides(const hs_mesh *m, uint32_t f) {
    return m->first[f + 1] - m->first[f];
}

/* A sharp edge, v-w in any direction, or, if w == v, a sharp vertex. */
typedef struct hs_sharp_tag {
    uint32_t v, w;   /* vertices of the soup, from 0 */
    float sharpness; /* Catmull-Clark levels; 10 and more: for ever */
    uint32_t line;   /* in the file, for messages; 0: unknown */
} hs_sharp_tag;

/* A face list to be made into a mesh. The arrays belong to the caller. */
typedef struct hs_soup {
    const char *name;      /* of the file or shape, for messages */
    uint32_t vertices;     /* how many */
    const float *position; /* 4 per vertex */
    uint32_t faces;
    const uint32_t *sides;  /* one per face */
    const uint32_t *corner; /* the faces' vertices, one face behind the other, from 0 */
    const uint32_t *vertex_line, *face_line; /* lines in the file, for messages; may be NULL */
    uint32_t tags;
    const hs_sharp_tag *tag; /* of the same edge or vertex the last one counts */
    bool round_sharpness;    /* to the nearest integer, halves up; else a fraction is an error */
} hs_soup;

/* Builds the half-edges of a face list and checks that it is an oriented 2-manifold in the limits
 * above, with finite positions. Vertices that no face uses are dropped, the others keep their
 * order, and *dropped (may be NULL) counts them. On failure *mesh is empty, *err names the line,
 * face, edge or vertex (HS_EXIT_MESH). Time O(half-edges log valence). */
bool hs_mesh_build(hs_mesh *mesh, const hs_soup *soup, uint32_t *dropped, hs_error *err);

/* Frees the arrays and empties *mesh; an empty (zeroed) mesh may be freed. */
void hs_mesh_free(hs_mesh *mesh);

#ifdef __cplusplus
}
#endif
#endif
