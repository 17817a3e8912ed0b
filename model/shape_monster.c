/* SPDX-License-Identifier: Apache-2.0
 *
 * monster: the head of a demon with curved horns, pointed ears, deep-set eyes under a brow ridge, a
 * snub nose and an open mouth with fangs. Only the half with x >= 0 is modelled; the other is its
 * mirror image.
 *
 *      front, columns from the middle      1. A cube of 10 x 12 x 5 quads, its lines spaced as
 *      row     5  6  7  8  9                  a face is, is rounded, tapered, and pushed and
 *       11    |__|__|__|__|__|  forehead      pulled by a table of smooth bumps.
 *       10    |__|__|__|__|__|  brow       2. Socket and eyeball, nostril, lips and mouth are
 *      8, 9   |__|eye  |__|__|                extruded from the quads shown here.
 *     6, 7    |nose |__|__|__|             3. Fangs are extruded from the wall behind the lips.
 *       5     |nostril_|__|__|             4. Horn and ear are limbs of 8-point loops, grown upon
 *      3, 4   |mouth   |__|__|                2 x 2 quads of the top and the side; the neck is
 *      0 - 2  |__|__|__|__|__|  chin          extruded from the bottom.
 */
#include <math.h>

#include "shape_kit.h"

enum { NX = 10, NY = 12, NZ = 5 };
enum { RIGHT = 0, TOP = 2, BOTTOM = 3, FRONT = 4 }; /* sides of the box */

static const uint32_t grid[3] = {NX, NY, NZ};

/* --- 1. The skull ------------------------------------------------------------------------------
 */

static const double line_x[NX / 2 + 1] = {0, 0.17, 0.44, 0.74, 0.88, 1};
static const double line_y[NY + 1] = {-1,   -0.92, -0.84, -0.76, -0.50, -0.24, -0.10,
                                      0.05, 0.18,  0.36,  0.54,  0.72,  1};
static const double line_z[NZ + 1] = {-1, -0.52, -0.16, 0.20, 0.58, 1};

/* Around at, within radius, everything is pushed by as much as push. */
static const struct bump {
    hs_vec at;
    double radius;
    hs_vec push;
} bumps[] = {
    {{0, -0.60, 1.50}, 1.20, {0, 0, 0.38}},          /* muzzle */
    {{0, -0.05, 1.60}, 0.52, {0, -0.05, 0.52}},      /* nose */
    {{0, 0.30, 1.60}, 0.36, {0, 0, 0.14}},           /* its bridge */
    {{0.30, -0.15, 1.55}, 0.32, {0.08, 0.03, 0.22}}, /* its wing */
    {{0.80, -0.45, 1.25}, 0.55, {0.14, 0.12, 0}},    /* corner of the mouth */
    {{0.60, 0.98, 1.30}, 0.62, {0, 0, 0.50}},        /* brow ridge */
    {{0, 0.80, 1.50}, 0.40, {0, -0.16, 0.18}},       /* frown */
    {{0.55, 0.50, 1.40}, 0.50, {0, 0, -0.20}},       /* hollow of the eye */
    {{1.10, 0.05, 0.95}, 0.60, {0.22, 0, 0.28}},     /* cheekbone */
    {{1.10, -0.70, 0.70}, 0.50, {-0.16, 0, -0.10}},  /* hollow cheek */
    {{0, -1.65, 1.10}, 0.75, {0, -0.28, 0.55}},      /* chin */
    {{1.00, -1.20, 0.20}, 0.75, {0.26, -0.12, 0}},   /* corner of the jaw */
    {{0, 1.60, 1.00}, 1.00, {0, 0, -0.20}},          /* forehead, slanting */
    {{0, 0.60, -1.40}, 1.20, {0, 0.10, -0.15}},      /* back of the head */
};

static hs_vec shape_skull(hs_vec p) {
    hs_vec ball = hs_ball_from_cube(p);
    hs_vec q = hs_vec_add(hs_vec_scale(p, 0.12), hs_vec_scale(ball, 0.88));
    q = hs_vec_of(1.45 * q.x, 1.85 * q.y, 1.60 * q.z);
    if (q.y < 0) q.x *= 1 + 0.10 * q.y; /* the jaw is narrower */
    hs_vec moved = q;
    for (unsigned b = 0; b < sizeof bumps / sizeof *bumps; b++) {
        hs_vec d = hs_vec_scale(hs_vec_sub(q, bumps[b].at), 1 / bumps[b].radius);
        moved = hs_vec_along(moved, bumps[b].push, hs_falloff(sqrt(hs_vec_dot(d, d))));
    }
    /* The eyes slant: the outer corner up, the inner one down. */
    hs_vec d = hs_vec_scale(hs_vec_sub(q, hs_vec_of(0.55, 0.60, 1.35)), 1 / 0.85);
    moved.y += 0.55 * (q.x - 0.52) * hs_falloff(sqrt(hs_vec_dot(d, d)));
    if (p.x == 0) moved.x = 0;
    return moved;
}

