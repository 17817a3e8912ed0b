/* SPDX-License-Identifier: Apache-2.0
 *
 * spoon: a sheet of 116 quads, bowl up, hollow to the front, with one boundary.
 *
 *         _ . _          Two columns of quads run along the middle, from the bowl's tip to the
 *       /_|_|_|_\        handle's end. Two rings of quads surround them, so that every boundary
 *      | | | | | |       vertex has two faces or more, and none is a corner that stays where it is.
 *      |_|_|_|_|_|       A vertex of the inner or outer ring lies half way, or all the way, from
 *       \_|_|_|_/        the middle's rim to the outline.
 *         |||||
 *         |||||          Lengths: about 5 cm are 1.
 *         \_._/
 */
#include <math.h>

#include "shape_kit.h"

enum { ROWS = 18, RIM = 2 * ROWS + 4 }; /* RIM: vertices around the middle */

static const double bowl_centre = 1.9, bowl_width = 1.08, bowl_height = 1.5;

/* The outline's right half, from the bowl's tip down: in the bowl by the angle from the middle, in
 * the handle by half its width and y. rise: how far the middle's rim stretches along y, as a part
 * of the outline. */
typedef struct row {
    double angle, width, y, rise;
} row;

static const row rows[ROWS + 1] = {
    {66, 0, 0, 0.60},    {44, 0, 0, 0.60},    {24, 0, 0, 0.60},    {6, 0, 0, 0.62},
    {-12, 0, 0, 0.70},   {-30, 0, 0, 0.80},   {-47, 0, 0, 0.88},   {-62, 0, 0, 0.96},
    {0, 0.30, 0.31, 1},  {0, 0.205, 0.0, 1},  {0, 0.17, -0.4, 1},  {0, 0.16, -0.85, 1},
    {0, 0.165, -1.3, 1}, {0, 0.18, -1.75, 1}, {0, 0.205, -2.2, 1}, {0, 0.235, -2.65, 1},
    {0, 0.265, -3.1, 1}, {0, 0.275, -3.5, 1}, {0, 0.17, -3.87, 1},
};
static const double tip = 3.43, end = -3.97; /* y of the outline's ends */

static bool in_bowl(uint32_t j) {
    return rows[j].width == 0;
}

/* An egg, wider towards the handle. */
static void outline(uint32_t j, double *x, double *y) {
    if (!in_bowl(j)) {
        *x = rows[j].width;
        *y = rows[j].y;
        return;
    }
    const double s = hs_sin_degrees(rows[j].angle), c = hs_cos_degrees(rows[j].angle);
    *x = bowl_width * c * (1 - 0.08 * s);
    *y = bowl_centre + bowl_height * s;
}

/* The sheet over x and y: a hollow with a flat rim, and a handle that rises and comes down again,
 * vaulted across. */
static double depth(double x, double y) {
    const double u = x / bowl_width, v = (y - bowl_centre) / bowl_height;
    const double inside = 1 - u * u - v * v;
    const double along = y < 0.6 ? (0.6 - y) / (0.6 - end) : 0; /* 0 at the neck, 1 at the end */
    const double hollow = inside > 0 ? 0.62 * inside * (1 - 0.25 * inside) : 0;
    return 1.3 * along * (1 - along) * (1 - 0.35 * along) - 0.12 * along - 0.9 * along * x * x -
           hollow;
}

static uint32_t add_point(hs_cage *cage, double x, double y) {
    return hs_cage_point(cage, hs_vec_of(x, y, depth(x, y)));
}

/* Vertex i of -1, 0, 1 of the middle's row j. */
static void middle(uint32_t j, int i, double *x, double *y) {
    outline(j, x, y);
    *x *= i / 3.0;
    if (in_bowl(j)) *y = bowl_centre + rows[j].rise * (*y - bowl_centre);
    if (j == ROWS) *y += 0.12;
    if (i == 0 && j == 0) *y += 0.06; /* the ends are round */
    if (i == 0 && j == ROWS) *y -= 0.02;
}

/* Where the outline is beside vertex k of the middle's rim: down the right side from the tip, and
 * up the left. */
static void rim(uint32_t k, uint32_t *j, int *i, double *x, double *y) {
    *i = k == 0 || k == ROWS + 2 ? 0 : k < ROWS + 2 ? 1 : -1;
    *j = k == 0 ? 0 : k < ROWS + 2 ? k - 1 : k == ROWS + 2 ? ROWS : RIM - 1 - k;
    outline(*j, x, y);
    *x *= *i;
    if (k == 0) *y = tip;
    if (k == ROWS + 2) *y = end;
}

void hs_shape_spoon(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)size;
    (void)seed;
    uint32_t number[ROWS + 1][3], inner[RIM], ring[RIM];
    for (uint32_t j = 0; j <= ROWS; j++)
        for (int i = -1; i <= 1; i++) {
            double x, y;
            middle(j, i, &x, &y);
            number[j][i + 1] = add_point(cage, x, y);
        }
    for (uint32_t j = 0; j < ROWS; j++)
        for (int i = 0; i < 2; i++)
            hs_cage_quad(cage, number[j][i], number[j + 1][i], number[j + 1][i + 1],
                         number[j][i + 1]);
    for (uint32_t part = 1; part <= 2; part++) {
        for (uint32_t k = 0; k < RIM; k++) {
            uint32_t j;
            int i;
            double from_x, from_y, to_x, to_y;
            rim(k, &j, &i, &to_x, &to_y);
            middle(j, i, &from_x, &from_y);
            ring[k] = add_point(cage, from_x + (to_x - from_x) * part / 2,
                                from_y + (to_y - from_y) * part / 2);
            if (part == 1) inner[k] = number[j][i + 1];
        }
        hs_cage_tube(cage, RIM, inner, ring);
        for (uint32_t k = 0; k < RIM; k++)
            inner[k] = ring[k];
    }
}
