/* SPDX-License-Identifier: Apache-2.0
 *
 * The options that say what a surface is and where it is refined, as several commands take them:
 * --front, --silhouette, --guard, --uniform, --min-edge-px, --boundary, --limit. --size belongs to
 * them as far as pixels are concerned, and --uniform excludes --force.
 */
#ifndef HS_SURFACE_OPTIONS_H
#define HS_SURFACE_OPTIONS_H

#include "stream.h"

/* The values as they were given; texts that were not are NULL. */
typedef struct hs_surface_options {
    uint32_t front, silhouette, guard, uniform; /* depths up to HS_MAX_DEPTH; guard 0 or 1 */
    bool front_given, silhouette_given, guard_given, uniform_given;
    const char *boundary, *min_edge;
    bool limit;
} hs_surface_options;
#define HS_SURFACE_DEFAULTS ((hs_surface_options){.front = 4, .silhouette = 8, .guard = 1})

/* Names of the boundary modes, as in "edge-only". */
const char *hs_boundary_name(hs_boundary boundary);

/* Reads a name of a boundary mode; false if there is none such. */
bool hs_boundary_parse(const char *text, hs_boundary *boundary);

/* Reads a length in pixels, 1/16 to 4095, to the nearest sixteenth; false if it is none. */
bool hs_pixels_parse(const char *text, uint16_t *sixteenths);

/* Makes settings of them; boundary is smooth if not given, width and height are the picture's,
 * forced: depths of single faces are given as well. With a least edge, depths that are not given
 * become limits for safety only: HS_SAFETY_DEPTH. False (HS_EXIT_USAGE) if a text is not understood
 * or --uniform stands beside a depth. */
enum { HS_SAFETY_DEPTH = 24 };
bool hs_surface_settings(hs_settings *settings, const hs_surface_options *options, bool forced,
                         uint32_t width, uint32_t height, hs_error *err);

#endif
