/* SPDX-License-Identifier: Apache-2.0
 *
 * Surfaces: from streams, meshes and face lists to what is drawn. Positions in clip and in object
 * space, the direction of the eye, which faces look to it, and how faces are cut into triangles.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render.h"
#include "render_parts.h"

/* --- Matrices --------------------------------------------------------------------------------- */

static double determinant3(const double a[4], const double b[4], const double c[4], int x, int y,
                           int z) {
    return a[x] * (b[y] * c[z] - b[z] * c[y]) - a[y] * (b[x] * c[z] - b[z] * c[x]) +
           a[z] * (b[x] * c[y] - b[y] * c[x]);
}

/* The fourth vector's cofactors: X . e = det[e; a; b; c] for every e. */
static void cross4(double result[4], const double a[4], const double b[4], const double c[4]) {
    result[0] = determinant3(a, b, c, 1, 2, 3);
    result[1] = -determinant3(a, b, c, 0, 2, 3);
    result[2] = determinant3(a, b, c, 0, 1, 3);
    result[3] = -determinant3(a, b, c, 0, 1, 2);
}

/* For points p, q, r with w = 1, det[(x, y, w) of M p, M q, M r] is (by Cauchy and Binet) the
 * product of cross4 of M's rows x, y, w and cross4 of the points, which is (N, -N . p) with N the
 * triangle's normal. So with E = cross4(rows x, y, w) the determinant is N . (E.xyz - p E.w): what
 * is front looks along E.xyz - p E.w, for perspective, parallel and mirrored views alike. */
void hs_eye_of_matrix(double eye[4], const double m[16]) {
    cross4(eye, &m[0], &m[4], &m[12]);
}

bool hs_matrix_invert(double inverse[16], const double m[16]) {
    /* Columns and then rows are scaled to length 1 first, so that "singular" does not depend on
     * units: neither those of object space nor those of x, y, z, w. */
    double row[4][4], height[4], length[4];
    for (int j = 0; j < 4; j++) {
        height[j] = hypot(hypot(m[j], m[4 + j]), hypot(m[8 + j], m[12 + j]));
        if (!(height[j] > 0) || isinf(height[j])) return false;
    }
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++)
            row[i][j] = m[4 * i + j] / height[j];
        length[i] = hypot(hypot(row[i][0], row[i][1]), hypot(row[i][2], row[i][3]));
        if (!(length[i] > 0)) return false;
        for (int j = 0; j < 4; j++)
            row[i][j] /= length[i];
    }
    double cofactor[4][4];
    for (int i = 0; i < 4; i++) {
        cross4(cofactor[i], row[i == 0], row[i < 2 ? 2 : 1], row[i < 3 ? 3 : 2]);
        for (int j = 0; j < 4 && i % 2 == 1; j++)
            cofactor[i][j] = -cofactor[i][j];
    }
    double determinant = 0;
    for (int j = 0; j < 4; j++)
        determinant += row[0][j] * cofactor[0][j];
    /* Rounding alone leaves about 1e-16 of a singular matrix. */
    if (!(fabs(determinant) > 1e-14)) return false;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            inverse[4 * j + i] = cofactor[i][j] / determinant / length[i] / height[j];
    return true;
}

void hs_matrix_apply(double result[4], const double m[16], const double p[4]) {
    for (int i = 0; i < 4; i++)
        result[i] =
            (m[4 * i] * p[0] + m[4 * i + 1] * p[1]) + (m[4 * i + 2] * p[2] + m[4 * i + 3] * p[3]);
}

/* --- Building --------------------------------------------------------------------------------- */

void hs_surface_free(hs_surface *surface) {
    free(surface->clip);
    free(surface->object);
    free(surface->first);
    free(surface->corner);
    free(surface->generation);
    free(surface->facing);
    free(surface->normal);
    *surface = (hs_surface){0};
}

uint8_t hs_surface_deepest(const hs_surface *surface) {
    uint8_t deepest = 0;
    for (uint32_t f = 0; f < surface->faces; f++)
        if (surface->generation[f] > deepest) deepest = surface->generation[f];
    return deepest;
}

