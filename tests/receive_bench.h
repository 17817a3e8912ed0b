/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/receive.sv behind a C interface, with its neighbours played: a source of beats that pauses
 * at random, a transform of 9 cycles that computes overflows in binary32, memories that write
 * down what they are given.
 */
#ifndef RECEIVE_BENCH_H
#define RECEIVE_BENCH_H

#include "stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The capacities with which tests/receive.mk builds it. */
enum { RECEIVE_VERTICES = 512, RECEIVE_QUADS = 1024 };

typedef struct receive_corner {
    uint32_t origin, twin, face; /* twin: HS_BORDER if it has none */
    uint8_t forced, first, last;
    uint8_t border, boundary;
    uint8_t sharpness, own; /* of the edge, of the vertex */
} receive_corner;

/* How a packet is sent. */
typedef struct receive_send {
    uint32_t seed;           /* of the pauses */
    uint8_t pause;           /* per cent of the cycles without a beat */
    bool empty_beat;         /* TLAST comes in a beat of its own, without records */
    uint32_t start_cycle;    /* start_i's; 0 is the cycle of the packet before's done_o */
    uint32_t limit_vertices; /* registers */
    uint32_t limit_quads;
} receive_send;

/* What came of it, sampled in the cycle of done_o. */
typedef struct receive_result {
    uint32_t status, position, view;
    uint32_t uniform, guard, limit, kept, corners_stay;
    uint32_t front_depth, silhouette_depth, uniform_depth, min_edge, width, height;
    uint32_t vertices, faces, halfedges, forced_max, closed, boundary_count;
    uint32_t matrix[16];
    uint32_t vertices_stored, corners_stored, vertices_done; /* how many pulses */
    uint32_t vertex[RECEIVE_VERTICES][4];
    receive_corner corner[RECEIVE_QUADS];
    uint32_t busy, starved, blocked, items_in, items_out; /* from start_i to done_o */
    uint32_t cycles;       /* from the cycle after start_i to done_o's */
    uint32_t not_in_order; /* vertices or corners whose index was not the next */
    uint32_t
        wrong_cycles; /* with tready before start_i or behind the last beat, or a second done_o */
    bool finished;    /* done_o came in time, behind the last beat, the transform idle */
} receive_result;

typedef struct receive_bench receive_bench;

/* Builds and resets one with 1, 2 or 4 records a beat; seed randomizes what reset leaves alone.
 * NULL if there is none of that width. */
receive_bench *receive_bench_new(uint32_t port_records, uint32_t seed);
void receive_bench_free(receive_bench *bench);

/* Sends a packet; its first beat is offered from cycle 0 on, before start_i. */
void receive_bench_run(receive_bench *bench, const hs_packet *packet, const receive_send *send,
                       receive_result *result);

#ifdef __cplusplus
}
#endif
#endif
