/* SPDX-License-Identifier: Apache-2.0
 *
 * What a figure shows, in numbers: for captions, and as JSON for pages that quote them.
 */
#ifndef HS_FIGURE_COUNTS_H
#define HS_FIGURE_COUNTS_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One surface of a figure. */
typedef struct hs_figure_panel {
    char caption[64];
    uint32_t vertices, faces;
    uint32_t cut;     /* triangles, once the faces are cut for drawing, or for POV-Ray */
    uint32_t deepest; /* generation */
    uint32_t generation[HS_MAX_DEPTH + 1]; /* faces of each */
    uint32_t facing[3];                    /* faces of each enum hs_facing */
} hs_figure_panel;

enum { HS_FIGURE_PANELS = HS_VIEW_COUNT };

typedef struct hs_figure_counts {
    uint32_t panels;
    hs_figure_panel panel[HS_FIGURE_PANELS];
    uint64_t cycles; /* by the cycle-level model; 0: the figure does not ask for them */
} hs_figure_counts;

/* Adds a panel. It must be one of the first HS_FIGURE_PANELS. */
void hs_figure_count(hs_figure_counts *counts, const char *caption, const hs_surface *surface);

/* "initial mesh (680 faces)". */
enum { HS_FIGURE_CAPTION = 128 };
void hs_figure_caption(char caption[HS_FIGURE_CAPTION], const hs_figure_panel *panel);

/* Writes {"figure": name, "panels": [{"caption", "vertices", "faces", "cut", "generations": [],
 * "facing": {"front", "back", "both"}}], "cycles"} to a file, "-" for standard output
 * (HS_EXIT_FILE, HS_EXIT_INTERNAL). */
bool hs_figure_counts_write(const hs_figure_counts *counts, const char *figure, const char *path,
                            hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