static void make_skull(hs_cage *cage) {
    hs_cage_box(cage, grid);
    for (uint32_t v = 0; v < cage->points; v++) {
        hs_vec p = cage->point[v];
        int i = (int)floor((p.x + 1) * NX / 2 + 0.5) - NX / 2;
        int j = (int)floor((p.y + 1) * NY / 2 + 0.5), k = (int)floor((p.z + 1) * NZ / 2 + 0.5);
        if (i >= 0)
            cage->point[v] = shape_skull(hs_vec_of(line_x[i], line_y[j], line_z[k]));
        else
            cage->point[v].x = -9; /* goes with the left half's faces */
    }
    for (uint32_t f = 0; f < cage->faces; f++)
        if (hs_cage_centre(cage, f).x < 0) cage->face[f].sides = 0;
}

/* --- 2. Eyes, nose, mouth ----------------------------------------------------------------------
 */

static void extrude(hs_cage *cage, uint32_t faces, const uint32_t *face, hs_vec centre,
                    hs_vec scale, hs_vec shift, uint32_t *wall) {
    hs_cage_extrude(cage, faces, face, wall);
    hs_cage_move(cage, faces, face, centre, scale, shift);
}

/* The region of columns i0..i1 and rows j0..j1 of a side; returns how many faces it has. */
static uint32_t select_region(uint32_t side, uint32_t i0, uint32_t i1, uint32_t j0, uint32_t j1,
                              uint32_t *face) {
    uint32_t count = 0;
    for (uint32_t j = j0; j <= j1; j++)
        for (uint32_t i = i0; i <= i1; i++)
            face[count++] = hs_box_face(grid, side, i, j);
    return count;
}

/* A loop of a limb. Its points keep their bearing around the limb's axis. */
typedef struct loop {
    hs_vec centre;
    double width, depth; /* half axes, along the limb's side and front */
    double hollow;       /* share of the depth by which the middle of the front is pushed in */
} loop;

/* Grows a limb upon 2 x 2 faces through loops; side is roughly across all of them. */
static void grow_limb(hs_cage *cage, const uint32_t face[4], hs_vec side, uint32_t loops,
                      const loop *l) {
    uint32_t point[9] = {0};
    double u[9], v[9];
    hs_vec axis = {0, 0, 0}, root = hs_cage_middle(cage, 4, face);
    for (uint32_t i = 0; i < loops; i++) {
        hs_vec before = l[i ? i - 1 : 0].centre, after = l[i + 1 < loops ? i + 1 : i].centre;
        hs_vec along = hs_vec_unit(hs_vec_sub(after, before));
        if (hs_vec_dot(along, axis) < 0) along = hs_vec_scale(along, -1); /* down into a pit */
        axis = along;
        hs_vec a = hs_vec_unit(hs_vec_along(side, along, -hs_vec_dot(side, along)));
        hs_vec b = hs_vec_cross(along, a);
        if (i == 0) {
            hs_cage_collect(cage, 4, face, 9, point);
            for (int p = 0; p < 9; p++) {
                hs_vec d = hs_vec_sub(cage->point[point[p]], root);
                u[p] = hs_vec_dot(d, a);
                v[p] = hs_vec_dot(d, b);
                double r = sqrt(u[p] * u[p] + v[p] * v[p]);
                bool middle = point[p] == cage->face[face[0]].corner[2];
                u[p] = middle ? 0 : u[p] / r;
                v[p] = middle ? 0 : v[p] / r;
            }
        }
        hs_cage_extrude(cage, 4, face, NULL);
        hs_cage_collect(cage, 4, face, 9, point);
        for (int p = 0; p < 9 && !cage->failed; p++) {
            double depth = v[p] > 0.9 ? v[p] * (1 - l[i].hollow) : v[p];
            hs_vec at = hs_vec_along(l[i].centre, a, u[p] * l[i].width);
            cage->point[point[p]] = hs_vec_along(at, b, depth * l[i].depth);
        }
    }
}

