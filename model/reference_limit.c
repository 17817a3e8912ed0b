/* SPDX-License-Identifier: Apache-2.0
 *
 * The limit surface, in this order:
 *   positions   of the vertices that leave a replay, in any generation    hs_reference_leave
 *   rings       the neighbours of a vertex, counter-clockwise             make_ring
 *   tangents    and the normals of a ring's sectors                       normals_of_vertex
 *   both        of a whole uniform level                                  hs_reference_limit
 */
#include "reference_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- Positions -------------------------------------------------------------------------------- */

/* The place of a vertex in a face. */
static uint32_t place_in_face(const hs_reference *r, uint32_t f, uint32_t v) {
    uint32_t k = 0;
    while (hs_reference_corner(r, f, k) != v)
        k++;
    return k;
}

static const double *position_of(const hs_reference *r, uint32_t v) {
    return r->vertex[v].position;
}

/* The rule of an odd generation, at the level that its positions have. An edge of that level is
 * half of an old edge, from the vertex to the attribute of the face that replaced it. attribute:
 * those of the sharp ones, if they are two. */
static hs_reference_rule rule_of_attributes(const hs_reference *r, uint32_t v,
                                            const double *attribute[2]) {
    const hs_reference_list faces = r->vertex[v].faces;
    uint32_t sharp = 0;
    for (uint32_t i = 0; i < faces.count; i++) {
        const uint32_t f = r->vertex_face[faces.first + i];
        if (!r->face[f].sharpness || place_in_face(r, f, v) % 2 == 1) continue;
        if (sharp < 2) attribute[sharp] = r->face[f].point;
        sharp++;
    }
    if (sharp > 2 || r->vertex[v].sharpness) return HS_REFERENCE_STAYS;
    return sharp == 2 ? HS_REFERENCE_CREASE : HS_REFERENCE_SMOOTH;
}

/* The same for any generation; end: where the two sharp edges of the level end. */
static hs_reference_rule rule_of(const hs_reference *r, uint32_t v, const double *end[2]) {
    if (r->generation % 2 == 1) return rule_of_attributes(r, v, end);
    uint32_t vertex[2];
    const hs_reference_rule rule = hs_reference_vertex_rule(r, v, vertex);
    for (int i = 0; rule == HS_REFERENCE_CREASE && i < 2; i++)
        end[i] = position_of(r, vertex[i]);
    return rule;
}

/* (n^2 v + sum(4a + b)) / (n^2 + 5n) over the quads of the level at v: in even generations a is the
 * next vertex and b the opposite one; in odd ones the attribute is a, and what comes next b. */
static void smooth_limit(const hs_reference *r, uint32_t v, double limit[4]) {
    const hs_reference_list faces = r->vertex[v].faces;
    const double n = faces.count;
    memset(limit, 0, 4 * sizeof *limit);
    for (uint32_t i = 0; i < faces.count; i++) {
        const uint32_t f = r->vertex_face[faces.first + i], k = place_in_face(r, f, v);
        const double *next = position_of(r, hs_reference_corner(r, f, k + 1));
        if (r->generation % 2 == 0) {
            hs_reference_add(limit, 4, next);
            hs_reference_add(limit, 1, position_of(r, hs_reference_corner(r, f, k + 2)));
        } else {
            hs_reference_add(limit, 4, r->face[f].point);
            hs_reference_add(limit, 1, next);
        }
    }
    hs_reference_add(limit, n * n, position_of(r, v));
    hs_reference_divide(limit, n * n + 5 * n);
}

/* False for vertices around which the surface is not a whole Catmull-Clark level: on a border of
 * the active mesh, and where generation 0 has other faces than quads. */
static bool has_limit(const hs_reference *r, uint32_t v) {
    const hs_reference_list faces = r->vertex[v].faces;
    for (uint32_t i = 0; r->generation == 0 && i < faces.count; i++)
        if (r->face[r->vertex_face[faces.first + i]].v.count != 4) return false;
    return !hs_reference_on_border(r, v);
}

/* Where an active vertex is in the limit; where it is, if it has none. */
static void limit_of(const hs_reference *r, uint32_t v, double limit[4]) {
    const double *end[2];
    memcpy(limit, position_of(r, v), 4 * sizeof *limit);
    if (!has_limit(r, v)) return;
    switch (rule_of(r, v, end)) {
    case HS_REFERENCE_SMOOTH:
        smooth_limit(r, v, limit);
        break;
    case HS_REFERENCE_CREASE:
        for (int i = 0; i < 4; i++)
            limit[i] = (end[0][i] + 4 * limit[i] + end[1][i]) / 6;
        break;
    case HS_REFERENCE_STAYS:
        break;
    }
}

