/* SPDX-License-Identifier: Apache-2.0
 *
 * The work of halfstep explore: the points of a shard that are not done, by as many threads as
 * there are cores.
 */
#ifndef HS_EXPLORE_WORK_H
#define HS_EXPLORE_WORK_H

#include "explore.h"

/* What is explored, and what is known of it. */
typedef struct hs_exploration {
    const hs_settings *settings;
    hs_limits limits;
    hs_mesh mesh;
    uint32_t depth; /* hs_view_depth */
    hs_views views;
    hs_packet *packet; /* of every view */
    hs_explore_space space;
    uint32_t shard, shards; /* 1 to shards */
    uint64_t points, mine;  /* in all; of this shard */
    hs_explore_row *row;    /* of every point */
    hs_explore_journal journal;
} hs_exploration;

/* Does what is not done of this shard, into rows and journal, with a progress line unless quiet.
 * jobs: threads; 0: one a core. Sets `mine`. */
bool hs_explore_work(hs_exploration *e, uint32_t jobs, bool quiet, hs_error *err);

#endif
