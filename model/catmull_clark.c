/* SPDX-License-Identifier: Apache-2.0
 *
 * Direct Catmull-Clark in integers:
 *   1. number the edges;
 *   2. face points, edge points, vertex points;
 *   3. a quad for every corner.
 */
#include "catmull_clark.h"

#include <stdlib.h>
#include <string.h>

/* RNE(x / d), d > 0: the floor, and one more when the rest is above half, or half of an odd one. */
static int32_t round_quotient(int64_t x, int64_t d) {
    const int64_t toward_zero = x / d, floor = toward_zero - (x - toward_zero * d < 0);
    const int64_t rest = 2 * (x - floor * d);
    return (int32_t)(floor + (rest > d || (rest == d && floor % 2 != 0)));
}

static uint32_t next_of(const hs_catmull_clark *s, uint32_t h) {
    const uint32_t f = s->face[h];
    return h + 1 == s->first[f + 1] ? s->first[f] : h + 1;
}

static uint32_t prev_of(const hs_catmull_clark *s, uint32_t h) {
    const uint32_t f = s->face[h];
    return h == s->first[f] ? s->first[f + 1] - 1 : h - 1;
}

/* --- A surface's memory ------------------------------------------------------------------------
 */

static bool allocate(hs_catmull_clark *s, hs_error *err) {
    s->position = malloc(s->vertices * sizeof *s->position);
    s->first = malloc((s->faces + (size_t)1) * sizeof *s->first);
    s->origin = malloc(s->halfedges * sizeof *s->origin);
    s->twin = malloc(s->halfedges * sizeof *s->twin);
    s->face = malloc(s->halfedges * sizeof *s->face);
    s->edge_sharpness = calloc(s->halfedges, 1);
    s->vertex_sharpness = calloc(s->vertices, 1);
    if (s->position && s->first && s->origin && s->twin && s->face && s->edge_sharpness &&
        s->vertex_sharpness)
        return true;
    hs_catmull_clark_free(s);
    return hs_fail(err, HS_EXIT_INTERNAL, "no memory for Catmull-Clark; use fewer levels");
}

void hs_catmull_clark_free(hs_catmull_clark *s) {
    free(s->position);
    free(s->first);
    free(s->origin);
    free(s->twin);
    free(s->face);
    free(s->edge_sharpness);
    free(s->vertex_sharpness);
    *s = (hs_catmull_clark){0};
}

/* Boundary edges are sharp for ever; with corners, boundary vertices of one face are, too. */
static void sharpen_boundary(hs_catmull_clark *s, bool corners) {
    for (uint32_t h = 0; h < s->halfedges; h++) {
        if (s->twin[h] != HS_BORDER) continue;
        s->edge_sharpness[h] = HS_SHARP_INFINITE;
        if (corners && s->twin[prev_of(s, h)] == HS_BORDER)
            s->vertex_sharpness[s->origin[h]] = HS_SHARP_INFINITE;
    }
}

bool hs_catmull_clark_new(hs_catmull_clark *s, const hs_mesh *mesh, const int32_t (*position)[4],
                          hs_boundary boundary, hs_error *err) {
    *s = (hs_catmull_clark){0};
    for (uint32_t h = 0; h < mesh->halfedges; h++)
        if (mesh->twin[h] == HS_BORDER && boundary == HS_BOUNDARY_KEPT)
            return hs_fail(err, HS_EXIT_MESH,
                           "half-edge %u is on a boundary, and Catmull-Clark keeps none", h);
    s->vertices = mesh->vertices;
    s->faces = mesh->faces;
    s->halfedges = mesh->halfedges;
    if (!allocate(s, err)) return false;
    memcpy(s->position, position, s->vertices * sizeof *s->position);
    memcpy(s->first, mesh->first, (s->faces + (size_t)1) * sizeof *s->first);
    memcpy(s->origin, mesh->origin, s->halfedges * sizeof *s->origin);
    memcpy(s->twin, mesh->twin, s->halfedges * sizeof *s->twin);
    memcpy(s->face, mesh->face, s->halfedges * sizeof *s->face);
    if (mesh->sharpness) memcpy(s->edge_sharpness, mesh->sharpness, s->halfedges);
    if (mesh->vertex_sharpness) memcpy(s->vertex_sharpness, mesh->vertex_sharpness, s->vertices);
    sharpen_boundary(s, boundary == HS_BOUNDARY_SMOOTH);
    return true;
}

