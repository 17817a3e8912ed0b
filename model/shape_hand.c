/* SPDX-License-Identifier: Apache-2.0
 *
 * hand: an open right hand, palm to the front, fingers up, one closed surface.
 *
 *      _  _  _          The palm is a stack of rows, each a loop of points around the hand. The
 *     | || || | _       top row is the rims of the four fingers and the webs between them; the
 *     | || || || |      two columns of every finger go on downwards, and the gaps end at once in
 *   __|_||_||_||_|      triangles. Above the wrist each finger's two columns become one in a
 *  |  :  :  :  : |__    pentagon. On the thumb's side a hole of two rows is left.
 *  |  :  :  :  : |__|   A digit is a tube of loops of 8 points from its rim to its tip, with three
 *   \_:__:__:__:_/      loops at every joint so that the joint keeps its shape under subdivision.
 *    |  :  :  : |
 *    |__:__:__:_|       Lengths: about 2 cm of a man's hand are 1.
 */
#include "shape_kit.h"

enum { FINGERS = 4, RIM = 8, COLUMNS = 9, ROWS = 9, TOP_PENTAGONS = 5, THUMB_TOP = 3 };

/* --- Digits ------------------------------------------------------------------------------------
 *
 * A loop of a digit, seen from its tip; across x dorsal = direction:
 *
 *        5 6 7     palmar
 *        4   0     -> across
 *        3 2 1     dorsal
 */

typedef struct frame {
    hs_vec centre, direction, across, palmar;
} frame;

/* The next loop of a digit: a step along, then (after half of the bend before it) its shape. */
typedef struct station {
    double step;           /* from the loop before */
    double bend;           /* degrees towards the palm, halfway along the step */
    double turn;           /* degrees sideways, against across */
    double width;          /* half of it */
    double palmar, dorsal; /* thickness to either side */
} station;

static frame bend_frame(frame f, double degrees) {
    double c = hs_cos_degrees(degrees), s = hs_sin_degrees(degrees);
    hs_vec d = f.direction, p = f.palmar;
    f.direction = hs_vec_along(hs_vec_scale(d, c), p, s);
    f.palmar = hs_vec_along(hs_vec_scale(p, c), d, -s);
    return f;
}

static frame turn_frame(frame f, double degrees) {
    double c = hs_cos_degrees(degrees), s = hs_sin_degrees(degrees);
    hs_vec d = f.direction, a = f.across;
    f.direction = hs_vec_along(hs_vec_scale(d, c), a, -s);
    f.across = hs_vec_along(hs_vec_scale(a, c), d, s);
    return f;
}

static frame advance(frame f, const station *s) {
    f.centre = hs_vec_along(f.centre, f.direction, s->step / 2);
    f = turn_frame(bend_frame(f, s->bend), s->turn);
    f.centre = hs_vec_along(f.centre, f.direction, s->step / 2);
    return f;
}

/* Position k of a loop, see above; the corners lie a little outside the ellipse, so that what is
 * left of the digit after smoothing is round and not thin. */
static hs_vec loop_position(const frame *f, const station *s, int k) {
    static const double across[RIM] = {1, 0.76, 0, -0.76, -1, -0.76, 0, 0.76};
    static const double depth[RIM] = {0, -0.76, -1, -0.76, 0, 0.76, 1, 0.76};
    double d = depth[k] * (depth[k] > 0 ? s->palmar : s->dorsal);
    return hs_vec_along(hs_vec_along(f->centre, f->across, across[k] * s->width), f->palmar, d);
}

/* Lays a nail upon two faces: sunk along the edge, domed within. */
static void add_nail(hs_cage *cage, const uint32_t *faces, hs_vec dorsal) {
    hs_vec middle = hs_cage_middle(cage, 2, faces);
    hs_cage_extrude(cage, 2, faces, NULL);
    hs_cage_move(cage, 2, faces, middle, hs_vec_of(0.8, 0.8, 0.8), hs_vec_scale(dorsal, -0.05));
    middle = hs_cage_middle(cage, 2, faces);
    hs_cage_extrude(cage, 2, faces, NULL);
    hs_cage_move(cage, 2, faces, middle, hs_vec_of(0.92, 0.92, 0.92), hs_vec_scale(dorsal, 0.09));
}

