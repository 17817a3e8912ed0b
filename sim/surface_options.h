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

/* Rows of a table of options, for commands that refine a mesh and show or write what came out:
 * surface is an hs_surface_options, round and force are where --round-sharpness and --force go. */
/* clang-format off */
#define HS_REFINED_OPTIONS(surface, round, force)                                                  \
    {"front", 'f', HS_OPTION_NUMBER, "DEPTH", &(surface).front, 0, HS_MAX_DEPTH,                   \
     &(surface).front_given, "steps for front faces in view (4)"},                                 \
    {"silhouette", 's', HS_OPTION_NUMBER, "DEPTH", &(surface).silhouette, 0, HS_MAX_DEPTH,         \
     &(surface).silhouette_given, "steps for faces at the silhouette (8)"},                        \
    {"min-edge-px", 0, HS_OPTION_TEXT, "PIXELS", &(surface).min_edge, 0, 0, NULL,                  \
     "leave faces alone whose edges are all shorter"},                                             \
    {"boundary", 'b', HS_OPTION_TEXT, "MODE", &(surface).boundary, 0, 0, NULL,                     \
     "kept, smooth or edge-only (smooth)"},                                                        \
    {"limit", 0, HS_OPTION_FLAG, NULL, &(surface).limit, 0, 0, NULL,                               \
     "vertices at their limit positions"},                                                         \
    {"round-sharpness", 0, HS_OPTION_FLAG, NULL, &(round), 0, 0, NULL,                             \
     "round fractions of a sharpness, halves up"},                                                 \
    {"guard", 'g', HS_OPTION_NUMBER, "0|1", &(surface).guard, 0, 1, &(surface).guard_given,        \
     "refine the ring around selected faces as well (1)"},                                         \
    {"uniform", 'u', HS_OPTION_NUMBER, "DEPTH", &(surface).uniform, 0, HS_MAX_DEPTH,               \
     &(surface).uniform_given, "so many steps everywhere, whatever the view shows"},               \
    {"force", 0, HS_OPTION_TEXT, "FILE", &(force), 0, 0, NULL,                                     \
     "depths for single faces: lines `FIRST-LAST DEPTH`,\nfaces from 1 as in the mesh"}
/* clang-format on */

/* Names of the boundary modes, as in "edge-only". */
const char *hs_boundary_name(hs_boundary boundary);

/* Reads a name of a boundary mode; false if there is none such. */
bool hs_boundary_parse(const char *text, hs_boundary *boundary);

/* Reads a length in pixels, 1/16 to 4095, to the nearest sixteenth; false if it is none. */
bool hs_pixels_parse(const char *text, uint16_t *sixteenths);

/* Reads the size of a picture, as in "768x768", 16 to 8192 each. False (HS_EXIT_USAGE) otherwise.
 */
bool hs_size_parse(const char *text, uint32_t *width, uint32_t *height, hs_error *err);

/* Makes settings of them; boundary is smooth if not given, width and height are the picture's,
 * forced: depths of single faces are given as well. With a least edge, depths that are not given
 * become limits for safety only: HS_SAFETY_DEPTH. False (HS_EXIT_USAGE) if a text is not understood
 * or --uniform stands beside a depth. */
enum { HS_SAFETY_DEPTH = 24 };
bool hs_surface_settings(hs_settings *settings, const hs_surface_options *options, bool forced,
                         uint32_t width, uint32_t height, hs_error *err);

#endif
