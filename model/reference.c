/* SPDX-License-Identifier: Apache-2.0
 *
 * The paper's algorithm in the paper's records. A step (3.3) reads, in this file's order:
 *   1. face points         average of the face's vertices              face_points
 *   2. edge points         (v + w + F + G)/4, an edge's attribute      edge_points
 *   3. vertex points       Q/n + 2R/n + S(n-3)/n                       vertex_points
 *   4. join face points and vertices; old edges that are kept leave
 *      a triangle beside them, which is final                          retire
 *   5. delete the other old edges, merge the triangles beside them     merge
 * An even step is 4 and 5 alone: its face points are the inherited edge points.
 * After each step the lists of neighbours are made anew (connect).
 */
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- Memory ---------------------------------------------------------------------------------- */

/* The array with room for count items; the old array, and *ok false, if there is no memory. */
static void *resized(void *array, uint64_t count, size_t size, bool *ok) {
    void *bigger = realloc(array, (size_t)(count ? count : 1) * size);
    if (bigger) return bigger;
    *ok = false;
    return array;
}

#define RESIZE(array, count, ok) ((array) = resized((array), (count), sizeof *(array), (ok)))

static bool no_memory(hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL,
                   "reference: out of memory; refine less deeply or use a smaller mesh");
}

/* Numbers are 32 bits; vertex_edge has two items per corner. */
static bool countable(uint64_t count, hs_error *err) {
    if (count < UINT32_MAX / 2) return true;
    return hs_fail(err, HS_EXIT_INTERNAL,
                   "reference: more than 2^31 vertices or corners; refine less deeply");
}

void hs_reference_free(hs_reference *r) {
    free(r->vertex);
    free(r->face);
    free(r->edge);
    free(r->final);
    free(r->face_vertex);
    free(r->face_face);
    free(r->vertex_face);
    free(r->vertex_edge);
    free(r->final_vertex);
    memset(r, 0, sizeof *r);
}

/* --- Neighbours ------------------------------------------------------------------------------ */

/* The vertex behind side k of a face; side k runs from vertex k to vertex k + 1. */
static uint32_t face_corner(const hs_reference *r, uint32_t f, uint32_t k) {
    const hs_reference_list v = r->face[f].v;
    return r->face_vertex[v.first + k % v.count];
}

/* The edge between two vertices, in any direction, or NONE. */
static uint32_t find_edge(const hs_reference *r, uint32_t v, uint32_t w) {
    const hs_reference_list edges = r->vertex[v].edges;
    for (uint32_t i = 0; i < edges.count; i++) {
        const uint32_t e = r->vertex_edge[edges.first + i];
        if (r->edge[e].v0 == w || r->edge[e].v1 == w) return e;
    }
    return HS_REFERENCE_NONE;
}

static void add_edge(hs_reference *r, uint32_t v, uint32_t w, uint32_t f) {
    const uint32_t e = r->edges++;
    r->edge[e] = (hs_reference_edge){.v0 = v, .v1 = w, .f0 = f, .f1 = HS_REFERENCE_NONE};
    hs_reference_list *at_v = &r->vertex[v].edges, *at_w = &r->vertex[w].edges;
    r->vertex_edge[at_v->first + at_v->count++] = e;
    r->vertex_edge[at_w->first + at_w->count++] = e;
}

/* Gives every vertex a place for its lists: as many faces as it has corners, and two edges for
 * each of those at most. */
static void reserve_lists(hs_reference *r) {
    for (uint32_t v = 0; v < r->vertices; v++)
        r->vertex[v].faces.count = 0;
    for (uint32_t i = 0; i < r->corners; i++)
        r->vertex[r->face_vertex[i]].faces.count++;
    uint32_t place = 0;
    for (uint32_t v = 0; v < r->vertices; v++) {
        const uint32_t corners = r->vertex[v].faces.count;
        r->vertex[v].faces = (hs_reference_list){place, 0};
        r->vertex[v].edges = (hs_reference_list){2 * place, 0};
        place += corners;
    }
}

