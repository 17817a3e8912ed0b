/* SPDX-License-Identifier: Apache-2.0
 *
 * The options that say what a surface is and where refinement ends, as several commands take them:
 * --boundary, --limit, --min-edge-px. --size belongs to them as far as pixels are concerned.
 */
#ifndef HS_SURFACE_OPTIONS_H
#define HS_SURFACE_OPTIONS_H

#include "stream.h"

/* The values as they were given; NULL: not given. */
typedef struct hs_surface_texts {
    const char *boundary, *min_edge;
    bool limit;
} hs_surface_texts;

/* Names of the boundary modes, as in "edge-only". */
const char *hs_boundary_name(hs_boundary boundary);

/* Reads a name of a boundary mode; false if there is none such. */
bool hs_boundary_parse(const char *text, hs_boundary *boundary);

/* Reads a length in pixels, 1/16 to 4095, to the nearest sixteenth; false if it is none. */
bool hs_pixels_parse(const char *text, uint16_t *sixteenths);

/* Puts boundary (smooth if not given), limit and least edge into *settings; width and height are
 * the picture's. With a least edge, depths that are not given become limits for safety only.
 * False if a text is not understood (HS_EXIT_USAGE). */
enum { HS_SAFETY_DEPTH = 24 };
bool hs_surface_settings(hs_settings *settings, const hs_surface_texts *texts, uint32_t width,
                         uint32_t height, hs_error *err);

#endif
