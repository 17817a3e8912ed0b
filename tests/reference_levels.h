/* SPDX-License-Identifier: Apache-2.0
 *
 * The reference beside OpenSubdiv, level by level. Which vertex of the one is which of the other
 * comes from the topology alone: both number old vertices, face points and edge points in the order
 * of the coarse mesh's vertices, faces and edges, of which each has an order of its own.
 */
#ifndef HS_TESTS_REFERENCE_LEVELS_H
#define HS_TESTS_REFERENCE_LEVELS_H

#include "osd.h"
#include "reference_samples.h"

/* The modes in which the boundary is refined. */
static const hs_boundary refined_modes[] = {HS_BOUNDARY_SMOOTH, HS_BOUNDARY_EDGE_ONLY};

static inline enum osd_boundary osd_mode(hs_boundary boundary) {
    return boundary == HS_BOUNDARY_SMOOTH ? OSD_BOUNDARY_EDGE_AND_CORNER : OSD_BOUNDARY_EDGE_ONLY;
}

/* --- Correspondence --------------------------------------------------------------------------- */

static inline uint32_t find_row(const row *rows, uint32_t count, row wanted, const char *what) {
    const row *found = bsearch(&wanted, rows, count, sizeof *rows, by_key);
    if (!found)
        fail_msg("OpenSubdiv has no %s %u %u %u %u", what, wanted.key[0], wanted.key[1],
                 wanted.key[2], wanted.key[3]);
    return found ? found->value : 0;
}

static inline row edge_row(uint32_t v, uint32_t w, uint32_t value) {
    return (row){{v < w ? v : w, v < w ? w : v, 0, 0}, value};
}

/* A quad, turned so that its least vertex is first: orientation matters, the start doesn't. */
static inline row quad_row(const uint32_t v[4], uint32_t value) {
    unsigned least = 0;
    for (unsigned k = 1; k < 4; k++)
        if (v[k] < v[least]) least = k;
    return (row){{v[least], v[(least + 1) % 4], v[(least + 2) % 4], v[(least + 3) % 4]}, value};
}

/* Which of OpenSubdiv's vertices and faces are the reference's. */
typedef struct {
    uint32_t *vertex, *face;
} correspondence;

static inline uint32_t *new_numbers(uint32_t count) {
    uint32_t *numbers = malloc((count + 1u) * sizeof *numbers);
    assert_non_null(numbers);
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = i;
    return numbers;
}

/* From a level to the next. Either way of refinement numbers old vertices, face points, edge
 * points in the order of the coarse mesh's vertices, faces, edges. */
static inline void descend(correspondence *c, const hs_reference *coarse, const hs_reference *fine,
                           const osd_level *level) {
    row *edges = new_rows(level->edges);
    for (uint32_t e = 0; e < level->edges; e++)
        edges[e] = edge_row(level->edge[2 * e], level->edge[2 * e + 1], e);
    qsort(edges, level->edges, sizeof *edges, by_key);

    assert_int_equal(fine->vertices, coarse->vertices + coarse->faces + coarse->edges);
    uint32_t *vertex = new_numbers(fine->vertices), count = 0;
    for (uint32_t v = 0; v < coarse->vertices; v++)
        vertex[count++] = level->vertex_child[c->vertex[v]];
    for (uint32_t f = 0; f < coarse->faces; f++)
        vertex[count++] = level->face_child[c->face[f]];
    for (uint32_t e = 0; e < coarse->edges; e++) {
        const row wanted =
            edge_row(c->vertex[coarse->edge[e].v0], c->vertex[coarse->edge[e].v1], 0);
        vertex[count++] = level->edge_child[find_row(edges, level->edges, wanted, "edge")];
    }
    free(edges);
    free(c->vertex);
    c->vertex = vertex;

    const osd_level *next = level + 1;
    row *quads = new_rows(next->faces);
    for (uint32_t f = 0; f < next->faces; f++)
        quads[f] = quad_row(next->corner + next->first[f], f);
    qsort(quads, next->faces, sizeof *quads, by_key);
    free(c->face);
    c->face = new_numbers(fine->faces);
    for (uint32_t f = 0; f < fine->faces; f++) {
        uint32_t corner[4];
        for (uint32_t k = 0; k < 4; k++)
            corner[k] = vertex[fine->face_vertex[fine->face[f].v.first + k]];
        c->face[f] = find_row(quads, next->faces, quad_row(corner, 0), "quad");
    }
    free(quads);
}

/* The longest side of the bounding box. */
static inline double box_size(const hs_reference *r) {
    double size = 0;
    for (int i = 0; i < 4; i++) {
        double low = INFINITY, high = -INFINITY;
        for (uint32_t v = 0; v < r->vertices; v++) {
            low = fmin(low, r->vertex[v].position[i]);
            high = fmax(high, r->vertex[v].position[i]);
        }
        size = fmax(size, high - low);
    }
    return size;
}

/* Largest difference of a component. */
static inline double distance(const hs_reference *r, const osd_level *level,
                              const uint32_t *vertex) {
    double largest = 0;
    assert_int_equal(r->vertices, level->vertices);
    for (uint32_t v = 0; v < r->vertices; v++)
        for (int i = 0; i < 4; i++) {
            const double here = r->vertex[v].position[i],
                         there = level->position[4 * (size_t)vertex[v] + (size_t)i];
            if (!(fabs(here - there) <= largest)) largest = fabs(here - there);
        }
    return largest;
}

/* --- A level ---------------------------------------------------------------------------------- */

typedef void refine_level(hs_reference *r);

static inline void two_steps(hs_reference *r) {
    step(r, NULL);
    step(r, NULL);
}

static inline void one_level(hs_reference *r) {
    hs_error err;
    if (!hs_reference_catmull_clark(r, &err)) fail_msg("%s", err.text);
}

/* One level more, and the correspondence with it. */
static inline void follow(hs_reference *fine, const osd_surface *surface, uint32_t level,
                          correspondence *c, refine_level *refine) {
    hs_reference coarse;
    hs_error err;
    if (!hs_reference_copy(&coarse, fine, &err)) fail_msg("%s", err.text);
    refine(fine);
    descend(c, &coarse, fine, &surface->level[level]);
    hs_reference_free(&coarse);
}

/* Distance relative to the bounding box, the worst of levels 1 to `levels`. */
static inline double compare_with_opensubdiv(const hs_mesh *mesh, hs_boundary boundary,
                                             uint32_t levels, refine_level *refine) {
    double matrix[16], worst = 0;
    matrix_in_double(matrix);
    hs_reference fine = new_reference(mesh, matrix, boundary);
    const double size = box_size(&fine);
    osd_surface surface;
    hs_error err;
    if (!osd_refine(&surface, mesh, matrix, levels, osd_mode(boundary), &err))
        fail_msg("%s", err.text);
    correspondence c = {new_numbers(mesh->vertices), new_numbers(mesh->faces)};
    for (uint32_t l = 0; l < levels; l++) {
        follow(&fine, &surface, l, &c, refine);
        worst = fmax(worst, distance(&fine, &surface.level[l + 1], c.vertex) / size);
    }
    hs_reference_free(&fine);
    osd_free(&surface);
    free(c.vertex);
    free(c.face);
    return worst;
}

#endif