void hs_reference_leave(hs_reference *r, const uint8_t *decision, bool finish) {
    for (uint32_t v = 0; v < r->vertices; v++) {
        hs_reference_vertex *vertex = &r->vertex[v];
        if (vertex->held || vertex->faces.count == 0) continue;
        if (!finish && !hs_reference_is_leaving(r, v, decision)) continue;
        limit_of(r, v, vertex->limit);
        r->at_level += !has_limit(r, v);
    }
}

/* --- Rings ------------------------------------------------------------------------------------ */

enum { MAX_RING = 255 }; /* faces at a vertex: HS_MAX_VALENCE, and sides of a face */

/* The neighbours of a vertex, counter-clockwise. Face i lies between edges i and i + 1; if the ring
 * is closed, edge `faces` is edge 0. It begins at a sharp edge, if there is one, or where the
 * surface does. */
typedef struct ring {
    uint32_t vertex, faces;
    bool closed;
    uint32_t around[MAX_RING + 1]; /* the edges' other ends */
    bool sharp[MAX_RING + 1];
    uint32_t opposite[MAX_RING]; /* in a quad, the vertex behind `around` */
    uint32_t corner[MAX_RING];   /* item of face_vertex */
} ring;

/* A face to begin with: the edge that leaves v in it is open, or else sharp. */
static uint32_t first_face(const hs_reference *r, uint32_t v) {
    const hs_reference_list faces = r->vertex[v].faces;
    uint32_t first = r->vertex_face[faces.first];
    for (uint32_t i = 0; i < faces.count; i++) {
        const uint32_t f = r->vertex_face[faces.first + i],
                       next = hs_reference_corner(r, f, place_in_face(r, f, v) + 1);
        const hs_reference_edge *edge = &r->edge[hs_reference_find_edge(r, v, next)];
        if (edge->f1 == HS_REFERENCE_NONE) return f;
        if (edge->sharpness) first = f;
    }
    return first;
}

static void make_ring(const hs_reference *r, uint32_t v, ring *ring) {
    ring->vertex = v;
    ring->faces = 0;
    ring->closed = false;
    const uint32_t first = first_face(r, v);
    for (uint32_t f = first; f != HS_REFERENCE_NONE;) {
        const uint32_t i = ring->faces++, k = place_in_face(r, f, v),
                       before = k + r->face[f].v.count - 1;
        ring->corner[i] = r->face[f].v.first + k;
        ring->around[i] = hs_reference_corner(r, f, k + 1);
        ring->opposite[i] = hs_reference_corner(r, f, k + 2);
        ring->around[i + 1] = hs_reference_corner(r, f, before);
        f = r->face_face[r->face[f].f.first + before % r->face[f].v.count];
        ring->closed = f == first;
        if (ring->closed) break;
    }
    for (uint32_t i = 0; i <= ring->faces; i++)
        ring->sharp[i] = r->edge[hs_reference_find_edge(r, v, ring->around[i])].sharpness != 0;
}

/* --- Tangents --------------------------------------------------------------------------------- */

/* The faces of a ring from edge `first` to edge `last`, between two sharp ones or all around. */
typedef struct sector {
    uint32_t first, last;
} sector;

static void subtract(const double a[4], const double b[4], double difference[4]) {
    for (int i = 0; i < 4; i++)
        difference[i] = a[i] - b[i];
}

/* The derivative of (x/w, y/w, z/w), times w^2, where that of (x, y, z, w) is given. */
static void project_tangent(const double p[4], const double tangent[4], double projected[3]) {
    for (int i = 0; i < 3; i++)
        projected[i] = tangent[i] * p[3] - p[i] * tangent[3];
}

