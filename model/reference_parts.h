/* SPDX-License-Identifier: Apache-2.0
 *
 * What the files of the reference share with each other:
 *   reference.c         records, memory, neighbours
 *   reference_points.c  the odd step's masks
 *   reference_step.c    the steps' topology, direct Catmull-Clark
 *   reference_limit.c   limit positions and normals
 *   reference_replay.c  decisions, replay, comparison
 */
#ifndef HS_REFERENCE_PARTS_H
#define HS_REFERENCE_PARTS_H

#include "reference.h"

/* The array with room for count items; the old array, and *ok false, if there is no memory. */
void *hs_reference_resized(void *array, uint64_t count, size_t size, bool *ok);

#define RESIZE(array, count, ok)                                                                   \
    ((array) = hs_reference_resized((array), (count), sizeof *(array), (ok)))

/* These two return false, with an error, if memory is exhausted, or if a number of things is too
 * large to be counted. */
bool hs_reference_no_memory(hs_error *err);
bool hs_reference_countable(uint64_t count, hs_error *err);

/* Makes edges and all lists of neighbours from the active faces' vertices. Edges are neither sharp
 * nor boundary. */
bool hs_reference_connect(hs_reference *r, hs_error *err);

/* The edge between two vertices, in any direction, or HS_REFERENCE_NONE. */
uint32_t hs_reference_find_edge(const hs_reference *r, uint32_t v, uint32_t w);

/* The vertex behind side k of a face; side k runs from vertex k to vertex k + 1. */
static inline uint32_t hs_reference_corner(const hs_reference *r, uint32_t f, uint32_t k) {
    const hs_reference_list v = r->face[f].v;
    return r->face_vertex[v.first + k % v.count];
}

static inline bool hs_reference_is_refined(const uint8_t *decision, uint32_t f) {
    return f != HS_REFERENCE_NONE && (!decision || (decision[f] & HS_REFERENCE_REFINED));
}

/* What is left of a sharpness a level later. */
static inline uint8_t hs_reference_worn(uint8_t sharpness) {
    if (sharpness == HS_SHARP_INFINITE || sharpness == 0) return sharpness;
    return (uint8_t)(sharpness - 1);
}

/* sum += weight * point, component by component. */
static inline void hs_reference_add(double sum[4], double weight, const double point[4]) {
    for (int i = 0; i < 4; i++)
        sum[i] += weight * point[i];
}

static inline void hs_reference_divide(double point[4], double by) {
    for (int i = 0; i < 4; i++)
        point[i] /= by;
}

/* Face points, edge points and vertex points of an odd step; vertices move, and wear off. */
bool hs_reference_compute_points(hs_reference *r, const uint8_t *decision, hs_error *err);

/* True if a vertex is an end of an edge with one active face that is not on the boundary. */
bool hs_reference_on_border(const hs_reference *r, uint32_t v);

/* True if a vertex will belong to a final face if these faces are refined now (NULL: all). */
bool hs_reference_is_leaving(const hs_reference *r, uint32_t v, const uint8_t *decision);

/* The rule for a vertex, by what is sharp around it. */
typedef enum hs_reference_rule {
    HS_REFERENCE_SMOOTH,
    HS_REFERENCE_CREASE,
    HS_REFERENCE_STAYS
} hs_reference_rule;

/* That of an even generation. end: the other ends of its sharp edges, if they are two. */
hs_reference_rule hs_reference_vertex_rule(const hs_reference *r, uint32_t v, uint32_t end[2]);

/* Gives the vertices that leave now their limit positions, before anything of the step is computed.
 * finish: all active vertices leave, otherwise those that the decision makes held. */
void hs_reference_leave(hs_reference *r, const uint8_t *decision, bool finish);

#endif
