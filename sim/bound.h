/* SPDX-License-Identifier: Apache-2.0
 *
 * The cycles that a view needs at least, in closed form, from what happened in its generations.
 *
 * Every pass takes one quad a cycle (one corner a cycle in generation 0), and one vertex moves a
 * cycle. Let A_g be the active faces of generation g (at g = 0: the corners), M_g the vertices that
 * move in it (0 at odd g), D the depth that the view asks for. Then
 *
 *   total = sum over g of classify_g + select_g + guard_g + smooth_g + split_g
 *
 *                 view-dependent                      uniform
 *   classify_g    A_g if g < D                        A_g if g < D and g is even (edge points
 *                                                     of odd generations are inherited)
 *   select_g      A_g if g < D                        0
 *   guard_g       A_g if g < D and something was      0
 *                 selected
 *   smooth_g      M_g                                 M_g
 *   split_g       A_g if g < D, or g = 0: split also  the same
 *                 sends the faces that are final
 *
 * The quads that the last step makes leave from there: generation D costs nothing. With limit
 * positions their vertices need their rings: classify_D and split_D are A_D then. Uniform
 * refinement of quads so tends to 5/3 cycles per face at even D and to 7/3 at odd ones.
 *
 * The stages before and behind work beside these, so they are no part of the total; their bounds
 * are receive: a beat of 16 words a cycle; transform and quantize: a vertex a cycle; emit: a beat
 * of 16 words a cycle.
 */
#ifndef HS_BOUND_H
#define HS_BOUND_H

#include "golden.h"

typedef struct hs_bound {
    uint64_t total;            /* classify to split, one after the other */
    uint64_t stage[HS_STAGES]; /* cycles at least, stage by stage */
} hs_bound;

/* The depth D that a view asks for: the generation in which everything is final. */
uint32_t hs_view_depth(const hs_settings *settings, const hs_mesh *mesh);

/* generation: golden's counts; generations 0 (a refused view) gives a total of 0. vertices: of the
 * initial mesh; words_in, words_out: of the packets. */
hs_bound hs_bound_of(const hs_settings *settings, uint32_t depth, const hs_generation *generation,
                     uint32_t generations, uint32_t vertices, size_t words_in, size_t words_out);

/* What this pipeline takes, in closed form, from the same counts (docs/timing.md derives it): each
 * pass that it makes at an item a cycle, and what the bound leaves out: records before generation
 * 0, smooth's walk over the marks, vertices that stay or leave, five records for four of them, and
 * about eighty cycles of latency a generation. For the default architecture, without stalls;
 * conflicts are not in it. */
uint64_t hs_expected_of(const hs_settings *settings, uint32_t depth,
                        const hs_generation *generation, uint32_t generations, size_t words_in,
                        uint32_t vertices_out);

#endif
