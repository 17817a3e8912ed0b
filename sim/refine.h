/* SPDX-License-Identifier: Apache-2.0
 *
 * A mesh in, what golden makes of it under one view out: for commands that show or write surfaces.
 */
#ifndef HS_REFINE_H
#define HS_REFINE_H

#include "golden.h"
#include "mesh.h"

/* Refines a mesh for a view (matrix row-major, clip = M p). What *output held is not freed. An
 * output that a capacity stopped early is an output: its status is HS_STATUS_STOPPED. False, with
 * *output empty: the pipeline refuses the view (HS_EXIT_REFUSED), or memory (HS_EXIT_INTERNAL). */
bool hs_refine(hs_output *output, const hs_mesh *mesh, const float matrix[16],
               const hs_settings *settings, hs_limits limits, hs_error *err);

#endif
