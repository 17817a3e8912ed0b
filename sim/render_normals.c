/* SPDX-License-Identifier: Apache-2.0
 *
 * Normals of corners, for smooth shading: the surface's own, or means of faces around vertices.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render.h"
#include "render_parts.h"

static size_t corners_of(const hs_surface *surface) {
    return surface->faces ? surface->first[surface->faces] : 0;
}

/* --- Own ones --------------------------------------------------------------------------------- */

bool hs_surface_add_normals(hs_surface *surface, const float *normal, hs_error *err) {
    const size_t numbers = 3 * corners_of(surface);
    surface->normal = malloc((numbers + 1) * sizeof *surface->normal);
    if (!surface->normal) {
        hs_fail(err, HS_EXIT_INTERNAL, "no memory for the normals of %u faces", surface->faces);
        hs_surface_free(surface);
        return false;
    }
    memcpy(surface->normal, normal, numbers * sizeof *normal);
    return true;
}

/* --- Means ------------------------------------------------------------------------------------ */

/* A face at a vertex. */
typedef struct meeting {
    uint32_t face;
    size_t corner;
    double normal[3]; /* of the two edges at the corner; zero if they have none */
    double angle;     /* between them, or 0 */
} meeting;

/* The meetings of vertex v are meeting[first[v]] to meeting[first[v + 1] - 1]. */
typedef struct meetings {
    size_t *first;
    meeting *meeting;
} meetings;

static void free_meetings(meetings *m) {
    free(m->first);
    free(m->meeting);
}

static void direction(double result[3], const hs_surface *surface, size_t from, size_t to) {
    const double *a = &surface->object[3 * (size_t)surface->corner[from]];
    const double *b = &surface->object[3 * (size_t)surface->corner[to]];
    for (int k = 0; k < 3; k++)
        result[k] = b[k] - a[k];
}

static meeting meet(const hs_surface *surface, uint32_t face, uint32_t i) {
    const size_t begin = surface->first[face];
    const uint32_t sides = surface->first[face + 1] - surface->first[face];
    meeting m = {.face = face, .corner = begin + i};
    double out[3], in[3];
    direction(out, surface, m.corner, begin + (i + 1) % sides);
    direction(in, surface, m.corner, begin + (i + sides - 1) % sides);
    if (!hs_normalize(out) || !hs_normalize(in)) return m;
    hs_cross(m.normal, out, in);
    if (hs_normalize(m.normal)) m.angle = acos(fmin(fmax(hs_dot(out, in), -1), 1));
    return m;
}

static bool find_meetings(meetings *m, const hs_surface *surface) {
    m->first = calloc((size_t)surface->vertices + 2, sizeof *m->first);
    m->meeting = malloc((corners_of(surface) + 1) * sizeof *m->meeting);
    if (!m->first || !m->meeting) return false;
    for (size_t c = 0; c < corners_of(surface); c++)
        m->first[surface->corner[c] + 2]++;
    for (size_t v = 2; v < (size_t)surface->vertices + 2; v++)
        m->first[v] += m->first[v - 1];
    for (uint32_t f = 0; f < surface->faces; f++)
        for (uint32_t i = 0; i < surface->first[f + 1] - surface->first[f]; i++)
            m->meeting[m->first[surface->corner[surface->first[f] + i] + 1]++] =
                meet(surface, f, i);
    return true;
}

static void add_meeting(double sum[3], const meeting *m) {
    for (int k = 0; k < 3; k++)
        sum[k] += m->angle * m->normal[k];
}

static void set_normal(float *normal, size_t corner, const double mean[3]) {
    for (size_t k = 0; k < 3; k++)
        normal[3 * corner + k] = (float)mean[k];
}

static bool crease_between(const hs_surface *surface, const meeting *a, const meeting *b,
                           double least_cosine) {
    return surface->generation[a->face] >= 2 && surface->generation[b->face] >= 2 &&
           hs_dot(a->normal, b->normal) < least_cosine;
}

/* If all faces are within half the angle of their mean, no two are further apart than the angle. */
static void average(const hs_surface *surface, const meeting *around, size_t count, float *normal) {
    const double crease = HS_CREASE_DEGREES * M_PI / 180;
    double mean[3] = {0};
    for (size_t i = 0; i < count; i++)
        add_meeting(mean, &around[i]);
    hs_normalize(mean);
    bool smooth = true;
    for (size_t i = 0; i < count && smooth; i++)
        smooth = hs_dot(around[i].normal, mean) > cos(crease / 2);
    for (size_t i = 0; i < count; i++) {
        if (!smooth) {
            memset(mean, 0, sizeof mean);
            for (size_t j = 0; j < count; j++)
                if (!crease_between(surface, &around[i], &around[j], cos(crease)))
                    add_meeting(mean, &around[j]);
            hs_normalize(mean);
        }
        set_normal(normal, around[i].corner, mean);
    }
}

bool hs_corner_normals(const hs_surface *surface, float *normal) {
    if (surface->normal) {
        memcpy(normal, surface->normal, 3 * corners_of(surface) * sizeof *normal);
        return true;
    }
    meetings m = {0};
    const bool done = find_meetings(&m, surface);
    for (uint32_t v = 0; v < surface->vertices && done; v++)
        average(surface, &m.meeting[m.first[v]], m.first[v + 1] - m.first[v], normal);
    free_meetings(&m);
    return done;
}
