/* SPDX-License-Identifier: Apache-2.0
 *
 * Two ways to split some faces of a mesh and leave the others alone, side by side: how fast does
 * the number of faces grow?
 *
 *   dyadic   Every edge of a face is halved: a triangle becomes 4 triangles, an n-gon n quads
 * around its middle. A neighbour that is not split now has a vertex in the middle of a side; so
 *            that there is no crack it falls into a fan around that vertex.
 *   face     A step of this scheme: the face's point is joined to its vertices. Edges of neighbours
 *            stay as they are, so neighbours stay as they are.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "figure_parts.h"

/* What stands for a face's generation here, so that its colour tells what happened to it. */
enum { WHOLE, TORN, SPLIT, PALETTE = 4 };

/* --- The dyadic split --------------------------------------------------------------------------
 */

typedef struct dyadic {
    uint32_t vertices, faces;
    double *position; /* 4 per vertex */
    uint32_t *first;  /* faces + 1 */
    uint32_t *corner; /* first[faces] */
    uint8_t *generation;
    uint32_t *halfway; /* per half-edge of the mesh: the vertex in its middle, or HS_BORDER */
} dyadic;

static void free_dyadic(dyadic *d) {
    free(d->position);
    free(d->first);
    free(d->corner);
    free(d->generation);
    free(d->halfway);
}

/* A half-edge gives at most a vertex and a middle's share of one, two faces, and six corners. */
static bool make_room(dyadic *d, const hs_mesh *m) {
    const size_t sides = m->halfedges;
    d->position = malloc(4 * (m->vertices + m->faces + sides) * sizeof *d->position);
    d->first = malloc((2 * sides + 1) * sizeof *d->first);
    d->corner = malloc(6 * sides * sizeof *d->corner);
    d->generation = malloc(2 * sides);
    d->halfway = malloc(sides * sizeof *d->halfway);
    return d->position && d->first && d->corner && d->generation && d->halfway;
}

/* The mean of some vertices, as a new vertex. */
static uint32_t add_mean(dyadic *d, const uint32_t *vertex, uint32_t count) {
    double *mean = &d->position[4 * (size_t)d->vertices];
    for (uint32_t k = 0; k < 4; k++) {
        mean[k] = 0;
        for (uint32_t i = 0; i < count; i++)
            mean[k] += d->position[4 * (size_t)vertex[i] + k] / count;
    }
    return d->vertices++;
}

static void add_face(dyadic *d, const uint32_t *corner, uint32_t sides, uint8_t generation) {
    memcpy(&d->corner[d->first[d->faces]], corner, sides * sizeof *corner);
    d->generation[d->faces++] = generation;
    d->first[d->faces] = d->first[d->faces - 1] + sides;
}

static void split_marked(dyadic *d, const hs_mesh *m, uint32_t face) {
    const uint32_t begin = m->first[face], sides = hs_sides(m, face);
    const bool triangle = sides == 3;
    uint32_t middle = triangle ? 0 : add_mean(d, &m->origin[begin], sides);
    for (uint32_t h = begin; h < begin + sides; h++) {
        const uint32_t before = d->halfway[hs_prev(m, h)], behind = d->halfway[h];
        add_face(d, (const uint32_t[]){before, m->origin[h], behind, middle}, triangle ? 3 : 4,
                 SPLIT);
    }
    if (triangle) add_face(d, &d->halfway[begin], 3, SPLIT);
}

static void split_neighbour(dyadic *d, const hs_mesh *m, uint32_t face) {
    uint32_t ring[2 * HS_MAX_SIDES] = {0}, count = 0, hub = HS_BORDER;
    for (uint32_t h = m->first[face]; h < m->first[face + 1]; h++) {
        ring[count++] = m->origin[h];
        if (d->halfway[h] == HS_BORDER) continue;
        if (hub == HS_BORDER) hub = count;
        ring[count++] = d->halfway[h];
    }
    if (hub == HS_BORDER) {
        add_face(d, ring, count, WHOLE);
        return;
    }
    for (uint32_t i = 1; i + 1 < count; i++)
        add_face(
            d, (const uint32_t[]){ring[hub], ring[(hub + i) % count], ring[(hub + i + 1) % count]},
            3, TORN);
}

static bool split_dyadic(dyadic *d, const hs_mesh *m, const uint8_t *marked, hs_error *err) {
    *d = (dyadic){.vertices = m->vertices};
    if (!make_room(d, m)) {
        free_dyadic(d);
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory to split faces");
    }
    for (size_t i = 0; i < 4 * (size_t)m->vertices; i++)
        d->position[i] = (double)m->position[i];
    d->first[0] = 0;
    for (uint32_t h = 0; h < m->halfedges; h++) {
        const uint32_t t = m->twin[h];
        if (t != HS_BORDER && t < h) {
            d->halfway[h] = d->halfway[t];
            continue;
        }
        const bool halved = marked[m->face[h]] || (t != HS_BORDER && marked[m->face[t]]);
        const uint32_t end[2] = {m->origin[h], m->origin[hs_next(m, h)]};
        d->halfway[h] = halved ? add_mean(d, end, 2) : HS_BORDER;
    }
    for (uint32_t f = 0; f < m->faces; f++)
        if (marked[f])
            split_marked(d, m, f);
        else
            split_neighbour(d, m, f);
    return true;
}

