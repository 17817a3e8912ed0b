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
    if (s->position && s->first && s->origin && s->twin && s->face) return true;
    hs_catmull_clark_free(s);
    return hs_fail(err, HS_EXIT_INTERNAL, "no memory for Catmull-Clark; use fewer levels");
}

void hs_catmull_clark_free(hs_catmull_clark *s) {
    free(s->position);
    free(s->first);
    free(s->origin);
    free(s->twin);
    free(s->face);
    *s = (hs_catmull_clark){0};
}

bool hs_catmull_clark_new(hs_catmull_clark *s, const hs_mesh *mesh, const int32_t (*position)[4],
                          hs_error *err) {
    *s = (hs_catmull_clark){0};
    for (uint32_t h = 0; h < mesh->halfedges; h++)
        if (mesh->twin[h] == HS_BORDER)
            return hs_fail(
                err, HS_EXIT_MESH,
                "half-edge %u is on a boundary; direct Catmull-Clark needs a closed mesh", h);
    s->vertices = mesh->vertices;
    s->faces = mesh->faces;
    s->halfedges = mesh->halfedges;
    if (!allocate(s, err)) return false;
    memcpy(s->position, position, s->vertices * sizeof *s->position);
    memcpy(s->first, mesh->first, (s->faces + (size_t)1) * sizeof *s->first);
    memcpy(s->origin, mesh->origin, s->halfedges * sizeof *s->origin);
    memcpy(s->twin, mesh->twin, s->halfedges * sizeof *s->twin);
    memcpy(s->face, mesh->face, s->halfedges * sizeof *s->face);
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

/* Of the edges that begin with their lower half-edge, in order. edge: per half-edge, its edge. */
static void edge_points(const hs_catmull_clark *s, const int32_t (*face_point)[4],
                        const uint32_t *edge, int32_t (*point)[4]) {
    for (uint32_t h = 0; h < s->halfedges; h++) {
        const uint32_t t = s->twin[h];
        if (t < h) continue;
        const int32_t *v = s->position[s->origin[h]], *w = s->position[s->origin[t]];
        const int32_t *f = face_point[s->face[h]], *g = face_point[s->face[t]];
        for (int k = 0; k < 4; k++)
            point[edge[h]][k] = round_quotient((int64_t)v[k] + w[k] + f[k] + g[k], 4);
    }
}

/* Walks around each vertex once, from whichever of its half-edges comes last. */
static void vertex_points(const hs_catmull_clark *s, const int32_t (*face_point)[4],
                          const uint32_t *leaving, int32_t (*point)[4]) {
    for (uint32_t v = 0; v < s->vertices; v++) {
        int64_t sum[4] = {0}, n = 0;
        uint32_t h = leaving[v];
        do {
            const int32_t *w = s->position[s->origin[s->twin[h]]], *f = face_point[s->face[h]];
            for (int k = 0; k < 4; k++)
                sum[k] += (int64_t)w[k] + f[k];
            n++;
            h = s->twin[prev_of(s, h)];
        } while (h != leaving[v]);
        for (int k = 0; k < 4; k++)
            point[v][k] = round_quotient(sum[k] + n * (n - 2) * s->position[v][k], n * n);
    }
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
        twin[0] = 4 * next_of(s, s->twin[h]) + 3;
        twin[1] = 4 * next + 2;
        twin[2] = 4 * prev + 1;
        twin[3] = 4 * s->twin[prev];
        to->first[h] = 4 * h;
        for (uint32_t i = 0; i < 4; i++)
            to->face[4 * (size_t)h + i] = h;
    }
    to->first[s->halfedges] = to->halfedges;
}

bool hs_catmull_clark_refine(hs_catmull_clark *s, hs_error *err) {
    const uint64_t vertices = (uint64_t)s->vertices + s->faces + s->halfedges / 2;
    if (s->halfedges > UINT32_MAX / 4 || vertices > UINT32_MAX)
        return hs_fail(err, HS_EXIT_INTERNAL, "Catmull-Clark level %u has too many faces",
                       s->level + 1);
    hs_catmull_clark to = {.level = s->level + 1,
                           .vertices = (uint32_t)vertices,
                           .faces = s->halfedges,
                           .halfedges = 4 * s->halfedges};
    uint32_t *edge = malloc(s->halfedges * sizeof *edge);
    uint32_t *leaving = malloc(s->vertices * sizeof *leaving);
    if (!edge || !leaving) {
        free(edge);
        free(leaving);
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for Catmull-Clark; use fewer levels");
    }
    const bool good = allocate(&to, err);
    if (good) {
        uint32_t edges = 0;
        for (uint32_t h = 0; h < s->halfedges; h++) {
            edge[h] = h < s->twin[h] ? edges++ : edge[s->twin[h]];
            leaving[s->origin[h]] = h;
        }
        int32_t(*face_point)[4] = to.position + s->vertices;
        face_points(s, face_point);
        edge_points(s, (const int32_t(*)[4])face_point, edge, face_point + s->faces);
        vertex_points(s, (const int32_t(*)[4])face_point, leaving, to.position);
        corner_quads(s, edge, &to);
        hs_catmull_clark_free(s);
        *s = to;
    }
    free(edge);
    free(leaving);
    return good;
}
