/* SPDX-License-Identifier: Apache-2.0
 *
 * From a face list to half-edges, in five steps:
 *   1. check what can be seen face by face: sides, indices, repeated vertices, valence;
 *   2. drop the vertices that no face uses, renumber the others, lay the half-edges out;
 *   3. sort the half-edges by the vertex that they leave (by counting);
 *   4. pair: the twin of u->v is the half-edge v->u among those that leave v;
 *   5. check that the faces around every vertex are one fan;
 *   6. make tagged edges and vertices sharp.
 * Every half-edge leaves one vertex and arrives at one, so steps 3 to 5 are O(half-edges).
 */
#include "mesh.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT_LIMIT = 1 << HS_INDEX_BITS };

typedef struct builder {
    const hs_soup *soup;
    hs_mesh *mesh;
    hs_error *err;
    uint32_t *face_mark; /* per soup vertex: 1 + the last face seen to use it, or 0 */
    uint32_t *valence;   /* per soup vertex: faces that use it */
    uint32_t *number;    /* per soup vertex: its number in the mesh */
    uint32_t *original;  /* per mesh vertex: its number in the soup */
    uint32_t *fan;       /* vertices + 1: where in leaving a vertex's half-edges begin */
    uint32_t *leaving;   /* half-edges, sorted by origin */
    uint32_t *towards;   /* per vertex w: the half-edge v->w, if towards_mark[w] is v + 1 */
    uint32_t *towards_mark;
} builder;

/* --- Messages -------------------------------------------------------------------------------- */

/* Fails with "name:line: " (the line, 0 if not known, is of the file) in front of the message. */
__attribute__((format(printf, 3, 4))) static bool fail_at(builder *b, uint32_t line,
                                                          const char *format, ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    /* A long name is cut, so that the cause isn't. */
    if (line == 0) return hs_fail(b->err, HS_EXIT_MESH, "%.180s: %s", b->soup->name, text);
    return hs_fail(b->err, HS_EXIT_MESH, "%.180s:%u: %s", b->soup->name, line, text);
}

static uint32_t line_of_face(const builder *b, uint32_t face) {
    return b->soup->face_line != NULL ? b->soup->face_line[face] : 0;
}

static uint32_t line_of_vertex(const builder *b, uint32_t vertex) {
    return b->soup->vertex_line != NULL ? b->soup->vertex_line[vertex] : 0;
}

typedef struct label {
    char text[48];
} label;

/* "face 12 (line 40)"; people count from 1. */
static label face_label(const builder *b, uint32_t face) {
    label name;
    uint32_t line = line_of_face(b, face);
    if (line == 0)
        snprintf(name.text, sizeof name.text, "face %u", face + 1);
    else
        snprintf(name.text, sizeof name.text, "face %u (line %u)", face + 1, line);
    return name;
}

/* --- Memory ---------------------------------------------------------------------------------- */

static void *allocate(size_t count, size_t size) {
    return calloc(count + 1, size); /* never 0 bytes, for which NULL would be no error */
}

static bool exhausted(builder *b) {
    return hs_fail(b->err, HS_EXIT_INTERNAL, "%.180s: out of memory; use a smaller mesh",
                   b->soup->name);
}

static void free_builder(builder *b) {
    free(b->face_mark);
    free(b->valence);
    free(b->number);
    free(b->original);
    free(b->fan);
    free(b->leaving);
    free(b->towards);
    free(b->towards_mark);
}

void hs_mesh_free(hs_mesh *mesh) {
    free(mesh->position);
    free(mesh->first);
    free(mesh->origin);
    free(mesh->twin);
    free(mesh->face);
    free(mesh->forced);
    free(mesh->sharpness);
    free(mesh->vertex_sharpness);
    memset(mesh, 0, sizeof *mesh);
}

/* --- 1. Face by face ------------------------------------------------------------------------- */

static bool check_positions(builder *b) {
    const hs_soup *soup = b->soup;
    for (uint32_t v = 0; v < soup->vertices; v++)
        for (uint32_t i = 0; i < 4; i++)
            if (!isfinite(soup->position[4 * (size_t)v + i]))
                return fail_at(b, line_of_vertex(b, v),
                               "%c of vertex %u is not a finite number; give a number of at most "
                               "3.4e38 in magnitude",
                               "xyzw"[i], v + 1);
    return true;
}

