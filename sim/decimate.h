/* SPDX-License-Identifier: Apache-2.0
 *
 * Fewer faces for looking at: vertices of one cell of a cubic grid become one, at their mean, and
 * faces with fewer than three corners left vanish. The cells are as small as the number of faces
 * allows.
 */
#ifndef HS_DECIMATE_H
#define HS_DECIMATE_H

#include "error.h"

#include <stdint.h>

/* Faces that name vertices. All is owned by it, from malloc. */
typedef struct hs_decimated {
    uint32_t vertices, faces;
    double *position; /* 3 per vertex */
    uint32_t *first;  /* faces + 1: where a face's corners begin */
    uint32_t *corner;
    uint32_t *source; /* per face: which one of the faces given it was; they increase */
} hs_decimated;

/* position: 3 per vertex, finite. With most faces or fewer, all stay as they are (vertices too);
 * otherwise at most `most` (1 or more) of them stay. On failure (memory) *fewer is empty. */
bool hs_decimate(hs_decimated *fewer, uint32_t vertices, const double *position, uint32_t faces,
                 const uint32_t *first, const uint32_t *corner, uint32_t most, hs_error *err);
void hs_decimated_free(hs_decimated *fewer);

#endif
