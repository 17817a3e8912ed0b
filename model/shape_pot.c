/* SPDX-License-Identifier: Apache-2.0
 *
 * pot: a teapot of two parts. The body is a vase of levels around the axis, with a rim that turns
 * inward and ends there. Four of its faces are left out for the spout, a tube that ends open, and
 * two for the handle, a tube from one to the other. The lid lies upon it, open below.
 *
 *               o          Eleven faces around, so that one of them lies opposite the edge between
 *            __/ \__       two: the spout is two faces wide, the handle one. The bottom is a
 * polygon
 *    __     /_______\      of eleven sides, the lid's knob ends in eleven triangles.
 *   /  \___/         \__
 *   |  |             / /   Levels are given by radius and y; the spout and the handle by stations
 *   \__|            /_/    along a path in the plane z = 0.
 *       \_________/
 */
#include "shape_kit.h"

enum { AROUND = 11, SPOUT = 8, HANDLE = 4 };

typedef struct level {
    double radius, y;
} level;

static const level body[] = {{0.66, -1.06}, {0.96, -1.04}, {1.34, -0.74}, {1.60, -0.30},
                             {1.66, 0.15},  {1.50, 0.56},  {1.20, 0.86},  {0.98, 0.98},
                             {0.92, 1.06},  {0.84, 1.00},  {0.85, 0.80}};
enum { BODY = sizeof body / sizeof *body };

static const level lid[] = {{0.78, 0.86}, {0.79, 1.00}, {0.98, 1.10}, {0.96, 1.16}, {0.66, 1.30},
                            {0.30, 1.38}, {0.15, 1.46}, {0.16, 1.54}, {0.28, 1.64}, {0.24, 1.78}};
enum { LID = sizeof lid / sizeof *lid };

/* Faces of the body that are left out: the level below them, and the segment they begin at. */
enum { SPOUT_LEVEL = 2, HANDLE_TOP = 5, HANDLE_BOTTOM = 2, HANDLE_SEGMENT = AROUND / 2 };

/* A loop of a tube: its centre, the direction in which the tube goes on (degrees from +x towards
 * +y), and half its size in the plane and across it. */
typedef struct station {
    double x, y, direction, high, wide;
} station;

static const station spout[] = {{1.92, -0.20, 25, 0.36, 0.32}, {2.24, 0.04, 45, 0.27, 0.24},
                                {2.50, 0.42, 58, 0.21, 0.18},  {2.72, 0.80, 58, 0.18, 0.15},
                                {2.92, 1.06, 44, 0.17, 0.14},  {3.02, 1.15, 40, 0.16, 0.14}};
enum { SPOUT_STATIONS = sizeof spout / sizeof *spout };

static const station handle[] = {{-1.62, 0.86, 172, 0.14, 0.22},  {-1.98, 0.90, 182, 0.11, 0.16},
                                 {-2.32, 0.80, 212, 0.10, 0.15},  {-2.54, 0.50, 250, 0.10, 0.15},
                                 {-2.56, 0.12, 275, 0.10, 0.15},  {-2.42, -0.24, 302, 0.10, 0.15},
                                 {-2.12, -0.50, 328, 0.11, 0.16}, {-1.76, -0.60, 352, 0.14, 0.2}};
enum { HANDLE_STATIONS = sizeof handle / sizeof *handle };

/* Number of the point at a level and a segment; segments go on around. */
static uint32_t at(const uint32_t number[][AROUND], uint32_t on, uint32_t segment) {
    return number[on][segment % AROUND];
}

/* Points around the axis; the middle of the spout's four faces has none. */
static void add_levels(hs_cage *cage, const level *levels, uint32_t count, bool with_holes,
                       uint32_t number[][AROUND]) {
    for (uint32_t l = 0; l < count; l++)
        for (uint32_t s = 0; s < AROUND; s++) {
            const double angle = 360.0 * s / AROUND;
            if (with_holes && l == SPOUT_LEVEL + 1 && s == 0) continue;
            number[l][s] =
                hs_cage_point(cage, hs_vec_of(levels[l].radius * hs_cos_degrees(angle), levels[l].y,
                                              -levels[l].radius * hs_sin_degrees(angle)));
        }
}

static bool is_hole(uint32_t l, uint32_t s) {
    const bool for_spout =
        (l == SPOUT_LEVEL || l == SPOUT_LEVEL + 1) && (s == 0 || s == AROUND - 1);
    return for_spout || (s == HANDLE_SEGMENT && (l == HANDLE_TOP || l == HANDLE_BOTTOM));
}

