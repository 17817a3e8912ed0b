/* SPDX-License-Identifier: Apache-2.0
 *
 * The meshes of a view for the page of halfstep report: what came out, and the surface as it was
 * after 0, 1, 2, ... steps. Golden makes these of the same input packet with all depths cut to the
 * step: what is refined in a generation depends on those before alone, so this is the run, halted.
 *
 *   input.hss  -- depths cut to k --> golden -.                      .-> JSON: positions of 16
 * bits, output.hss ------------------------------- +-> surface -> fewer -+   corners, and per face
 * its generation, depth, facing, end
 */
#ifndef HS_REPORT_MESH_H
#define HS_REPORT_MESH_H

#include <jansson.h>

#include "golden.h"

/* How a face left the pipeline. sim/report/mesh.js has the words. */
enum hs_face_end {
    HS_END_WHOLE,    /* as it was: not refined in its generation */
    HS_END_CUT,      /* a triangle along an edge that is kept, cut off a face that was refined */
    HS_END_LAST_STEP /* a child of the last step */
};

/* What to read, and how much of it to keep. */
typedef struct hs_report_mesh_request {
    const char *folder; /* of the view: input.hss, output.hss */
    uint32_t most;      /* faces of a mesh that are kept, 1 or more: decimated if it has more */
    hs_golden *golden;
} hs_report_mesh_request;

/* The object of a view:
 *
 *   box      [x, y, z, x, y, z]: least and largest coordinates of all steps, object space
 *   steps    of each: step, faces, vertices (of the mesh), stored (faces that are kept), data
 *   matrix   16 numbers, row-major, clip = M p; from the packet
 *
 * data is packed (report_pack.h): vertices, faces; the x of all vertices, as differences to the one
 * before, in 16383ths of the box, then all y, all z; per face sides, generation, depth (steps that
 * its youngest vertex has seen), facing + 4 * hs_face_end; corners, each as how many vertices it is
 * behind the ones named so far: 0 is the next one. Faces are not in the order of the stream, but
 * near ones near each other, which packs better.
 *
 * NULL with an empty why: memory, *err says so. NULL with a why: there is no mesh to show, and that
 * is the reason, in words (a file is missing or broken, the view was refused, the matrix is
 * singular). */
json_t *hs_report_mesh(const hs_report_mesh_request *request, char *why, size_t size,
                       hs_error *err);

#endif
