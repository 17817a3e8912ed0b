/* SPDX-License-Identifier: Apache-2.0
 *
 * The paper's algorithm in the paper's records. A step (3.3) reads
 *   1. to 3. face points, edge points, vertex points        reference_points.c
 *   4. join face points and vertices; old edges that are
 *      kept leave a triangle beside them, which is final    retire
 *   5. delete the other old edges, merge the triangles
 *      beside them                                          merge
 * An even step is 4 and 5 alone: its face points are the inherited edge points.
 * After each step the lists of neighbours are made anew (hs_reference_connect), and what is sharp
 * is handed on: in an odd step from an edge to the face that replaces it, in an even one from there
 * to the edge's two halves.
 */
#include "reference_parts.h"

#include <stdlib.h>
#include <string.h>

/* --- Final faces ------------------------------------------------------------------------------ */

static bool add_final(hs_reference *r, hs_reference_final final, const uint32_t *vertex,
                      hs_error *err) {
    const uint32_t count = final.v.count;
    bool ok = true;
    if (!hs_reference_countable((uint64_t)r->final_corners + count, err)) return false;
    if (r->finals == r->final_room) {
        r->final_room += r->final_room / 2 + 1024;
        RESIZE(r->final, r->final_room, &ok);
    }
    if (r->final_corners + count > r->final_corner_room) {
        r->final_corner_room += r->final_corner_room / 2 + 4096;
        RESIZE(r->final_vertex, r->final_corner_room, &ok);
    }
    if (!ok) return hs_reference_no_memory(err);
    final.v.first = r->final_corners;
    r->final[r->finals++] = final;
    for (uint32_t k = 0; k < count; k++) {
        r->final_vertex[r->final_corners++] = vertex[k];
        r->vertex[vertex[k]].held = true;
    }
    return true;
}

/* An active face becomes final as it is. */
static bool keep_face(hs_reference *r, uint32_t f, hs_error *err) {
    const hs_reference_face *face = &r->face[f];
    const hs_reference_final final = {
        .v.count = face->v.count, .generation = r->generation, .candidate = face->candidate};
    return add_final(r, final, r->face_vertex + face->v.first, err);
}

/* 4. Appends a vertex at every refined face's point and notes its number per face. */
static bool add_face_vertices(hs_reference *r, const uint8_t *decision, uint32_t *number,
                              hs_error *err) {
    uint64_t count = r->vertices;
    for (uint32_t f = 0; f < r->faces; f++)
        count += hs_reference_is_refined(decision, f);
    bool ok = true;
    if (!hs_reference_countable(count, err)) return false;
    RESIZE(r->vertex, count, &ok);
    if (!ok) return hs_reference_no_memory(err);
    for (uint32_t f = 0; f < r->faces; f++) {
        number[f] = HS_REFERENCE_NONE;
        if (!hs_reference_is_refined(decision, f)) continue;
        number[f] = r->vertices;
        hs_reference_vertex *vertex = &r->vertex[r->vertices++];
        *vertex = (hs_reference_vertex){.held = false};
        memcpy(vertex->position, r->face[f].point, sizeof vertex->position);
    }
    return true;
}

/* --- What replaces an edge -------------------------------------------------------------------- */

static bool is_odd(const hs_reference *r) {
    return r->generation % 2 == 0;
}

/* True if this step makes a face of an edge: between refined faces, or on the boundary of one. The
 * boundary side of a half-quad, in even steps, is divided, but nothing is beside it to merge with.
 */
static bool is_replaced(const hs_reference *r, const hs_reference_edge *edge,
                        const uint8_t *decision) {
    if (!hs_reference_is_refined(decision, edge->f0)) return false;
    return edge->boundary ? is_odd(r) : hs_reference_is_refined(decision, edge->f1);
}

static bool is_selected(const uint8_t *decision, uint32_t f) {
    return !decision || (decision[f] & HS_REFERENCE_SELECTED);
}

static bool is_candidate(const hs_reference_edge *edge, const uint8_t *decision) {
    return is_selected(decision, edge->f0) && (edge->boundary || is_selected(decision, edge->f1));
}