static void make_eye(hs_cage *cage) {
    uint32_t face[4];
    select_region(FRONT, 6, 7, 8, 9, face);
    hs_vec middle = hs_cage_middle(cage, 4, face);
    extrude(cage, 4, face, middle, hs_vec_of(0.90, 0.86, 0.8), hs_vec_of(0, 0, 0.03), NULL);
    extrude(cage, 4, face, middle, hs_vec_of(0.98, 1.08, 0.3), hs_vec_of(-0.02, 0, -0.26), NULL);
    /* The eyeball: loops of a ball, and a pit for the pupil. */
    middle = hs_vec_add(middle, hs_vec_of(0.02, 0.00, -0.03));
    enum { EYE_LOOPS = 5 };
    static const double radius[EYE_LOOPS] = {0.14, 0.205, 0.175, 0.10, 0.075};
    static const double depth[EYE_LOOPS] = {-0.17, -0.05, 0.09, 0.13, 0.06};
    loop l[EYE_LOOPS];
    for (int i = 0; i < EYE_LOOPS; i++)
        l[i] = (loop){hs_vec_along(middle, hs_vec_of(0.1, -0.1, 1), depth[i]), radius[i], radius[i],
                      0};
    grow_limb(cage, face, hs_vec_of(1, 0.3, 0), EYE_LOOPS, l);
}

static void make_nostril(hs_cage *cage) {
    uint32_t face[1] = {hs_box_face(grid, FRONT, 6, 5)};
    hs_vec middle = hs_cage_centre(cage, face[0]);
    extrude(cage, 1, face, middle, hs_vec_of(0.70, 0.70, 0.7), hs_vec_of(-0.02, 0, 0.03), NULL);
    extrude(cage, 1, face, middle, hs_vec_of(0.80, 0.80, 0.8), hs_vec_of(0.00, 0.08, -0.17), NULL);
}

/* The mouth: lips, and a cavity behind them. *wall receives the first quad behind the lips. */
static void make_mouth(hs_cage *cage, uint32_t *wall) {
    uint32_t face[6];
    uint32_t n = select_region(FRONT, 5, 7, 3, 4, face);
    hs_vec middle = hs_cage_middle(cage, n, face);
    middle.x = 0;
    extrude(cage, n, face, middle, hs_vec_of(0.97, 0.90, 0.9), hs_vec_of(0, 0, 0.12), NULL);
    extrude(cage, n, face, middle, hs_vec_of(0.92, 0.86, 1), hs_vec_of(0, 0, -0.08), NULL);
    extrude(cage, n, face, middle, hs_vec_of(0.97, 1.06, 0.9), hs_vec_of(0, 0, -0.25), wall);
    extrude(cage, n, face, middle, hs_vec_of(0.95, 1.02, 0.7), hs_vec_of(0, 0, -0.40), NULL);
    extrude(cage, n, face, middle, hs_vec_of(0.75, 0.70, 0.4), hs_vec_of(0, 0, -0.30), NULL);
}

/* --- 3. Teeth ----------------------------------------------------------------------------------
 */

/* The quads behind the lips, in the order in which make_mouth's extrusion lists them: those of the
 * lower row of faces, then those of the upper. The inner ones touch the plane of symmetry, where
 * nothing can be extruded from one half alone. */
enum { LOW_INNER, LOW_MIDDLE, LOW_OUTER, SIDE_LOW, UP_INNER, UP_MIDDLE, SIDE_UP, UP_OUTER };

/* A cone upon a face, by way long. */
static void make_tooth(hs_cage *cage, uint32_t face, hs_vec way) {
    hs_vec middle = hs_cage_centre(cage, face);
    extrude(cage, 1, &face, middle, hs_vec_of(0.8, 0.8, 0.8), hs_vec_scale(way, 0.35), NULL);
    middle = hs_cage_centre(cage, face);
    extrude(cage, 1, &face, middle, hs_vec_of(0.2, 0.2, 0.2), hs_vec_scale(way, 0.65), NULL);
}

static void make_teeth(hs_cage *cage, uint32_t wall) {
    static const struct {
        uint32_t place;
        hs_vec way;
    } teeth[] = {
        {UP_MIDDLE, {0, -0.18, 0.03}},    /* incisor */
        {UP_OUTER, {-0.06, -0.46, 0.10}}, /* fang */
        {LOW_MIDDLE, {0.02, 0.40, 0.08}}, /* tusk */
    };
    for (unsigned t = 0; t < sizeof teeth / sizeof *teeth; t++)
        make_tooth(cage, wall + teeth[t].place, teeth[t].way);
}

