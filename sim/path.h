/* SPDX-License-Identifier: Apache-2.0
 *
 * A camera path: what changes from a frame to the next. A vertex and a face are the same in two
 * frames if the half-edge rule made them of the same edge of the same faces, down to the initial
 * mesh; their numbers in the pipeline are others each time.
 *
 *   hs_history of a frame -- dictionary of all frames --> names of vertices and faces
 *   names, levels, positions in object space -- those of the frame before --> hs_path_step
 */
#ifndef HS_PATH_H
#define HS_PATH_H

#include "history.h"

/* A frame beside the one before it; the first one has nothing beside it. */
typedef struct hs_path_step {
    bool done;  /* false: no path, or the view was refused */
    bool first; /* there is no accepted frame before it */
    uint32_t faces, kept, gained, lost;
    uint32_t vertices, shared;  /* in this frame; of both */
    uint32_t settled, compared; /* of this frame; shared, settled in both, at the same level */
    uint32_t moved;             /* of the compared: at another place of object space. None, or
                                   there is a defect */
    double reached, short_of;   /* silhouette faces, counted as faces of the silhouette depth */
} hs_path_step;

typedef struct hs_path hs_path;

/* A path of views of one mesh. NULL if memory is exhausted. */
hs_path *hs_path_new(const hs_mesh *mesh);
void hs_path_free(hs_path *path);

/* Adds a frame: what golden's record, complete, and its output and report are of a view that was
 * accepted. A vertex is settled if all that went into its position, down to the initial mesh, was
 * at the level that uniform refinement has: then level and name say where it is, whatever the view.
 * Its place in object space is that of the reference, which replays golden's decisions there, at
 * its level even with settings.limit. */
bool hs_path_add(hs_path *path, hs_path_step *step, const hs_history *history,
                 const hs_output *output, const hs_golden_report *report, hs_error *err);

#endif
