/* SPDX-License-Identifier: Apache-2.0
 *
 * Meshes made from parameters, so that nobody needs a mesh file to start: test bodies, random
 * bodies, two shapes that show what view-dependent refinement is for, a hand and a monster's head,
 * and three for boundaries and creases: a spoon, a pot and a die. All but the grid, the spoon and
 * the pot are closed; faces run counter-clockwise seen from outside; up is +y and fronts face +z.
 * Only +, -, *, / and sqrt are used, each rounded as IEEE 754 says, so the same name, size and seed
 * give the same bits on every machine.
 */
#ifndef HS_SHAPE_H
#define HS_SHAPE_H

#include <stdint.h>

#include "error.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hs_cage;

/* One shape that can be made, for help texts. */
typedef struct hs_shape {
    const char *name;
    const char *what;                  /* one line, no full stop */
    uint32_t size, min_size, max_size; /* default and range; all 0: the shape has no size */
    bool seeded;                       /* whether the seed matters */
    void (*build)(struct hs_cage *cage, uint32_t size, uint32_t seed); /* shape_kit.h */
} hs_shape;

/* The shapes, in the order in which help should show them; a name of NULL ends the list. */
extern const hs_shape hs_shapes[];

/* Makes the shape called name. size 0 stands for its default size; seed is ignored unless the
 * shape is seeded. On failure *mesh is empty and *err says which names or sizes there are
 * (HS_EXIT_USAGE), or that memory is exhausted (HS_EXIT_INTERNAL). */
bool hs_shape_make(hs_mesh *mesh, const char *name, uint32_t size, uint32_t seed, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
