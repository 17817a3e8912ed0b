/* SPDX-License-Identifier: Apache-2.0
 *
 * Where a command's mesh comes from: an OBJ file, or `shape:NAME[:SIZE[:SEED]]` for one of the
 * built-in shapes (model/shape.h), as in shape:hand, shape:grid:16, shape:random:200:7.
 */
#ifndef HS_MESH_SOURCE_H
#define HS_MESH_SOURCE_H

#include "mesh.h"

/* Opens a mesh; notes of an OBJ file go to stderr unless quiet, and fractions of a sharpness are
 * refused unless they may be rounded. On failure *mesh is empty. */
bool hs_mesh_open(hs_mesh *mesh, const char *source, bool round_sharpness, bool quiet,
                  hs_error *err);

/* Sets mesh->forced from a text file. A line is `FACE DEPTH` or `FIRST-LAST DEPTH`; faces count
 * from 1 in the order of the mesh, depths go to HS_MAX_DEPTH; # begins a comment; of lines for the
 * same face the last one holds. Errors (HS_EXIT_MESH, HS_EXIT_FILE) name file and line. */
bool hs_mesh_force(hs_mesh *mesh, const char *path, hs_error *err);

/* The same from a text in memory, one line: what stands behind `force` in a trace.txt. where is for
 * messages. An empty line is fine. */
bool hs_mesh_force_line(hs_mesh *mesh, const char *line, const char *where, hs_error *err);

#endif