static bool check_face(builder *b, uint32_t face, const uint32_t *corner) {
    const hs_soup *soup = b->soup;
    for (uint32_t i = 0; i < soup->sides[face]; i++) {
        uint32_t v = corner[i];
        if (v >= soup->vertices)
            return fail_at(b, line_of_face(b, face),
                           "face %u uses vertex %llu, but the mesh has %u vertices; correct the "
                           "index",
                           face + 1, v + 1ULL, soup->vertices);
        if (b->face_mark[v] == face + 1)
            return fail_at(b, line_of_face(b, face),
                           "face %u uses vertex %u more than once; leave the repeated corner out, "
                           "or split the face",
                           face + 1, v + 1);
        b->face_mark[v] = face + 1;
        if (++b->valence[v] > HS_MAX_VALENCE)
            return fail_at(b, line_of_vertex(b, v),
                           "vertex %u has more than %d faces; split the vertex", v + 1,
                           HS_MAX_VALENCE);
    }
    return true;
}

static bool check_faces(builder *b, uint32_t *corners) {
    const hs_soup *soup = b->soup;
    *corners = 0;
    if (soup->faces == 0)
        return fail_at(b, 0, "the mesh has no faces; give at least one ('f' lines, in OBJ)");
    if (soup->vertices >= COUNT_LIMIT || soup->faces >= COUNT_LIMIT)
        return fail_at(b, 0, "%u vertices and %u faces; fewer than %d of each are supported",
                       soup->vertices, soup->faces, COUNT_LIMIT);
    b->face_mark = allocate(soup->vertices, sizeof *b->face_mark);
    b->valence = allocate(soup->vertices, sizeof *b->valence);
    if (b->face_mark == NULL || b->valence == NULL) return exhausted(b);
    if (!check_positions(b)) return false;
    for (uint32_t f = 0; f < soup->faces; f++) {
        uint32_t sides = soup->sides[f];
        if (sides < HS_MIN_SIDES || sides > HS_MAX_SIDES)
            return fail_at(b, line_of_face(b, f), "face %u has %u corner%s; a face needs %d to %d",
                           f + 1, sides, sides == 1 ? "" : "s", HS_MIN_SIDES, HS_MAX_SIDES);
        if (sides >= COUNT_LIMIT - *corners)
            return fail_at(b, line_of_face(b, f),
                           "the faces have too many corners; fewer than %d are supported",
                           COUNT_LIMIT);
        if (!check_face(b, f, soup->corner + *corners)) return false;
        *corners += sides;
    }
    return true;
}

/* --- 2. Lay the half-edges out --------------------------------------------------------------- */

static bool keep_used_vertices(builder *b) {
    const hs_soup *soup = b->soup;
    uint32_t used = 0;
    for (uint32_t v = 0; v < soup->vertices; v++)
        used += b->valence[v] != 0;
    b->number = allocate(soup->vertices, sizeof *b->number);
    b->original = allocate(used, sizeof *b->original);
    b->mesh->position = allocate(used, 4 * sizeof(float));
    if (b->number == NULL || b->original == NULL || b->mesh->position == NULL) return exhausted(b);
    for (uint32_t v = 0; v < soup->vertices; v++) {
        if (b->valence[v] == 0) continue;
        uint32_t number = b->mesh->vertices++;
        b->number[v] = number;
        b->original[number] = v;
        memcpy(b->mesh->position + 4 * (size_t)number, soup->position + 4 * (size_t)v,
               4 * sizeof(float));
    }
    return true;
}

static bool lay_out(builder *b, uint32_t corners) {
    hs_mesh *mesh = b->mesh;
    const hs_soup *soup = b->soup;
    mesh->first = allocate(soup->faces + (size_t)1, sizeof *mesh->first);
    mesh->origin = allocate(corners, sizeof *mesh->origin);
    mesh->twin = allocate(corners, sizeof *mesh->twin);
    mesh->face = allocate(corners, sizeof *mesh->face);
    mesh->forced = allocate(soup->faces, sizeof *mesh->forced);
    mesh->sharpness = allocate(corners, sizeof *mesh->sharpness);
    mesh->vertex_sharpness = allocate(mesh->vertices, sizeof *mesh->vertex_sharpness);
    if (mesh->first == NULL || mesh->origin == NULL || mesh->twin == NULL || mesh->face == NULL ||
        mesh->forced == NULL || mesh->sharpness == NULL || mesh->vertex_sharpness == NULL)
        return exhausted(b);
    mesh->faces = soup->faces;
    mesh->halfedges = corners;
    uint32_t h = 0;
    for (uint32_t f = 0; f < soup->faces; f++) {
        mesh->first[f] = h;
        for (uint32_t i = 0; i < soup->sides[f]; i++, h++) {
            mesh->origin[h] = b->number[soup->corner[h]];
            mesh->twin[h] = (uint32_t)HS_BORDER;
            mesh->face[h] = f;
        }
    }
    mesh->first[mesh->faces] = h;
    return true;
}

/* --- 3. Sort by origin ----------------------------------------------------------------------- */