/* Makes edges and all lists of neighbours from the active faces' vertices. */
static bool connect(hs_reference *r, hs_error *err) {
    bool ok = true;
    RESIZE(r->vertex_face, r->corners, &ok);
    RESIZE(r->vertex_edge, 2 * (uint64_t)r->corners, &ok);
    RESIZE(r->face_face, r->corners, &ok);
    RESIZE(r->edge, r->corners, &ok);
    if (!ok) return no_memory(err);

    reserve_lists(r);
    r->edges = 0;
    for (uint32_t f = 0; f < r->faces; f++) {
        for (uint32_t k = 0; k < r->face[f].v.count; k++) {
            const uint32_t v = face_corner(r, f, k), w = face_corner(r, f, k + 1);
            hs_reference_list *around = &r->vertex[v].faces;
            r->vertex_face[around->first + around->count++] = f;
            const uint32_t e = find_edge(r, v, w);
            if (e == HS_REFERENCE_NONE)
                add_edge(r, v, w, f);
            else if (r->edge[e].v0 == w && r->edge[e].f1 == HS_REFERENCE_NONE)
                r->edge[e].f1 = f;
            else
                return hs_fail(err, HS_EXIT_MESH,
                               "reference: face %u: another face has the edge from vertex %u to "
                               "%u in the same direction; orient the faces alike",
                               f, v, w);
        }
    }
    for (uint32_t f = 0; f < r->faces; f++) {
        r->face[f].f = r->face[f].v; /* as many neighbours as sides, at the same place */
        for (uint32_t k = 0; k < r->face[f].v.count; k++) {
            const hs_reference_edge *e =
                &r->edge[find_edge(r, face_corner(r, f, k), face_corner(r, f, k + 1))];
            r->face_face[r->face[f].f.first + k] = e->f0 == f ? e->f1 : e->f0;
        }
    }
    return true;
}

/* --- A mesh in the paper's records
 * ----------------------------------------------------------------- */

/* clip = M p; remembers the largest sum of absolute products. */
static void transform(hs_reference *r, const float *p, const double *matrix, double clip[4]) {
    for (size_t row = 0; row < 4; row++) {
        const double *m = matrix + 4 * row;
        double absolute = 0;
        clip[row] = 0;
        for (size_t i = 0; i < 4; i++) {
            clip[row] += m[i] * (double)p[i];
            absolute += fabs(m[i] * (double)p[i]);
        }
        if (absolute > r->input_sum) r->input_sum = absolute;
    }
}

bool hs_reference_new(hs_reference *r, const hs_mesh *mesh, const double matrix[16],
                      hs_error *err) {
    memset(r, 0, sizeof *r);
    bool ok = true;
    RESIZE(r->vertex, mesh->vertices, &ok);
    RESIZE(r->face, mesh->faces, &ok);
    RESIZE(r->face_vertex, mesh->halfedges, &ok);
    if (!ok || !countable(mesh->halfedges, err)) {
        hs_reference_free(r);
        return ok ? false : no_memory(err);
    }
    r->vertices = mesh->vertices;
    r->faces = mesh->faces;
    r->corners = mesh->halfedges;
    for (uint32_t v = 0; v < r->vertices; v++) {
        const float *p = mesh->position + 4 * (size_t)v;
        r->vertex[v] = (hs_reference_vertex){.position = {p[0], p[1], p[2], p[3]}};
        if (matrix) transform(r, p, matrix, r->vertex[v].position);
    }
    for (uint32_t f = 0; f < r->faces; f++)
        r->face[f] = (hs_reference_face){.v = {mesh->first[f], hs_sides(mesh, f)},
                                         .forced = mesh->forced ? mesh->forced[f] : 0,
                                         .candidate = true};
    memcpy(r->face_vertex, mesh->origin, r->corners * sizeof *r->face_vertex);
    if (connect(r, err)) return true;
    hs_reference_free(r);
    return false;
}

static void *duplicate(const void *array, uint64_t count, size_t size, bool *ok) {
    void *copy = resized(NULL, count, size, ok);
    if (copy && array) memcpy(copy, array, (size_t)count * size);
    return copy;
}

bool hs_reference_copy(hs_reference *copy, const hs_reference *r, hs_error *err) {
    bool ok = true;
    *copy = *r;
    copy->final_room = r->finals;
    copy->final_corner_room = r->final_corners;
    copy->vertex = duplicate(r->vertex, r->vertices, sizeof *r->vertex, &ok);
    copy->face = duplicate(r->face, r->faces, sizeof *r->face, &ok);
    copy->edge = duplicate(r->edge, r->edges, sizeof *r->edge, &ok);
    copy->final = duplicate(r->final, r->finals, sizeof *r->final, &ok);
    copy->face_vertex = duplicate(r->face_vertex, r->corners, sizeof(uint32_t), &ok);
    copy->face_face = duplicate(r->face_face, r->corners, sizeof(uint32_t), &ok);
    copy->vertex_face = duplicate(r->vertex_face, r->corners, sizeof(uint32_t), &ok);
    copy->vertex_edge = duplicate(r->vertex_edge, 2 * (uint64_t)r->corners, sizeof(uint32_t), &ok);
    copy->final_vertex = duplicate(r->final_vertex, r->final_corners, sizeof(uint32_t), &ok);
    if (ok) return true;
    hs_reference_free(copy);
    return no_memory(err);
}