/* Builds a digit upon a rim. The nail lies between the stations nail and nail + 1. */
static void grow_digit(hs_cage *cage, const uint32_t rim[RIM], frame f, uint32_t stations,
                       const station *s, uint32_t nail) {
    uint32_t loop[RIM], last[RIM], nail_faces[2] = {0, 0};
    hs_vec dorsal = {0, 0, 0};
    for (int k = 0; k < RIM; k++)
        last[k] = rim[k];
    for (uint32_t i = 0; i < stations; i++) {
        f = advance(f, &s[i]);
        if (i == nail + 1) {
            nail_faces[0] = cage->faces + 1;
            nail_faces[1] = cage->faces + 2;
            dorsal = hs_vec_scale(f.palmar, -1);
        }
        for (int k = 0; k < RIM; k++)
            loop[k] = hs_cage_point(cage, loop_position(&f, &s[i], k));
        hs_cage_tube(cage, RIM, last, loop);
        for (int k = 0; k < RIM; k++)
            last[k] = loop[k];
    }
    /* The tip: four quads around a point a little further on. */
    uint32_t tip =
        hs_cage_point(cage, hs_vec_along(f.centre, f.direction, 0.3 * s[stations - 1].width));
    for (int k = 0; k < RIM; k += 2)
        hs_cage_quad(cage, last[(k + 7) % RIM], last[k], last[(k + 1) % RIM], tip);
    add_nail(cage, nail_faces, dorsal);
}

/* --- Fingers -----------------------------------------------------------------------------------
 */

typedef struct finger {
    double x, y;    /* centre of its rim */
    double width;   /* half, at the rim */
    double length;  /* from the rim to the tip */
    double spread;  /* degrees, from up towards the thumb */
    double bend[3]; /* degrees, at the knuckle and at the two joints */
} finger;

/* Little, ring, middle and index finger, from left to right. */
static const finger fingers[FINGERS] = {
    {-1.56, 0.45, 0.43, 2.75, -15, {6, 16, 12}},
    {-0.54, 0.95, 0.48, 3.55, -5, {4, 13, 10}},
    {0.50, 1.10, 0.50, 3.85, 2, {3, 10, 9}},
    {1.53, 0.90, 0.49, 3.45, 9, {4, 12, 9}},
};

static frame finger_frame(const finger *f) {
    double c = hs_cos_degrees(f->spread), s = hs_sin_degrees(f->spread);
    return (frame){.centre = hs_vec_of(f->x, f->y, 0.04),
                   .direction = hs_vec_of(s, c, 0),
                   .across = hs_vec_of(c, -s, 0),
                   .palmar = hs_vec_of(0, 0, 1)};
}

static void grow_finger(hs_cage *cage, const finger *f, const uint32_t rim[RIM]) {
    double w = f->width, l = f->length, joint1 = 0.43 * l, joint2 = 0.72 * l, j = 0.55 * w;
    const station s[] = {
        {0.5 * joint1, f->bend[0], 0, 0.96 * w, 0.96 * w, 0.90 * w},
        {0.5 * joint1 - j, 0, 0, 0.97 * w, 0.92 * w, 0.92 * w},
        {j, f->bend[1] / 2, 0, 1.03 * w, 0.82 * w, 1.02 * w},
        {j, f->bend[1] / 2, 0, 0.95 * w, 0.88 * w, 0.88 * w},
        {0.5 * (joint2 - joint1) - j, 0, 0, 0.91 * w, 0.90 * w, 0.80 * w},
        {0.5 * (joint2 - joint1) - j, 0, 0, 0.90 * w, 0.82 * w, 0.82 * w},
        {j, f->bend[2] / 2, 0, 0.94 * w, 0.72 * w, 0.88 * w},
        {j, f->bend[2] / 2, 0, 0.88 * w, 0.80 * w, 0.74 * w},
        {0.5 * (l - joint2) - j, 0, 0, 0.86 * w, 0.86 * w, 0.66 * w},
        {0.36 * (l - joint2), 0, 0, 0.72 * w, 0.70 * w, 0.52 * w},
        {0.10 * (l - joint2), 0, 0, 0.46 * w, 0.40 * w, 0.32 * w},
    };
    grow_digit(cage, rim, finger_frame(f), sizeof s / sizeof *s, s, 8);
}

static void grow_thumb(hs_cage *cage, const uint32_t rim[RIM]) {
    frame f = {.centre = hs_vec_of(2.00, -2.25, 0.16)};
    f.direction = hs_vec_unit(hs_vec_of(0.97, 0.15, 0.22));
    hs_vec palmar = hs_vec_of(-0.25, 0.25, 0.95);
    palmar = hs_vec_along(palmar, f.direction, -hs_vec_dot(palmar, f.direction));
    f.palmar = hs_vec_unit(palmar);
    f.across = hs_vec_cross(f.direction, f.palmar);
    const station s[] = {
        {0.46, 0, 8, 0.80, 0.58, 0.62},  {0.40, 5, 17, 0.72, 0.60, 0.62},
        {0.42, 5, 14, 0.62, 0.58, 0.58}, {0.28, 3, 4, 0.59, 0.52, 0.60},
        {0.28, 3, 2, 0.54, 0.52, 0.52},  {0.38, 0, 2, 0.52, 0.54, 0.48},
        {0.35, 0, 0, 0.53, 0.50, 0.49},  {0.25, 5, -2, 0.55, 0.44, 0.52},
        {0.25, 5, -3, 0.53, 0.48, 0.46}, {0.40, 0, -3, 0.54, 0.54, 0.40},
        {0.40, 0, 0, 0.46, 0.42, 0.32},  {0.13, 0, 0, 0.29, 0.25, 0.20},
    };
    grow_digit(cage, rim, f, sizeof s / sizeof *s, s, 9);
}