/* --- 4. Horns, ears, neck ----------------------------------------------------------------------
 */

enum { HORN_LOOPS = 12, EAR_LOOPS = 6 };

static void make_horn(hs_cage *cage) {
    uint32_t face[4];
    select_region(TOP, 2, 3, 7, 8, face);
    /* A cubic Bezier curve: out, up, and in again towards the front. */
    static const hs_vec way[4] = {
        {0.78, 1.55, 0.35}, {1.45, 2.05, 0.15}, {2.15, 2.70, 0.25}, {1.55, 3.75, 1.05}};
    loop l[HORN_LOOPS];
    for (int i = 0; i < HORN_LOOPS; i++) {
        double t = (i + 0.9) / HORN_LOOPS, s = 1 - t;
        double weight[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        hs_vec at = {0, 0, 0};
        for (int k = 0; k < 4; k++)
            at = hs_vec_along(at, way[k], weight[k]);
        double radius = (0.50 * s + 0.03) * (i % 2 ? 0.93 : 1.05); /* rings, as of growth */
        l[i] = (loop){at, radius, radius, 0};
    }
    grow_limb(cage, face, hs_vec_of(0.3, -0.3, 1), HORN_LOOPS, l);
}

static void make_ear(hs_cage *cage) {
    uint32_t face[4];
    select_region(RIGHT, 7, 8, 1, 2, face);
    static const loop l[EAR_LOOPS] = {
        {{1.52, 0.28, -0.24}, 0.28, 0.30, 0.1}, {{1.72, 0.38, -0.44}, 0.38, 0.20, 0.9},
        {{1.95, 0.52, -0.64}, 0.44, 0.14, 1.6}, {{2.22, 0.74, -0.86}, 0.34, 0.11, 1.5},
        {{2.46, 0.98, -1.04}, 0.19, 0.08, 1.0}, {{2.64, 1.18, -1.14}, 0.06, 0.04, 0.0},
    };
    grow_limb(cage, face, hs_vec_of(-0.4, 0.9, 0), EAR_LOOPS, l);
}

static void make_neck(hs_cage *cage) {
    enum { COLUMNS = 3, POINTS = (COLUMNS + 1) * (COLUMNS + 1), LOOPS = 3 };
    static const loop l[LOOPS] = {{{0, -1.95, -0.40}, 0.85, 0.80, 0},
                                  {{0, -2.40, -0.48}, 0.82, 0.80, 0},
                                  {{0, -2.85, -0.52}, 1.05, 0.98, 0}};
    uint32_t face[COLUMNS * COLUMNS], point[POINTS] = {0};
    uint32_t n = select_region(BOTTOM, 0, COLUMNS - 1, NX / 2, NX / 2 + COLUMNS - 1, face);
    hs_cage_collect(cage, n, face, POINTS, point);
    double x_most = 0, z_most = -INFINITY, z_least = INFINITY, u[POINTS], v[POINTS];
    for (int p = 0; p < POINTS; p++) {
        hs_vec at = cage->point[point[p]];
        x_most = fmax(x_most, at.x);
        z_most = fmax(z_most, at.z);
        z_least = fmin(z_least, at.z);
    }
    /* Half a rectangle becomes half a disc: hs_ball_from_cube in two dimensions. */
    for (int p = 0; p < POINTS; p++) {
        double x = cage->point[point[p]].x / x_most;
        double z = (2 * cage->point[point[p]].z - z_most - z_least) / (z_most - z_least);
        u[p] = x * sqrt(1 - z * z / 2);
        v[p] = z * sqrt(1 - x * x / 2);
    }
    for (int i = 0; i < LOOPS; i++) {
        hs_cage_extrude(cage, n, face, NULL);
        hs_cage_collect(cage, n, face, POINTS, point);
        for (int p = 0; p < POINTS && !cage->failed; p++)
            cage->point[point[p]] =
                hs_vec_add(l[i].centre, hs_vec_of(u[p] * l[i].width, 0, v[p] * l[i].depth));
    }
}

/* --- The head ----------------------------------------------------------------------------------
 */

void hs_shape_monster(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)size;
    (void)seed;
    uint32_t wall = 0;
    make_skull(cage);
    if (cage->failed) return;
    make_eye(cage);
    make_nostril(cage);
    make_mouth(cage, &wall);
    if (cage->failed) return;
    make_teeth(cage, wall);
    make_horn(cage);
    make_ear(cage);
    make_neck(cage);
    hs_cage_mirror(cage);
}