static void add_cross(const double a[3], const double b[3], double normal[3]) {
    for (int i = 0; i < 3; i++)
        normal[i] += a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double length(const double a[3]) {
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static bool normalize(double normal[3], double small) {
    const double size = length(normal);
    if (!(size > small)) return false;
    for (int i = 0; i < 3; i++)
        normal[i] /= size;
    return true;
}

/* The normal of two tangents at a position; false if they have none. */
static bool normal_of_tangents(const double limit[4], const double t1[4], const double t2[4],
                               double normal[3]) {
    double a[3], b[3];
    project_tangent(limit, t1, a);
    project_tangent(limit, t2, b);
    memset(normal, 0, 3 * sizeof *normal);
    add_cross(a, b, normal);
    return normalize(normal, 1e-10 * length(a) * length(b));
}

/* The normal of the fan v, e_0, e_1, ... of a sector; 0 0 0 if it is flat to a line. */
static void normal_of_fan(const hs_reference *r, const ring *ring, sector s, double normal[3]) {
    const double *v = position_of(r, ring->vertex);
    double sum[3] = {0};
    for (uint32_t i = s.first; i < s.last; i++) {
        double edge[4], a[3], b[3];
        subtract(position_of(r, ring->around[i]), v, edge);
        project_tangent(v, edge, a);
        subtract(position_of(r, ring->around[i + 1]), v, edge);
        project_tangent(v, edge, b);
        add_cross(a, b, sum);
    }
    if (!normalize(sum, 0)) memset(sum, 0, sizeof sum);
    memcpy(normal, sum, sizeof sum);
}

/* Halstead, Kass, DeRose: A c_i e_i + (c_i + c_(i+1)) f_i with the cosine and with the sine. */
static void smooth_tangents(const hs_reference *r, const ring *ring, double t1[4], double t2[4]) {
    const double t = 2 * M_PI / ring->faces, A = 1 + cos(t) + cos(t / 2) * sqrt(2 * (9 + cos(t)));
    for (uint32_t i = 0; i < ring->faces; i++) {
        const double *e = position_of(r, ring->around[i]), *f = position_of(r, ring->opposite[i]);
        hs_reference_add(t1, A * cos(i * t), e);
        hs_reference_add(t2, A * sin(i * t), e);
        hs_reference_add(t1, cos(i * t) + cos((i + 1) * t), f);
        hs_reference_add(t2, sin(i * t) + sin((i + 1) * t), f);
    }
}

/* Biermann, Levin, Zorin: along the crease, and across, into the sector. */
static void crease_tangents(const hs_reference *r, const ring *ring, sector s, double t1[4],
                            double t2[4]) {
    const uint32_t k = s.last - s.first;
    const double *v = position_of(r, ring->vertex), *first = position_of(r, ring->around[s.first]),
                 *last = position_of(r, ring->around[s.last]);
    subtract(first, last, t1);
    if (k == 1) {
        hs_reference_add(t2, 1, first);
        hs_reference_add(t2, 1, last);
        hs_reference_add(t2, -2, v);
        return;
    }
    const double t = M_PI / k, R = (cos(t) + 1) / sin(t);
    hs_reference_add(t2, 4 * R * (cos(t) - 1), v);
    hs_reference_add(t2, -R * (1 + 2 * cos(t)), first);
    hs_reference_add(t2, -R * (1 + 2 * cos(t)), last);
    for (uint32_t i = 0; i < k; i++) {
        if (i > 0) hs_reference_add(t2, 4 * sin(i * t), position_of(r, ring->around[s.first + i]));
        hs_reference_add(t2, sin(i * t) + sin((i + 1) * t),
                         position_of(r, ring->opposite[s.first + i]));
    }
}

static void normal_of_sector(const hs_reference *r, const ring *ring, sector s,
                             hs_reference_rule rule, double normal[3]) {
    double limit[4], t1[4] = {0}, t2[4] = {0};
    limit_of(r, ring->vertex, limit);
    const bool whole = ring->closed && s.last - s.first == ring->faces;
    if (!has_limit(r, ring->vertex)) {
        normal_of_fan(r, ring, s, normal);
        return;
    }
    if (rule == HS_REFERENCE_SMOOTH && whole && ring->faces > 2) {
        smooth_tangents(r, ring, t1, t2);
    } else if (rule == HS_REFERENCE_CREASE) {
        crease_tangents(r, ring, s, t1, t2);
    } else if (rule == HS_REFERENCE_STAYS && !whole) {
        subtract(position_of(r, ring->around[s.first]), limit, t1);
        subtract(position_of(r, ring->around[s.last]), limit, t2);
    }
    if (!normal_of_tangents(limit, t1, t2, normal)) normal_of_fan(r, ring, s, normal);
}

/* Every sector's normal, for each of its corners. */
static void normals_of_vertex(const hs_reference *r, uint32_t v, double (*normal)[3]) {
    ring ring;
    const double *end[2];
    make_ring(r, v, &ring);
    const hs_reference_rule rule = rule_of(r, v, end);
    uint32_t sharp = 0;
    for (uint32_t i = 0; i < ring.faces; i++)
        sharp += ring.sharp[i];
    const bool undivided = ring.closed && sharp < 2;
    sector s = {0, 0};
    while (s.first < ring.faces) {
        s.last++;
        while (s.last < ring.faces && (undivided || !ring.sharp[s.last]))
            s.last++;
        double of_sector[3];
        normal_of_sector(r, &ring, s, rule, of_sector);
        for (uint32_t i = s.first; i < s.last; i++)
            memcpy(normal[ring.corner[i]], of_sector, sizeof of_sector);
        s.first = s.last;
    }
}

bool hs_reference_limit(const hs_reference *r, double (*position)[4], double (*normal)[3],
                        hs_error *err) {
    if (r->generation % 2 == 1)
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "reference: limits of generation %u; ask for them in an even one",
                       r->generation);
    for (uint32_t v = 0; v < r->vertices; v++) {
        if (r->vertex[v].faces.count == 0) continue;
        limit_of(r, v, position[v]);
        if (normal) normals_of_vertex(r, v, normal);
    }
    return true;
}