/* --- The palm ----------------------------------------------------------------------------------
 */

/* A row's points, from the little finger's side to the thumb's. */
typedef struct row {
    uint32_t front[COLUMNS], back[COLUMNS], left, right, columns;
} row;

/* Where a row lies. It sags to both sides by up to sag, as the knuckles do. */
typedef struct row_shape {
    double y, left, right, sag, front, back;
} row_shape;

static const row_shape rows[ROWS] = {
    {0},
    {0.25, -1.98, 1.98, 0.42, 0.50, 0.52},
    {-0.60, -2.02, 2.00, 0.30, 0.50, 0.56},
    {-1.30, -2.04, 2.24, 0.12, 0.50, 0.58},
    {-2.25, -1.94, 2.02, 0.05, 0.54, 0.60},
    {-3.05, -1.66, 1.62, 0.00, 0.58, 0.62},
    {-3.75, -1.36, 1.30, 0.00, 0.60, 0.64},
    {-4.45, -1.32, 1.28, 0.00, 0.66, 0.68},
    {-4.90, -1.04, 1.00, 0.00, 0.48, 0.50},
};

/* What makes a slab a hand: pads and hollows of the palm, knuckles of the back. */
static const struct bump {
    double x, y, radius, front, back;
} bumps[] = {
    {0.95, -2.40, 1.40, 0.62, 0},  {-1.25, -2.30, 1.50, 0.34, 0}, {-0.05, -1.20, 1.15, -0.30, 0},
    {-1.35, 0.00, 0.75, 0.16, 0},  {1.20, 0.25, 0.80, 0.16, 0},   {-0.10, 0.30, 0.80, 0.12, 0},
    {-1.45, -0.25, 0.55, 0, 0.22}, {-0.50, 0.10, 0.55, 0, 0.24},  {0.48, 0.20, 0.55, 0, 0.25},
    {1.42, 0.05, 0.55, 0, 0.24},
};

static hs_vec palm_position(const row_shape *r, double u, int side) {
    double x = r->left + (r->right - r->left) * (u + 1) / 2, y = r->y - r->sag * u * u;
    double z = side > 0 ? r->front : -r->back, round = 1 - 0.30 * u * u * u * u;
    z *= round;
    for (unsigned b = 0; b < sizeof bumps / sizeof *bumps; b++) {
        double dx = (x - bumps[b].x) / bumps[b].radius, dy = (y - bumps[b].y) / bumps[b].radius;
        double weight = hs_falloff(dx * dx + dy * dy);
        z += side > 0 ? bumps[b].front * weight : -bumps[b].back * weight;
    }
    return hs_vec_of(x, y, side == 0 ? 0 : z);
}

static row make_row(hs_cage *cage, const row_shape *shape, uint32_t columns) {
    row r = {.columns = columns};
    for (uint32_t c = 0; c < columns; c++) {
        double u = 2.0 * c / (columns - 1) - 1, edge = c == 0 || c == columns - 1 ? 0.95 : 1;
        r.front[c] = hs_cage_point(cage, palm_position(shape, u * edge, 1));
        r.back[c] = hs_cage_point(cage, palm_position(shape, u * edge, -1));
    }
    r.left = hs_cage_point(cage, palm_position(shape, -1, 0));
    r.right = hs_cage_point(cage, palm_position(shape, 1, 0));
    return r;
}

static void join_sides(hs_cage *cage, const row *low, const row *high, bool right) {
    uint32_t l = low->columns - 1, h = high->columns - 1;
    hs_cage_quad(cage, low->back[0], low->left, high->left, high->back[0]);
    hs_cage_quad(cage, low->left, low->front[0], high->front[0], high->left);
    if (!right) return;
    hs_cage_quad(cage, low->front[l], low->right, high->right, high->front[h]);
    hs_cage_quad(cage, low->right, low->back[l], high->back[h], high->right);
}

/* Quads between two rows of as many columns. */
static void join_rows(hs_cage *cage, const row *low, const row *high, bool right) {
    for (uint32_t c = 0; c + 1 < low->columns; c++) {
        hs_cage_quad(cage, low->front[c], low->front[c + 1], high->front[c + 1], high->front[c]);
        hs_cage_quad(cage, low->back[c + 1], low->back[c], high->back[c], high->back[c + 1]);
    }
    join_sides(cage, low, high, right);
}