static bool sort_by_origin(builder *b) {
    const hs_mesh *mesh = b->mesh;
    b->fan = allocate(mesh->vertices + (size_t)1, sizeof *b->fan);
    b->leaving = allocate(mesh->halfedges, sizeof *b->leaving);
    if (b->fan == NULL || b->leaving == NULL) return exhausted(b);
    /* fan[v] starts as the end of v's range and is counted down to its begin. */
    uint32_t end = 0;
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        end += b->valence[b->original[v]];
        b->fan[v] = end;
    }
    b->fan[mesh->vertices] = end;
    for (uint32_t h = mesh->halfedges; h-- > 0;)
        b->leaving[--b->fan[mesh->origin[h]]] = h;
    return true;
}

/* --- 4. Pair --------------------------------------------------------------------------------- */

/* How many faces have the edge between v and w. */
static uint32_t faces_at_edge(const builder *b, uint32_t v, uint32_t w) {
    const hs_mesh *mesh = b->mesh;
    uint32_t count = 0;
    for (uint32_t i = b->fan[v]; i < b->fan[v + 1]; i++) {
        uint32_t h = b->leaving[i];
        count += mesh->origin[hs_next(mesh, h)] == w;
        count += mesh->origin[hs_prev(mesh, h)] == w;
    }
    return count;
}

/* Two half-edges with the same origin and the same end. */
static bool fail_at_edge(builder *b, uint32_t one, uint32_t other) {
    const hs_mesh *mesh = b->mesh;
    uint32_t v = mesh->origin[one], w = mesh->origin[hs_next(mesh, one)];
    uint32_t count = faces_at_edge(b, v, w);
    uint32_t line = line_of_face(b, mesh->face[other]);
    label first = face_label(b, mesh->face[one]), second = face_label(b, mesh->face[other]);
    if (count > 2)
        return fail_at(b, line,
                       "edge %u-%u belongs to %u faces, %s and %s among them; an edge may have at "
                       "most two faces: remove the others, or give them vertices of their own",
                       b->original[v] + 1, b->original[w] + 1, count, first.text, second.text);
    return fail_at(b, line,
                   "%s and %s are inconsistently oriented: both run along edge %u-%u in the same "
                   "direction; reverse the corners of one of them",
                   first.text, second.text, b->original[v] + 1, b->original[w] + 1);
}

static bool pair_halfedges(builder *b) {
    hs_mesh *mesh = b->mesh;
    b->towards = allocate(mesh->vertices, sizeof *b->towards);
    b->towards_mark = allocate(mesh->vertices, sizeof *b->towards_mark);
    if (b->towards == NULL || b->towards_mark == NULL) return exhausted(b);
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        for (uint32_t i = b->fan[v]; i < b->fan[v + 1]; i++) {
            uint32_t h = b->leaving[i];
            uint32_t w = mesh->origin[hs_next(mesh, h)];
            if (b->towards_mark[w] == v + 1) return fail_at_edge(b, b->towards[w], h);
            b->towards_mark[w] = v + 1;
            b->towards[w] = h;
        }
        for (uint32_t i = b->fan[v]; i < b->fan[v + 1]; i++) {
            uint32_t arriving = hs_prev(mesh, b->leaving[i]);
            uint32_t u = mesh->origin[arriving];
            if (b->towards_mark[u] == v + 1) mesh->twin[arriving] = b->towards[u];
        }
    }
    return true;
}

/* --- 5. One fan around every vertex ---------------------------------------------------------- */

/* A face of vertex v that the walk around it did not reach. */
static uint32_t face_outside_fan(const builder *b, uint32_t v, uint32_t start, uint32_t steps) {
    const hs_mesh *mesh = b->mesh;
    for (uint32_t i = b->fan[v]; i < b->fan[v + 1]; i++) {
        uint32_t h = start;
        uint32_t step = 0;
        while (step < steps && h != b->leaving[i]) {
            h = mesh->twin[hs_prev(mesh, h)];
            step++;
        }
        if (step == steps) return mesh->face[b->leaving[i]];
    }
    return mesh->face[start];
}

static bool check_fan(builder *b, uint32_t v) {
    const hs_mesh *mesh = b->mesh;
    uint32_t count = b->fan[v + 1] - b->fan[v];
    /* An open fan has a first face: the one whose half-edge from v has no twin. */
    uint32_t start = b->leaving[b->fan[v]];
    for (uint32_t i = b->fan[v]; i < b->fan[v + 1]; i++)
        if (mesh->twin[b->leaving[i]] == (uint32_t)HS_BORDER) {
            start = b->leaving[i];
            break;
        }
    /* h -> twin(prev(h)) is a one-to-one map on the half-edges that leave v, so the walk either
     * comes back to its start or ends at the border. */
    uint32_t reached = 0, h = start;
    do {
        reached++;
        h = mesh->twin[hs_prev(mesh, h)];
    } while (h != (uint32_t)HS_BORDER && h != start);
    if (reached == count) return true;
    uint32_t outside = face_outside_fan(b, v, start, reached);
    label first = face_label(b, mesh->face[start]), second = face_label(b, outside);
    uint32_t number = b->original[v];
    return fail_at(b, line_of_vertex(b, number),
                   "vertex %u is non-manifold: %s and %s meet there, but not through faces that "
                   "share edges at it; give each fan of faces a vertex of its own",
                   number + 1, first.text, second.text);
}

