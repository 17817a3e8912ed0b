/* SPDX-License-Identifier: Apache-2.0
 *
 * tests/sharpness_top.sv under Verilator: sharpness.sv with a memory of 32 words, a cycle at a
 * time, and vertex_kind.sv.
 */
#ifndef SHARPNESS_SHIM_H
#define SHARPNESS_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { SHARPNESS_VERTICES = 32 };

/* What receive hands over in a cycle: a vertex, a corner, or nothing. */
typedef struct sharpness_in {
    bool vertex, corner;
    uint8_t index; /* of the vertex; of the corner's */
    bool boundary;
    uint8_t sharpness, own;
} sharpness_in;

typedef struct vertex_kind {
    bool stays, crease;
} vertex_kind;

typedef struct sharpness_shim sharpness_shim;

/* Builds and resets it; seed randomizes what reset leaves alone, the memory's words too. */
sharpness_shim *sharpness_new(uint32_t seed);
void sharpness_free(sharpness_shim *shim);
void sharpness_cycle(sharpness_shim *shim, sharpness_in in);
/* A vertex' word in the memory. */
uint32_t sharpness_word(sharpness_shim *shim, uint8_t vertex);
vertex_kind sharpness_kind(sharpness_shim *shim, uint32_t word, uint8_t level, bool corners_stay);

#ifdef __cplusplus
}
#endif
#endif