/* The vertices of the quad or half-quad; gives their number. */
static uint32_t vertices_of_child(const hs_reference_edge *edge, const uint32_t *number,
                                  uint32_t vertex[4]) {
    vertex[0] = edge->v1;
    vertex[1] = number[edge->f0];
    vertex[2] = edge->v0;
    if (edge->boundary) return 3;
    vertex[3] = number[edge->f1];
    return 4;
}

/* --- What leaves ------------------------------------------------------------------------------ */

/* The triangle at side v -> w of a refined face that is kept. With limit positions, its new vertex
 * leaves where it was made: its ring will never be. */
static bool keep_side(hs_reference *r, uint32_t v, uint32_t w, uint32_t new_vertex, hs_error *err) {
    hs_reference_vertex *F = &r->vertex[new_vertex];
    if (!F->held && r->limit) r->at_level++;
    memcpy(F->limit, F->position, sizeof F->limit);
    const hs_reference_final triangle = {.v.count = 3, .generation = r->generation};
    return add_final(r, triangle, (uint32_t[3]){v, w, new_vertex}, err);
}

/* What side k of a refined face leaves for good: at a kept edge, a triangle; elsewhere, in the last
 * step and seen from the first face of its edge, the quad or half-quad. */
static bool retire_side(hs_reference *r, uint32_t f, uint32_t k, const uint8_t *decision,
                        const uint32_t *number, bool last, hs_error *err) {
    const uint32_t v = hs_reference_corner(r, f, k), w = hs_reference_corner(r, f, k + 1);
    const hs_reference_edge *edge = &r->edge[hs_reference_find_edge(r, v, w)];
    const uint32_t beside = r->face_face[r->face[f].f.first + k];
    if (!edge->boundary && !hs_reference_is_refined(decision, beside))
        return keep_side(r, v, w, number[f], err);
    if (!last || edge->f0 != f || !is_replaced(r, edge, decision)) return true;
    uint32_t vertex[4];
    const hs_reference_final final = {.v.count = vertices_of_child(edge, number, vertex),
                                      .generation = r->generation + 1,
                                      .candidate = is_candidate(edge, decision)};
    return add_final(r, final, vertex, err);
}

/* 4. What leaves in this step, in the order of the faces and of their sides. */
static bool retire(hs_reference *r, const uint8_t *decision, const uint32_t *number, bool last,
                   hs_error *err) {
    for (uint32_t f = 0; f < r->faces; f++) {
        if (!hs_reference_is_refined(decision, f)) {
            if (!keep_face(r, f, err)) return false;
            continue;
        }
        for (uint32_t k = 0; k < r->face[f].v.count; k++)
            if (!retire_side(r, f, k, decision, number, last, err)) return false;
    }
    return true;
}

/* --- Sharp edges ------------------------------------------------------------------------------ */

/* The new vertex of a sharp edge, and the edge's ends: both halves have this sharpness. */
typedef struct crease {
    uint32_t middle, end[2];
    uint8_t sharpness;
    bool boundary;
} crease;

static void sharpen(hs_reference *r, uint32_t v, uint32_t w, uint8_t sharpness, bool boundary) {
    const uint32_t e = hs_reference_find_edge(r, v, w);
    if (e == HS_REFERENCE_NONE) return; /* no active face has it */
    r->edge[e].sharpness = sharpness;
    r->edge[e].boundary = boundary;
}

static void sharpen_halves(hs_reference *r, const crease *halved, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++)
            sharpen(r, halved[i].middle, halved[i].end[k], halved[i].sharpness, halved[i].boundary);
}

/* The boundary sides of half-quads. */
static void sharpen_half_quads(hs_reference *r) {
    for (uint32_t f = 0; f < r->faces; f++)
        if (r->face[f].v.count == 3)
            sharpen(r, hs_reference_corner(r, f, 2), hs_reference_corner(r, f, 0),
                    HS_SHARP_INFINITE, true);
}

/* In an even step, what replaced a sharp edge is divided at the edge's middle. *count is 0, and
 * NULL no error, if nothing is sharp. */
