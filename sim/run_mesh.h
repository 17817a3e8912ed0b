/* SPDX-License-Identifier: Apache-2.0
 *
 * The mesh of a run and its views: one mesh from all viewpoints, or a mesh a view.
 */
#ifndef HS_RUN_MESH_H
#define HS_RUN_MESH_H

#include "run.h"

/* Opens what the request names, and the views. Of a deforming mesh all files are read once, so that
 * what is wrong with one is found out now; run->mesh is the first. Its views are as many as there
 * are files, or one for all; those of an orbit see all meshes. */
bool hs_run_mesh_open(hs_run *run, hs_error *err);

/* Has run->mesh be that of a view. Does nothing where one mesh has all views. */
bool hs_run_mesh_enter(hs_run *run, uint32_t view, hs_error *err);

#endif
