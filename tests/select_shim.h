/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/select.sv under Verilator, with the memories around it: a generation at a time.
 */
#ifndef SELECT_SHIM_H
#define SELECT_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { SELECT_VERTICES = 256, SELECT_ITEMS = 256 };
enum { SELECT_FRONT = 1, SELECT_BACK = 2, SELECT_HITS = 4 }; /* marks of a vertex */

/* A generation: items are quads, half-quads among them, or the corners of n-gons, in lane 0. */
typedef struct select_generation {
    bool quads;
    uint32_t generation, front_depth, silhouette_depth;
    uint32_t items;
    struct {
        uint8_t origin[4], forced;
        bool half, candidate, last;
    } item[SELECT_ITEMS];
    struct {
        bool front, stop;
    } face[SELECT_ITEMS];
    uint8_t mark[SELECT_VERTICES];
} select_generation;

typedef struct select_verdicts {
    uint32_t faces; /* verdicts that came */
    bool any;       /* there are selected faces, as the module says */
    bool verdict[SELECT_ITEMS];
    bool read[SELECT_VERTICES], chosen[SELECT_VERTICES]; /* marks that were read; what was set */
} select_verdicts;

typedef struct select_rtl select_rtl;

/* Builds and resets it; seed randomizes what reset leaves alone. */
select_rtl *select_rtl_new(uint32_t seed);
void select_rtl_free(select_rtl *rtl);
/* False if it does not come to an end, or the verdicts do not come in the order of the faces. */
bool select_rtl_run(select_rtl *rtl, const select_generation *in, select_verdicts *out);

#ifdef __cplusplus
}
#endif
#endif
