/* SPDX-License-Identifier: Apache-2.0
 *
 * The masks of an odd step, in the order of the paper (3.3): face points, edge points, vertex
 * points; and docs/refinement.md, section 9, for boundaries, creases and corners.
 */
#include "reference_parts.h"

#include <stdlib.h>
#include <string.h>

/* 1. Every refined face: the average of its vertices. */
static void face_points(hs_reference *r, const uint8_t *decision) {
    for (uint32_t f = 0; f < r->faces; f++) {
        if (!hs_reference_is_refined(decision, f)) continue;
        hs_reference_face *face = &r->face[f];
        memset(face->point, 0, sizeof face->point);
        for (uint32_t k = 0; k < face->v.count; k++)
            hs_reference_add(face->point, 1, r->vertex[hs_reference_corner(r, f, k)].position);
        hs_reference_divide(face->point, face->v.count);
    }
}

/* 2. Every edge that will be replaced: the average of its ends and the face points beside it; of
 * its ends alone, if it is sharp. */
static void edge_points(hs_reference *r, const uint8_t *decision) {
    for (uint32_t e = 0; e < r->edges; e++) {
        hs_reference_edge *edge = &r->edge[e];
        if (!hs_reference_is_refined(decision, edge->f0)) continue;
        if (!edge->boundary && !hs_reference_is_refined(decision, edge->f1)) continue;
        memset(edge->point, 0, sizeof edge->point);
        hs_reference_add(edge->point, 1, r->vertex[edge->v0].position);
        hs_reference_add(edge->point, 1, r->vertex[edge->v1].position);
        if (edge->sharpness) {
            hs_reference_divide(edge->point, 2);
            continue;
        }
        hs_reference_add(edge->point, 1, r->face[edge->f0].point);
        hs_reference_add(edge->point, 1, r->face[edge->f1].point);
        hs_reference_divide(edge->point, 4);
    }
}

bool hs_reference_on_border(const hs_reference *r, uint32_t v) {
    const hs_reference_list edges = r->vertex[v].edges;
    for (uint32_t i = 0; i < edges.count; i++) {
        const hs_reference_edge *edge = &r->edge[r->vertex_edge[edges.first + i]];
        if (edge->f1 == HS_REFERENCE_NONE && !edge->boundary) return true;
    }
    return false;
}

/* A face at the vertex that is not refined is final; one that is leaves a triangle at a border. */
bool hs_reference_is_leaving(const hs_reference *r, uint32_t v, const uint8_t *decision) {
    const hs_reference_list faces = r->vertex[v].faces;
    for (uint32_t i = 0; i < faces.count; i++)
        if (!hs_reference_is_refined(decision, r->vertex_face[faces.first + i])) return true;
    return hs_reference_on_border(r, v);
}

/* Vertices of final faces stay, and so do those that no active face has. */
static bool may_move(const hs_reference *r, uint32_t v, const uint8_t *decision) {
    return !r->vertex[v].held && r->vertex[v].faces.count > 0 &&
           !hs_reference_is_leaving(r, v, decision);
}

hs_reference_rule hs_reference_vertex_rule(const hs_reference *r, uint32_t v, uint32_t end[2]) {
    const hs_reference_list edges = r->vertex[v].edges;
    uint32_t sharp = 0;
    for (uint32_t i = 0; i < edges.count; i++) {
        const hs_reference_edge *edge = &r->edge[r->vertex_edge[edges.first + i]];
        if (!edge->sharpness) continue;
        if (sharp < 2) end[sharp] = edge->v0 == v ? edge->v1 : edge->v0;
        sharp++;
    }
    if (sharp > 2 || r->vertex[v].sharpness) return HS_REFERENCE_STAYS;
    return sharp == 2 ? HS_REFERENCE_CREASE : HS_REFERENCE_SMOOTH;
}

/* 3. A smooth vertex, by formula (1): Q, the average of the new face points around the vertex; R,
 * the average of the midpoints of its old edges; S, the vertex itself. */
static void smooth_point(const hs_reference *r, uint32_t v, double point[4]) {
    const hs_reference_vertex *vertex = &r->vertex[v];
    const double n = vertex->faces.count;
    double Q[4] = {0}, R[4] = {0};
    for (uint32_t i = 0; i < vertex->faces.count; i++)
        hs_reference_add(Q, 1, r->face[r->vertex_face[vertex->faces.first + i]].point);
    hs_reference_divide(Q, n);
    for (uint32_t i = 0; i < vertex->edges.count; i++) {
        const hs_reference_edge *edge = &r->edge[r->vertex_edge[vertex->edges.first + i]];
        hs_reference_add(R, 0.5, r->vertex[edge->v0].position);
        hs_reference_add(R, 0.5, r->vertex[edge->v1].position);
    }
    hs_reference_divide(R, n);
    const double *S = vertex->position;
    for (int i = 0; i < 4; i++)
        point[i] = Q[i] / n + 2 * R[i] / n + S[i] * (n - 3) / n;
}

/* On a crease: (a + 6S + b)/8, along it. */
static void crease_point(const hs_reference *r, uint32_t v, const uint32_t end[2],
                         double point[4]) {
    memset(point, 0, 4 * sizeof *point);
    hs_reference_add(point, 0.125, r->vertex[end[0]].position);
    hs_reference_add(point, 0.125, r->vertex[end[1]].position);
    hs_reference_add(point, 0.75, r->vertex[v].position);
}

/* Where vertex v goes. */
static void vertex_point(const hs_reference *r, uint32_t v, const uint8_t *decision,
                         double point[4]) {
    uint32_t end[2];
    memcpy(point, r->vertex[v].position, 4 * sizeof *point);
    if (!may_move(r, v, decision)) return;
    switch (hs_reference_vertex_rule(r, v, end)) {
    case HS_REFERENCE_SMOOTH:
        smooth_point(r, v, point);
        break;
    case HS_REFERENCE_CREASE:
        crease_point(r, v, end, point);
        break;
    case HS_REFERENCE_STAYS:
        break;
    }
}

/* All vertices that move do so at once: R needs the old positions of the neighbours. */
static bool vertex_points(hs_reference *r, const uint8_t *decision, hs_error *err) {
    double(*moved)[4] = calloc(r->vertices ? r->vertices : 1, sizeof *moved);
    if (!moved) return hs_reference_no_memory(err);
    for (uint32_t v = 0; v < r->vertices; v++)
        vertex_point(r, v, decision, moved[v]);
    for (uint32_t v = 0; v < r->vertices; v++) {
        memcpy(r->vertex[v].position, moved[v], sizeof moved[v]);
        r->vertex[v].sharpness = hs_reference_worn(r->vertex[v].sharpness);
    }
    free(moved);
    return true;
}

bool hs_reference_compute_points(hs_reference *r, const uint8_t *decision, hs_error *err) {
    face_points(r, decision);
    edge_points(r, decision);
    return vertex_points(r, decision, err);
}