/* --- Points: sum += weight * point, component by component
 * ------------------------------------------ */

static void add(double sum[4], double weight, const double point[4]) {
    for (int i = 0; i < 4; i++)
        sum[i] += weight * point[i];
}

static void divide(double point[4], double by) {
    for (int i = 0; i < 4; i++)
        point[i] /= by;
}

static bool is_refined(const uint8_t *decision, uint32_t f) {
    return f != HS_REFERENCE_NONE && (!decision || (decision[f] & HS_REFERENCE_REFINED));
}

static bool is_selected(const uint8_t *decision, uint32_t f) {
    return !decision || (decision[f] & HS_REFERENCE_SELECTED);
}

/* 1. Every refined face: the average of its vertices. */
static void face_points(hs_reference *r, const uint8_t *decision) {
    for (uint32_t f = 0; f < r->faces; f++) {
        if (!is_refined(decision, f)) continue;
        hs_reference_face *face = &r->face[f];
        memset(face->point, 0, sizeof face->point);
        for (uint32_t k = 0; k < face->v.count; k++)
            add(face->point, 1, r->vertex[face_corner(r, f, k)].position);
        divide(face->point, face->v.count);
    }
}

/* 2. Every edge that will be deleted: the average of its ends and the face points beside it. */
static void edge_points(hs_reference *r, const uint8_t *decision) {
    for (uint32_t e = 0; e < r->edges; e++) {
        hs_reference_edge *edge = &r->edge[e];
        if (!is_refined(decision, edge->f0) || !is_refined(decision, edge->f1)) continue;
        memset(edge->point, 0, sizeof edge->point);
        add(edge->point, 1, r->vertex[edge->v0].position);
        add(edge->point, 1, r->vertex[edge->v1].position);
        add(edge->point, 1, r->face[edge->f0].point);
        add(edge->point, 1, r->face[edge->f1].point);
        divide(edge->point, 4);
    }
}

/* A vertex moves iff all its faces are active and refined, and no edge of it is on a border. */
static bool moves(const hs_reference *r, uint32_t v, const uint8_t *decision) {
    const hs_reference_vertex *vertex = &r->vertex[v];
    if (vertex->held || vertex->faces.count == 0) return false;
    for (uint32_t i = 0; i < vertex->faces.count; i++)
        if (!is_refined(decision, r->vertex_face[vertex->faces.first + i])) return false;
    for (uint32_t i = 0; i < vertex->edges.count; i++)
        if (r->edge[r->vertex_edge[vertex->edges.first + i]].f1 == HS_REFERENCE_NONE) return false;
    return true;
}

/* 3. Formula (1): Q, the average of the new face points around the vertex; R, the average of the
 * midpoints of its old edges; S, the vertex itself. */
static void vertex_point(const hs_reference *r, uint32_t v, double point[4]) {
    const hs_reference_vertex *vertex = &r->vertex[v];
    const double n = vertex->faces.count;
    double Q[4] = {0}, R[4] = {0};
    for (uint32_t i = 0; i < vertex->faces.count; i++)
        add(Q, 1, r->face[r->vertex_face[vertex->faces.first + i]].point);
    divide(Q, n);
    for (uint32_t i = 0; i < vertex->edges.count; i++) {
        const hs_reference_edge *edge = &r->edge[r->vertex_edge[vertex->edges.first + i]];
        add(R, 0.5, r->vertex[edge->v0].position);
        add(R, 0.5, r->vertex[edge->v1].position);
    }
    divide(R, n);
    const double *S = vertex->position;
    for (int i = 0; i < 4; i++)
        point[i] = Q[i] / n + 2 * R[i] / n + S[i] * (n - 3) / n;
}

/* All vertices that move do so at once: R needs the old positions of the neighbours. */
static bool vertex_points(hs_reference *r, const uint8_t *decision, hs_error *err) {
    double(*moved)[4] = calloc(r->vertices ? r->vertices : 1, sizeof *moved);
    if (!moved) return no_memory(err);
    for (uint32_t v = 0; v < r->vertices; v++) {
        if (moves(r, v, decision))
            vertex_point(r, v, moved[v]);
        else
            memcpy(moved[v], r->vertex[v].position, sizeof moved[v]);
    }
    for (uint32_t v = 0; v < r->vertices; v++)
        memcpy(r->vertex[v].position, moved[v], sizeof moved[v]);
    free(moved);
    return true;
}