/* --- One level ---------------------------------------------------------------------------------
 */

static void face_points(const hs_catmull_clark *s, int32_t (*point)[4]) {
    for (uint32_t f = 0; f < s->faces; f++) {
        int64_t sum[4] = {0};
        for (uint32_t h = s->first[f]; h < s->first[f + 1]; h++)
            for (int k = 0; k < 4; k++)
                sum[k] += s->position[s->origin[h]][k];
        for (int k = 0; k < 4; k++)
            point[f][k] = round_quotient(sum[k], s->first[f + 1] - s->first[f]);
    }
}

static void set_rounded(int32_t point[4], const int64_t sum[4], int64_t divisor) {
    for (int k = 0; k < 4; k++)
        point[k] = round_quotient(sum[k], divisor);
}

/* Of the edges that begin with their lower half-edge, in order. edge: per half-edge, its edge. */
static void edge_points(const hs_catmull_clark *s, const int32_t (*face_point)[4],
                        const uint32_t *edge, int32_t (*point)[4]) {
    for (uint32_t h = 0; h < s->halfedges; h++) {
        const uint32_t t = s->twin[h];
        if (t < h) continue;
        const int32_t *v = s->position[s->origin[h]], *w = s->position[s->origin[next_of(s, h)]];
        const bool sharp = s->edge_sharpness[h] > 0;
        int64_t sum[4];
        for (int k = 0; k < 4; k++) {
            sum[k] = (int64_t)v[k] + w[k];
            if (!sharp) sum[k] += (int64_t)face_point[s->face[h]][k] + face_point[s->face[t]][k];
        }
        set_rounded(point[edge[h]], sum, sharp ? 2 : 4);
    }
}

/* What surrounds a vertex. */
typedef struct surroundings {
    int64_t ring[4];   /* neighbours and face points of its n faces */
    int64_t crease[4]; /* far ends of its sharp edges */
    int64_t n;
    uint32_t sharp; /* edges */
} surroundings;

static void meet_sharp_edge(surroundings *at, const int32_t far[4]) {
    at->sharp++;
    for (int k = 0; k < 4; k++)
        at->crease[k] += far[k];
}

static void survey(const hs_catmull_clark *s, const int32_t (*face_point)[4], surroundings *at) {
    for (uint32_t h = 0; h < s->halfedges; h++) {
        const uint32_t v = s->origin[h], w = s->origin[next_of(s, h)];
        for (int k = 0; k < 4; k++)
            at[v].ring[k] += (int64_t)s->position[w][k] + face_point[s->face[h]][k];
        at[v].n++;
        if (s->edge_sharpness[h] == 0 || s->twin[h] < h) continue;
        meet_sharp_edge(&at[v], s->position[w]);
        meet_sharp_edge(&at[w], s->position[v]);
    }
}

static void vertex_points(const hs_catmull_clark *s, const surroundings *at, int32_t (*point)[4]) {
    for (uint32_t v = 0; v < s->vertices; v++) {
        const int32_t *old = s->position[v];
        const int64_t n = at[v].n;
        int64_t sum[4];
        if (at[v].sharp > 2 || s->vertex_sharpness[v] > 0) {
            memcpy(point[v], old, sizeof point[v]);
        } else if (at[v].sharp == 2) {
            for (int k = 0; k < 4; k++)
                sum[k] = at[v].crease[k] + 6 * (int64_t)old[k];
            set_rounded(point[v], sum, 8);
        } else {
            for (int k = 0; k < 4; k++)
                sum[k] = at[v].ring[k] + n * (n - 2) * old[k];
            set_rounded(point[v], sum, n * n);
        }
    }
}