/* --- The figure --------------------------------------------------------------------------------
 */

/* The face whose corners' mean is nearest to the middle of the screen. */
static uint32_t face_in_the_middle(const hs_surface *surface) {
    uint32_t best = 0;
    double least = INFINITY;
    for (uint32_t f = 0; f < surface->faces; f++) {
        double mean[4] = {0};
        for (uint32_t i = surface->first[f]; i < surface->first[f + 1]; i++)
            for (uint32_t k = 0; k < 4; k++)
                mean[k] += (double)surface->clip[4 * (size_t)surface->corner[i] + k];
        const bool back = surface->facing[f] == HS_FACING_BACK;
        const double distance = hypot(mean[0], mean[1]) / mean[3];
        if (back || !(mean[3] > 0) || distance >= least) continue;
        least = distance;
        best = f;
    }
    return best;
}

static bool show_dyadic(hs_picture *picture, hs_renderer *renderer, const hs_mesh *mesh,
                        const hs_style *style, const hs_figure_source *source, hs_error *err) {
    dyadic d;
    if (!split_dyadic(&d, mesh, mesh->forced, err)) return false;
    const hs_faces faces = {.vertices = d.vertices,
                            .faces = d.faces,
                            .position = d.position,
                            .first = d.first,
                            .corner = d.corner,
                            .generation = d.generation};
    hs_surface surface = {0};
    const bool done =
        hs_surface_of_faces(&surface, &faces, source->matrix, err) &&
        hs_figure_show(picture, "dyadic split", renderer, &surface, style, source, err);
    hs_surface_free(&surface);
    free_dyadic(&d);
    return done;
}

/* Colours what the step made: triangles at kept edges leave in the place of their face and in the
 * order of its sides, quads between two split faces behind all that was there. */
static void mark_split(hs_surface *surface, const hs_mesh *mesh) {
    uint32_t at = 0;
    for (uint32_t f = 0; f < mesh->faces; f++)
        if (!mesh->forced[f])
            at++;
        else
            for (uint32_t h = mesh->first[f]; h < mesh->first[f + 1]; h++)
                if (mesh->twin[h] == HS_BORDER || !mesh->forced[mesh->face[mesh->twin[h]]])
                    surface->generation[at++] = SPLIT;
    while (at < surface->faces)
        surface->generation[at++] = SPLIT;
}

static bool show_face_split(hs_picture *picture, hs_renderer *renderer, const hs_mesh *mesh,
                            const hs_style *style, const hs_figure_source *source, hs_error *err) {
    const hs_settings step = {.boundary = HS_BOUNDARY_KEPT}; /* what is forced, and no guard */
    hs_output output = {0};
    hs_surface surface = {0};
    bool done = hs_figure_refine(&output, mesh, &step, source, err) &&
                hs_surface_of_output(&surface, &output, source->matrix, err);
    if (done && output.status == HS_STATUS_OK) mark_split(&surface, mesh);
    done = done && hs_figure_show(picture, "face split", renderer, &surface, style, source, err);
    hs_surface_free(&surface);
    hs_output_free(&output);
    return done;
}

bool hs_figure_splits(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                      hs_error *err) {
    enum { PANELS = 3 };
    static const hs_style style = {.paint = HS_PAINT_DEPTH, .wires = true, .deepest = PALETTE};
    hs_picture picture[PANELS] = {{0}};
    hs_surface initial = {0};
    hs_mesh mesh = *source->mesh; /* but for its forced depths */
    mesh.forced = calloc(mesh.faces, 1);
    bool done = mesh.forced ? hs_surface_of_mesh(&initial, &mesh, source->matrix, err)
                            : hs_fail(err, HS_EXIT_INTERNAL, "no memory to mark faces");
    if (done && !source->forced) mesh.forced[face_in_the_middle(&initial)] = 1;
    for (uint32_t f = 0; done && source->forced && f < mesh.faces; f++)
        mesh.forced[f] = source->mesh->forced[f] > 0;
    done = done &&
           hs_figure_show(&picture[0], "initial mesh", renderer, &initial, &style, source, err) &&
           show_dyadic(&picture[1], renderer, &mesh, &style, source, err) &&
           show_face_split(&picture[2], renderer, &mesh, &style, source, err);
    if (done && renderer) done = hs_figure_sheet(sheet, picture, PANELS, source, err);
    for (int i = 0; i < PANELS; i++)
        hs_picture_free(&picture[i]);
    hs_surface_free(&initial);
    free(mesh.forced);
    return done;
}
