/* SPDX-License-Identifier: Apache-2.0 */
#include "mesh_info.h"

#include <stdlib.h>
#include <string.h>

static bool is_border(const hs_mesh *mesh, uint32_t h) {
    return mesh->twin[h] == (uint32_t)HS_BORDER;
}

/* --- Counts and extent ----------------------------------------------------------------------- */

static void count_edges(hs_mesh_info *info, const hs_mesh *mesh) {
    for (uint32_t h = 0; h < mesh->halfedges; h++) {
        info->boundary_edges += is_border(mesh, h);
        info->edges += is_border(mesh, h) || h < mesh->twin[h];
    }
    info->euler = (int32_t)info->vertices - (int32_t)info->edges + (int32_t)info->faces;
}

static void measure_box(hs_mesh_info *info, const hs_mesh *mesh) {
    for (uint32_t v = 0; v < mesh->vertices; v++)
        for (uint32_t i = 0; i < 4; i++) {
            float c = mesh->position[4 * (size_t)v + i];
            if (v == 0 || c < info->lowest[i]) info->lowest[i] = c;
            if (v == 0 || c > info->highest[i]) info->highest[i] = c;
        }
}

/* valence and on_boundary: zeroed scratch, one per vertex. */
static void count_valences(hs_mesh_info *info, const hs_mesh *mesh, uint8_t *valence,
                           uint8_t *on_boundary) {
    for (uint32_t h = 0; h < mesh->halfedges; h++) {
        uint32_t v = mesh->origin[h];
        valence[v]++;
        if (is_border(mesh, h))
            on_boundary[v] = 1; /* one border half-edge leaves each boundary vertex */
    }
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        info->valence[valence[v]]++;
        info->boundary_valence[valence[v]] += on_boundary[v];
    }
}

/* --- Topology -------------------------------------------------------------------------------- */

/* The border half-edge that goes on where border half-edge h ends: turn around that vertex, face
 * by face, until there is no neighbour any more. */
static uint32_t next_border(const hs_mesh *mesh, uint32_t h) {
    h = hs_next(mesh, h);
    while (!is_border(mesh, h))
        h = hs_next(mesh, mesh->twin[h]);
    return h;
}

/* seen: zeroed scratch, one per half-edge. */
static uint32_t count_loops(const hs_mesh *mesh, uint8_t *seen) {
    uint32_t loops = 0;
    for (uint32_t start = 0; start < mesh->halfedges; start++) {
        if (!is_border(mesh, start) || seen[start]) continue;
        loops++;
        for (uint32_t h = start; !seen[h]; h = next_border(mesh, h))
            seen[h] = 1;
    }
    return loops;
}

/* Floods the faces; seen (zeroed) and waiting: scratch, one per face. */
static uint32_t count_components(const hs_mesh *mesh, uint8_t *seen, uint32_t *waiting) {
    uint32_t components = 0;
    for (uint32_t start = 0; start < mesh->faces; start++) {
        if (seen[start]) continue;
        components++;
        uint32_t count = 0;
        seen[start] = 1;
        waiting[count++] = start;
        while (count > 0) {
            uint32_t f = waiting[--count];
            for (uint32_t h = mesh->first[f]; h < mesh->first[f + 1]; h++) {
                if (is_border(mesh, h)) continue;
                uint32_t g = mesh->face[mesh->twin[h]];
                if (!seen[g]) {
                    seen[g] = 1;
                    waiting[count++] = g;
                }
            }
        }
    }
    return components;
}

static void count_sharp(hs_mesh_info *info, const hs_mesh *mesh) {
    for (uint32_t h = 0; mesh->sharpness && h < mesh->halfedges; h++)
        if (mesh->sharpness[h] && (is_border(mesh, h) || h < mesh->twin[h]))
            info->creases[mesh->sharpness[h]]++;
    for (uint32_t v = 0; mesh->vertex_sharpness && v < mesh->vertices; v++)
        if (mesh->vertex_sharpness[v]) info->corners[mesh->vertex_sharpness[v]]++;
}

bool hs_mesh_measure(hs_mesh_info *info, const hs_mesh *mesh, hs_error *err) {
    memset(info, 0, sizeof *info);
    uint8_t *valence = calloc(mesh->vertices + (size_t)1, 1);
    uint8_t *on_boundary = calloc(mesh->vertices + (size_t)1, 1);
    uint8_t *border_seen = calloc(mesh->halfedges + (size_t)1, 1);
    uint8_t *face_seen = calloc(mesh->faces + (size_t)1, 1);
    uint32_t *waiting = calloc(mesh->faces + (size_t)1, sizeof *waiting);
    bool good = valence != NULL && on_boundary != NULL && border_seen != NULL &&
                face_seen != NULL && waiting != NULL;
    if (good) {
        info->vertices = mesh->vertices;
        info->faces = mesh->faces;
        for (uint32_t f = 0; f < mesh->faces; f++)
            info->sides[hs_sides(mesh, f)]++;
        count_edges(info, mesh);
        count_sharp(info, mesh);
        measure_box(info, mesh);
        count_valences(info, mesh, valence, on_boundary);
        info->boundary_loops = count_loops(mesh, border_seen);
        info->components = count_components(mesh, face_seen, waiting);
    } else {
        hs_fail(err, HS_EXIT_INTERNAL, "out of memory while measuring the mesh; use a smaller one");
    }
    free(valence);
    free(on_boundary);
    free(border_seen);
    free(face_seen);
    free(waiting);
    return good;
}
