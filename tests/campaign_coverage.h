/* SPDX-License-Identifier: Apache-2.0
 *
 * What a campaign's cases were: how many of each kind of mesh, coordinates and view, of each
 * status, and with each of the traits below. A kind that did not occur was not tested.
 */
#ifndef HS_TESTS_CAMPAIGN_COVERAGE_H
#define HS_TESTS_CAMPAIGN_COVERAGE_H

#include "campaign_check.h"

/* All but those of the streams are counted of cases that were not refused. */
#define TRAITS(X)                                                                                  \
    X(closed, "closed mesh")                                                                       \
    X(open, "mesh with a boundary")                                                                \
    X(parts, "several parts")                                                                      \
    X(triangle, "faces of 3 sides")                                                                \
    X(ngon, "faces of 5 to 23 sides")                                                              \
    X(large, "faces of 24 sides and more")                                                         \
    X(valence_2, "inner vertices of valence 2")                                                    \
    X(valence_5, "vertices of valence 5 to 23")                                                    \
    X(pole, "vertices of valence 24 and more")                                                     \
    X(crease, "sharp edges")                                                                       \
    X(finite, "sharpness that wears off")                                                          \
    X(sharp_vertex, "sharp vertices")                                                              \
    X(forced, "forced depths")                                                                     \
    X(uniform_even, "uniform, even depth")                                                         \
    X(uniform_odd, "uniform, odd depth")                                                           \
    X(front_even, "front depth even, over 0")                                                      \
    X(front_odd, "front depth odd")                                                                \
    X(silhouette_even, "silhouette depth even, over 0")                                            \
    X(silhouette_odd, "silhouette depth odd")                                                      \
    X(front_more, "front depth above silhouette's")                                                \
    X(depth_0, "no depth at all")                                                                  \
    X(depth_deep, "seven steps and more were made")                                                \
    X(guard_on, "guard on")                                                                        \
    X(guard_off, "guard off")                                                                      \
    X(limit, "limit positions")                                                                    \
    X(min_edge, "least edge")                                                                      \
    X(kept, "boundary kept, of an open mesh")                                                      \
    X(smooth, "boundary smooth, of an open mesh")                                                  \
    X(edge_only, "boundary edge-only, of an open mesh")                                            \
    X(nothing, "a view that refines nothing")                                                      \
    X(everything, "an adaptive view that refines all in some step")                                \
    X(some, "a view that refines a part")                                                          \
    X(ring, "a guard ring beyond what is selected")                                                \
    X(limits, "limits below the capacities")                                                       \
    X(stall_in, "stalls of the input")                                                             \
    X(stall_out, "stalls of the output")                                                           \
    X(stall_both, "stalls of both")                                                                \
    X(refused_stalled, "refused while stalled")

#define TRAIT(name, what) TRAIT_##name,
enum { TRAITS(TRAIT) TRAIT_COUNT };
#undef TRAIT

enum { SIZE_CLASSES = 6, CYCLE_CLASSES = 7, STATUSES = 64 };

typedef struct coverage {
    uint64_t mesh[MESHES], coordinates[COORDINATES], view[VIEW_TYPES], status[STATUSES];
    uint64_t trait[TRAIT_COUNT];
    uint64_t size[SIZE_CLASSES], cycles[CYCLE_CLASSES]; /* cases by faces, by cycles */
} coverage;

/* Counts a case that the checker has just checked, and found good. */
void coverage_add(coverage *sum, const campaign_case *which, const checker *c);

/* Prints the tables. Gives how many kinds did not occur, which it names. */
uint32_t coverage_print(const coverage *sum);

/* *sum += *other. */
void coverage_join(coverage *sum, const coverage *other);

#endif