static crease *creases_of_faces(const hs_reference *r, const uint8_t *decision,
                                const uint32_t *number, uint32_t *count, bool *ok) {
    *count = 0;
    for (uint32_t f = 0; f < r->faces; f++)
        *count += hs_reference_is_refined(decision, f) && r->face[f].sharpness;
    if (*count == 0) return NULL;
    crease *all = hs_reference_resized(NULL, *count, sizeof *all, ok), *next = all;
    for (uint32_t f = 0; *ok && f < r->faces; f++) {
        const hs_reference_face *face = &r->face[f];
        if (!hs_reference_is_refined(decision, f) || !face->sharpness) continue;
        *next++ = (crease){number[f],
                           {hs_reference_corner(r, f, 0), hs_reference_corner(r, f, 2)},
                           face->sharpness,
                           face->v.count == 3};
    }
    return all;
}

/* --- The next mesh ---------------------------------------------------------------------------- */

/* Replaces the active faces, and with them the edges and the lists. */
static bool replace_faces(hs_reference *r, hs_reference_face *face, uint32_t faces,
                          uint32_t *face_vertex, uint32_t corners, hs_error *err) {
    free(r->face);
    free(r->face_vertex);
    r->face = face;
    r->faces = faces;
    r->face_vertex = face_vertex;
    r->corners = corners;
    return hs_reference_connect(r, err);
}

/* What the face that replaces an edge inherits. */
static hs_reference_face child_of(const hs_reference *r, const hs_reference_edge *edge,
                                  const uint8_t *decision) {
    const uint8_t f = r->face[edge->f0].forced, g = edge->boundary ? f : r->face[edge->f1].forced;
    hs_reference_face child = {.forced = f < g ? f : g,
                               .candidate = is_candidate(edge, decision),
                               .sharpness = is_odd(r) ? hs_reference_worn(edge->sharpness) : 0};
    memcpy(child.point, edge->point, sizeof child.point);
    return child;
}

/* 5. Deletes the edges that are replaced: the triangles beside each merge into a quad. */
static bool merge(hs_reference *r, const uint8_t *decision, const uint32_t *number, hs_error *err) {
    uint64_t faces = 0;
    for (uint32_t e = 0; e < r->edges; e++)
        faces += is_replaced(r, &r->edge[e], decision);
    if (!hs_reference_countable(4 * faces, err)) return false;
    bool ok = true;
    uint32_t creases = 0;
    crease *halved = is_odd(r) ? NULL : creases_of_faces(r, decision, number, &creases, &ok);
    hs_reference_face *face = hs_reference_resized(NULL, faces, sizeof *face, &ok);
    uint32_t *vertex = hs_reference_resized(NULL, 4 * faces, sizeof *vertex, &ok);
    if (!ok) {
        free(halved);
        free(face);
        free(vertex);
        return hs_reference_no_memory(err);
    }
    uint32_t count = 0, corners = 0;
    for (uint32_t e = 0; e < r->edges; e++) {
        const hs_reference_edge *edge = &r->edge[e];
        if (!is_replaced(r, edge, decision)) continue;
        face[count] = child_of(r, edge, decision);
        face[count].v.first = corners;
        face[count].v.count = vertices_of_child(edge, number, vertex + corners);
        corners += face[count++].v.count;
    }
    const bool odd = is_odd(r);
    ok = replace_faces(r, face, count, vertex, corners, err);
    if (ok && odd) sharpen_half_quads(r);
    if (ok) sharpen_halves(r, halved, creases);
    free(halved);
    return ok;
}

static bool retire_everything(hs_reference *r, hs_error *err) {
    r->faces = r->corners = 0;
    return hs_reference_connect(r, err);
}

static bool take_step(hs_reference *r, const uint8_t *decision, bool last, hs_error *err) {
    if (r->limit) hs_reference_leave(r, decision, false);
    if (is_odd(r) && !hs_reference_compute_points(r, decision, err)) return false;

    bool ok = true;
    uint32_t *number = hs_reference_resized(NULL, r->faces, sizeof *number, &ok);
    if (!ok) return hs_reference_no_memory(err);
    ok = add_face_vertices(r, decision, number, err) && retire(r, decision, number, last, err) &&
         (last ? retire_everything(r, err) : merge(r, decision, number, err));
    free(number);
    r->generation++;
    return ok;
}

bool hs_reference_step(hs_reference *r, const uint8_t *decision, hs_error *err) {
    return take_step(r, decision, false, err);
}

bool hs_reference_last_step(hs_reference *r, const uint8_t *decision, hs_error *err) {
    return take_step(r, decision, true, err);
}

