/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/face_geometry.sv, rtl/short_edges.sv and rtl/marks.sv under Verilator, a cycle at a time.
 */
#ifndef GEOMETRY_SHIM_H
#define GEOMETRY_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { GEOMETRY_LATENCY = 5, EDGES_LATENCY = 3, MARKS_LATENCY = 3 };

typedef struct geometry_settings {
    bool quads;
    uint32_t min_edge, width, height;
} geometry_settings;

/* What goes in with valid: x, y, z, w of four lanes. */
typedef struct geometry_item {
    bool half, last, border;
    int32_t position[4][4], source[4][4];
} geometry_item;

/* What comes out with valid. */
typedef struct geometry_face {
    int32_t point[4];
    int64_t sum[4];
    bool front, back, hits, stop, nonquad, last_border;
    int32_t last_position[4];
} geometry_face;

typedef struct geometry_rtl geometry_rtl;

/* Builds and resets it; seed randomizes what reset leaves alone. */
geometry_rtl *geometry_rtl_new(uint32_t seed);
void geometry_rtl_free(geometry_rtl *rtl);
void geometry_rtl_reset(geometry_rtl *rtl);
/* One cycle with an item at the input, none if NULL. Gives valid_o before it, and then the face. */
bool geometry_rtl_cycle(geometry_rtl *rtl, const geometry_settings *settings,
                        const geometry_item *in, geometry_face *out);
/* short_edges' answer on those of four edges v-w that are in use (bit i: edge i), all by itself. */
bool geometry_rtl_edges(geometry_rtl *rtl, const geometry_settings *settings, uint32_t use,
                        const int32_t v[4][4], const int32_t w[4][4]);

/* The vectors of marks, x, y, w each, and which determinants count: bits 0 to 3, of P, Q, R, S. */
enum { MARKS_A, MARKS_B, MARKS_C, MARKS_D, MARKS_P, MARKS_Q, MARKS_R, MARKS_S, MARKS_VECTORS };
typedef struct geometry_marks {
    uint32_t use;
    int32_t vector[MARKS_VECTORS][3];
} geometry_marks;
/* One cycle of marks, all by itself, with vectors at the input, none if NULL. Gives the outputs
 * before it, which belong to what went in MARKS_LATENCY cycles ago. */
void geometry_rtl_marks(geometry_rtl *rtl, const geometry_marks *in, bool *front, bool *back);

#ifdef __cplusplus
}
#endif
#endif