static bool check_fans(builder *b) {
    for (uint32_t v = 0; v < b->mesh->vertices; v++)
        if (!check_fan(b, v)) return false;
    return true;
}

/* --- 6. Sharp edges and vertices ------------------------------------------------------------- */

/* "the crease 3-7" or "the corner 3"; as the tag has them, so from 0. */
static label tag_label(const hs_sharp_tag *tag) {
    label name;
    if (tag->v == tag->w)
        snprintf(name.text, sizeof name.text, "the corner %u", tag->v);
    else
        snprintf(name.text, sizeof name.text, "the crease %u-%u", tag->v, tag->w);
    return name;
}

/* What a tag says, in the mesh's numbers. */
static bool read_sharpness(builder *b, const hs_sharp_tag *tag, uint8_t *sharpness) {
    const float s = tag->sharpness, whole = b->soup->round_sharpness ? floorf(s + 0.5f) : floorf(s);
    if (!(s >= 0))
        return fail_at(b, tag->line, "%s has the sharpness %g; give a number of levels, 0 or more",
                       tag_label(tag).text, (double)s);
    *sharpness = HS_SHARP_INFINITE;
    if (whole > HS_MAX_SHARPNESS) return true;
    if (!b->soup->round_sharpness && whole < s)
        return fail_at(b, tag->line,
                       "%s has the sharpness %g, but only whole levels are refined; round it, or "
                       "let --round-sharpness do it",
                       tag_label(tag).text, (double)s);
    *sharpness = (uint8_t)whole;
    return true;
}

/* The half-edge v -> w, or HS_BORDER. */
static uint32_t find_halfedge(const builder *b, uint32_t v, uint32_t w) {
    for (uint32_t i = b->fan[v]; i < b->fan[v + 1]; i++)
        if (b->mesh->origin[hs_next(b->mesh, b->leaving[i])] == w) return b->leaving[i];
    return HS_BORDER;
}

static bool apply_tag(builder *b, const hs_sharp_tag *tag) {
    const hs_soup *soup = b->soup;
    const uint32_t largest = tag->v > tag->w ? tag->v : tag->w;
    uint8_t sharpness;
    if (!read_sharpness(b, tag, &sharpness)) return false;
    if (largest >= soup->vertices)
        return fail_at(b, tag->line,
                       "%s names vertex %u, but the last one is %u (tags count from 0); correct "
                       "the number",
                       tag_label(tag).text, largest, soup->vertices - 1);
    if (b->valence[tag->v] == 0 || b->valence[tag->w] == 0)
        return fail_at(b, tag->line, "%s names a vertex that no face uses; remove the tag",
                       tag_label(tag).text);
    const uint32_t v = b->number[tag->v], w = b->number[tag->w];
    if (v == w) {
        b->mesh->vertex_sharpness[v] = sharpness;
        return true;
    }
    const uint32_t h = find_halfedge(b, v, w), t = find_halfedge(b, w, v);
    if (h == (uint32_t)HS_BORDER && t == (uint32_t)HS_BORDER)
        return fail_at(b, tag->line,
                       "%s: no edge joins the two vertices (tags count from 0); correct the "
                       "numbers, or remove the tag",
                       tag_label(tag).text);
    if (h != (uint32_t)HS_BORDER) b->mesh->sharpness[h] = sharpness;
    if (t != (uint32_t)HS_BORDER) b->mesh->sharpness[t] = sharpness;
    return true;
}

static bool apply_tags(builder *b) {
    for (uint32_t i = 0; i < b->soup->tags; i++)
        if (!apply_tag(b, &b->soup->tag[i])) return false;
    return true;
}

bool hs_mesh_build(hs_mesh *mesh, const hs_soup *soup, uint32_t *dropped, hs_error *err) {
    memset(mesh, 0, sizeof *mesh);
    builder b = {.soup = soup, .mesh = mesh, .err = err};
    uint32_t corners;
    bool good = check_faces(&b, &corners) && keep_used_vertices(&b) && lay_out(&b, corners) &&
                sort_by_origin(&b) && pair_halfedges(&b) && check_fans(&b) && apply_tags(&b);
    free_builder(&b);
    if (!good) hs_mesh_free(mesh);
    if (dropped != NULL) *dropped = good ? soup->vertices - mesh->vertices : 0;
    return good;
}