static bool compute_points(hs_reference *r, const uint8_t *decision, hs_error *err) {
    face_points(r, decision);
    edge_points(r, decision);
    return vertex_points(r, decision, err);
}

/* --- Topology
 * --------------------------------------------------------------------------------------- */

static bool add_final(hs_reference *r, hs_reference_final final, const uint32_t *vertex,
                      hs_error *err) {
    const uint32_t count = final.v.count;
    bool ok = true;
    if (!countable((uint64_t)r->final_corners + count, err)) return false;
    if (r->finals == r->final_room) {
        r->final_room += r->final_room / 2 + 1024;
        RESIZE(r->final, r->final_room, &ok);
    }
    if (r->final_corners + count > r->final_corner_room) {
        r->final_corner_room += r->final_corner_room / 2 + 4096;
        RESIZE(r->final_vertex, r->final_corner_room, &ok);
    }
    if (!ok) return no_memory(err);
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
        count += is_refined(decision, f);
    bool ok = true;
    if (!countable(count, err)) return false;
    RESIZE(r->vertex, count, &ok);
    if (!ok) return no_memory(err);
    for (uint32_t f = 0; f < r->faces; f++) {
        number[f] = HS_REFERENCE_NONE;
        if (!is_refined(decision, f)) continue;
        number[f] = r->vertices;
        hs_reference_vertex *vertex = &r->vertex[r->vertices++];
        *vertex = (hs_reference_vertex){.held = false};
        memcpy(vertex->position, r->face[f].point, sizeof vertex->position);
    }
    return true;
}

/* The quad that replaces an edge between refined faces. */
static void quad_of_edge(const hs_reference_edge *edge, const uint32_t *number, uint32_t quad[4]) {
    quad[0] = edge->v1;
    quad[1] = number[edge->f0];
    quad[2] = edge->v0;
    quad[3] = number[edge->f1];
}

static bool quad_is_candidate(const hs_reference_edge *edge, const uint8_t *decision) {
    return is_selected(decision, edge->f0) && is_selected(decision, edge->f1);
}

/* What side k of a refined face leaves for good: at a kept edge, a triangle; elsewhere, in the last
 * step and seen from the first face of its edge, the quad. */
static bool retire_side(hs_reference *r, uint32_t f, uint32_t k, const uint8_t *decision,
                        const uint32_t *number, bool last, hs_error *err) {
    const uint32_t v = face_corner(r, f, k), w = face_corner(r, f, k + 1);
    if (!is_refined(decision, r->face_face[r->face[f].f.first + k])) {
        const hs_reference_final triangle = {.v.count = 3, .generation = r->generation};
        return add_final(r, triangle, (uint32_t[3]){v, w, number[f]}, err);
    }
    const hs_reference_edge *edge = &r->edge[find_edge(r, v, w)];
    if (!last || edge->f0 != f) return true;
    const hs_reference_final final = {.v.count = 4,
                                      .generation = r->generation + 1,
                                      .candidate = quad_is_candidate(edge, decision)};
    uint32_t quad[4];
    quad_of_edge(edge, number, quad);
    return add_final(r, final, quad, err);
}

/* 4. What leaves in this step, in the order of the faces and of their sides. */
static bool retire(hs_reference *r, const uint8_t *decision, const uint32_t *number, bool last,
                   hs_error *err) {
    for (uint32_t f = 0; f < r->faces; f++) {
        if (!is_refined(decision, f)) {
            if (!keep_face(r, f, err)) return false;
            continue;
        }
        for (uint32_t k = 0; k < r->face[f].v.count; k++)
            if (!retire_side(r, f, k, decision, number, last, err)) return false;
    }
    return true;
}

/* Replaces the active faces, and with them the edges and the lists. */
static bool replace_faces(hs_reference *r, hs_reference_face *face, uint32_t faces,
                          uint32_t *face_vertex, hs_error *err) {
    free(r->face);
    free(r->face_vertex);
    r->face = face;
    r->faces = faces;
    r->face_vertex = face_vertex;
    r->corners = 4 * faces;
    return connect(r, err);
}