static void add_bands(hs_cage *cage, uint32_t count, bool with_holes,
                      const uint32_t number[][AROUND]) {
    for (uint32_t l = 0; l + 1 < count; l++)
        for (uint32_t s = 0; s < AROUND; s++)
            if (!with_holes || !is_hole(l, s))
                hs_cage_quad(cage, at(number, l, s), at(number, l, s + 1), at(number, l + 1, s + 1),
                             at(number, l + 1, s));
}

/* The next loop of a tube. across, up: of its points, in parts of its size. */
static void add_station(hs_cage *cage, const station *s, uint32_t points, const double *across,
                        const double *up, uint32_t *loop) {
    const double c = hs_cos_degrees(s->direction), d = hs_sin_degrees(s->direction);
    for (uint32_t k = 0; k < points; k++)
        loop[k] = hs_cage_point(cage, hs_vec_of(s->x - d * up[k] * s->high,
                                                s->y + c * up[k] * s->high, across[k] * s->wide));
}

static void add_spout(hs_cage *cage, const uint32_t number[][AROUND]) {
    static const double across[SPOUT] = {-1, -0.78, 0, 0.78, 1, 0.78, 0, -0.78};
    static const double up[SPOUT] = {0, 0.78, 1, 0.78, 0, -0.78, -1, -0.78};
    const uint32_t l = SPOUT_LEVEL, left = AROUND - 1;
    uint32_t loop[2][SPOUT] = {{at(number, l + 1, 1), at(number, l + 2, 1), at(number, l + 2, 0),
                                at(number, l + 2, left), at(number, l + 1, left),
                                at(number, l, left), at(number, l, 0), at(number, l, 1)}};
    for (uint32_t i = 0; i < SPOUT_STATIONS; i++) {
        uint32_t *from = loop[i % 2], *to = loop[(i + 1) % 2];
        add_station(cage, &spout[i], SPOUT, across, up, to);
        hs_cage_tube(cage, SPOUT, from, to);
    }
}

/* Its outer side is up at first, and down at the end. */
static void add_handle(hs_cage *cage, const uint32_t number[][AROUND]) {
    static const double across[HANDLE] = {-1, 1, 1, -1};
    static const double up[HANDLE] = {1, 1, -1, -1}; /* the path runs to -x: up is towards -y */
    const uint32_t s = HANDLE_SEGMENT, top = HANDLE_TOP, bottom = HANDLE_BOTTOM;
    uint32_t loop[2][HANDLE] = {{at(number, top, s), at(number, top, s + 1),
                                 at(number, top + 1, s + 1), at(number, top + 1, s)}};
    for (uint32_t i = 0; i < HANDLE_STATIONS; i++) {
        uint32_t *from = loop[i % 2], *to = loop[(i + 1) % 2];
        add_station(cage, &handle[i], HANDLE, across, up, to);
        hs_cage_tube(cage, HANDLE, from, to);
    }
    const uint32_t last[HANDLE] = {at(number, bottom + 1, s), at(number, bottom + 1, s + 1),
                                   at(number, bottom, s + 1), at(number, bottom, s)};
    hs_cage_tube(cage, HANDLE, loop[HANDLE_STATIONS % 2], last);
}

void hs_shape_pot(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)size;
    (void)seed;
    uint32_t number[BODY][AROUND] = {{0}}, below[AROUND];
    add_levels(cage, body, BODY, true, number);
    add_bands(cage, BODY, true, (const uint32_t(*)[AROUND])number);
    for (uint32_t s = 0; s < AROUND; s++)
        below[s] = number[0][AROUND - 1 - s];
    hs_cage_face_of(cage, AROUND, below);
    add_spout(cage, (const uint32_t(*)[AROUND])number);
    add_handle(cage, (const uint32_t(*)[AROUND])number);

    add_levels(cage, lid, LID, false, number);
    add_bands(cage, LID, false, (const uint32_t(*)[AROUND])number);
    const uint32_t knob = hs_cage_point(cage, hs_vec_of(0, 1.84, 0));
    for (uint32_t s = 0; s < AROUND; s++)
        hs_cage_triangle(cage, at((const uint32_t(*)[AROUND])number, LID - 1, s),
                         at((const uint32_t(*)[AROUND])number, LID - 1, s + 1), knob);
}