/* Room for a surface, with its faces. */
bool hs_surface_make(hs_surface *surface, uint32_t vertices, uint32_t faces, const uint32_t *first,
                     const uint32_t *corner, const uint8_t *generation, hs_error *err) {
    size_t corners = faces ? first[faces] : 0;
    /* One element more than needed: an empty surface is no lack of memory. */
    *surface = (hs_surface){
        .vertices = vertices,
        .faces = faces,
        .clip = calloc((size_t)vertices * 4 + 1, sizeof(float)),
        .object = calloc((size_t)vertices * 3 + 1, sizeof(double)),
        .first = calloc((size_t)faces + 1, sizeof(uint32_t)),
        .corner = calloc(corners + 1, sizeof(uint32_t)),
        .generation = calloc((size_t)faces + 1, 1),
        .facing = calloc((size_t)faces + 1, 1),
    };
    if (!surface->clip || !surface->object || !surface->first || !surface->corner ||
        !surface->generation || !surface->facing) {
        hs_surface_free(surface);
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for a surface of %u faces", faces);
    }
    if (faces) {
        memcpy(surface->first, first, ((size_t)faces + 1) * sizeof *first);
        memcpy(surface->corner, corner, corners * sizeof *corner);
        if (generation) memcpy(surface->generation, generation, faces);
    }
    return true;
}

/* Sets the object-space positions from w-divided points; drops all if one is not finite. */
static void place_vertex(hs_surface *surface, uint32_t v, const double p[4], bool *finite) {
    for (int i = 0; i < 3; i++) {
        surface->object[3 * v + (uint32_t)i] = p[i] / p[3];
        *finite = *finite && isfinite(p[i] / p[3]);
    }
}

static void drop_object_space(hs_surface *surface) {
    free(surface->object);
    free(surface->normal);
    surface->object = NULL;
    surface->normal = NULL;
}

static int32_t block_exponent(const hs_surface *surface) {
    float largest = 0;
    for (size_t i = 0; i < (size_t)surface->vertices * 4; i++)
        largest = fmaxf(largest, fabsf(surface->clip[i]));
    int exponent = 0;
    if (largest > 0) frexpf(largest, &exponent);
    return exponent;
}

/* The facing of every face, on integers q = RNE(c 2^(30-E)): three factors below 2^31, exact. */
static void classify_faces(hs_surface *surface, int32_t exponent) {
    for (uint32_t f = 0; f < surface->faces; f++) {
        uint32_t begin = surface->first[f], sides = surface->first[f + 1] - begin;
        bool front = false, back = false;
        for (uint32_t i = 0; i < sides; i++) {
            int64_t q[3][3];
            for (uint32_t k = 0; k < 3; k++) {
                const float *c = &surface->clip[4 * surface->corner[begin + (i + k) % sides]];
                for (int j = 0; j < 3; j++)
                    q[k][j] = llrint(ldexp((double)c[j < 2 ? j : 3], HS_FRACTION_BITS - exponent));
            }
            __int128 determinant = (__int128)q[0][0] * (q[1][1] * q[2][2] - q[1][2] * q[2][1]) -
                                   (__int128)q[0][1] * (q[1][0] * q[2][2] - q[1][2] * q[2][0]) +
                                   (__int128)q[0][2] * (q[1][0] * q[2][1] - q[1][1] * q[2][0]);
            if (determinant > 0)
                front = true;
            else
                back = true;
        }
        surface->facing[f] = (uint8_t)(front && back ? HS_FACING_BOTH
                                       : front       ? HS_FACING_FRONT
                                                     : HS_FACING_BACK);
    }
}

bool hs_surface_of_output(hs_surface *surface, const hs_output *output, const float *matrix,
                          hs_error *err) {
    if (!hs_surface_make(surface, output->vertices, output->faces, output->first, output->corner,
                         output->generation, err))
        return false;
    if (output->vertices)
        memcpy(surface->clip, output->position, (size_t)output->vertices * 4 * sizeof(float));
    double inverse[16];
    bool finite = matrix != NULL;
    for (int i = 0; i < 16 && matrix; i++)
        surface->matrix[i] = (double)matrix[i];
    finite = finite && hs_matrix_invert(inverse, surface->matrix);
    for (uint32_t v = 0; v < output->vertices && finite; v++) {
        double p[4], c[4];
        for (uint32_t i = 0; i < 4; i++)
            c[i] = (double)surface->clip[4 * v + i];
        hs_matrix_apply(p, inverse, c);
        place_vertex(surface, v, p, &finite);
    }
    hs_eye_of_matrix(surface->eye, surface->matrix);
    if (!finite) drop_object_space(surface);
    classify_faces(surface, output->exponent);
    return true;
}