bool hs_reference_finish(hs_reference *r, hs_error *err) {
    if (r->limit) hs_reference_leave(r, NULL, true);
    for (uint32_t f = 0; f < r->faces; f++)
        if (!keep_face(r, f, err)) return false;
    return retire_everything(r, err);
}

/* --- Catmull-Clark, directly ------------------------------------------------------------------ */

/* Vertices at the face points, then at the edge points. */
static bool add_catmull_clark_vertices(hs_reference *r, hs_error *err) {
    const uint64_t count = (uint64_t)r->vertices + r->faces + r->edges;
    bool ok = true;
    if (!hs_reference_countable(count, err)) return false;
    RESIZE(r->vertex, count, &ok);
    if (!ok) return hs_reference_no_memory(err);
    for (uint32_t i = 0; i < r->faces + r->edges; i++) {
        const double *point = i < r->faces ? r->face[i].point : r->edge[i - r->faces].point;
        hs_reference_vertex *vertex = &r->vertex[r->vertices + i];
        *vertex = (hs_reference_vertex){.held = false};
        memcpy(vertex->position, point, sizeof vertex->position);
    }
    r->vertices = (uint32_t)count;
    return true;
}

/* The halves of edge e of what is to become the last level have these. */
static crease *creases_of_edges(const hs_reference *r, uint32_t first_edge_vertex, bool *ok) {
    crease *all = hs_reference_resized(NULL, r->edges, sizeof *all, ok);
    for (uint32_t e = 0; *ok && e < r->edges; e++) {
        const hs_reference_edge *edge = &r->edge[e];
        all[e] = (crease){first_edge_vertex + e,
                          {edge->v0, edge->v1},
                          hs_reference_worn(edge->sharpness),
                          edge->boundary};
    }
    return all;
}

static bool can_be_refined_whole(const hs_reference *r, hs_error *err) {
    for (uint32_t e = 0; e < r->edges; e++)
        if (r->edge[e].f1 == HS_REFERENCE_NONE && !r->edge[e].boundary)
            return hs_fail(err, HS_EXIT_MESH,
                           "reference: the edge from vertex %u to %u is on a boundary that is "
                           "kept; direct Catmull-Clark is for the other boundary modes, use "
                           "sqrt(2) steps",
                           r->edge[e].v0, r->edge[e].v1);
    return true;
}

bool hs_reference_catmull_clark(hs_reference *r, hs_error *err) {
    const uint32_t vertices = r->vertices, edges = r->edges;
    if (!can_be_refined_whole(r, err) || !hs_reference_compute_points(r, NULL, err) ||
        !add_catmull_clark_vertices(r, err) ||
        !hs_reference_countable(4 * (uint64_t)r->corners, err))
        return false;

    bool ok = true;
    crease *halved = creases_of_edges(r, vertices + r->faces, &ok);
    hs_reference_face *quad = hs_reference_resized(NULL, r->corners, sizeof *quad, &ok);
    uint32_t *corner = hs_reference_resized(NULL, 4 * (uint64_t)r->corners, sizeof *corner, &ok);
    if (!ok) {
        free(halved);
        free(quad);
        free(corner);
        return hs_reference_no_memory(err);
    }
    uint32_t count = 0;
    for (uint32_t f = 0; f < r->faces; f++) {
        const uint32_t n = r->face[f].v.count;
        for (uint32_t k = 0; k < n; k++, count++) {
            const uint32_t u = hs_reference_corner(r, f, k + n - 1),
                           v = hs_reference_corner(r, f, k), w = hs_reference_corner(r, f, k + 1);
            quad[count] = (hs_reference_face){
                .v = {4 * count, 4}, .forced = r->face[f].forced, .candidate = true};
            corner[4 * count] = v;
            corner[4 * count + 1] = vertices + r->faces + hs_reference_find_edge(r, v, w);
            corner[4 * count + 2] = vertices + f;
            corner[4 * count + 3] = vertices + r->faces + hs_reference_find_edge(r, u, v);
        }
    }
    r->generation += 2;
    ok = replace_faces(r, quad, count, corner, 4 * count, err);
    if (ok) sharpen_halves(r, halved, edges);
    free(halved);
    return ok;
}
