/* SPDX-License-Identifier: Apache-2.0
 *
 * die: a cube of 5 x 5 faces a side, with pips sunk into it. Its edges are sharp, but not as far as
 * the corners, which stay round: a crease ends a face before them.
 *
 *      -1  -0.7 -0.24 0.24 0.7  1       A pip is a face, drawn in (its rim) and pushed down, in two
 *     1 ._____________________.         steps. Sides that lie opposite each other have seven pips
 *       |___|____|_____|____|_|         together; one, two and three run counter-clockwise around
 *       |   | o  |     | o  | |         their common corner.
 *       |___|____|_____|____|_|
 *       |   |    |  o  |    | |         Smoothed, edges get a radius of about the outer faces'
 *                                       width; with a sharpness of s, of about 2^-s of that.
 */
#include <math.h>

#include "shape_kit.h"

enum { SIDES = 6, CELLS = 5 };

/* Bit 3j + i: a pip in column i and row j. */
static const uint32_t pips[SIDES] = {
    0020, /* +x: one */
    0555, /* -x: six, in two columns */
    0401, /* +y: two */
    0525, /* -y: five */
    0421, /* +z: three */
    0505, /* -z: four */
};

static const double line[CELLS + 1] = {-1, -0.7, -0.24, 0.24, 0.7, 1};

static double place(double even) {
    return line[(int)((even + 1) * CELLS / 2 + 0.5)];
}

#define CORNER 0.8 /* how far out corners are, the cube's being 1 */

static bool is_corner(hs_vec p) {
    return fabs(p.x) + fabs(p.y) + fabs(p.z) == 3;
}

/* On an edge of the cube two coordinates are at an end. Both points have to be on the same edge,
 * and none of them at a corner. */
static bool on_an_edge(hs_vec p, hs_vec q) {
    const bool x = p.x == q.x && fabs(p.x) == 1, y = p.y == q.y && fabs(p.y) == 1,
               z = p.z == q.z && fabs(p.z) == 1;
    return x + y + z == 2 && !is_corner(p) && !is_corner(q);
}

static void crease_edges(hs_cage *cage, uint32_t sharpness) {
    for (uint32_t f = 0; f < cage->faces; f++)
        for (uint32_t i = 0; i < cage->face[f].sides; i++) {
            const uint32_t a = cage->face[f].corner[i],
                           b = cage->face[f].corner[(i + 1) % cage->face[f].sides];
            if (a < b && on_an_edge(cage->point[a], cage->point[b]))
                hs_cage_crease(cage, a, b, sharpness);
        }
}

static void sink_pip(hs_cage *cage, uint32_t side, uint32_t i, uint32_t j) {
    const uint32_t n[3] = {CELLS, CELLS, CELLS};
    const uint32_t face = hs_box_face(n, side, i + 1, j + 1);
    const double down = side % 2 ? 0.1 : -0.1;
    const hs_vec shift =
        hs_vec_of(side / 2 == 0 ? down : 0, side / 2 == 1 ? down : 0, side / 2 == 2 ? down : 0);
    hs_vec centre = hs_cage_centre(cage, face);
    hs_cage_extrude(cage, 1, &face, NULL);
    hs_cage_move(cage, 1, &face, centre, hs_vec_of(0.84, 0.84, 0.84), hs_vec_of(0, 0, 0));
    hs_cage_extrude(cage, 1, &face, NULL);
    hs_cage_move(cage, 1, &face, centre, hs_vec_of(0.72, 0.72, 0.72), shift);
    centre = hs_vec_add(centre, shift);
    hs_cage_extrude(cage, 1, &face, NULL);
    hs_cage_move(cage, 1, &face, centre, hs_vec_of(0.5, 0.5, 0.5), hs_vec_scale(shift, 0.8));
}

void hs_shape_die(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)seed;
    const uint32_t n[3] = {CELLS, CELLS, CELLS};
    hs_cage_box(cage, n);
    if (cage->failed) return;
    for (uint32_t v = 0; v < cage->points; v++) {
        hs_vec *p = &cage->point[v];
        *p = hs_vec_of(place(p->x), place(p->y), place(p->z));
    }
    if (size > 1) crease_edges(cage, size - 1);
    for (uint32_t v = 0; v < cage->points; v++)
        if (is_corner(cage->point[v])) cage->point[v] = hs_vec_scale(cage->point[v], CORNER);
    for (uint32_t side = 0; side < SIDES; side++)
        for (uint32_t k = 0; k < 9; k++)
            if (pips[side] >> k & 1) sink_pip(cage, side, k % 3, k / 3);
}
