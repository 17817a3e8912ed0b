/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/face_geometry.sv and rtl/short_edges.sv under Verilator, a cycle at a time.
 */
#ifndef GEOMETRY_SHIM_H
#define GEOMETRY_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { GEOMETRY_LATENCY = 5, EDGES_LATENCY = 3 };

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

#ifdef __cplusplus
}
#endif
#endif
