/* SPDX-License-Identifier: Apache-2.0
 *
 * The modeller's kit: see shape_kit.h.
 */
#include "shape_kit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- Vectors and numbers --------------------------------------------------------------------- */

hs_vec hs_vec_cross(hs_vec a, hs_vec b) {
    return hs_vec_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

hs_vec hs_vec_unit(hs_vec a) {
    double length = sqrt(hs_vec_dot(a, a));
    return length > 0 ? hs_vec_scale(a, 1 / length) : a;
}

double hs_cos_degrees(double degrees) {
    double turns = degrees / 360;
    turns -= floor(turns + 0.5); /* -1/2 .. 1/2 */
    double x = turns * 6.283185307179586476925;
    /* Taylor's series in Horner's form: the first term left out is pi^28/28! < 3e-16. */
    double sum = 1;
    for (int k = 26; k >= 2; k -= 2)
        sum = 1 - sum * x * x / (double)(k * (k - 1));
    return sum;
}

double hs_sin_degrees(double degrees) {
    return hs_cos_degrees(degrees - 90);
}

double hs_falloff(double distance) {
    if (distance >= 1) return 0;
    double rest = 1 - distance * distance;
    return rest * rest;
}

uint64_t hs_random_next(uint64_t *state) {
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

uint32_t hs_random_below(uint64_t *state, uint32_t below) {
    return (uint32_t)((hs_random_next(state) >> 32) * below >> 32);
}

double hs_random_signed(uint64_t *state) {
    return (double)(hs_random_next(state) >> 11) * 0x1p-52 - 1;
}

/* --- The cage -------------------------------------------------------------------------------- */

void hs_cage_init(hs_cage *cage) {
    *cage = (hs_cage){.point_capacity = 256, .face_capacity = 256, .tag_capacity = 64};
    cage->point = calloc(cage->point_capacity, sizeof *cage->point);
    cage->face = calloc(cage->face_capacity, sizeof *cage->face);
    cage->tag = calloc(cage->tag_capacity, sizeof *cage->tag);
    cage->failed = !cage->point || !cage->face || !cage->tag;
}

void hs_cage_free(hs_cage *cage) {
    free(cage->point);
    free(cage->face);
    free(cage->tag);
    *cage = (hs_cage){0};
}

uint32_t hs_cage_point(hs_cage *cage, hs_vec position) {
    if (cage->failed) return 0;
    if (cage->points == cage->point_capacity) {
        hs_vec *more = realloc(cage->point, 2 * cage->point_capacity * sizeof *more);
        if (!more) {
            cage->failed = true;
            return 0;
        }
        cage->point = more;
        cage->point_capacity *= 2;
    }
    cage->point[cage->points] = position;
    return cage->points++;
}

uint32_t hs_cage_face_of(hs_cage *cage, uint32_t sides, const uint32_t *corner) {
    if (cage->failed) return 0;
    if (cage->faces == cage->face_capacity) {
        hs_cage_face *more = realloc(cage->face, 2 * cage->face_capacity * sizeof *more);
        if (!more) {
            cage->failed = true;
            return 0;
        }
        cage->face = more;
        cage->face_capacity *= 2;
    }
    hs_cage_face *f = &cage->face[cage->faces];
    *f = (hs_cage_face){.sides = sides};
    memcpy(f->corner, corner, sides * sizeof *corner);
    return cage->faces++;
}

uint32_t hs_cage_quad(hs_cage *cage, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    uint32_t corner[4] = {a, b, c, d};
    return hs_cage_face_of(cage, 4, corner);
}

uint32_t hs_cage_triangle(hs_cage *cage, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t corner[3] = {a, b, c};
    return hs_cage_face_of(cage, 3, corner);
}

void hs_cage_crease(hs_cage *cage, uint32_t a, uint32_t b, uint32_t sharpness) {
    if (cage->failed) return;
    if (cage->tags == cage->tag_capacity) {
        hs_sharp_tag *more = realloc(cage->tag, 2 * cage->tag_capacity * sizeof *more);
        if (!more) {
            cage->failed = true;
            return;
        }
        cage->tag = more;
        cage->tag_capacity *= 2;
    }
    cage->tag[cage->tags++] = (hs_sharp_tag){.v = a, .w = b, .sharpness = (float)sharpness};
}

void hs_cage_tube(hs_cage *cage, uint32_t n, const uint32_t *a, const uint32_t *b) {
    for (uint32_t i = 0; i < n; i++) {
        uint32_t next = (i + 1) % n;
        hs_cage_quad(cage, a[i], a[next], b[next], b[i]);
    }
}

uint32_t hs_box_face(const uint32_t n[3], uint32_t side, uint32_t i, uint32_t j) {
    uint32_t first = 0;
    for (uint32_t s = 0; s < side; s++)
        first += n[(s / 2 + 1) % 3] * n[(s / 2 + 2) % 3];
    return first + j * n[(side / 2 + 1) % 3] + i;
}

void hs_cage_box(hs_cage *cage, const uint32_t n[3]) {
    size_t row = n[0] + 1, layer = row * (n[1] + 1);
    uint32_t *number = calloc(layer * (n[2] + 1), sizeof *number); /* of a grid point */
    if (!number) {
        cage->failed = true;
        return;
    }
    for (uint32_t k = 0; k <= n[2]; k++)
        for (uint32_t j = 0; j <= n[1]; j++)
            for (uint32_t i = 0; i <= n[0]; i++)
                if (i % n[0] == 0 || j % n[1] == 0 || k % n[2] == 0)
                    number[k * layer + j * row + i] =
                        hs_cage_point(cage, hs_vec_of(2.0 * i / n[0] - 1, 2.0 * j / n[1] - 1,
                                                      2.0 * k / n[2] - 1));
    for (uint32_t side = 0; side < 6; side++) {
        uint32_t own = side / 2, a = (own + 1) % 3, b = (own + 2) % 3;
        size_t step[3] = {1, row, layer};
        const uint32_t *at = number + (side % 2 ? 0 : n[own] * step[own]);
        for (uint32_t j = 0; j < n[b]; j++)
            for (uint32_t i = 0; i < n[a]; i++) {
                const uint32_t *p = at + i * step[a] + j * step[b];
                uint32_t p00 = p[0], p10 = p[step[a]], p01 = p[step[b]], p11 = p[step[a] + step[b]];
                if (side % 2)
                    hs_cage_quad(cage, p00, p01, p11, p10);
                else
                    hs_cage_quad(cage, p00, p10, p11, p01);
            }
    }
    free(number);
}

hs_vec hs_ball_from_cube(hs_vec p) {
    double x = p.x * p.x, y = p.y * p.y, z = p.z * p.z;
    return hs_vec_of(p.x * sqrt(1 - y / 2 - z / 2 + y * z / 3),
                     p.y * sqrt(1 - z / 2 - x / 2 + z * x / 3),
                     p.z * sqrt(1 - x / 2 - y / 2 + x * y / 3));
}

/* --- Operations ------------------------------------------------------------------------------ */

hs_vec hs_cage_centre(const hs_cage *cage, uint32_t face) {
    const hs_cage_face *f = &cage->face[face];
    hs_vec sum = {0, 0, 0};
    for (uint32_t i = 0; i < f->sides; i++)
        sum = hs_vec_add(sum, cage->point[f->corner[i]]);
    return hs_vec_scale(sum, 1.0 / f->sides);
}

static bool has_edge(const hs_cage_face *f, uint32_t a, uint32_t b) {
    for (uint32_t c = 0; c < f->sides; c++)
        if (f->corner[c] == a && f->corner[(c + 1) % f->sides] == b) return true;
    return false;
}

/* Whether the edge a -> b belongs to a face of the region, or to one of the first faces. */
static bool region_has(const hs_cage *cage, uint32_t faces, const uint32_t *face, uint32_t a,
                       uint32_t b) {
    for (uint32_t i = 0; i < faces; i++)
        if (has_edge(&cage->face[face[i]], a, b)) return true;
    return false;
}

static bool cage_has(const hs_cage *cage, uint32_t faces, uint32_t a, uint32_t b) {
    for (uint32_t i = 0; i < faces; i++)
        if (has_edge(&cage->face[i], a, b)) return true;
    return false;
}

uint32_t hs_cage_collect(const hs_cage *cage, uint32_t faces, const uint32_t *face, uint32_t limit,
                         uint32_t *points) {
    uint32_t count = 0;
    if (cage->failed) return 0; /* the region's faces may be missing */
    for (uint32_t i = 0; i < faces; i++)
        for (uint32_t c = 0; c < cage->face[face[i]].sides; c++) {
            uint32_t p = cage->face[face[i]].corner[c], at = 0;
            while (at < count && points[at] != p)
                at++;
            if (at == count && count < limit) points[count++] = p;
        }
    return count;
}

void hs_cage_extrude(hs_cage *cage, uint32_t faces, const uint32_t *face, uint32_t *wall) {
    uint32_t old_faces = cage->faces;
    uint32_t *lifted = calloc(cage->points + 1, sizeof *lifted); /* a point's double + 1, or 0 */
    if (!lifted) cage->failed = true;
    if (cage->failed) {
        free(lifted);
        return;
    }
    for (uint32_t i = 0; i < faces; i++)
        for (uint32_t c = 0; c < cage->face[face[i]].sides; c++) {
            uint32_t p = cage->face[face[i]].corner[c];
            if (!lifted[p]) lifted[p] = hs_cage_point(cage, cage->point[p]) + 1;
        }
    if (wall) *wall = cage->faces;
    for (uint32_t i = 0; i < faces; i++)
        for (uint32_t c = 0; c < cage->face[face[i]].sides; c++) {
            const hs_cage_face *f = &cage->face[face[i]];
            uint32_t a = f->corner[c], b = f->corner[(c + 1) % f->sides];
            if (!region_has(cage, faces, face, b, a) && cage_has(cage, old_faces, b, a))
                hs_cage_quad(cage, a, b, lifted[b] - 1, lifted[a] - 1);
        }
    for (uint32_t i = 0; i < faces; i++)
        for (uint32_t c = 0; c < cage->face[face[i]].sides; c++) {
            uint32_t *corner = &cage->face[face[i]].corner[c];
            *corner = lifted[*corner] - 1;
        }
    free(lifted);
}

enum { REGION_POINTS = 256 }; /* most points of a region that is moved */

hs_vec hs_cage_middle(const hs_cage *cage, uint32_t faces, const uint32_t *face) {
    uint32_t point[REGION_POINTS];
    uint32_t count = hs_cage_collect(cage, faces, face, REGION_POINTS, point);
    hs_vec sum = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++)
        sum = hs_vec_add(sum, cage->point[point[i]]);
    return hs_vec_scale(sum, 1.0 / count);
}

void hs_cage_move(hs_cage *cage, uint32_t faces, const uint32_t *face, hs_vec centre, hs_vec scale,
                  hs_vec shift) {
    uint32_t point[REGION_POINTS];
    uint32_t count = hs_cage_collect(cage, faces, face, REGION_POINTS, point);
    for (uint32_t i = 0; i < count; i++) {
        hs_vec *p = &cage->point[point[i]], d = hs_vec_sub(*p, centre);
        d = hs_vec_of(d.x * scale.x, d.y * scale.y, d.z * scale.z);
        *p = hs_vec_add(hs_vec_add(centre, shift), d);
    }
}

void hs_cage_mirror(hs_cage *cage) {
    uint32_t points = cage->points, faces = cage->faces;
    uint32_t *image = calloc(points + 1, sizeof *image);
    if (!image) cage->failed = true;
    for (uint32_t v = 0; v < points && !cage->failed; v++) {
        hs_vec p = cage->point[v];
        image[v] = p.x != 0 ? hs_cage_point(cage, hs_vec_of(-p.x, p.y, p.z)) : v;
    }
    for (uint32_t f = 0; f < faces && !cage->failed; f++) {
        hs_cage_face from = cage->face[f], to = {0};
        for (uint32_t c = from.sides; c-- > 0;)
            to.corner[to.sides++] = image[from.corner[c]];
        hs_cage_face_of(cage, to.sides, to.corner);
    }
    free(image);
}

bool hs_cage_merge(hs_cage *cage, uint32_t a, uint32_t b) {
    hs_cage_face *fa = &cage->face[a], *fb = &cage->face[b];
    if (a == b || fa->sides + fb->sides - 2 > HS_CAGE_SIDES) return false;
    uint32_t shared = 0, edges = 0, at_a = 0, at_b = 0;
    for (uint32_t i = 0; i < fa->sides; i++)
        for (uint32_t j = 0; j < fb->sides; j++) {
            shared += fa->corner[i] == fb->corner[j];
            if (fa->corner[i] == fb->corner[(j + 1) % fb->sides] &&
                fa->corner[(i + 1) % fa->sides] == fb->corner[j]) {
                edges++;
                at_a = i;
                at_b = j;
            }
        }
    if (edges != 1 || shared != 2) return false;
    /* All corners of a from the edge's end round to its start, then b's others likewise. */
    hs_cage_face merged = {0};
    for (uint32_t i = 1; i <= fa->sides; i++)
        merged.corner[merged.sides++] = fa->corner[(at_a + i) % fa->sides];
    for (uint32_t j = 2; j < fb->sides; j++)
        merged.corner[merged.sides++] = fb->corner[(at_b + j) % fb->sides];
    *fa = merged;
    fb->sides = 0;
    return true;
}

uint32_t hs_cage_split(hs_cage *cage, uint32_t face, uint32_t i, uint32_t j) {
    hs_cage_face old = cage->face[face], kept = {0}, cut = {0};
    for (uint32_t c = i; c <= j; c++)
        kept.corner[kept.sides++] = old.corner[c];
    for (uint32_t c = j; c <= i + old.sides; c++)
        cut.corner[cut.sides++] = old.corner[c % old.sides];
    cage->face[face] = kept;
    return hs_cage_face_of(cage, cut.sides, cut.corner);
}

uint32_t hs_cage_poke(hs_cage *cage, uint32_t face) {
    hs_cage_face old = cage->face[face];
    uint32_t top = hs_cage_point(cage, hs_cage_centre(cage, face));
    for (uint32_t c = 1; c < old.sides; c++)
        hs_cage_triangle(cage, old.corner[c], old.corner[(c + 1) % old.sides], top);
    cage->face[face] = (hs_cage_face){3, {old.corner[0], old.corner[1], top}};
    return top;
}

bool hs_cage_mesh(const hs_cage *cage, const char *name, hs_mesh *mesh, hs_error *err) {
    *mesh = (hs_mesh){0};
    float *position = NULL;
    uint32_t *sides = NULL, *corner = NULL;
    if (!cage->failed) {
        position = malloc((size_t)cage->points * 4 * sizeof *position);
        sides = malloc(cage->faces * sizeof *sides);
        corner = malloc((size_t)cage->faces * HS_CAGE_SIDES * sizeof *corner);
    }
    bool ok;
    if (!position || !sides || !corner) {
        ok = hs_fail(err, HS_EXIT_INTERNAL, "%s: out of memory; ask for a smaller size", name);
    } else {
        for (uint32_t v = 0; v < cage->points; v++) {
            hs_vec p = cage->point[v];
            float xyzw[4] = {(float)p.x, (float)p.y, (float)p.z, 1};
            memcpy(position + (size_t)4 * v, xyzw, sizeof xyzw);
        }
        uint32_t faces = 0;
        size_t corners = 0;
        for (uint32_t f = 0; f < cage->faces; f++) {
            uint32_t n = cage->face[f].sides;
            if (n == 0) continue;
            memcpy(corner + corners, cage->face[f].corner, n * sizeof *corner);
            corners += n;
            sides[faces++] = n;
        }
        hs_soup soup = {.name = name,
                        .vertices = cage->points,
                        .position = position,
                        .faces = faces,
                        .sides = sides,
                        .corner = corner,
                        .tags = cage->tags,
                        .tag = cage->tag};
        ok = hs_mesh_build(mesh, &soup, NULL, err);
    }
    free(position);
    free(sides);
    free(corner);
    return ok;
}