/* 5. Deletes the edges between refined faces: the triangles beside each merge into a quad. */
static bool merge(hs_reference *r, const uint8_t *decision, const uint32_t *number, hs_error *err) {
    uint64_t quads = 0;
    for (uint32_t e = 0; e < r->edges; e++)
        quads += is_refined(decision, r->edge[e].f0) && is_refined(decision, r->edge[e].f1);
    if (!countable(4 * quads, err)) return false;
    bool ok = true;
    hs_reference_face *quad = resized(NULL, quads, sizeof *quad, &ok);
    uint32_t *corner = resized(NULL, 4 * quads, sizeof *corner, &ok);
    if (!ok) {
        free(quad);
        free(corner);
        return no_memory(err);
    }
    uint32_t count = 0;
    for (uint32_t e = 0; e < r->edges; e++) {
        const hs_reference_edge *edge = &r->edge[e];
        if (!is_refined(decision, edge->f0) || !is_refined(decision, edge->f1)) continue;
        const hs_reference_face *f = &r->face[edge->f0], *g = &r->face[edge->f1];
        quad[count] = (hs_reference_face){.v = {4 * count, 4},
                                          .forced = f->forced < g->forced ? f->forced : g->forced,
                                          .candidate = is_selected(decision, edge->f0) &&
                                                       is_selected(decision, edge->f1)};
        memcpy(quad[count].point, edge->point, sizeof edge->point);
        quad_of_edge(edge, number, corner + 4 * (size_t)count);
        count++;
    }
    return replace_faces(r, quad, count, corner, err);
}

static bool retire_everything(hs_reference *r, hs_error *err) {
    r->faces = r->corners = 0;
    return connect(r, err);
}

static bool take_step(hs_reference *r, const uint8_t *decision, bool last, hs_error *err) {
    const bool odd = r->generation % 2 == 0;
    if (odd && !compute_points(r, decision, err)) return false;

    bool ok = true;
    uint32_t *number = resized(NULL, r->faces, sizeof *number, &ok);
    if (!ok) return no_memory(err);
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
    for (uint32_t f = 0; f < r->faces; f++)
        if (!keep_face(r, f, err)) return false;
    return retire_everything(r, err);
}

/* --- Catmull-Clark, directly
 * ------------------------------------------------------------------------- */

/* Vertices at the face points, then at the edge points. */
static bool add_catmull_clark_vertices(hs_reference *r, hs_error *err) {
    const uint64_t count = (uint64_t)r->vertices + r->faces + r->edges;
    bool ok = true;
    if (!countable(count, err)) return false;
    RESIZE(r->vertex, count, &ok);
    if (!ok) return no_memory(err);
    for (uint32_t i = 0; i < r->faces + r->edges; i++) {
        const double *point = i < r->faces ? r->face[i].point : r->edge[i - r->faces].point;
        hs_reference_vertex *vertex = &r->vertex[r->vertices + i];
        *vertex = (hs_reference_vertex){.held = false};
        memcpy(vertex->position, point, sizeof vertex->position);
    }
    r->vertices = (uint32_t)count;
    return true;
}

bool hs_reference_catmull_clark(hs_reference *r, hs_error *err) {
    for (uint32_t e = 0; e < r->edges; e++)
        if (r->edge[e].f1 == HS_REFERENCE_NONE)
            return hs_fail(err, HS_EXIT_MESH,
                           "reference: the edge from vertex %u to %u is on a boundary; direct "
                           "Catmull-Clark is for closed meshes, use sqrt(2) steps",
                           r->edge[e].v0, r->edge[e].v1);
    const uint32_t vertices = r->vertices;
    if (!compute_points(r, NULL, err) || !add_catmull_clark_vertices(r, err) ||
        !countable(4 * (uint64_t)r->corners, err))
        return false;

    bool ok = true;
    hs_reference_face *quad = resized(NULL, r->corners, sizeof *quad, &ok);
    uint32_t *corner = resized(NULL, 4 * (uint64_t)r->corners, sizeof *corner, &ok);
    if (!ok) {
        free(quad);
        free(corner);
        return no_memory(err);
    }
    uint32_t count = 0;
    for (uint32_t f = 0; f < r->faces; f++) {
        const uint32_t n = r->face[f].v.count;
        for (uint32_t k = 0; k < n; k++, count++) {
            const uint32_t u = face_corner(r, f, k + n - 1), v = face_corner(r, f, k),
                           w = face_corner(r, f, k + 1);
            quad[count] = (hs_reference_face){
                .v = {4 * count, 4}, .forced = r->face[f].forced, .candidate = true};
            corner[4 * count] = v;
            corner[4 * count + 1] = vertices + r->faces + find_edge(r, v, w);
            corner[4 * count + 2] = vertices + f;
            corner[4 * count + 3] = vertices + r->faces + find_edge(r, u, v);
        }
    }
    r->generation += 2;
    return replace_faces(r, quad, count, corner, err);
}
