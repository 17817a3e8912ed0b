/* SPDX-License-Identifier: Apache-2.0
 *
 * One case of the differential campaign: a mesh, a view, settings, limits, stalls, and perhaps a
 * fault in the packet. All of it follows from a seed; consecutive seeds take turns in the kinds of
 * views and faults.
 */
#ifndef HS_TESTS_CAMPAIGN_CASE_H
#define HS_TESTS_CAMPAIGN_CASE_H

#include "campaign_polygons.h"
#include "cycles.h"
#include "golden.h"

/* Where the mesh began, before it was changed at random. */
#define MESH_KINDS(X)                                                                              \
    X(cube, "cube with tags, faces missing")                                                       \
    X(grid, "grid")                                                                                \
    X(torus, "torus")                                                                              \
    X(prism, "prism of n sides")                                                                   \
    X(bicone, "two poles of valence n")                                                            \
    X(pillow, "two n-gons back to back")                                                           \
    X(cone, "pole of valence n, open or closed")                                                   \
    X(polygon, "one n-gon")                                                                        \
    X(body, "random body")                                                                         \
    X(mixed, "valences 3 to 12, 3 to 9 sides")                                                     \
    X(parts, "several parts")

/* What was done to its coordinates at the end. */
#define COORDINATE_KINDS(X)                                                                        \
    X(plain, "shaken")                                                                             \
    X(lattice, "on a coarse lattice")                                                              \
    X(coincident, "some vertices in one place")                                                    \
    X(rational, "w from 1/4 to 4")                                                                 \
    X(infinite, "some w zero or negative")                                                         \
    X(stretched, "axes of other scales")                                                           \
    X(distant, "far from the origin")                                                              \
    X(tiny, "tiny, to subnormal")                                                                  \
    X(huge, "huge")

#define VIEW_KINDS(X)                                                                              \
    X(orbit, "around")                                                                             \
    X(close, "near")                                                                               \
    X(inside, "inside the mesh")                                                                   \
    X(corner, "the eye in a vertex")                                                               \
    X(grazing, "grazing")                                                                          \
    X(far, "far away")                                                                             \
    X(behind, "behind the eye")                                                                    \
    X(across, "half behind the eye")                                                               \
    X(beside, "out of view")                                                                       \
    X(orthographic, "orthographic")                                                                \
    X(identity, "identity")                                                                        \
    X(mirrored, "mirrored")                                                                        \
    X(negated, "negated, w < 0")                                                                   \
    X(zero_row, "a row of zeros")                                                                  \
    X(zero, "all zero")                                                                            \
    X(equal_rows, "singular: two equal rows")                                                      \
    X(rank_one, "singular: rank one")                                                              \
    X(integers, "small integers")                                                                  \
    X(any, "any matrix")                                                                           \
    X(large, "large numbers")                                                                      \
    X(small, "small numbers, to subnormal")

#define MESH(name, what)        MESH_##name,
#define COORDINATES(name, what) COORDINATES_##name,
#define VIEW(name, what)        VIEW_##name,
enum { MESH_KINDS(MESH) MESHES };
enum { COORDINATE_KINDS(COORDINATES) COORDINATES };
enum { VIEW_KINDS(VIEW) VIEW_TYPES };
#undef MESH
#undef COORDINATES
#undef VIEW
extern const char *const mesh_kind[MESHES], *const coordinate_kind[COORDINATES],
                                                *const view_kind[VIEW_TYPES];

typedef struct campaign_case {
    uint64_t seed;
    uint32_t mesh, coordinates, view; /* kinds */
    polygons shape;
    float matrix[16];
    hs_settings settings;
    hs_limits limits;
    hs_stalls stalls;
    uint32_t number;   /* of the view: TID */
    uint32_t fault;    /* the status that the packet is spoiled for, HS_STATUS_OK: it is not */
    uint32_t fault_at; /* any number: where */
} campaign_case;

/* The case of a seed. Ends the program if memory is exhausted. */
void campaign_make(campaign_case *c, uint64_t seed);

/* The packet of a case, its fault included, the limits that it is meant for, and the status that it
 * is spoiled for: HS_STATUS_OK if it is not, or if its mesh has no place for the fault. False if
 * the faces are no mesh or memory is exhausted. */
bool campaign_packet(const campaign_case *c, hs_packet *packet, hs_limits *limits, uint32_t *wanted,
                     hs_error *err);

/* The same without the fault. */
bool campaign_good_packet(const campaign_case *c, hs_packet *packet, hs_error *err);

/* Faults that a packet may have: statuses from HS_STATUS_BAD_MAGIC on, all of them. */
enum { FIRST_FAULT = HS_STATUS_BAD_MAGIC, FAULTS = HS_STATUS_BAD_SHARPNESS - FIRST_FAULT + 1 };

/* Spoils a good packet so that it is refused with the status `fault`; at: any number. Lowers the
 * limits for that, if need be. False, the packet as it was, if this mesh has no place for it. */
bool campaign_spoil(hs_packet *packet, hs_limits *limits, uint32_t fault, uint32_t at);

#endif
