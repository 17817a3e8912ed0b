/* SPDX-License-Identifier: Apache-2.0
 *
 * mixed: a ball with every valence from 3 to 12 and faces of every number of sides from 3 to 9.
 *
 * On a cubed ball of 6 x 6 quads a side, strips of quads are merged into one face each, two strips
 * a side; q quads give 2q + 2 sides, and half a quad more at the end, one side more:
 *
 *      __ __ __                   __ __ __
 *     |        |  q = 3: 8        |     | /|  q = 2 and a half: 7, and a triangle left over
 *     |__ __ __|                  |__ __|/_|
 *
 * Five strips stay faces of 5 to 9 sides. Seven, of 6 to 12 sides, are poked: their centres get
 * valences 6 to 12. Valence 3 appears where an edge was taken away, 5 where one was added.
 */
#include "shape_kit.h"

static const uint32_t grid[3] = {6, 6, 6};

/* Merges the strip of faces that begins at (0, row) of a side into one of so many sides. */
static uint32_t merge_strip(hs_cage *cage, uint32_t side, uint32_t row, uint32_t sides) {
    uint32_t first = hs_box_face(grid, side, 0, row), quads = (sides - 2) / 2;
    for (uint32_t q = 1; q < quads; q++)
        hs_cage_merge(cage, first, hs_box_face(grid, side, q, row));
    if (sides % 2) { /* the half of the next quad that has corner 0, on the strip's side */
        uint32_t half = hs_cage_split(cage, hs_box_face(grid, side, quads, row), 1, 3);
        hs_cage_merge(cage, first, half);
    }
    return first;
}

void hs_shape_mixed(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)size;
    (void)seed;
    hs_cage_box(cage, grid);
    for (uint32_t v = 0; v < cage->points; v++)
        cage->point[v] = hs_ball_from_cube(cage->point[v]);
    if (cage->failed) return;
    for (uint32_t strip = 0; strip < 12; strip++) {
        uint32_t side = strip % 6, row = strip < 6 ? 1 : 4; /* far enough to share no point */
        if (strip < 5)
            merge_strip(cage, side, row, 5 + strip);
        else
            hs_cage_poke(cage, merge_strip(cage, side, row, 1 + strip));
    }
}
