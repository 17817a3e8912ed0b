/* SPDX-License-Identifier: Apache-2.0
 *
 * A deforming mesh: OBJ files whose names are a pattern such as frame_%04d.obj, a mesh a view.
 */
#ifndef HS_FRAMES_H
#define HS_FRAMES_H

#include "mesh.h"

typedef struct hs_frames {
    const char *source;    /* the pattern, as it was given */
    size_t before, behind; /* where %d begins in it, and what stands behind begins */
    int digits;            /* at least, with zeroes before */
    uint32_t first, count; /* numbers of the files: first .. first + count - 1; 0: no pattern */
} hs_frames;

enum { HS_FRAMES_MOST = 65536 }; /* as many as a stream numbers views */

/* Finds the files of a pattern: a name with %d, or %04d, in it. Numbers begin with 0 or with 1 and
 * go on without a gap. *frames is empty if source is no pattern: a shape, or the name of a file
 * that is there. False if it is a pattern of no files, with a gap (HS_EXIT_FILE), or with more than
 * one number (HS_EXIT_USAGE). */
bool hs_frames_find(hs_frames *frames, const char *source, hs_error *err);

/* The name of a file of theirs, from index 0. False (HS_EXIT_FILE) if it is too long. */
bool hs_frames_name(const hs_frames *frames, uint32_t index, char *name, size_t size,
                    hs_error *err);

#endif