bool hs_surface_of_mesh(hs_surface *surface, const hs_mesh *mesh, const float matrix[16],
                        hs_error *err) {
    if (!hs_surface_make(surface, mesh->vertices, mesh->faces, mesh->first, mesh->origin, NULL,
                         err))
        return false;
    bool finite = true;
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        const float *m = matrix, *p = &mesh->position[4 * v];
        for (uint32_t i = 0; i < 4; i++, m += 4)
            surface->clip[4 * v + i] = (m[0] * p[0] + m[1] * p[1]) + (m[2] * p[2] + m[3] * p[3]);
        const double exact[4] = {(double)p[0], (double)p[1], (double)p[2], (double)p[3]};
        place_vertex(surface, v, exact, &finite);
    }
    for (int i = 0; i < 16; i++)
        surface->matrix[i] = (double)matrix[i];
    hs_eye_of_matrix(surface->eye, surface->matrix);
    if (!finite) drop_object_space(surface);
    classify_faces(surface, block_exponent(surface));
    return true;
}

bool hs_surface_of_faces(hs_surface *surface, const hs_faces *faces, const float matrix[16],
                         hs_error *err) {
    if (!hs_surface_make(surface, faces->vertices, faces->faces, faces->first, faces->corner,
                         faces->generation, err) ||
        (faces->normal && !hs_surface_add_normals(surface, faces->normal, err)))
        return false;
    bool finite = true;
    for (int i = 0; i < 16; i++)
        surface->matrix[i] = (double)matrix[i];
    for (uint32_t v = 0; v < faces->vertices; v++) {
        double clip[4];
        hs_matrix_apply(clip, surface->matrix, &faces->position[4 * (size_t)v]);
        for (uint32_t i = 0; i < 4; i++)
            surface->clip[4 * v + i] = (float)clip[i];
        place_vertex(surface, v, &faces->position[4 * (size_t)v], &finite);
    }
    hs_eye_of_matrix(surface->eye, surface->matrix);
    if (!finite) drop_object_space(surface);
    classify_faces(surface, block_exponent(surface));
    return true;
}

/* --- Normals and triangles -------------------------------------------------------------------- */