/* Pentagons from a row to one of half as many columns below it. */
static void join_pentagons(hs_cage *cage, const row *low, const row *high) {
    for (uint32_t c = 0; c + 1 < low->columns; c++) {
        const uint32_t *f = high->front + 2 * c, *b = high->back + 2 * c;
        uint32_t front[5] = {low->front[c], low->front[c + 1], f[2], f[1], f[0]};
        uint32_t back[5] = {low->back[c + 1], low->back[c], b[0], b[1], b[2]};
        hs_cage_face_of(cage, 5, front);
        hs_cage_face_of(cage, 5, back);
    }
    join_sides(cage, low, high, true);
}

/* The top row: the rims of the fingers (loops as in the picture above), the webs between them, and
 * the faces down to the row below, whose columns are in turn a finger's middle and a gap. */
static void join_fingers(hs_cage *cage, const row *low, uint32_t rim[FINGERS][RIM]) {
    for (uint32_t i = 0; i < FINGERS; i++) {
        const finger *f = &fingers[i];
        frame at = finger_frame(f);
        station s = {0, 0, 0, f->width, 0.46, 0.48};
        for (int k = 0; k < RIM; k++)
            rim[i][k] = hs_cage_point(cage, loop_position(&at, &s, k));
    }
    for (uint32_t i = 0; i < FINGERS; i++) {
        const uint32_t *r = rim[i], *n = rim[i + 1 < FINGERS ? i + 1 : i];
        const uint32_t *f = low->front + 2 * i, *b = low->back + 2 * i;
        hs_cage_quad(cage, f[0], f[1], r[6], r[5]);
        hs_cage_quad(cage, f[1], f[2], r[7], r[6]);
        hs_cage_quad(cage, b[1], b[0], r[3], r[2]);
        hs_cage_quad(cage, b[2], b[1], r[2], r[1]);
        if (i + 1 == FINGERS) break;
        hs_cage_triangle(cage, f[2], n[5], r[7]);
        hs_cage_triangle(cage, b[2], r[1], n[3]);
        hs_cage_quad(cage, r[7], n[5], n[4], r[0]);
        hs_cage_quad(cage, r[0], n[4], n[3], r[1]);
    }
    const uint32_t *first = rim[0], *last = rim[FINGERS - 1];
    row top = {.front = {first[5], last[7]},
               .back = {first[3], last[1]},
               .left = first[4],
               .right = last[0],
               .columns = 2};
    join_sides(cage, low, &top, true);
}

/* Closes the wrist with a row of points across it. */
static void close_wrist(hs_cage *cage, const row *r) {
    uint32_t middle[COLUMNS], last = r->columns - 1;
    middle[0] = r->left;
    middle[last] = r->right;
    for (uint32_t c = 1; c < last; c++) {
        hs_vec sum = hs_vec_add(cage->point[r->front[c]], cage->point[r->back[c]]);
        sum = hs_vec_scale(sum, 0.5);
        sum.y -= 0.12;
        middle[c] = hs_cage_point(cage, sum);
    }
    for (uint32_t c = 0; c < last; c++) {
        hs_cage_quad(cage, middle[c], middle[c + 1], r->front[c + 1], r->front[c]);
        hs_cage_quad(cage, r->back[c], r->back[c + 1], middle[c + 1], middle[c]);
    }
}

/* --- The hand ----------------------------------------------------------------------------------
 */

void hs_shape_hand(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)size;
    (void)seed;
    row r[ROWS] = {0};
    uint32_t rim[FINGERS][RIM];
    for (uint32_t i = 1; i < ROWS; i++)
        r[i] = make_row(cage, &rows[i], i <= TOP_PENTAGONS ? COLUMNS : (COLUMNS + 1) / 2);
    join_fingers(cage, &r[1], rim);
    for (uint32_t i = 2; i < ROWS; i++)
        if (i == TOP_PENTAGONS + 1)
            join_pentagons(cage, &r[i], &r[i - 1]);
        else
            join_rows(cage, &r[i], &r[i - 1], i <= THUMB_TOP || i > THUMB_TOP + 2);
    close_wrist(cage, &r[ROWS - 1]);
    for (uint32_t i = 0; i < FINGERS; i++)
        grow_finger(cage, &fingers[i], rim[i]);
    const row *top = &r[THUMB_TOP], *mid = top + 1, *low = top + 2;
    uint32_t last = COLUMNS - 1;
    uint32_t hole[RIM] = {low->right, low->back[last],  mid->back[last],  top->back[last],
                          top->right, top->front[last], mid->front[last], low->front[last]};
    grow_thumb(cage, hole);
}
