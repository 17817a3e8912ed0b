/* SPDX-License-Identifier: Apache-2.0
 *
 * What vectors are made with. All end the program where something cannot be made.
 */
#ifndef HS_TESTS_MUTATION_VECTORS_MAKE_H
#define HS_TESTS_MUTATION_VECTORS_MAKE_H

#include "mesh.h"
#include "vectors.h"

_Noreturn void give_up(const char *what, const hs_error *err);

/* A vector with an empty packet; it stays where it is until the next one is added. */
vector *add_vector(vectors *all, const char *name, hs_limits limits, hs_stalls stalls);

/* A view of a mesh. */
vector *add_view(vectors *all, const char *name, hs_limits limits, const hs_mesh *mesh,
                 const float matrix[16], const hs_settings *settings, hs_stalls stalls);

/* n triangles of the same three vertices, each alone: above 255, those behind are one corner too
 * many each, first at vertex `first`. */
enum { FAN_VERTICES = 4 };
vector *add_fan(vectors *all, hs_limits limits, uint32_t n, uint32_t first);

/* Words of packets, behind the header and the matrix, and of corner h of one with so many vertices.
 */
enum { VERTICES_AT = 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS) };
static inline uint32_t corner_at(uint32_t vertices, uint32_t h) {
    return VERTICES_AT + 4 * (vertices + h);
}

/* Each aims at a few gates that meshes, views and settings by chance hardly ever reach. */
void add_aimed(vectors *all, hs_limits limits);

#endif
