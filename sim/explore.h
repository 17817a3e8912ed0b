/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep explore in parts: a space of micro-architectures, times views, is a row of points; each
 * point is a run of the cycle-level model; those of an architecture with several views in flight
 * are one run, in which the views stream through it in a row. What is known of a point is a line in
 * a journal, so that an interrupted exploration goes on where it was, and many machines can share
 * one.
 *
 *   explore_space.c    settings -> points
 *   explore_journal.c  points that are done, on disk
 *   explore_work.c     workers
 *   explore_report.c   CSV, JSON, the table
 *   cmd_explore.c      options
 */
#ifndef HS_EXPLORE_H
#define HS_EXPLORE_H

#include <stdio.h>

#include "bound.h"
#include "model.h"
#include "view.h"

/* --- The space ----------------------------------------------------------------------------------
 */
enum { HS_EXPLORE_NAMES = 8, HS_EXPLORE_VALUES = 16 };

/* For each parameter of hs_model_config, by the name that --set knows, the values to try. */
typedef struct hs_explore_space {
    struct {
        uint32_t value[HS_EXPLORE_VALUES], count;
        bool given;
    } parameter[HS_EXPLORE_NAMES];
    uint32_t views;
} hs_explore_space;

const char *hs_explore_name(uint32_t parameter);

/* Every parameter with its default value. */
void hs_explore_space_start(hs_explore_space *space, uint32_t views);

/* Reads "banks=2,4,8". HS_EXIT_USAGE: no such parameter, a value that the model does not take, one
 * that is there twice, too many. */
bool hs_explore_set(hs_explore_space *space, const char *text, hs_error *err);

/* Points are numbered view by view within a configuration; the last parameter varies fastest. */
uint64_t hs_explore_points(const hs_explore_space *space);
hs_model_config hs_explore_config(const hs_explore_space *space, uint64_t point);
static inline uint32_t hs_explore_view(const hs_explore_space *space, uint64_t point) {
    return (uint32_t)(point % space->views);
}
/* The value of a parameter. */
uint32_t hs_explore_value(const hs_model_config *config, uint32_t parameter);

/* --- What is known of a point -------------------------------------------------------------------
 */
enum {
    HS_EXPLORE_POINT, /* number of the point */
    HS_EXPLORE_STATUS,
    HS_EXPLORE_FACES,
    HS_EXPLORE_VERTICES,
    HS_EXPLORE_CYCLES, /* of the view: from its first word offered to its last one out */
    HS_EXPLORE_STREAM, /* of all views in a row; 0: they were run apart */
    HS_EXPLORE_BOUND,
    HS_EXPLORE_FIRST_FACE, /* cycles to the first face and to the trailer; HS_NO_CYCLE: there is
                              none */
    HS_EXPLORE_TRAILER,
    HS_EXPLORE_CONFLICTS,
    HS_EXPLORE_READ, /* bits, of all memories */
    HS_EXPLORE_WRITTEN,
    HS_EXPLORE_ACTIVITY, /* stage by stage: busy, starved, blocked, idle */
    HS_EXPLORE_COLUMNS = HS_EXPLORE_ACTIVITY + HS_STAGES * HS_ACTIVITIES
};

typedef struct hs_explore_row {
    bool done;
    uint64_t value[HS_EXPLORE_COLUMNS];
} hs_explore_row;

/* --- The journal --------------------------------------------------------------------------------
 */
typedef struct hs_explore_journal {
    int file;
    char path[4200];
} hs_explore_journal;

/* Opens this shard's journal in a folder, and reads all journals there into row[points]. The
 * fingerprint is that of what is explored: journals of something else are refused
 * (HS_EXIT_USAGE), as is one that another process writes. A torn last line is cut off. */
bool hs_explore_journal_open(hs_explore_journal *journal, const char *folder, uint32_t shard,
                             uint32_t shards, uint32_t fingerprint, hs_explore_row *row,
                             uint64_t points, hs_error *err);
bool hs_explore_journal_add(hs_explore_journal *journal, const hs_explore_row *row, hs_error *err);
void hs_explore_journal_close(hs_explore_journal *journal);

/* --- Reports ------------------------------------------------------------------------------------
 */
typedef struct hs_explore_result {
    const hs_explore_space *space;
    const hs_explore_row *row; /* all done */
    const char *mesh;
    double clock; /* MHz; 0: not given */
} hs_explore_result;

bool hs_explore_write_csv(const hs_explore_result *result, const char *path, hs_error *err);
bool hs_explore_write_json(const hs_explore_result *result, const char *path, hs_error *err);

/* A line a configuration, all views together, with the parameters that were set; * marks those that
 * no other beats in both cycles and memory. The ratio is to the bound of as many
 * pipelines as there are views in flight. */
void hs_explore_print(const hs_explore_result *result, FILE *out);

#endif