static void subtract(double result[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        result[i] = a[i] - b[i];
}

void hs_cross(double result[3], const double a[3], const double b[3]) {
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

double hs_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool hs_normalize(double v[3]) {
    double length = sqrt(hs_dot(v, v));
    for (int i = 0; i < 3 && length > 0; i++)
        v[i] /= length;
    return length > 0;
}

static const double *corner_place(const hs_surface *surface, uint32_t face, uint32_t i) {
    return &surface->object[3 * (size_t)surface->corner[surface->first[face] + i]];
}

/* Twice the vector area of a face: its mean normal, unnormalized, whatever its shape. */
static void vector_area(const hs_surface *surface, uint32_t face, double area[3]) {
    uint32_t sides = surface->first[face + 1] - surface->first[face];
    const double *origin = corner_place(surface, face, 0);
    area[0] = area[1] = area[2] = 0;
    for (uint32_t i = 1; i + 1 < sides; i++) {
        double a[3], b[3], n[3];
        subtract(a, corner_place(surface, face, i), origin);
        subtract(b, corner_place(surface, face, i + 1), origin);
        hs_cross(n, a, b);
        for (int k = 0; k < 3; k++)
            area[k] += n[k];
    }
}

void hs_face_normal(const hs_surface *surface, uint32_t face, double normal[3]) {
    vector_area(surface, face, normal);
    if (!hs_normalize(normal)) normal[2] = 1;
}

/* Whether a, b, c turn left, seen against the normal; straight is not left. */
static bool turns_left(const double *a, const double *b, const double *c, const double normal[3]) {
    double u[3], v[3], n[3];
    subtract(u, b, a);
    subtract(v, c, b);
    hs_cross(n, u, v);
    return hs_dot(n, normal) > 0;
}

/* Cuts ears off a face that is not convex: a corner that turns left and whose triangle holds no
 * other corner. If rounding or a self-intersection leaves no ear, the first corner goes. */
static uint32_t cut_ears(const hs_surface *surface, uint32_t face, const double normal[3],
                         uint8_t *triangle) {
    uint32_t left = surface->first[face + 1] - surface->first[face], triangles = 0;
    uint8_t ring[HS_MAX_SIDES] = {0};
    for (uint32_t i = 0; i < left; i++)
        ring[i] = (uint8_t)i;
    while (left > 3) {
        uint32_t ear = 0;
        for (uint32_t i = 0; i < left; i++) {
            const double *a = corner_place(surface, face, ring[(i + left - 1) % left]);
            const double *b = corner_place(surface, face, ring[i]);
            const double *c = corner_place(surface, face, ring[(i + 1) % left]);
            bool is_ear = turns_left(a, b, c, normal);
            for (uint32_t k = 2; k + 1 < left && is_ear; k++) {
                const double *p = corner_place(surface, face, ring[(i + k) % left]);
                is_ear = !(turns_left(a, b, p, normal) && turns_left(b, c, p, normal) &&
                           turns_left(c, a, p, normal));
            }
            if (!is_ear) continue;
            ear = i;
            break;
        }
        triangle[3 * triangles] = ring[(ear + left - 1) % left];
        triangle[3 * triangles + 1] = ring[ear];
        triangle[3 * triangles++ + 2] = ring[(ear + 1) % left];
        memmove(&ring[ear], &ring[ear + 1], left - ear - 1);
        left--;
    }
    memcpy(&triangle[3 * triangles], ring, 3);
    return triangles + 1;
}

static double squared_distance(const double *a, const double *b) {
    double d[3];
    subtract(d, a, b);
    return hs_dot(d, d);
}

uint32_t hs_surface_triangles(const hs_surface *surface, uint32_t face, uint8_t *triangle) {
    uint32_t sides = surface->first[face + 1] - surface->first[face];
    bool convex = true, other_diagonal = false;
    if (surface->object && sides > 3) {
        double normal[3];
        hs_face_normal(surface, face, normal);
        for (uint32_t i = 0; i < sides && convex; i++)
            convex = turns_left(corner_place(surface, face, i),
                                corner_place(surface, face, (i + 1) % sides),
                                corner_place(surface, face, (i + 2) % sides), normal);
        if (!convex) return cut_ears(surface, face, normal, triangle);
        /* A tie goes to the first diagonal, clearly, so that rounding does not flicker. */
        if (sides == 4)
            other_diagonal =
                squared_distance(corner_place(surface, face, 1), corner_place(surface, face, 3)) <
                0.999 * squared_distance(corner_place(surface, face, 0),
                                         corner_place(surface, face, 2));
    }
    if (sides == 3) {
        memcpy(triangle, (const uint8_t[]){0, 1, 2}, 3);
        return 1;
    }
    if (sides == 4) {
        static const uint8_t cut[2][6] = {{0, 1, 2, 0, 2, 3}, {1, 2, 3, 1, 3, 0}};
        memcpy(triangle, cut[other_diagonal], 6);
        return 2;
    }
    for (uint32_t i = 0; i < sides; i++) {
        triangle[3 * i] = (uint8_t)i;
        triangle[3 * i + 1] = (uint8_t)((i + 1) % sides);
        triangle[3 * i + 2] = (uint8_t)sides;
    }
    return sides;
}

/* --- Edges ------------------------------------------------------------------------------------ */

static int compare_keys(const void *a, const void *b) {
    uint64_t x, y;
    memcpy(&x, a, sizeof x);
    memcpy(&y, b, sizeof y);
    return (x > y) - (x < y);
}

hs_edge *hs_surface_edges(const hs_surface *surface, uint32_t *count) {
    size_t corners = surface->faces ? surface->first[surface->faces] : 0;
    uint64_t *key = malloc((corners + 1) * sizeof *key);
    hs_edge *edge = malloc((corners + 1) * sizeof *edge);
    *count = 0;
    if (!key || !edge) {
        free(key);
        free(edge);
        return NULL;
    }
    for (uint32_t f = 0; f < surface->faces; f++) {
        uint32_t begin = surface->first[f], sides = surface->first[f + 1] - begin;
        for (uint32_t i = 0; i < sides; i++) {
            uint64_t v = surface->corner[begin + i], w = surface->corner[begin + (i + 1) % sides];
            key[begin + i] = v < w ? v << 32 | w : w << 32 | v;
        }
    }
    qsort(key, corners, sizeof *key, compare_keys);
    for (size_t i = 0, j; i < corners; i = j) {
        for (j = i + 1; j < corners && key[j] == key[i];)
            j++;
        edge[(*count)++] = (hs_edge){(uint32_t)(key[i] >> 32), (uint32_t)key[i], j - i == 1};
    }
    free(key);
    return edge;
}
