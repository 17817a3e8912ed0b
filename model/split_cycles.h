/* SPDX-License-Identifier: Apache-2.0
 *
 * What the model's split has in common where it fetches its items itself, and where classify hands
 * them on. An item enters, and when its face's last item has, leaves.
 */
#ifndef HS_SPLIT_CYCLES_H
#define HS_SPLIT_CYCLES_H

#include "model_parts.h"

/* What becomes of an item's edges, a bit a lane. */
typedef struct hs_edges {
    uint32_t lanes, boundary, border, replaced, lower;
    uint32_t beyond[HS_LANES]; /* the items of the twins */
    uint32_t quad[HS_LANES];   /* that replaced edges become */
    bool refined;
} hs_edges;

typedef struct hs_split_run {
    hs_model *m;
    const hs_state *s;
    bool all;           /* every quad is refined: no verdicts are read */
    uint64_t items;     /* so far */
    uint32_t quads;     /* numbered so far */
    hs_time looked;     /* the latest item asked for its twins' numbers */
    hs_time done, sent; /* the latest item is done; emit took the latest op */
    bool vertex_sent;   /* of the face, with an earlier corner */
} hs_split_run;

void hs_split_begin(hs_split_run *r, hs_model *m, const hs_state *s);
/* The first cycle from t on in which an item can enter. */
hs_time hs_split_wait(hs_split_run *r, hs_time t);
/* An item enters in cycle t; the one in which it gets to the fold. */
hs_time hs_split_enter(hs_split_run *r, uint32_t f, uint32_t item, hs_time t, hs_edges *e);
/* known: the fold shows the item with what its face's last one said. */
void hs_split_leave(hs_split_run *r, uint32_t f, uint32_t item, uint32_t corner, hs_time known,
                    const hs_edges *e);
/* The last cycle in which split is active for the items so far. */
hs_time hs_split_until(const hs_split_run *r);
/* Behind the last item: adds to the report what the windows counted. */
void hs_split_end(hs_split_run *r);

#endif
