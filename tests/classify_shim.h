/* SPDX-License-Identifier: Apache-2.0
 *
 * tests/classify_top.sv under Verilator: classify.sv, then smooth.sv, on one generation's faces and
 * vertices.
 */
#ifndef CLASSIFY_SHIM_H
#define CLASSIFY_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { CLASSIFY_VERTICES = 1024, CLASSIFY_ITEMS = 1024 };

/* An item as the record memory tells it: a quad, or in generation 0 a corner in lane 0. */
typedef struct classify_item {
    uint32_t origin[4];
    uint8_t border, boundary; /* a bit a lane */
    uint8_t sharpness[4], tag;
    bool half, last;
} classify_item;

typedef struct classify_vertex {
    int32_t position[4], old[4];
    uint32_t sharp;  /* its sharp word */
    bool sent, held; /* held is set between classify and smooth, as guard does */
} classify_vertex;

typedef struct classify_generation {
    uint8_t generation;
    bool limit, finish;
    uint16_t min_edge, width, height;
    uint32_t items, vertices;
    const classify_item *item;
    const classify_vertex *vertex;
} classify_generation;

typedef struct classified_face {
    int32_t point[4];
    bool front, stop;
} classified_face;

typedef struct smoothed_vertex {
    bool active, moved, sent, at_level;
    uint8_t marks; /* border, hits, back, front */
    int32_t position[4], old[4], left_at[4];
} smoothed_vertex;

typedef struct classify_run {
    uint32_t faces;
    uint32_t cycles; /* of classify */
    classified_face face[CLASSIFY_ITEMS];
    smoothed_vertex vertex[CLASSIFY_VERTICES];
} classify_run;

typedef struct classify_shim classify_shim;

/* Builds and resets it; seed randomizes what reset leaves alone, and when emit is ready. */
classify_shim *classify_new(uint32_t seed);
void classify_free(classify_shim *shim);
/* False if a stage did not come to an end. */
bool classify_generation_run(classify_shim *shim, const classify_generation *in, classify_run *out);

#ifdef __cplusplus
}
#endif
#endif
