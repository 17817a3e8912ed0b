/* SPDX-License-Identifier: Apache-2.0
 *
 * The paper's records: how they are made of a mesh, copied and freed, and how edges and the lists
 * of neighbours are found anew behind every step. The steps themselves are in reference_step.c.
 */
#include "reference_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- Memory ----------------------------------------------------------------------------------- */

/* The array with room for count items; the old array, and *ok false, if there is no memory. */
void *hs_reference_resized(void *array, uint64_t count, size_t size, bool *ok) {
    void *bigger = realloc(array, (size_t)(count ? count : 1) * size);
    if (bigger) return bigger;
    *ok = false;
    return array;
}

bool hs_reference_no_memory(hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL,
                   "reference: out of memory; refine less deeply or use a smaller mesh");
}

/* Numbers are 32 bits; vertex_edge has two items per corner. */
bool hs_reference_countable(uint64_t count, hs_error *err) {
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

/* --- Neighbours ------------------------------------------------------------------------------- */

uint32_t hs_reference_find_edge(const hs_reference *r, uint32_t v, uint32_t w) {
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

bool hs_reference_connect(hs_reference *r, hs_error *err) {
    bool ok = true;
    RESIZE(r->vertex_face, r->corners, &ok);
    RESIZE(r->vertex_edge, 2 * (uint64_t)r->corners, &ok);
    RESIZE(r->face_face, r->corners, &ok);
    RESIZE(r->edge, r->corners, &ok);
    if (!ok) return hs_reference_no_memory(err);

    reserve_lists(r);
    r->edges = 0;
    for (uint32_t f = 0; f < r->faces; f++) {
        for (uint32_t k = 0; k < r->face[f].v.count; k++) {
            const uint32_t v = hs_reference_corner(r, f, k), w = hs_reference_corner(r, f, k + 1);
            hs_reference_list *around = &r->vertex[v].faces;
            r->vertex_face[around->first + around->count++] = f;
            const uint32_t e = hs_reference_find_edge(r, v, w);
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
            const hs_reference_edge *e = &r->edge[hs_reference_find_edge(
                r, hs_reference_corner(r, f, k), hs_reference_corner(r, f, k + 1))];
            r->face_face[r->face[f].f.first + k] = e->f0 == f ? e->f1 : e->f0;
        }
    }
    return true;
}

/* --- A mesh in the paper's records ------------------------------------------------------------ */

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

/* What is sharp at generation 0, and where the boundary is, if it is refined. In the mode `smooth`
 * a boundary vertex with one face stays for ever. */
static void sharpen(hs_reference *r, const hs_mesh *mesh) {
    for (uint32_t h = 0; mesh->sharpness && h < mesh->halfedges; h++)
        r->edge[hs_reference_find_edge(r, mesh->origin[h], mesh->origin[hs_next(mesh, h)])]
            .sharpness = mesh->sharpness[h];
    for (uint32_t v = 0; mesh->vertex_sharpness && v < r->vertices; v++)
        r->vertex[v].sharpness = mesh->vertex_sharpness[v];
    if (r->boundary == HS_BOUNDARY_KEPT) return;
    for (uint32_t e = 0; e < r->edges; e++) {
        hs_reference_edge *edge = &r->edge[e];
        if (edge->f1 != HS_REFERENCE_NONE) continue;
        edge->boundary = true;
        edge->sharpness = HS_SHARP_INFINITE;
        const uint32_t end[2] = {edge->v0, edge->v1};
        for (int i = 0; i < 2; i++)
            if (r->boundary == HS_BOUNDARY_SMOOTH && r->vertex[end[i]].faces.count == 1)
                r->vertex[end[i]].sharpness = HS_SHARP_INFINITE;
    }
}

bool hs_reference_new(hs_reference *r, const hs_mesh *mesh, const double matrix[16],
                      hs_boundary boundary, hs_error *err) {
    memset(r, 0, sizeof *r);
    r->boundary = boundary;
    bool ok = true;
    RESIZE(r->vertex, mesh->vertices, &ok);
    RESIZE(r->face, mesh->faces, &ok);
    RESIZE(r->face_vertex, mesh->halfedges, &ok);
    if (!ok || !hs_reference_countable(mesh->halfedges, err)) {
        hs_reference_free(r);
        return ok ? false : hs_reference_no_memory(err);
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
    if (hs_reference_connect(r, err)) {
        sharpen(r, mesh);
        return true;
    }
    hs_reference_free(r);
    return false;
}

static void *duplicate(const void *array, uint64_t count, size_t size, bool *ok) {
    void *copy = hs_reference_resized(NULL, count, size, ok);
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
    return hs_reference_no_memory(err);
}
