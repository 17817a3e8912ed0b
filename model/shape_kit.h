/* SPDX-License-Identifier: Apache-2.0
 *
 * The modeller's kit behind the shapes (shape.h): a cage, that is, lists of points and faces that
 * may be edited, and the few operations from which the shapes are made.
 *
 *   extrude        inset = extrude + scale     merge            split            poke
 *    ____            ________                  ________          ________        ________
 *   /___/|          |\ ____ /|                |   :    |        |      / |      |\      /|
 *   |   ||          | |    | |                | a : b  |        |   /    |      |   \/   |
 *   |___|/          |_/----\_|                |___:____|        |/_______|      |__/__\__|
 *
 * Running out of memory sets cage->failed; from then on every new point and face is number 0, so
 * that builders need to look at nothing and hs_cage_mesh reports it once.
 */
#ifndef HS_SHAPE_KIT_H
#define HS_SHAPE_KIT_H

#include <stdbool.h>
#include <stdint.h>

#include "error.h"
#include "mesh.h"

enum { HS_CAGE_SIDES = 12 }; /* most sides of a cage's face */

typedef struct hs_vec {
    double x, y, z;
} hs_vec;

typedef struct hs_cage_face {
    uint32_t sides; /* 0: deleted */
    uint32_t corner[HS_CAGE_SIDES];
} hs_cage_face;

typedef struct hs_cage {
    hs_vec *point;
    hs_cage_face *face;
    hs_sharp_tag *tag;
    uint32_t points, faces, tags;
    uint32_t point_capacity, face_capacity, tag_capacity;
    bool failed;
} hs_cage;

/* --- Vectors and numbers --------------------------------------------------------------------- */