static uint8_t worn(uint8_t sharpness) {
    return (uint8_t)(sharpness == 0 || sharpness == HS_SHARP_INFINITE ? sharpness : sharpness - 1);
}

/* Of h's half at its origin, and of prev's half at its end: the same half of the edge, seen from
 * the face beyond; catmull_clark.h has the picture. */
static uint32_t twin_of_start(const hs_catmull_clark *s, uint32_t h) {
    return s->twin[h] == HS_BORDER ? HS_BORDER : 4 * next_of(s, s->twin[h]) + 3;
}

static uint32_t twin_of_end(const hs_catmull_clark *s, uint32_t prev) {
    return s->twin[prev] == HS_BORDER ? HS_BORDER : 4 * s->twin[prev];
}

/* The quad (v, E, F, E') of every corner. */
static void corner_quads(const hs_catmull_clark *s, const uint32_t *edge, hs_catmull_clark *to) {
    const uint32_t first_face = s->vertices, first_edge = s->vertices + s->faces;
    for (uint32_t h = 0; h < s->halfedges; h++) {
        const uint32_t next = next_of(s, h), prev = prev_of(s, h);
        uint32_t *origin = to->origin + 4 * (size_t)h, *twin = to->twin + 4 * (size_t)h;
        origin[0] = s->origin[h];
        origin[1] = first_edge + edge[h];
        origin[2] = first_face + s->face[h];
        origin[3] = first_edge + edge[prev];
        twin[0] = twin_of_start(s, h);
        twin[1] = 4 * next + 2;
        twin[2] = 4 * prev + 1;
        twin[3] = twin_of_end(s, prev);
        to->edge_sharpness[4 * (size_t)h] = worn(s->edge_sharpness[h]);
        to->edge_sharpness[4 * (size_t)h + 3] = worn(s->edge_sharpness[prev]);
        to->first[h] = 4 * h;
        for (uint32_t i = 0; i < 4; i++)
            to->face[4 * (size_t)h + i] = h;
    }
    to->first[s->halfedges] = to->halfedges;
    for (uint32_t v = 0; v < s->vertices; v++)
        to->vertex_sharpness[v] = worn(s->vertex_sharpness[v]);
}

/* Gives each half-edge the number of its edge, and how many there are. */
static uint32_t number_edges(const hs_catmull_clark *s, uint32_t *edge) {
    uint32_t edges = 0;
    for (uint32_t h = 0; h < s->halfedges; h++)
        edge[h] = s->twin[h] < h ? edge[s->twin[h]] : edges++;
    return edges;
}

bool hs_catmull_clark_refine(hs_catmull_clark *s, hs_error *err) {
    uint32_t *edge = malloc(s->halfedges * sizeof *edge);
    surroundings *at = calloc(s->vertices, sizeof *at);
    if (!edge || !at) {
        free(edge);
        free(at);
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for Catmull-Clark; use fewer levels");
    }
    const uint64_t vertices = (uint64_t)s->vertices + s->faces + number_edges(s, edge);
    hs_catmull_clark to = {.level = s->level + 1,
                           .vertices = (uint32_t)vertices,
                           .faces = s->halfedges,
                           .halfedges = 4 * s->halfedges};
    const bool small = s->halfedges <= UINT32_MAX / 4 && vertices <= UINT32_MAX;
    const bool good = small ? allocate(&to, err)
                            : hs_fail(err, HS_EXIT_INTERNAL,
                                      "Catmull-Clark level %u has too many faces", s->level + 1);
    if (good) {
        int32_t(*face_point)[4] = to.position + s->vertices;
        face_points(s, face_point);
        edge_points(s, (const int32_t(*)[4])face_point, edge, face_point + s->faces);
        survey(s, (const int32_t(*)[4])face_point, at);
        vertex_points(s, at, to.position);
        corner_quads(s, edge, &to);
        hs_catmull_clark_free(s);
        *s = to;
    }
    free(edge);
    free(at);
    return good;
}