static inline hs_vec hs_vec_of(double x, double y, double z) {
    return (hs_vec){x, y, z};
}
static inline hs_vec hs_vec_add(hs_vec a, hs_vec b) {
    return (hs_vec){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline hs_vec hs_vec_sub(hs_vec a, hs_vec b) {
    return (hs_vec){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline hs_vec hs_vec_scale(hs_vec a, double s) {
    return (hs_vec){a.x * s, a.y * s, a.z * s};
}
/* a + b*s */
static inline hs_vec hs_vec_along(hs_vec a, hs_vec b, double s) {
    return (hs_vec){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s};
}
static inline double hs_vec_dot(hs_vec a, hs_vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
hs_vec hs_vec_cross(hs_vec a, hs_vec b);
/* a / |a|; a itself if it is zero. */
hs_vec hs_vec_unit(hs_vec a);

/* Sine and cosine of degrees. The C library's differ in the last bit between versions; these are a
 * fixed row of IEEE operations. Error below 1e-15. */
double hs_sin_degrees(double degrees);
double hs_cos_degrees(double degrees);

/* 1 at the distance 0, 0 from the distance 1 on, smooth between. */
double hs_falloff(double distance);

/* The next number of a generator (Steele, Lea and Flood's SplitMix64): any state is a good seed. */
uint64_t hs_random_next(uint64_t *state);
/* An integer in 0 .. below-1, below > 0. */
uint32_t hs_random_below(uint64_t *state, uint32_t below);
/* A number in [-1, 1). */
double hs_random_signed(uint64_t *state);

/* --- The cage -------------------------------------------------------------------------------- */

/* Both allocate; failed is set when memory is exhausted. */
void hs_cage_init(hs_cage *cage);
void hs_cage_free(hs_cage *cage);

/* Appends, and gives the number back. */
uint32_t hs_cage_point(hs_cage *cage, hs_vec position);
uint32_t hs_cage_face_of(hs_cage *cage, uint32_t sides, const uint32_t *corner);
uint32_t hs_cage_quad(hs_cage *cage, uint32_t a, uint32_t b, uint32_t c, uint32_t d);
uint32_t hs_cage_triangle(hs_cage *cage, uint32_t a, uint32_t b, uint32_t c);

/* Makes the edge between two points sharp for so many Catmull-Clark levels, 10 and more: for ever.
 * It has to be one of the finished mesh's. */
void hs_cage_crease(hs_cage *cage, uint32_t a, uint32_t b, uint32_t sharpness);

/* The faces between two loops of n points each, one quad a side: (a0, a1, b1, b0) and so on. */
void hs_cage_tube(hs_cage *cage, uint32_t n, const uint32_t *a, const uint32_t *b);

/* The surface of the cube [-1, 1]^3, n[axis] quads along each axis; the cage must be empty. The
 * sides are numbered +x, -x, +y, -y, +z, -z; hs_box_face gives the number of a side's quad: i
 * counts along the axis after the side's own (x, y, z, x, ...), j along the one after that. */
void hs_cage_box(hs_cage *cage, const uint32_t n[3]);
uint32_t hs_box_face(const uint32_t n[3], uint32_t side, uint32_t i, uint32_t j);

/* Maps the cube [-1, 1]^3 onto the unit ball, sides onto the sphere, evenly and without a root of
 * a sum of squares at the centre (P. Nowell, "Mapping a Cube to a Sphere", 2005). */
hs_vec hs_ball_from_cube(hs_vec p);

/* --- Operations ------------------------------------------------------------------------------ */

hs_vec hs_cage_centre(const hs_cage *cage, uint32_t face);

/* Lifts a region of faces off the surface: its points are doubled, and quads join the region to
 * the faces around it (where there are none, as on the edge of a half body, none are made). The
 * new points lie upon the old ones; move them. If wall is not NULL it receives the number of the
 * first of the quads; the rest follow it. */
void hs_cage_extrude(hs_cage *cage, uint32_t faces, const uint32_t *face, uint32_t *wall);

/* The mean of a region's points. */
hs_vec hs_cage_middle(const hs_cage *cage, uint32_t faces, const uint32_t *face);

/* Moves every point of a region: first scaled about centre, per axis, then shifted. */
void hs_cage_move(hs_cage *cage, uint32_t faces, const uint32_t *face, hs_vec centre, hs_vec scale,
                  hs_vec shift);

/* The points of a region, each once, in an order that extruding does not change. Returns how many
 * there are; no more than limit are written. */
uint32_t hs_cage_collect(const hs_cage *cage, uint32_t faces, const uint32_t *face, uint32_t limit,
                         uint32_t *points);

/* Adds the mirror image of everything at the plane x = 0; points with x = 0 are shared. Creases are
 * to be made afterwards. */
void hs_cage_mirror(hs_cage *cage);

/* Makes one face of two that share exactly one edge and no other point. Keeps number a, deletes b.
 * False, with nothing changed, if they don't, or the face would have too many sides. */
bool hs_cage_merge(hs_cage *cage, uint32_t a, uint32_t b);

/* Cuts a face from corner i to corner j, i < j, which are not neighbours. The face keeps corners
 * i..j; the other side becomes the new face, whose number is returned. */
uint32_t hs_cage_split(hs_cage *cage, uint32_t face, uint32_t i, uint32_t j);

/* Replaces a face of n sides by n triangles around a new point at its centre, which is returned. */
uint32_t hs_cage_poke(hs_cage *cage, uint32_t face);

/* Makes the mesh; name is for messages. */
bool hs_cage_mesh(const hs_cage *cage, const char *name, hs_mesh *mesh, hs_error *err);

/* --- The larger builders, a file each -------------------------------------------------------- */

void hs_shape_mixed(hs_cage *cage, uint32_t size, uint32_t seed);
void hs_shape_random(hs_cage *cage, uint32_t size, uint32_t seed);
void hs_shape_hand(hs_cage *cage, uint32_t size, uint32_t seed);
void hs_shape_monster(hs_cage *cage, uint32_t size, uint32_t seed);
void hs_shape_spoon(hs_cage *cage, uint32_t size, uint32_t seed);
void hs_shape_pot(hs_cage *cage, uint32_t size, uint32_t seed);
void hs_shape_die(hs_cage *cage, uint32_t size, uint32_t seed);
/* size segments around the axis (+y), half as many around the tube; radii 1 and 0.4. */
void hs_shape_torus(hs_cage *cage, uint32_t size, uint32_t seed);

#endif
